# SPDX-License-Identifier: Apache-2.0
# Files: what is no whole PNG is refused with its name, one line and exit code 2; odd images are no crash.
. "$(dirname "$0")/common.sh"

# refused FILE [REASON]: by every command, whatever is wrong
refused() {
    run 2 measure "$1" $camera
    says "drogue: $1: "
    [ $# -eq 1 ] || says "$2"
    [ ! -s out ] || fail "$1: output in spite of it"
    run 2 track "$1" $camera
    says "drogue: $1: "
    run 2 edges "$1" edges.png --low 40 --high 100
    says "drogue: $1: "
    [ ! -e edges.png ] || fail "$1: an edge map in spite of it"
}

refused missing.png 'No such file'
mkdir folder.png
refused folder.png 'directory'
: >empty.png
refused empty.png 'empty'
echo 'Portable' >text.png
refused text.png 'not a PNG'
printf '\211PNG' >short.png
refused short.png 'not a PNG'
printf '\211PNG\r\n\032\n' >signature.png
refused signature.png
refused huge.png 'more than'

# Cut anywhere, even only the end mark.
size=$(wc -c <scene.png)
for length in 8 9 20 33 40 41 100 $((size / 2)) $((size - 20)) $((size - 12)) $((size - 1)); do
    head -c "$length" scene.png >cut.png
    refused cut.png
done

# Any one byte wrong: refused, or read as what it still says, and never more than a line about it.
size=$(wc -c <two.png)
refusals=0
at=0
while [ $at -lt "$size" ]; do
    for byte in '\000' '\177' '\377'; do
        cp two.png wrong.png
        # shellcheck disable=SC2059
        printf "$byte" | dd of=wrong.png bs=1 seek=$at conv=notrunc 2>/dev/null
        "$drogue" measure wrong.png $camera >out 2>err
        code=$?
        checks=$((checks + 1))
        case $code in
        1) [ "$(wc -l <err)" -eq 1 ] || fail "byte $at: exit code 1 without a sentence" ;;
        2)
            refusals=$((refusals + 1))
            [ "$(wc -l <err)" -eq 1 ] || fail "byte $at: no complaint of one line"
            ;;
        *) fail "byte $at: exit code $code" ;;
        esac
    done
    at=$((at + 1))
done
[ $refusals -gt $((2 * size)) ] || fail "only $refusals of $((3 * size)) wrong bytes were seen"

# Odd images are read, and measure says that there is nothing.
for image in black white one two tall; do
    run 1 measure $image.png $camera --json --overlay over.png
    "$json_check" status position_m <out >found || fail "$image: no JSON"
    same "$(sed -n 2p found)" null
    run 1 track $image.png $image.png $camera
    same "$(wc -l <out | tr -d ' ')" 2
    run 0 edges $image.png edges.png --low 40 --high 100
    run 0 edges edges.png again.png --low 0 --high 0 --smooth
done

# Noise may hold anything: exit code and status agree, and it is no crash.
for image in noise noise_full; do
    "$drogue" measure $image.png $camera --json --overlay over.png >out 2>err
    code=$?
    case $code,$(json status) in
    0,'"ok"' | 1,'"no_edges"' | 1,'"no_arcs"' | 1,'"no_ellipse"') ;;
    *) fail "$image: exit code $code, $(cat out err)" ;;
    esac
    checks=$((checks + 1))
    run 0 edges $image.png edges.png --low 0 --high 0
done

# Larger than a region may be: searched, but not measured as a whole.
for image in wide large; do
    run 1 measure $image.png $camera --json --overlay over.png
    same "$(json status)" '"no_inner_part"'
    run 1 track $image.png $camera
    same "$(json raw.status)" '"no_inner_part"'
    run 2 edges $image.png edges.png --low 40 --high 100
    says '2048'
    run 1 measure $image.png $camera --roi 0,0,2048,1 --overlay over.png
    run 2 measure $image.png $camera --roi 0,0,2049,1
    says 'smaller'
done

for image in widest tallest; do
    run 2 measure $image.png $camera
    says 'give a --roi'
    run 2 track $image.png $camera
    says 'give a --roi'
done
run 1 measure widest.png $camera --roi 100,0,100,1
run 1 track widest.png $camera --roi 100,0,100,1
run 1 measure widest.png $camera --roi 32700,0,100,1
says 'ends beyond pixel 32766'
run 0 measure scene_large.png $far_camera --drogue 0.35,0.175,0.02 --json --overlay over.png
near "$(json ellipse.xc)" 2241.25 0.02
near "$(json ellipse.yc)" 118.5 0.02
[ "$(png_side over.png 16)" -lt 1600 ] || fail 'the overlay of a large image is not cropped about what was found'
run 0 track scene_large.png $far_camera --drogue 0.35,0.175,0.02 --overlay over.png

# The same colours in another kind of file give the same answer.
run 0 measure scene.png $camera $roi --drogue 0.35,0.175,0.02 --json
sed 's/scene\.png//' out >first
for kind in grey16 grey_alpha rgb rgba16 palette; do
    run 0 measure scene_$kind.png $camera $roi --drogue 0.35,0.175,0.02 --json
    sed "s/scene_$kind\\.png//" out | cmp -s - first || fail "scene_$kind.png: another answer"
done

# Output that cannot be written.
run 2 measure scene.png $camera $roi --overlay nowhere/over.png
says 'drogue: nowhere/over.png: No such file'
run 2 measure scene.png $camera $roi --overlay folder.png
run 2 edges scene.png nowhere/edges.png --low 40 --high 100
says 'drogue: nowhere/edges.png: '
run 2 edges scene.png folder.png --low 40 --high 100
if [ -c /dev/full ]; then
    for arguments in '--help' '--version' "measure scene.png $camera $roi" "measure scene.png $camera $roi --json" \
        "track scene.png $camera $roi"; do
        checks=$((checks + 1))
        # shellcheck disable=SC2086
        "$drogue" $arguments >/dev/full 2>err
        same $? 2
        says 'drogue: standard output: '
    done
    run 2 edges scene.png /dev/full --low 40 --high 100
    says 'drogue: /dev/full: '
    run 2 measure scene.png $camera $roi --overlay /dev/full
    says 'drogue: /dev/full: '
else
    echo 'skipped: output to a full device, there is no /dev/full'
fi

finish
