/* SPDX-License-Identifier: Apache-2.0 */
/* The top and the passes that sum: histogram of a disc, darkness in a disc. */
#include "inner.h"

#include "components.h"
#include "disc_walk.h"
#include "operators.h"

enum { LEVELS = 256, COUNT_LAG = 3 };
enum { MIDDLE, LOWER, UPPER, RAMPS };

static uint32_t histogram[LEVELS + 1]; /* the last bin is that of pixels outside the disc */

/* Registers of the counting loop: a bin's count is read in one tick and written in the next. The two written last are
 * kept: a table of two cycles' latency serves a pixel a cycle, whatever the levels are. */
typedef struct counting {
    uint32_t level; /* of the pixel taken last, and whether it counts */
    uint32_t in_disc;
    uint32_t bin;     /* of the one before */
    uint32_t counted; /* of the one before that, and what the table held */
    uint32_t stored;
    uint32_t recent_bin[2];
    uint32_t recent_count[2];
} counting;

static void count_tick(counting *c)
{
    const uint32_t stored = histogram[c->bin];
    const uint32_t outside = drogue_hls_when(c->in_disc == 0);
    const uint32_t last = drogue_hls_when(c->counted == c->recent_bin[0]);
    const uint32_t before = drogue_hls_when(c->counted == c->recent_bin[1]) & ~last;
    const uint32_t count =
        ((c->recent_count[0] & last) | (c->recent_count[1] & before) | (c->stored & ~(last | before))) + 1;
    histogram[c->counted] = count;
    c->recent_bin[1] = c->recent_bin[0];
    c->recent_count[1] = c->recent_count[0];
    c->recent_bin[0] = c->counted;
    c->recent_count[0] = count;
    c->stored = stored;
    c->counted = c->bin;
    c->bin = (c->level & ~outside) | (LEVELS & outside);
}

/* Histogram of a disc: drogue_hls_disc_left() and centre. What reads the stream takes scalars: Bambu loses the stream
 * behind a pointer whose target the compiler would rather pass by value. */
static void take_histogram(const uint8_t *pixels, uint32_t at, int32_t width, int32_t height, int64_t disc_left,
                           int32_t centre2_x, int32_t centre2_y)
{
    drogue_hls_walk rows = drogue_hls_walk_from(disc_left, centre2_y);
    counting c = {0, 0, LEVELS, LEVELS, 0, {LEVELS, LEVELS}, {0, 0}};
    int32_t bin;
    int32_t x;
    int32_t y;
    for (bin = 0; bin <= LEVELS; bin++) {
        histogram[bin] = 0;
    }
    for (y = 0; y < height; y++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_HEIGHT
        drogue_hls_walk columns = drogue_hls_walk_from(rows.left, centre2_x);
        drogue_hls_walk_on(&rows);
        for (x = 0; x < width; x++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_WIDTH
#ifndef __BAMBU__
#pragma HLS pipeline II = 1
/* What the last two ticks wrote comes from registers. */
#pragma HLS dependence variable = histogram type = inter direction = RAW distance = 2 true
#endif
            const uint8_t level = drogue_hls_take_pixel(pixels, at++);
            count_tick(&c);
            c.level = level;
            c.in_disc = drogue_hls_in_disc(columns.left);
            drogue_hls_walk_on(&columns);
        }
    }
    for (x = 0; x < COUNT_LAG; x++) { /* the last pixels */
        count_tick(&c);
        c.in_disc = 0;
    }
}

/* Sums over a window by one ramp. Weights come without products: the sum of x d(x) over w columns is w times that of d
 * less the sum of all the partial sums of d; the same down the rows. */
typedef struct weighing {
    int32_t row; /* of this row */
    int32_t row_partial;
    int32_t total;
    int64_t x_partial;
    int64_t y_partial;
} weighing;

static int32_t totals[RAMPS];
static int64_t x_partials[RAMPS];
static int64_t y_partials[RAMPS];

static void add_row(weighing *w)
{
    w->total += w->row;
    w->x_partial += w->row_partial;
    w->y_partial += w->total;
    w->row = 0;
    w->row_partial = 0;
}

static void add_darkness(weighing *w, uint8_t pixel, int32_t full, int32_t range, uint32_t within)
{
    w->row += (int32_t)drogue_hls_darkness(pixel, full, range, within);
    w->row_partial += w->row;
}

