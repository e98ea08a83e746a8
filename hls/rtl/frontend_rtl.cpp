// SPDX-License-Identifier: Apache-2.0
// drogue_hls_frontend() as the test bench of the C calls it, but by the Verilog under Verilator; counts clocks.
#include <cstdio>
#include <cstdlib>

#include "Vdrogue_frontend.h"
#include "verilated.h"

extern "C" {
#include "frontend/frontend.h"

static const uint32_t most_clocks = 20u * 1000u * 1000u;

namespace {

// The busiest frame of the largest region, in clocks.
struct Busiest {
    unsigned long clocks = 0, rows = 0, waiting = 0;
    ~Busiest()
    {
        const unsigned long px = DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT;
        if (clocks) {
            printf("rtl: busiest frame of %d x %d: %lu clocks, %lu of them until the lists begin: %lu.%03lu a pixel\n",
                   DROGUE_HLS_WIDTH, DROGUE_HLS_HEIGHT, clocks, rows, clocks / px, clocks % px * 1000 / px);
        }
    }
} busiest;

Vdrogue_frontend *block()
{
    static Vdrogue_frontend *v = nullptr;
    if (v == nullptr) {
        v = new Vdrogue_frontend;
    }
    return v;
}

void rise(Vdrogue_frontend *v)
{
    v->clock = 1;
    v->eval();
    v->clock = 0; // takes effect with the inputs of the next clock
}

} // namespace

void drogue_hls_frontend(const uint8_t *pixels, uint64_t *edges, uint64_t *arcs, int32_t width_px, int32_t height_px,
                         int32_t canny_low, int32_t canny_high, int32_t smooth, uint32_t min_arc_px, int32_t use_ring,
                         int32_t centre2_x, int32_t centre2_y, int32_t longest_px, uint32_t *results)
{
    static uint32_t gaps = 1;
    static unsigned long frames = 0;
    Vdrogue_frontend *v = block();
    unsigned long clocks = 0, rows = 0, taken = 0;
    const bool stalls = ++frames % 4 == 0; // a camera that does not always have a pixel
    v->width_px = (uint32_t)width_px;
    v->height_px = (uint32_t)height_px;
    v->canny_low = (uint32_t)canny_low;
    v->canny_high = (uint32_t)canny_high;
    v->smooth = (uint32_t)smooth;
    v->min_arc_px = min_arc_px;
    v->use_ring = (uint32_t)use_ring;
    v->centre2_x = (uint32_t)centre2_x;
    v->centre2_y = (uint32_t)centre2_y;
    v->longest_px = (uint32_t)longest_px;
    v->start = 1;
    v->eval();
    do {
        gaps = gaps * 1664525u + 1013904223u;
        v->pixel_valid = stalls ? gaps >> 30 != 0 : 1;
        v->pixel = v->pixel_valid && v->pixel_ready ? pixels[taken] : 0xA5;
        v->eval(); // the same half of the clock: writes may follow from the pixel
        taken += v->pixel_valid && v->pixel_ready;
        if (v->edge_write) {
            edges[v->edge_at] = v->edge_word;
        }
        if (v->arc_write) {
            arcs[v->arc_at] = v->arc_word;
        }
        rise(v);
        v->start = 0;
        clocks++;
        rows += !v->listing;
        if (clocks > most_clocks) {
            printf("rtl: the block does not end\n");
            exit(1);
        }
        v->eval();
    } while (v->busy);
    if (!stalls && width_px == DROGUE_HLS_WIDTH && height_px == DROGUE_HLS_HEIGHT && clocks > busiest.clocks) {
        busiest.clocks = clocks;
        busiest.rows = rows;
    }
    results[DROGUE_HLS_FRONTEND_EDGE_COUNT] = v->edge_count;
    results[DROGUE_HLS_FRONTEND_ARC_COUNT] = v->arc_count;
    results[DROGUE_HLS_FRONTEND_STATUS] = v->status;
}
}
