#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The same pictures give the same JSON, byte for byte, from gcc -O0, gcc -O3, clang -O2, a 32-bit processor (Arm)
# and a big-endian one (s390x), the last two under qemu. The host program is built with no_png.c in place of libpng,
# which need not be there for foreign processors. One more build leaves its workspace as malloc() gives it and runs
# under valgrind: no decision may rest on memory that nobody wrote, which the address sanitizer does not see.
# usage: digest.sh ROOT
set -euo pipefail
. "$(dirname "$0")/../../src/sources.sh"
root=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

warnings=(-pedantic -Wall -Wextra -Wconversion -Wsign-conversion -Wvla -Wdouble-promotion -Wshadow -Werror)
program=()
for source in $(core_files "$root" '*.c') "$root"/src/cli/*.c; do
    [ "${source##*/}" = png_io.c ] || program+=("$source")
done
# build NAME CC CFLAGS...
build() {
    local name=$1
    shift
    "$@" -std=c99 "${warnings[@]}" -D_POSIX_C_SOURCE=200809L -I "$root/include" -I "$root/src/cli" "${program[@]}" \
        "$root/tests/checks/no_png.c" -o "$work/$name"
}
build gcc-O0 gcc -O0
build gcc-O3 gcc -O3
build clang-O2 clang -O2
build armhf arm-linux-gnueabihf-gcc -O2 -static
build s390x s390x-linux-gnu-gcc -O2 -static
build uncleared gcc -O1 -g -Dcalloc=uncleared
readelf -h "$work/armhf" | grep -q ELF32
readelf -h "$work/s390x" | grep -q 'big endian'
# shellcheck disable=SC2046 # flags are words
gcc -std=c99 "${warnings[@]}" -I "$root/src/cli" $(pkg-config --cflags libpng) "$root"/tests/checks/png_to_pgm.c \
    "$root"/src/cli/{png_io,pnm,images,cli}.c -D_POSIX_C_SOURCE=200809L -o "$work/png_to_pgm" $(pkg-config --libs libpng)

# sidecar_numbers FILE KEY: the numbers in the object of that name, with commas
sidecar_numbers() {
    sed -nE "s/^ *\"$2\": \{(.*)\},?$/\1/p" "$1" | grep -oE -- '-?[0-9]+(\.[0-9]+)?' | paste -sd,
}

# frame_options FILE: camera, drogue and region from a sidecar, one word a line in this order
frame_options() {
    printf '%s\n' --camera "$(sidecar_numbers "$1" camera)" --drogue "$(sidecar_numbers "$1" drogue)" \
        --roi "$(sidecar_numbers "$1" region)"
}

# run_all COMMAND...: every frame measured, in its region and as a whole; a track with a frame that shows no drogue
run_all() {
    local frame options
    for frame in "${frames[@]}"; do
        mapfile -t options < <(frame_options "$root/vectors/frame/$frame.json")
        "$@" measure --json "${options[@]}" "$frame.pgm" || echo "exit $?"
        "$@" measure --json "${options[@]:0:4}" "$frame.pgm" || echo "exit $?"
    done
    mapfile -t options < <(frame_options "$root/vectors/frame/demo.json")
    "$@" track --json --fps 25 "${options[@]}" demo.pgm demo.pgm black.pgm demo.pgm || echo "exit $?"
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
for name in gcc-O0 gcc-O3 clang-O2 armhf s390x uncleared; do
    case $name in
    armhf) run_all qemu-arm ../armhf ;;
    s390x) run_all qemu-s390x ../s390x ;;
    uncleared) run_all valgrind -q --error-exitcode=99 --leak-check=full ../uncleared ;;
    *) run_all ../$name ;;
    esac >"../$name.json"
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
