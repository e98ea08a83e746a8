// SPDX-License-Identifier: Apache-2.0
// The front end by itself between registers: its inputs from a chain, its outputs folded into one bit, so that every path of it
// lies between registers and few pins are needed.
module drogue_frontend_alone (input wire clock, input wire serial, output reg folded);
    reg [331:0] in;
    wire [11:0] edge_at;
    wire [6:0] arc_at;
    wire [63:0] edge_word, arc_word;
    wire [31:0] status, edge_count, arc_count;
    wire busy, pixel_ready, edge_write, arc_write, listing;
    reg [248:0] out;
    drogue_frontend block (
        .clock(clock), .reset(in[330]), .start(in[329]), .busy(busy), .width_px(in[31:0]), .height_px(in[63:32]),
        .canny_low(in[95:64]), .canny_high(in[127:96]), .smooth(in[159:128]), .min_arc_px(in[191:160]),
        .use_ring(in[223:192]), .centre2_x(in[255:224]), .centre2_y(in[287:256]), .longest_px(in[319:288]),
        .pixel_valid(in[328]), .pixel(in[327:320]), .pixel_ready(pixel_ready), .edge_write(edge_write),
        .edge_at(edge_at), .edge_word(edge_word), .arc_write(arc_write), .arc_at(arc_at), .arc_word(arc_word),
        .status(status), .edge_count(edge_count), .arc_count(arc_count), .listing(listing));
    always @(posedge clock) begin
        in <= {in[330:0], serial};
        if (in[331])
            out <= {busy, pixel_ready, edge_write, edge_at, edge_word, arc_write, arc_at, arc_word, status, edge_count,
                arc_count, listing};
        else
            out <= out << 1;
        folded <= out[248];
    end
endmodule