static void keep(int ramp, const weighing *w)
{
    totals[ramp] = w->total;
    x_partials[ramp] = w->x_partial;
    y_partials[ramp] = w->y_partial;
}

/* Darkness in a window about the part, by the three ramps. */
static void take_darkness(const uint8_t *pixels, uint32_t at, int32_t width, int32_t height, int64_t disc_left,
                          int32_t centre2_x, int32_t centre2_y, int32_t full, int32_t range, int32_t step)
{
    drogue_hls_walk rows = drogue_hls_walk_from(disc_left, centre2_y);
    weighing middle = {0, 0, 0, 0, 0};
    weighing lower = {0, 0, 0, 0, 0};
    weighing upper = {0, 0, 0, 0, 0};
    int32_t x;
    int32_t y;
    for (y = 0; y < height; y++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_HEIGHT
        drogue_hls_walk columns = drogue_hls_walk_from(rows.left, centre2_x);
        drogue_hls_walk_on(&rows);
        for (x = 0; x < width; x++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_WIDTH
#ifndef __BAMBU__
#pragma HLS pipeline II = 1
#endif
            const uint8_t pixel = drogue_hls_take_pixel(pixels, at++);
            const uint32_t within = drogue_hls_in_disc(columns.left);
            drogue_hls_walk_on(&columns);
            add_darkness(&middle, pixel, full, range, within);
            add_darkness(&lower, pixel, full - step, range, within);
            add_darkness(&upper, pixel, full + step, range, within);
        }
        add_row(&middle);
        add_row(&lower);
        add_row(&upper);
    }
    keep(MIDDLE, &middle);
    keep(LOWER, &lower);
    keep(UPPER, &upper);
}

/* Of numbers not negative. */
static int64_t times(int32_t a, int32_t b) { return (int64_t)((uint64_t)(uint32_t)a * (uint32_t)b); }

/* The part's place by one of the ramps. */
static drogue_inner_part place(const drogue_inner_part *part, int k, int32_t width, int32_t height,
                               const drogue_inner_ramp *ramp)
{
    drogue_inner_part placed = *part;
    drogue_inner_sums sums;
    sums.sum = totals[k];
    sums.x = times(width, totals[k]) - x_partials[k];
    sums.y = times(height, totals[k]) - y_partials[k];
    drogue_inner_place(&placed, &sums, ramp);
    return placed;
}

/* The last two passes: weigh the part, then about the place found, with the three ramps in one pass; by the lower and
 * the upper one the part has a spread. */
static void weigh(drogue_inner_part *part, const uint8_t *pixels, uint32_t at, int32_t width, int32_t height,
                  drogue_q16 a_px_q16)
{
    enum { PASSES = 2, STEPS = PASSES + RAMPS - 1 };
    drogue_inner_part lower = *part;
    drogue_inner_part upper = *part;
    drogue_mask window;
    drogue_inner_ramp ramp;
    int step;
    drogue_inner_ramp_of(&ramp, part, histogram);
    for (step = 0; step < STEPS; step++) {
        if (step < PASSES) {
            drogue_inner_window(&window, part, a_px_q16, DROGUE_INNER_NARROW);
            take_darkness(pixels, at, width, height, drogue_hls_disc_left(&window), window.centre2_x, window.centre2_y,
                          ramp.full, ramp.range, drogue_inner_ramp_step(&ramp));
            at += (uint32_t)(width * height);
        }
        lower = upper;
        upper = place(part, step < PASSES ? MIDDLE : step - PASSES + LOWER, width, height, &ramp);
        if (step < PASSES) {
            *part = upper;
        }
    }
    part->spread_px_q16 = drogue_inner_distance(&lower, upper.x_px_q16, upper.y_px_q16);
}

/* All five passes; without a part the last three are taken all the same, for nothing. Each kind of pass is called in one
 * place: one piece of hardware. */
