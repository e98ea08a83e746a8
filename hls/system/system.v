// SPDX-License-Identifier: Apache-2.0
// A small system: camera -> frame memory -> front end -> lists -> VexRiscv, which runs the library after the lists.
//
//   0x00000000  RAM: firmware, its data and stack
//   0x40000000  frame memory, to read; the processor waits for the front end, the camera for both
//   0x80000000  the front end's registers and lists, bank.v; not cached, like all from here on
//   0x90000000  CAPTURE: write, pixels of the next frame to take; read, 1 when they are there
//   0x90000004  RESULT: words that go out
module drogue_system #(
    parameter RAM_WORDS = 53248, parameter FRAME_WORDS = 16384, parameter FIRMWARE = "firmware.hex") (
    input wire clock, input wire reset,
    input wire camera_valid, input wire camera_first, input wire [7:0] camera_pixel, output wire camera_ready,
    output wire result_valid, output wire [31:0] result,
    output wire block_busy, output wire list_read, output wire captured);
    wire i_cycle, i_strobe, d_cycle, d_strobe, d_write;
    wire [29:0] i_at, d_at;
    wire [31:0] d_word;
    wire [3:0] d_bytes;
    wire [2:0] i_burst, d_burst;
    reg [31:0] i_read, d_read;
    wire [31:0] ram_read, frame_read, bank_read;
    wire irq;

    wire unit_asked, unit_ready, unit_answered, unit_taken;
    wire [9:0] unit_function;
    wire [31:0] unit_first, unit_second, unit_answer, ray_at;
    wire ray_free;
    wire running; // the front end
    wire i_done, d_done;

    VexRiscv core (
        .externalResetVector(32'd0), .timerInterrupt(1'b0), .softwareInterrupt(1'b0),
        .externalInterruptArray({31'd0, irq}), .clk(clock), .reset(reset),
        .CfuPlugin_bus_cmd_valid(unit_asked), .CfuPlugin_bus_cmd_ready(unit_ready),
        .CfuPlugin_bus_cmd_payload_function_id(unit_function), .CfuPlugin_bus_cmd_payload_inputs_0(unit_first),
        .CfuPlugin_bus_cmd_payload_inputs_1(unit_second), .CfuPlugin_bus_rsp_valid(unit_answered),
        .CfuPlugin_bus_rsp_ready(unit_taken), .CfuPlugin_bus_rsp_payload_outputs_0(unit_answer),
        .iBusWishbone_CYC(i_cycle), .iBusWishbone_STB(i_strobe), .iBusWishbone_ACK(i_done), .iBusWishbone_WE(),
        .iBusWishbone_ADR(i_at), .iBusWishbone_DAT_MISO(i_read), .iBusWishbone_DAT_MOSI(), .iBusWishbone_SEL(),
        .iBusWishbone_ERR(1'b0), .iBusWishbone_CTI(i_burst), .iBusWishbone_BTE(),
        .dBusWishbone_CYC(d_cycle), .dBusWishbone_STB(d_strobe), .dBusWishbone_ACK(d_done), .dBusWishbone_WE(d_write),
        .dBusWishbone_ADR(d_at), .dBusWishbone_DAT_MISO(d_read), .dBusWishbone_DAT_MOSI(d_word),
        .dBusWishbone_SEL(d_bytes), .dBusWishbone_ERR(1'b0), .dBusWishbone_CTI(d_burst), .dBusWishbone_BTE());
    drogue_unit units (
        .clock(clock), .reset(reset), .asked(unit_asked), .ready(unit_ready), .function_id(unit_function),
        .first(unit_first), .second(unit_second), .answers(unit_answered), .taken(unit_taken), .says(unit_answer),
        .frame_at(ray_at), .frame_free(ray_free), .frame_word(frame_read));

    // A word that is read comes three clocks after it was asked for: the way to so many block RAMs and the way from there are long,
    // and registers lie before and after. Of a cache line the next word is asked for each clock. What is written is done at once. Data
    // go before instructions: there is one address.
    reg [2:0] d_ahead, i_ahead; // words asked for that have not come: on the way there, in the memory, on the way back
    wire [1:0] d_under_way = {1'b0, d_ahead[0]} + {1'b0, d_ahead[1]} + {1'b0, d_ahead[2]};
    wire [1:0] i_under_way = {1'b0, i_ahead[0]} + {1'b0, i_ahead[1]} + {1'b0, i_ahead[2]};
    wire d_line = d_burst != 3'd0 && !d_write;
    wire [3:0] d_of_line = {1'b0, d_at[2:0]} + {2'd0, d_under_way}, i_of_line = {1'b0, i_at[2:0]} + {2'd0, i_under_way};
    wire d_asks = d_cycle && d_strobe && (d_line ? !d_of_line[3] : d_ahead == 3'd0);
    wire i_asks = i_cycle && i_strobe && !i_of_line[3];
    wire d_ram = d_asks && d_at[29:28] == 2'd0;
    wire d_frame = d_asks && d_at[29:28] == 2'd1 && !running;
    wire d_bank = d_asks && d_at[29:26] == 4'd8;
    wire d_own = d_asks && d_at[29:26] == 4'd9;
    wire d_given = d_ram || d_frame || d_bank || d_own, i_given = i_asks && !d_ram && !d_frame && !d_bank;
    assign d_done = d_ahead[2] || (d_given && d_write);
    assign i_done = i_ahead[2];
    reg [29:0] place; // of what goes to RAM, frame memory or the front end's registers
    reg [31:0] word;
    reg [3:0] ram_write;
    reg bank_write, to_frame, to_bank, to_own, from_frame, from_bank, from_own;
    always @(posedge clock) begin
        d_ahead <= reset ? 3'd0 : {d_ahead[1:0], d_given && !d_write};
        i_ahead <= reset ? 3'd0 : {i_ahead[1:0], i_given};
        place <= i_given ? {i_at[29:3], i_of_line[2:0]} : {d_at[29:3], d_line ? d_of_line[2:0] : d_at[2:0]};
        word <= d_word;
        ram_write <= d_bytes & {4{d_ram && d_write}};
        bank_write <= d_write;
        {to_frame, to_bank, to_own} <= {d_frame && !d_write, !reset && d_bank, d_own};
        {from_frame, from_bank, from_own} <= {to_frame, to_bank, to_own};
        d_read <= from_bank ? bank_read : from_own ? {31'd0, captured} : from_frame ? frame_read : ram_read;
        i_read <= ram_read;
    end

    // The most of the RAM in block RAMs of a bit each, which need the fewest of them for a bit and so the shortest way out; the rest,
    // which the firmware begins without, apart.
    localparam LOW_WORDS = RAM_WORDS / 16384 * 16384;
    generate if (LOW_WORDS == 0 || LOW_WORDS == RAM_WORDS) begin : refused
        drogue_ram_words_are_below_16384_or_a_multiple_of_it error ();
    end endgenerate
    wire [$clog2(RAM_WORDS)-1:0] ram_at = place[$clog2(RAM_WORDS)-1:0];
    wire high = ram_at >= LOW_WORDS;
    wire [31:0] low_read, high_read;
    reg was_high;
    always @(posedge clock) was_high <= high;
    assign ram_read = was_high ? high_read : low_read;
    drogue_ram #(.WORDS(LOW_WORDS), .CONTENTS(FIRMWARE)) low_ram (
        .clock(clock), .enable(1'b1), .write(ram_write & {4{!high}}), .at(ram_at), .word(word), .read(low_read));
    drogue_ram #(.WORDS(RAM_WORDS - LOW_WORDS), .CONTENTS("")) high_ram (
        .clock(clock), .enable(1'b1), .write(ram_write & {4{high}}), .at(ram_at[$clog2(RAM_WORDS - LOW_WORDS)-1:0]),
        .word(word), .read(high_read));

    // The frame memory: the processor's while a word is on its way, which none is while the front end runs; else the front end's, the
    // camera's when it brings a pixel, the rays' unit's.
    wire [31:0] block_at;
    reg [31:0] wanted, taken;
    wire between = !camera_first && taken == 32'd0; // a pixel of no frame that is wanted: taken and dropped
    wire takes = camera_valid && camera_ready && !between;
    wire [31:0] pixel = camera_first ? 32'd0 : taken;
    assign captured = wanted == 32'd0;
    assign camera_ready = between || (!captured && !running && !to_frame);
    assign ray_free = !running && !takes && !to_frame;
    wire [31:0] frame_at = to_frame ? {place, 2'd0} : running ? block_at : takes ? pixel : ray_at;
    drogue_ram #(.WORDS(FRAME_WORDS), .CONTENTS("")) frame (
        .clock(clock), .enable(1'b1), .write(takes ? 4'd1 << pixel[1:0] : 4'd0),
        .at(frame_at[2 +: $clog2(FRAME_WORDS)]), .word({4{camera_pixel}}), .read(frame_read));
    always @(posedge clock) begin
        if (reset) begin
            wanted <= 32'd0;
            taken <= 32'd0;
        end else if (d_own && !d_at[0] && d_write) begin
            wanted <= d_word;
            taken <= 32'd0;
        end else if (takes) begin
            taken <= pixel + 32'd1 == wanted ? 32'd0 : pixel + 32'd1;
            if (pixel + 32'd1 == wanted) wanted <= 32'd0;
        end
    end

    drogue_bank bank (
        .clock(clock), .reset(reset), .select(to_bank), .write(bank_write), .at({place[15:0], 2'd0}), .word(word),
        .read(bank_read), .irq(irq), .running(running), .frame_at(block_at), .frame_word(frame_read));
    assign result_valid = d_own && d_at[0] && d_write;
    assign result = d_word;
    assign block_busy = running;
    assign list_read = d_bank && d_at[15:14] != 2'd0;
endmodule

// A memory of words with a write enable a byte; what is read comes a clock later.
module drogue_ram #(parameter WORDS = 1024, parameter CONTENTS = "") (
    input wire clock, input wire enable, input wire [3:0] write, input wire [$clog2(WORDS)-1:0] at,
    input wire [31:0] word, output reg [31:0] read);
    reg [31:0] words [0:WORDS-1];
    generate if (CONTENTS != "") begin : filled
        initial $readmemh(CONTENTS, words);
    end endgenerate
    integer k;
    always @(posedge clock) if (enable) begin
        for (k = 0; k < 4; k = k + 1) if (write[k]) words[at][8 * k +: 8] <= word[8 * k +: 8];
        read <= words[at];
    end
endmodule
