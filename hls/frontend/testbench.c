/* SPDX-License-Identifier: Apache-2.0 */
/* Test bench of drogue_hls_frontend(): every list and status against the library's front end, bit for bit. */
#include <stdio.h>
#include <string.h>

#include "frontend.h"

static uint32_t
    memory[DROGUE_WORKSPACE_BYTES(DROGUE_HLS_WIDTH, DROGUE_HLS_EDGES, DROGUE_HLS_LABELS, DROGUE_HLS_ARCS) / 4 + 1];
static uint8_t pixels[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT];
static uint64_t edges[DROGUE_HLS_EDGES];
static uint64_t arcs[DROGUE_HLS_ARCS];

typedef struct lists {
    uint32_t edge_count;
    uint32_t arc_count;
    uint32_t status;
} lists;

static drogue_status library(drogue_edge_list *list, drogue_workspace *workspace, const drogue_frontend_config *config,
                             int32_t width_px, int32_t height_px)
{
    static const drogue_capacity capacity = {DROGUE_HLS_WIDTH, DROGUE_HLS_EDGES, DROGUE_HLS_LABELS, DROGUE_HLS_ARCS};
    drogue_frontend frontend;
    drogue_status status;
    int32_t y;
    list->edge_count = 0;
    list->arc_count = 0;
    drogue_workspace_init(workspace, memory, sizeof memory, &capacity);
    status = drogue_frontend_begin(&frontend, workspace, config, width_px, height_px);
    if (status != DROGUE_OK) {
        return status;
    }
    for (y = 0; y < height_px; y++) {
        drogue_frontend_row(&frontend, pixels + y * width_px);
    }
    return drogue_frontend_end(list, &frontend);
}

static int check(const char *name, const drogue_frontend_config *c, int32_t width_px, int32_t height_px)
{
    drogue_workspace workspace;
    drogue_edge_list expected;
    lists got = {77, 77, 77};
    const drogue_status status = library(&expected, &workspace, c, width_px, height_px);
    uint32_t i;
    int differ;
    drogue_hls_frontend(pixels, edges, arcs, width_px, height_px, c->canny_low, c->canny_high, c->smooth, c->min_arc_px,
                        c->use_ring, c->ring.centre2_x, c->ring.centre2_y, c->ring.longest_px, &got.edge_count,
                        &got.arc_count, &got.status);
    differ = got.edge_count != expected.edge_count || got.arc_count != expected.arc_count ||
             (got.status & DROGUE_HLS_STATUS) != (uint32_t)status;
    for (i = 0; i < expected.edge_count && !differ; i++) {
        differ = edges[i] != drogue_hls_pack_edge(&workspace.edges[i]);
    }
    for (i = 0; i < expected.arc_count && !differ; i++) {
        differ = arcs[i] != drogue_hls_pack_arc(&workspace.arcs[i]);
    }
    if (differ) {
        printf("%s: %d x %d: differs: edges %u (%u), arcs %u (%u), status 0x%x (%u)\n", name, (int)width_px,
               (int)height_px, (unsigned)got.edge_count, (unsigned)expected.edge_count, (unsigned)got.arc_count,
               (unsigned)expected.arc_count, (unsigned)got.status, (unsigned)status);
    }
    return differ;
}

int main(void)
{
    uint32_t rng = 1;
    int n, failed = 0, full = 0;
    for (n = 0; n < 6000; n++) {
        drogue_frontend_config c;
        int32_t width, height, k;
        int kind;
#define R(m) (rng = rng * 1664525u + 1013904223u, (int32_t)((rng >> 8) % (uint32_t)(m)))
        width = 1 + R(n % 3 ? 40 : DROGUE_HLS_WIDTH);
        height = 1 + R(n % 5 ? 40 : DROGUE_HLS_HEIGHT);
        kind = R(4);
        for (k = 0; k < width * height; k++) {
            int x = k % width, y = k / width;
            pixels[k] = (uint8_t)(kind == 0                                         ? R(256)
                                  : kind == 1                                       ? (R(20) ? 0 : 255)
                                  : kind == 2                                       ? ((x / 3 + y / 2) & 1) * 200 + R(9)
                                  : (x - 20) * (x - 20) + (y - 20) * (y - 20) < 200 ? 30 + R(8)
                                                                                    : 200 + R(8));
        }
        c.canny_low = R(120);
        c.canny_high = c.canny_low + R(300);
        c.smooth = R(3) != 0;
        c.use_ring = R(2);
        c.ring = drogue_mask_of_size(width, height);
        c.min_arc_px = (uint32_t)R(12);
        failed += check("random", &c, width, height);
    }
    printf("frontend: cases=%d failed=%d full=%d\n", n, failed, full);
    return failed;
}
