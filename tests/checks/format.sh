#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# All C and C++ files, tracked ones and new ones, against .clang-format; and no line of the library's is longer than 120
# columns, which it leaves comments. Other versions of clang-format lay out some lines differently, so version 14 it is.
# usage: format.sh [--apply]
set -euo pipefail
cd "$(dirname "$0")/../.."
patterns=('*.c' '*.h' '*.cpp' '*.hpp')

if [ -e .git ] && git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
    list() { git ls-files -z --cached --others --exclude-standard -- "${patterns[@]}"; }
else
    list() { find src include hls tests \( -name '*.[ch]' -o -name '*.[ch]pp' \) -print0; }
fi
files=()
while IFS= read -r -d '' file; do
    [ -e "$file" ] && files+=("$file")
done < <(list)
[ ${#files[@]} -gt 0 ] || { echo 'format: no files found' >&2; exit 1; }

if [ "${1:-}" = --apply ]; then
    clang-format-14 -i "${files[@]}"
    exit
fi
status=0
for file in "${files[@]}"; do
    if ! clang-format-14 --dry-run -Werror "$file" 2>/dev/null; then
        echo "format: $file differs from what ./run format gives"
        status=1
    fi
done
if grep -rnE --include='*.[ch]' '^[^"]{121,}$' include src; then
    echo 'format: these lines are longer than 120 columns'
    status=1
fi
if [ $status -eq 0 ]; then
    echo "format: ${#files[@]} files as they should be"
fi
exit $status
