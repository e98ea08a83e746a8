# Written by hls/vitis/generate.sh from hls/tops.txt. In this folder, after 'hls/vectors.sh outline':
#   vitis-run --mode hls --tcl run_hls.tcl
set name outline
set top drogue_hls_outline
set root ../../..
set sources {
    hls/backend/near.c
    hls/backend/outline.c
    src/arithmetic/eigen.c
    src/arithmetic/fixed.c
    src/arithmetic/wide.c
    src/camera/undistort.c
    src/config.c
    src/inner/inner.c
    src/outline/cluster.c
    src/outline/conic.c
    src/outline/constraints.c
    src/outline/ellipse.c
    src/outline/moments.c
    src/outline/outline.c
    src/outline/quality.c
    src/outline/support.c
    src/pose/joint_model.c
    src/pose/pose.c
}
set bench {
    hls/backend/outline_test.c
    hls/bench/bench.c
    build/hls/outline/cases_0.c
    build/hls/outline/cases_index.c
}
set replaced {src/outline/near.c}
source $root/hls/vitis/run.tcl
