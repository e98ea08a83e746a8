# SPDX-License-Identifier: Apache-2.0
# The same pixels by every way in: PNG, PGM, PPM, standard input, folders, raw video; and what is not read is named.
. "$(dirname "$0")/common.sh"
model=--drogue=0.35,0.175,0.02

frames='frame00.png frame01.png frame02.png frame03.png'
for file in scene.png $frames; do
    "$make_images" --raw "$file" >"${file%.png}.raw" || exit 1
done
# The same pixels in every form: PGM of 8 and 16 bits, PPM; the frames as gray8, nv12 and yuyv.
python3 - $frames <<'END' || exit 1
import sys
grey = open('scene.raw', 'rb').read()
open('scene.pgm', 'wb').write(b'P5\n# a comment\n320 240\n255\n' + grey)
open('scene16.pgm', 'wb').write(b'P5 320 240 65535\n' + bytes(b for v in grey for b in (v, v)))
open('scene.ppm', 'wb').write(b'P6 320\n240 255\n' + bytes(b for v in grey for b in (v, v, v)))
planes = [open(name.replace('.png', '.raw'), 'rb').read() for name in sys.argv[1:]]
open('gray8', 'wb').write(b''.join(planes))
open('nv12', 'wb').write(b''.join(plane + bytes(len(plane) // 2) for plane in planes))
open('yuyv', 'wb').write(bytes(b for plane in planes for v in plane for b in (v, 128)))
END

run 0 measure scene.png $camera $roi $model --json
sed 's/scene\.png//' out >first
run 0 measure scene.pgm $camera $roi $model --json
sed 's/scene\.pgm//' out | cmp -s - first || fail 'PGM: another answer'
run 0 measure scene16.pgm $camera $roi $model --json
sed 's/scene16\.pgm//' out | cmp -s - first || fail 'PGM of 16 bits: another answer'
run 0 measure scene.ppm $camera $roi $model --json
sed 's/scene\.ppm//' out | cmp -s - first || fail 'PPM: another answer'
for file in scene.png scene.pgm; do
    "$drogue" measure - $camera $roi $model --json <$file >out 2>err || fail "$file on standard input: $(cat err)"
    sed 's/"image":"-"/"image":""/' out | cmp -s - first || fail "$file on standard input: another answer"
    checks=$((checks + 1))
done
"$drogue" edges - - --low 40 --high 100 <scene.png >edges.png || fail 'edges from and to standard streams'
"$canny_check" scene.png edges.png 40 100 0 >found || fail "edges on standard output: $(cat found)"
run 0 measure scene.png $camera $roi $model --overlay over.png
"$drogue" measure scene.png $camera $roi $model --overlay - >streamed.png || fail 'overlay to standard output'
cmp -s over.png streamed.png || fail 'overlay on standard output: another picture'
run 2 track scene.png $camera --overlay -
says 'numbered'

# Unsound PGM.
for header in 'P5 0 1 255 ' 'P5 1 1 0 ' 'P5 1 1 65536 ' 'P5 1 x 255 ' 'P5' 'P5 9999999 1 255 ' 'P5 1000000 999999 255 ' 'P2 1 1 255 1' 'P7 '; do
    printf '%sx' "$header" >bad.pgm
    run 2 measure bad.pgm $camera
    says 'drogue: bad.pgm: '
done
# The pixels decide, whatever a side is: 2^26 are read.
for size in '1000000 1' '1 67108864'; do
    printf 'P5 %s 255 x' "$size" >bad.pgm
    run 2 measure bad.pgm $camera
    says 'ends early'
done
for size in '1 67108865' '99999999 1'; do
    printf 'P5 %s 255 x' "$size" >bad.pgm
    run 2 measure bad.pgm $camera
    says 'more than the 67108864 that are read'
done
for number in 000000001 123456789; do
    printf 'P5 %s 1 255 x' $number >bad.pgm
    run 2 measure bad.pgm $camera
    says 'no sound header'
done
{ printf 'P5 1000000 1 255 ' && head -c 1000000 /dev/zero; } >row.pgm
run 1 measure row.pgm $camera --roi 100,0,100,1
head -c 1000 scene.pgm >bad.pgm
run 2 measure bad.pgm $camera
says 'ends early'
printf 'P5 1 1 3 \004' >bad.pgm
run 2 measure bad.pgm $camera
says 'more than the 3'

# What is not read, by name.
printf '\377\330\377\340....JFIF' >a.jpg
run 2 measure a.jpg $camera
says 'JPEG'
says 'ffmpeg'
printf '....ftypisom' >a.mp4
run 2 track a.mp4 $camera
says 'rawvideo'

# Folders in the order of names, images alone; streams; raw video: the same lines but for the names.
names() { sed -E 's/"image":"[^"]*"/"image":""/g' out; }
# shellcheck disable=SC2086
run 0 track $frames $camera $roi $model
names >first
mkdir frames
# shellcheck disable=SC2086
cp $frames frames
echo text >frames/notes.txt
run 0 track frames $camera $roi $model
names | cmp -s - first || fail 'a folder: other lines'
same "$(json image | sed -n 2p)" '"frames/frame01.png"'
# shellcheck disable=SC2086
cat $frames >stream
"$drogue" track - $camera $roi $model <stream >out 2>err || fail "a stream of PNG: $(cat err)"
names | cmp -s - first || fail 'a stream of PNG: other lines'
"$drogue" track - $camera $roi $model --raw 320,240,gray8 <gray8 >out 2>err || fail "gray8: $(cat err)"
names | cmp -s - first || fail 'gray8: other lines'
run 0 track gray8 $camera $roi $model --raw 320,240,gray8
names | cmp -s - first || fail 'gray8 from a file: other lines'
run 0 track nv12 $camera $roi $model --raw 320,240,nv12
names | cmp -s - first || fail 'nv12: other lines'
run 0 track yuyv $camera $roi $model --raw 320,240,yuyv
names | cmp -s - first || fail 'yuyv: other lines'
[ ! -s err ] || fail "progress without a terminal: $(cat err)"
head -c 100000 gray8 >part
run 2 track part $camera $roi $model --raw 320,240,gray8
says 'ends within a frame'
: >nothing
run 2 track nothing $camera --raw 320,240,gray8
says 'no frame'
run 2 track - scene.png $camera
says 'stand alone'
run 2 track gray8 gray8 $camera --raw 320,240,gray8
says 'stand alone'
run 2 track frames $camera --raw 320,240,gray8
says 'drogue: frames: is a folder'
[ ! -s out ] || fail 'a folder of raw video: lines before the refusal'
mkdir empty
run 2 track empty $camera
says 'a folder without'
for raw in 320,240 320,240,rgb 320,240,gray8,1 0,240,gray8 321,240,yuyv 320,241,nv12 x,240,gray8 40000,1,gray8 ''; do
    run 2 track gray8 $camera --raw "$raw"
    says '--raw'
done

# Progress on a terminal.
if command -v script >/dev/null; then
    script -qec "'$drogue' track $frames $camera $roi $model >out" terminal >/dev/null 2>&1
    grep -q 'frame 4 of 4' terminal || fail 'no progress on a terminal'
    checks=$((checks + 1))
fi

finish
