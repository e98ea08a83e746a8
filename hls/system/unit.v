// SPDX-License-Identifier: Apache-2.0
// The units beside the soft core, reached by its instructions of opcode custom-0: function is {funct7, funct3}, unit.h.
module drogue_unit (
    input wire clock, input wire reset,
    input wire asked, output wire ready, input wire [9:0] function_id, input wire [31:0] first, input wire [31:0] second,
    output reg answered, input wire taken, output reg [31:0] answer);
    // Reals, mantissa and exponent: a, b, c were told before the operation, which brings d.
    reg [63:0] a, b, c, d;
    reg [2:0] what;
    reg [31:0] exponent;
    reg busy;
    reg [7:0] step;
    wire linear_done, quotient_done;
    wire [31:0] linear_mantissa, linear_exponent, quotient_mantissa, quotient_exponent;
    drogue_real_unit_linear linear (
        .clock(clock), .step(step), .done(linear_done), .asked_0(a[31:0]), .asked_32(a[63:32]), .asked_64(b[31:0]),
        .asked_96(b[63:32]), .asked_128(c[31:0]), .asked_160(c[63:32]), .asked_192(d[31:0]), .asked_224(d[63:32]),
        .asked_256({29'd0, what}), .out_0(linear_mantissa), .out_32(linear_exponent));
    drogue_real_unit_quotient quotient (
        .clock(clock), .step(step), .done(quotient_done), .asked_128(c[31:0]), .asked_160(c[63:32]), .asked_192(d[31:0]),
        .asked_224(d[63:32]), .out_0(quotient_mantissa), .out_32(quotient_exponent));
    wire divides = what == 3'd7;
    wire done = divides ? quotient_done : linear_done;

    function [5:0] leading_zeros(input [31:0] v);
        integer k;
        begin
            leading_zeros = 6'd32;
            for (k = 0; k < 32; k = k + 1) if (v[k]) leading_zeros = 6'd31 - k[5:0];
        end
    endfunction

    assign ready = !busy && (!answered || taken);
    wire begins = asked && ready;
    always @(posedge clock) begin
        step <= begins ? 8'd0 : step + 8'd1;
        if (taken) answered <= 1'b0;
        if (begins) case (function_id[9:3])
            7'd0: begin
                d <= {second, first};
                what <= function_id[2:0];
                busy <= 1'b1;
            end
            7'd1: begin
                a <= b;
                b <= c;
                c <= {second, first};
            end
            default: ;
        endcase
        if (begins && function_id[9:3] != 7'd0) begin
            answer <= function_id[9:3] == 7'd2 ? exponent : {26'd0, leading_zeros(first)};
            answered <= 1'b1;
        end
        if (busy && done) begin
            busy <= 1'b0;
            answer <= divides ? quotient_mantissa : linear_mantissa;
            exponent <= divides ? quotient_exponent : linear_exponent;
            answered <= 1'b1;
        end
        if (reset) begin
            busy <= 1'b0;
            answered <= 1'b0;
        end
    end
endmodule

// dividend / divisor, rounded down, 17 clocks from the one of 'start' on; two bits a clock.
module drogue_divider (
    input wire clock, input wire start, input wire [31:0] dividend, input wire [31:0] divisor, output reg [31:0] quotient);
    reg [31:0] rest, by;
    wire [33:0] next = {rest, quotient[31:30]}, twice = {1'b0, by, 1'b0};
    wire upper = next >= twice;
    wire [33:0] left = upper ? next - twice : next;
    wire lower = left >= {2'd0, by};
    wire [33:0] least = lower ? left - {2'd0, by} : left;
    always @(posedge clock) begin
        if (start) begin
            quotient <= dividend;
            rest <= 32'd0;
            by <= divisor;
            count <= 5'd16;
        end else if (count != 5'd0) begin
            quotient <= {quotient[29:0], upper, lower};
            rest <= least[31:0];
            count <= count - 5'd1;
        end
    end
    reg [4:0] count = 5'd0;
endmodule