static uint32_t find(drogue_inner_part *out, uint32_t *which, const uint8_t *pixels, int32_t width, int32_t height,
                     const drogue_mask *disc, const drogue_inner_expected *expected)
{
    const uint32_t frame = (uint32_t)(width * height);
    drogue_mask window = *disc;
    drogue_inner_part part = {0, 0, 0, 0, 0, 0};
    drogue_status status = DROGUE_OK;
    drogue_q16 a_px_q16 = 0;
    uint32_t full = 0;
    uint32_t at = 0;
    int round;
    for (round = 0; round < 2; round++) { /* threshold of the disc, then of a window about what is dark in it */
        const int64_t left = drogue_hls_disc_left(&window);
        take_histogram(pixels, at, width, height, left, window.centre2_x, window.centre2_y);
        part.threshold = drogue_otsu(histogram);
        at += frame;
        if (round == 0) {
            *out = part;
            drogue_hls_take_components(pixels, at, width, height, left, window.centre2_x, window.centre2_y,
                                       part.threshold, &full);
            at += frame;
            status = drogue_hls_choose_components(&part, which, expected);
            a_px_q16 = expected->disc[*which].a_px_q16;
            drogue_inner_window(&window, &part, a_px_q16, DROGUE_INNER_WIDE);
        }
    }
    weigh(&part, pixels, at, width, height, a_px_q16);
    if (full != 0) {
        *which = 0;
        return DROGUE_E_LABELS_FULL | DROGUE_HLS_INNER_FULL;
    }
    if (status == DROGUE_OK) {
        *out = part;
    }
    return (uint32_t)status;
}

static drogue_status check(int32_t width, int32_t height, const drogue_mask *disc, uint32_t count)
{
    if (width < 1 || width > DROGUE_MAX_SIDE || height < 1 || height > DROGUE_MAX_SIDE || !drogue_mask_valid(disc) ||
        count > DROGUE_HLS_DISCS) {
        return DROGUE_E_ARGUMENT;
    }
    return width > DROGUE_HLS_WIDTH || height > DROGUE_HLS_HEIGHT ? DROGUE_E_WORKSPACE : DROGUE_OK;
}

void drogue_hls_inner(const uint8_t pixels[DROGUE_HLS_INNER_PASSES * DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT],
                      const int32_t expected[DROGUE_HLS_DISCS * DROGUE_HLS_ELLIPSE_WORDS],
                      int32_t dark[DROGUE_HLS_INNER_WORDS], int32_t width_px, int32_t height_px, int32_t centre2_x,
                      int32_t centre2_y, int32_t longest_px, uint32_t min_area, uint32_t count)
{
#ifdef __BAMBU__
#pragma HLS interface port = pixels mode = fifo
#else
#pragma HLS interface port = pixels mode = axis
#pragma HLS interface port = expected mode = s_axilite
#pragma HLS interface port = dark mode = s_axilite
#pragma HLS interface port = width_px mode = s_axilite
#pragma HLS interface port = height_px mode = s_axilite
#pragma HLS interface port = centre2_x mode = s_axilite
#pragma HLS interface port = centre2_y mode = s_axilite
#pragma HLS interface port = longest_px mode = s_axilite
#pragma HLS interface port = min_area mode = s_axilite
#pragma HLS interface port = count mode = s_axilite
#pragma HLS interface port = return mode = s_axilite
#endif
    drogue_inner_part part = {0, 0, 0, 0, 0, 0};
    drogue_inner_expected sought;
    const drogue_mask disc = {centre2_x, centre2_y, longest_px};
    uint32_t which = 0;
    uint32_t status;
    int32_t k;
    for (k = 0; k < DROGUE_HLS_DISCS; k++) {
        sought.disc[k] = drogue_hls_unpack_ellipse(&expected[k * DROGUE_HLS_ELLIPSE_WORDS]);
    }
    sought.count = count;
    sought.min_area_px = min_area;
    status = (uint32_t)check(width_px, height_px, &disc, count);
    if (status == DROGUE_OK) {
        status = find(&part, &which, pixels, width_px, height_px, &disc, &sought);
    }
    dark[DROGUE_HLS_D_STATUS] = (int32_t)status;
    dark[DROGUE_HLS_D_X] = part.x_px_q16;
    dark[DROGUE_HLS_D_Y] = part.y_px_q16;
    dark[DROGUE_HLS_D_AREA] = (int32_t)part.area_px;
    dark[DROGUE_HLS_D_SPREAD] = part.spread_px_q16;
    dark[DROGUE_HLS_D_THRESHOLD] = part.threshold;
    dark[DROGUE_HLS_D_CONTRAST] = part.contrast;
    dark[DROGUE_HLS_D_WHICH] = (int32_t)which;
}
