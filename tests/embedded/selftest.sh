#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# embedded.sh must bite: each case spoils one thing by a tool found first in PATH, and expects exit status 1 and a
# message.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export DROGUE_EMBEDDED_DIR=build/embedded-selftest DROGUE_EMBEDDED_OPTIMISATION=-O1
failures=0

# spoil TOOL SED [FILE]: a TOOL that drops what SED deletes from its arguments, or edits FILE before it uses it
spoil() {
    local real
    real=$(command -v "$1")
    rm -rf "${work:?}/bin"
    mkdir -p "$work/bin"
    cat >"$work/bin/$1" <<END
#!/usr/bin/env bash
arguments=()
for argument in "\$@"; do
    case \$argument in
    */${3:-none}) sed '$2' "\$argument" >$work/${3:-none} && argument=$work/${3:-none} ;;
    $([ -n "${3:-}" ] && echo none || echo "$2")) continue ;;
    esac
    arguments+=("\$argument")
done
exec $real "\${arguments[@]}"
END
    chmod +x "$work/bin/$1"
}

# expect NAME PATTERN
expect() {
    local status=0
    PATH=$work/bin:$PATH tests/embedded/embedded.sh cortex-m7 >"$work/out" 2>&1 || status=$?
    if [ $status -eq 1 ] && grep -qE "$2" "$work/out"; then
        echo "ok      $1"
    else
        echo "FAILED  $1: exit status $status, expected 1 and '$2' in"
        cat "$work/out"
        failures=$((failures + 1))
    fi
}

spoil arm-none-eabi-gcc 's/DROGUE_Q16(6, 1)/DROGUE_Q16(5, 1)/' config.c
expect 'library with another default' '^cortex-m7: digests of measure differ'

spoil qemu-system-arm '-icount|shift=0'
expect 'clock that does not count instructions' '^cortex-m7: measure cannot count instructions'

spoil arm-none-eabi-gcc 's/f->true_position_m_q16\[2\] \/ 100/1/' measure.c
expect 'image that fails' '^cortex-m7: measure failed'

spoil arm-none-eabi-gcc 's/#define FRAMES 12/#define FRAMES 13/' filter_loop.c
expect 'example that prints something else' '^cortex-m7: filter_loop prints something else'

[ $failures -eq 0 ] && echo 'embedded selftest: all ok'
[ $failures -eq 0 ]
