/* SPDX-License-Identifier: Apache-2.0 */
/* Test bench of drogue_hls_fit(): every vector of the stage 'ellipse' that the block holds. */
#include "backend.h"
#include "drogue/ellipse.h"
#include "testbench.h"

static uint32_t points[DROGUE_HLS_EDGES];

static void run(bench *b, const conf_case *c)
{
    const uint32_t count = (uint32_t)(c->inputs[0].count / 2);
    const int32_t frac_bits = (int32_t)conf_word(&c->inputs[1], 0);
    int32_t words[6];
    int32_t expected[6] = {0, 0, 0, 0, 0, 0};
    drogue_moments moments;
    drogue_ellipse e;
    uint32_t i;
    if (count > (uint32_t)DROGUE_HLS_EDGES) {
        bench_skip(b, c->id, "more points than DROGUE_HLS_EDGES");
        return;
    }
    bench_begin(b, c->id);
    drogue_moments_clear(&moments);
    for (i = 0; i < count; i++) {
        const int32_t x = (int32_t)conf_word(&c->inputs[0], 2 * i);
        const int32_t y = (int32_t)conf_word(&c->inputs[0], 2 * i + 1);
        points[i] = (uint32_t)(uint16_t)x | (uint32_t)(uint16_t)y << 16;
        drogue_moments_add_point(&moments, x, y);
    }
    BENCH_ARRAY(0, points);
    BENCH_ARRAY(3, words);
    words[0] = drogue_hls_fit(points, count, frac_bits, words + 1);
    expected[0] = (int32_t)drogue_ellipse_fit(&e, &moments, frac_bits);
    if (expected[0] == DROGUE_OK) {
        drogue_hls_pack_ellipse(expected + 1, &e);
    }
    bench_words32(b, "fit", words, expected, 6);
    bench_vector32(b, c, "ellipse", words, 6);
    bench_end(b, "");
}

int main(void)
{
    bench b = {"fit", "", 0, 0, 0, 0};
    size_t l;
    size_t i;
    for (l = 0; l < conf_case_list_count; l++) {
        for (i = 0; i < conf_case_lists[l].count; i++) {
            if (bench_wants(&conf_case_lists[l].cases[i], "ellipse")) {
                run(&b, &conf_case_lists[l].cases[i]);
            }
        }
    }
    return bench_report(&b);
}
