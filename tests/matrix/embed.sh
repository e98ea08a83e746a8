#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# usage: embed.sh FOLDER [FILES [STAGE | STAGE/CASE]...]: writes the golden vectors, or those of the stages and cases
# named, as so many C files into FOLDER, by the host tool conformance_embed, which it builds there.
set -euo pipefail
folder=$(realpath -m "$1")
cd "$(dirname "$0")/../.."
. src/sources.sh
mkdir -p "$folder"
rm -f "$folder"/cases_*.c
read -ra libraries <<<"$(pkg-config --cflags --libs libpng libcjson)"
gcc -O1 -std=c99 -D_POSIX_C_SOURCE=200809L -I include -I tests/conformance \
    tests/conformance/{embed,vectors,vectors_fields,vectors_files,stages,stages_*,sha256}.c $(core_files . '*.c') "${libraries[@]}" \
    -o "$folder/conformance_embed"
"$folder/conformance_embed" vectors "$folder" "${2:-4}" "${@:3}"
