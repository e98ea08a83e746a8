/* SPDX-License-Identifier: Apache-2.0 */
/* The block against the library, every word: on the vectors of stages disc, centroid and frame, on random images of odd
 * sizes, on patterns that merge or exceed the labels. */
#include <stdio.h>
#include <string.h>

#include "../../src/dark_pass.h"
#include "bench/bench.h"
#include "centroid.h"
#include "drogue/drogue.h"
#include "drogue/inner.h"
#include "operators.h"
#ifdef __BAMBU_SIM__
#include <mdpi/mdpi_user.h>
#endif

enum { MOST_PIXELS = DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT, GUARD = 0x5A5A5A5A, FRAME_SIDE = 512 };

static uint8_t stream[DROGUE_HLS_DARK_PASSES * MOST_PIXELS];
static uint8_t drawn[MOST_PIXELS];

static const char *const words[DROGUE_HLS_DARK_WORDS] = {"status", "x",         "y",        "area",
                                                         "spread", "threshold", "contrast", "which"};

/* What is asked, of both. */
typedef struct question {
    drogue_image image;
    drogue_mask disc;
    uint32_t min_area;
    drogue_ellipse expected[DROGUE_HLS_DISCS];
    uint32_t count;
} question;

static unsigned answers[DROGUE_STATUS_COUNT]; /* how many of each status */

/* The stream ends where the memory ends: a pixel too many is one outside. */
static const uint8_t *send(const question *q)
{
    const size_t width = (size_t)q->image.width_px;
    const size_t frame = width * (size_t)q->image.height_px;
    uint8_t *first = stream + sizeof stream - DROGUE_HLS_DARK_PASSES * frame;
    uint8_t *to = first;
    int32_t pass;
    int32_t y;
    for (pass = 0; pass < DROGUE_HLS_DARK_PASSES; pass++) {
        for (y = 0; y < q->image.height_px; y++, to += width) {
            memcpy(to, drogue_image_row(&q->image, y), width);
        }
    }
    return first;
}

static int fits(const question *q)
{
    return q->image.width_px >= 1 && q->image.width_px <= DROGUE_HLS_WIDTH && q->image.height_px >= 1 &&
           q->image.height_px <= DROGUE_HLS_HEIGHT;
}

static void ask_block(int32_t dark[DROGUE_HLS_DARK_WORDS], const question *q)
{
    static int32_t out[DROGUE_HLS_DARK_WORDS];
    int32_t expected[DROGUE_HLS_DISCS * DROGUE_HLS_ELLIPSE_WORDS];
    const uint8_t *pixels = fits(q) ? send(q) : stream;
    int k;
    for (k = 0; k < DROGUE_HLS_DISCS; k++) {
        int32_t *to = expected + k * DROGUE_HLS_ELLIPSE_WORDS;
        to[0] = q->expected[k].xc_px_q16;
        to[1] = q->expected[k].yc_px_q16;
        to[2] = q->expected[k].a_px_q16;
        to[3] = q->expected[k].b_px_q16;
        to[4] = q->expected[k].angle_rad_q16;
    }
    for (k = 0; k < DROGUE_HLS_DARK_WORDS; k++) {
        out[k] = GUARD; /* all are written */
    }
#ifdef __BAMBU_SIM__
    m_param_alloc(0, (size_t)(stream + sizeof stream - pixels));
    m_param_alloc(1, sizeof expected);
    m_param_alloc(2, sizeof out);
#endif
    drogue_hls_centroid(pixels, expected, out, q->image.width_px, q->image.height_px, q->disc.centre2_x,
                        q->disc.centre2_y, q->disc.longest_px, q->min_area, q->count);
    memcpy(dark, out, sizeof out);
}

static void ask_library(int32_t dark[DROGUE_HLS_DARK_WORDS], const question *q)
{
    static uint32_t memory[DROGUE_WORKSPACE_BYTES(DROGUE_HLS_WIDTH, 1, DROGUE_HLS_LABELS, 1) / 4 + 1];
    const drogue_capacity capacity = {DROGUE_HLS_WIDTH, 1, DROGUE_HLS_LABELS, 1};
    drogue_workspace workspace;
    drogue_dark_part part;
    uint32_t which = 0;
    drogue_status status = drogue_workspace_init(&workspace, memory, sizeof memory, &capacity);
    if (status == DROGUE_OK) {
        status =
            drogue_dark_disc_find(&part, &which, &workspace, &q->image, &q->disc, q->min_area, q->expected, q->count);
    } else {
        memset(&part, 0, sizeof part);
    }
    dark[DROGUE_HLS_D_STATUS] = (int32_t)(status | (status == DROGUE_E_LABELS_FULL ? DROGUE_HLS_DARK_FULL : 0));
    dark[DROGUE_HLS_D_X] = part.x_px_q16;
    dark[DROGUE_HLS_D_Y] = part.y_px_q16;
    dark[DROGUE_HLS_D_AREA] = (int32_t)part.area_px;
    dark[DROGUE_HLS_D_SPREAD] = part.spread_px_q16;
    dark[DROGUE_HLS_D_THRESHOLD] = part.threshold;
    dark[DROGUE_HLS_D_CONTRAST] = part.contrast;
    dark[DROGUE_HLS_D_WHICH] = (int32_t)which;
    answers[status]++;
}

