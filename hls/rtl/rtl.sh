#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The front end in Verilog, a clock of the C a clock of the block: build/hls/rtl/WIDTH/drogue_frontend.v, sizes.vh.
# clang makes LLVM IR of drogue_hls_step(), verilog.py a combinational module of that, shell.c registers and memories.
# usage: rtl.sh [WIDTH]      largest region, 256, at most 2048; 77 where clang, llvm or python3 are absent
set -euo pipefail
cd "$(dirname "$0")/../.."
. hls/usage.sh
width=${1:-256}
[[ $width =~ ^[1-9][0-9]{0,3}$ && $width -le 2048 ]] || usage
for tool in clang llvm-link opt python3 gcc; do
    command -v $tool >/dev/null || { echo "rtl: SKIPPED: no $tool" && exit 77; }
done
work=build/hls/rtl/$width
mkdir -p "$work"
flags=(-std=c99 -w -Iinclude -Ihls "-DDROGUE_HLS_WIDTH=$width")

sources=(hls/rtl/step_rtl.c hls/frontend/{step,labels,lists,operators,pixels}.c)
bitcode=()
for source in "${sources[@]}"; do
    bitcode+=("$work/$(basename "$source" .c).bc")
    clang "${flags[@]}" -O2 -Xclang -disable-llvm-passes -fno-builtin -emit-llvm -c "$source" -o "${bitcode[-1]}"
done
# Everything in one function, every loop unrolled, every variable a value.
straighten='loop-simplify,lcssa,loop-mssa(loop-rotate),loop(indvars,loop-unroll-full),sroa,'
passes="internalize,globaldce,cgscc(inline),function(${straighten}early-cse,simplifycfg,${straighten}instcombine,"
passes+='simplifycfg,early-cse,instcombine,adce),globaldce'
llvm-link "${bitcode[@]}" -o "$work/all.bc"
opt -passes="$passes" -internalize-public-api-list=drogue_hls_step_rtl -inline-threshold=1000000 \
    -unroll-threshold=1000000 -S "$work/all.bc" -o "$work/step.ll"
gcc "${flags[@]}" hls/rtl/shell.c -o "$work/shell"
{
    cat hls/rtl/memory.v
    "$work/shell" begin
    python3 hls/rtl/verilog.py "$work/step.ll" drogue_hls_step_rtl now=in asked=in read=in next=now places=out write=out
    "$work/shell"
} >"$work/drogue_frontend.v"
"$work/shell" sizes >"$work/sizes.vh"
echo "rtl: $work/drogue_frontend.v"
