# SPDX-License-Identifier: Apache-2.0
# JSON, table and CSV hold the same members with the same values; docs/program.md names each member and status; a region
# too wide is searched; an unreliable result is none.
. "$(dirname "$0")/common.sh"
model=--drogue=0.35,0.175,0.02

# leaves: names and values of a JSON line, a line each, in the order of CSV
leaves() {
    python3 -c '
import json, sys
def walk(value, name):
    if isinstance(value, dict):
        for key in value: walk(value[key], f"{name}.{key}" if name else key)
    elif isinstance(value, list):
        for i, item in enumerate(value): walk(item, f"{name}.{i}")
    else:
        print(name, value if isinstance(value, str) else json.dumps(value))
walk(json.loads(sys.stdin.read(), parse_float=str, parse_int=str), "")'
}
csv_leaves() {
    python3 -c '
import csv, sys
names, values = csv.reader(sys.stdin)
assert len(names) == len(values) == len(set(names))
for pair in zip(names, values): print(*pair)'
}

run 0 measure scene.png $camera $roi $model --json
leaves <out >json_leaves
run 0 measure scene.png $camera $roi $model --csv
csv_leaves <out >csv_leaves
cmp json_leaves csv_leaves || fail 'CSV is not JSON'
run 0 measure scene.png $camera $roi $model
tr -s ' ,\n' '\n\n\n' <out | grep -v '^$' >table_words
sed 's/^[^ ]* //' json_leaves | tr -s ' ' '\n' | sed '2d' >values
while read -r value; do
    grep -qxF -- "$value" table_words || grep -qF -- "$value" out || fail "the table has no $value"
done <values
checks=$((checks + 1))
same "$(grep -cE '^ *[a-z_]+ ' out)" "$(sed -E 's/ .*//;s/(\.[0-9]+)+$//' json_leaves | sort -u | grep -cvE '^(image|status)$')"

# Names that need quotes; unknown members are empty, as many as ever.
cp black.png 'a,"b".png'
run 1 measure 'a,"b".png' $camera --csv
csv_leaves <out >empty_leaves
same "$(sed -n 1p empty_leaves)" 'image a,"b".png'
same "$(sed 's/ .*//' empty_leaves)" "$(sed 's/ .*//' csv_leaves)"
run 0 track frame00.png frame01.png frame04.png $camera $roi $model --csv
same "$(wc -l <out | tr -d ' ')" 4
same "$(awk -F, '{ print NF }' out | sort -u | wc -l | tr -d ' ')" 1

# Every member of both commands has its place in docs/program.md, and so has every status.
run 0 track frame00.png $camera $roi $model
leaves <out | sed -E 's/ .*//;s/(\.[0-9]+)+$//' | tr . '\n' | sort -u >names
while read -r name; do
    grep -qF -- "\`$name\`" "$root/docs/program.md" || fail "docs/program.md does not name $name"
done <names
sed -n '/^A line of `track`/,/^## /p' "$root/docs/program.md" >line_of_track
python3 -c 'import json, sys; print(*json.loads(sys.stdin.read()), sep="\n")' <out >names
while read -r name; do
    grep -qE "^\|.*\`$name\`.*\|.*\|" line_of_track || fail "docs/program.md does not have $name in a line of track"
done <names
sed -nE 's/.*case DROGUE_E_[A-Z_]+: return "([a-z_]+)";/\1/p' "$root/src/status.c" >statuses
[ "$(wc -l <statuses)" -ge 14 ] || fail 'no statuses found'
echo unreliable >>statuses
while read -r status; do
    grep -qF -- "| \`$status\` |" "$root/docs/program.md" || fail "docs/program.md does not explain $status"
done <statuses
checks=$((checks + 2))

# A region too wide holds no outline of its size: it is searched, and that is said.
for wide in 1,0,318,238 20,0,270,238; do
    "$drogue" measure scene.png $camera --roi $wide $model --json >out 2>err || fail "--roi $wide: $(cat err)"
    near "$(json ellipse.xc)" 161.25 0.05
    if [ "$(json searched)" = true ]; then
        says 'found by a search within --roi'
    else
        [ ! -s err ] || fail "--roi $wide: $(cat err)"
    fi
done
"$drogue" measure scene_large.png $far_camera --roi 1900,0,600,240 $model --json >out 2>err || fail "a wide region: $(cat err)"
same "$(json searched)" true
says 'found by a search within --roi'
near "$(json ellipse.xc)" 2241.25 0.05
run 1 measure noise.png $camera --roi 0,0,30,30 --json
same "$(json searched)" false

# A measurement below the least reliability is none, but its outline stays.
run 0 measure scene.png $camera $roi $model --json --min-reliability 0.9
run 0 measure scene_cut.png $camera --roi 0,-30,200,200 --json
reliability=$(json reliability)
run 1 measure scene_cut.png $camera --roi 0,-30,200,200 --json --min-reliability "$(awk "BEGIN { print $reliability + 0.001 }")"
same "$(json status)" '"unreliable"'
same "$(json position_m)" null
near "$(json reliability)" "$reliability" 0
says 'unreliable: '

# Its overlay shows no pose, either: the same picture whatever the rim's radius, and another one than with a pose.
unseen='--roi 0,-30,200,200 --min-reliability 1'
for command in measure track; do
    for radius in 0.35 0.7; do
        # shellcheck disable=SC2086
        run 1 $command scene_cut.png $camera $unseen --drogue $radius --overlay $command-$radius.png
    done
done
run 0 measure scene_cut.png $camera --roi 0,-30,200,200 --drogue 0.35 --overlay pose.png
cmp -s measure-0.35.png measure-0.7.png || fail 'measure: the overlay of an unreliable result shows a pose'
cmp -s track-0.35-0001.png track-0.7-0001.png || fail 'track: the overlay of an unreliable result shows a pose'
cmp -s measure-0.35.png pose.png && fail 'the overlay of an unreliable result says that it is measured'
checks=$((checks + 3))

# A frame of a track below it is missed; of one that is reliable enough nothing changes.
cut='track scene_cut.png scene_cut.png --roi 0,-30,200,200'
# shellcheck disable=SC2086
run 0 $cut $camera
cp out plain
same "$(json state | tr '\n' ' ')" '"tracking" "tracking" '
reliability=$(json raw.reliability | sort -g | head -n 1)
# shellcheck disable=SC2086
run 0 $cut $camera --min-reliability "$(awk "BEGIN { print $reliability - 0.001 }")"
cmp -s out plain || fail 'a least reliability that all frames have changes a track'
# shellcheck disable=SC2086
run 1 $cut $camera --min-reliability "$(awk "BEGIN { print $reliability + 0.001 }")"
same "$(json state | tr '\n' ' ')" '"lost" "lost" '
same "$(json raw.status | tr '\n' ' ')" '"unreliable" "unreliable" '
same "$(json raw.position_m | tr '\n' ' ')" 'null null '
says '2 of 2 frames: unreliable: its reliability is below --min-reliability'

# The twins alike: each has all of a pose.
run 0 measure scene.png $camera $roi --drogue 0.35 --json
for key in position_m axis yaw_deg pitch_deg; do
    [ "$(json alternative.$key)" != null ] || fail "the alternative has no $key"
done

finish
