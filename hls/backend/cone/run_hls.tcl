# Written by hls/vitis/generate.sh from hls/tops.txt. In this folder, after 'hls/vectors.sh cone':
#   vitis-run --mode hls --tcl run_hls.tcl
set name cone
set top drogue_hls_cone
set root ../../..
set sources {
    hls/backend/cone.c
    src/arithmetic/eigen.c
    src/arithmetic/fixed.c
    src/arithmetic/wide.c
    src/pose/pose.c
}
set bench {
    hls/backend/cone_test.c
    hls/bench/bench.c
    build/hls/cone/cases_0.c
    build/hls/cone/cases_index.c
}
set replaced {}
source $root/hls/vitis/run.tcl
