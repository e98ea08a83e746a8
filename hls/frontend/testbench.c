/* SPDX-License-Identifier: Apache-2.0 */
/* Test bench of drogue_hls_frontend(): the golden vectors of edges and arcs word for word; and every frame, with images
 * drawn at random in tables that fill, against the library's front end: without DROGUE_HLS_FEW, and not in Bambu. */
#include <string.h>

#include "bench.h"
#include "drogue/config.h"
#include "frontend.h"
#include "sim.h"

static uint32_t
    memory[DROGUE_WORKSPACE_BYTES(DROGUE_HLS_WIDTH, DROGUE_HLS_EDGES, DROGUE_HLS_LABELS, DROGUE_HLS_ARCS) / 4 + 1];
static uint8_t pixels[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT];
static uint64_t edges[DROGUE_HLS_EDGES];
static uint64_t arcs[DROGUE_HLS_ARCS];
static uint8_t map[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT];

/* What the block answers beside its lists. */
typedef struct answer {
    uint32_t edge_count;
    uint32_t arc_count;
    uint32_t status;
} answer;

static answer run_block(const drogue_frontend_config *c, int32_t width_px, int32_t height_px)
{
    uint32_t results[DROGUE_HLS_FRONTEND_RESULTS];
    answer a;
    SIM_ARRAY(0, pixels);
    SIM_ARRAY(1, edges);
    SIM_ARRAY(2, arcs);
    SIM_ARRAY(13, results);
    drogue_hls_frontend(pixels, edges, arcs, width_px, height_px, c->canny_low, c->canny_high, c->smooth, c->min_arc_px,
                        c->use_ring, c->ring.centre2_x, c->ring.centre2_y, c->ring.longest_px, results);
    a.edge_count = results[DROGUE_HLS_FRONTEND_EDGE_COUNT];
    a.arc_count = results[DROGUE_HLS_FRONTEND_ARC_COUNT];
    a.status = results[DROGUE_HLS_FRONTEND_STATUS];
    return a;
}

/* Bring the part of an image into the stream's order; 0 when it is larger than the block. */
static int load(const drogue_image *image, int32_t x_px, int32_t y_px, int32_t width_px, int32_t height_px)
{
    int32_t y;
    if (width_px > DROGUE_HLS_WIDTH || height_px > DROGUE_HLS_HEIGHT) {
        return 0;
    }
    for (y = 0; y < height_px; y++) {
        memcpy(pixels + y * width_px, drogue_image_row(image, y_px + y) + x_px, (size_t)width_px);
    }
    return 1;
}

static drogue_status run_library(drogue_edge_list *list, drogue_workspace *workspace, const drogue_frontend_config *c,
                                 int32_t width_px, int32_t height_px)
{
    static const drogue_capacity capacity = {DROGUE_HLS_WIDTH, DROGUE_HLS_EDGES, DROGUE_HLS_LABELS, DROGUE_HLS_ARCS};
    drogue_frontend frontend;
    drogue_status status = drogue_workspace_init(workspace, memory, sizeof memory, &capacity);
    int32_t y;
    list->edge_count = 0;
    list->arc_count = 0;
    if (status == DROGUE_OK) {
        status = drogue_frontend_begin(&frontend, workspace, c, width_px, height_px);
    }
    if (status != DROGUE_OK) {
        return status;
    }
    for (y = 0; y < height_px; y++) {
        drogue_frontend_row(&frontend, pixels + y * width_px);
    }
    return drogue_frontend_end(list, &frontend);
}

/* The block against the library, on the pixels loaded; returns the block's status. */
static uint32_t against_library(bench *b, const drogue_frontend_config *c, int32_t width_px, int32_t height_px)
{
    drogue_workspace workspace;
    drogue_edge_list list;
    const drogue_status status = run_library(&list, &workspace, c, width_px, height_px);
    const answer a = run_block(c, width_px, height_px);
    uint32_t i;
    int same = bench_word(b, "status", a.status & DROGUE_HLS_STATUS, status) &&
               bench_word(b, "edge points", a.edge_count, list.edge_count) &&
               bench_word(b, "arcs", a.arc_count, list.arc_count);
    for (i = 0; i < list.edge_count && same; i++) {
        same = bench_word(b, "edge point", (int64_t)edges[i], (int64_t)drogue_hls_pack_edge(&workspace.edges[i]));
    }
    for (i = 0; i < list.arc_count && same; i++) {
        same = bench_word(b, "arc", (int64_t)arcs[i], (int64_t)drogue_hls_pack_arc(&workspace.arcs[i]));
    }
    return a.status;
}

