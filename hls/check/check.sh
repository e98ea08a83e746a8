#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Can the tops be synthesised? Without a synthesis tool: clang makes LLVM IR of a top and all that it calls, and
# findings.py says what in it no HLS compiler can turn into hardware.
# usage: check.sh [NAME...]                      tops of hls/tops.txt, all unless named
#        check.sh --function TOP SOURCE...       a function of these files
set -euo pipefail
invoked_in=$PWD
cd "$(dirname "$0")/../.."
. hls/tops.sh
work=${DROGUE_HLS_CHECK_DIR:-build/hls/check}

# Variables in registers, loops in normal form, nothing inlined or unrolled: each loop of the source is there once.
# fix-irreducible makes loops of what gotos with two entries make.
passes='function(sroa,early-cse,simplifycfg,instcombine,fix-irreducible,loop-simplify,lcssa,
loop-mssa(loop-rotate,licm),instcombine,loop-simplify)'

# examine NAME FUNCTION "CORE SOURCES" SOURCE...
examine() {
    local name=$1 function=$2 core=$3 source dir=$work/$1 bitcode=()
    shift 3
    mkdir -p "$dir"
    for source in "$@" $core; do
        bitcode+=("$dir/$(tr / - <<<"${source#/}").bc")
        # Not optimised: what recursion, a pointer to a function or floating point would be folded into is no excuse.
        clang -std=c99 -O1 -Xclang -disable-llvm-passes -fno-discard-value-names -g -emit-llvm -w -Iinclude -Ihls \
            -c "$source" -o "${bitcode[-1]}" || return 2
    done
    llvm-link "${bitcode[@]}" -o "$dir/all.bc" &&
        opt -passes='internalize,globaldce' -internalize-public-api-list="$function" -S "$dir/all.bc" \
            -o "$dir/linked.ll" &&
        opt -passes="${passes//$'\n'/}" -S "$dir/linked.ll" -o "$dir/loops.ll" &&
        opt -passes='print<scalar-evolution>' -disable-output "$dir/loops.ll" 2>"$dir/trips" || return 2
    # shellcheck disable=SC2086 # a list of files
    python3 hls/check/findings.py "$dir/linked.ll" "$dir/loops.ll" "$dir/trips" "$name" $core
}

if [ "${1:-}" = --function ]; then
    function=$2
    shift 2
    files=()
    for file in "$@"; do
        files+=("$(cd "$invoked_in" && realpath "$file")")
    done
    examine "$(basename "${files[0]}" .c)" "$function" "" "${files[@]}"
    exit
fi
status=0
for name in $(tops "$@"); do
    top "$name"
    examine "$name" "$function" "$core" "$source" || status=1
done
if [ $status -ne 0 ]; then
    echo 'hls check: FAILED'
fi
exit $status
