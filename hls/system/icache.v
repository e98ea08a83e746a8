// SPDX-License-Identifier: Apache-2.0
// The soft core's instruction cache, in the place of the package's module of this name and with its ports: 16 KB where that has 4,
// and the core goes on as soon as the word that it misses is there, not when all of its line is. One way: the way from a tag by the
// choice of a word to the register file was the longest of all.
//
// A word is read in the clock of its address in prefetch, found or missed in fetch, and said to be missed in decode. Then the core
// fetches it again, which waits until it has come, and what follows it is fetched behind the words as they come. What overtakes them
// is missed once more, and waits for the whole line.
module InstructionCache (
    input wire clk, input wire reset, input wire io_flush,
    input wire io_cpu_prefetch_isValid, output wire io_cpu_prefetch_haltIt, input wire [31:0] io_cpu_prefetch_pc,
    input wire io_cpu_fetch_isValid, input wire io_cpu_fetch_isStuck, input wire io_cpu_fetch_isRemoved,
    input wire [31:0] io_cpu_fetch_pc, output wire [31:0] io_cpu_fetch_data, output wire [31:0] io_cpu_fetch_physicalAddress,
    // addresses are not translated, and none is refused
    input wire [31:0] io_cpu_fetch_mmuRsp_physicalAddress, input wire io_cpu_fetch_mmuRsp_isIoAccess,
    input wire io_cpu_fetch_mmuRsp_isPaging, input wire io_cpu_fetch_mmuRsp_allowRead, input wire io_cpu_fetch_mmuRsp_allowWrite,
    input wire io_cpu_fetch_mmuRsp_allowExecute, input wire io_cpu_fetch_mmuRsp_exception,
    input wire io_cpu_fetch_mmuRsp_refilling, input wire io_cpu_fetch_mmuRsp_bypassTranslation,
    input wire io_cpu_decode_isValid, input wire io_cpu_decode_isStuck, input wire io_cpu_decode_isUser,
    input wire [31:0] io_cpu_decode_pc, output reg [31:0] io_cpu_decode_physicalAddress, output reg [31:0] io_cpu_decode_data,
    output reg io_cpu_decode_cacheMiss, output wire io_cpu_decode_error, output wire io_cpu_decode_mmuRefilling,
    output wire io_cpu_decode_mmuException,
    input wire io_cpu_fill_valid, input wire [31:0] io_cpu_fill_payload,
    output wire io_mem_cmd_valid, input wire io_mem_cmd_ready, output wire [31:0] io_mem_cmd_payload_address,
    output wire [2:0] io_mem_cmd_payload_size,
    input wire io_mem_rsp_valid, input wire [31:0] io_mem_rsp_payload_data, input wire io_mem_rsp_payload_error);
    localparam LINES = 512; // of eight words
    // What a word or a tag reads in the clock of its writing is no matter, and its address waits for no comparison with the one written.
    // A line's tag is written before its first word has come, and all are cleared, while prefetch halts: what is read then no one takes.
    // A word that comes behind its line's tag is 'to_come' where it belongs to the address that was asked for, and else its tag is not
    // that of the address; either way it is missed.
    (* no_rw_check *) reg [31:0] words [0:8*LINES-1];
    (* no_rw_check *) reg [18:0] tags [0:LINES-1]; // valid, address

    reg loading, asked, overtaken;
    reg [31:0] missed;  // the word that is waited for; its line comes
    reg [2:0] come;     // words of it, of which the last ends the loading
    reg [9:0] clearing; // from line 0 on: LINES is the end

    assign io_cpu_prefetch_haltIt =
        !clearing[9] || io_flush || io_cpu_fill_valid || (loading && (overtaken || come <= missed[4:2]));
    assign io_mem_cmd_valid = loading && !asked;
    assign io_mem_cmd_payload_address = {missed[31:5], 5'd0};
    assign io_mem_cmd_payload_size = 3'd5;

    reg [31:0] word;
    reg [18:0] tag;
    reg was_loading; // when the word was read, and so many words had come
    reg [2:0] had_come;
    wire tags_line = loading && !asked;
    wire [8:0] line = clearing[9] ? missed[13:5] : clearing[8:0];
    always @(posedge clk) begin
        if (!io_cpu_fetch_isStuck) begin
            word <= words[io_cpu_prefetch_pc[13:2]];
            tag <= tags[io_cpu_prefetch_pc[13:5]];
            was_loading <= loading;
            had_come <= come;
        end
        if (!clearing[9] || tags_line) tags[line] <= {clearing[9], missed[31:14]};
        if (io_mem_rsp_valid) words[{missed[13:5], come}] <= io_mem_rsp_payload_data;
    end

    wire to_come = was_loading && io_cpu_fetch_pc[31:5] == missed[31:5] && io_cpu_fetch_pc[4:2] >= had_come;
    assign io_cpu_fetch_data = word;
    assign io_cpu_fetch_physicalAddress = io_cpu_fetch_pc;
    assign {io_cpu_decode_error, io_cpu_decode_mmuRefilling, io_cpu_decode_mmuException} = 3'd0;
    always @(posedge clk) if (!io_cpu_decode_isStuck) begin
        io_cpu_decode_data <= io_cpu_fetch_data;
        io_cpu_decode_physicalAddress <= io_cpu_fetch_pc;
        io_cpu_decode_cacheMiss <= tag != {1'b1, io_cpu_fetch_pc[31:14]} || to_come;
    end

    wire starts = io_cpu_fill_valid && !loading;
    always @(posedge clk) begin
        if (starts) missed <= io_cpu_fill_payload;
        asked <= loading && (asked || io_mem_cmd_ready);
        overtaken <= loading && (overtaken || io_cpu_fill_valid);
        if (io_mem_rsp_valid) come <= come + 3'd1;
        loading <= starts || (loading && !(io_mem_rsp_valid && come == 3'd7));
        if (!clearing[9]) clearing <= clearing + 10'd1;
        if (reset) {loading, asked, overtaken, come} <= 6'd0;
        if (reset || io_flush) clearing <= 10'd0;
    end

`ifdef VERILATOR
    // Stops where the core takes what was read in the clock of its writing.
    reg tag_unknown, word_unknown, taken_unknown;
    always @(posedge clk) begin
        if (!io_cpu_fetch_isStuck) begin
            tag_unknown <= (!clearing[9] || tags_line) && io_cpu_prefetch_pc[13:5] == line;
            word_unknown <= io_mem_rsp_valid && io_cpu_prefetch_pc[13:2] == {missed[13:5], come};
        end
        if (!io_cpu_decode_isStuck) taken_unknown <= tag_unknown || (word_unknown && !(tag != {1'b1, io_cpu_fetch_pc[31:14]} || to_come));
        if (!reset && io_cpu_decode_isValid && taken_unknown) begin
            $display("icache: %x was read while it was written", io_cpu_decode_pc);
            $stop;
        end
    end
`endif
endmodule
