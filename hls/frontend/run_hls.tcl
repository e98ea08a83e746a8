# Written by hls/vitis/generate.sh from hls/tops.txt. In this folder, after 'hls/vectors.sh frontend':
#   vitis-run --mode hls --tcl run_hls.tcl
# Part, clock and steps are those of the environment, where it has any.
proc setting {name otherwise} {
    return [expr {[info exists ::env($name)] ? $::env($name) : $otherwise}]
}
set part [setting DROGUE_HLS_PART xc7z020clg484-1]
set clock_ns [setting DROGUE_HLS_CLOCK_NS 5]
set steps [setting DROGUE_HLS_STEPS "csim csynth cosim export"]
set flags "-std=c99 -Wno-unknown-pragmas -I../../include -I../../hls -I../../hls/bench -I../../tests/conformance"

if {[llength [info commands open_component]] > 0} {
    open_component -reset frontend -flow_target vivado
} else {
    open_project -reset frontend
}
foreach file {
    ../../hls/choose_label.c
    ../../hls/frontend/frontend.c
    ../../hls/frontend/labels.c
    ../../hls/frontend/operators.c
    ../../hls/frontend/pixels.c
} {
    add_files $file -cflags $flags
}
foreach file {
    ../../hls/frontend/testbench.c
    ../../hls/bench/bench.c
    ../../build/hls/frontend/cases_0.c
    ../../build/hls/frontend/cases_index.c
    ../../src/acquire.c
    ../../src/canny.c
    ../../src/centroid.c
    ../../src/cholesky.c
    ../../src/cluster.c
    ../../src/config.c
    ../../src/conic.c
    ../../src/constraints.c
    ../../src/dark_disc.c
    ../../src/dark_sums.c
    ../../src/decide.c
    ../../src/disc.c
    ../../src/drogue.c
    ../../src/eigen.c
    ../../src/ellipse.c
    ../../src/fixed.c
    ../../src/frontend.c
    ../../src/gradient.c
    ../../src/inner.c
    ../../src/joint.c
    ../../src/joint_model.c
    ../../src/joint_weights.c
    ../../src/kalman.c
    ../../src/label.c
    ../../src/moments.c
    ../../src/otsu.c
    ../../src/outline.c
    ../../src/pose.c
    ../../src/quality.c
    ../../src/rim.c
    ../../src/search.c
    ../../src/smooth.c
    ../../src/status.c
    ../../src/support.c
    ../../src/track.c
    ../../src/track_end.c
    ../../src/undistort.c
    ../../src/wide.c
    ../../src/workspace.c
} {
    add_files -tb $file -cflags $flags
}
set_top drogue_hls_frontend
if {[llength [info commands open_component]] == 0} {
    open_solution -reset solution -flow_target vivado
}
set_part $part
create_clock -period $clock_ns
if {"csim" in $steps} {
    csim_design
}
if {"csynth" in $steps} {
    csynth_design
}
if {"cosim" in $steps} {
    cosim_design
}
if {"export" in $steps} {
    export_design -format ip_catalog
}
exit
