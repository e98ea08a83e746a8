#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The core's rules that compilers do not know: no floating point, no 128-bit built-in, no heap, no function
# pointer, no recursion, no variable-length array, no system header but the four below. Needs gcc 10 or later.
# usage: core_rules.sh ROOT     checks the library's files below ROOT/src, and ROOT/include/drogue/*.h
set -euo pipefail
. "$(dirname "$0")/../../src/sources.sh"
shopt -s nullglob
root=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0

complain() {
    sed "s|^|core rules: $1: |"
    status=1
}

# forbid WHAT PATTERN: complain about each match in $text of $name
forbid() {
    local found
    if found=$(grep -oE "$2" <<<"$text"); then
        complain "$1: $name" <<<"$found"
    fi
}

for file in "$root"/include/drogue/*.h $(core_files "$root" '*.[ch]'); do
    name=${file#"$root/"}
    # Without comments; directives stay.
    text=$(gcc -fpreprocessed -dD -E -P "$file")
    if found=$(grep -E '^ *# *include *<' <<<"$text" | grep -vE '<(limits|stddef|stdint|string)\.h>'); then
        complain "system header: $name" <<<"$found"
    fi
    # Without strings, on one line: a construct may span lines.
    text=$(sed -E 's/"(\\.|[^"\\])*"/""/g' <<<"$text" | tr '\n' ' ')
    forbid 'floating point' '\b(float|double|_Complex|_Float[0-9]+x?|__float128|__fp16)\b'
    forbid 'floating literal' '(^|[^A-Za-z0-9_.])([0-9]+\.[0-9]*|\.[0-9]+|[0-9]+[eE][+-]?[0-9]+)'
    forbid '128-bit built-in' '\b(__u?int128(_t)?|_BitInt)\b'
    forbid 'heap' '\b(malloc|calloc|realloc|free|alloca|__builtin_alloca)\b'
    forbid 'function pointer' '\( *\* *(const *)?[A-Za-z_0-9]* *(\[[^]]*\] *)*\) *\('
done

: >"$work/calls"
for source in $(core_files "$root" '*.c'); do
    object=$work/$(basename "$source" .c).o
    # Not optimised, so that each call is still a call.
    if ! gcc -std=c99 -I "$root/include" -O0 -fcallgraph-info -Werror=vla -c "$source" -o "$object"; then
        complain 'does not compile' <<<"${source#"$root/"}"
        continue
    fi
    sed -nE 's/^edge: \{ sourcename: "([^"]*)" targetname: "([^"]*)".*/\1 \2/p' "${object%.o}.ci" |
        sed "s|$root/||g" >>"$work/calls"
done
if found=$(grep ' __indirect_call$' "$work/calls"); then
    complain 'call through a pointer' <<<"$found"
fi
if found=$(grep -E '^([^ ]+) \1$' "$work/calls"); then # tsort ignores a name paired with itself
    complain 'recursion' <<<"$found"
fi
if ! found=$(tsort <"$work/calls" 2>&1 >/dev/null); then
    complain 'recursion' <<<"$found"
fi
exit $status
