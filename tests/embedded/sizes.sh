#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Flash, RAM and worst-case stack of the library on a Cortex-M7 with -Os, against the budgets; and an image that only
# fits ellipses, which must run and be small.
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
python3 tests/embedded/sizes.py build/sizes/cortex-m7 "$@"
