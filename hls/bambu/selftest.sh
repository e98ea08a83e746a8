#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# bambu.sh must not take a failure for a pass: here a stand-in for bambu ends as the real one can.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit
. hls/tops.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
name=eigen
top $name

# expect STATUS WORD SCRIPT FLAG...: bambu.sh with a bambu that runs SCRIPT
expect() {
    local wanted=$1 word=$2 status=0
    printf '#!/usr/bin/env bash\n%s\n' "$3" >"$work/bambu"
    chmod +x "$work/bambu"
    PATH=$work:$PATH DROGUE_HLS_TIMEOUT_S=1 hls/bambu/bambu.sh "$name" "${@:4}" >"$work/out" 2>&1 || status=$?
    if [ $status -ne "$wanted" ] || ! grep -q "^$word" "$work/out"; then
        echo "FAILED  bambu.sh: status $status instead of $wanted and '$word' after: $3"
        cat "$work/out"
        failures=$((failures + 1))
    fi
}

rtl="echo module >$function.v"
ran="echo 'Average execution   : 12 cycles'"
expect 0 PASS "$rtl"
expect 0 PASS "$rtl; $ran" --simulate
expect 1 FAIL "true"
expect 1 FAIL "$rtl; exit 1"
expect 1 FAIL "$rtl" --simulate
expect 1 MISMATCH "$rtl; $ran; echo 'mismatch on memory'" --simulate
expect 1 MISMATCH "$rtl; $ran; mkdir -p HLS_output/simulation; echo 'Returned error code!' >HLS_output/simulation/testbench.log" --simulate
expect 1 FAIL "$rtl; $ran; echo \"fatal error: 'asm/errno.h' file not found\"; echo 'Returned error code!'" --simulate
expect 1 FAIL "echo '.PROXY_PREF_done_port_root(1'\\''b0)' >$function.v; $ran" --simulate
expect 1 TIMEOUT "sleep 20"

# area.sh likewise, with a stand-in for yosys: counts are those of the whole hierarchy, and one failed module is a failure
yosys() { printf '#!/usr/bin/env bash\n%s\n' "$1" >"$work/yosys" && chmod +x "$work/yosys"; }
answers="case \$3 in
*modules*) printf '\n2 modules:\n  f\n  $function\n' >modules ;;
*'tee -o stat'*) printf '=== f ===\n     LUT2      7\n=== design hierarchy ===\n     LUT2     14\n     LUT6      1\n     FDRE      3\n     RAMB36E1  2\n     DSP48E1   5\n     RAM32M    2\n     SRL16E    1\n' >stat ;;
esac"
yosys "$answers"
expect 0 "area of $name: LUT=15 FF=3 DSP=5 BRAM18=4 LUTRAM=9" "$rtl" --area
yosys "$answers
case \$3 in *'-top f'*) exit 1 ;; esac"
expect 1 "area of $name: yosys did not end well" "$rtl" --area
yosys "${answers/design hierarchy/f again}"
expect 1 "area of $name: no counts" "$rtl" --area
yosys 'sleep 20'
expect 1 "area of $name: yosys did not end well" "$rtl" --area
rm -rf "build/hls/bambu/$name"

# without bambu
mkdir "$work/bin"
for program in bash sed cut grep dirname basename; do
    ln -s "$(command -v $program)" "$work/bin/"
done
status=0
PATH=$work/bin hls/bambu/bambu.sh "$name" >"$work/out" 2>&1 || status=$?
if [ $status -ne 77 ] || ! grep -qx 'SKIPPED: no bambu' "$work/out"; then
    echo "FAILED  bambu.sh: status $status where there is no bambu"
    failures=$((failures + 1))
fi
[ $failures -eq 0 ] && echo 'bambu: self-test of the judge passed'
[ $failures -eq 0 ]
