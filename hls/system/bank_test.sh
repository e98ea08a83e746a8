#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The register bank with the front end behind it under Verilator, its state read every clock, and its interrupt by the driver.
# usage: bank_test.sh     77 where a tool is absent
set -euo pipefail
cd "$(dirname "$0")/../.."
. hls/usage.sh
[ $# -eq 0 ] || usage
for tool in verilator make gcc g++; do
    command -v "$tool" >/dev/null || { echo "bank: SKIPPED: no $tool" && exit 77; }
done
hls/rtl/rtl.sh 256 >/dev/null
work=$PWD/build/hls/system/bank
mkdir -p "$work"
gcc -std=c99 -O1 -Iinclude -c hls/driver/block.c -o "$work/block.o"
verilator --cc --exe --build -O3 --x-assign fast --x-initial fast -Wall -Mdir "$work" --public-flat-rw --top-module drogue_bank \
    -Ibuild/hls/rtl/256 hls/system/lint.vlt hls/system/bank.v build/hls/rtl/256/drogue_frontend.v \
    "$PWD/hls/system/bank_test.cpp" "$work/block.o" -CFLAGS "-O1 -I$PWD/hls -I$PWD/include" -o bank_test \
    >"$work/verilator.log" 2>&1 || { tail -n 20 "$work/verilator.log" && exit 1; }
"$work/bank_test"
