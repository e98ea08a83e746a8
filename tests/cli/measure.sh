# SPDX-License-Identifier: Apache-2.0
# drogue measure: the known pose of a drawn scene, JSON and table, region, overlay.
. "$(dirname "$0")/common.sh"
model=--drogue=0.35,0.175,0.02

# A disc of radius 80 px and 0.35 m about (161.25, 118.5), seen head-on with f = 800 px, stands at 3.5 m.
run 0 measure scene.png $camera $roi $model --json
same "$(wc -l <out | tr -d ' ')" 1
same "$(json image)" '"scene.png"'
same "$(json status)" '"ok"'
same "$(json polarity)" '"dark"'
same "$(json orientation_resolved)" true
near "$(json ellipse.xc)" 161.25 0.02
near "$(json ellipse.yc)" 118.5 0.02
near "$(json ellipse.a)" 80 0.05
near "$(json ellipse.b)" 80 0.05
near "$(json reliability)" 1 0.1
near "$(json inner_centre.x)" 161.25 0.05
near "$(json inner_centre.y)" 118.5 0.05
near "$(json position_m.0)" '3.5 * 1.75 / 800' 0.001
near "$(json position_m.1)" '3.5 * -1 / 800' 0.001
near "$(json position_m.2)" 3.5 0.005
near "$(json axis.2)" 1 0.001
near "$(json yaw_deg)" 0 1
near "$(json pitch_deg)" 0 1
near "$(json alternative.position_m.2)" 3.5 0.005
near "$(json alternative.axis.2)" 1 0.01
near "$(json ambiguity)" 0.5 0.5
near "$(json ellipse.angle_deg)" 0 90.001
# Each real number has a decimal and no more digits than it needs; seven are whole: region, outside, arcs, cluster_members.
tr ',:[]{}' '\n\n\n\n\n\n' <out | grep -E '^-?[0-9]' >all_numbers
same "$(grep -cE '^[0-9]+$' all_numbers)" 7
grep -vE '^[0-9]+$' all_numbers >numbers
same "$(grep -cE '^-?(0|[1-9][0-9]*)\.([0-9]|[0-9]{1,8}[1-9])(e[-+][0-9]{2})?$' numbers)" "$(wc -l <numbers | tr -d ' ')"
# The covariance is symmetric, and its diagonal the square of what is stated beside it.
for i in 0 1 2 3 4; do
    for j in 0 1 2 3 4; do
        same "$(json covariance.$i.$j)" "$(json covariance.$j.$i)"
    done
done
for i in 0 1 2; do
    near "$(json position_std_m.$i) ^ 2 / $(json covariance.$i.$i)" 1 0.0001
done
near "$(json axis_std_deg)" "sqrt($(json covariance.3.3) + $(json covariance.4.4)) * 180 / atan2(0, -1)" 0.0002
near "$(json axis_std_deg)" 1.7 0.7 # head-on, the inner part only 2 cm behind: 0.1 px of its centre
near "$(json position_std_m.2)" 0.0005 0.0004
"$json_check" covariance.5 <out >/dev/null 2>&1 && fail 'covariance of more than five rows'
"$json_check" covariance.4.5 <out >/dev/null 2>&1 && fail 'covariance of more than five columns'
# yaw and pitch belong to the axis: n = (sin yaw cos pitch, sin pitch, cos yaw cos pitch).
near "$(json axis.1)" "sin($(json pitch_deg) * atan2(0, -1) / 180)" 0.0001
near "$(json axis.0)" "sin($(json yaw_deg) * atan2(0, -1) / 180) * cos($(json pitch_deg) * atan2(0, -1) / 180)" 0.0001

# Without a region the drogue is searched for.
run 0 measure scene.png $camera $model --json --overlay found.png
near "$(json ellipse.xc)" 161.25 0.02
near "$(json ellipse.a)" 80 0.05
near "$(json inner_centre.x)" 161.25 0.05
near "$(json position_m.2)" 3.5 0.005

# The background may be darker than the drogue, or both.
for polarity in bright mixed; do
    run 0 measure scene_$polarity.png $camera $roi $model --json
    same "$(json polarity)" "\"$polarity\""
    near "$(json ellipse.xc)" 161.25 0.05
    near "$(json ellipse.yc)" 118.5 0.05
    near "$(json ellipse.a)" 80 0.1
    near "$(json position_m.2)" 3.5 0.005
done
run 0 measure scene_mixed.png $camera $roi $model
prints 'mixed'

# The keys are all there when nothing is found.
run 1 measure black.png $camera --json
same "$(json status)" '"no_edges"'
same "$(json second_look)" '"none"'
for key in ellipse reliability cover outside arcs cluster_members polarity inner_centre position_m axis yaw_deg pitch_deg alternative orientation_resolved ambiguity doubt log_odds \
    covariance position_std_m axis_std_deg; do
    same "$(json $key)" null
done

