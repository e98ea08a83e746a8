# SPDX-License-Identifier: Apache-2.0
# Camera files: the four forms give the camera that the numbers give; what is not that camera is refused by name.
. "$(dirname "$0")/common.sh"

printf '%%YAML:1.0\n---\na: 1\n' >probe.yaml
if "$drogue" measure scene.png --camera probe.yaml 2>&1 | grep -q 'without libyaml'; then
    echo 'skipped: the program is built without libyaml'
    finish
fi

cat >opencv.yaml <<'END'
%YAML:1.0
---
calibration_time: "today"
image_width: 320
image_height: 240
flags: 0
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 8.0000000000000000e+02, 0., 1.5950000000000000e+02, 0.,
       8.0500000000000000e+02, 1.1950000000000000e+02, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ -1.0000000000000001e-01, 2.0000000000000000e-02, 1.0e-03, -2.0e-03, 3.0e-03 ]
avg_reprojection_error: 3.0e-01
END
cat >opencv.xml <<'END'
<?xml version="1.0"?>
<opencv_storage>
<image_width>320</image_width>
<image_height>240</image_height>
<camera_matrix type_id="opencv-matrix">
  <rows>3</rows><cols>3</cols><dt>d</dt>
  <data>
    800. 0. 1.5950000000000000e+02 0. 805. 1.1950000000000000e+02 0. 0. 1.</data></camera_matrix>
<distortion_coefficients type_id="opencv-matrix">
  <rows>5</rows><cols>1</cols><dt>d</dt>
  <data>-1.0e-01 2.0e-02 1.0e-03 -2.0e-03 3.0e-03</data></distortion_coefficients>
</opencv_storage>
END
cat >ros.yaml <<'END'
image_width: 320
image_height: 240
camera_name: probe
camera_matrix:
  rows: 3
  cols: 3
  data: [800.0, 0.0, 159.5, 0.0, 805.0, 119.5, 0.0, 0.0, 1.0]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.1, 0.02, 0.001, -0.002, 0.003]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
END
cat >message.yaml <<'END'
header: {stamp: {sec: 0, nanosec: 0}, frame_id: probe}
height: 240
width: 320
distortion_model: plumb_bob
d: [-0.1, 0.02, 0.001, -0.002, 0.003]
k: [800.0, 0.0, 159.5, 0.0, 805.0, 119.5, 0.0, 0.0, 1.0]
---
END
cat >kalibr.yaml <<'END'
cam0:
  cam_overlaps: []
  camera_model: pinhole
  distortion_coeffs: [-0.1, 0.02, 0.001, -0.002]
  distortion_model: radtan
  intrinsics: [800.0, 805.0, 159.5, 119.5]
  resolution: [320, 240]
  rostopic: /cam0/image_raw
  T_cam_imu:
  - [1.0, 0.0, 0.0, 0.0]
  - [0.0, 1.0, 0.0, 0.0]
END

run 0 measure scene.png --camera 800,805,159.5,119.5 --distortion -0.1,0.02,0.001,-0.002,0.003 $roi --json
cp out first
for file in opencv.yaml opencv.xml ros.yaml message.yaml; do
    run 0 measure scene.png --camera $file $roi --json
    cmp -s out first || fail "$file: another answer"
    run 2 measure black.png --camera $file
    says '64x48 pixels, but the camera of'
    run 2 track black.png --camera $file
    run 2 measure scene.png --camera $file --distortion 0,0,0,0,0
    says 'is in the camera file'
done
run 0 measure scene.png --camera 800,805,159.5,119.5 --distortion -0.1,0.02,0.001,-0.002,0 $roi --json
cp out first
run 0 measure scene.png --camera kalibr.yaml $roi --json
cmp -s out first || fail 'kalibr.yaml: another answer'

