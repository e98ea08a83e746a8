/* SPDX-License-Identifier: Apache-2.0 */
/* Row kernels on lanes: smoothing and gradient. */
#include "rows_lanes.h"

#if !DROGUE_ROWS_PLAIN

#include <string.h>

drogue_slope *drogue_rows_points(const drogue_frontend *f)
{
    return (drogue_slope *)(void *)((lanes_record *)(void *)f->workspace->slope_rows + 2 * drogue_row_half(f));
}

void drogue_rows_begin(const drogue_frontend *f)
{
    const size_t half = (size_t)drogue_row_half(f);
    memset(f->workspace->raw_rows, 0, 5 * (2 * half + 4));
    memset(f->workspace->smooth_rows, 0, 3 * (half + 2) * sizeof(uint32_t));
    memset(f->workspace->magnitude_rows, 0, 4 * (half + 2) * sizeof(uint32_t));
}

/* Word of a place in a row: of the places before its middle, and of those as far from its end. */
static inline int32_t fold(int32_t place, int32_t half) { return place < half ? place : 2 * half - 1 - place; }

/* From the word that is farthest from the row's middle to the nearest. */
drogue_stretch drogue_rows_stretch(const drogue_frontend *f, const drogue_columns *columns)
{
    const int32_t half = drogue_row_half(f);
    const int32_t left = drogue_row_left(f);
    drogue_stretch s = {UINT16_MAX, 0};
    int32_t k;
    for (k = 0; k < 2; k++) {
        const int32_t begin = columns->begin[k] + left;
        const int32_t last = columns->end[k] + left - 1;
        if (begin <= last) {
            const int32_t near = begin >= half ? begin : last < half ? last : half;
            const int32_t a = fold(begin, half);
            const int32_t b = fold(last, half);
            const int32_t far = a < b ? a : b;
            s.begin = (uint16_t)(far < s.begin ? far : s.begin);
            s.end = (uint16_t)(fold(near, half) < s.end ? s.end : fold(near, half) + 1);
        }
    }
    return s;
}

/* Four words of a row from four pixels of the left half, and four of the right half as far from the row's end. */
static inline void pair_halves(uint32_t out[4], uint32_t even_left, uint32_t odd_left, uint32_t even_right,
                               uint32_t odd_right)
{
    out[0] =
        odd_right ^ ((odd_right ^ even_left) & 0xFFFFu); /* with the other's lower lane; a mask less than by 'or' */
    out[1] = even_right ^ ((even_right ^ odd_left) & 0xFFFFu);
    out[2] = (even_left >> 16) | (odd_right << 16);
    out[3] = (odd_left >> 16) | (even_right << 16);
}

/* What lies beside a row's pixels, and where its halves meet. */
static void set_borders(const drogue_frontend *f, uint32_t *row, uint32_t left, uint32_t right)
{
    const int32_t half = drogue_row_half(f);
    uint32_t *before = row + drogue_row_left(f) - 1;
    uint32_t *after = row + fold(drogue_row_left(f) + f->width_px, half);
    *before = (*before & 0xFFFF0000u) | left;
    *after = drogue_lanes_lower(*after, right);
    row[half] = (row[half - 1] << 16) | (row[half - 1] >> 16);
}

/* Smoothed row y is complete but for its border. */
static void replicate(const drogue_frontend *f, uint32_t *row)
{
    const int32_t left = drogue_row_left(f);
    const uint32_t first = row[left] & 0xFFFFu;
    set_borders(f, row, first, f->width_px == 1 ? first : row[fold(left + f->width_px - 1, drogue_row_half(f))] >> 16);
}

void drogue_rows_take_smoothed(const drogue_frontend *f, int32_t y, const uint8_t *pixels)
{
    const int32_t half = drogue_row_half(f);
    uint8_t *places = f->workspace->raw_rows;
    uint32_t *out = smooth_row(f, y);
    int32_t i;
    memcpy(places + drogue_row_left(f), pixels, (size_t)f->width_px);
    for (i = 0; i < half; i++) {
        out[i] = drogue_lanes_lower(places[i], places[2 * half - 1 - i]);
    }
    replicate(f, out);
}

/* Column sums of four pixels, as even and odd lanes, with what rounds a sixteenth of them: of the fours [begin,
 * end). */
static void sum_columns(uint32_t *sums, const uint8_t *const rows[5], int32_t begin, int32_t end)
{
    const uint32_t *r0 = (const uint32_t *)(const void *)rows[0] + begin;
    const uint32_t *r1 = (const uint32_t *)(const void *)rows[1] + begin;
    const uint32_t *r2 = (const uint32_t *)(const void *)rows[2] + begin;
    const uint32_t *r3 = (const uint32_t *)(const void *)rows[3] + begin;
    const uint32_t *r4 = (const uint32_t *)(const void *)rows[4] + begin;
    uint32_t *out = sums + 2 * begin;
    const uint32_t *last = sums + 2 * end;
    for (; out < last; out += 2) {
        const uint32_t p0 = drogue_first_lowest(*r0++);
        const uint32_t p1 = drogue_first_lowest(*r1++);
        const uint32_t p2 = drogue_first_lowest(*r2++);
        const uint32_t p3 = drogue_first_lowest(*r3++);
        const uint32_t p4 = drogue_first_lowest(*r4++);
        const uint32_t sides = drogue_lanes_add_even(drogue_lanes_even(p1), p3);
        const uint32_t ends = drogue_lanes_add_even(drogue_lanes_add_even(DROGUE_LANES(8u), p0), p4);
        const uint32_t even = drogue_binomial5(ends, sides, drogue_lanes_even(p2), 0, 0);
        /* The upper three bytes as one number; what the byte between the two lanes adds to it is known. */
        const uint32_t odd =
            drogue_binomial5((DROGUE_LANES(8u) + (8u << 8)) + (p0 >> 8), p1 >> 8, p2 >> 8, p3 >> 8, p4 >> 8);
        out[0] = even;
        out[1] = odd - ((even >> 16) << 8);
    }
}

