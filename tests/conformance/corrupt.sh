#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Spoils a copy of a small set of vectors in every way that the runner must notice, and looks for the message.
# usage: corrupt.sh CONFORMANCE TINY_VECTORS
set -euo pipefail
conformance=$1
tiny=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$tiny" "$work/clean"
status=0
tried=0

# spoiled WHAT STATUS TEXT...: run on the copy in $copy; the exit status and each text must be there
spoiled() {
    local what=$1 expected=$2 got=0 text
    shift 2
    "$conformance" --vectors "$copy" >"$work/out" 2>&1 || got=$?
    tried=$((tried + 1))
    if [ "$got" != "$expected" ]; then
        echo "corrupt: $what: exit status $got, expected $expected"
        status=1
    fi
    if [ "$expected" = 2 ] && [ "$(wc -l <"$work/out")" != 1 ]; then
        echo "corrupt: $what: not a single line"
        status=1
    fi
    for text; do
        if ! grep -qF -- "$text" "$work/out"; then
            echo "corrupt: $what: '$text' is missing in:"
            head -n 3 "$work/out"
            status=1
        fi
    done
    rm -rf "$copy"
}

fresh() {
    copy=$work/copy
    cp -R "$work/clean" "$copy"
}

# edit SED_SCRIPT: change the manifest, which must differ after
edit() {
    sed -i "$1" "$copy/manifest.json"
    if cmp -s "$copy/manifest.json" "$work/clean/manifest.json"; then
        echo "corrupt: nothing changed: $1"
        status=1
    fi
}

# resign FILE: put the file's new SHA-256 into the manifest
resign() {
    local sum
    sum=$(sha256sum "$copy/$1")
    edit "\\|\"$1\"|s/\"sha256\": \"[0-9a-f]*\"/\"sha256\": \"${sum%% *}\"/"
}

# flip FILE OFFSET: change one bit of the byte
flip() {
    local byte
    byte=$(od -An -tu1 -j "$2" -N 1 "$copy/$1")
    printf "\\$(printf %03o $((byte ^ 1)))" | dd of="$copy/$1" bs=1 seek="$2" conv=notrunc status=none
}

fresh
spoiled 'nothing' 0 'conformance: cases=17 exact=9 failed=0 digest='

# Files.
points=ellipse/tiny.points.hex
image=smooth/tiny.image.png
fresh && flip $points 3
spoiled 'bit in words' 2 "ellipse/tiny: inputs points: file $points: SHA-256"
fresh && flip $image 200
spoiled 'bit in a PNG' 2 "smooth/tiny: inputs image: file $image: SHA-256"
fresh && flip $image 200 && resign $image
spoiled 'unsound PNG' 2 "smooth/tiny: inputs image: file $image: is no sound PNG"
fresh && cp "$copy/VERSION" "$copy/$image" && resign $image
spoiled 'no PNG' 2 "smooth/tiny: inputs image: file $image: is no PNG"
fresh && rm "$copy/$points"
spoiled 'missing words' 2 "ellipse/tiny: inputs points: file $points: cannot be opened"
fresh && rm "$copy/smooth/tiny.image.out.png"
spoiled 'missing PNG' 2 'smooth/tiny: exact image: file smooth/tiny.image.out.png: cannot be opened'
fresh && sed -i 2s/./G/ "$copy/$points" && resign $points
spoiled 'no digit' 2 "ellipse/tiny: inputs points: file $points: line 2 is not 4 lower-case"
fresh && sed -i 3s/^/0/ "$copy/$points" && resign $points
spoiled 'digit too many' 2 "ellipse/tiny: inputs points: file $points: line 3 is not 4 lower-case"
fresh && sed -i 's/$/\r/' "$copy/$points" && resign $points
spoiled 'carriage return' 2 "ellipse/tiny: inputs points: file $points: line 1 is not 4"
fresh && truncate -s -1 "$copy/$points" && resign $points
spoiled 'no end of line' 2 "ellipse/tiny: inputs points: file $points: line 16 is not 4"
fresh && echo 0000 >>"$copy/$points" && resign $points
spoiled 'word too many' 2 "ellipse/tiny: inputs points: file $points: 16 words expected, 17 found"

