// SPDX-License-Identifier: Apache-2.0
// The front end's register bank, ../driver/registers.h, its lists, and what reads a region out of the frame memory for it.
module drogue_bank (
    input wire clock, input wire reset,
    // the processor's: a word a clock, what is read comes a clock later
    input wire select, input wire write, input wire [17:0] at, input wire [31:0] word, output reg [31:0] read,
    output wire irq, // a level: high from the end of a frame until INTERRUPT is 0 or the next START
    // the frame memory's: the word about the pixel that lies at 'frame_at', a clock later
    output wire running, output wire [31:0] frame_at, input wire [31:0] frame_word);
    `include "sizes.vh" // WIDTH, EDGES, ARCS, LABELS of the block, ../rtl/rtl.sh
    localparam EDGE_BITS = $clog2(EDGES), ARC_BITS = $clog2(ARCS);
    reg [31:0] asked [0:11]; // WIDTH_PX .. STRIDE
    reg started, done, interrupting, was_running;
    wire busy, listing, pixel_ready, edge_write, arc_write;
    wire [EDGE_BITS-1:0] edge_at;
    wire [ARC_BITS-1:0] arc_at;
    wire [63:0] edge_word, arc_word;
    wire [31:0] status, edge_count, arc_count;
    wire control = select && write && at == 18'h10;
    wire start = control && word[0] && !busy && !started;
    wire stop = reset || (control && word[1]);
    reg [31:0] source, row; // of the pixels asked for ahead
    reg [11:0] column;
    reg [1:0] byte_of, ahead;
    reg asked_for;
    reg [7:0] waiting [0:2];
    integer k;
    generate if (EDGES > 8192 || ARCS > 8192) begin : refused // 718 px
        drogue_lists_are_longer_than_the_register_map error ();
    end endgenerate
    initial for (k = 0; k < 12; k = k + 1) asked[k] = 0;

    drogue_frontend block (
        .clock(clock), .reset(stop), .start(started), .busy(busy), .width_px(asked[0]), .height_px(asked[1]),
        .canny_low(asked[2]), .canny_high(asked[3]), .smooth(asked[4]), .min_arc_px(asked[5]), .use_ring(asked[6]),
        .centre2_x(asked[7]), .centre2_y(asked[8]), .longest_px(asked[9]), .pixel_valid(1'b1), .pixel(waiting[0]),
        .pixel_ready(pixel_ready), .edge_write(edge_write), .edge_at(edge_at), .edge_word(edge_word),
        .arc_write(arc_write), .arc_at(arc_at), .arc_word(arc_word), .status(status), .edge_count(edge_count),
        .arc_count(arc_count), .listing(listing));

    // The region's pixels in raster order, asked for ahead of the block, by registers alone: the way from the block to the frame
    // memory would be the longest. Three ahead are enough for one a clock, and the block squares for more than twenty clocks before
    // it takes its first (SQUARE_BITS in ../frontend/step.c): one is there whenever it takes one.
    wire last = column == asked[0][11:0] - 12'd1;
    wire asks = running && !started && {1'b0, ahead} + {2'd0, asked_for} < 3'd3;
    wire [1:0] left = ahead - {1'b0, pixel_ready};
    assign running = started || busy;
    assign frame_at = source;
    wire [7:0] came = frame_word[8 * byte_of +: 8];
    always @(posedge clock) begin
        asked_for <= asks;
        byte_of <= source[1:0];
        if (started) begin
            source <= asked[10];
            row <= asked[10] + asked[11];
            column <= 12'd0;
            ahead <= 2'd0;
        end else begin
            if (asks) begin
                source <= last ? row : source + 32'd1;
                column <= last ? 12'd0 : column + 12'd1;
                if (last) row <= row + asked[11];
            end
            if (pixel_ready) begin
                waiting[0] <= waiting[1];
                waiting[1] <= waiting[2];
            end
            if (asked_for) waiting[left] <= came;
            ahead <= left + {1'b0, asked_for};
        end
    end

    always @(posedge clock) begin
        started <= start;
        if (stop || start) done <= 1'b0;
        else if (was_running && !running) done <= 1'b1;
        if (select && write && !busy && at >= 18'h20 && at < 18'h50) asked[at[5:2] - 4'd8] <= word;
        if (select && write && at == 18'h18) interrupting <= word[0];
        if (reset) begin
            started <= 1'b0;
            interrupting <= 1'b0;
        end
    end
    always @(posedge clock) was_running <= running && !stop;
    assign irq = interrupting && done;

    // The lists, a half of a word a memory.
    reg [31:0] edges_low [0:EDGES-1];
    reg [31:0] edges_high [0:EDGES-1];
    reg [31:0] arcs_low [0:ARCS-1];
    reg [31:0] arcs_high [0:ARCS-1];
    reg [31:0] edge_low, edge_high, arc_low, arc_high, plain;
    reg [17:0] was_at;
    always @(posedge clock) begin
        if (edge_write) begin
            edges_low[edge_at] <= edge_word[31:0];
            edges_high[edge_at] <= edge_word[63:32];
        end
        if (arc_write) begin
            arcs_low[arc_at] <= arc_word[31:0];
            arcs_high[arc_at] <= arc_word[63:32];
        end
        edge_low <= edges_low[at[3 +: EDGE_BITS]];
        edge_high <= edges_high[at[3 +: EDGE_BITS]];
        arc_low <= arcs_low[at[3 +: ARC_BITS]];
        arc_high <= arcs_high[at[3 +: ARC_BITS]];
        was_at <= at;
        case (at)
            18'h00: plain <= 32'h44524731;
            18'h04: plain <= WIDTH;
            18'h08: plain <= EDGES;
            18'h0C: plain <= ARCS;
            18'h1C: plain <= LABELS;
            18'h14: plain <= {30'd0, done, running || was_running}; // never neither from START on
            18'h50: plain <= status;
            18'h54: plain <= edge_count;
            18'h58: plain <= arc_count;
            default: plain <= 32'd0;
        endcase
    end
    always @(*) case (was_at[17:16])
        2'd1: read = was_at[2] ? edge_high : edge_low;
        2'd2: read = was_at[2] ? arc_high : arc_low;
        default: read = plain;
    endcase
endmodule