# refused FILE SED REASON: with one thing changed
refused() {
    sed "$2" "$1" >bad
    cmp -s "$1" bad && fail "$2 changes nothing in $1"
    run 2 measure scene.png --camera bad $roi
    says 'drogue: bad: '
    says "$3"
}
refused ros.yaml 's/plumb_bob/equidistant/' equidistant
refused message.yaml 's/plumb_bob/fisheye/' fisheye
refused kalibr.yaml 's/radtan/equidistant/' equidistant
refused kalibr.yaml 's/pinhole/omni/' omni
refused kalibr.yaml 's/^cam0:/cam1:/' 'has no camera_matrix'
refused kalibr.yaml '$a cam1: {camera_model: pinhole}' 'more than one'
refused kalibr.yaml '/intrinsics/d' 'has no camera_matrix'
refused kalibr.yaml '/intrinsics/s/\]/, 1]/' 'has more than 4 numbers'
refused opencv.yaml '0,/ 1. \]/s/ 1. \]/ 1., 0. ]/' 'has more than 9 numbers'
refused opencv.yaml 's/^flags: 0/fisheye_model: 1/' fisheye_model
refused opencv.yaml '/distortion_coefficients/,/data/d' 'has no distortion_coefficients'
refused opencv.yaml 's/-1.0000000000000001e-01/-2.561e+02/' 'a coefficient of distortion is beyond 256'
run 2 measure scene.png --camera 800,805,159.5,119.5 --distortion 0,0,0,0,257
says 'drogue: --distortion: a coefficient of distortion is beyond 256'
refused opencv.yaml 's/805/x&/;s/8.0500000000000000e+02/eight/' 'no number'
refused ros.yaml 's/805.0/"805.0\\0junk"/' 'holds a NUL'
refused ros.yaml 's/^image_width/"image_width\\0junk"/' 'holds a NUL'
refused ros.yaml 's/805.0/"8\\n05"/' "'8?05' is no number"
refused opencv.yaml 's/data: \[ 8.0/data: [ -8.0/' 'above 0'
refused opencv.yaml 's/+02, 0., 1.595/+02, 1., 1.595/' skew
refused opencv.yaml 's/3.0e-03 \]/3.0e-03, 1. ]/' rational
refused opencv.yaml 's/image_width: 320/image_width: 3.5/' 'no number of pixels'
refused opencv.yaml '/image_width/d' 'has image_height without image_width'
refused message.yaml '/^height/d' 'has width without height'
refused kalibr.yaml 's/\[320, 240\]/[320]/' 'has cam0.resolution.0 without cam0.resolution.1'
refused opencv.yaml 's/8.0500000000000000e+02/8.05/' 'too unlike'
refused message.yaml 's/805.0/8050.0/' 'too unlike'
refused message.yaml 's/0.003\]/0.003, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1]/' 'more than 14'
refused opencv.xml 's,</data>,,' 'no sound XML'
refused ros.yaml 's/data: \[800.0/data: [800.0, [/' 'no YAML'
# Rows x columns are as many as there are numbers, of both matrices and in both forms.
refused opencv.yaml '/^camera_matrix/,/data/s/rows: 3/rows: 4/' 'camera_matrix: rows x cols is 4 x 3, but data has 9 numbers'
refused opencv.yaml 's/rows: 5/rows: 4/' 'distortion_coefficients: rows x cols is 4 x 1, but data has 5 numbers'
refused opencv.yaml 's/, 3.0e-03 \]/ ]/' 'distortion_coefficients: rows x cols is 5 x 1, but data has 4 numbers'
refused opencv.xml 's/<cols>3/<cols>2/' 'camera_matrix: rows x cols is 3 x 2, but data has 9 numbers'
refused ros.yaml 's/cols: 5/cols: 4/' 'distortion_coefficients: rows x cols is 1 x 4, but data has 5 numbers'
refused ros.yaml 's/cols: 5/cols: 0/' 'rows x cols is 1 x 0'
refused ros.yaml 's/cols: 5/cols: five/' "distortion_coefficients.cols: 'five' is no number of cols"
refused ros.yaml 's/cols: 5/cols: -5/' "'-5' is no number of cols"
refused ros.yaml 's/rows: 1$/rows: 0.5/' "distortion_coefficients.rows: '0.5' is no number of rows"
refused ros.yaml 's/cols: 5/&\n  cols: 4/' 'has distortion_coefficients.cols more than once'
run 0 measure scene.png --camera ros.yaml $roi --json
cp out first
for file in ros.yaml opencv.xml opencv.yaml; do # a file that says nothing of them, or of one alone, has its numbers
    for side in rows cols 'rows\|cols'; do
        sed "s,<\($side\)>[0-9]*</\($side\)>,,g;/^ *\($side\):/d" $file >bad
        cmp -s $file bad && fail "$side are not gone from $file"
        run 0 measure scene.png --camera bad $roi --json
        cmp -s out first || fail "$file without $side: another answer"
    done
done

