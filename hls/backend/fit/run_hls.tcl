# Written by hls/vitis/generate.sh from hls/tops.txt. In this folder, after 'hls/vectors.sh fit':
#   vitis-run --mode hls --tcl run_hls.tcl
set name fit
set top drogue_hls_fit
set root ../../..
set sources {
    hls/backend/fit.c
    src/arithmetic/eigen.c
    src/arithmetic/fixed.c
    src/arithmetic/wide.c
    src/outline/conic.c
    src/outline/ellipse.c
    src/outline/moments.c
}
set bench {
    hls/backend/fit_test.c
    hls/bench/bench.c
    build/hls/fit/cases_0.c
    build/hls/fit/cases_index.c
}
set replaced {}
source $root/hls/vitis/run.tcl
