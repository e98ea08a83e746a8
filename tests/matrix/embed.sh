#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# usage: embed.sh FOLDER: the golden vectors as C files in FOLDER, by the host tool conformance_embed, which it builds there.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$1"
rm -f "$1"/*.c
read -ra libraries <<<"$(pkg-config --cflags --libs libpng libcjson)"
gcc -O1 -std=c99 -D_POSIX_C_SOURCE=200809L -I "$root/include" -I "$root/tests/conformance" \
    "$root"/tests/conformance/{embed,vectors,vectors_files,stages,stages_*,sha256}.c "$root"/src/*.c "${libraries[@]}" \
    -o "$1/conformance_embed"
"$1/conformance_embed" "$root/vectors" "$1" 4
