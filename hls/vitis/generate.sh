#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Writes hls_config.cfg and run_hls.tcl of every top from hls/tops.txt.
# usage: generate.sh                    into the tops' folders
#        generate.sh --config NAME      one hls_config.cfg to stdout, with absolute paths, and with the part and clock
#                                       of DROGUE_HLS_PART and DROGUE_HLS_CLOCK_NS
#        generate.sh --to FOLDER        all of them below FOLDER, to compare
set -euo pipefail
cd "$(dirname "$0")/../.."
. hls/tops.sh
default_part=xc7z020clg484-1
default_clock_ns=5

# prefixed KEY ROOT FILE...: lines 'KEYROOT/FILE'
prefixed() { printf "$1$2/%s\n" "${@:3}"; }

# flags ROOT: of every compilation
flags() { echo "-std=c99 -Wno-unknown-pragmas -I$1/include -I$1/hls -I$1/hls/bench -I$1/tests/conformance"; }

# files NAME: of the test bench, beside the sources
bench_files() { echo "$bench hls/bench/bench.c build/hls/$1/cases_0.c build/hls/$1/cases_index.c $rest"; }

# set_top NAME: as top, and 'rest': files of src/ that the top does not need but its test bench may
load() {
    local file
    top "$1"
    rest=""
    for file in src/*.c; do
        [[ " $core " == *" $file "* ]] || rest+="${rest:+ }$file"
    done
}

# config NAME ROOT PART CLOCK_NS
# shellcheck disable=SC2046,SC2086 # lists of files
config() {
    load "$1"
    cat <<END
# Written by hls/vitis/generate.sh from hls/tops.txt. In this folder, after 'hls/vectors.sh $1':
#   vitis-run --mode hls --csim --config hls_config.cfg --work_dir $1
#   v++ -c --mode hls --config hls_config.cfg --work_dir $1
#   vitis-run --mode hls --cosim --config hls_config.cfg --work_dir $1
#   vitis-run --mode hls --package --config hls_config.cfg --work_dir $1
part=$3

[hls]
clock=${4}ns
flow_target=vivado
syn.top=$function
syn.cflags=$(flags "$2")
$(prefixed syn.file= "$2" $sources $core)
tb.cflags=$(flags "$2")
$(prefixed tb.file= "$2" $(bench_files "$1"))
package.output.format=ip_catalog
package.output.syn=false
END
}

# script NAME ROOT
# shellcheck disable=SC2046,SC2086
script() {
    load "$1"
    cat <<END
# Written by hls/vitis/generate.sh from hls/tops.txt. In this folder, after 'hls/vectors.sh $1':
#   vitis-run --mode hls --tcl run_hls.tcl
# Part, clock and steps are those of the environment, where it has any.
proc setting {name otherwise} {
    return [expr {[info exists ::env(\$name)] ? \$::env(\$name) : \$otherwise}]
}
set part [setting DROGUE_HLS_PART $default_part]
set clock_ns [setting DROGUE_HLS_CLOCK_NS $default_clock_ns]
set steps [setting DROGUE_HLS_STEPS "csim csynth cosim export"]
set flags "$(flags "$2")"

if {[llength [info commands open_component]] > 0} {
    open_component -reset $1 -flow_target vivado
} else {
    open_project -reset $1
}
foreach file {
$(prefixed '    ' "$2" $sources $core)
} {
    add_files \$file -cflags \$flags
}
foreach file {
$(prefixed '    ' "$2" $(bench_files "$1"))
} {
    add_files -tb \$file -cflags \$flags
}
set_top $function
if {[llength [info commands open_component]] == 0} {
    open_solution -reset solution -flow_target vivado
}
set_part \$part
create_clock -period \$clock_ns
if {"csim" in \$steps} {
    csim_design
}
if {"csynth" in \$steps} {
    csynth_design
}
if {"cosim" in \$steps} {
    cosim_design
}
if {"export" in \$steps} {
    export_design -format ip_catalog
}
exit
END
}

case ${1:-} in
--config)
    name=$(tops "$2")
    config "$name" "$PWD" "${DROGUE_HLS_PART:-$default_part}" "${DROGUE_HLS_CLOCK_NS:-$default_clock_ns}"
    exit
    ;;
--to) to=$2 ;;
*) to=. ;;
esac
for name in $(all_tops); do
    top "$name"
    mkdir -p "$to/$folder"
    root=$(sed -E 's|[^/]+|..|g' <<<"$folder")
    config "$name" "$root" "$default_part" "$default_clock_ns" >"$to/$folder/hls_config.cfg"
    script "$name" "$root" >"$to/$folder/run_hls.tcl"
done
