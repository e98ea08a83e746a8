/* SPDX-License-Identifier: Apache-2.0 */
/* Writes the front end's shell in Verilog: registers, memories and ports about the combinational block that verilog.py makes
 * of drogue_hls_step(). Places of members are the compiler's, sizes those of stages.h: the shell cannot drift from the C. */
#include <stdio.h>

#include "../frontend/stages.h"

/* Bits of a member in the port of its struct. */
static const char *bits(size_t offset, size_t size)
{
    static char text[4][32];
    static int next;
    next = (next + 1) % 4;
    snprintf(text[next], sizeof text[next], "[%u +: %u]", (unsigned)(8 * offset), (unsigned)size);
    return text[next];
}

static unsigned address_bits(unsigned words)
{
    unsigned n = 1;
    while (1u << n < words) {
        n++;
    }
    return n;
}

#define MEMBER(type, member, size) bits(offsetof(type, member), size)
#define WRITE(member, size) MEMBER(drogue_hls_writes, member, size)

/* A memory: its port to write, and the places that it is read at. */
static void memory(const char *name, unsigned words, unsigned size, size_t write, const size_t places[2],
                   const size_t reads[2])
{
    const unsigned address = address_bits(words);
    int k;
    for (k = 0; k < 2 && reads[k] != SIZE_MAX; k++) {
        printf("    wire [%u:0] read_%s_%d;\n", size - 1, name, k);
        printf("    assign read%s = read_%s_%d;\n", bits(reads[k], size), name, k);
        if (size < 64) {
            printf("    assign read[%u +: %u] = %u'd0;\n", (unsigned)(8 * reads[k]) + size, 64 - size, 64 - size);
        }
    }
    printf("    drogue_memory%s #(.WORDS(%u), .BITS(%u), .ADDRESS(%u)) %s (\n", k == 2 ? "_2" : "", words, size, address, name);
    printf("        .clock(clock), .enable(enable), .write(write%s), .write_at(write%s), .word(write%s),\n",
           bits(write + offsetof(drogue_hls_write, enable), 1), bits(write + offsetof(drogue_hls_write, address), address),
           bits(write + offsetof(drogue_hls_write, word), size));
    printf("        .at(places%s), .read(read_%s_0)", bits(places[0], address), name);
    if (k == 2) {
        printf(",\n        .at_2(places%s), .read_2(read_%s_1)", bits(places[1], address), name);
    }
    printf(");\n");
}

static void port(const char *name, size_t offset, unsigned size)
{
    printf("    assign asked%s = {%s};\n", bits(offset, 32), name);
    (void)size;
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
           "    output wire edge_write, output wire [%u:0] edge_at, output wire [63:0] edge_word,\n"
           "    output wire arc_write, output wire [%u:0] arc_at, output wire [63:0] arc_word,\n"
           "    output wire [31:0] status, output wire [31:0] edge_count, output wire [31:0] arc_count,\n"
           "    output wire listing);\n",
           address_bits(DROGUE_HLS_EDGES) - 1, address_bits(DROGUE_HLS_ARCS) - 1);
}

#define REGISTER(member) MEMBER(drogue_hls_registers, member, 32)

static void registers(void)
{
    const unsigned now = 8 * (unsigned)sizeof(drogue_hls_registers) - 1;
    printf("    reg [%u:0] now;\n    wire [%u:0] next;\n", now, now);
    printf("    wire [%u:0] asked;\n", 8 * (unsigned)sizeof(drogue_hls_asked) - 1);
    printf("    wire [%u:0] read;\n", 8 * (unsigned)sizeof(drogue_hls_words) - 1);
    printf("    wire [%u:0] places;\n", 8 * (unsigned)sizeof(drogue_hls_places) - 1);
    printf("    wire [%u:0] write;\n", 8 * (unsigned)sizeof(drogue_hls_writes) - 1);
    printf("    wire [31:0] phase = now%s;\n", REGISTER(phase));
    printf("    assign busy = phase != 32'd%d;\n", PHASE_IDLE);
    printf("    assign listing = phase > 32'd%d;\n", PHASE_SETTLE);
    printf("    assign pixel_ready = phase == 32'd%d && now%s;\n", PHASE_ROWS,
           MEMBER(drogue_hls_registers, windows.take, 1));
    printf("    wire enable = !pixel_ready || pixel_valid;\n");
    printf("    initial now = %u'd0;\n", now + 1);
    printf("    always @(posedge clock) if (reset) now <= %u'd0; else if (enable) now <= next;\n", now + 1);
    printf("    drogue_frontend_step step (.now(now), .asked(asked), .read(read), .next(next), .places(places), "
           ".write(write));\n");
    printf("    assign status = now%s;\n", REGISTER(status));
    printf("    assign edge_count = now%s;\n", REGISTER(lists.left));
    printf("    assign arc_count = now%s;\n", REGISTER(lists.arcs));
    printf("    assign edge_write = enable && write%s;\n    assign edge_at = write%s;\n    assign edge_word = write%s;\n",
           WRITE(edges.enable, 1), WRITE(edges.address, address_bits(DROGUE_HLS_EDGES)), WRITE(edges.word, 64));
    printf("    assign arc_write = enable && write%s;\n    assign arc_at = write%s;\n    assign arc_word = write%s;\n",
           WRITE(arcs.enable, 1), WRITE(arcs.address, address_bits(DROGUE_HLS_ARCS)), WRITE(arcs.word, 64));
}

int main(void)
{
    head();
    registers();
#define PORT(member) port(#member, offsetof(drogue_hls_asked, member), 32)
    PORT(width_px);
    PORT(height_px);
    PORT(canny_low);
    PORT(canny_high);
    PORT(smooth);
    PORT(min_arc_px);
    PORT(use_ring);
    PORT(centre2_x);
    PORT(centre2_y);
    PORT(longest_px);
    port("31'd0, start", offsetof(drogue_hls_asked, start), 1);
    port("24'd0, pixel", offsetof(drogue_hls_asked, pixel), 8);
#define X(name, words, size)                                                                               \
    {                                                                                                      \
        const size_t places[2] = {offsetof(drogue_hls_places, name), SIZE_MAX};                            \
        const size_t reads[2] = {offsetof(drogue_hls_words, name), SIZE_MAX};                              \
        memory(#name, (unsigned)(words), (unsigned)(size), offsetof(drogue_hls_writes, name), places, reads); \
    }
    DROGUE_HLS_MEMORIES(X)
#undef X
#define X(name, words, size)                                                                               \
    {                                                                                                      \
        const size_t places[2] = {offsetof(drogue_hls_places, name), offsetof(drogue_hls_places, name##_2)}; \
        const size_t reads[2] = {offsetof(drogue_hls_words, name), offsetof(drogue_hls_words, name##_2)};  \
        memory(#name, (unsigned)(words), (unsigned)(size), offsetof(drogue_hls_writes, name), places, reads); \
    }
    DROGUE_HLS_PAIR_MEMORIES(X)
#undef X
    printf("endmodule\n");
    return 0;
}
