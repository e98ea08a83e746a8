#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The stand-alone sample, built from a copy outside the tree against the installed library, soft and hard float, as
# docs/embedded.md says, and run in QEMU: each must print the pose of the drogue that it draws.
# usage: standalone.sh [TARGET...]
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/matrix/machine.sh
root=$PWD
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
targets=("$@")
[ $# -gt 0 ] || targets=(cortex-m4 cortex-m4-hard cortex-m7 cortex-m7-hard)
declare -A boards=([cortex-m3]=mps2-an385 [cortex-m4]=mps2-an386 [cortex-m7]=mps2-an500)
status=0

# convention TARGET FILE: 'hard' when functions take floating-point arguments in registers
convention() {
    if arm-none-eabi-readelf -A "$1" | grep -q 'Tag_ABI_VFP_args: VFP registers'; then echo hard; else echo soft; fi
}

for target in "${targets[@]}"; do
    folder=$work/$target
    toolchain=$root/src/cmake/$target.cmake
    cp -R tests/embedded/examples/standalone "$folder"
    {
        cmake -S . -B "$folder/library" --toolchain "$toolchain" -DCMAKE_BUILD_TYPE=MinSizeRel &&
            cmake --build "$folder/library" &&
            cmake --install "$folder/library" --prefix "$folder/installed" &&
            cmake -S "$folder" -B "$folder/build" --toolchain "$toolchain" -DCMAKE_BUILD_TYPE=MinSizeRel \
                -Ddrogue_ROOT="$folder/installed" -DCMAKE_COMPILE_WARNING_AS_ERROR=ON &&
            cmake --build "$folder/build"
    } >"$folder/log" 2>&1 || {
        echo "standalone: $target is not built:"
        tail -n 20 "$folder/log"
        status=1
        continue
    }
    machine "${boards[${target%-hard}]}"
    echo "== $target"
    timeout 60 "${run[0]}" -icount shift=0 "${run[@]:1}" "$folder/build/standalone" </dev/null >"$folder/out" 2>&1 || status=1
    sed 's/^/    /' "$folder/out"
    wanted=soft
    [ "$target" = "${target%-hard}" ] || wanted=hard
    if ! grep -Eq '^position 1[0-3] -[4-7] 3(49|50)[0-9] mm, axis -?[0-9]{1,2} -?[0-9]{1,2} (999|1000) / 1000$' "$folder/out" ||
        ! grep -Eq '^[1-9][0-9]* thousand clocks, [1-9][0-9]* microseconds at 480 MHz$' "$folder/out"; then
        echo "standalone: $target does not print the pose of what it drew and the time"
        status=1
    fi
    if [ "$(convention "$folder/build/standalone")" != $wanted ]; then
        echo "standalone: $target is not $wanted float"
        status=1
    fi
done
exit $status
