// SPDX-License-Identifier: Apache-2.0
// The units beside the soft core, reached by its instructions of opcode custom-0: function is {funct7, funct3}, unit.h.
module drogue_unit (
    input wire clock, input wire reset,
    input wire asked, output wire ready, input wire [9:0] function_id, input wire [31:0] first, input wire [31:0] second,
    output wire answers, input wire taken, output wire [31:0] says,
    // the frame memory's: the word about a byte, a clock after it was asked for
    output wire [31:0] frame_at, input wire frame_free, input wire [31:0] frame_word);
    // Reals, mantissa and exponent: a, b, c were told before the operation, which brings d.
    reg [63:0] a, b, c, d;
    reg [2:0] what;
    reg [31:0] exponent;
    reg busy;
    reg [7:0] step;
    // An answer, and one before it that the soft core has not taken yet: whether it takes one is known too late to say by that whether
    // an instruction may begin.
    reg answered, kept;
    reg [31:0] answer, kept_answer;
    assign answers = answered || kept;
    assign says = kept ? kept_answer : answer;
    wire linear_done;
    wire [63:0] linear_real;
    drogue_real_unit_linear linear (
        .clock(clock), .step(step), .done(linear_done), .asked({29'd0, what, d, c, b, a}), .out(linear_real));

    function [5:0] leading_zeros(input [31:0] v);
        integer k;
        begin
            leading_zeros = 6'd32;
            for (k = 0; k < 32; k = k + 1) if (v[k]) leading_zeros = 6'd31 - k[5:0];
        end
    endfunction

    // Edge points: words of an ellipse, two at a time, then points, one in eight clocks at most: of these so many are on their way,
    // and so it is with moments. What is said of the last one is fetched later.
    reg [703:0] told;
    reg [63:0] point;
    reg placing, adding, place_starts, add_starts, out_of;
    reg [6:0] place_waits, add_waits; // as many bits as clocks until the next may start
    wire place_more, add_more;
    reg [31:0] added, near_points;
    reg [1279:0] moments;
    wire place_done, add_done;
    wire [95:0] place_said;
    wire [1279:0] moments_next;
    reg [31:0] said;
    drogue_points_unit_place place (
        .clock(clock), .reset(reset), .start(place_starts), .more(place_more), .done(place_done),
        .asked({point, told[671:0]}), .out(place_said));
    drogue_points_unit_moments add (
        .clock(clock), .reset(reset), .start(add_starts), .more(add_more), .done(add_done),
        .asked({31'd0, out_of, added, moments}), .out(moments_next));

    // Points that are counted: one that is held in its bin and in a support's sums, and one whose place among the moments changes is
    // added to them or taken out, as drogue_collect_edges() does, while the next one's place is worked out.
    reg counts_it, judging, counting, deciding, counted_out, moments_changed;
    reg [7:0] count_step;
    reg [31:0] bright_bins, points_in, its_place, its_gradient;
    reg [159:0] support;
    reg [63:0] counts_told; // bins' counts that are not 0, two of each; the sum of a bin is told with one of them
    reg [15:0] bin_counts [0:63];
    reg [31:0] bin_sums [0:31];
    reg [15:0] bin_count;
    reg [31:0] bin_sum;
    reg own;
    wire count_done;
    wire [255:0] count_said;
    wire [5:0] its_count = {said[28:24], said[29]};
    drogue_points_unit_count count (
        .clock(clock), .step(count_step), .done(count_done),
        .asked({bright_bins, its_gradient, said, bin_sum, 16'd0, bin_count, support}), .out(count_said));
    wire settling = placing || judging || counting || deciding || adding;
    wire [31:0] bins_told;
    genvar bin;
    generate for (bin = 0; bin < 32; bin = bin + 1) begin : told_of
        assign bins_told[bin] = |counts_told[2 * bin +: 2];
    end endgenerate
    wire [5:0] asked_count = {first[4:0], 1'b0};

    // Grey along a ray, sample after sample before the soft core asks, each five clocks after the one before: while the pixels of
    // one come, a pixel a clock, the next one's place is worked out, and the one before is interpolated. What is worked out stays
    // until it is taken.
    reg [63:0] image, size, pace, where; // first byte, stride; width, height; and so on
    reg placing_sample, rowing, mixing, there;
    reg [7:0] sample_step, rows_step, mix_step;
    reg [2:0] fetch; // 0: not; 1: the first pixel is asked for; to 5: the last one comes; 6: all are there
    reg [191:0] sample;
    reg [63:0] rows_at;
    reg [31:0] pixels, rows_pixels, mixed_at, grey;
    reg [63:0] mixed_rows;
    reg [1:0] byte_of;
    wire sample_done, rows_done, mix_done;
    wire [191:0] sample_said;
    wire [63:0] rows_said;
    wire [31:0] grey_said;
    wire [2:0] pixel = fetch - 3'd1;
    assign frame_at = pixel[1] ? pixel[0] ? sample[127:96] : sample[95:64] : pixel[0] ? sample[63:32] : sample[31:0];
    drogue_ray_unit_place ray_place (
        .clock(clock), .step(sample_step), .done(sample_done), .asked({where, image, size}), .out(sample_said));
    drogue_ray_unit_rows ray_rows (
        .clock(clock), .step(rows_step), .done(rows_done), .asked({rows_at[31:0], rows_pixels}), .out(rows_said));
    drogue_ray_unit_grey ray_grey (
        .clock(clock), .step(mix_step), .done(mix_done), .asked({mixed_at, mixed_rows}), .out(grey_said));
    wire [31:0] shifted = frame_word >> {byte_of, 3'd0};
    wire [31:0] pixels_next = {shifted[7:0], pixels[31:8]};

    // Peaks of the slope along a ray, instead of its grey: the unit waits at one until the soft core has taken it.
    reg seeking, either, sloping, peak, peak_falls, sought;
    reg [7:0] slope_step, samples, samples_wanted; // of grey
    reg [191:0] greys; // six
    reg [127:0] slope_sums; // four
    reg [31:0] slope_before, slope, slope_after, slope_least;
    wire slope_done;
    wire [95:0] slope_said;
    wire [31:0] peak_at = {23'd0, peak_falls, samples - 8'd10}; // nine samples make a slope, the next may tell that it was a peak
    drogue_ray_unit_slope ray_slope (
        .clock(clock), .step(slope_step), .done(slope_done),
        .asked({slope_least, slope_after, slope, slope_sums[31:0], greys[191:32]}), .out(slope_said));
    wire mix_taken = mixing && mix_done && (seeking ? !sloping && !peak && !sought : !there);
    wire rows_taken = rowing && rows_done && (!mixing || mix_taken);
    wire pixels_taken = (fetch == 3'd5 || fetch == 3'd6) && (!rowing || rows_taken);
    wire sample_taken = placing_sample && sample_done && (fetch == 3'd0 || pixels_taken);

    // Least squares over rays: edges, then the ray that they are on. While it is worked out the next one's edges are told.
    reg [127:0] offset; // and the tolerance
    reg [255:0] edges, fit_edges;
    reg [2:0] edges_told, fit_count;
    reg [63:0] normal;
    reg [639:0] sums; // and which of the edges is about the offset
    reg fitting;
    reg [7:0] fit_step;
    wire fit_done;
    wire [639:0] sums_next;
    drogue_fit_unit_ray fit (
        .clock(clock), .step(fit_step), .done(fit_done),
        .asked({29'd0, fit_count, fit_edges, normal, offset, sums}), .out(sums_next));

    // A square root, two bits of it a clock.
    reg [63:0] radicand;
    reg [31:0] root, left;
    reg [4:0] root_step; // 0: not
    wire [33:0] first_left = {left, radicand[63:62]}, first_by = {root, 2'd1};
    wire first_bit = first_left >= first_by;
    wire [33:0] between = first_bit ? first_left - first_by : first_left;
    wire [34:0] second_left = {between[32:0], radicand[61:60]}, second_by = {root, first_bit, 2'd1};
    wire second_bit = second_left >= second_by;
    wire [34:0] after = second_bit ? second_left - second_by : second_left;

    // A quotient of whole numbers, rounded down, two bits a clock, four by a divisor of 32 bits, sixteen that are 0 at once: the one
    // that was told, then what is divided, whose place the quotient takes. That of reals has 31 bits and is rounded to nearest, by one
    // bit more: it begins with the divided number's upper word already there.
    reg divides, rounds, negative, none; // of reals
    reg [63:0] divisor, dividend, remains;
    reg [65:0] thrice;
    reg [5:0] divide_step; // 0: not
    wire [66:0] part = {1'b0, remains, dividend[63:62]};
    wire [66:0] less_1 = part - {3'd0, divisor}, less_2 = part - {2'd0, divisor, 1'b0}, less_3 = part - {1'b0, thrice};
    wire below = dividend[31:0] < divisor[31:0];
    wire [31:0] rounded = {1'b0, dividend[31:1]} + {31'd0, dividend[0]};
    wire [1:0] divided = !less_2[66] ? {1'b1, !less_3[66]} : {1'b0, !less_1[66]};
    wire narrow = divisor[63:32] == 32'd0;
    wire [34:0] short = {1'b0, remains[31:0], dividend[63:62]};
    wire [34:0] short_1 = short - {3'd0, divisor[31:0]}, short_2 = short - {2'd0, divisor[31:0], 1'b0},
        short_3 = short - {1'b0, thrice[33:0]};
    wire [1:0] upper = !short_2[34] ? {1'b1, !short_3[34]} : {1'b0, !short_1[34]};
    wire [31:0] short_left = upper[1] ? upper[0] ? short_3[31:0] : short_2[31:0] : upper[0] ? short_1[31:0] : short[31:0];
    wire [34:0] next = {1'b0, short_left, dividend[61:60]};
    wire [34:0] next_1 = next - {3'd0, divisor[31:0]}, next_2 = next - {2'd0, divisor[31:0], 1'b0},
        next_3 = next - {1'b0, thrice[33:0]};
    wire [1:0] lower = !next_2[34] ? {1'b1, !next_3[34]} : {1'b0, !next_1[34]};
    wire [31:0] next_left = lower[1] ? lower[0] ? next_3[31:0] : next_2[31:0] : lower[0] ? next_1[31:0] : next[31:0];
    wire divide_last = narrow ? divide_step == 6'd2 : divide_step == 6'd1;
    wire [63:0] quotient_next = narrow ? {dividend[59:0], upper, lower} : {dividend[61:0], divided};
    wire [66:0] remains_next = divided[1] ? divided[0] ? less_3 : less_2 : divided[0] ? less_1 : part;

    wire [6:0] unit = {2'd0, function_id[7:3]}; // there are thirty-two: the next are those again
    assign ready = !busy && !kept && !(placing && (unit == 7'd4 || unit == 7'd6)) &&
        !(place_waits[0] && unit == 7'd5) && !(add_waits[0] && unit == 7'd8) &&
        !(adding && (unit == 7'd7 || unit == 7'd9)) && !(settling && unit[6:1] == 6'd13) && !(unit == 7'd14 && !there) &&
        !(unit == 7'd23 && function_id[2:0] == 3'd0 && !peak && !sought) &&
        !(fitting && (unit == 7'd16 || unit == 7'd17 || unit == 7'd19 || unit == 7'd20 || unit == 7'd21));
    wire begins = asked && ready;

    // What is answered at once is chosen before it is known whether an instruction begins, which none does while the unit is busy.
    reg [31:0] at_once;
    always @(*) case (unit)
        7'd2: at_once = exponent;
        7'd3: at_once = {26'd0, leading_zeros(first)};
        7'd6: at_once = said;
        7'd9: at_once = moments[31:0];
        7'd14: at_once = grey;
        7'd20: at_once = sums[639:608];
        7'd21: at_once = sums[31:0];
        7'd23: case (function_id[2:0])
            3'd0: at_once = peak ? peak_at : 32'hFFFFFFFF;
            3'd1: at_once = slope_before;
            3'd2: at_once = slope;
            3'd3: at_once = slope_after;
            default: at_once = greys[31:0];
        endcase
        7'd27: case (function_id[2:0])
            3'd0: at_once = bins_told;
            3'd1: at_once = support[31:0];
            3'd2: at_once = {bin_counts[asked_count | 6'd1] & {16{counts_told[asked_count | 6'd1]}},
                bin_counts[asked_count] & {16{counts_told[asked_count]}}};
            3'd3: at_once = bin_sums[first[4:0]];
            3'd4: at_once = {31'd0, moments_changed};
            default: at_once = near_points;
        endcase
        default: at_once = 32'd0;
    endcase
    wire [31:0] worked_out = rounds ? none ? 32'd0 : negative ? -rounded : rounded :
        root_step != 5'd0 ? root : divide_step != 6'd0 ? quotient_next[31:0] : linear_real[31:0];

    always @(posedge clock) begin
        if (busy || begins) answer <= busy ? worked_out : at_once;
        // What has no product (set, sum, difference) begins a clock later in the unit's schedule: it waits for no multiplier.
        step <= begins ? {7'd0, function_id[2:0] < 3'd3} : step + 8'd1;
        place_starts <= begins && unit == 7'd5;
        placing <= place_more || (begins && unit == 7'd5);
        place_waits <= place_waits >> 1;
        count_step <= count_step + 8'd1;
        add_starts <= begins && unit == 7'd8;
        adding <= add_more || (begins && unit == 7'd8);
        add_waits <= add_waits >> 1;
        fit_step <= fit_step + 8'd1;
        if (taken) begin
            kept <= 1'b0;
            if (!kept) answered <= 1'b0;
        end
        if (begins) begin
            kept <= answered && !taken;
            kept_answer <= answer;
            answered <= 1'b0;
        end
        if (begins) divides <= unit == 7'd0 && function_id[2:0] == 3'd7;
        if (begins && unit != 7'd0 && unit != 7'd15 && unit != 7'd25) answered <= 1'b1;
        if (begins) case (unit)
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
            7'd4: told <= {second, first, told[703:64]};
            7'd5: begin
                point <= {second, first};
                counts_it <= function_id[0];
                place_waits <= 7'h7F;
            end
            7'd7: moments <= 1280'd0;
            7'd8: begin
                added <= first;
                out_of <= second[0];
                add_waits <= 7'h7F;
            end
            7'd9: moments <= {moments[31:0], moments[1279:32]};
            7'd10: image <= {second, first};
            7'd11: size <= {second, first};
            7'd12: pace <= {second, first};
            7'd13: ; // below
            7'd15: begin
                radicand <= {second, first};
                {root, left} <= 64'd0;
                root_step <= 5'd17;
                busy <= 1'b1;
            end
            7'd16: offset[63:0] <= {second, first};
            7'd17: begin
                offset[127:64] <= {second, first};
                sums <= 640'd0;
                edges_told <= 3'd0;
            end
            7'd18: begin
                edges <= {second, first, edges[255:64]};
                edges_told <= edges_told + 3'd1;
            end
            7'd19: begin
                normal <= {second, first};
                fit_edges <= edges;
                fit_count <= edges_told;
                edges_told <= 3'd0;
                fit_step <= 8'd0;
                fitting <= 1'b1;
            end
            7'd21: sums <= {sums[31:0], sums[639:32]};
            7'd22: {samples_wanted, slope_least} <= {second[7:0], first};
            7'd24: divisor <= {second, first};
            7'd25: begin
                dividend <= {second, first};
                remains <= 64'd0;
                divide_step <= 6'd32;
                busy <= 1'b1;
            end
            7'd26: begin
                bright_bins <= first;
                points_in <= {1'b0, second[30:0]};
                counted_out <= second[31];
                {support, counts_told, moments_changed, near_points} <= 257'd0;
            end
            7'd27: if (function_id[2:0] == 3'd1) support <= {32'd0, support[159:32]};
            default: ;
        endcase
        if (busy && root_step == 5'd0 && divide_step == 6'd0 && !divides && linear_done) begin
            busy <= 1'b0;
            exponent <= linear_real[63:32];
            answered <= 1'b1;
        end
        if (place_done) begin
            {its_gradient, its_place, said} <= place_said;
            near_points <= near_points + {31'd0, place_said[30]};
            judging <= counts_it;
        end
        if (judging) begin
            judging <= 1'b0;
            counting <= said[31];
            deciding <= !said[31];
            own <= 1'b0;
            count_step <= 8'd0;
            bin_count <= counts_told[its_count] ? bin_counts[its_count] : 16'd0;
            bin_sum <= bins_told[said[28:24]] ? bin_sums[said[28:24]] : 32'd0;
        end
        if (counting && count_done) begin
            counting <= 1'b0;
            deciding <= 1'b1;
            support <= count_said[159:0];
            bin_counts[its_count] <= count_said[175:160];
            bin_sums[said[28:24]] <= count_said[223:192];
            counts_told <= counts_told | 64'd1 << its_count;
            own <= count_said[224];
        end
        if (deciding && !add_waits[0]) begin // before the next point's judging: one that is not held is not counted, and overtakes
            deciding <= 1'b0;
            if (own != counted_out && (!own || points_in < 32'd131072)) begin
                points_in <= points_in + (own ? 32'd1 : 32'hFFFFFFFF);
                moments_changed <= 1'b1;
                added <= its_place;
                out_of <= !own;
                {add_starts, adding} <= 2'd3;
                add_waits <= 7'h7F;
            end
        end
        if (add_done) moments <= moments_next;
        if (fitting && fit_done) begin
            fitting <= 1'b0;
            sums <= sums_next;
        end
        if (!sample_done) sample_step <= sample_step + 8'd1;
        if (!rows_done) rows_step <= rows_step + 8'd1;
        if (!mix_done) mix_step <= mix_step + 8'd1;
        slope_step <= slope_step + 8'd1;
        byte_of <= frame_at[1:0];
        if (fetch != 3'd0 && fetch != 3'd6) begin
            fetch <= frame_free || fetch == 3'd5 ? fetch + 3'd1 : 3'd1; // from the first once more
            pixels <= pixels_next;
        end
        if (mix_taken) begin
            mixing <= 1'b0;
            if (seeking) begin
                greys <= {grey_said, greys[191:32]};
                samples <= samples + 8'd1;
                sloping <= 1'b1;
                slope_step <= 8'd0;
            end else grey <= grey_said;
        end
        if (begins && unit == 7'd14) there <= 1'b0;
        else if (mix_taken && !seeking) there <= 1'b1;
        if (rows_taken) begin
            rowing <= 1'b0;
            {mixed_at, mixed_rows} <= {rows_at[63:32], rows_said};
            mixing <= 1'b1;
            mix_step <= 8'd0;
        end
        if (pixels_taken) begin
            fetch <= 3'd0;
            {rows_at, rows_pixels} <= {sample[191:128], fetch == 3'd5 ? pixels_next : pixels};
            rowing <= 1'b1;
            rows_step <= 8'd0;
        end
        if (sample_taken) begin
            fetch <= 3'd1;
            sample <= sample_said;
            where <= {where[63:32] + pace[63:32], where[31:0] + pace[31:0]};
            sample_step <= 8'd0;
        end
        if (sloping && slope_done) begin
            sloping <= 1'b0;
            slope_sums <= {slope_said[31:0], slope_sums[127:32]};
            {slope_after, slope, slope_before} <= {slope_said[63:32], slope_after, slope};
            peak <= samples > 8'd10 && (slope_said[64] || (slope_said[65] && either));
            peak_falls <= slope_said[65];
            sought <= samples == samples_wanted;
        end
        if (begins && unit == 7'd23 && function_id[2:0] == 3'd4) peak <= 1'b0;
        if (begins && unit == 7'd13) begin
            where <= {second, first};
            {rowing, mixing, there, fetch} <= 6'd0;
            {either, seeking} <= function_id[1:0];
            {sloping, peak, sought} <= 3'd0;
            samples <= 8'd0;
            placing_sample <= 1'b1;
            sample_step <= 8'd0;
        end
        if (root_step != 5'd0) begin
            radicand <= {radicand[59:0], 4'd0};
            root <= {root[29:0], first_bit, second_bit};
            left <= after[31:0];
            root_step <= root_step - 5'd1;
            if (root_step == 5'd1) begin
                busy <= 1'b0;
                answered <= 1'b1;
            end
        end
        thrice <= {2'd0, divisor} + {1'b0, divisor, 1'b0};
        if (divide_step > 6'd8 && remains == 64'd0 && dividend[63:48] == 16'd0) begin
            dividend <= {dividend[47:0], 16'd0};
            divide_step <= divide_step - 6'd8;
        end else if (divide_step != 6'd0) begin
            dividend <= quotient_next;
            remains <= narrow ? {32'd0, next_left} : remains_next[63:0];
            divide_step <= narrow ? {divide_step[5:1] - 5'd1, 1'b0} : divide_step - 6'd1; // narrow from the first one on, which is even
            rounds <= divide_last && divides;
            if (divide_last && !divides) begin
                busy <= 1'b0;
                exponent <= quotient_next[63:32];
                answered <= 1'b1;
            end
        end
        if (busy && divides && step == 8'd0) begin
            dividend <= {32'd0, c[31] ? -c[31:0] : c[31:0]};
            divisor <= {32'd0, d[31] ? -d[31:0] : d[31:0]};
            exponent <= c[63:32] - d[63:32];
            negative <= c[31] ^ d[31];
        end
        if (busy && divides && step == 8'd1) begin
            none <= dividend[31:0] == 32'd0 || divisor[31:0] == 32'd0;
            remains <= {32'd0, below ? dividend[31:0] : {1'b0, dividend[31:1]}};
            dividend <= {dividend[0] && !below, 63'd0};
            exponent <= exponent - (below ? 32'd31 : 32'd30);
            divide_step <= 6'd16;
        end
        if (rounds) begin
            rounds <= 1'b0;
            busy <= 1'b0;
            if (none) exponent <= 32'd0;
            answered <= 1'b1;
        end
        if (reset) begin
            {busy, answered, placing, adding, place_starts, add_starts, fitting, root_step, divide_step} <= 18'd0;
            {place_waits, add_waits} <= 14'd0;
            {kept, rounds, judging, counting, deciding} <= 5'd0;
            {placing_sample, rowing, mixing, there, fetch} <= 7'd0;
            {seeking, sloping, peak, sought} <= 4'd0;
        end
    end
endmodule
