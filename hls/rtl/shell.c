/* SPDX-License-Identifier: Apache-2.0 */
/* Writes the front end's shell in Verilog: memories and ports about the registers and the combinational part that verilog.py
 * makes of drogue_hls_step(). Places of members are the compiler's, sizes those of stages.h: the shell cannot drift from
 * the C, nor what is about it, which includes the sizes. */
#include <stdio.h>
#include <string.h>

#include "../frontend/stages.h"

static unsigned address_bits(unsigned words)
{
    unsigned n = 1;
    while (1u << n < words) {
        n++;
    }
    return n;
}

/* The wire of a member, by the place of its lowest bit. */
#define WIRE(member) (8u * (unsigned)offsetof(drogue_hls_registers, member))
#define OUT(member) (8u * (unsigned)offsetof(drogue_hls_writes, member))

/* A memory: its port to write, and the places that it is read at. 'later': no word is asked for just after it was written. */
static void memory(const char *name, unsigned words, unsigned size, int later, size_t write, const size_t places[2],
                   const size_t reads[2])
{
    const unsigned address = address_bits(words);
    int k;
    for (k = 0; k < 2 && reads[k] != SIZE_MAX; k++) {
        printf("    wire [%u:0] %s_%d;\n", size - 1, name, k);
        if (size < 64) {
            printf("    assign read_%u = {%u'd0, %s_%d};\n", 8 * (unsigned)reads[k], 64 - size, name, k);
        } else {
            printf("    assign read_%u = %s_%d;\n", 8 * (unsigned)reads[k], name, k);
        }
    }
    printf("    drogue_memory%s #(.WORDS(%u), .BITS(%u), .ADDRESS(%u)%s) %s (\n", k == 2 ? "_2" : "", words, size,
           address, later ? ", .NEAR(0)" : "", name);
    printf(
        "        .clock(clock), .enable(enable), .write(write_%u[0]), .write_at(write_%u[%u:0]), .word(write_%u[%u:0]),\n",
        8 * (unsigned)(write + offsetof(drogue_hls_write, enable)),
        8 * (unsigned)(write + offsetof(drogue_hls_write, address)), address - 1,
        8 * (unsigned)(write + offsetof(drogue_hls_write, word)), size - 1);
    printf("        .at(places_%u[%u:0]), .read(%s_0)", 8 * (unsigned)places[0], address - 1, name);
    if (k == 2) {
        printf(",\n        .at_2(places_%u[%u:0]), .read_2(%s_1)", 8 * (unsigned)places[1], address - 1, name);
    }
    printf(");\n");
}

static void head(void)
{
    printf("// Made by hls/rtl/shell.c for regions of %d x %d pixels.\n", DROGUE_HLS_WIDTH, DROGUE_HLS_HEIGHT);
    printf("module drogue_frontend (\n    input wire clock, input wire reset,\n"
           "    input wire start, output wire busy,\n"
           "    input wire [31:0] width_px, input wire [31:0] height_px, input wire [31:0] canny_low,\n"
           "    input wire [31:0] canny_high, input wire [31:0] smooth, input wire [31:0] min_arc_px,\n"
           "    input wire [31:0] use_ring, input wire [31:0] centre2_x, input wire [31:0] centre2_y,\n"
           "    input wire [31:0] longest_px,\n"
           "    input wire pixel_valid, input wire [7:0] pixel, output wire pixel_ready,\n"
           "    output reg edge_write, output reg [%u:0] edge_at, output reg [63:0] edge_word,\n"
           "    output reg arc_write, output reg [%u:0] arc_at, output reg [63:0] arc_word,\n"
           "    output wire [31:0] status, output wire [31:0] edge_count, output wire [31:0] arc_count,\n"
           "    output wire listing);\n",
           address_bits(DROGUE_HLS_EDGES) - 1, address_bits(DROGUE_HLS_ARCS) - 1);
}

