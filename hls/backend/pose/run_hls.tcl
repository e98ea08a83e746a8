# Written by hls/vitis/generate.sh from hls/tops.txt. In this folder, after 'hls/vectors.sh pose':
#   vitis-run --mode hls --tcl run_hls.tcl
set name pose
set top drogue_hls_pose
set root ../../..
set sources {
    hls/backend/pose.c
    src/arithmetic/cholesky.c
    src/arithmetic/fixed.c
    src/arithmetic/wide.c
    src/camera/undistort.c
    src/inner/centroid.c
    src/inner/inner.c
    src/outline/quality.c
    src/pose/decide.c
    src/pose/joint.c
    src/pose/joint_model.c
    src/pose/joint_weights.c
    src/pose/pose.c
}
set bench {
    hls/backend/pose_test.c
    hls/bench/bench.c
    build/hls/pose/cases_0.c
    build/hls/pose/cases_index.c
}
set replaced {}
source $root/hls/vitis/run.tcl