# Log odds as drogue/search.h has them, of a disc of 39.77 px by 0.175 m of 0.35 and 0.02 behind 3.5, which most rays see and
# spread by less than 0.13 px. What is not sure has them, too; of an outline without disc they are -3 and the cover; by a model without one, none.
run 0 measure scene.png $camera $roi $model --json
same "$(json outside)" 0
near "$(json log_odds)" "(5 * (5 + 7.77 / 32) + 9 + 10 - 7 * $(json ambiguity) + 3) / 4 - 5 - 0.25" 0.25
demo='--camera 1465.5,1465.5,403.5,143.5 --drogue 0.35,0.12,0.25 --json'
# shellcheck disable=SC2086 # words of a command line
run 1 measure "$root/vectors/frame/banded-rim-0.image.png" $demo
same "$(json status)" '"unsure"'
same "$(json position_m)" null
near "$(json log_odds)" "-3 + $(json cover)" 0.00002
run 0 measure scene_alone.png $camera $roi $model --json
near "$(json log_odds)" "-3 + $(json cover)" 0.00002
# shellcheck disable=SC2086
run 1 measure "$root/vectors/frame/noisy-rim-0.image.png" $demo
same "$(json status)" '"unsure"'
same "$(json outside)" 7
near "$(json log_odds)" -1.2 0.1
for unknown in '' --drogue=0.35; do
    # shellcheck disable=SC2086 # none is no word
    run 0 measure scene.png $camera $roi $unknown --json
    same "$(json log_odds)" null
    same "$(json outside)" 0
done
# shellcheck disable=SC2086
run 1 measure "$root/vectors/frame/demo.png" $demo --min-reliability 1
same "$(json status)" '"unreliable"'
[ "$(json log_odds)" != null ] || fail 'an unreliable result has no log odds'
run 0 track scene_alone.png $camera $roi $model --csv
same "$(awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i } NR == 2 { print $at["raw.outside"], $at["raw.log_odds"] + 3 == $at["raw.cover"] }' out)" '0 1'

# Without the inner part the orientation stays open; without --drogue lengths are rim radii.
run 0 measure scene.png $camera $roi --drogue 0.35 --json
same "$(json orientation_resolved)" false
same "$(json inner_centre)" null
near "$(json position_m.2)" 3.5 0.005
run 0 measure scene.png $camera $roi --json
near "$(json position_m.2)" 10 0.015

# The smallest rim that is taken: rounded to a multiple of 1/65536, 0.05 % less than given.
run 0 measure scene.png $camera $roi --drogue 0.01 --json
near "$(json position_m.2)" 0.1 0.0002

# The lens: distortion moves the ideal outline, not the one seen.
run 0 measure scene.png $camera $roi --json --distortion 0.5,0,0,0,0
near "$(json ellipse.a)" 80 0.05
near "$(json position_m.2)" 10.05 0.04

# The table.
run 0 measure scene.png $camera $roi $model
same "$(head -n 1 out)" 'scene.png: ok'
for line in 'polarity               dark' 'length_unit            m' 'orientation_resolved   true' '  position_m '; do
    prints "$line"
done
run 0 measure scene.png $camera $roi
prints 'rim radii'
same "$(head -n 1 out)" 'scene.png: ok, orientation unresolved: either pose, this or the alternative'
run 1 measure black.png $camera
same "$(head -n 1 out)" 'black.png: no_edges'
says 'drogue: black.png: no_edges: no edge'

# Regions: past the image is clipped, outside it is nothing measurable.
run 0 measure scene_cut.png $camera --roi 0,-30,200,200 --json --overlay over.png
near "$(json ellipse.xc)" 100 0.1
near "$(json ellipse.yc)" 70 0.1
near "$(json ellipse.b)" 80 0.2
run 1 measure scene.png $camera --roi 320,0,50,50 --json --overlay over.png
same "$(json status)" '"region"'
run 1 measure scene.png $camera --roi -50,-50,50,50 --json --overlay over.png
same "$(json status)" '"region"'
run 1 measure scene.png $camera --roi -1048576,1048576,8192,8192 --json --overlay over.png
same "$(json status)" '"region"'
run 1 measure scene.png $camera --roi 5,5,1,1 --json --overlay over.png

# File names become proper JSON strings, whatever bytes they have.
for name in 'quote".png' 'back\slash.png' "$(printf 'tab\tline\nend\001.png')" "$(printf 'gr\303\274n.png')" \
    "$(printf '\342\202\254\360\237\233\251.png')"; do
    cp black.png "$name"
    run 1 measure "$name" $camera --json
    "$json_check" <out || fail "file name $name"
done
same "$(json image)" "$(printf '"\342\202\254\360\237\233\251.png"')"
for bytes in '\377' '\300\257' '\355\240\200' '\364\220\200\200' '\340\200\200' '\303' '\200'; do
    # shellcheck disable=SC2059
    name=$(printf "a${bytes}z.png")
    cp black.png "$name"
    run 1 measure "$name" $camera --json
    grep -qF 'a\ufffd' out || fail "bytes $bytes: $(cat out)"
    "$json_check" <out || fail "bytes $bytes"
done
cp black.png 'quote".png'
run 1 measure 'quote".png' $camera --json
same "$(json image)" '"quote\".png"'

# The overlay is another picture for what was found, wide enough to read, and the answer is the same.
run 0 measure scene.png $camera $roi $model --json
cp out first
run 0 measure scene.png $camera $roi $model --json --overlay found.png
cmp -s out first || fail 'another answer with --overlay'
same "$(png_side found.png 16)" 640
[ "$(png_side found.png 20)" -gt 480 ] || fail 'no room for words'
run 0 measure scene.png $camera $roi --overlay unresolved.png
run 1 measure scene.png $camera --roi 0,0,30,30 --overlay nothing.png
cmp -s found.png unresolved.png && fail 'overlays do not show the orientation'
cmp -s found.png nothing.png && fail 'overlays do not show what was found'
run 1 measure one.png $camera --overlay over.png
[ "$(png_side over.png 16)" -ge 640 ] || fail 'the overlay of one pixel is too small to read'
run 1 measure wide.png $camera --roi 5000,0,100,1 --overlay over.png
[ "$(png_side over.png 16)" -lt 3300 ] || fail 'the overlay of a large image is not cropped'

finish