# ROS writes no coefficients of a camera without distortion, with plumb_bob or with no model; of another model they are missing.
run 0 measure scene.png --camera 800,805,159.5,119.5 $roi --json
cp out first
sed 's/^d: .*/d: []/' message.yaml >plain.yaml
sed '/^distortion_coefficients/,/data/{s/cols: 5/cols: 0/;s/data: .*/data: []/}' ros.yaml >plain_file.yaml
for file in plain.yaml plain_file.yaml; do
    for model in '' 's/plumb_bob//' "s/plumb_bob/''/" '/^distortion_model/d'; do
        sed "$model" $file >bad
        run 0 measure scene.png --camera bad $roi --json
        cmp -s out first || fail "$file, $model: another answer"
    done
    refused $file 's/plumb_bob/rational_polynomial/' 'with four or five numbers'
    refused $file 's/plumb_bob/equidistant/' equidistant
done
refused message.yaml 's/plumb_bob//' "distortion_model is ''"
refused plain.yaml '$a d: [0, 0, 0, 0]' 'has d more than once'
refused plain.yaml '/^d:/d' 'has no d with four or five numbers'
refused plain.yaml 's/^d: .*/d: [0]/' 'has no d with four or five numbers'
refused plain_file.yaml 's/cols: 0/cols: 5/' 'distortion_coefficients: rows x cols is 1 x 5, but data has 0 numbers'
refused kalibr.yaml 's/^  distortion_coeffs: .*/  distortion_coeffs: []/' 'has no cam0.distortion_coeffs'
# Which of two was meant nobody knows, but the same twice is one: what ROS prints of a topic.
refused opencv.yaml '$a image_width: 640' 'has image_width more than once'
refused opencv.yaml '$a distortion_coefficients: {data: [0, 0, 0, 0]}' 'has distortion_coefficients.data.0 more than once'
refused opencv.xml 's,</opencv_storage>,<camera_matrix><data>800. 0. 160 0. 805. 119 0. 0. 1.</data></camera_matrix>&,' \
    'has camera_matrix.data.2 more than once'
{ cat message.yaml && sed 's/805.0/804.0/' message.yaml; } >bad
run 2 measure scene.png --camera bad
says 'has k.4 more than once'
run 0 measure scene.png --camera message.yaml $roi --json
cp out first
cat message.yaml message.yaml >bad
run 0 measure scene.png --camera bad $roi --json
cmp -s out first || fail 'a message twice: another answer'
# Bounds of depth and of the number of keys, in both forms; as many as that are read.
refused ros.yaml '$a deep: [[[[[[[[1]]]]]]]]' 'nested too deep'
refused opencv.xml '$i <a><a><a><a><a><a><a><a>1</a></a></a></a></a></a></a></a>' 'nested too deep'
yes 'word: 1' | head -n 20000 >keys.yaml
{ echo '<x>' && yes '<word>1 2</word>' | head -n 10000 && echo '</x>'; } >keys.xml
for file in keys.yaml keys.xml; do
    run 2 measure scene.png --camera $file
    says 'has no camera_matrix'
done
refused keys.yaml '$a word: 1' 'too large'
refused keys.xml '$i <word>1</word>' 'too large'
: >bad
run 2 measure scene.png --camera bad
says 'empty'

# The mark of UTF-8 before it changes nothing; half of one is no file, and neither is the mark alone.
run 0 measure scene.png --camera opencv.yaml $roi --json
cp out first
for file in opencv.yaml opencv.xml ros.yaml; do
    { printf '\357\273\277' && cat $file; } >bad
    run 0 measure scene.png --camera bad $roi --json
    cmp -s out first || fail "$file behind a mark: another answer"
    { printf '\357\273' && cat $file; } >bad
    run 2 measure scene.png --camera bad
    says 'no YAML'
done
printf '\357\273\277' >bad
run 2 measure scene.png --camera bad
says 'empty'
run 2 measure scene.png --camera .
says 'drogue: .: '
run 2 measure scene.png --camera ros.yaml --overlay ros.yaml
says 'is read as input'

# Any byte wrong: refused or read, but no crash.
size=$(wc -c <opencv.xml)
for file in ros.yaml opencv.xml; do
    at=0
    while [ $at -lt "$size" ]; do
        cp $file bad
        printf '[' | dd of=bad bs=1 seek=$at conv=notrunc 2>/dev/null
        "$drogue" measure scene.png --camera bad $roi >out 2>err
        [ $? -le 2 ] || fail "$file, byte $at: a crash"
        at=$((at + 7))
    done
    checks=$((checks + 1))
done

finish
