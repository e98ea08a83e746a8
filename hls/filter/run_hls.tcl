# Written by hls/vitis/generate.sh from hls/tops.txt. In this folder, after 'hls/vectors.sh filter':
#   vitis-run --mode hls --tcl run_hls.tcl
set name filter
set top drogue_hls_filter
set root ../..
set sources {
    hls/filter/filter.c
    src/arithmetic/fixed.c
    src/arithmetic/wide.c
    src/track/kalman.c
}
set bench {
    hls/filter/testbench.c
    hls/bench/bench.c
    build/hls/filter/cases_0.c
    build/hls/filter/cases_index.c
}
set replaced {}
source $root/hls/vitis/run.tcl
