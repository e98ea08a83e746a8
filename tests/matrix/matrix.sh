#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The same bits everywhere: compiles core, conformance run and golden vectors into one program per row (compiler, flags,
# processor), runs it, and compares the digests of all outputs. A row counts only when its program shows that it is what
# the row says: compiler, optimisation, pointer size, byte order and core are read back from it.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit
. src/sources.sh
. tests/matrix/machine.sh
work=${DROGUE_MATRIX_DIR:-build/matrix}
jobs=${DROGUE_MATRIX_JOBS:-$(nproc)}
read -ra stages <<<"${DROGUE_MATRIX_STAGES:-}"
most_s=900 # of one row's run
host=$(uname -m)
host=${host/_/-}

# row | in --ci? | compiler | flags | where it runs | what it must report: target, pointer bits, byte order, core
rows="
gcc-O0     |ci| gcc                     | -O0                             | host         | $host 64 little -
gcc-O2     |  | gcc                     | -O2                             | host         | $host 64 little -
gcc-O3     |ci| gcc                     | -O3                             | host         | $host 64 little -
gcc-Os     |  | gcc                     | -Os                             | host         | $host 64 little -
clang-O0   |  | clang                   | -O0                             | host         | $host 64 little -
clang-O2   |ci| clang                   | -O2                             | host         | $host 64 little -
clang-O3   |  | clang                   | -O3                             | host         | $host 64 little -
clang-Os   |  | clang                   | -Os                             | host         | $host 64 little -
gcc-m32    |ci| gcc                     | -m32 -O2                        | host         | i386 32 little -
aarch64    |  | aarch64-linux-gnu-gcc   | -O2                             | qemu-aarch64 | aarch64 64 little -
arm        |  | arm-linux-gnueabihf-gcc | -O2                             | qemu-arm     | arm 32 little -
riscv64    |  | riscv64-linux-gnu-gcc   | -O2                             | qemu-riscv64 | rv64 64 little -
s390x      |ci| s390x-linux-gnu-gcc     | -O2                             | qemu-s390x   | s390x 64 big -
cortex-m0+ |  | arm-none-eabi-gcc       | -mcpu=cortex-m0plus -mthumb -Os | mps2-an385   | armv6-m 32 little Cortex-M3
cortex-m3  |  | arm-none-eabi-gcc       | -mcpu=cortex-m3 -mthumb -O2     | mps2-an385   | armv7-m 32 little Cortex-M3
cortex-m7  |ci| arm-none-eabi-gcc       | -mcpu=cortex-m7 -mthumb -O3     | mps2-an500   | armv7e-m 32 little Cortex-M7
rv32       |ci| riscv64-unknown-elf-gcc | -march=rv32imac -mabi=ilp32 -O2 | virt         | rv32 32 little RV32
"

# row_names CI: of all, or of those of --ci
row_names() { awk -F'|' -v ci="$1" 'NF && (ci == "" || $2 ~ ci) {gsub(/ /, "", $1); print $1}' <<<"$rows"; }

usage() {
    cat <<END
usage: tests/matrix/matrix.sh [--ci] [ROW...]

Without ROW: every row; with --ci: those that a commit must pass, where a row that cannot be built is a failure and not
SKIPPED. Exit status 0 when the rows that ran passed every case with the same digest.
Works in build/matrix (DROGUE_MATRIX_DIR) with as many jobs as processors (DROGUE_MATRIX_JOBS), with the vectors of every
stage (or DROGUE_MATRIX_STAGES).
Rows: $(row_names "" | tr '\n' ' ')
END
}

# lookup ROW: sets compiler, flags, where, reports; and for the place: dialect (of every compilation), link, run
lookup() {
    local line target
    line=$(awk -F'|' -v row="$1" '{k = $1; gsub(/ /, "", k)} k == row' <<<"$rows")
    IFS='|' read -r _ _ compiler target where reports <<<"$line"
    compiler=${compiler// /}
    where=${where// /}
    reports=${reports# }
    read -ra flags <<<"$target"
    dialect=() link=() run=()
    case $where in
    host) ;;
    qemu-*) link=(-static) run=("$where") ;;
    mps2-*)
        dialect=(--specs=rdimon.specs)
        link=(-nostartfiles -T tests/matrix/mps2.ld tests/matrix/start_mps2.c)
        [ "$where" != mps2-an500 ] || link=(-Wl,--defsym=psram=0x60000000 "${link[@]}")
        machine "$where"
        ;;
    virt)
        dialect=(--specs=picolibc.specs)
        link=(--oslib=semihost --crt0=semihost "-Wl,--defsym=__flash=0x80000000,--defsym=__flash_size=16M"
            "-Wl,--defsym=__ram=0x81000000,--defsym=__ram_size=16M,--defsym=__stack_size=64K")
        machine virt
        ;;
    *)
        echo "matrix: no row '$1'" >&2
        return 1
        ;;
    esac
}

