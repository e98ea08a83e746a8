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
}
set replaced {}
source $root/hls/vitis/run.tcl
