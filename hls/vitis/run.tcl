# SPDX-License-Identifier: Apache-2.0
# What the run_hls.tcl of all tops have in common; they set name, top, root, sources, bench and
# replaced, and source this.
# Part, clock and steps are those of the environment, where it has any.
proc setting {name otherwise} {
    return [expr {[info exists ::env($name)] ? $::env($name) : $otherwise}]
}
set part [setting DROGUE_HLS_PART xc7z020clg484-1]
set clock_ns [setting DROGUE_HLS_CLOCK_NS 5]
set steps [setting DROGUE_HLS_STEPS "csim csynth cosim export"]
set flags "-std=c99 -Wno-unknown-pragmas"
foreach folder {include hls hls/bench tests/conformance} {
    append flags " -I$root/$folder"
}

if {[llength [info commands open_component]] > 0} {
    open_component -reset $name -flow_target vivado
} else {
    open_project -reset $name
}
foreach file $sources {
    add_files $root/$file -cflags $flags
}
foreach file $bench {
    add_files -tb $root/$file -cflags "$flags -DDROGUE_HLS_FEW"
}
foreach file [lsort [glob -tails -directory $root src/*.c src/{arithmetic,camera,frontend,inner,outline,pose,search,track}/*.c]] { # the test bench's own copy of what the top does not have
    if {$file ni $sources && $file ni $replaced} {
        add_files -tb $root/$file -cflags $flags
    }
}
set_top $top
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
