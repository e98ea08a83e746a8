# Written by hls/vitis/generate.sh from hls/tops.txt. In this folder, after 'hls/vectors.sh centroid':
#   vitis-run --mode hls --tcl run_hls.tcl
set name centroid
set top drogue_hls_centroid
set root ../..
set sources {
    hls/choose_label.c
    hls/centroid/centroid.c
    hls/centroid/components.c
    hls/centroid/operators.c
    src/dark_sums.c
    src/fixed.c
    src/label.c
    src/otsu.c
    src/wide.c
}
set bench {
    hls/centroid/testbench.c
    hls/bench/bench.c
    build/hls/centroid/cases_0.c
    build/hls/centroid/cases_index.c
}
set replaced {}
source $root/hls/vitis/run.tcl