static void compare(bench *b, int32_t dark[DROGUE_HLS_DARK_WORDS], const question *q)
{
    int32_t expected[DROGUE_HLS_DARK_WORDS];
    int k;
    ask_block(dark, q);
    ask_library(expected, q);
    for (k = 0; k < DROGUE_HLS_DARK_WORDS; k++) {
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
    q->expected[0] = circle(x, y, drogue_q16_div(q->disc.longest_px, 5));
    q->expected[1] = circle(x + DROGUE_Q16_ONE, y, drogue_q16_div(q->disc.longest_px, 8));
    q->count = 2;
}

static int take_case(question *q, bench *b, const conf_case *c)
{
    const int32_t *p = bench_words32(bench_input(c, "params"));
    memset(q, 0, sizeof *q);
    q->image = bench_image(c);
    q->disc.centre2_x = p[0];
    q->disc.centre2_y = p[1];
    q->disc.longest_px = p[2];
    q->min_area = (uint32_t)p[3];
    if (q->image.height_px > DROGUE_HLS_HEIGHT) {
        bench_skip(b, "higher than DROGUE_HLS_HEIGHT");
        return 0;
    }
    return 1;
}

/* The vectors' own words hold where the block has room for the region and its labels. */
static void check_disc(bench *b, const int32_t dark[DROGUE_HLS_DARK_WORDS], const conf_case *c)
{
    const int32_t *part = bench_words32(bench_expected(c, "part"));
    const uint32_t status = (uint32_t)dark[DROGUE_HLS_D_STATUS] & DROGUE_HLS_STATUS;
    if (status == DROGUE_E_WORKSPACE || status == DROGUE_E_LABELS_FULL) {
        return;
    }
    bench_word(b, "vector's status", status, part[0]);
    bench_word(b, "vector's threshold", dark[DROGUE_HLS_D_THRESHOLD], part[1]);
    bench_word(b, "vector's area", dark[DROGUE_HLS_D_AREA], part[2]);
    bench_word(b, "vector's x", dark[DROGUE_HLS_D_X], part[3]);
    bench_word(b, "vector's y", dark[DROGUE_HLS_D_Y], part[4]);
    bench_word(b, "vector's spread", dark[DROGUE_HLS_D_SPREAD], part[5]);
    bench_word(b, "vector's which", dark[DROGUE_HLS_D_WHICH], part[6]);
    bench_word(b, "vector's contrast", dark[DROGUE_HLS_D_CONTRAST], part[8]);
}

static void disc_vectors(bench *b)
{
    const conf_case *c;
    while ((c = bench_next(b, "disc")) != NULL) {
        const conf_array *discs = bench_input(c, "expected");
        int32_t dark[DROGUE_HLS_DARK_WORDS];
        question q;
        uint32_t i;
        if (!take_case(&q, b, c)) {
            continue;
        }
        q.count = (uint32_t)discs->count / 4;
        for (i = 0; i < q.count; i++) {
            const int32_t *w = bench_words32(discs) + 4 * i;
            q.expected[i] = circle(w[0], w[1], w[2]);
            q.expected[i].b_px_q16 = w[3];
        }
        compare(b, dark, &q);
        check_disc(b, dark, c);
    }
}

static void centroid_vectors(bench *b)
{
    const conf_case *c;
    while ((c = bench_next(b, "centroid")) != NULL) {
        int32_t dark[DROGUE_HLS_DARK_WORDS];
        question q;
        if (take_case(&q, b, c)) {
            expect_middle(&q);
            compare(b, dark, &q);
        }
    }
}

/* What drogue_measure() asks of the inner part's search, put together again from its result. */
static void question_of(question *q, const drogue_result *r, const drogue_camera *camera, const drogue_model *model)
{
    drogue_ellipse outline = r->ellipse;
    drogue_pose poses[2];
    outline.xc_px_q16 -= drogue_q16_from_int(r->region.x_px);
    outline.yc_px_q16 -= drogue_q16_from_int(r->region.y_px);
    q->disc = drogue_inner_disc(&outline);
    if (outline.b_px_q16 > 0 && model->inner_radius_m_q16 > 0 &&
        drogue_pose_from_ellipse(poses, &r->ideal, camera, model->rim_radius_m_q16) == DROGUE_OK) {
        q->count = drogue_inner_expect(q->expected, poses, camera, model, r->region.x_px, r->region.y_px);
    } else {
        q->disc = drogue_mask_of_size(q->image.width_px, q->image.height_px);
        expect_middle(q);
    }
}

/* Where the library's frame has an inner part it is the block's. */
static void check_frame(bench *b, const int32_t dark[DROGUE_HLS_DARK_WORDS], const conf_case *c,
                        const drogue_region *region)
{
    enum { HAS_INNER = 14, INNER_X, INNER_Y, INNER_AREA, INNER_THRESHOLD, INNER_SPREAD };
    const int32_t *frame = bench_words32(bench_expected(c, "frame"));
    if (frame[HAS_INNER] != 0) {
        bench_word(b, "frame's x", dark[DROGUE_HLS_D_X], frame[INNER_X] - drogue_q16_from_int(region->x_px));
        bench_word(b, "frame's y", dark[DROGUE_HLS_D_Y], frame[INNER_Y] - drogue_q16_from_int(region->y_px));
        bench_word(b, "frame's area", dark[DROGUE_HLS_D_AREA], frame[INNER_AREA]);
        bench_word(b, "frame's threshold", dark[DROGUE_HLS_D_THRESHOLD], frame[INNER_THRESHOLD]);
        bench_word(b, "frame's spread", dark[DROGUE_HLS_D_SPREAD], frame[INNER_SPREAD]);
    }
}

static void frame_vectors(bench *b)
{
    static uint32_t memory[DROGUE_WORKSPACE_BYTES(FRAME_SIDE, CONF_MAX_EDGES, CONF_MAX_LABELS, CONF_MAX_ARCS) / 4 + 1];
    const drogue_capacity capacity = {FRAME_SIDE, CONF_MAX_EDGES, CONF_MAX_LABELS, CONF_MAX_ARCS};
    const conf_case *c;
    while ((c = bench_next(b, "frame")) != NULL) {
        const drogue_camera camera = bench_camera(c);
        const drogue_model model = bench_model(c);
        const drogue_region region = bench_region(c);
        drogue_image image = bench_image(c);
        int32_t dark[DROGUE_HLS_DARK_WORDS];
        drogue_workspace workspace;
        drogue_config config;
        drogue_result result;
        question q;
        drogue_config_default(&config);
        if (!bench_check(b, "workspace",
                         drogue_workspace_init(&workspace, memory, sizeof memory, &capacity) == DROGUE_OK)) {
            return;
        }
        (void)drogue_measure(&result, &workspace, &config, &camera, &model, &image, &region);
        memset(&q, 0, sizeof q);
        q.image = image;
        if (result.region.width_px > 0) {
            q.image.data = drogue_image_row(&image, result.region.y_px) + result.region.x_px;
            q.image.width_px = result.region.width_px;
            q.image.height_px = result.region.height_px;
        }
        if (!fits(&q)) {
            bench_skip(b, "larger than DROGUE_HLS_WIDTH or _HEIGHT");
            continue;
        }
        q.min_area = config.min_dark_area_px;
        question_of(&q, &result, &camera, &model);
        compare(b, dark, &q);
        check_frame(b, dark, c, &result.region);
    }
}

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
    q->min_area = random_below(20);
    q->count = random_below(8) == 0 ? 0 : 1 + random_below(2);
    for (i = 0; i < DROGUE_HLS_DISCS; i++) {
        q->expected[i] = circle(random_q16(width), random_q16(height), DROGUE_Q16_ONE + random_q16(most_px));
        if (random_below(2) == 0) {
            q->expected[i].xc_px_q16 = q->disc.centre2_x * (DROGUE_Q16_ONE / 2) + random_q16(4);
            q->expected[i].yc_px_q16 = q->disc.centre2_y * (DROGUE_Q16_ONE / 2) - random_q16(4);
        }
        q->expected[i].b_px_q16 -= (drogue_q16)random_below((uint32_t)q->expected[i].b_px_q16);
    }
    draw(q, kind, width, height);
}

