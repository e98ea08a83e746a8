# SPDX-License-Identifier: Apache-2.0
# Runs a run_hls.tcl with commands of the tool that only look: at the files, the top, the order of the steps.
# usage: tclsh stub.tcl FUNCTION run_hls.tcl, in the script's folder; exit status 1 with a line for each fault
# The files must be those of hls_config.cfg there, each once.
set faults 0
set files {}
set done {}
proc fault {what} {
    puts "$::argv: $what"
    incr ::faults
}
proc add_files {args} {
    set is_bench [expr {"-tb" in $args}]
    set flags [lsearch -exact $args -cflags]
    set file [lindex $args [expr {$is_bench ? 1 : 0}]]
    if {$flags < 0} {
        fault "$file without flags"
    }
    foreach flag [lindex $args [expr {$flags + 1}]] {
        if {[string match -I* $flag] && ![file isdirectory [string range $flag 2 end]]} {
            fault "no folder $flag"
        }
    }
    if {![file exists $file] && ![string match */build/hls/*/cases_*.c $file]} {
        fault "no file $file"
    }
    if {[string match */hls/*/*test*.c $file] && "-DDROGUE_HLS_FEW" ni [lindex $args [expr {$flags + 1}]]} {
        fault "$file with all its random images"
    }
    lappend ::files "[expr {$is_bench ? "tb" : "syn"}].file=$file"
    lappend ::done [expr {$is_bench ? "bench" : "source"}]
}
proc set_top {name} {
    lappend ::done top
    if {$name ne [lindex $::argv 0]} {
        fault "top $name"
    }
}
foreach {command step} {open_component open set_part part create_clock clock csim_design csim csynth_design csynth
    cosim_design cosim export_design export} {
    proc $command {args} "lappend ::done $step"
}
rename exit leave
proc exit {} {}

source [lindex $argv 1]
set order {}
foreach step $done {
    if {$step ne [lindex $order end]} {
        lappend order $step
    }
}
if {$order ne {open source bench top part clock csim csynth cosim export}} {
    fault "steps $order"
}
set config [open hls_config.cfg]
if {[lsort $files] ne [lsort [regexp -all -inline -line {^(?:syn|tb)\.file=.*$} [read $config]]]} {
    fault "files that are not those of hls_config.cfg"
}
leave [expr {$faults > 0}]
