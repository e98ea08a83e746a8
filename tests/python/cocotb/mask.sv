// SPDX-License-Identifier: Apache-2.0
// The ring mask (include/drogue/mask.h) in Verilog: a pixel a clock in raster order. All in units of half a pixel,
// squared: longest / 3 to longest / 2 from the centre.
module mask (
    input  logic               clk,
    input  logic               start,
    input  logic        [15:0] width,
    input  logic        [15:0] height,
    input  logic signed [31:0] centre2_x,
    input  logic signed [31:0] centre2_y,
    input  logic        [31:0] longest,
    output logic               valid,
    output logic         [7:0] ring
);
    logic [15:0] x, y;
    logic signed [63:0] dx, dy, distance, side;

    initial valid = 0;

    assign dx = 2 * $signed({48'b0, x}) - 64'(centre2_x);
    assign dy = 2 * $signed({48'b0, y}) - 64'(centre2_y);
    assign distance = dx * dx + dy * dy;
    assign side = $signed({32'b0, longest}) * $signed({32'b0, longest});
    assign ring = (9 * distance >= 4 * side && distance <= side) ? 8'd255 : 8'd0;

    always_ff @(posedge clk)
        if (start) begin
            x <= 0;
            y <= 0;
            valid <= 1;
        end else if (valid) begin
            x <= x + 1 == width ? 0 : x + 1;
            if (x + 1 == width) begin
                y <= y + 1;
                valid <= y + 1 != height;
            end
        end
endmodule
