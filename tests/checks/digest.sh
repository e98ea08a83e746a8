#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The same pictures give the same JSON, byte for byte, from gcc -O0, gcc -O3, clang -O2 and a 32-bit build. The
# host program is built four times with pgm_io.c in place of libpng, which need not be there for 32 bits.
# usage: digest.sh ROOT
set -euo pipefail
root=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

warnings=(-pedantic -Wall -Wextra -Wconversion -Wsign-conversion -Wvla -Wdouble-promotion -Wshadow -Werror)
program=()
for source in "$root"/src/*.c "$root"/src/cli/*.c; do
    [ "${source##*/}" = png_io.c ] || program+=("$source")
done
# build NAME CC CFLAGS...
build() {
    local name=$1
    shift
    "$@" -std=c99 "${warnings[@]}" -D_POSIX_C_SOURCE=200809L -I "$root/include" -I "$root/src/cli" "${program[@]}" \
        "$root/tests/checks/pgm_io.c" -o "$work/$name"
}
build gcc-O0 gcc -O0
build gcc-O3 gcc -O3
build clang-O2 clang -O2
build gcc-m32 gcc -m32 -O2
readelf -h "$work/gcc-m32" | grep -q ELF32
# shellcheck disable=SC2046 # flags are words
gcc -std=c99 "${warnings[@]}" -I "$root/src/cli" $(pkg-config --cflags libpng) "$root"/tests/checks/png_to_pgm.c \
    "$root"/src/cli/png_io.c "$root"/src/cli/cli.c -o "$work/png_to_pgm" $(pkg-config --libs libpng)

# numbers FILE KEY: the numbers in the object of that name in a sidecar, with commas
numbers() {
    sed -nE "s/^ *\"$2\": \{(.*)\},?$/\1/p" "$1" | grep -oE -- '-?[0-9]+(\.[0-9]+)?' | paste -sd,
}

# settings FILE: options from a sidecar, one a line
settings() {
    printf '%s\n' --camera "$(numbers "$1" camera)" --drogue "$(numbers "$1" drogue)" --roi "$(numbers "$1" region)"
}

# run_all NAME: every frame measured, in its region and as a whole; a track with a frame that shows no drogue
run_all() {
    local frame options
    for frame in "${frames[@]}"; do
        mapfile -t options < <(settings "$root/vectors/frame/$frame.json")
        "../$1" measure --json "${options[@]}" "$frame.pgm" || echo "exit $?"
        "../$1" measure --json "${options[@]:0:4}" "$frame.pgm" || echo "exit $?"
    done
    mapfile -t options < <(settings "$root/vectors/frame/demo.json")
    "../$1" track --json --fps 25 "${options[@]}" demo.pgm demo.pgm black.pgm demo.pgm || echo "exit $?"
}

mkdir "$work/frames"
cd "$work/frames"
frames=()
for sidecar in "$root"/vectors/frame/*.json; do
    frame=$(basename "$sidecar" .json)
    frames+=("$frame")
    ../png_to_pgm "$root/vectors/frame/$frame.png" >"$frame.pgm"
done
{ printf 'P5\n640 480\n255\n' && head -c $((640 * 480)) /dev/zero; } >black.pgm

status=0
for name in gcc-O0 gcc-O3 clang-O2 gcc-m32; do
    run_all $name >"../$name.json"
    if ! cmp "../gcc-O0.json" "../$name.json"; then
        diff "../gcc-O0.json" "../$name.json" | head -n 6
        status=1
    fi
    echo "digest: $(sha256sum <"../$name.json" | cut -c 1-16) $name"
done

# What was compared must be measurements: a pose from every frame's region, and a track that coasts and recovers.
measured=$(grep -c '"status":"ok"' ../gcc-O0.json || true)
if [ "$measured" -lt $((${#frames[@]} + 3)) ] || ! grep -q '"state":"coasting"' ../gcc-O0.json; then
    echo "digest: only $measured measurements in:"
    cat ../gcc-O0.json
    status=1
fi
exit $status