/* The binomial weights as sums of neighbours, four times over. */
typedef struct cascade {
    uint32_t sum[4];
} cascade;

static inline uint32_t cascade_step(cascade *c, uint32_t next)
{
    const uint32_t a = next + c->sum[0];
    const uint32_t b = a + c->sum[1];
    const uint32_t d = b + c->sum[2];
    const uint32_t all = d + c->sum[3];
    c->sum[0] = next;
    c->sum[1] = a;
    c->sum[2] = b;
    c->sum[3] = d;
    return drogue_lanes_odd(all);
}

void drogue_rows_smooth(const drogue_frontend *f, int32_t y, drogue_stretch stretch)
{
    const int32_t half = drogue_row_half(f);
    const int32_t begin = stretch.begin / 4;
    const int32_t end = (stretch.end + 3) / 4;
    uint32_t *sums = (uint32_t *)(void *)record_row(f, y - 1); /* the place of the records that come next */
    const uint32_t *const first = sums + 2 * begin;
    const uint32_t *const last = sums + 2 * end;
    const uint32_t *lower = first;
    const uint32_t *upper = sums + half - 2 * begin;
    uint32_t *out = smooth_row(f, y) + 4 * begin - 4;
    const uint8_t *rows[5];
    cascade c = {{0, 0, 0, 0}};
    int32_t k;
    for (k = 0; k < 5; k++) {
        rows[k] = drogue_raw_row(f, drogue_reflect_101(y + k - 2, f->height_px));
    }
    sum_columns(sums, rows, begin, end + 1);
    sum_columns(sums, rows, half / 2 - end, half / 2 - begin + 1);
    for (; lower <= last; lower += 2, upper -= 2, out += 4) { /* the first four only fill the cascade */
        uint32_t next[4];
        pair_halves(next, lower[0], lower[1], upper[0], upper[1]);
        next[0] = cascade_step(&c, next[0]);
        next[1] = cascade_step(&c, next[1]);
        next[2] = cascade_step(&c, next[2]);
        next[3] = cascade_step(&c, next[3]);
        if (lower != first) {
            out[0] = next[0];
            out[1] = next[1];
            out[2] = next[2];
            out[3] = next[3];
        }
    }
    replicate(f, smooth_row(f, y));
}

/* A column of three pixels: smoothed across the horizontal derivative, the step of the vertical one, and the sum of
 * that and the step before. */
typedef struct column {
    uint32_t sum;
    uint32_t step;
    uint32_t steps;
} column;

static inline column column_of(uint32_t step_before, uint32_t above, uint32_t middle, uint32_t below)
{
    column c;
    c.sum = drogue_sobel_121(above, middle, below);
    c.step = signed_difference(below, above);
    c.steps = signed_sum(step_before, c.step);
    return c;
}

/* Magnitude of the pixels between two columns; 'right' comes after the one on them. Those that matter are recorded. */
static inline lanes_record *gradient_word(lanes_record *next, uint32_t *magnitude, int32_t word, uint32_t left_sum,
                                          uint32_t left_steps, const column *right, uint32_t low)
{
    const uint32_t dx = signed_difference(right->sum, left_sum);
    const uint32_t dy = signed_sum(left_steps, right->steps);
    const uint32_t m = l1_magnitude(dx, dy);
    magnitude[word] = m;
    if (excess_of(m, low) != 0) {
        next->word = word;
        next->dx = dx;
        next->dy = dy;
        next++;
    }
    return next;
}

void drogue_rows_gradient(drogue_frontend *f, int32_t y, drogue_stretch stretch)
{
    const uint32_t low =
        DROGUE_LANES((uint32_t)(f->config.canny_low < DROGUE_L1_MAX ? f->config.canny_low : DROGUE_L1_MAX));
    const int32_t below = y + 1 < f->height_px ? y + 1 : y;
    const int32_t begin = stretch.begin / 2 * 2;
    const uint32_t *t = smooth_row(f, y > 0 ? y - 1 : 0) + begin + 1;
    const uint32_t *c = smooth_row(f, y) + begin + 1;
    const uint32_t *b = smooth_row(f, below) + begin + 1;
    uint32_t *const magnitude = magnitude_row(f, y);
    int32_t word;
    lanes_record *const first = record_row(f, y);
    lanes_record *next = first;
    column left = column_of(0, t[-2], c[-2], b[-2]);
    column middle = column_of(left.step, t[-1], c[-1], b[-1]);
    for (word = begin; word < stretch.end; word += 2, t += 2, c += 2, b += 2) {
        column right = column_of(middle.step, t[0], c[0], b[0]);
        next = gradient_word(next, magnitude, word, left.sum, middle.steps, &right, low);
        left = column_of(right.step, t[1], c[1], b[1]);
        next = gradient_word(next, magnitude, word + 1, middle.sum, right.steps, &left, low);
        middle = left;
        left = right;
    }
    set_borders(f, magnitude, 0, 0);
    f->slope_count[y & 1] = (uint32_t)(next - first);
}

#endif
