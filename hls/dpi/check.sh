#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The DPI-C model under Verilator: frames of the golden vectors, every word; and a false vector is noticed.
# usage: check.sh      works in build/dpi; needs verilator, make, g++, libpng, python3
set -euo pipefail
cd "$(dirname "$0")/../.."
. src/sources.sh
. hls/usage.sh
[ $# -eq 0 ] || usage
root=$PWD
work=$root/build/dpi
mkdir -p "$work/objects"
warnings=(-pedantic -Wall -Wextra -Wconversion -Wsign-conversion -Wvla -Wshadow -Wno-unknown-pragmas -Werror)

core_files "$root" '*.c' >"$work/sources"
echo "$root/hls/dpi/drogue_dpi.c" >>"$work/sources"
(cd "$work/objects" && xargs gcc -std=c99 -O2 "${warnings[@]}" -I "$root/include" -c <"$work/sources")
rm -f "$work/libdrogue_dpi.a"
ar rcs "$work/libdrogue_dpi.a" "$work"/objects/*.o
verilator --binary -Wall -Ihls/dpi --Mdir "$work/frame" hls/dpi/frame.sv --top-module frame \
    -LDFLAGS "$work/libdrogue_dpi.a" -o frame >"$work/log" 2>&1 || {
    tail -n 20 "$work/log"
    exit 1
}

gcc -std=c99 -O1 tests/cli/make_images.c -o "$work/make_images" $(pkg-config --cflags --libs libpng)

# run NAME DIR: one case, its expected words from that folder; the image as words for $readmemh, its size from the manifest
run() {
    local size
    size=$(python3 -c 'import json, sys
case = next(c for c in json.load(open("vectors/manifest.json"))["cases"] if c["id"] == "frame/" + sys.argv[1])
config = " +config" * (case["inputs"][-1]["name"] == "config")
print("+width=%(width)d +height=%(height)d" % case["inputs"][0] + config)' "$1")
    "$work/make_images" --raw "vectors/frame/$1.image.png" | od -A n -v -t x1 -w1 >"$work/image.hex"
    # shellcheck disable=SC2086 # two words or three
    "$work/frame/frame" "+dir=$2" "+case=$1" "+image=$work/image.hex" $size
}

count=0
for name in $(python3 -c 'import json
print(*(c["id"][6:] for c in json.load(open("vectors/manifest.json"))["cases"] if c["stage"] == "frame"))'); do
    run "$name" vectors >"$work/log" || { cat "$work/log" && exit 1; }
    count=$((count + 1))
done
mkdir -p "$work/false/frame"
cp "$root"/vectors/frame/demo-region.*.hex "$work/false/frame"
sed -i '22s/.*/0000beef/' "$work/false/frame/demo-region.frame.out.hex"
if run demo-region "$work/false" >"$work/false.log" 2>&1; then
    echo 'dpi: a false vector is not noticed'
    exit 1
fi
grep -q 'pose: found .*, expected 0000beef (word 21)' "$work/false.log"
[ $count -gt 0 ]
echo "dpi: passed, $count frames"
