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
$(prefixed tb.file= "$2" $(bench_files "$1") $rest)
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
set name $1
set top $function
set root $2
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
