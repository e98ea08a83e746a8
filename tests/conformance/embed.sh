#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Cases compiled in give what the files give: the same lines, the same digest, however many files they are split into.
# usage: embed.sh ROOT CC CONFORMANCE CONFORMANCE_EMBED TINY_VECTORS
set -euo pipefail
root=$1
cc=$2
conformance=$3
embed=$4
here=$root/tests/conformance
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$5" "$work/vectors"
"$conformance" --vectors "$work/vectors" >"$work/expected"
status=0

for files in 1 3 40; do # 40: more than there are cases
    mkdir "$work/$files"
    "$embed" "$work/vectors" "$work/$files" $files
    "$cc" -std=c99 -pedantic -Wall -Wextra -Werror -O1 -I "$root/include" -I "$here" "$here"/embedded_main.c \
        "$here"/conformance.c "$here"/sha256.c "$here"/stages*.c "$root"/src/*.c "$work/$files"/cases_*.c \
        -o "$work/$files/run"
    "$work/$files/run" >"$work/$files/out"
    if ! sed 1d "$work/$files/out" | cmp - "$work/expected"; then
        status=1
    fi
    grep -qx 'vectors 0.0.1' "$work/$files/out"
done
exit $status
