#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Every public header compiles alone and twice, as C99 and as C++11, without a warning; drogue.h brings all of them, as
# that of the two-file form does.
# usage: headers.sh ROOT CC CXX
set -euo pipefail
root=$1 cc=$2 cxx=$3
warnings='-pedantic -Wall -Wextra -Wconversion -Wsign-conversion -Wdouble-promotion -Wshadow -Wundef -Werror'
status=0
all=$("$cc" -std=c99 -I "$root/include" -M -x c - <<<'#include "drogue/drogue.h"')

for path in "$root"/include/drogue/*.h; do
    header=${path#"$root/include/"}
    program=$(printf '#include "%s"\n' "$header" "$header")
    # shellcheck disable=SC2086 # the warnings are words
    "$cc" -std=c99 $warnings -Wvla -Wstrict-prototypes -I "$root/include" -fsyntax-only -x c - <<<"$program" ||
        { echo "headers: $header does not compile as C99"; status=1; }
    # shellcheck disable=SC2086
    "$cxx" -std=c++11 $warnings -I "$root/include" -fsyntax-only -x c++ - <<<"$program" ||
        { echo "headers: $header does not compile as C++11"; status=1; }
    grep -qF "/$header" <<<"$all" || { echo "headers: drogue/drogue.h does not bring $header"; status=1; }
done
exit $status
