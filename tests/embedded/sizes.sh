#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Flash, RAM and worst-case stack of the library on a Cortex-M7 with -Os, the stack on the other cores and with -O2, too,
# against the budgets; and an image that only fits ellipses, which must run and be small.
# usage: sizes.sh            print and check; docs/ must hold the tables as they are now
#        sizes.sh --update   write the tables into docs/sizes.md and docs/architecture.md
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/matrix/machine.sh
export DROGUE_EMBEDDED_DIR=build/sizes
export DROGUE_EMBEDDED_OPTIMISATION='-Os -fstack-usage'
mkdir -p build
if ! tests/embedded/embedded.sh cortex-m7 >build/sizes.log; then
    cat build/sizes.log
    exit 1
fi
machine mps2-an500
if ! "${run[@]}" build/sizes/cortex-m7/images/only_ellipse </dev/null; then
    echo 'sizes: the image that only fits ellipses fails'
    exit 1
fi
# Libraries alone, for the stack: cores and options of sizes.py.
stack=build/sizes/stack
for core in cortex-m0plus cortex-m4 cortex-m7 rv32imac; do
    for option in Os O2; do
        if ! { cmake -S . -B "$stack/$core-$option/library" -G Ninja --toolchain "$PWD/src/cmake/$core.cmake" \
            -DCMAKE_BUILD_TYPE=Release "-DCMAKE_C_FLAGS_RELEASE=-$option -fstack-usage" -DDROGUE_BUILD_CLI=OFF \
            -DDROGUE_BUILD_TESTS=OFF && cmake --build "$stack/$core-$option/library"; } >build/sizes/stack.log 2>&1; then
            tail -n 30 build/sizes/stack.log
            exit 1
        fi
    done
done
python3 tests/embedded/sizes.py build/sizes/cortex-m7 "$stack" "$@"
