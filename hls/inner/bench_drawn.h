/* SPDX-License-Identifier: Apache-2.0 */
/* Test bench: images drawn, at random or to fill the tables. */
#ifndef DROGUE_HLS_INNER_BENCH_DRAWN_H
#define DROGUE_HLS_INNER_BENCH_DRAWN_H

#include <stdio.h>

#include "bench_ask.h"

static uint8_t drawn[MOST_PIXELS];

static uint32_t random_state = 1;

/* [0, below) */
static uint32_t random_below(uint32_t below)
{
    random_state = random_state * UINT32_C(1664525) + UINT32_C(1013904223);
    return (uint32_t)(((uint64_t)random_state * below) >> 32);
}

typedef enum pattern { NOISE, CELLS, COMB, ARCHES, DISC, FLAT, PATTERNS } pattern;
static const char *const pattern_names[PATTERNS] = {"noise", "cells", "comb", "arches", "disc", "flat"};

/* Of 3-pixel strokes: what the opening leaves, with as many merges and labels as that allows. */
static int is_stroke(pattern kind, int32_t x, int32_t y, int32_t width_px, const uint8_t *dice)
{
    const int32_t depth = x < width_px / 2 ? x : width_px - 1 - x; /* nested arches: the outer ones join last */
    switch (kind) {
    case CELLS:
        return dice[(x / 4 * 7 + y / 4 * 13) % 256] < 150 && (x % 4 < 3 || dice[x % 256] < 90) &&
               (y % 4 < 3 || dice[(y + x / 4) % 256] < 60);
    case COMB: return x % 4 < 3 ? y % 32 >= dice[x / 4 % 256] % 16 : y % 32 > 20 + dice[x / 8 % 256] % 8;
    default: return depth % 4 < 3 ? y > dice[depth / 4 % 256] % 8 : y > 12 + (depth / 4 * 5 + dice[0]) % 40;
    }
}

static uint8_t level_of(pattern kind, int32_t x, int32_t y, const question *q, const uint8_t *dice)
{
    const drogue_mask inner = {q->disc.centre2_x, q->disc.centre2_y, q->disc.longest_px / 2};
    const uint32_t noise = random_below(40);
    switch (kind) {
    case NOISE: return (uint8_t)random_below(256);
    case FLAT: return dice[0];
    case DISC: return (uint8_t)((drogue_mask_in_disc(&inner, x, y) && x % 16 != dice[0] % 64 ? 20u : 180u) + noise);
    default: return (uint8_t)((is_stroke(kind, x, y, q->image.width_px, dice) ? 10u : 200u) + noise);
    }
}

static void draw(question *q, pattern kind, int32_t width_px, int32_t height_px)
{
    uint8_t dice[256];
    int32_t x;
    int32_t y;
    for (x = 0; x < 256; x++) {
        dice[x] = (uint8_t)random_below(256);
    }
    q->image.data = drawn;
    q->image.width_px = width_px;
    q->image.height_px = height_px;
    q->image.stride = width_px;
    for (y = 0; y < height_px; y++) {
        for (x = 0; x < width_px; x++) {
            drawn[y * width_px + x] = level_of(kind, x, y, q, dice);
        }
    }
}

static drogue_q16 random_q16(int32_t below_px) { return (drogue_q16)random_below((uint32_t)below_px * 65536u); }

/* Random discs over an image of random size. */
static void draw_random(question *q, pattern kind, int32_t most_px)
{
    const int32_t width = 1 + (int32_t)random_below((uint32_t)most_px);
    const int32_t height = 1 + (int32_t)random_below((uint32_t)most_px);
    const uint32_t spread = 2u * (uint32_t)(width > height ? width : height);
    uint32_t i;
    q->disc = drogue_mask_of_size(width, height);
    if (random_below(3) != 0) {
        q->disc.centre2_x = (int32_t)random_below(spread + 8) - 4;
        q->disc.centre2_y = (int32_t)random_below(spread + 8) - 4;
    }
    q->disc.longest_px = 1 + (int32_t)random_below(random_below(4) == 0 ? 1u << 20 : 2 * spread);
    q->expected.min_area_px = random_below(20);
    q->expected.count = random_below(8) == 0 ? 0 : 1 + random_below(2);
    for (i = 0; i < DROGUE_HLS_DISCS; i++) {
        q->expected.disc[i] = circle(random_q16(width), random_q16(height), DROGUE_Q16_ONE + random_q16(most_px));
        if (random_below(2) == 0) {
            q->expected.disc[i].xc_px_q16 = q->disc.centre2_x * (DROGUE_Q16_ONE / 2) + random_q16(4);
            q->expected.disc[i].yc_px_q16 = q->disc.centre2_y * (DROGUE_Q16_ONE / 2) - random_q16(4);
        }
        q->expected.disc[i].b_px_q16 -= (drogue_q16)random_below((uint32_t)q->expected.disc[i].b_px_q16);
    }
    draw(q, kind, width, height);
}