/* A table that filled where the vectors' tables, which are larger, did not: the block says so, and that is right. */
static int smaller_table_full(bench *b, uint32_t status)
{
    enum {
        FULL = DROGUE_HLS_COMPONENTS_FULL | DROGUE_HLS_ARC_LABELS_FULL | DROGUE_HLS_EDGES_FULL | DROGUE_HLS_ARCS_FULL
    };
    if ((status & FULL) == 0 || (DROGUE_HLS_EDGES >= 16384 && DROGUE_HLS_LABELS >= 8192 && DROGUE_HLS_ARCS >= 1024)) {
        return 0;
    }
    bench_skip(b, "a table fills that is smaller than the vectors'");
    return 1;
}

/* Stage 'arcs': status, counts, pixel, class and arc of each point, and its subpixel place and gradient. */
static void check_arcs(bench *b, const conf_case *c)
{
    const drogue_image image = bench_image(c);
    const int32_t *p = bench_words32(bench_input(c, "params"));
    const conf_array *expected = bench_expected(c, "edges");
    const int32_t *want = bench_words32(bench_expected(c, "arcs"));
    const int32_t *want_edge = bench_words32(expected);
    const drogue_frontend_config config = {p[0], p[1], p[2], p[3], {p[4], p[5], p[6]}, (uint32_t)p[7]};
    answer a;
    uint32_t arc = 0;
    uint32_t i;
    if (!load(&image, 0, 0, image.width_px, image.height_px)) {
        bench_skip(b, "larger than the block");
        return;
    }
    a = run_block(&config, image.width_px, image.height_px);
    if (smaller_table_full(b, a.status)) {
        return;
    }
    if (!bench_word(b, "status", a.status & DROGUE_HLS_STATUS, want[0]) || want[0] != DROGUE_OK ||
        !bench_word(b, "edge points", a.edge_count, want[1]) || !bench_word(b, "arcs", a.arc_count, want[2])) {
        return;
    }
    for (i = 0; i < a.edge_count; i++) {
        const drogue_edge e = drogue_hls_unpack_edge(edges[i]);
        const int32_t got[4] = {e.x_q5, e.y_q5, e.gx, e.gy};
        int32_t in = -1;
        if (arc < a.arc_count) {
            const drogue_arc one = drogue_hls_unpack_arc(arcs[arc]);
            in = (int32_t)arc;
            bench_word(b, "direction", one.direction, want[3 + 4 * i + 2]);
            arc += i + 1u == one.first + one.count;
        }
        if (!bench_check(b, "edge point", memcmp(got, want_edge + 4 * i, sizeof got) == 0) ||
            !bench_word(b, "arc of a point", in, want[3 + 4 * i + 3])) {
            return;
        }
    }
}

/* Stage 'canny': the map of edges, hysteresis of any length included. */
static void check_canny(bench *b, const conf_case *c)
{
    const drogue_image image = bench_image(c);
    const int32_t *p = bench_words32(bench_input(c, "params"));
    const drogue_frontend_config config = {p[0], p[1], p[2], 0, {0, 0, 1}, UINT32_MAX};
    answer a;
    uint32_t i;
    if (!load(&image, 0, 0, image.width_px, image.height_px)) {
        bench_skip(b, "larger than the block");
        return;
    }
    a = run_block(&config, image.width_px, image.height_px);
    if (smaller_table_full(b, a.status)) {
        return;
    }
    memset(map, 0, sizeof map);
    for (i = 0; i < a.edge_count; i++) {
        const drogue_edge e = drogue_hls_unpack_edge(edges[i]);
        map[drogue_edge_y_px(&e) * image.width_px + drogue_edge_x_px(&e)] = 255;
    }
    bench_word(b, "status", a.status, DROGUE_OK);
    bench_words(b, "map", map, bench_expected(c, "map"));
}

