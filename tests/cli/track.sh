# SPDX-License-Identifier: Apache-2.0
# drogue track: found, followed, coasting, lost, found again; lines at once; rates; bad frames.
. "$(dirname "$0")/common.sh"
model=--drogue=0.35,0.175,0.02
seen='frame00.png frame01.png frame02.png frame03.png'
gone='frame04.png frame05.png frame06.png frame07.png frame08.png frame09.png frame10.png frame11.png frame12.png frame13.png frame14.png frame15.png'

# Lines to one line of words
words() {
    tr '\n' ' ' | sed 's/ $//'
}

# Nothing, then four frames two pixels apart, then twelve without, then found again.
# shellcheck disable=SC2086
run 0 track frame04.png $seen $gone frame00.png $camera $roi $model
same "$(json state | words)" '"lost" "tracking" "tracking" "tracking" "tracking" "coasting" "coasting" "coasting" "coasting" "coasting" "coasting" "coasting" "coasting" "coasting" "coasting" "lost" "lost" "tracking"'
same "$(json image | words)" "$(for f in frame04.png $seen $gone frame00.png; do printf '"%s"\n' "$f"; done | words)"
same "$(json raw.image)" "$(json image)"
same "$(json frame | words)" "$(seq 18 | words)"
same "$(json time_s | sed -n '1p;2p;4p;18p' | words)" '0.0 0.033333 0.1 0.566667'
says '13 of 18 frames: no_edges: '
same "$(json raw.status | sed -n '1p;2p;6p' | words)" '"no_edges" "ok" "no_edges"'
same "$(json filtered | grep -c null)" 3
same "$(json raw.position_m | grep -c null)" 13
same "$(json roi | sed -n '1p;2p;17p;18p' | words)" '[60,18,200,200] [60,18,200,200] [60,18,200,200] [60,18,200,200]'
json roi | sed -n 4p | grep -qE '^\[6[0-9],1[0-9],2[01][0-9],2[01][0-9]\]$' || fail "region of the third frame: $(json roi | sed -n 4p)"
"$json_check" filtered.position_m filtered.velocity_mps filtered.axis filtered.yaw_deg filtered.pitch_deg <out >/dev/null 2>&1 &&
    fail 'a lost frame has an estimate'
sed -n 5p out >fifth && mv fifth out
near "$(json filtered.position_m.0)" '3.5 * 6.5 / 800' 0.001
near "$(json filtered.position_m.2)" 3.5 0.01
near "$(json filtered.velocity_mps.0)" '3.5 * 2 / 800 * 30' 0.02
near "$(json filtered.velocity_mps.1)" 0 0.01
near "$(json filtered.axis.2)" 1 0.001
near "$(json filtered.yaw_deg)" 0 1
near "$(json filtered.pitch_deg)" 0 1
near "$(json filtered.position_std_m.0)" 0.0005 0.0005
near "$(json filtered.position_std_m.1)" 0.0005 0.0005
near "$(json filtered.position_std_m.2)" 0.003 0.003
near "$(json filtered.axis_std_deg)" 2.2 1
near "$(json filtered.axis_std_deg) ^ 2" "$(json filtered.yaw_std_deg) ^ 2 + $(json filtered.pitch_std_deg) ^ 2" 0.001
same "$(json gated)" false
same "$(json filtered.orientation_resolved)" true
cp out at_30

# As many missed frames as asked for.
# shellcheck disable=SC2086
run 0 track $seen frame04.png frame05.png frame06.png $camera $roi $model --max-missed 2
same "$(json state | words)" '"tracking" "tracking" "tracking" "tracking" "coasting" "coasting" "lost"'
run 0 track frame00.png frame04.png $camera $roi $model --max-missed=0
same "$(json state | words)" '"tracking" "lost"'

# Standard deviations grow while it is not seen.
# shellcheck disable=SC2086
run 0 track $seen frame04.png frame05.png frame06.png $camera $roi $model
json filtered.position_std_m.0 | sed -n '4,$p' >grown
sort -g grown | cmp -s - grown || fail "standard deviations while coasting: $(words <grown)"
same "$(sort -gu grown | wc -l | tr -d ' ')" 4

