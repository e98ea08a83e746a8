# SPDX-License-Identifier: Apache-2.0
# What the end-to-end tests share; sourced with the script's own arguments: the program and its helpers.
set -u
drogue=$1 make_images=$2 json_check=$3 canny_check=$4
# shellcheck disable=SC2034
root=$5
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
cd "$work" || exit 1
"$make_images" . || exit 1

checks=0
failed=0
camera=--camera=800,800,159.5,119.5
far_camera=--camera=800,800,2241,119.5 # of a drogue that is far to the right
roi=--roi=60,18,200,200

fail() {
    echo "FAIL: $*"
    failed=$((failed + 1))
}

# run CODE ARGUMENT...: the program must exit with CODE; its output goes to 'out' and 'err'. A complaint is one line when
# the code is 2, a sentence or more (track: one a status) when it is 1. With 0 there is none, but track's of some frames.
run() {
    want=$1
    shift
    checks=$((checks + 1))
    "$drogue" "$@" >out 2>err
    code=$?
    [ $code -eq "$want" ] || fail "exit code $code, not $want: drogue $*"
    if [ "$want" -eq 2 ]; then
        { [ "$(wc -l <err)" -eq 1 ] && grep -q '^drogue: ' err; } || {
            fail "no complaint of one line: drogue $*"
            cat err
        }
    elif [ "$want" -eq 1 ]; then
        LC_ALL=C grep -aq '^drogue: .*: [a-z_]*: [a-z]' err && ! LC_ALL=C grep -aqv '^drogue: ' err || fail "no sentence: drogue $*: $(cat err)"
    elif LC_ALL=C grep -aqvE '^drogue: [0-9]+ of [0-9]+ frames: [a-z_]+: ' err; then
        fail "a complaint without need: drogue $*"
        cat err
    fi
}

# says TEXT: the last complaint holds it.   prints TEXT: the last output does.
says() {
    checks=$((checks + 1))
    grep -qF -- "$1" err || fail "complaint without '$1': $(cat err)"
}
prints() {
    checks=$((checks + 1))
    grep -qF -- "$1" out || fail "output without '$1': $(cat out)"
}

# same A B: two texts
same() {
    checks=$((checks + 1))
    [ "$1" = "$2" ] || fail "'$1' is not '$2'"
}

# json PATH: the value there in each line of the last output, all of which must be JSON
json() {
    "$json_check" "$1" <out || fail "no $1 in the output"
}

png_side() { # FILE OFFSET
    od -A n -t u1 -j "$2" -N 4 "$1" | awk '{ print (($1 * 256 + $2) * 256 + $3) * 256 + $4 }'
}

# near VALUE EXPECTED TOLERANCE
near() {
    checks=$((checks + 1))
    awk "BEGIN { d = ($1) - ($2); exit !(\"$1\" != \"\" && d <= $3 && d >= -($3)) }" || fail "$1 is not within $3 of $2"
}

finish() {
    echo "$checks checks, $failed failed"
    [ $failed -eq 0 ] || exit 1
    exit 0
}
