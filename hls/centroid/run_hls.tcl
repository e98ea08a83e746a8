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
    src/arithmetic/fixed.c
    src/arithmetic/wide.c
    src/frontend/label.c
    src/inner/centroid.c
    src/inner/otsu.c
}
set bench {
    hls/centroid/testbench.c
    hls/bench/bench.c
    build/hls/centroid/cases_0.c
    build/hls/centroid/cases_index.c
}
set replaced {}
source $root/hls/vitis/run.tcl
