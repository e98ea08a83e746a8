#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# For each target: installs the static library, builds the images of this folder from it by find_package, runs them in
# QEMU. Prints one table. Exit status 0 when every image succeeds, every digest and every example's output is the
# host's, and the instructions on the Cortex-M7 keep their budgets.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit
. tests/matrix/machine.sh
here=tests/embedded
work=$PWD/${DROGUE_EMBEDDED_DIR:-build/embedded}
optimisation=${DROGUE_EMBEDDED_OPTIMISATION:--O2}

# target | machine in QEMU; the first column is also the name of the toolchain file in src/cmake. QEMU has no Cortex-M0+
# with room for a frame: its code, of Armv6-M alone, runs on a Cortex-M3.
targets="
host           | host
cortex-m0plus  | mps2-an385
cortex-m3      | mps2-an385
cortex-m4      | mps2-an386
cortex-m7      | mps2-an500
cortex-m7-hard | mps2-an500
rv32imac       | virt
"
examples=(static_frame camera_dma filter_loop)

target_names() { awk -F'|' 'NF {gsub(/ /, "", $1); print $1}' <<<"$targets"; }
where_of() { awk -F'|' -v name="$1" '{gsub(/ /, "")} $1 == name {print $2}' <<<"$targets"; }

usage() {
    cat <<END
usage: tests/embedded/embedded.sh [TARGET...]

Targets: $(target_names | sed 1d | tr '\n' ' ')(default: all). The images stay in build/embedded/TARGET/images
(DROGUE_EMBEDDED_DIR). Optimisation is -O2 (DROGUE_EMBEDDED_OPTIMISATION); budgets are checked for that.
END
}

# timed WHAT COMMAND...: quietly; says how long it took, or shows the output of what failed
timed() {
    local what=$1 begin=$EPOCHREALTIME
    shift
    if ! "$@" >"$work/log" 2>&1; then
        echo "embedded: $what failed:"
        tail -n 30 "$work/log"
        return 1
    fi
    awk -v what="$what" -v begin="$begin" -v end="$EPOCHREALTIME" 'BEGIN {printf "%-40s %5.1f s\n", what, end - begin}'
}

make_frames() {
    local libraries
    read -ra libraries <<<"$(pkg-config --cflags --libs libpng libcjson)"
    gcc -std=c99 -Wall -Wextra -Werror -O1 -D_GNU_SOURCE -I include -I $here $here/make_frames.c "${libraries[@]}" -lm \
        -o "$work/make_frames" && "$work/make_frames" vectors/frame/*.json >"$work/frames.c"
}

# configure SOURCE FOLDER TARGET OPTION...
configure() {
    local source=$1 folder=$2 toolchain=()
    [ "$3" = host ] || toolchain=(--toolchain "$PWD/src/cmake/$3.cmake")
    cmake -S "$source" -B "$folder" -G Ninja "${toolchain[@]}" -DCMAKE_BUILD_TYPE=Release \
        "-DCMAKE_C_FLAGS_RELEASE=$optimisation" -DCMAKE_COMPILE_WARNING_AS_ERROR=ON "${@:4}"
}

# install_library TARGET
install_library() {
    configure . "$work/$1/library" "$1" -DDROGUE_BUILD_CLI=OFF -DDROGUE_BUILD_TESTS=OFF \
        -DCMAKE_INSTALL_PREFIX="$work/$1/installed" &&
        cmake --build "$work/$1/library" && cmake --install "$work/$1/library"
}

# build_images TARGET
build_images() {
    configure $here "$work/$1/images" "$1" -Ddrogue_ROOT="$work/$1/installed" -DDROGUE_FRAMES="$work/frames.c" &&
        cmake --build "$work/$1/images"
}

# run_images TARGET: output of each in its folder's NAME.out; exit status 0 when all of them exit with 0
run_images() {
    local name status=0 dir=$work/$1/images
    machine "$(where_of "$1")"
    case ${run[0]:-} in qemu*) run=("${run[0]}" -icount "shift=0" "${run[@]:1}") ;; esac
    for name in measure stages "${examples[@]}"; do
        if ! timeout 120 "${run[@]}" "$dir/$name" </dev/null >"$dir/$name.out" 2>&1; then
            echo "$1: $name failed:"
            tail -n 5 "$dir/$name.out"
            status=1
        fi
    done
    return $status
}

# judge TARGET: nothing, or what is wrong with the outputs
judge() {
    local name dir=$work/$1/images host=$work/host/images
    for name in "${examples[@]}"; do
        cmp -s "$host/$name.out" "$dir/$name.out" || echo "$1: $name prints something else than on the host"
    done
    for name in measure stages; do
        [ "$(grep -o ' digest=.*' "$dir/$name.out")" = "$(grep -o ' digest=.*' "$host/measure.out")" ] ||
            echo "$1: digests of $name differ from the host's"
        grep -q '^measure: .* counting=1 failed=0 ' "$dir/$name.out" || [ "$1" = host ] ||
            echo "$1: $name cannot count instructions"
    done
}

# table TARGET...: from the outputs
table() {
    local target
    for target in host "$@"; do
        sed -n "s/^frame \([^:]*\): /$target \1 measure /p" "$work/$target/images/measure.out"
        sed -n "s/^frame \([^:]*\): /$target \1 stages /p" "$work/$target/images/stages.out"
    done | awk -f $here/table.awk
}

# budget NAME VALUE: prints both; exit status 1 when it is exceeded
budget() {
    awk -v name="$1" -v value="$2" '$1 == name {
        printf "%-40s %9.0f, budget %9d  %s\n", name, value, $2, value <= $2 ? "ok" : "EXCEEDED"
        found = 1
        bad = value > $2
    } END { exit bad || !found }' $here/budgets
}

# budgets: worst frame on the Cortex-M7
budgets() {
    local counts status=0
    counts=$(table cortex-m7 | awk '$1 == "cortex-m7" { if ($7 > front) front = $7; if ($14 > back) back = $14 }
        END { print front, back * 1000 }')
    echo
    budget front_end_per_pixel "${counts% *}" || status=1
    budget back_end "${counts#* }" || status=1
    return $status
}

chosen=()
for argument in "$@"; do
    case $argument in
    -h | --help) usage && exit ;;
    *) if [ "$argument" = host ] || [ -z "$(where_of "$argument")" ]; then usage >&2 && exit 2; fi ;;
    esac
    chosen+=("$argument")
done
[ ${#chosen[@]} -gt 0 ] || mapfile -t chosen < <(target_names | sed 1d)

rm -rf "$work"
mkdir -p "$work"
failed=0
timed 'frames as C' make_frames || exit 1
for target in host "${chosen[@]}"; do
    timed "$target: library, installed" install_library "$target" &&
        timed "$target: images" build_images "$target" &&
        timed "$target: runs" run_images "$target" || exit 1
    wrong=$(judge "$target")
    if [ -n "$wrong" ]; then
        echo "$wrong"
        failed=1
    fi
done
echo
echo "static_frame on ${chosen[-1]}, in QEMU:"
sed 's/^/    /' "$work/${chosen[-1]}/images/static_frame.out"
echo
table "${chosen[@]}"
if [[ " ${chosen[*]} " == *' cortex-m7 '* && $optimisation == -O2 ]]; then
    budgets || failed=1
fi
echo "embedded: targets=${#chosen[@]} failed=$failed optimisation=$optimisation seconds=$SECONDS"
exit $failed
