# Written by hls/vitis/generate.sh from hls/tops.txt. In this folder, after 'hls/vectors.sh frontend':
#   vitis-run --mode hls --tcl run_hls.tcl
set name frontend
set top drogue_hls_frontend
set root ../..
set sources {
    hls/choose_label.c
    hls/frontend/frontend.c
    hls/frontend/labels.c
    hls/frontend/operators.c
    hls/frontend/pixels.c
}
set bench {
    hls/frontend/testbench.c
    hls/bench/bench.c
    build/hls/frontend/cases_0.c
    build/hls/frontend/cases_index.c
}
set replaced {}
source $root/hls/vitis/run.tcl
