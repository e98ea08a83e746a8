#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs the C simulation of every top and checks whether it can be synthesised; one table. Before it what is wrong, and
# the checks of the check itself and of the scripts for the tools.
# usage: table.sh FOLDER      of the simulations hls_NAME that CMake builds
set -uo pipefail
cd "$(dirname "$0")/.." || exit
. hls/tops.sh
. hls/usage.sh
[[ ${1:--} != -* ]] || usage
simulations=$(cd "$OLDPWD" && realpath "$1")
work=build/hls
export DROGUE_CONFORMANCE_EMBED=$simulations/../tests/conformance/conformance_embed
mkdir -p "$work"
status=0

# value NAME LINE: of NAME=VALUE in a line
value() { sed -nE "s/.*\b$1=([^ ]*).*/\1/p" <<<"$2"; }

# examine NAME: simulation and check; adds a row
examine() {
    local begin=$SECONDS verdict=ok last found
    if ! "$simulations/hls_$1" >"$work/$1.log" 2>&1; then
        verdict='FAILED: simulation'
        grep -v '^ok ' "$work/$1.log" | tail -n 20
    fi
    last=$(grep -E '^[a-z]+: cases=[0-9]+ failed=[0-9]+' "$work/$1.log" | tail -n 1)
    if [ -z "$last" ] || [ "$(value failed "$last")" != 0 ] || [ "$(value cases "$last")" = 0 ]; then
        verdict='FAILED: simulation'
    fi
    if ! hls/vectors.sh "$1" >"$work/$1.vectors" 2>&1; then
        verdict="${verdict/#ok/FAILED:} vectors"
        cat "$work/$1.vectors"
    fi
    if ! hls/check/check.sh "$1" >"$work/$1.check"; then
        verdict="${verdict/#ok/FAILED:} check"
        grep -vE '^[a-z]+: functions=|^hls check' "$work/$1.check"
    fi
    found=$(tail -n 2 "$work/$1.check" | grep ': functions=')
    rows+=("$1|$(value cases "$last")|$(value failed "$last")|$(value skipped "$last")|$(value functions "$found")|$(
        value loops "$found")|$(value annotated "$found")|$(value findings "$found")|$((SECONDS - begin))|$verdict")
    [ "$verdict" = ok ] || status=1
}

hls/check/selftest.sh || status=1
hls/vitis/check.sh || status=1
hls/bambu/selftest.sh || status=1
rows=('top|cases|failed|skipped|functions|loops|annotated|findings|s|verdict')
for name in $(all_tops); do
    examine "$name"
done
printf '%s\n' "${rows[@]}" | awk -F'|' '{ printf "%-9s %6s %7s %8s %10s %6s %10s %9s %4s  %s\n", $1, $2, $3, $4, $5, $6, $7, $8, $9, $10 }'
# skipped, which says so itself, is no failure
hls/rtl/simulate.sh 256 || [ $? -eq 77 ] || status=1
hls/system/bank_test.sh || [ $? -eq 77 ] || status=1
few=0
hls/system/vectors.sh --few >"$work/system.log" 2>&1 || few=$?
grep -v -e '^ok ' -e ' clocks$' "$work/system.log"
[ $few -eq 0 ] || [ $few -eq 77 ] || status=1
hls/system/simulate.sh "$simulations/hls_system_render" || [ $? -eq 77 ] || status=1
command -v vitis-run >/dev/null || echo 'Vitis: SKIPPED: no vitis-run'
command -v bambu >/dev/null || echo 'Bambu: SKIPPED: no bambu'
exit $status
