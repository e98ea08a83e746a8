# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# Sourced, in the project's folder: reads hls/tops.txt.

tops_list() { sed -E '/^#|^ *$/d; s/ *\| */|/g; s/ +$//' "${DROGUE_HLS_TOPS:-hls/tops.txt}"; }

# tops [NAME...]: names of all tops, or those given, which must be there
tops() {
    local name
    if [ $# -eq 0 ]; then
        tops_list | cut -d'|' -f1
        return
    fi
    for name in "$@"; do
        if ! tops_list | grep -q "^$name|"; then
            echo "no top '$name' in hls/tops.txt" >&2
            return 2
        fi
        echo "$name"
    done
}

# top NAME: sets function, source, bench, stages, core (its files of src/), folder (of its scripts)
# shellcheck disable=SC2034 # for those who source this
top() {
    local line stems stem
    line=$(tops_list | grep "^$1|")
    IFS='|' read -r _ function source bench stages stems <<<"$line"
    core=""
    for stem in $stems; do
        core+="${core:+ }src/$stem.c"
    done
    folder=$(dirname "$source")
    if [ "$(basename "$folder")" != "$1" ]; then
        folder+=/$1
    fi
}
