# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# Sourced, in the project's folder: what the simulations of the small system are built of, in build/hls/system.
# The soft core is the Verilog of the Python package pythondata-cpu-vexriscv: DROGUE_VEXRISCV, or what python3 finds.
. src/sources.sh
root=$PWD
made=$root/build/hls/system

# need WHO TOOL...: exit 77 where the core or a tool is absent; sets core, without the instruction cache that is icache.v's, with a data
# cache of 8 KB where the package has 4, since as many block RAMs hold it, and with its registers in LUTs. What the data cache reads in
# the clock of its writing is no matter, and no address waits for a comparison: such a word is read once more (dataColisions), tags are
# written while execute is halted. In simulation such a word is a wrong one, such a tag the one that was asked for.
# What waited for the longest ways does so no more: the registers are read as an instruction is decoded, not ahead of that, behind the
# instruction cache and what holds decoding up; branches compare registers, not what is chosen for other instructions in their place;
# the bus has no errors; whether the program counter goes on is but a gate behind what says whether fetch takes an instruction.
# An instruction for a unit waits for no store before it: none is taken back, as a load is that misses.
need() {
    local tool who=$1
    for tool in "${@:2}"; do
        command -v "$tool" >/dev/null || { echo "$who: SKIPPED: no $tool" && exit 77; }
    done
    core=${DROGUE_VEXRISCV:-$(python3 -c 'import pythondata_cpu_vexriscv as v
print(v.data_location + "/VexRiscv_FullCfu.v")' 2>/dev/null || true)}
    [ -e "$core" ] || { echo "$who: SKIPPED: no pythondata-cpu-vexriscv" && exit 77; }
    mkdir -p "$made"
    sed -e '/^module InstructionCache (/,/^endmodule/d' -e '/RegFilePlugin_regFile \[/s/"block"/"distributed"/' \
        -e '/^  always @(posedge clk) begin$/{N; s/(posedge clk)\( begin\n *if(_zz_decode_RegFilePlugin_rs[12]Data)\)/(*)\1/; }' \
        -e '/_zz_RegFilePlugin_regFile_port[01] <=/s/<=/=/' \
        -e '/decode_RegFilePlugin_regFileReadAddress[12] =/s/_ANTICIPATED//' \
        -e '/execute_BranchPlugin_eq =/s/SRC\([12]\)/RS\1/g' \
        -e '/_zz_execute_BRANCH_COND_RESULT = /s/execute_SRC_LESS/branch_less/' \
        -e '/^  assign execute_BranchPlugin_eq/i wire branch_less = {execute_RS1[31] ^ !execute_INSTRUCTION[13], execute_RS1[30:0]} <\
            {execute_RS2[31] ^ !execute_INSTRUCTION[13], execute_RS2[30:0]};' \
        -e '/execute_to_memory_HAS_SIDE_EFFECT <=/s/;/ \&\& !(execute_MEMORY_ENABLE \&\& execute_MEMORY_WR);/' \
        -e 's/\(stageB_tagsReadRsp_0_error <=\).*/\1 1'\''b0;/' \
        -e 's/\(IBusCachedPlugin_fetchPc_output_fire_1 =\).*/\1 1'\''b1;/; s/\(when_Fetcher_l134_1 =\).*/\1 1'\''b0;/' \
        -e 's/\(IBusCachedPlugin_fetchPc_inc <=\) 1.*1;/\1 IBusCachedPlugin_fetchPc_pcRegPropagate ?\
            IBusCachedPlugin_iBusRsp_stages_0_output_valid : IBusCachedPlugin_fetchPc_inc \&\& !IBusCachedPlugin_fetchPc_correction;/' \
        -e '/^module DataCache (/,/^endmodule/{
        s/ram_style = "block"/&, no_rw_check/
        s/\(_zz_ways_0_datasymbol_read[_0-9]*\) <= ways_0_data_symbol\([0-3]\)\[.*/&\n`ifdef VERILATOR\
            if (_zz_1 \&\& dataWriteCmd_payload_mask[\2] \&\& dataWriteCmd_payload_address == dataReadCmd_payload) \1 <= 8'\''hA5;\n`endif/
        s/_zz_ways_0_tags_port0 <= ways_0_tags\[.*/&\n`ifdef VERILATOR\
            if (_zz_2 \&\& tagsWriteCmd_payload_address == tagsReadCmd_payload)\
                _zz_ways_0_tags_port0 <= {io_cpu_execute_address[31:12], 2'\''b01};\n`endif/
        s/\[9:0\]/[10:0]/; s/\[6:0\]/[7:0]/; s/\[11 : \([25]\)\]/[12 : \1]/g; s/\[0:127\]/[0:255]/; s/\[0:1023\]/[0:2047]/
        /stageB_flusher_counter/{ s/\[7:0\] *stageB/[8:0] stageB/; s/\[7\]/[8]/; s/8'\''h/9'\''h/g; }
    }' "$core" >"$made/VexRiscv.v"
    core=$made/VexRiscv.v
}

# firmware FOLDER SOURCE [FLAG...]: a program of the soft core, linked with the library and the driver
firmware() {
    # what the soft core's clocks go into, and where reals stand where they are called; all else is small, so that it fits the RAM at
    # 256 px, and shares the code that saves registers
    local hot=(src/arithmetic/{fixed,real}.c src/outline/{cluster,constraints,rays,slopes,support}.c
        src/search/cells.c)
    local reals=(src/arithmetic/{cholesky,eigen}.c src/track/kalman.c src/outline/{ellipse,moments,quality}.c src/pose/{joint,joint_model}.c)
    local flags=(-mtune=size -march=rv32im -mabi=ilp32 -std=c99 -Os -ffunction-sections -fdata-sections "-I$root/include" "-I$root/hls" "${@:3}")
    rm -rf "$1/objects"
    mkdir -p "$1/objects"
    (cd "$1/objects" && core_files "$root" '*.c' | xargs riscv64-unknown-elf-gcc --specs=picolibc.specs "${flags[@]}" -msave-restore -c &&
        riscv64-unknown-elf-gcc --specs=picolibc.specs "${flags[@]}" -msave-restore "$root/hls/system/look.c" -c &&
        riscv64-unknown-elf-gcc --specs=picolibc.specs "${flags[@]}" -O2 "${hot[@]/#/$root/}" -c &&
        riscv64-unknown-elf-gcc --specs=picolibc.specs "${flags[@]}" -O2 -mtune=rocket -DREAL_WHERE_CALLED -include "$root/hls/system/real.c" \
            "${reals[@]/#/$root/}" -c)
    # what hls/system has by the units goes before the library's; what that calls stays strong, or no archive would give it
    local own
    for own in fixed real near rays fit shade track; do
        riscv64-unknown-elf-nm -g --defined-only --just-symbols "$1/objects/$own.o" >"$1/objects/$own.symbols"
        riscv64-unknown-elf-objcopy --weaken-symbols="$1/objects/$own.symbols" "$1/objects/$own.o"
    done
    rm -f "$1/libdrogue.a"
    riscv64-unknown-elf-ar rcs "$1/libdrogue.a" "$1"/objects/*.o
    riscv64-unknown-elf-gcc --specs=picolibc.specs "${flags[@]}" -nostartfiles -Wl,--gc-sections,--no-warn-rwx-segments \
        -T hls/system/system.ld -O2 -fno-tree-loop-distribute-patterns hls/system/start.S "$2" \
        hls/system/{fixed,real,near,rays,fit,shade,track,memory,block}.c "$1/libdrogue.a" -o "$1/firmware.elf"
    riscv64-unknown-elf-objcopy -O verilog --verilog-data-width=4 "$1/firmware.elf" "$1/firmware.hex"
    riscv64-unknown-elf-size "$1/firmware.elf" |
        awk 'NR == 2 { print "system: firmware " $1 " bytes of code and constants, " $2 + $3 " of data" }'
}

# model: the system's Verilog as C++, and the library for this machine
model() {
    hls/rtl/rtl.sh 256
    hls/system/unit.sh
    mkdir -p "$made/objects"
    verilator --cc --build -O3 --x-assign fast --x-initial fast -Wall -Mdir "$made/verilated" \
        --top-module drogue_system "-GFIRMWARE=\"firmware.hex\"" -Ibuild/hls/rtl/256 hls/system/lint.vlt \
        hls/system/{system,bank,unit,icache}.v \
        build/hls/system/unit/units.v build/hls/rtl/256/drogue_frontend.v "$core" -CFLAGS -O2 >"$made/verilator.log" 2>&1 ||
        { tail -n 20 "$made/verilator.log" && exit 1; }
    (cd "$made/objects" && core_files "$root" '*.c' | xargs gcc -std=c99 -O2 "-I$root/include" -c)
    rm -f "$made/libdrogue.a"
    ar rcs "$made/libdrogue.a" "$made"/objects/*.o
}

# bench PROGRAM SOURCE [FLAG | OBJECT]...
bench() {
    local verilator_root
    verilator_root=$(verilator --getenv VERILATOR_ROOT)
    g++ -O2 "-I$root/include" "-I$root/hls" "-I$made/verilated" "-I$verilator_root/include" \
        "-I$verilator_root/include/vltstd" "$2" "${@:3}" \
        "$verilator_root"/include/verilated{,_threads}.cpp "$made/verilated/Vdrogue_system__ALL.a" "$made/libdrogue.a" -pthread -o "$1"
}
