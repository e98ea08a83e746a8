#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The check must bite: each file of hls/check/bad has a top that breaks one rule, in the lines that say so by a comment
# 'expect: RULE'; just these must be found, and nothing in the files named none_*.
set -euo pipefail
cd "$(dirname "$0")/bad"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export DROGUE_HLS_CHECK_DIR=$work
failures=0
rules='recursion indirect-call dynamic-memory unbounded-loop floating-point external pragma port layout'

# verdict NAME OK
verdict() {
    if [ "$2" = 1 ]; then
        echo "ok      $1"
    else
        echo "FAILED  $1"
        failures=$((failures + 1))
    fi
}

seen=""
for file in *.c; do
    grep -nEo 'expect: [a-z-]+' "$file" | sed -E "s|^([0-9]+):expect: (.*)|$file:\1: \2|" >"$work/expected" || true
    status=0
    ../check.sh --function top "$file" >"$work/out" || status=$?
    grep -E '^[^ ]+:[0-9]+: ' "$work/out" | sed -E 's|^[^ ]*/([^ ]+:[0-9]+: [a-z-]+):.*|\1|' >"$work/found" || true
    ok=0
    if cmp -s "$work/expected" "$work/found"; then
        case $file in
        none_*) [ $status -eq 0 ] && [ ! -s "$work/expected" ] && ok=1 ;;
        *) [ $status -eq 1 ] && [ "$(cut -d' ' -f2 "$work/expected" | sort -u | wc -l)" -eq 1 ] && ok=1 ;;
        esac
    fi
    verdict "$file: $(cut -d' ' -f2 "$work/expected" | sort -u | xargs)" $ok
    [ $ok = 1 ] || cat "$work/out"
    seen+=" $(cut -d' ' -f2 "$work/expected" | sort -u | xargs)"
done
for rule in $rules; do
    [[ " $seen " == *" $rule "* ]] || verdict "no bad top for $rule" 0
done
# The list of a top's files: one too many, one too few.
expect_files() {
    echo "eigen | drogue_hls_eigen | pose/eigen_top.c | - | - | - | $1" >"$work/tops.txt"
    DROGUE_HLS_TOPS=$work/tops.txt ../check.sh eigen >"$work/out" && verdict "files of src/: $1" 0
    if grep -vE ': functions=|^hls check: FAILED$' "$work/out" | grep -qvE "$2" || ! grep -qE "$2" "$work/out"; then
        verdict "files of src/: $1" 0
        cat "$work/out"
    else
        verdict "files of src/: $1" 1
    fi
}
expect_files 'arithmetic/eigen arithmetic/fixed inner/shade arithmetic/real' '^hls/tops.txt:0: sources: eigen: src/inner/shade.c is listed'
expect_files 'arithmetic/eigen arithmetic/real' '^[a-z/]+\.c:[0-9]+: external: .* has no source here$'
ok=1
[ ! -e ../__pycache__ ] || ok=0
verdict 'nothing is left in the tree' $ok

if [ $failures -eq 0 ]; then
    echo 'hls check: self-test passed'
fi
[ $failures -eq 0 ]
