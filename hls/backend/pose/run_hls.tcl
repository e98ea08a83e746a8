# Written by hls/vitis/generate.sh from hls/tops.txt. In this folder, after 'hls/vectors.sh pose':
#   vitis-run --mode hls --tcl run_hls.tcl
set name pose
set top drogue_hls_pose
set root ../../..
set sources {
    hls/backend/pose.c
    src/cholesky.c
    src/dark_sums.c
    src/decide.c
    src/fixed.c
    src/inner.c
    src/joint.c
    src/joint_model.c
    src/joint_weights.c
    src/pose.c
    src/quality.c
    src/undistort.c
    src/wide.c
}
set bench {
    hls/backend/pose_test.c
    hls/bench/bench.c
    build/hls/pose/cases_0.c
    build/hls/pose/cases_index.c
}
set replaced {}
source $root/hls/vitis/run.tcl
