#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Lines and branches of the library and of the host program that unit tests, golden vectors and program tests reach, counted by
# gcc at -O0 and summed by gcovr, against thresholds. Lines: build/coverage/library.txt, program.txt. What is left out is marked in the
# source (GCOVR_EXCL_*) with its reason.
# usage: coverage.sh [--again]    --again only sums up what the last run counted
set -euo pipefail
cd "$(dirname "$0")/../.."
build=build/coverage
if [ "${1:-}" != --again ]; then
    cmake --preset coverage >/dev/null
    find $build -name '*.gcda' -delete
    cmake --build --preset coverage --target quick drogue-cli conformance cli_decimal cli_png_io cli_json_check \
        cli_make_images cli_canny_check >/dev/null
    ctest --preset coverage -R '^(unit_|cli_|conformance_vectors)' >$build/tests.log || {
        tail -n 20 $build/tests.log
        exit 1
    }
fi
# Left out, too: the rows' and cells' form for cores without SIMD, which its own unit test and the images in QEMU run.
# DROGUE_PACKED orders its two indices: where a caller's order is fixed one arm of it is dead.
summed=(gcovr -r . --object-directory $build --exclude-directories '.*_lanes.dir.*' --exclude-branches-by-pattern '.*DROGUE_PACKED\(.*')
status=0
# part NAME LINES BRANCHES FILTER...: in percent
part() {
    local name=$1 lines=$2 branches=$3
    shift 3
    "${summed[@]}" "$@" --txt $build/$name.txt
    "${summed[@]}" "$@" --branches --txt $build/$name-branches.txt \
        --print-summary --fail-under-line "$lines" --fail-under-branch "$branches" | sed "s/^/coverage: $name: /" || status=1
}
part library 100 99 --filter src/ --filter include/ --exclude src/cli/
part program 95 0 --filter src/cli/
exit $status
