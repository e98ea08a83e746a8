#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# MISRA C:2012 by cppcheck's addon over the library: no hit of a rule that docs/misra.md does not list as a deviation, and of
# those no more than it counts. A hit in a header counts once. Exit status 77 without cppcheck.
# usage: misra.sh [--update]    --update writes the counts of the rules listed; every hit lies in build/misra/hits
set -euo pipefail
cd "$(dirname "$0")/../.."
. src/sources.sh
page=docs/misra.md
if ! command -v cppcheck >/dev/null; then
    echo 'misra: skipped: no cppcheck here'
    exit 77
fi
mkdir -p build/misra
mapfile -t sources < <(core_files . '*.c')
cppcheck -q -j "$(nproc)" --std=c99 --platform=unix32 --addon=misra -I include "${sources[@]}" 2>build/misra/log
sed -nE 's/^([^:]+:[0-9]+:[0-9]+): .*\[misra-c2012-([0-9.]+)\]$/\2 \1/p' build/misra/log | sort -u >build/misra/hits
if [ ! -s build/misra/hits ]; then
    echo 'misra: not one hit: the addon did not run; see build/misra/log' >&2
    exit 1
fi

status=0
declare -A listed
total=0
while read -r rule count; do
    listed[$rule]=$count
done < <(sed -nE 's/^\| ([0-9]+\.[0-9]+) \| (required|advisory) \| ([0-9]+) \| .+ \|$/\1 \3/p' $page)
while read -r count rule; do
    total=$((total + count))
    if [ "${1:-}" = --update ] && [ -n "${listed[$rule]:-}" ]; then
        sed -i -E "s/^(\| ${rule//./\\.} \| [a-z]+ \| )[0-9]+ /\1$count /" $page
        listed[$rule]=$count
    fi
    if [ "$count" -gt "${listed[$rule]:-0}" ]; then
        echo "misra: rule $rule: $count hits, $page lists ${listed[$rule]:-none}:"
        grep "^$rule " build/misra/hits | cut -d' ' -f2 | head -n 20
        status=1
    elif [ "$count" -lt "${listed[$rule]}" ]; then
        echo "misra: rule $rule: $count hits, fewer than the ${listed[$rule]} in $page: './run misra --update' notes it"
    fi
    unset "listed[$rule]"
done < <(cut -d' ' -f1 build/misra/hits | sort | uniq -c)
for rule in "${!listed[@]}"; do
    echo "misra: rule $rule: no hit is left: take it out of $page"
    status=1
done
echo "misra: files=${#sources[@]} hits=$total status=$status"
exit $status
