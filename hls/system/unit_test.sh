#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The units beside the soft core under Verilator beside the library.
# usage: unit_test.sh [DRAWN]     operands drawn for each operation, 100000; 77 where a tool is absent
set -euo pipefail
cd "$(dirname "$0")/../.."
. src/sources.sh
. hls/usage.sh
[[ ${1:-1} =~ ^[1-9][0-9]*$ ]] || usage
root=$PWD
for tool in verilator make gcc g++; do
    command -v "$tool" >/dev/null || { echo "unit: SKIPPED: no $tool" && exit 77; }
done
hls/system/unit.sh
work=$root/build/hls/system/unit
mkdir -p "$work/objects"
flags=("-I$root/include" "-I$root/hls")
(cd "$work/objects" && rm -f ./*.o && core_files "$root" '*.c' | xargs gcc -std=c99 -O2 "${flags[@]}" -c)
gcc -std=c99 -O2 "${flags[@]}" -c hls/system/points_unit.c -o "$work/objects/points_unit.o"
verilator --cc --exe --build -O3 --x-assign fast --x-initial fast -Wall -Mdir "$work/verilated" --top-module drogue_unit \
    hls/system/lint.vlt hls/system/unit.v "$work/units.v" \
    "$root/hls/system/unit_test.cpp" "$work"/objects/*.o -CFLAGS "-O1 ${flags[*]}" -o unit_test \
    >"$work/verilator.log" 2>&1 || { tail -n 20 "$work/verilator.log" && exit 1; }
"$work/verilated/unit_test" "$@"
