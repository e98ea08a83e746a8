/* SPDX-License-Identifier: Apache-2.0 */
/* Test bench: a question, put to the block and to the library. */
#ifndef DROGUE_HLS_INNER_BENCH_ASK_H
#define DROGUE_HLS_INNER_BENCH_ASK_H

#include <string.h>

#include "bench/bench.h"
#include "bench/inner.h"
#include "bench/sim.h"
#include "drogue/inner.h"
#include "inner.h"

enum { MOST_PIXELS = DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT, GUARD = 0x5A5A5A5A };

static uint8_t stream[DROGUE_HLS_INNER_PASSES * MOST_PIXELS];

static const char *const words[DROGUE_HLS_INNER_WORDS] = {"status", "x",         "y",        "area",
                                                          "spread", "threshold", "contrast", "which"};

/* What is asked, of both. */
typedef struct question {
    drogue_image image;
    drogue_mask disc;
    drogue_inner_expected expected;
} question;

static unsigned answers[DROGUE_STATUS_COUNT]; /* how many of each status */

/* Returns the number of pixels. */
static size_t send(const question *q)
{
    const size_t width = (size_t)q->image.width_px;
    uint8_t *to = stream;
    int32_t pass;
    int32_t y;
    for (pass = 0; pass < DROGUE_HLS_INNER_PASSES; pass++) {
        for (y = 0; y < q->image.height_px; y++, to += width) {
            memcpy(to, drogue_image_row(&q->image, y), width);
        }
    }
    return (size_t)(to - stream);
}

static int fits(const question *q)
{
    return q->image.width_px >= 1 && q->image.width_px <= DROGUE_HLS_WIDTH && q->image.height_px >= 1 &&
           q->image.height_px <= DROGUE_HLS_HEIGHT;
}

static void ask_block(int32_t dark[DROGUE_HLS_INNER_WORDS], const question *q)
{
    static int32_t out[DROGUE_HLS_INNER_WORDS];
    int32_t expected[DROGUE_HLS_DISCS * DROGUE_HLS_ELLIPSE_WORDS];
    const size_t sent = fits(q) ? send(q) : 0;
    int k;
    for (k = 0; k < DROGUE_HLS_DISCS; k++) {
        drogue_hls_pack_ellipse(expected + k * DROGUE_HLS_ELLIPSE_WORDS, &q->expected.disc[k]);
    }
    for (k = 0; k < DROGUE_HLS_INNER_WORDS; k++) {
        out[k] = GUARD; /* all are written */
    }
    SIM_BYTES(0, sent);
    SIM_ARRAY(1, expected);
    SIM_ARRAY(2, out);
    drogue_hls_inner(stream, expected, out, q->image.width_px, q->image.height_px, q->disc.centre2_x, q->disc.centre2_y,
                     q->disc.longest_px, q->expected.min_area_px, q->expected.count);
    memcpy(dark, out, sizeof out);
}

static void ask_library(int32_t dark[DROGUE_HLS_INNER_WORDS], const question *q)
{
    static uint32_t memory[DROGUE_WORKSPACE_BYTES(DROGUE_HLS_WIDTH, 1, DROGUE_HLS_LABELS, 1) / 4 + 1];
    const drogue_capacity capacity = {DROGUE_HLS_WIDTH, 1, DROGUE_HLS_LABELS, 1};
    drogue_workspace workspace;
    drogue_inner_part part;
    uint32_t which = 0;
    drogue_status status = drogue_workspace_init(&workspace, memory, sizeof memory, &capacity);
    if (status == DROGUE_OK) {
        status = drogue_inner_find(&part, &which, &workspace, &q->image, &q->disc, &q->expected);
    } else {
        memset(&part, 0, sizeof part);
    }
    bench_put_inner(dark, status | (status == DROGUE_E_LABELS_FULL ? DROGUE_HLS_INNER_FULL : 0), &part, which);
    answers[status]++;
}

static void compare(bench *b, int32_t dark[DROGUE_HLS_INNER_WORDS], const question *q)
{
    int32_t expected[DROGUE_HLS_INNER_WORDS];
    int k;
    ask_block(dark, q);
    ask_library(expected, q);
    for (k = 0; k < DROGUE_HLS_INNER_WORDS; k++) {
        bench_word(b, words[k], dark[k], expected[k]);
    }
}

static drogue_ellipse circle(drogue_q16 x, drogue_q16 y, drogue_q16 radius)
{
    drogue_ellipse e;
    e.xc_px_q16 = x;
    e.yc_px_q16 = y;
    e.a_px_q16 = radius;
    e.b_px_q16 = radius;
    e.angle_rad_q16 = 0;
    return e;
}

/* Discs about the middle of what is searched, for want of better. */
static void expect_middle(question *q)
{
    const drogue_q16 x = q->disc.centre2_x * (DROGUE_Q16_ONE / 2);
    const drogue_q16 y = q->disc.centre2_y * (DROGUE_Q16_ONE / 2);
    q->expected.disc[0] = circle(x, y, drogue_q16_div(q->disc.longest_px, 5));
    q->expected.disc[1] = circle(x + DROGUE_Q16_ONE, y, drogue_q16_div(q->disc.longest_px, 8));
    q->expected.count = 2;
}

#endif
