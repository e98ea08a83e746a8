#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The front end's Verilog under Verilator by the test bench of the C: the golden vectors of frames, arcs and edge maps and 2000
# drawn images, every word; a frame in four with a camera that has gaps. Clocks of the busiest frame that fills the region.
# usage: simulate.sh [WIDTH]     largest region, 256; 77 where a tool is absent
set -euo pipefail
cd "$(dirname "$0")/../.."
. src/sources.sh
. hls/usage.sh
root=$PWD
width=${1:-256}
[[ $width =~ ^[1-9][0-9]*$ ]] || usage
for tool in verilator make g++; do
    command -v $tool >/dev/null || { echo "rtl simulation: SKIPPED: no $tool" && exit 77; }
done
hls/rtl/rtl.sh "$width"
hls/vectors.sh frontend frame arcs canny >/dev/null
work=build/hls/rtl/$width
rm -rf "$work/objects"
mkdir -p "$work/objects"
{
    core_files "$root" '*.c'
    printf '%s\n' "$root"/hls/{frontend/testbench.c,bench/bench.c} "$root"/build/hls/frontend/cases_*.c
} >"$work/sources"
flags=("-DDROGUE_HLS_WIDTH=$width" "-I$root/include" "-I$root/hls" "-I$root/hls/bench" "-I$root/tests/conformance")
(cd "$work/objects" && xargs gcc -std=c99 -O2 -Wno-unknown-pragmas "${flags[@]}" -c <../sources)
if ! verilator --cc --exe --build -Wall -Wno-UNUSED -Wno-DECLFILENAME -O3 --x-assign fast --x-initial fast \
    --Mdir "$work/verilated" --top-module drogue_frontend "$work/drogue_frontend.v" "$root/hls/rtl/frontend_rtl.cpp" \
    "$root/$work"/objects/*.o -CFLAGS "-O2 ${flags[*]}" -o simulation >"$work/verilator.log" 2>&1; then
    tail -n 20 "$work/verilator.log"
    exit 1
fi
if ! "$work/verilated/simulation" >"$work/simulation.log"; then
    grep -v '^ok ' "$work/simulation.log"
    exit 1
fi
tail -n 2 "$work/simulation.log"

# What the page says of regions of 256 x 256
says() { grep -qF -- "$1" hls/README.md || { echo "rtl simulation: hls/README.md does not say: $1" && exit 1; }; }
if [ "$width" = 256 ]; then
    cases=$(sed -nE 's/^frontend: cases=([0-9]+) .*/\1/p' "$work/simulation.log")
    clocks=$(sed -nE 's/^rtl: .*: ([0-9]+) clocks, ([0-9]+) of them .*: ([0-9.]+) a pixel/\1 \2 \3/p' "$work/simulation.log")
    read -r all before a_pixel <<<"$(sed -E 's/([0-9]+)([0-9]{3}) /\1,\2 /g' <<<"$clocks")"
    says "front end, $cases cases of the vectors and 2,000 drawn images;"
    says "| $all, lists included; $before until the last pixel's merges |"
    says "$all clocks for 65,536 pixels, lists included: $a_pixel a pixel"
fi