# Fields.
fresh && edit "\\|$points|s/\"count\": 16/\"count\": 15/"
spoiled 'wrong count' 2 "ellipse/tiny: inputs points: file $points: 15 words expected, 16 found"
fresh && edit "\\|$points|s/\"bits\": 16/\"bits\": 32/"
spoiled 'wrong bits' 2 "ellipse/tiny: inputs points: file $points: line 1 is not 8"
fresh && edit "\\|$points|s/\"bits\": 16/\"bits\": 12/"
spoiled 'odd bits' 2 "ellipse/tiny: inputs points: field 'bits'"
fresh && edit "\\|$image|s/\"bits\": 8/\"bits\": 16/"
spoiled 'bits of an image' 2 "smooth/tiny: inputs image: field 'bits'"
fresh && edit "\\|$image|s/\"width\": 96/\"width\": 95/"
spoiled 'wrong width' 2 "smooth/tiny: inputs image: file $image: 95 x 96 pixels expected, 96 x 96 found"
fresh && edit "\\|$image|s/\"height\": 96, //"
spoiled 'no height' 2 "smooth/tiny: inputs image: fields 'width' and 'height' are missing"
fresh && edit "\\|$points|s/\"bits\"/\"colour\": 1, \"bits\"/"
spoiled 'unknown field of an array' 2 "ellipse/tiny: inputs points: unknown field 'colour'"
fresh && edit '/"id": "pose/s/"id"/"colour": 1, "id"/'
spoiled 'unknown field of a case' 2 "pose/tiny: unknown field 'colour'"
fresh && edit '1s/"version"/"colour": 1, "version"/'
spoiled 'unknown field' 2 "manifest.json: unknown field 'colour'"
fresh && edit "\\|$points|s/\"bits\"/\"name\": \"points\", \"bits\"/"
spoiled 'field twice' 2 "ellipse/tiny: inputs points: field 'name' is there twice"
fresh && edit "\\|$points|s/, \"sha256\": \"[0-9a-f]*\"//"
spoiled 'no SHA-256' 2 "ellipse/tiny: inputs points: field 'sha256' is missing"
fresh && edit '/"id": "pose/s/"tier": "ordinary", //'
spoiled 'no tier' 2 "pose/tiny: field 'tier' is missing"
fresh && edit '/"id": "pose/s/"ordinary"/"usual"/'
spoiled 'unknown tier' 2 "pose/tiny: field 'tier': 'usual'"
fresh && edit '/"id": "pose/s/"stage": "pose"/"stage": "poses"/'
spoiled 'unknown stage' 2 "pose/tiny: field 'stage': there is no stage 'poses'"
fresh && edit '/"id": "pose/,/"frame/{/"seed"/s/: 0,/: 1.5,/}'
spoiled 'broken seed' 2 "pose/tiny: field 'seed'"
fresh && edit '/"reference": \[/{/,$/!{N;s/\n.*ellipse.ref.hex.*\]/]/}}'
spoiled 'no reference' 2 'ellipse/tiny: reference: a list of 1 to 4 arrays is expected'
fresh && edit '/"id": "canny/s/"id": "canny/"id": "smooth/;/"id": "smooth/s/"stage": "canny"/"stage": "smooth"/'
spoiled 'id twice' 2 'smooth/tiny: this id is there twice'
fresh && edit '/ellipse.ref.hex/s/"class": "lsb"/"class": "exact"/'
spoiled 'bound of class exact' 2 "ellipse/tiny: reference ellipse: field 'bound' without class lsb"
fresh && edit '/ellipse.ref.hex/s/"bound": \[[^]]*\], //'
spoiled 'class lsb without bound' 2 "ellipse/tiny: reference ellipse: field 'bound' is missing"
fresh && edit '/ellipse.ref.hex/s/"bound": \[0/"bound": [-1/'
spoiled 'negative bound' 2 "ellipse/tiny: reference ellipse: field 'bound'"
fresh && edit '/ellipse.ref.hex/s/\[0, 4/[0, 400/'
spoiled 'bound wider than the measure' 2 "ellipse/tiny: reference ellipse: field 'bound': 400 LSB for word 1 (centre, axes), where "
fresh && edit '/ellipse.ref.hex/s/\[0, 4/[1, 4/'
spoiled 'bound of an exact word' 2 "ellipse/tiny: reference ellipse: field 'bound': 1 LSB for word 0 (exact), where 0 is the most"
fresh && edit '/ellipse.ref.hex/s/4, 64\]/4, 4294967295]/'
spoiled 'bound that nothing breaks' 2 "ellipse/tiny: reference ellipse: field 'bound': 4294967295 LSB for word 5 (angle), where 1024 is the most"
fresh && edit '/joint.ref.hex/s/4, 4\]/4, 9000000]/'
spoiled 'wide share' 2 "joint/tiny: reference joint: field 'bound': 9000000 LSB for word 9 (chi2), where "
fresh && edit '/tiny.covariance.ref.hex/s/"class": "exact"/"class": "lsb", "bound": 9007199254740992/'
spoiled 'wide share of a scale' 2 "joint/tiny: reference covariance: field 'bound': 9007199254740992 LSB for word 0 (covariance), where "
fresh && edit '/ellipse.ref.hex/s/4, 64\]/4, 9007199254740994]/'
spoiled 'bound beyond a double' 2 "ellipse/tiny: reference ellipse: field 'bound'"
fresh && edit '/ellipse.ref.hex/s/\[0, 4/[0, "circle"/'
spoiled 'undefined what may not be' 2 "ellipse/tiny: reference ellipse: field 'bound': word 1 is not undefined for 'circle'"
fresh && edit '/ellipse.ref.hex/s/4, 64\]/4, "difficult"]/'
spoiled 'undefined for no known reason' 2 "ellipse/tiny: reference ellipse: field 'bound': word 5 is not undefined for 'difficult'"
fresh && edit '/tiny.distance2.ref.hex/d;/verdict.ref.hex/s/},$/}],/'
spoiled 'output without a class' 2 'constraints/tiny: reference: output distance2 has no class'
fresh && edit '/ellipse.out.hex/s/"class": "exact"/"class": "lsb", "bound": 9/'
spoiled 'bound in the bit-exact tier' 2 "ellipse/tiny: exact ellipse: field 'class'"
fresh && edit "s|\"$points\"|\"../$points\"|"
spoiled 'file elsewhere' 2 "ellipse/tiny: inputs points: field 'file'"
fresh && edit '1s/0\.0\.1/0.0.2/'
spoiled 'version of the manifest' 2 "manifest.json: field 'version' is '0.0.2', file VERSION says '0.0.1'"
fresh && echo 1.0.0 >"$copy/VERSION"
spoiled 'version of the file' 2 "manifest.json: field 'version' is '0.0.1', file VERSION says '1.0.0'"
fresh && rm "$copy/VERSION"
spoiled 'no VERSION' 2 'manifest.json: file VERSION: cannot be opened'
fresh && edit '$d'
spoiled 'half a manifest' 2 'manifest.json: is no JSON'
fresh && echo '{}' >>"$copy/manifest.json"
spoiled 'two manifests' 2 'manifest.json: is no JSON'
fresh && rm "$copy/manifest.json"
spoiled 'no manifest' 2 'manifest.json: cannot be opened'