/* Two dark rows at the upper border, before anything else: the line buffers hold what they were born with. */
static void first_call(bench *b)
{
    int32_t dark[DROGUE_HLS_DARK_WORDS];
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
    int32_t dark[DROGUE_HLS_DARK_WORDS];
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
            int32_t dark[DROGUE_HLS_DARK_WORDS];
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
        int32_t dark[DROGUE_HLS_DARK_WORDS];
        int32_t i;
        memset(drawn, 200, sizeof drawn);
        for (i = 0; i < 9 * squares; i++) {
            const int32_t at = i / 9;
            drawn[(at / a_row * 4 + i / 3 % 3) * DROGUE_HLS_WIDTH + at % a_row * 4 + i % 3] = 20;
        }
        compare(b, dark, &q);
        bench_word(b, "status of full labels", dark[DROGUE_HLS_D_STATUS],
                   more ? (int64_t)(DROGUE_E_LABELS_FULL | DROGUE_HLS_DARK_FULL) : DROGUE_OK);
        b->cases++;
    }
}

/* Arguments out of range: refused, and no pixel taken. */
static void refusals(bench *b)
{
    int32_t dark[DROGUE_HLS_DARK_WORDS];
    question q;
    memset(&q, 0, sizeof q);
    draw_random(&q, DISC, 8);
    q.disc.longest_px = 0;
    compare(b, dark, &q);
    q.disc.longest_px = (1 << 20) + 1;
    compare(b, dark, &q);
    q.disc.longest_px = 8;
    q.disc.centre2_x = (1 << 15) + 1;
    compare(b, dark, &q);
    q.disc.centre2_x = 0;
    q.image.width_px = q.image.stride = 0;
    compare(b, dark, &q);
    q.image.width_px = q.image.stride = DROGUE_MAX_SIDE + 1;
    compare(b, dark, &q);
    q.image.width_px = q.image.stride = DROGUE_HLS_WIDTH + 1;
    compare(b, dark, &q);
    q.image.width_px = q.image.stride = 4;
    q.image.height_px = DROGUE_HLS_HEIGHT + 1; /* the library's line buffers do not mind */
    ask_block(dark, &q);
    bench_word(b, "status of too high a region", dark[DROGUE_HLS_D_STATUS], DROGUE_E_WORKSPACE);
    q.image.height_px = 4;
    q.count = DROGUE_HLS_DISCS + 1;
    ask_block(dark, &q);
    bench_word(b, "status of too many discs", dark[DROGUE_HLS_D_STATUS], DROGUE_E_ARGUMENT);
    b->cases += 8;
}

