# SPDX-License-Identifier: Apache-2.0
# Command line: both spellings, any order, and every misuse refused with one line and exit code 2.
. "$(dirname "$0")/common.sh"

run 0 --help
prints 'rim radii'
prints 'Exit code'
run 0 measure --help
prints 'drogue track'
cp out long
run 0 -h
cmp -s out long || fail '-h is not --help'
run 0 -V
cp out long
run 0 --version
cmp -s out long || fail '-V is not --version'
grep -Eq '^drogue [0-9]+\.[0-9]+\.[0-9]+$' out || fail "version: $(cat out)"

run 2
says 'no command'
run 2 scene.png
says 'no such command'
run 2 measur scene.png $camera
run 2 measure $camera
says 'one image'
run 2 measure scene.png black.png $camera
says 'not 2 files'
run 2 track $camera
says 'at least one image'
run 2 edges scene.png --low 1 --high 2
run 2 edges a b c --low 1 --high 2
run 2 measure scene.png
says '--camera'
run 2 track scene.png
says '--camera'
run 2 edges scene.png out.png --high 3
says '--low'
run 2 edges scene.png out.png --low 3
says '--high'

# Options: unknown, without a value, with one too many, of another command.
run 2 measure scene.png $camera --frobnicate
says '--frobnicate'
run 2 measure scene.png $camera -x
says '-x'
run 2 measure scene.png --camera
says 'needs a value'
run 2 measure scene.png $camera --overlay
says 'needs a value'
run 2 measure scene.png $camera --json=yes
says 'drogue: --json=yes: takes no value'
run 2 measure scene.png $camera --he
says 'drogue: --he: unknown or ambiguous option'
run 2 measure scene.png $camera --fps 30
says '--fps'
run 2 measure scene.png $camera --low 30
run 2 edges scene.png out.png --low 1 --high 2 $camera
says '--camera'
run 2 edges scene.png out.png --low 1 --high 2 --roi 0,0,5,5
run 2 track scene.png $camera --smooth

run 2 measure scene.png --camera 800,5,800,5,159,5,119,5
says 'behind a point, not a comma'
run 2 measure scene.png $camera --json --csv
says 'excludes'
run 2 measure scene.png $camera --raw 1,1,gray8
run 2 measure scene.png --camera 800,800,5000,119.5
says 'the principal point lies far outside the image: scene.png has 320x240 pixels'
run 2 track scene.png --camera 800,800,159.5,-4500
says 'the principal point lies far outside the image: scene.png has 320x240 pixels'
for r in -0.1 1.1 x '' 0.5,0.5; do
    run 2 track scene.png $camera --min-reliability "$r"
    run 2 measure scene.png $camera --min-reliability "$r"
    says '--min-reliability'
done

# Order and spelling do not matter; -- ends the options.
run 0 measure scene.png --camera=800,800,159.5,119.5 --roi=60,18,200,200 --drogue=0.35,0.175,0.02 --json
cp out first
for order in \
    'measure scene.png --camera 800,800,159.5,119.5 --roi 60,18,200,200 --drogue 0.35,0.175,0.02 --json' \
    'measure --json --camera 800,800,159.5,119.5 --roi=60,18,200,200 --drogue 0.35,0.175,0.02 scene.png' \
    '--drogue .35,1.75e-1,2E-2 --json measure --roi +60,018,2e2,200.0 scene.png --camera 8e2,800.0,159.5,119.5' \
    'measure --json --camera 1,1,1,1 --camera 800,800,159.5,119.5 --roi 60,18,200,200 --drogue 0.35,0.175,0.02 -- scene.png'; do
    # shellcheck disable=SC2086
    run 0 $order
    cmp -s out first || fail "not the same output: drogue $order"
done
cp scene.png -- --json.png
run 0 measure $camera $roi -- --json.png

# Numbers: each list is exact in count, each number exact in form and range.
for list in 1,2,3 1,2,3,4,5 '' ,,, 1,2,3, ,1,2,3 a,2,3,4 1,2,3,4x '1, 2,3,4' nan,1,1,1 1,inf,1,1 1,1,0x10,1 1,1,1,1e 1e,1,1,1 \
    32768,1,1,1 1,1,-32769,1 1,1,1,1e99 0,1,1,1 1,0,1,1 -1,1,1,1 1,-800,1,1 1e-9,1,1,1 '1;2;3;4' 1..2,1,1,1 1465,5,1465,5 800,5,800,5,159,5,119,5 no-such.yaml; do
    run 2 measure scene.png --camera "$list"
    says '--camera'
done
for list in 1,2,3,4 1,2,3,4,5,6 0 '' 0,0,0,0,nan 0,0,0,0, 0,0,0,0,99999; do
    run 2 measure scene.png $camera --distortion "$list"
    says '--distortion'
done
for list in 1,2 1,2,3,4 '' 0 -1 0,1,1 0.35,0.36,0.1 0,35 1,0,1 1,-1,1 1,1,-0.1 x 1e-7 0.00998 0.005,0.002,0 1,1e-7,1 40000 1,2,nan; do
    run 2 measure scene.png $camera --drogue "$list"
    says '--drogue'
done
for list in 1,2,3 1,2,3,4,5 '' 0,0,0,10 0,0,10,0 0,0,-5,5 0,0,5,-5 0.5,0,10,10 0,0,1e-1,10 0,0,1e9,10 0,0,10000,10 \
    0,0,8193,10 -2000000,0,10,10 99999999999999999999,0,1,1 a,0,1,1 0,0,0x8,8; do
    run 2 measure scene.png $camera --roi "$list"
    says '--roi'
done
for rate in 0 -1 nan '' 30,30 1e-9 0.0001 0.000499999 1e9 1000000.1 30fps 1e99; do
    run 2 track scene.png $camera --fps "$rate"
    says '--fps'
done
run 2 track scene.png $camera --raw 1,1,gray8 --raw 1,1,gray9
says 'is not gray8'
run 2 track scene.png $camera --overlay ''
says 'drogue: --overlay: has no name'
POSIXLY_CORRECT=1 "$drogue" measure scene.png $camera $roi >out 2>err || fail "options behind the image: $(cat err)"
for raw in 16384,16384,gray8 32767,2049,yuyv 0,1,gray8 1,1,gray9 1,1 3,2,yuyv; do
    run 2 track scene.png $camera --raw $raw
    says 'drogue: --raw: '
done
for count in -1 1.5 nan '' 1,2 1000001 1e9 x 3f; do
    run 2 track scene.png $camera --max-missed "$count"
    says '--max-missed'
done
run 2 measure scene.png $camera --max-missed 3
says 'takes no option --max-missed'
for level in -1 nan '' 1,2 1e9 -0.0000000000001 x; do
    run 2 edges scene.png out.png --low "$level" --high 100
    says '--low'
    run 2 edges scene.png out.png --low 0 --high "$level"
    says '--high'
done
run 2 edges scene.png out.png --low 50.1 --high 50
says '--low'
[ ! -e out.png ] || fail 'a refused command wrote a file'

# A complaint is one line (run() looks), whatever a value holds.
broken=$(printf '1,2\n\r\033\177x')
for option in --camera --distortion --roi --drogue --min-reliability --set --low; do
    run 2 measure scene.png $camera $option "$broken"
done
for option in --raw --fps --max-missed; do
    run 2 track scene.png $camera $option "$broken"
done
run 2 track scene.png $camera --raw "1,$broken"
says "'2????x' is not gray8"
run 2 measure scene.png $camera --set "$(printf 'foo\nbar=1')"
says "named 'foo?bar'"

finish