# Sound files with other content: the comparison must fail.
fresh && flip canny/tiny.params.hex 7 && resign canny/tiny.params.hex
spoiled 'other thresholds' 0 'failed=0' # 41 instead of 40 changes no edge here
fresh && sed -i '1s/.*/00000000/;2s/.*/00000000/' "$copy/canny/tiny.params.hex" && resign canny/tiny.params.hex
spoiled 'no thresholds' 1 'FAIL canny/tiny: reference map word ' 'FAIL canny/tiny: exact map word ' 'failed=1'
fresh && sed -i 3s/.*/00000123/ "$copy/ellipse/tiny.ellipse.out.hex" && resign ellipse/tiny.ellipse.out.hex
spoiled 'other exact word' 1 'FAIL ellipse/tiny: exact ellipse word 2: expected 00000123 (291), found ' 'failed=1'
fresh && edit '/ellipse.ref.hex/s/\[0, 4/[0, 3/'
spoiled 'bound exceeded' 1 'FAIL ellipse/tiny: reference ellipse word 1: ' 'bound 3, 1 of 6 words off'
fresh && edit '/ellipse.ref.hex/s/4, 64\]/4, "circle"]/' && sed -i 6s/.*/00001234/ "$copy/ellipse/tiny.ellipse.ref.hex" && resign ellipse/tiny.ellipse.ref.hex
spoiled 'undefined word of the reference' 0 'failed=0' 'ellipse          1      0      0            1        4         1'
fresh && edit '/ellipse.ref.hex/s/4, 64\]/4, "circle"]/' && sed -i 6s/.*/00001234/ "$copy/ellipse/tiny.ellipse.out.hex" && resign ellipse/tiny.ellipse.out.hex
spoiled 'undefined word of the exact tier' 1 'FAIL ellipse/tiny: exact ellipse word 5: expected 00001234' 'failed=1'
fresh && edit '/pose.*ref.hex/s/"bound": \[[^]]*\]/"bound": 0/'
spoiled 'no deviation allowed' 1 'FAIL pose/tiny: reference pose word 1: '
fresh && edit '/tiny.distance2.out.hex/d;/verdict.out.hex/s/},$/}]},/'
spoiled 'unchecked output' 1 'FAIL constraints/tiny: exact distance2: not among the expected outputs'
fresh && edit '/ellipse.out.hex/s/"name": "ellipse"/"name": "circle"/'
spoiled 'renamed output' 2 'ellipse/tiny: reference: output circle has no class'
fresh && edit '/smooth.tiny.image.[ro]/s/"name": "image"/"name": "picture"/'
spoiled 'unknown output' 1 'FAIL smooth/tiny: reference picture: the stage has no such output' 'FAIL smooth/tiny: exact picture: the stage has no such output'
fresh && sed -i 6d "$copy/ellipse/tiny.ellipse.out.hex" && edit '/ellipse.out.hex/s/"count": 6/"count": 5/' && resign ellipse/tiny.ellipse.out.hex
spoiled 'fewer words' 1 'FAIL ellipse/tiny: exact ellipse: expected 5 words of 32 bits, found 6 words of 32 bits'
fresh && echo 00000000 >>"$copy/eigen/tiny.matrix.hex" && sed -i '/tiny.matrix.hex/{s/"bits": 64/"bits": 32/;s/"count": 6/"count": 13/}' "$copy/manifest.json" &&
    sed -i 's/^\(........\)\(........\)$/\1\n\2/' "$copy/eigen/tiny.matrix.hex" && resign eigen/tiny.matrix.hex
spoiled 'other inputs' 1 'FAIL eigen/tiny: stage eigen: inputs are not what the stage takes'

echo "corrupt: $tried sets tried"
exit $status
