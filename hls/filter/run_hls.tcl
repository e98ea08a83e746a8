# Written by hls/vitis/generate.sh from hls/tops.txt. In this folder, after 'hls/vectors.sh filter':
#   vitis-run --mode hls --tcl run_hls.tcl
set name filter
set top drogue_hls_filter
set root ../..
set sources {
    hls/filter/filter.c
    src/fixed.c
    src/kalman.c
    src/wide.c
}
set bench {
    hls/filter/testbench.c
    hls/bench/bench.c
    build/hls/filter/cases_0.c
    build/hls/filter/cases_index.c
    src/acquire.c
    src/canny.c
    src/centroid.c
    src/cholesky.c
    src/cluster.c
    src/config.c
    src/conic.c
    src/constraints.c
    src/dark_disc.c
    src/dark_sums.c
    src/decide.c
    src/disc.c
    src/drogue.c
    src/eigen.c
    src/ellipse.c
    src/frontend.c
    src/gradient.c
    src/inner.c
    src/joint.c
    src/joint_model.c
    src/joint_weights.c
    src/label.c
    src/moments.c
    src/near.c
    src/otsu.c
    src/outline.c
    src/pose.c
    src/quality.c
    src/rim.c
    src/search.c
    src/smooth.c
    src/status.c
    src/support.c
    src/track.c
    src/track_end.c
    src/undistort.c
    src/workspace.c
}
source $root/hls/vitis/run.tcl
