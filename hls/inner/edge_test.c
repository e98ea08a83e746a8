/* SPDX-License-Identifier: Apache-2.0 */
/* Test bench of drogue_hls_edge(): front end and outline of every frame vector by the library, the region's pixels row by
 * row in a memory of their own; each word that the top gives is compared with the library's. */
#include "frame.h"
#include "sim.h"

static uint8_t pixels[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT];
static int32_t parameters[DROGUE_HLS_PARAMETERS];
static int32_t got[DROGUE_HLS_EDGE_WORDS];

static void call(frame *f)
{
    frame_pack_pixels(pixels, f);
    memset(got, 0x55, sizeof got);
    drogue_hls_pack_parameters(parameters, &f->p);
    SIM_ARRAY(0, pixels);
    SIM_ARRAY(1, parameters);
    SIM_ARRAY(2, f->words);
    SIM_ARRAY(5, got);
    drogue_hls_edge(pixels, parameters, f->words, f->view.width_px, f->view.height_px, got);
}

int main(void)
{
    static frame f;
    const conf_case *c;
    int found = 0;
    bench b;
    bench_begin(&b, "edge");
    while ((c = bench_next(&b, "frame")) != NULL) {
        int32_t expected[DROGUE_HLS_EDGE_WORDS];
        int k;
        if (!frame_read(&f, c)) {
            bench_skip(&b, "no region within the image and the blocks");
            continue;
        }
        frame_run_frontend(&f);
        for (f.p.larger = 0; f.p.larger < 2; f.p.larger++) {
            frame_find_outline(&f);
            frame_find_inner(expected, &f);
            call(&f);
            for (k = 0; k < DROGUE_HLS_EDGE_WORDS; k++) {
                (void)bench_word(&b, "edge", got[k], expected[k]);
            }
            found += expected[DROGUE_HLS_E_STATUS] == DROGUE_OK;
        }
    }
    (void)bench_check(&b, "discs found", found > 0);
    return bench_end(&b);
}
