#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The soft core's units in Verilog, of the library's own functions: build/hls/system/unit/units.v.
# clang makes LLVM IR of each function of PARTS and of all that it calls, verilog.py wires of that, stages.py the clocks.
# usage: unit.sh     77 where clang, llvm or python3 are absent
set -euo pipefail
cd "$(dirname "$0")/../.."
. hls/usage.sh
[ $# -eq 0 ] || usage
for tool in clang llvm-link opt python3; do
    command -v $tool >/dev/null || { echo "unit: SKIPPED: no $tool" && exit 77; }
done
nanoseconds=13 # a stage, by stages.py's estimate
work=build/hls/system/unit
mkdir -p "$work"

# part SOURCE FUNCTION [EVERY FIXED LATE]: the module drogue_FUNCTION; stages.py says what the others are
part() {
    local straighten='loop-simplify,lcssa,loop-mssa(loop-rotate),loop(indvars,loop-unroll-full),sroa,' source bitcode=()
    for source in "hls/system/$1" src/arithmetic/fixed.c; do
        bitcode+=("$work/$2.$(basename "$source" .c).bc")
        # __SYNTHESIS__: leading zeros by the library's own C
        clang -std=c99 -w -Iinclude -Ihls -D__SYNTHESIS__ -O2 -Xclang -disable-llvm-passes -fno-builtin -emit-llvm -c "$source" -o "${bitcode[-1]}"
    done
    llvm-link "${bitcode[@]}" -o "$work/$2.bc"
    opt -passes="internalize,globaldce,cgscc(inline),function(${straighten}early-cse,simplifycfg,${straighten}instcombine,simplifycfg,early-cse,instcombine,adce),globaldce" \
        -internalize-public-api-list="$2" -inline-threshold=1000000 -unroll-threshold=1000000 -S "$work/$2.bc" -o "$work/$2.ll"
    python3 hls/rtl/verilog.py "$work/$2.ll" "$2" asked=in out=out >"$work/$2.wires"
    python3 hls/rtl/stages.py "drogue_$2" "$nanoseconds" "${@:3}" <"$work/$2.wires"
}

{
    part real_unit.c real_unit_linear
    part points_unit.c points_unit_place 8 672 0 # what is told of the ellipse stays
    part points_unit.c points_unit_count
    part points_unit.c points_unit_moments 8 1280 4 # of the moments, the point before is there then
    part ray_unit.c ray_unit_place
    part ray_unit.c ray_unit_rows
    part ray_unit.c ray_unit_grey
    part ray_unit.c ray_unit_slope
    part fit_unit.c fit_unit_ray
} >"$work/units.v"
echo "unit: $work/units.v"