/* Two dark rows at the upper border, before anything else: the line buffers hold what they were born with. */
static void first_call(bench *b)
{
    int32_t dark[DROGUE_HLS_INNER_WORDS];
    question q;
    memset(&q, 0, sizeof q);
    q.disc = drogue_mask_of_size(DROGUE_HLS_WIDTH, DROGUE_HLS_HEIGHT);
    q.disc.centre2_y = 0;
    expect_middle(&q);
    draw(&q, FLAT, DROGUE_HLS_WIDTH, DROGUE_HLS_HEIGHT);
    memset(drawn, 20, sizeof drawn);
    memset(drawn + 2 * DROGUE_HLS_WIDTH, 200, sizeof drawn - 2 * DROGUE_HLS_WIDTH);
    compare(b, dark, &q);
    bench_word(b, "status of a part at the border", dark[DROGUE_HLS_D_STATUS], DROGUE_OK);
    b->cases++;
}

/* A pattern over the largest region, all of which is searched. */
static void largest_image(bench *b, pattern kind)
{
    const unsigned failed = b->failed;
    int32_t dark[DROGUE_HLS_INNER_WORDS];
    question q;
    memset(&q, 0, sizeof q);
    q.disc = drogue_mask_of_size(DROGUE_HLS_WIDTH, DROGUE_HLS_HEIGHT);
    q.disc.longest_px *= 3;
    expect_middle(&q);
    if (kind == DISC) { /* it fills as much as a drogue's inner part */
        q.disc.longest_px /= 3;
    }
    draw(&q, kind, DROGUE_HLS_WIDTH, DROGUE_HLS_HEIGHT);
    compare(b, dark, &q);
    b->cases++;
    printf("%-7s %dx%d/%s: status %d\n", b->failed == failed ? "ok" : "FAILED", DROGUE_HLS_WIDTH, DROGUE_HLS_HEIGHT,
           pattern_names[kind], dark[DROGUE_HLS_D_STATUS]);
}

/* 'images' of each pattern up to a side, then one of the largest size. */
static void random_images(bench *b, unsigned images, int32_t most_px)
{
    unsigned kind;
    unsigned i;
    most_px = most_px < DROGUE_HLS_WIDTH ? most_px : DROGUE_HLS_WIDTH;
    most_px = most_px < DROGUE_HLS_HEIGHT ? most_px : DROGUE_HLS_HEIGHT;
    for (kind = 0; kind < PATTERNS; kind++) {
        const unsigned failed = b->failed;
        question q;
        memset(&q, 0, sizeof q);
        for (i = 0; i < images; i++) {
            int32_t dark[DROGUE_HLS_INNER_WORDS];
            draw_random(&q, (pattern)kind, most_px);
            compare(b, dark, &q);
        }
        b->cases += images;
        printf("%-7s random/%s: %u images\n", b->failed == failed ? "ok" : "FAILED", pattern_names[kind], images);
        largest_image(b, (pattern)kind);
    }
}

/* Isolated dark squares, one short of filling the labels, then one too many. */
static void full_labels(bench *b)
{
    const int32_t a_row = DROGUE_HLS_WIDTH / 4;
    const int32_t rows = DROGUE_HLS_HEIGHT / 4;
    int32_t more;
    question q;
    memset(&q, 0, sizeof q);
    q.image.data = drawn;
    q.image.width_px = q.image.stride = DROGUE_HLS_WIDTH;
    q.image.height_px = 4 * rows;
    q.disc = drogue_mask_of_size(DROGUE_HLS_WIDTH, DROGUE_HLS_HEIGHT);
    q.disc.longest_px *= 3;
    expect_middle(&q);
    if (DROGUE_HLS_LABELS > a_row * rows) {
        printf("SKIPPED full labels: the region does not hold %d squares\n", DROGUE_HLS_LABELS);
        return;
    }
    for (more = 0; more < 2; more++) {
        const int32_t squares = DROGUE_HLS_LABELS - 1 + more;
        int32_t dark[DROGUE_HLS_INNER_WORDS];
        int32_t i;
        memset(drawn, 200, sizeof drawn);
        for (i = 0; i < 9 * squares; i++) {
            const int32_t at = i / 9;
            drawn[(at / a_row * 4 + i / 3 % 3) * DROGUE_HLS_WIDTH + at % a_row * 4 + i % 3] = 20;
        }
        compare(b, dark, &q);
        bench_word(b, "status of full labels", dark[DROGUE_HLS_D_STATUS],
                   more ? (int64_t)(DROGUE_E_LABELS_FULL | DROGUE_HLS_INNER_FULL) : DROGUE_OK);
        b->cases++;
    }
}

#endif
