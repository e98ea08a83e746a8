#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The golden vectors of stage 'frame' through the small system under Verilator, every word; then frames that fill its labels and its points.
# A line a case, then one that sums up.
# usage: vectors.sh [--few | STAGE/CASE...]     all of them; --few: 22 small ones and the tables; 77 where a tool is absent
set -euo pipefail
cd "$(dirname "$0")/../.."
. hls/system/build.sh
. hls/usage.sh
[[ ${1:-} =~ ^(--few$|[^-]|$) ]] || usage
need 'system vectors' verilator make gcc g++ riscv64-unknown-elf-gcc
few=(scene-20m-{1,2} scene-25m-{1,2} far-region noise faint-noise all-black no-drogue square straight-edge outline-outside-ring
    region-{empty,too-large,too-far,beside-image,left-of-image} no-radius radius-negative no-focal-length one-row one-column)
if [ $# -eq 0 ]; then
    set -- frame
elif [ "$1" = --few ]; then
    set -- "${few[@]/#/frame/}"
fi
work=$made/vectors
mkdir -p "$work/words"
if [ -n "${DROGUE_CONFORMANCE_EMBED:-}" ]; then # built already
    rm -f "$work"/cases_*.c
    "$DROGUE_CONFORMANCE_EMBED" vectors "$work" 1 "$@"
else
    tests/matrix/embed.sh "$work" 1 "$@"
fi
firmware "$work" hls/system/measure.c
model
own=("-I$root/include" "-I$root/hls" "-I$root/hls/bench" "-I$root/tests/conformance")
(cd "$work/words" && rm -f ./*.o && gcc -std=c99 -O2 "${own[@]}" -c "$root"/hls/bench/bench.c \
    "$root"/tests/conformance/stages*.c "$work"/cases_*.c)
bench "$work/bench" hls/system/vectors.cpp "${own[@]}" "$work"/words/*.o
(cd "$work" && ./bench)
