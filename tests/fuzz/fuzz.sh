#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fuzzes the library and the program's readers by libFuzzer under the address and undefined-behaviour sanitizers, from the
# corpus in this folder. Exit status 77 without clang's runtime.
# usage: fuzz.sh [SECONDS [TARGET]...]    SECONDS in all, 120 unless given; what is found lies in build/fuzz
set -euo pipefail
cd "$(dirname "$0")/../.."
. src/sources.sh
seconds=${1:-120}
targets=("${@:2}")
[ ${#targets[@]} -gt 0 ] || targets=(measure track acquire stages program)
mkdir -p build/fuzz
cd build/fuzz
root=../..
clang=${CLANG:-clang}
if ! printf '#include <stddef.h>\nint LLVMFuzzerTestOneInput(const char *d, size_t n) { (void)d; return (int)(n - n); }\n' |
    "$clang" -x c -fsanitize=fuzzer,address - -o probe 2>/dev/null; then
    echo "fuzz: skipped: $clang without libFuzzer (Debian: libclang-rt-dev)"
    exit 77
fi
mapfile -t core < <(core_files $root '*.c')
status=0
for target in "${targets[@]}"; do
    sources=("$root/tests/fuzz/fuzz.c" "$root/tests/fuzz/$target.c")
    libraries=(-lm)
    case $target in
    stages) for f in "$root"/tests/conformance/stages*.c; do sources+=("$f"); done ;;
    program)
        for f in "$root"/src/cli/*.c; do
            [ "${f##*/}" = main.c ] || sources+=("$f")
        done
        read -ra png <<<"$(pkg-config --cflags --libs libpng)"
        libraries+=("${png[@]}" -lz)
        ;;
    esac
    "$clang" -std=gnu99 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -I $root/include \
        -I $root/tests/conformance -I $root/src/cli -I $root/tests/fuzz "${core[@]}" "${sources[@]}" "${libraries[@]}" \
        -o "$target"
    mkdir -p "found/$target" "corpus/$target"
    got=0
    "./$target" -max_total_time=$((seconds / ${#targets[@]})) -max_len=1024 -timeout=20 -print_final_stats=1 \
        -artifact_prefix="found/$target/" "corpus/$target" "$root/tests/fuzz/corpus/$target" >"$target.log" 2>&1 || got=$?
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$target.log")
    echo "fuzz: target=$target executions=${runs:-0} status=$got"
    if [ $got -ne 0 ]; then
        grep -aE 'fuzz: line|ERROR|runtime error|SUMMARY' "$target.log" | head -n 5 || true
        status=1
    fi
done
exit $status
