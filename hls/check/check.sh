#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Can the tops be synthesised? Without a synthesis tool: clang makes LLVM IR of a top and all that it calls, and
# findings.py says what in it no HLS compiler can turn into hardware.
# usage: check.sh [NAME...]                      tops of hls/tops.txt, all unless named
#        check.sh --needed NAME                  files of src/ that a top needs, without .c
#        check.sh --function TOP SOURCE...       a function of these files
set -euo pipefail
invoked_in=$PWD
cd "$(dirname "$0")/../.."
. hls/tops.sh
. hls/usage.sh
work=${DROGUE_HLS_CHECK_DIR:-build/hls/check}
export PYTHONDONTWRITEBYTECODE=1 # findings.py imports ir.py: nothing is left beside them

# Variables in registers, loops in normal form, nothing inlined or unrolled: each loop of the source is there once.
# fix-irreducible makes loops of what gotos with two entries make.
passes='function(sroa,early-cse,simplifycfg,instcombine,fix-irreducible,loop-simplify,lcssa,
loop-mssa(loop-rotate,licm),instcombine,loop-simplify)'

# make_ir DIR FUNCTION SOURCE...: linked.ll with the function and all that it calls
make_ir() {
    local dir=$1 function=$2 source bitcode=()
    shift 2
    mkdir -p "$dir"
    for source in "$@"; do
        bitcode+=("$dir/$(tr / - <<<"${source#/}").bc")
        # Not optimised: what recursion, a pointer to a function or floating point would be folded into is no excuse.
        clang -std=c99 -O1 -Xclang -disable-llvm-passes -fno-discard-value-names -g -emit-llvm -w -Iinclude -Ihls \
            -c "$source" -o "${bitcode[-1]}" || return 2
    done
    llvm-link "${bitcode[@]}" -o "$dir/all.bc" &&
        opt -passes='internalize,globaldce' -internalize-public-api-list="$function" -S "$dir/all.bc" -o "$dir/linked.ll"
}

# pragmas SOURCE...: those that Bambu refuses; exit status 1 where there are any
pragmas() {
    local source found=0
    for source in "$@"; do
        clang -std=c99 -E -D__BAMBU__ -w -Iinclude -Ihls "$source" | awk -f hls/check/pragmas.awk | grep . && found=1
    done
    return $found
}

# examine NAME FUNCTION "CORE SOURCES" SOURCE...
examine() {
    local name=$1 function=$2 core=$3 dir=$work/$1 status=0
    shift 3
    pragmas "$@" || status=1
    # shellcheck disable=SC2086 # a list of files
    make_ir "$dir" "$function" "$@" $core &&
        opt -passes="${passes//$'\n'/}" -S "$dir/linked.ll" -o "$dir/loops.ll" &&
        opt -passes='print<scalar-evolution>' -disable-output "$dir/loops.ll" 2>"$dir/trips" || return 2
    # shellcheck disable=SC2086
    python3 hls/check/findings.py "$dir/linked.ll" "$dir/loops.ll" "$dir/trips" "$name" $core || status=1
    return $status
}

case ${1:-} in
--function)
    [ $# -ge 3 ] || usage
    function=$2
    shift 2
    files=()
    for file in "$@"; do
        files+=("$(cd "$invoked_in" && realpath --relative-to="$OLDPWD" "$file")")
    done
    examine "$(basename "${files[0]}" .c)" "$function" "" "${files[@]}"
    exit
    ;;
--needed)
    [ $# -eq 2 ] || usage
    chosen=$(tops "$2")
    top "$chosen"
    for file in $(core_files . '*.c'); do
        [[ " $replaced " == *" $file "* ]] || sources+=" $file"
    done
    # shellcheck disable=SC2086
    make_ir "$work/needed" "$function" $sources
    python3 hls/check/findings.py --needed "$work/needed/linked.ll"
    exit
    ;;
-*) usage ;;
esac
chosen=$(tops "$@")
status=0
for name in $chosen; do
    top "$name"
    # shellcheck disable=SC2086
    examine "$name" "$function" "$core" $sources || status=1
done
if [ $status -ne 0 ]; then
    echo 'hls check: FAILED'
fi
exit $status
