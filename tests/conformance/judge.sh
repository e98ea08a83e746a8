#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The judge of other people's results, and the command line of the runner.
# usage: judge.sh CONFORMANCE TINY_VECTORS README    (of the vectors: what it says of names must hold)
set -euo pipefail
conformance=$1
tiny=$2
readme=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$tiny" "$work/vectors"
status=0

# expect STATUS ARGUMENT... : TEXT...
expect() {
    local expected=$1 got=0 arguments=() text
    shift
    while [ "$1" != : ]; do
        arguments+=("$1")
        shift
    done
    shift
    "$conformance" --vectors "$work/vectors" "${arguments[@]}" >"$work/out" 2>&1 || got=$?
    if [ "$got" != "$expected" ]; then
        echo "judge: ${arguments[*]}: exit status $got, expected $expected"
        status=1
    fi
    for text; do
        if ! grep -qF -- "$text" "$work/out"; then
            echo "judge: ${arguments[*]}: '$text' is missing in:"
            cat "$work/out"
            status=1
        fi
    done
}

same=$work/same
cp -R "$work/vectors" "$same"
expect 0 judge arcs "$same" : 'judge: files=2 equal=2 different=0 missing=0'
expect 0 judge arcs/tiny "$same" : 'judge: files=2 equal=2 different=0 missing=0'
expect 0 judge smooth "$same" : 'judge: files=1 equal=1'

flat=$work/flat
mkdir "$flat"
cp "$same"/arcs/*.out.hex "$same"/mask/*.out.png "$flat"
expect 0 judge arcs "$flat" : 'judge: files=2 equal=2'
expect 0 judge mask "$flat" : 'judge: files=1 equal=1'

# The vectors' own files are no results, by whatever way they are named.
expect 1 judge mask "$work/vectors/mask" : 'tiny.ring.out.png: is what is expected, no result' 'different=1'
ln -s "$work/vectors/mask" "$work/other"
expect 1 judge mask "$work/other" : 'is what is expected, no result'
# A picture without its end, and with something behind it.
cp "$flat/tiny.ring.out.png" "$work/whole.png"
truncate -s -12 "$flat/tiny.ring.out.png"
expect 1 judge mask "$flat" : 'tiny.ring.out.png: does not end as a PNG does' 'different=1'
{ cat "$work/whole.png"; echo; } >"$flat/tiny.ring.out.png"
expect 1 judge mask "$flat" : 'tiny.ring.out.png: does not end as a PNG does'
cp "$work/whole.png" "$flat/tiny.ring.out.png"

# A word off, the file one word short, a file missing.
sed -i '5s/.*/0000beef/;7s/.*/0000beef/' "$flat/tiny.arcs.out.hex"
expect 1 judge arcs "$flat" : 'DIFFERENT' 'tiny.arcs.out.hex: line 5: expected ' 'found 0000beef (48879); 2 of ' \
    'judge: files=2 equal=1 different=1 missing=0'
sed -i '$d' "$flat/tiny.edges.out.hex"
expect 1 judge arcs "$flat" : 'tiny.edges.out.hex: ' 'words expected' 'judge: files=2 equal=0 different=2 missing=0'
rm "$flat/tiny.edges.out.hex"
expect 1 judge arcs "$flat" : 'MISSING arcs/tiny.edges.out.hex' 'judge: files=2 equal=0 different=1 missing=1'
expect 1 judge arcs "$work" : 'judge: files=2 equal=0 different=0 missing=2'
echo xxxxxxxx >"$flat/tiny.ellipse.out.hex"
expect 1 judge ellipse "$flat" : "tiny.ellipse.out.hex: line 1: 'xxxxxxxx' is no hexadecimal number"

# Words as $writememh writes them, and in the other forms that $readmemh takes.
memory=$work/memory
mkdir "$memory"
words() { cat "$same/arcs/tiny.edges.out.hex"; }
cp "$same/arcs/tiny.arcs.out.hex" "$memory"
taken() { # TEXT on standard input, taken as the words of tiny.edges
    cat >"$memory/tiny.edges.out.hex"
    expect 0 judge arcs "$memory" : 'judge: files=2 equal=2'
}
refused() { # REASON: the same for what is not to be taken
    cat >"$memory/tiny.edges.out.hex"
    expect 1 judge arcs "$memory" : "tiny.edges.out.hex: $1" 'different=1'
}
count=$(words | wc -l)
shopt -s lastpipe # what a function behind a pipe finds is not lost
{ echo '// 0x00000000'; words | tr a-f A-F; } | taken
words | tr '\n' ' ' | taken
words | sed 's/^\(..\)/\1_/;s/$/\r/' | taken
{ echo '/* two'; echo ' lines */'; words; echo '// no end of the line'; } | head -c -1 | taken
{ printf '@%x\n' $((count - 3)); words | tail -n 3; echo '@0'; words | head -n $((count - 3)); } | taken
words | sed 's/^0*\(.\)/\1/' | taken
{ words; echo 0; } | refused "line $((count + 1)): more than the $count words expected"
words | sed '$d' | refused "$count words expected, $((count - 1)) found"
words | sed '2s/.*/0000000x/' | refused "line 2: '0000000x' is no hexadecimal number"
words | sed '2s/.*/100000000/' | refused "line 2: '100000000' is no hexadecimal number"
{ words; echo '/* open'; } | refused 'a comment has no end'

# Images as words, named as the README says: the mask is 33 x 21, 0 or 255.
rm "$flat"/*.png
as_words=$(sed -nE 's/.*image `NAME\.png` may be words, `(NAME[^`]*)`.*/\1/p' "$readme")
seq 693 | sed s,.*,00, >"$flat/${as_words/NAME/tiny.ring.out}"
expect 1 judge mask "$flat" : 'tiny.ring.out.hex: line 4 (pixel 3, 0): expected ff (255), found 00 (0); 272 of 693' 'different=1'
sed -i '$d' "$flat/tiny.ring.out.hex"
expect 1 judge mask "$flat" : 'tiny.ring.out.hex: 693 words expected, 692 found'

# Command line.
expect 2 judge nothing "$same" : "no stage and no case is named 'nothing'"
expect 2 judge arcs : 'usage:'
expect 2 judge arcs "$work/nowhere" : "conformance: $work/nowhere: No such file"
[ "$(wc -l <"$work/out")" = 1 ] || { echo 'judge: a folder that is not there gives more than a line'; status=1; }
expect 2 judge arcs "$work/vectors" : "conformance: $work/vectors: is the folder of the vectors"
expect 2 judge arcs "$readme" : "conformance: $readme: is no folder"
expect 2 nonsense : 'usage:'
expect 2 --stage nothing : 'there is no stage nothing'
expect 2 --nonsense : 'usage:'
expect 0 --help : 'usage:'
expect 0 --list : 'frame/tiny ordinary'
expect 0 --stage ellipse --list : 'ellipse/tiny ordinary'
expect 0 --stage ellipse : 'conformance: cases=1 exact=0 failed=0 digest='
exit $status
