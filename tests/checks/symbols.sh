#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The core as a linker sees it: it needs nothing but memcpy, memset and the compiler's integer helpers, exports
# nothing without the prefix, and holds no data that can change.
# usage: symbols.sh ROOT CC [CFLAGS...]     checks the library's sources below ROOT/src
set -euo pipefail
. "$(dirname "$0")/../../src/sources.sh"
root=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0

# Position-independent code would put constant pointers into .data.rel.ro, and distributions' hardening adds calls.
for source in $(core_files "$root" '*.c'); do
    "$@" -std=c99 -I "$root/include" -fno-pic -fno-stack-protector -U_FORTIFY_SOURCE -c "$source" \
        -o "$work/$(basename "$source" .c).o"
done

"$("$1" -print-prog-name=nm)" -P "$work"/*.o >"$work/nm"
"$("$1" -print-prog-name=size)" -A "$work"/*.o >"$work/size"

# Run-time ABI for Arm, 4.2 and 4.3 without the floating-point part; libgcc's integer routines (si, di).
integer_helpers='^(__aeabi_(lmul|u?ldivmod|llsl|llsr|lasr|u?idiv|u?idivmod|u?lcmp|mem(cpy|set|clr)[48]?)'
integer_helpers+='|__gnu_thumb1_case_(sqi|uqi|shi|uhi|si)|__(mul|u?div|u?mod|u?divmod|ashl|ashr|lshr|u?cmp|clz)[sd]i[234])$'

awk -v helpers="$integer_helpers" '
    NF < 2 { next } # the name of an object file
    $2 ~ /^[Uw]$/ { needed[$1] = 1; next }
    { defined[$1] = 1; count++ }
    $2 ~ /^[A-Zvu]$/ && $1 !~ /^drogue_/ { print "symbols: exported without prefix drogue_: " $1; bad = 1 }
    $2 ~ /^[BbDdCcGgSsVv]$/ { print "symbols: data that can change: " $1; bad = 1 }
    END {
        for (name in needed) {
            if (!(name in defined) && name !~ /^(memcpy|memset)$/ && name !~ helpers) {
                print "symbols: needs something foreign: " name
                bad = 1
            }
        }
        if (count == 0) { print "symbols: nothing defined"; bad = 1 }
        exit bad
    }' "$work/nm" || status=1

awk '
    $1 ~ /^\.(data|bss|tdata|tbss|init_array|ctors)/ && $2 > 0 {
        print "symbols: section that can change or runs at start: " $1 ", " $2 " bytes"
        bad = 1
    }
    END { exit bad }' "$work/size" || status=1
exit $status
