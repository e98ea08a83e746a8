#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fuzzes the library and the program's readers by libFuzzer under the address and undefined-behaviour sanitizers, from the
# corpus in this folder; then what was kept is run once under the memory sanitizer, but for the program and its files, whose
# libpng, libyaml and expat are foreign. Exit status 77 without clang's runtime.
# usage: fuzz.sh [SECONDS [TARGET]...]    SECONDS in all, 120 unless given; what is found lies in build/fuzz
set -euo pipefail
cd "$(dirname "$0")/../.."
. src/sources.sh
seconds=${1:-120}
targets=("${@:2}")
[ ${#targets[@]} -gt 0 ] || targets=(measure track acquire stages program files)
mkdir -p build/fuzz
cd build/fuzz
root=../..
clang=${CLANG:-clang}
if ! printf '#include <stddef.h>\nint LLVMFuzzerTestOneInput(const char *d, size_t n) { (void)d; return (int)(n - n); }\n' |
    "$clang" -x c -fsanitize=fuzzer,address - -o probe 2>/dev/null; then
    echo "fuzz: skipped: $clang without libFuzzer (Debian: libclang-rt-dev)"
    exit 77
fi
mapfile -t core < <(core_files "$PWD/$root" '*.c')
includes=(-I $root/include -I $root/tests/conformance -I $root/src/cli -I $root/tests/fuzz)

# library FOLDER SANITIZERS: the core's objects in a folder
library() {
    local object
    mkdir -p "$1"
    for source in "${core[@]}"; do
        object=$1/$(echo "${source#"$PWD/$root/src/"}" | tr / _).o
        "$clang" -std=gnu99 -g -O1 "-fsanitize=fuzzer-no-link,$2" -fno-sanitize-recover=all "${includes[@]}" -c "$source" \
            -o "$object"
    done
}

# target NAME FOLDER SANITIZERS: its executable in the folder
target() {
    local name=$1 folder=$2 sources=("$root/tests/fuzz/fuzz.c" "$root/tests/fuzz/$1.c") libraries=(-lm) readers
    case $name in
    stages) for f in "$root"/tests/conformance/stages*.c; do sources+=("$f"); done ;;
    program | files)
        for f in "$root"/src/cli/*.c; do
            [ "${f##*/}" = main.c ] || sources+=("$f")
        done
        read -ra readers <<<"$(pkg-config --cflags --libs libpng yaml-0.1 expat)"
        libraries+=(-DHAVE_YAML -DHAVE_EXPAT "${readers[@]}" -lz)
        ;;
    esac
    [ -n "${readers+there}" ] || sources+=("$root/src/cli/thresholds.c")
    "$clang" -std=gnu99 -g -O1 "-fsanitize=fuzzer,$3" -fno-sanitize-recover=all "${includes[@]}" "${sources[@]}" \
        "$folder"/*.o "${libraries[@]}" -o "$folder/$name"
}

# verdict NAME STATUS LOG: a line, and what was found
verdict() {
    local runs
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$3")
    echo "fuzz: target=$1 executions=${runs:-0} status=$2"
    if [ "$2" -ne 0 ]; then
        grep -aE 'fuzz: line|ERROR|WARNING: Mem|runtime error|SUMMARY' "$3" | head -n 5 || true
        status=1
    fi
}

status=0
library address address,undefined
library memory memory
for name in "${targets[@]}"; do
    target "$name" address address,undefined
    mkdir -p "found/$name" "corpus/$name"
    got=0
    "address/$name" -max_total_time=$((seconds / ${#targets[@]})) -max_len=1024 -timeout=20 -print_final_stats=1 \
        -artifact_prefix="found/$name/" "corpus/$name" "$root/tests/fuzz/corpus/$name" >"$name.log" 2>&1 || got=$?
    verdict "$name" $got "$name.log"
    if [ "$name" != program ] && [ "$name" != files ]; then
        target "$name" memory memory
        got=0
        "memory/$name" -runs=0 -max_len=1024 -timeout=60 -print_final_stats=1 -artifact_prefix="found/$name/" \
            "corpus/$name" "$root/tests/fuzz/corpus/$name" >"$name-memory.log" 2>&1 || got=$?
        verdict "$name-memory" $got "$name-memory.log"
    fi
done
exit $status
