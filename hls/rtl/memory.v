// SPDX-License-Identifier: Apache-2.0
// Memories of a block: a word is read at the place given in the clock before, what that clock wrote included. Word 0 powers up as 0.
// What is written lies in a register for a clock, so that no path to a memory is long; with NEAR a word that is asked for while it
// lies there, or in the clock in which it goes on, comes from the registers. Without, no word may be asked for then.
module drogue_memory #(parameter WORDS = 2, parameter BITS = 8, parameter ADDRESS = 1, parameter NEAR = 1) (
    input wire clock, input wire enable,
    input wire write, input wire [ADDRESS-1:0] write_at, input wire [BITS-1:0] word,
    input wire [ADDRESS-1:0] at, output wire [BITS-1:0] read);
    (* no_rw_check *) reg [BITS-1:0] words [0:WORDS-1];
    reg [BITS-1:0] stored, last_word, older_word;
    reg [ADDRESS-1:0] place, last_at, older_at;
    reg last = 1'b0, older = 1'b0;
    initial words[0] = 0;
    always @(posedge clock) if (enable) begin
        if (last) words[last_at] <= last_word;
        stored <= words[at];
        place <= at;
        {last, last_at, last_word} <= {write, write_at, word};
        {older, older_at, older_word} <= {last, last_at, last_word};
    end
    generate if (NEAR != 0) begin : near
        wire is_last = last && last_at == place, is_older = older && older_at == place;
        assign read = is_last ? last_word : is_older ? older_word : stored;
    end else begin : later
        assign read = stored;
    end endgenerate
endmodule

// The same with two places to read.
module drogue_memory_2 #(parameter WORDS = 2, parameter BITS = 8, parameter ADDRESS = 1) (
    input wire clock, input wire enable,
    input wire write, input wire [ADDRESS-1:0] write_at, input wire [BITS-1:0] word,
    input wire [ADDRESS-1:0] at, output wire [BITS-1:0] read,
    input wire [ADDRESS-1:0] at_2, output wire [BITS-1:0] read_2);
    drogue_memory #(.WORDS(WORDS), .BITS(BITS), .ADDRESS(ADDRESS)) first (
        .clock(clock), .enable(enable), .write(write), .write_at(write_at), .word(word), .at(at), .read(read));
    drogue_memory #(.WORDS(WORDS), .BITS(BITS), .ADDRESS(ADDRESS)) second (
        .clock(clock), .enable(enable), .write(write), .write_at(write_at), .word(word), .at(at_2), .read(read_2));
endmodule