# lacks: what this machine lacks for the row looked up
lacks() {
    if ! command -v "$compiler" >/dev/null; then
        echo "$compiler"
    elif [ ${#run[@]} -gt 0 ] && ! command -v "${run[0]}" >/dev/null; then
        echo "${run[0]}"
    elif ! "$compiler" "${dialect[@]}" "${flags[@]}" -xc -c -o /dev/null - <<<'#include <stdio.h>' 2>/dev/null; then
        echo "the C library for $compiler ${flags[*]}"
    fi
}

# data_compiler: sets data_cc, the command that compiles the vectors for the row looked up, and data_dir, where to: rows
# of one binary interface share the objects, which hold no code
data_compiler() {
    case $compiler in
    gcc | clang) data_cc=(gcc) ;;
    arm-none-eabi-gcc) data_cc=("$compiler" -mcpu=cortex-m0plus -mthumb) ;;
    *) data_cc=("$compiler" "${flags[@]/#-O*/-O0}") ;;
    esac
    if [[ ${flags[*]} == *-m32* ]]; then
        data_cc+=(-m32)
    fi
    data_cc+=("${dialect[@]}" -O0 -std=c99)
    data_dir=$work/data/$(tr -c 'a-zA-Z0-9\n' _ <<<"${data_cc[*]}")
}

# build_data: compile the vectors for the row looked up
build_data() {
    local file
    mkdir -p "$data_dir"
    for file in "$work"/cases/*.c; do
        "${data_cc[@]}" -I tests/conformance -c "$file" -o "$data_dir/$(basename "$file" .c).o" || return 1
    done 2>"$data_dir/build.log"
}

conformance=(tests/conformance/{stages*,sha256,conformance}.c)
warnings=(-pedantic -Wall -Wextra -Wconversion -Wsign-conversion -Wvla -Wdouble-promotion -Wshadow -Werror)

# build_row DIR: compile and link the row looked up
build_row() {
    local compile=("$compiler" "${dialect[@]}" "${flags[@]}" -std=c99 "${warnings[@]}" -frecord-gcc-switches
        -I include -I tests/conformance)
    "${compile[@]}" -Dmain=conformance_main -c tests/conformance/embedded_main.c -o "$1/embedded_main.o" &&
        "${compile[@]}" $(core_files . '*.c') "${conformance[@]}" tests/matrix/row_main.c "$1/embedded_main.o" \
            "$data_dir"/*.o "${link[@]}" -o "$1/image"
} >"$1/build.log" 2>&1

# value NAME LINE: of NAME=VALUE in a line
value() { sed -nE "s/.*\b$1=([^ ]*).*/\1/p" <<<"$2"; }

# took_effect IMAGE LINE: nothing, or how the program differs from the row looked up. The level of optimisation is what
# the compiler recorded in the image: one level for every file that was compiled.
took_effect() {
    local level recorded speed=speed
    level=$(printf '%s\n' "${flags[@]}" | grep '^-O')
    recorded=$(readelf -p .GCC.command.line "$1" 2>/dev/null | grep -oE -- ' -O[0-9sgz]*' | sort -u | xargs)
    case $level in
    -O0) speed=none ;;
    -Os) speed=size ;;
    esac
    if [ "$(value target "$2") $(value bits "$2") $(value order "$2") $(value core "$2")" != "$reports" ]; then
        echo "reports '$2' instead of '$reports'"
    elif [ "$(value optimised "$2")" != "$speed" ] || [ "$recorded" != "$level" ]; then
        echo "compiled with '$recorded', reports $(value optimised "$2")"
    elif [[ $(value compiler "$2") != "$([[ $compiler == *clang ]] && echo clang || echo gcc)"-* ]]; then
        echo "compiled by $(value compiler "$2")"
    fi
}

