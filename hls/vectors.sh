#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Writes the vectors that a top is co-simulated with as C files, build/hls/NAME/cases_*.c; the scripts for Vitis and
# Bambu name them.
# usage: vectors.sh NAME [STAGE | STAGE/CASE]...     others than those of hls/tops.txt
set -euo pipefail
cd "$(dirname "$0")/.."
. hls/tops.sh
. hls/usage.sh
[[ ${1:--} != -* ]] || usage
name=$(tops "$1")
top "$name"
if [ $# -eq 1 ]; then
    read -ra chosen <<<"$cosimulated"
else
    chosen=("${@:2}")
fi
if [ -n "${DROGUE_CONFORMANCE_EMBED:-}" ]; then # built already
    mkdir -p "build/hls/$1"
    "$DROGUE_CONFORMANCE_EMBED" vectors "build/hls/$1" 1 "${chosen[@]}"
else
    tests/matrix/embed.sh "build/hls/$1" 1 "${chosen[@]}"
fi
