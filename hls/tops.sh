# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# Sourced, in the project's folder: reads hls/tops.txt.

. src/sources.sh

tops_list() { sed -E '/^#|^ *$/d; s/ *\| */|/g; s/ +$//' "${DROGUE_HLS_TOPS:-hls/tops.txt}"; }

all_tops() { tops_list | cut -d'|' -f1; }

# tops [NAME...]: names of all tops, or those given, which must be in the list
tops() {
    local name
    if [ $# -eq 0 ]; then
        all_tops
    fi
    for name in "$@"; do
        if ! tops_list | grep -q "^$name|"; then
            echo "no top '$name' in hls/tops.txt" >&2
            return 2
        fi
        echo "$name"
    done
}

# top NAME: sets function; sources, bench, core, replaced (files, from the project's folder); stages, cosimulated
# shellcheck disable=SC2034 # for those who source this
top() {
    local line
    line=$(tops_list | grep "^$1|")
    IFS='|' read -r _ function sources bench stages cosimulated core replaced <<<"$line"
    sources=$(sed -E 's|[^ ]+|hls/&|g' <<<"$sources")
    bench=$(sed -E 's|[^ ]+|hls/&|g' <<<"$bench")
    core=$(sed -E 's|[^ ]+|src/&.c|g' <<<"$core")
    replaced=$(sed -E 's|[^ ]+|src/&.c|g' <<<"$replaced")
}
