#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Writes hls_config.cfg and run_hls.tcl of tops from hls/tops.txt into build/hls/vitis/NAME.
# usage: generate.sh [NAME...]          all of them when none is named
# Part and clock: DROGUE_HLS_PART, DROGUE_HLS_CLOCK_NS.
set -euo pipefail
cd "$(dirname "$0")/../.."
. hls/tops.sh
. hls/usage.sh
[[ ${1:-} != -* ]] || usage
part=${DROGUE_HLS_PART:-xc7z020clg484-1}
clock_ns=${DROGUE_HLS_CLOCK_NS:-5}
root=../../../..

# prefixed KEY ROOT FILE...: lines 'KEYROOT/FILE'
prefixed() { printf "$1$2/%s\n" "${@:3}"; }

# flags ROOT: of every compilation
flags() { echo "-std=c99 -Wno-unknown-pragmas -I$1/include -I$1/hls -I$1/hls/bench -I$1/tests/conformance"; }

# files NAME: of the test bench alone
bench_files() { echo "$bench hls/bench/bench.c build/hls/$1/cases_0.c build/hls/$1/cases_index.c"; }

# load NAME: as top, and 'rest': files of src/ that the top does not need but its test bench may
load() {
    local file
    top "$1"
    rest=""
    for file in $(core_files . '*.c'); do
        [[ " $core $replaced " == *" $file "* ]] || rest+="${rest:+ }$file"
    done
}

# config NAME
# shellcheck disable=SC2046,SC2086 # lists of files
config() {
    load "$1"
    cat <<END
# Written by hls/vitis/generate.sh from hls/tops.txt. In this folder, after 'hls/vectors.sh $1':
#   vitis-run --mode hls --csim --config hls_config.cfg --work_dir $1
#   v++ -c --mode hls --config hls_config.cfg --work_dir $1
#   vitis-run --mode hls --cosim --config hls_config.cfg --work_dir $1
#   vitis-run --mode hls --package --config hls_config.cfg --work_dir $1
part=$part

[hls]
clock=${clock_ns}ns
flow_target=vivado
syn.top=$function
syn.cflags=$(flags $root)
$(prefixed syn.file= $root $sources $core)
tb.cflags=$(flags $root) -DDROGUE_HLS_FEW
$(prefixed tb.file= $root $(bench_files "$1") $rest)
package.output.format=ip_catalog
package.output.syn=false
END
}

# script NAME
# shellcheck disable=SC2046,SC2086
script() {
    load "$1"
    cat <<END
# Written by hls/vitis/generate.sh from hls/tops.txt. In this folder, after 'hls/vectors.sh $1':
#   vitis-run --mode hls --tcl run_hls.tcl
set name $1
set top $function
set root $root
set sources {
$(printf '    %s\n' $sources $core)
}
set bench {
$(printf '    %s\n' $(bench_files "$1"))
}
set replaced {$replaced}
source \$root/hls/vitis/run.tcl
END
}

chosen=$(tops "$@")
for name in $chosen; do
    mkdir -p "build/hls/vitis/$name"
    config "$name" >"build/hls/vitis/$name/hls_config.cfg"
    script "$name" >"build/hls/vitis/$name/run_hls.tcl"
done
