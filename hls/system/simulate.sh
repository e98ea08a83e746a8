#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The small system under Verilator: twelve rendered frames of 128 x 128, three of 256 x 256, track carried on, every word
# that of drogue_track_frame(). A line a frame, then one that sums up.
# usage: simulate.sh RENDER [SIDE FRAMES]...     RENDER: hls_system_render of the build; 77 where a tool is absent
# The soft core is the Verilog of the Python package pythondata-cpu-vexriscv: DROGUE_VEXRISCV, or what python3 finds.
set -euo pipefail
render=$(realpath "${1:?usage: simulate.sh RENDER [SIDE FRAMES]...}")
cd "$(dirname "$0")/../.."
. src/sources.sh
root=$PWD
shift
[ $# -gt 0 ] || set -- 128 12 256 3
for tool in verilator make g++ riscv64-unknown-elf-gcc; do
    command -v $tool >/dev/null || { echo "system: SKIPPED: no $tool" && exit 77; }
done
core=${DROGUE_VEXRISCV:-$(python3 -c 'import pythondata_cpu_vexriscv as v
print(v.data_location + "/VexRiscv.v")' 2>/dev/null || true)}
[ -e "$core" ] || { echo 'system: SKIPPED: no pythondata-cpu-vexriscv' && exit 77; }
hls/rtl/rtl.sh 256

# firmware SIDE FOLDER
firmware() {
    local flags=(-march=rv32im -mabi=ilp32 -std=c99 -Os -ffunction-sections -fdata-sections "-DSIDE=$1" -Iinclude -Ihls)
    mkdir -p "$2/objects"
    (cd "$2/objects" && core_files "$root" '*.c' | xargs riscv64-unknown-elf-gcc --specs=picolibc.specs "${flags[@]/#-I/-I$root/}" -c)
    rm -f "$2/libdrogue.a"
    riscv64-unknown-elf-ar rcs "$2/libdrogue.a" "$2"/objects/*.o
    riscv64-unknown-elf-gcc --specs=picolibc.specs "${flags[@]}" -nostartfiles -Wl,--gc-sections,--no-warn-rwx-segments \
        -T hls/system/system.ld hls/system/start.S hls/system/firmware.c hls/driver/{block,bank,block_frontend}.c \
        "$2/libdrogue.a" -o "$2/firmware.elf"
    riscv64-unknown-elf-objcopy -O verilog --verilog-data-width=4 "$2/firmware.elf" "$2/firmware.hex"
    riscv64-unknown-elf-size "$2/firmware.elf" | awk 'NR == 2 { print "system: firmware " $1 " bytes of code and constants, " $2 + $3 " of data" }'
}

# build SIDE FOLDER
build() {
    verilator --cc --exe --build -O3 --x-assign fast --x-initial fast -Wno-fatal -Wno-lint -Mdir "$2/verilated" \
        --top-module drogue_system "-GFIRMWARE=\"firmware.hex\"" hls/system/system.v hls/system/bank.v \
        build/hls/rtl/256/drogue_frontend.v "$core" "$root/hls/system/bench.cpp" "$root/build/hls/system/libdrogue.a" \
        -CFLAGS "-O2 -DSIDE=$1 -I$root/include -I$root/hls" -o bench >"$2/verilator.log" 2>&1 ||
        { tail -n 20 "$2/verilator.log" && exit 1; }
}

mkdir -p build/hls/system/objects
(cd build/hls/system/objects && core_files "$root" '*.c' | xargs gcc -std=c99 -O2 "-I$root/include" -c)
rm -f build/hls/system/libdrogue.a
ar rcs build/hls/system/libdrogue.a build/hls/system/objects/*.o
while [ $# -ge 2 ]; do
    work=build/hls/system/$1
    mkdir -p "$work"
    firmware "$1" "$work"
    build "$1" "$work"
    "$render" "$1" "$2" >"$work/frames.raw"
    (cd "$work" && verilated/bench frames.raw)
    shift 2
done
