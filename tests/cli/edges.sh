# SPDX-License-Identifier: Apache-2.0
# drogue edges: cv::Canny's edge map, with thresholds as cv::Canny takes them.
. "$(dirname "$0")/common.sh"

for image in scene noise step one two tall black; do
    for thresholds in '40 100' '0 0' '40.7 99.99' '99.9999999999 100' '100 100.2' '0 2040' '500 900' '5e2 1e8'; do
        # shellcheck disable=SC2086
        set -- $thresholds
        run 0 edges $image.png edges.png --low "$1" --high "$2"
        "$canny_check" $image.png edges.png "$1" "$2" 0 >found || fail "$image, $thresholds: $(cat found)"
        run 0 edges --smooth --high="$2" --low="$1" $image.png edges.png
        "$canny_check" $image.png edges.png "$1" "$2" 1 >found || fail "$image smoothed, $thresholds: $(cat found)"
        checks=$((checks + 2))
        [ ! -s out ] || fail "output: $(cat out)"
    done
done
run 0 edges noise_full.png edges.png --low 0 --high 0
"$canny_check" noise_full.png edges.png 0 0 0 >found || fail "noise of full size: $(cat found)"

# The comparison bites: another threshold is another map, and so is smoothing.
run 0 edges scene.png edges.png --low 40 --high 100
"$canny_check" scene.png edges.png 500 900 0 >found && fail 'thresholds make no difference'
"$canny_check" noise.png edges.png 40 100 0 >found 2>&1 && fail 'any image will do'
run 0 edges noise.png edges.png --low 40 --high 100 --smooth
"$canny_check" noise.png edges.png 40 100 0 >found && fail 'smoothing makes no difference'

finish
