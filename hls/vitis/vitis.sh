#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A top through Vitis HLS: C simulation, synthesis, co-simulation, IP; in build/hls/vitis/NAME.
# usage: vitis.sh NAME [--csim] [--synthesis] [--cosim] [--package]      all four steps when none is named
# Part and clock: DROGUE_HLS_PART, DROGUE_HLS_CLOCK_NS. Exit status 77 where there is no vitis-run.
set -euo pipefail
cd "$(dirname "$0")/../.."
. hls/tops.sh
. hls/usage.sh
[[ ${1:--} != -* ]] || usage
name=$(tops "$1")
for step in "${@:2}"; do
    [[ $step =~ ^--(csim|synthesis|cosim|package)$ ]] || usage
done
if ! command -v vitis-run >/dev/null || ! command -v v++ >/dev/null; then
    echo 'SKIPPED: no vitis-run'
    exit 77
fi
steps=("${@:2}")
if [ ${#steps[@]} -eq 0 ]; then
    steps=(--csim --synthesis --cosim --package)
fi
hls/vectors.sh "$name"
hls/vitis/generate.sh "$name"
cd "build/hls/vitis/$name"
for step in "${steps[@]}"; do
    case $step in
    --synthesis) v++ -c --mode hls --config hls_config.cfg --work_dir "$name" ;;
    *) vitis-run --mode hls "$step" --config hls_config.cfg --work_dir "$name" ;;
    esac
done
