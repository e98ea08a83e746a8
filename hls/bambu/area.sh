#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What yosys makes for 7-series of the Verilog that bambu.sh left in build/hls/bambu/NAME: one line, LUT, FF, DSP, BRAM;
# area/stat there has the counts of each module.
# Operators are flattened into the functions: as modules of their own, a thousand and more, they would be mapped one by one,
# a shift by a constant to LUTs. Each function's datapath and each controller is then mapped by a yosys of its own, the
# others being black boxes: no pass of this flow works across modules, but some look at the whole design once a module.
# And synth_xilinx goes without its pass 'share', which asks a SAT solver of every two operators whether both are ever in
# use at once. With both, outline was not at its end after 76 minutes of processor time.
# usage: area.sh NAME      patience with a module: DROGUE_HLS_TIMEOUT_S
set -euo pipefail
cd "$(dirname "$0")/../.."
. hls/tops.sh
. hls/usage.sh
[[ ${1:--} != -* ]] || usage
name=$(tops "$1")
top "$name"
cd "build/hls/bambu/$name"
rm -rf area
mkdir area
cd area

# run COMMANDS LOG: yosys; status 255 keeps xargs from going on
run() {
    if ! timeout "${DROGUE_HLS_TIMEOUT_S:-3600}" yosys -q -p "$1" >"$2" 2>&1; then
        echo "area of $name: yosys did not end well, see build/hls/bambu/$name/area/$2"
        return 255
    fi
}
export -f run
export name

run "read_verilog -defer ../$function.v; hierarchy -check -top $function
    setattr -mod -set keep_hierarchy 1 *datapath_* *controller_*
    proc; flatten; tee -o modules ls; write_rtlil whole.il" split.log
mapfile -t modules < <(sed -n 's/^  //p' modules)
split='read_rtlil whole.il'
for i in "${!modules[@]}"; do
    split+="; select ${modules[i]}; write_rtlil -selected $i.il"
done
run "$split; select -clear; blackbox; write_rtlil black.il" split.log
for i in "${!modules[@]}"; do
    synth="synth_xilinx -noiopad -noclkbuf -top ${modules[i]} -run"
    printf '%s\0%s.log\0' "read_rtlil black.il; read_rtlil $i.il; $synth begin:coarse
        techmap -map +/cmp2lut.v -map +/cmp2lcu.v -D LUT_WIDTH=6; alumacc; opt; memory -nomap; opt_clean; $synth map_memory:
        select ${modules[i]}; write_rtlil -selected $i.mapped.il" "$i"
done | xargs -0 -n 2 -P "$(nproc)" bash -c 'run "$@"' run 2>/dev/null
whole=
for i in "${!modules[@]}"; do
    whole+="read_rtlil $i.mapped.il; "
done
run "$whole hierarchy -top $function; tee -o stat stat" stat.log

awk -v name="$name" '
    /design hierarchy/ { whole = 1 } # after the modules one by one
    !whole { next }
    /^ +LUT[1-6] / { lut += $2 } /^ +FD[CPRS]E / { ff += $2 } /^ +DSP48E1 / { dsp += $2 }
    /^ +RAMB18E1 / { bram += $2 } /^ +RAMB36E1 / { bram += 2 * $2 }
    # LUTs that these take
    /^ +(SRL16E|SRLC32E|RAM(32|64)X1S) / { lutram += $2 } /^ +(RAM(32|64)X1D|RAM128X1S) / { lutram += 2 * $2 }
    /^ +(RAM(32|64)M|RAM128X1D|RAM256X1S) / { lutram += 4 * $2 }
    END {
        if (!whole) { print "area of " name ": no counts"; exit 1 }
        printf "area of %s: LUT=%d FF=%d DSP=%d BRAM18=%d LUTRAM=%d\n", name, lut, ff, dsp, bram, lutram
    }' stat