# do_row ROW: build and run it; leaves 'verdict|compiler and flags|ran on|cases|failed|digest|seconds' in its folder
do_row() {
    local dir=$work/rows/$1 begin=$SECONDS verdict="" line="" last="" status=0 built="" ran=- lacking
    lookup "$1" && data_compiler || return
    mkdir -p "$dir"
    rm -f "$dir"/*
    lacking=$(lacks)
    if [ -n "$lacking" ]; then
        echo "SKIPPED: no $lacking|$compiler ${flags[*]}|-|-|-|-|0" >"$dir/result"
        return
    fi
    if [ ! -e "$data_dir/done" ]; then
        verdict="FAILED: vectors do not compile"
        cp "$data_dir/build.log" "$dir/log"
    elif ! build_row "$dir" || [ ! -x "$dir/image" ]; then
        verdict="FAILED: does not build"
        cp "$dir/build.log" "$dir/log"
    else
        timeout "$most_s" "${run[@]}" "$dir/image" </dev/null >"$dir/log" 2>&1 || status=$?
        line=$(grep -a '^row: ' "$dir/log" | head -n 1)
        built=$(value compiler "$line")
        ran="$where: $(value target "$line") $(value bits "$line") bit $(value order "$line") $(value core "$line")"
        last=$(tail -n 1 "$dir/log" |
            grep -aE '^conformance: cases=[0-9]+ exact=[0-9]+ failed=[0-9]+ digest=[0-9a-f]{64}$')
        if [ -z "$last" ]; then
            verdict="FAILED: no result, exit status $status"
        else
            verdict=$(took_effect "$dir/image" "$line")
            verdict=${verdict:+FAILED: $verdict}
        fi
        if [ -z "$verdict" ] && { [ "$status" -ne 0 ] || [ "$(value failed "$last")" != 0 ]; }; then
            verdict="FAILED: exit status $status"
        fi
    fi
    printf '%s|%s|%s|%s|%s|%s|%d\n' "$verdict" "${built:-$compiler} ${flags[*]}" "${ran%% -}" "$(value cases "$last")" \
        "$(value failed "$last")" "$(value digest "$last")" $((SECONDS - begin)) >"$dir/result"
}

# in_parallel COMMAND NAME...: one background job per name
in_parallel() {
    local command=$1 name
    shift
    for name in "$@"; do
        while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do
            wait -n
        done
        "$command" "$name" &
    done
    wait
}

# do_data DIR: by the command that its file 'row' leads to
do_data() {
    lookup "$(cat "$1/row")" && data_compiler && build_data && touch "$data_dir/done"
}

# compare ROW...: prints the table; exit status 0 when every row is right
compare() {
    local row
    for row in "$@"; do
        echo "$row|$(cat "$work/rows/$row/result")"
    done | awk -F'|' -v ci="$ci" -v seconds="$SECONDS" '
        {
            for (k = 1; k <= 8; k++) cell[NR, k] = $k
            if (length($7) == 64 && ++seen[$7] > seen[common]) common = $7
        }
        function put(row, k, text) {
            table[row, k] = text
            if (length(text) > width[k]) width[k] = length(text)
        }
        END {
            n = split("row compiler_and_flags ran_on cases failed digest s verdict", title, " ")
            for (k = 1; k <= n; k++) {
                gsub("_", " ", title[k])
                put(0, k, title[k])
            }
            for (r = 1; r <= NR; r++) {
                verdict = cell[r, 2]
                if (length(cell[r, 7]) == 64 && cell[r, 7] != common) {
                    verdict = verdict (verdict == "" ? "" : ", ") "DIGEST DIFFERS"
                    differ = differ " " cell[r, 1]
                }
                if (verdict ~ /^SKIPPED/) skipped++
                if (verdict != "" && (verdict !~ /^SKIPPED/ || ci)) failed++
                put(r, 1, cell[r, 1])
                for (k = 2; k <= 5; k++) put(r, k, cell[r, k + 1])
                put(r, 6, substr(cell[r, 7], 1, 16))
                put(r, 7, cell[r, 8])
                put(r, 8, verdict == "" ? "ok" : verdict)
            }
            for (r = 0; r <= NR; r++) {
                line = ""
                for (k = 1; k <= n; k++) line = line sprintf("%-" width[k] "s  ", table[r, k])
                sub(/ +$/, "", line)
                print line
            }
            if (differ != "") print "matrix: digest differs from the other rows in:" differ
            printf "matrix: rows=%d ok=%d failed=%d skipped=%d seconds=%d digest=%s\n", NR,
                NR - failed - (ci ? 0 : skipped), failed, skipped, seconds, common == "" ? "-" : common
            exit failed > 0 || common == ""
        }'
}

ci=""
chosen=()
for argument in "$@"; do
    case $argument in
    --ci) ci=ci ;;
    -h | --help) usage && exit ;;
    -*) usage >&2 && exit 2 ;;
    *) chosen+=("$argument") ;;
    esac
done
if [ ${#chosen[@]} -eq 0 ]; then
    mapfile -t chosen < <(row_names "$ci")
fi
rm -rf "$work/data" "$work/rows"
data_dirs=()
for row in "${chosen[@]}"; do
    lookup "$row" && data_compiler || exit 2
    if [ -z "$(lacks)" ] && [ ! -e "$data_dir" ]; then
        mkdir -p "$data_dir"
        echo "$row" >"$data_dir/row"
        data_dirs+=("$data_dir")
    fi
done
if ! tests/matrix/embed.sh "$work/cases" 4 "${stages[@]}"; then
    echo "matrix: cannot turn vectors/ into C" >&2
    exit 1
fi
in_parallel do_data "${data_dirs[@]}"
in_parallel do_row "${chosen[@]}"
compare "${chosen[@]}" && exit
for row in "${chosen[@]}"; do
    if grep -q '^FAILED' "$work/rows/$row/result"; then
        printf '\n== %s, end of its output\n' "$row"
        tail -n 15 "$work/rows/$row/log"
    fi
done
exit 1