static int32_t smaller(int32_t a, int32_t b) { return a < b ? a : b; }

/* Stage 'frame': the region's part of the image, as much of it as the block is large, with the thresholds of the default configuration. */
static void check_frame(bench *b, const conf_case *c)
{
    const drogue_image image = bench_image(c);
    const drogue_region region = bench_region(c);
    const drogue_config of_case = bench_config(c);
    drogue_frontend_config config;
    drogue_region part;
    if (!bench_place(&part, &config.ring, &image, &region)) {
        bench_skip(b, "no region");
        return;
    }
    config.canny_low = of_case.canny_low;
    config.canny_high = of_case.canny_high;
    config.smooth = of_case.smooth;
    config.use_ring = 1;
    config.min_arc_px = of_case.min_arc_px;
    part.width_px = smaller(part.width_px, DROGUE_HLS_WIDTH);
    part.height_px = smaller(part.height_px, DROGUE_HLS_HEIGHT);
    if (part.width_px > 0 && part.height_px > 0) {
        load(&image, part.x_px, part.y_px, part.width_px, part.height_px);
    }
    against_library(b, &config, part.width_px, part.height_px);
}

static int32_t random_below(uint32_t *state, int32_t n)
{
    *state = *state * 1664525u + 1013904223u;
    return (int32_t)((*state >> 8) % (uint32_t)n);
}

/* A grey level of one of four kinds of image: noise, specks, a board, a disc. */
static uint8_t draw(uint32_t *state, int32_t kind, int32_t x, int32_t y)
{
    const int32_t dx = x - 20;
    const int32_t dy = y - 20;
    return (uint8_t)(kind == 0   ? random_below(state, 256)
                     : kind == 1 ? (random_below(state, 20) != 0 ? 0 : 255)
                     : kind == 2 ? ((x / 3 + y / 2) & 1) * 200 + random_below(state, 9)
                                 : (dx * dx + dy * dy < 200 ? 30 : 200) + random_below(state, 8));
}

/* Images of all sizes and kinds with any thresholds, refused ones too. Notes which bits the status register showed. */
static uint32_t check_random(bench *b, int count)
{
    uint32_t state = 1;
    uint32_t seen = 0;
    int n;
    for (n = 0; n < count; n++) {
        const int32_t most = n % 4 == 0 ? 120 : 40;
        const int32_t width_px = 1 + random_below(&state, most < DROGUE_HLS_WIDTH ? most : DROGUE_HLS_WIDTH);
        const int32_t height_px = 1 + random_below(&state, most < DROGUE_HLS_HEIGHT ? most : DROGUE_HLS_HEIGHT);
        const int32_t kind = random_below(&state, 4);
        drogue_frontend_config c;
        int32_t k;
        for (k = 0; k < width_px * height_px; k++) {
            pixels[k] = draw(&state, kind, k % width_px, k / width_px);
        }
        c.canny_low = random_below(&state, 120) - 1;
        c.canny_high = c.canny_low + random_below(&state, 300) - 1;
        c.smooth = random_below(&state, 3) != 0;
        c.use_ring = random_below(&state, 2);
        c.ring = drogue_mask_of_size(width_px, height_px);
        c.min_arc_px = (uint32_t)random_below(&state, 12);
        seen |= against_library(b, &c, width_px, height_px);
    }
    return seen;
}

int main(void)
{
    bench b;
    const conf_case *c;
    bench_begin(&b, "frontend");
    while ((c = bench_next(&b, "arcs")) != NULL) {
        check_arcs(&b, c);
    }
    while ((c = bench_next(&b, "canny")) != NULL) {
        check_canny(&b, c);
    }
    while ((c = bench_next(&b, "frame")) != NULL) {
        check_frame(&b, c);
    }
#if !defined __BAMBU_SIM__ && !defined DROGUE_HLS_FEW /* a simulation of the hardware takes hours for these */
    {
        const uint32_t seen = check_random(&b, 2000);
        if (DROGUE_HLS_EDGES <= 120) { /* built with small tables: all of them must have filled */
            bench_word(&b, "bits seen of full tables", seen & 0xF00u, 0xF00u);
        }
    }
#endif
    return bench_end(&b);
}