# Without a region the whole frame is searched, and followed from there.
# shellcheck disable=SC2086
run 0 track frame04.png $seen $camera $model
same "$(json state | words)" '"lost" "tracking" "tracking" "tracking" "tracking"'
same "$(json roi | sed -n 1p)" '[0,0,320,240]'
json roi | sed -n 2p | grep -qE '^\[[0-9]+,[0-9]+,([12][0-9][0-9]),\1\]$' || fail "region of the search: $(json roi | sed -n 2p)"
sed -n 5p out >fifth && mv fifth out
near "$(json filtered.position_m.2)" 3.5 0.01
near "$(json filtered.velocity_mps.0)" '3.5 * 2 / 800 * 30' 0.02

# The rate of frames is the clock; 30 is the default, decimals count.
# shellcheck disable=SC2086
for rate in 60 7.5 29.97; do
    run 0 track $seen $camera $roi $model --fps=$rate
    sed -n 4p out >fourth && mv fourth out
    near "$(json filtered.velocity_mps.0)" "3.5 * 2 / 800 * $rate" "0.003 * $rate"
done
# shellcheck disable=SC2086
run 0 track $seen $camera $roi $model
cp out first
# shellcheck disable=SC2086
run 0 track $seen $camera $roi $model --fps 30 --json
cmp -s out first || fail '--fps 30 is not the default'
# shellcheck disable=SC2086
run 0 track $seen $camera $roi $model --fps 29.97
cmp -s out first && fail '29.97 frames a second are taken as 30'

# Times are of the frames, and not of a rounded step: whole seconds at any rate, the last frame's exact.
head -c $((16 * 16 * 145)) /dev/zero >frames.raw
# shellcheck disable=SC2086
for rate in 144 144.000 48 12 7; do
    run 1 track frames.raw --raw 16,16,gray8 $camera --fps $rate
    same "$(json time_s | sed -n 145p)" "$(awk "BEGIN { s = sprintf(\"%.6f\", 144 / $rate); sub(/0+\$/, \"\", s); sub(/\\.\$/, \".0\", s); print s }")"
done
for rate in 700000 1e6; do
    run 1 track frames.raw --raw 16,16,gray8 $camera --fps $rate
    near "$(json time_s | sed -n 145p)" "144 / $rate" 0.0000005
done

# Nothing measured in any frame.
run 1 track black.png black.png white.png $camera
same "$(json state | words)" '"lost" "lost" "lost"'
same "$(json roi | words)" '[0,0,64,48] [0,0,64,48] [0,0,64,48]'
run 1 track black.png $camera --roi -9,-8,7,6
same "$(json roi)" '[-9,-8,7,6]'
same "$(json raw.status)" '"region"'

# A bad frame ends it; what was printed stays.
run 2 track frame00.png frame01.png missing.png frame02.png $camera $roi $model
says 'drogue: missing.png: '
same "$(json image | words)" '"frame00.png" "frame01.png"'
run 2 track frame00.png black.png $camera $roi $model
says 'drogue: black.png: 64x48'
same "$(json image)" '"frame00.png"'

# One overlay a frame.
run 0 track frame00.png frame01.png frame04.png $camera $roi $model --overlay ./over.lay.png
for n in 1 2 3; do
    [ -s over.lay-000$n.png ] || fail "no overlay of frame $n"
done
run 0 track frame00.png $camera $roi $model --overlay plain
[ -s plain-0001 ] || fail 'no overlay for a name without an ending'

# A line is there as soon as its frame is done: the second frame is not, and the first line is.
mkfifo late.png
"$drogue" track frame00.png late.png $camera $roi $model >late.out 2>late.err &
tracker=$!
waited=0
while [ ! -s late.out ] && [ $waited -lt 100 ]; do
    sleep 0.1
    waited=$((waited + 1))
done
same "$(wc -l <late.out | tr -d ' ')" 1
cat frame01.png >late.png
wait $tracker
same $? 0
same "$(wc -l <late.out | tr -d ' ')" 2

finish
