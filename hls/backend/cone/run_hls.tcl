# Written by hls/vitis/generate.sh from hls/tops.txt. In this folder, after 'hls/vectors.sh cone':
#   vitis-run --mode hls --tcl run_hls.tcl
set name cone
set top drogue_hls_cone
set root ../../..
set sources {
    hls/backend/cone.c
    src/eigen.c
    src/fixed.c
    src/pose.c
    src/wide.c
}
set bench {
    hls/backend/cone_test.c
    hls/bench/bench.c
    build/hls/cone/cases_0.c
    build/hls/cone/cases_index.c
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
    src/ellipse.c
    src/frontend.c
    src/gradient.c
    src/inner.c
    src/joint.c
    src/joint_model.c
    src/joint_weights.c
    src/kalman.c
    src/label.c
    src/moments.c
    src/near.c
    src/otsu.c
    src/outline.c
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
