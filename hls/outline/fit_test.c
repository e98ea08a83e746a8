/* SPDX-License-Identifier: Apache-2.0 */
/* Test bench of drogue_hls_fit(): every vector of the stage 'ellipse' that the block holds. */
#include <string.h>

#include "../bench/bench.h"
#include "../words.h"
#include "drogue/ellipse.h"
#include "sim.h"

static uint32_t points[DROGUE_HLS_EDGES];

static void run(bench *b, const conf_case *c)
{
    const conf_array *in = bench_input(c, "points");
    const uint32_t count = (uint32_t)(in->count / 2);
    const int32_t frac_bits = (int32_t)conf_word(bench_input(c, "params"), 0);
    int32_t ellipse[5];
    int32_t words[6];
    drogue_moments moments;
    drogue_ellipse e;
    uint32_t i;
    if (count > (uint32_t)DROGUE_HLS_EDGES) {
        bench_skip(b, "more points than DROGUE_HLS_EDGES");
        return;
    }
    drogue_moments_clear(&moments);
    for (i = 0; i < count; i++) {
        const int32_t x = (int32_t)conf_word(in, 2 * i);
        const int32_t y = (int32_t)conf_word(in, 2 * i + 1);
        points[i] = (uint32_t)(uint16_t)x | (uint32_t)(uint16_t)y << 16;
        drogue_moments_add_point(&moments, x, y);
    }
    memset(ellipse, 0x55, sizeof ellipse);
    SIM_ARRAY(0, points);
    SIM_ARRAY(3, ellipse);
    words[0] = drogue_hls_fit(points, count, frac_bits, ellipse);
    memcpy(words + 1, ellipse, sizeof ellipse);
    (void)bench_word(b, "status", words[0], drogue_ellipse_fit(&e, &moments, frac_bits));
    (void)bench_words(b, "ellipse", words, bench_expected(c, "ellipse"));
}

int main(void)
{
    const conf_case *c;
    int32_t ellipse[5];
    bench b;
    bench_begin(&b, "fit");
    while ((c = bench_next(&b, "ellipse")) != NULL) {
        run(&b, c);
    }
    SIM_ARRAY(0, points);
    SIM_ARRAY(3, ellipse);
    (void)bench_word(&b, "more points than the memory",
                     drogue_hls_fit(points, (uint32_t)DROGUE_HLS_EDGES + 1, 0, ellipse), DROGUE_E_ARGUMENT);
    return bench_end(&b);
}
