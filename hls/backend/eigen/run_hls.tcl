# Written by hls/vitis/generate.sh from hls/tops.txt. In this folder, after 'hls/vectors.sh eigen':
#   vitis-run --mode hls --tcl run_hls.tcl
set name eigen
set top drogue_hls_eigen
set root ../../..
set sources {
    hls/backend/eigen.c
    src/arithmetic/eigen.c
    src/arithmetic/fixed.c
    src/arithmetic/wide.c
}
set bench {
    hls/backend/eigen_test.c
    hls/bench/bench.c
    build/hls/eigen/cases_0.c
    build/hls/eigen/cases_index.c
}
set replaced {}
source $root/hls/vitis/run.tcl