/* The test of a pixel against the disc gives the columns that the library computes by a root. */
static void disc_by_pixel(bench *b)
{
    enum { SIDE = 13 };
    drogue_mask disc;
    int differ = 0;
    for (disc.longest_px = 1; disc.longest_px <= 48; disc.longest_px++) {
        for (disc.centre2_x = -SIDE; disc.centre2_x <= 3 * SIDE; disc.centre2_x++) {
            for (disc.centre2_y = -1; disc.centre2_y <= 0; disc.centre2_y++) {
                int32_t y;
                for (y = 0; y <= 17; y++) {
                    const int64_t most_x9 = drogue_mask_disc_row(&disc, y);
                    int32_t first = 0;
                    int32_t last = -1;
                    const int any = drogue_disc_span(&first, &last, &disc, y, SIDE);
                    int32_t x;
                    for (x = 0; x < SIDE; x++) {
                        differ +=
                            (drogue_hls_in_disc(x, disc.centre2_x, most_x9) != 0) != (any && x >= first && x <= last);
                    }
                }
            }
        }
    }
    b->cases++;
    bench_word(b, "pixels in a disc by one test alone", differ, 0);
}

int main(void)
{
    bench b;
    bench_begin(&b, "centroid");
    first_call(&b);
    disc_vectors(&b);
    b.list = b.index = 0;
    centroid_vectors(&b);
    b.list = b.index = 0;
    frame_vectors(&b);
#ifdef __BAMBU_SIM__ /* few: each is simulated */
    largest_image(&b, DISC);
    largest_image(&b, CELLS);
    largest_image(&b, ARCHES);
#else
    random_images(&b, 400, 70);
    full_labels(&b);
    refusals(&b);
    disc_by_pixel(&b);
    printf("answers: ok %u, no part %u, labels full %u, refused %u\n", answers[DROGUE_OK],
           answers[DROGUE_E_NO_DARK_PART], answers[DROGUE_E_LABELS_FULL],
           answers[DROGUE_E_ARGUMENT] + answers[DROGUE_E_WORKSPACE]);
    bench_check(&b, "each answer is among them", answers[DROGUE_OK] > 500 && answers[DROGUE_E_NO_DARK_PART] > 50);
#endif
    return bench_end(&b);
}
