# SPDX-License-Identifier: Apache-2.0
# No command writes over a file that it reads, under whatever name, and it says so before it writes anything.
. "$(dirname "$0")/common.sh"
model=--drogue=0.35,0.175,0.02

# kept FILE: the same as scene.png
kept() {
    checks=$((checks + 1))
    cmp -s "$1" scene.png || fail "$1 was written over"
}

cp scene.png same.png
ln same.png link.png
ln -s same.png symbolic.png
mkdir sub
for out in same.png ./same.png sub/../same.png link.png symbolic.png; do
    run 2 measure same.png $camera $roi $model --overlay $out
    says "drogue: $out: is read as input"
    [ ! -s out ] || fail "$out: output before the refusal"
    run 2 edges same.png $out --low 40 --high 100
    says "drogue: $out: is read as input"
    kept same.png
done

# A numbered overlay meets a frame, the last one too: nothing is drawn at all.
for i in 1 2 3; do
    cp scene.png f-000$i.png
done
run 2 track f-0001.png f-0002.png f-0003.png $camera $roi $model --overlay f.png
says 'drogue: f-0001.png: is read as input'
run 2 track scene.png same.png f-0003.png $camera $roi $model --overlay f.png
says 'drogue: f-0003.png: is read as input'
for i in 1 2 3; do
    kept f-000$i.png
done

# Standard input is a file, too, and a stream has more frames than files.
run 2 measure - $camera $roi $model --overlay same.png <same.png
says 'drogue: same.png: is read as input'
run 2 edges - same.png --low 40 --high 100 <same.png
kept same.png
run 2 track - $camera $roi $model --overlay f.png <f-0003.png
says 'drogue: f-0003.png: is read as input'
run 2 track f-0002.png --raw 16,16,gray8 $camera --overlay f.png
says 'drogue: f-0002.png: is read as input'
kept f-0002.png
kept f-0003.png

# What is there but not read is replaced as ever.
run 0 track scene.png same.png $camera $roi $model --overlay f.png
cmp -s f-0001.png scene.png && fail 'an overlay was not written'
kept f-0003.png
run 0 measure scene.png $camera $roi $model --overlay f-0003.png

finish
