/* SPDX-License-Identifier: Apache-2.0 */
/* The front end's memories, and its clocks one after the other. */
#include "frontend.h"

#include "stages.h"

#define X(name, words, bits) static uint64_t name[words];
DROGUE_HLS_MEMORIES(X)
DROGUE_HLS_PAIR_MEMORIES(X)
#undef X

/* A word of 'bits' bits, as a memory keeps it. */
static uint64_t kept(uint64_t word, int32_t bits) { return word & UINT64_MAX >> (64 - bits); }

static void read_words(drogue_hls_words *read, const drogue_hls_places *places)
{
#define X(name, words, bits) read->name = name[places->name < (uint32_t)(words) ? places->name : 0];
    DROGUE_HLS_MEMORIES(X)
    DROGUE_HLS_PAIR_MEMORIES(X)
#undef X
#define X(name, words, bits) read->name##_2 = name[places->name##_2 < (uint32_t)(words) ? places->name##_2 : 0];
    DROGUE_HLS_PAIR_MEMORIES(X)
#undef X
}

static void write_words(const drogue_hls_writes *write)
{
#define X(name, words, bits)                                      \
    if (write->name.enable) {                                     \
        name[write->name.address] = kept(write->name.word, bits); \
    }
    DROGUE_HLS_MEMORIES(X)
    DROGUE_HLS_PAIR_MEMORIES(X)
#undef X
}

void drogue_hls_frontend(const uint8_t pixels[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT], uint64_t edges[DROGUE_HLS_EDGES],
                         uint64_t arcs[DROGUE_HLS_ARCS], int32_t width_px, int32_t height_px, int32_t canny_low,
                         int32_t canny_high, int32_t smooth, uint32_t min_arc_px, int32_t use_ring, int32_t centre2_x,
                         int32_t centre2_y, int32_t longest_px, uint32_t results[DROGUE_HLS_FRONTEND_RESULTS])
{
#ifdef __BAMBU__
#pragma HLS interface port = pixels mode = fifo
#pragma HLS interface port = edges mode = m_axi offset = direct
#pragma HLS interface port = arcs mode = m_axi offset = direct
#else
#pragma HLS interface mode = axis port = pixels
#pragma HLS interface mode = m_axi port = edges bundle = lists
#pragma HLS interface mode = m_axi port = arcs bundle = lists
#pragma HLS interface mode = s_axilite port = width_px
#pragma HLS interface mode = s_axilite port = height_px
#pragma HLS interface mode = s_axilite port = canny_low
#pragma HLS interface mode = s_axilite port = canny_high
#pragma HLS interface mode = s_axilite port = smooth
#pragma HLS interface mode = s_axilite port = min_arc_px
#pragma HLS interface mode = s_axilite port = use_ring
#pragma HLS interface mode = s_axilite port = centre2_x
#pragma HLS interface mode = s_axilite port = centre2_y
#pragma HLS interface mode = s_axilite port = longest_px
#pragma HLS interface mode = s_axilite port = results
#pragma HLS interface mode = s_axilite port = return
#endif
    static drogue_hls_registers r;
    drogue_hls_asked asked;
    drogue_hls_places places = {0};
    drogue_hls_words read;
    drogue_hls_writes write;
    uint32_t taken = 0;
    asked.width_px = width_px;
    asked.height_px = height_px;
    asked.canny_low = canny_low;
    asked.canny_high = canny_high;
    asked.smooth = smooth;
    asked.min_arc_px = min_arc_px;
    asked.use_ring = use_ring;
    asked.centre2_x = centre2_x;
    asked.centre2_y = centre2_y;
    asked.longest_px = longest_px;
    asked.start = 1;
    do { /* bound: clocks of a frame, hls/frontend/README.md */
        asked.pixel = 0;
        if (drogue_hls_takes(&r)) {
            asked.pixel = pixels[taken++];
        }
        read_words(&read, &places);
        drogue_hls_step(&r, &asked, &read, &places, &write);
        write_words(&write);
        if (write.edges.enable) {
            edges[write.edges.address] = write.edges.word;
        }
        if (write.arcs.enable) {
            arcs[write.arcs.address] = write.arcs.word;
        }
    } while (r.phase != PHASE_IDLE);
    results[DROGUE_HLS_FRONTEND_EDGE_COUNT] = r.lists.left;
    results[DROGUE_HLS_FRONTEND_ARC_COUNT] = r.lists.arcs;
    results[DROGUE_HLS_FRONTEND_STATUS] = r.status;
}
