#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Every pure pixel operator of the streams alone, through Bambu as a pipelined block with interval 1; a line each. Exit
# status 0 when all could be made, 77 where there is no bambu. Device and clock as for bambu.sh.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit
root=$PWD
if ! command -v bambu >/dev/null; then
    echo 'SKIPPED: no bambu'
    exit 77
fi
status=0
for header in hls/frontend/operators.h; do
    for operator in $(grep -v '^static' "$header" | grep -oE '\bdrogue_hls_[a-z_]+\(' | tr -d '(' | awk '!seen[$0]++'); do
        work=build/hls/bambu/operators/$operator
        rm -rf "$work"
        mkdir -p "$work"
        (cd "$work" && bambu "--top-fname=$operator" --std=c99 -O2 "--pipelining=$operator=1" \
            "--device-name=${DROGUE_HLS_BAMBU_DEVICE:-xc7z020,-1,clg484,VVD}" \
            "--clock-period=${DROGUE_HLS_CLOCK_NS:-5}" "-I$root/include" "-I$root/hls" "$root/${header%.h}.c" \
            >log 2>&1 </dev/null)
        verdict=PASS
        if [ ! -s "$work/$operator.v" ] || ! grep -q 'Required pipelining with II=1' "$work/log"; then
            verdict=FAIL
            status=1
        fi
        # the report of a function's own schedule comes last
        printf '%s %s control_steps=%s MHz=%s FF=%s DSP=%s\n' "$verdict" "$operator" \
            "$(sed -nE 's/.*Number of control steps: ([0-9]+).*/\1/p' "$work/log" | tail -n 1)" \
            "$(sed -nE 's/.*Estimated max frequency \(MHz\): ([0-9]+).*/\1/p' "$work/log" | tail -n 1)" \
            "$(sed -nE 's/.*flip-flops in function [^ ]*: ([0-9]+).*/\1/p' "$work/log" | tail -n 1)" \
            "$(sed -nE 's/.*Estimated number of DSPs: ([0-9]+).*/\1/p' "$work/log" | tail -n 1)"
    done
done
exit $status
