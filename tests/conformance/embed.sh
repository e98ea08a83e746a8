#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Cases compiled in give what the files give: the same lines, the same digest, however many files they are split into.
# usage: embed.sh ROOT CC CONFORMANCE CONFORMANCE_EMBED TINY_VECTORS
set -euo pipefail
. "$(dirname "$0")/../../src/sources.sh"
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

# build FOLDER: the run over the cases in it
build() {
    "$cc" -std=c99 -pedantic -Wall -Wextra -Werror -O1 -I "$root/include" -I "$here" "$here"/embedded_main.c \
        "$here"/conformance.c "$here"/sha256.c "$here"/stages*.c $(core_files "$root" '*.c') "$1"/cases_*.c -o "$1/run"
}

for files in 1 3 40; do # 40: more than there are cases
    mkdir "$work/$files"
    "$embed" "$work/vectors" "$work/$files" $files
    build "$work/$files"
    "$work/$files/run" >"$work/$files/out"
    if ! sed 1d "$work/$files/out" | cmp - "$work/expected"; then
        status=1
    fi
    grep -qx 'vectors 0.0.1' "$work/$files/out"
done

# A stage, or a case by its id; what names nothing is an error.
mkdir "$work/chosen" "$work/none"
"$embed" "$work/vectors" "$work/chosen" 2 eigen frame/tiny
build "$work/chosen"
"$work/chosen/run" | grep -E '^conformance: cases=2 exact=[0-9]+ failed=0 ' || status=1
if "$embed" "$work/vectors" "$work/none" 1 eigen frames; then
    echo "a stage that is not there is taken"
    status=1
fi
exit $status