/* What the block asks of its surroundings: the members of drogue_hls_asked, and the words read. */
static void inputs(void)
{
    unsigned k;
#define PORT(member, value) \
    printf("    wire [31:0] asked_%u = %s;\n", 8 * (unsigned)offsetof(drogue_hls_asked, member), value)
    PORT(width_px, "width_px");
    PORT(height_px, "height_px");
    PORT(canny_low, "canny_low");
    PORT(canny_high, "canny_high");
    PORT(smooth, "smooth");
    PORT(min_arc_px, "min_arc_px");
    PORT(use_ring, "use_ring");
    PORT(centre2_x, "centre2_x");
    PORT(centre2_y, "centre2_y");
    PORT(longest_px, "longest_px");
    PORT(start, "{31'd0, start}");
    PORT(pixel, "{24'd0, pixel}");
    for (k = 0; k < sizeof(drogue_hls_words) / sizeof(uint64_t); k++) {
        printf("    wire [63:0] read_%u;\n", 64 * k);
    }
    printf("    wire enable;\n");
}

static void outputs(void)
{
    printf("    assign busy = now_%u != 32'd%d || edge_write;\n", WIRE(phase), PHASE_IDLE);
    printf("    assign listing = (now_%u & 32'd%d) != 0;\n", WIRE(phase),
           PHASE_COMPONENTS | PHASE_ARCS | PHASE_PLACE | PHASE_SORT);
    printf("    assign pixel_ready = (now_%u & 32'd%d) != 0 && now_%u[0];\n", WIRE(phase), PHASE_ROWS,
           WIRE(windows.take));
    printf("    assign enable = !pixel_ready || pixel_valid;\n");
    printf("    assign status = now_%u;\n    assign edge_count = now_%u;\n    assign arc_count = now_%u;\n",
           WIRE(status), WIRE(lists.left), WIRE(lists.arcs));
    printf("    always @(posedge clock) begin\n        edge_write <= !reset && enable && write_%u[0];\n"
           "        edge_at <= write_%u[%u:0];\n        edge_word <= write_%u;\n",
           OUT(edges.enable), OUT(edges.address), address_bits(DROGUE_HLS_EDGES) - 1, OUT(edges.word));
    printf("        arc_write <= !reset && enable && write_%u[0];\n        arc_at <= write_%u[%u:0];\n"
           "        arc_word <= write_%u;\n    end\n",
           OUT(arcs.enable), OUT(arcs.address), address_bits(DROGUE_HLS_ARCS) - 1, OUT(arcs.word));
}

/* Before the combinational part, with the argument 'begin', or after it; with 'sizes' what the block was made for. */
int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "sizes") == 0) {
        printf("localparam WIDTH = %d, EDGES = %d, ARCS = %d, LABELS = %d;\n", DROGUE_HLS_WIDTH, DROGUE_HLS_EDGES,
               DROGUE_HLS_ARCS, DROGUE_HLS_LABELS);
        return 0;
    }
    if (argc > 1) {
        head();
        inputs();
        return 0;
    }
    outputs();
#define SINGLE(name, words, size, later)                                                                             \
    {                                                                                                                \
        const size_t places[2] = {offsetof(drogue_hls_places, name), SIZE_MAX};                                      \
        const size_t reads[2] = {offsetof(drogue_hls_words, name), SIZE_MAX};                                        \
        memory(#name, (unsigned)(words), (unsigned)(size), later, offsetof(drogue_hls_writes, name), places, reads); \
    }
#define LATER(name, words, size) SINGLE(name, words, size, 1)
#define NEAR(name, words, size) SINGLE(name, words, size, 0)
    DROGUE_HLS_LATER_MEMORIES(LATER)
    DROGUE_HLS_SINGLE_MEMORIES(NEAR)
#define PAIR(name, words, size)                                                                                  \
    {                                                                                                            \
        const size_t places[2] = {offsetof(drogue_hls_places, name), offsetof(drogue_hls_places, name##_2)};     \
        const size_t reads[2] = {offsetof(drogue_hls_words, name), offsetof(drogue_hls_words, name##_2)};        \
        memory(#name, (unsigned)(words), (unsigned)(size), 0, offsetof(drogue_hls_writes, name), places, reads); \
    }
    DROGUE_HLS_PAIR_MEMORIES(PAIR)
    printf("endmodule\n");
    return 0;
}
