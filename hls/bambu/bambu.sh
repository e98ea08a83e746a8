#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A top through Bambu (PandA), in build/hls/bambu/NAME: RTL; with --simulate the RTL beside the C, under Verilator, over
# the vectors of build/hls/NAME; with --area what yosys makes of it for 7-series. One line: PASS, or FAIL, MISMATCH,
# TIMEOUT; cycles and frequency as Bambu reports them. Exit status 0 only for PASS, 77 where there is no bambu.
# usage: bambu.sh NAME [--simulate] [--area] [FLAG...]      other flags go to bambu
# Device, clock and patience: DROGUE_HLS_BAMBU_DEVICE, DROGUE_HLS_CLOCK_NS, DROGUE_HLS_TIMEOUT_S.
# Vectors other than those of hls/tops.txt: DROGUE_HLS_VECTORS="STAGE/CASE ...".
set -euo pipefail
cd "$(dirname "$0")/../.."
. hls/tops.sh
. hls/usage.sh
root=$PWD
[[ ${1:--} != -* ]] || usage
name=$(tops "$1")
top "$name"
if ! command -v bambu >/dev/null; then
    echo 'SKIPPED: no bambu'
    exit 77
fi
simulated=no area=no extra=()
for argument in "${@:2}"; do
    case $argument in
    --simulate) simulated=yes ;;
    --area) area=yes ;;
    *) extra+=("$argument") ;;
    esac
done

flags=("--top-fname=$function" --std=c99 -O2 --generate-interface=INFER
    "--device-name=${DROGUE_HLS_BAMBU_DEVICE:-xc7z020,-1,clg484,VVD}" "--clock-period=${DROGUE_HLS_CLOCK_NS:-5}"
    "-I$root/include" "-I$root/hls" "-I$root/hls/bench" "-I$root/tests/conformance")
# The back end's many functions stay functions: all in one would not come to an end in an hour.
case $name in
outline | edge | pose | eigen | fit | cone | filter) flags+=(-finline-hint-functions --range-analysis-mode=skip --enable-function-proxy) ;;
esac
design=()
for file in $sources $core; do
    design+=("$root/$file")
done
if [ $simulated = yes ]; then
    read -ra vectors <<<"${DROGUE_HLS_VECTORS:-}"
    hls/vectors.sh "$name" "${vectors[@]}"
    flags+=(--simulate --simulator=VERILATOR)
    # The test bench is a program apart, with a library of its own, and without the top: that is the RTL.
    for file in $bench hls/bench/bench.c build/hls/"$name"/cases_*.c $(core_files . '*.c'); do
        flags+=("--generate-tb=$root/$file")
    done
fi

work=build/hls/bambu/$name
rm -rf "$work"
mkdir -p "$work"
cd "$work"
begin=$SECONDS
status=0
timeout --kill-after=10 "${DROGUE_HLS_TIMEOUT_S:-3600}" bambu "${flags[@]}" "${extra[@]}" "${design[@]}" >log 2>&1 </dev/null ||
    status=$?

# Bambu's exit status is no judge: it can be 0 after a mismatch.
complaints() { grep -hE "error:|error ->|ERROR:|Returned error|mismatch|not supported" log HLS_output/simulation/testbench.log; }
# Ports of a shared function that Bambu left open, as it did where another function's name was the end of its name.
open_ports() { sed -nE "s/.*PROXY_PREF_done_port_(\\w+)\\(1'b0\\).*/error: \\1 has an open port/p" "$function.v" 2>/dev/null; }
verdict=PASS
if [ $status -eq 124 ] || [ $status -eq 137 ]; then
    verdict=TIMEOUT
elif grep -q 'fatal error:' log; then
    verdict=FAIL # a header that is not there, of the test bench for one: nothing was simulated
elif [ $simulated = yes ] && grep -qE 'mismatch|Returned error|ERROR:' log HLS_output/simulation/testbench.log 2>/dev/null; then
    verdict=MISMATCH
elif [ $status -ne 0 ] || [ ! -s "$function.v" ]; then
    verdict=FAIL
elif [ $simulated = yes ] && ! grep -q 'Average execution' log; then
    verdict=FAIL # nothing was simulated
elif [ -n "$(open_ports)" ]; then
    verdict=FAIL
fi

# last NAME REGEX: 'NAME=' and the last number that the log gives
last() { sed -nE "s/^ *$2 *: *([0-9]+).*/ $1=\1/p" log | tail -n 1 | tr -d '\n'; }
figures=$(last cycles 'Total cycles')$(last calls 'Number of executions')$(last cycles_a_call 'Average execution')
figures+=$(last MHz 'Estimated max frequency \(MHz\)')
echo "$verdict $name simulated=$simulated seconds=$((SECONDS - begin))$figures log=$work/log"
if [ $verdict != PASS ]; then
    { complaints 2>/dev/null; open_ports; } | sort -u | head -8 || true
    exit 1
fi
if [ $area = yes ]; then
    "$root/hls/bambu/area.sh" "$name" || exit 1
fi
