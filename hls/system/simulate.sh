#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The small system under Verilator: twelve rendered frames of 128 x 128, three of 256 x 256, track carried on, every word
# that of drogue_track_frame(). A line a frame, then one that sums up.
# usage: simulate.sh RENDER [SIDE FRAMES]...     RENDER: hls_system_render of the build; 77 where a tool is absent
# DROGUE_PROFILE=1: then the functions that take the soft core's clocks.
set -euo pipefail
cd "$(dirname "$0")/../.."
. hls/system/build.sh
. hls/usage.sh
[[ ${1:--} != -* && $(($# % 2)) -eq 1 ]] || usage
render=$(cd "$OLDPWD" && realpath "$1")
shift
[ $# -gt 0 ] || set -- 128 12 256 3
need system verilator make gcc g++ riscv64-unknown-elf-gcc
model
while [ $# -ge 2 ]; do
    work=$made/$1
    mkdir -p "$work"
    firmware "$work" hls/system/firmware.c "-DSIDE=$1"
    bench "$work/bench" hls/system/bench.cpp "-DSIDE=$1"
    "$render" "$1" "$2" >"$work/frames.raw"
    if [ -n "${DROGUE_PROFILE:-}" ]; then
        (cd "$work" && ./bench frames.raw clocks)
        { riscv64-unknown-elf-nm "$work/firmware.elf" | awk '$2 ~ /[tTwW]/ { print $1, "!", $3 }' && cat "$work/clocks"; } | LC_ALL=C sort |
            awk '$2 == "!" { name = $3; next } { clocks[name] += $2; all += $2 }
                END { for (name in clocks) printf "%5.1f %% %s\n", 100 * clocks[name] / all, name }' | sort -rn | head -n 25
    else
        (cd "$work" && ./bench frames.raw)
    fi
    shift 2
done
