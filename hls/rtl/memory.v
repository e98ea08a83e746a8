// SPDX-License-Identifier: Apache-2.0
// Memories of a block: a word is read at the place given in the clock before, what that clock wrote included. Word 0 powers up as 0.
module drogue_memory #(parameter WORDS = 2, parameter BITS = 8, parameter ADDRESS = 1) (
    input wire clock, input wire enable,
    input wire write, input wire [ADDRESS-1:0] write_at, input wire [BITS-1:0] word,
    input wire [ADDRESS-1:0] at, output wire [BITS-1:0] read);
    reg [BITS-1:0] words [0:WORDS-1];
    reg [ADDRESS-1:0] place;
    initial words[0] = 0;
    always @(posedge clock) if (enable) begin
        if (write) words[write_at] <= word;
        place <= at;
    end
    assign read = words[place];
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
