/* SPDX-License-Identifier: Apache-2.0 */
/* Test bench of drogue_hls_outline(): the lists of every frame vector, from the library's front end; each word that the
 * top gives is compared with the library's functions. */
#include "frame.h"
#include "sim.h"

static uint64_t edges[DROGUE_HLS_EDGES];
static uint64_t arcs[DROGUE_HLS_ARCS];
static uint8_t pixels[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT];
static int32_t width_px = 1;
static int32_t height_px = 1;
static int32_t parameters[DROGUE_HLS_PARAMETERS];
static int32_t outline[DROGUE_HLS_OUTLINE_WORDS];

static void call(uint32_t edge_count, uint32_t arc_count, uint32_t frontend_status)
{
    memset(outline, 0x55, sizeof outline);
    SIM_ARRAY(0, edges);
    SIM_ARRAY(2, arcs);
    SIM_ARRAY(5, pixels);
    SIM_ARRAY(8, parameters);
    SIM_ARRAY(9, outline);
    drogue_hls_outline(edges, edge_count, arcs, arc_count, frontend_status, pixels, width_px, height_px, parameters,
                       outline);
}

static int same(bench *b, const char *what, const int32_t expected[DROGUE_HLS_OUTLINE_WORDS])
{
    int ok = 1;
    int i;
    for (i = 0; i < DROGUE_HLS_OUTLINE_WORDS && ok; i++) {
        ok = bench_word(b, what, outline[i], expected[i]);
        if (!ok) {
            ok = bench_word(b, "which is word", i, -1);
        }
    }
    return ok;
}

static void run(bench *b, frame *f, const conf_case *c)
{
    static const drogue_transfer transfer[2] = {DROGUE_TRANSFER_SRGB, DROGUE_TRANSFER_LINEAR};
    int k;
    uint32_t i;
    if (!frame_read(f, c)) {
        bench_skip(b, "no region within the image and the blocks");
        return;
    }
    frame_run_frontend(f);
    for (i = 0; i < f->list.edge_count; i++) {
        edges[i] = drogue_hls_pack_edge(&f->workspace.edges[i]);
    }
    for (i = 0; i < f->list.arc_count; i++) {
        arcs[i] = drogue_hls_pack_arc(&f->workspace.arcs[i]);
    }
    frame_pack_pixels(pixels, f);
    width_px = f->view.width_px;
    height_px = f->view.height_px;
    for (k = 0; k < 2; k++) {
        f->p.config.transfer = transfer[k];
        drogue_hls_pack_parameters(parameters, &f->p);
        call(f->list.edge_count, f->list.arc_count, (uint32_t)f->front);
        frame_find_outline(f);
        (void)same(b, "outline", f->words);
    }
}

static void refuses(bench *b, const char *what, uint32_t edge_count, uint32_t arc_count)
{
    int32_t expected[DROGUE_HLS_OUTLINE_WORDS];
    memset(expected, 0, sizeof expected);
    memset(expected + DROGUE_HLS_O_ARCS, 0xFF, 4 * sizeof *expected);
    expected[DROGUE_HLS_O_STATUS] = expected[DROGUE_HLS_O_FOUND] = DROGUE_E_ARGUMENT;
    call(edge_count, arc_count, 0);
    (void)same(b, what, expected);
}

/* What no front end and no driver should give, after a frame that was measured. */
static void run_refused(bench *b)
{
    static const int at[3] = {DROGUE_HLS_P_MASK_LONGEST, DROGUE_HLS_P_FY, DROGUE_HLS_P_REFIT_ROUNDS};
    drogue_arc arc = {0, 5, 0};
    int k;
    arcs[0] = drogue_hls_pack_arc(&arc);
    refuses(b, "arc beyond the list", 4, 1);
    refuses(b, "more edges than the memory", (uint32_t)DROGUE_HLS_EDGES + 1, 0);
    refuses(b, "more arcs than the memory", 0, (uint32_t)DROGUE_HLS_ARCS + 1);
    width_px = DROGUE_HLS_WIDTH + 1;
    refuses(b, "wider than the memory", 0, 0);
    width_px = 0;
    refuses(b, "no column", 0, 0);
    width_px = 1;
    height_px = DROGUE_HLS_HEIGHT + 1;
    refuses(b, "higher than the memory", 0, 0);
    height_px = 0;
    refuses(b, "no row", 0, 0);
    height_px = 1;
    arc.count = 0;
    arcs[0] = drogue_hls_pack_arc(&arc);
    refuses(b, "empty arc", 4, 1);
    for (k = 0; k < 3; k++) {
        const int32_t was = parameters[at[k]];
        parameters[at[k]] = -1;
        refuses(b, "parameter", 0, 0);
        parameters[at[k]] = was;
    }
}

int main(void)
{
    static frame f;
    const conf_case *c;
    bench b;
    int measured = 0;
    bench_begin(&b, "outline");
    while ((c = bench_next(&b, "frame")) != NULL) {
        run(&b, &f, c);
        if (!measured && f.result.status == DROGUE_OK && f.list.arc_count > 0) {
            measured = 1;
            run_refused(&b);
        }
    }
    (void)bench_check(&b, "a frame was measured", measured);
    return bench_end(&b);
}
