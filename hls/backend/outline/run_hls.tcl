# Written by hls/vitis/generate.sh from hls/tops.txt. In this folder, after 'hls/vectors.sh outline':
#   vitis-run --mode hls --tcl run_hls.tcl
set name outline
set top drogue_hls_outline
set root ../../..
set sources {
    hls/backend/near.c
    hls/backend/outline.c
    src/cluster.c
    src/config.c
    src/conic.c
    src/constraints.c
    src/eigen.c
    src/ellipse.c
    src/fixed.c
    src/inner.c
    src/joint_model.c
    src/moments.c
    src/outline.c
    src/pose.c
    src/quality.c
    src/support.c
    src/undistort.c
    src/wide.c
}
set bench {
    hls/backend/outline_test.c
    hls/bench/bench.c
    build/hls/outline/cases_0.c
    build/hls/outline/cases_index.c
}
set replaced {src/near.c}
source $root/hls/vitis/run.tcl
