/* SPDX-License-Identifier: Apache-2.0 */
/* Row kernels on words of two 16-bit lanes: the lower lane has a pixel of the left half of the row, the upper one the
 * pixel as far into the right half, so that neighbours are in neighbouring words. */
#include "rows.h"

#if !DROGUE_ROWS_PLAIN

#include <string.h>

/* Signed lanes: derivatives and what they are made of, in [-1023, 1023]. Without instructions for them a word is the sum of
 * both, so that plain sums and differences serve. */
#if DROGUE_LANES_INSTRUCTIONS
static inline uint32_t signed_sum(uint32_t a, uint32_t b)
{
    return (uint32_t)__builtin_arm_sadd16((int32_t)a, (int32_t)b);
}
static inline uint32_t signed_difference(uint32_t a, uint32_t b)
{
    return (uint32_t)__builtin_arm_ssub16((int32_t)a, (int32_t)b);
}
static inline uint32_t signed_magnitude(uint32_t v)
{
    const uint32_t negated = signed_difference(0, v); /* says in flags where it is not negative */
    return (uint32_t)__builtin_arm_sel(negated, v);
}
static inline uint32_t l1_magnitude(uint32_t dx, uint32_t dy) { return signed_magnitude(dx) + signed_magnitude(dy); }
static inline int16_t signed_lane(uint32_t lanes, uint32_t lane) { return (int16_t)(lanes >> lane); }
/* What a lane has above another. */
static inline uint32_t excess_of(uint32_t v, uint32_t low) { return (uint32_t)__builtin_arm_uqsub16(v, low); }
#else
static inline uint32_t signed_sum(uint32_t a, uint32_t b) { return a + b; }
static inline uint32_t signed_difference(uint32_t a, uint32_t b) { return a - b; }
static inline uint32_t biased(uint32_t v) { return v + DROGUE_LANES(DROGUE_SOBEL_BIAS); }
static inline uint32_t l1_magnitude(uint32_t dx, uint32_t dy)
{
    return drogue_sobel_l1(biased(dx), drogue_sobel_mask(biased(dx)), biased(dy), drogue_sobel_mask(biased(dy)));
}
static inline int16_t signed_lane(uint32_t lanes, uint32_t lane) { return drogue_sobel_unbias(biased(lanes) >> lane); }
/* Not 0 where a lane exceeds another; both in [0, 2047]. */
static inline uint32_t excess_of(uint32_t v, uint32_t low)
{
    return (v + (DROGUE_LANES(0x7FFFu) - low)) & DROGUE_LANES(0x8000u);
}
#endif

/* Two pixels of which at least one may exceed the low threshold. */
typedef struct lanes_record {
    uint32_t place; /* of their magnitudes; an index would cost the gradient an instruction a word */
    uint32_t dx;    /* derivatives in signed lanes */
    uint32_t dy;
} lanes_record;

static uint32_t *smooth_row(const drogue_frontend *f, int32_t y)
{
    uint32_t *rows = (uint32_t *)(void *)f->workspace->smooth_rows;
    return rows + (y % 3) * (drogue_row_half(f) + 2) + 1;
}

static uint32_t *magnitude_row(const drogue_frontend *f, int32_t y)
{
    uint32_t *rows = (uint32_t *)(void *)f->workspace->magnitude_rows;
    const int32_t row = y >= 0 && y < f->height_px ? y % 3 : 3; /* the fourth stays 0 */
    return rows + row * (drogue_row_half(f) + 2) + 1;
}

static lanes_record *record_row(const drogue_frontend *f, int32_t y)
{
    return (lanes_record *)(void *)f->workspace->slope_rows + (y & 1) * drogue_row_half(f);
}

drogue_slope *drogue_rows_points(const drogue_frontend *f)
{
    return (drogue_slope *)(void *)((lanes_record *)(void *)f->workspace->slope_rows + 2 * drogue_row_half(f));
}

void drogue_rows_begin(const drogue_frontend *f)
{
    const size_t half = (size_t)drogue_row_half(f);
    memset(f->workspace->raw_rows, 0, 5 * (2 * half + 4));
    memset(f->workspace->smooth_rows, 0, 3 * (half + 2) * sizeof(uint32_t));
    memset(magnitude_row(f, -1) - 1, 0, (half + 2) * sizeof(uint32_t));
}

/* Four words of a row from four pixels of each half. */
static void pair_halves(uint32_t out[4], uint32_t even_left, uint32_t odd_left, uint32_t even_right, uint32_t odd_right)
{
    out[0] = drogue_lanes_lower(even_left, even_right);
    out[1] = drogue_lanes_lower(odd_left, odd_right);
    out[2] = drogue_lanes_upper(even_left, even_right);
    out[3] = drogue_lanes_upper(odd_left, odd_right);
}

/* What lies beside the halves: the border replicated or 0, and at the seam the other half's. */
static void set_seams(uint32_t *row, int32_t half, uint32_t left_border, uint32_t right_border)
{
    row[-1] = drogue_lanes_lower(left_border, row[half - 1]);
    row[half] = (row[0] >> 16) | (right_border << 16);
}

/* Write pixel x in [0, 2 * half). */
static void set_pixel(uint32_t *row, int32_t half, int32_t x, uint32_t value)
{
    if (x < half) {
        row[x] = (row[x] & 0xFFFF0000u) | value;
    } else {
        row[x - half] = drogue_lanes_lower(row[x - half], value);
    }
}

/* Smoothed row y is complete but for its border. */
static void replicate(const drogue_frontend *f, uint32_t *row)
{
    const int32_t half = drogue_row_half(f);
    const int32_t last = f->width_px - 1;
    const uint32_t border = last < half ? row[last] & 0xFFFFu : row[last - half] >> 16;
    if (f->width_px < 2 * half) {
        set_pixel(row, half, f->width_px, border);
    }
    set_seams(row, half, row[0], border);
}

void drogue_rows_take_smoothed(const drogue_frontend *f, int32_t y, const uint8_t *pixels)
{
    const int32_t half = drogue_row_half(f);
    const uint32_t *left = (const uint32_t *)(void *)f->workspace->raw_rows;
    uint32_t *out = smooth_row(f, y);
    int32_t i;
    memcpy(f->workspace->raw_rows, pixels, (size_t)f->width_px);
    for (i = 0; i < half; i += 4) {
        const uint32_t a = drogue_first_lowest(left[i / 4]);
        const uint32_t b = drogue_first_lowest(left[(i + half) / 4]);
        pair_halves(out + i, drogue_lanes_even(a), drogue_lanes_odd(a), drogue_lanes_even(b), drogue_lanes_odd(b));
    }
    replicate(f, out);
}

/* Column sums of four pixels, as even and odd lanes, with what rounds a sixteenth of them: 'fours' pairs of words. */
static void sum_columns(uint32_t *out, const uint8_t *const rows[5], int32_t fours)
{
    const uint32_t *r0 = (const uint32_t *)(const void *)rows[0];
    const uint32_t *r1 = (const uint32_t *)(const void *)rows[1];
    const uint32_t *r2 = (const uint32_t *)(const void *)rows[2];
    const uint32_t *r3 = (const uint32_t *)(const void *)rows[3];
    const uint32_t *r4 = (const uint32_t *)(const void *)rows[4];
    const uint32_t *end = out + 2 * fours;
    for (; out < end; out += 2) {
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

void drogue_rows_smooth(const drogue_frontend *f, int32_t y)
{
    const int32_t half = drogue_row_half(f);
    uint32_t *column = (uint32_t *)(void *)record_row(f, y - 1); /* the place of the records that come next */
    uint32_t *out = smooth_row(f, y);
    const uint32_t *left = column;
    const uint32_t *right = column + half / 2;
    const uint32_t *end = right;
    const uint8_t *rows[5];
    cascade c = {{0, 0, 0, 0}};
    int32_t k;
    for (k = 0; k < 5; k++) {
        rows[k] = drogue_raw_row(f, drogue_reflect_101(y + k - 2, f->height_px)) - 2;
    }
    sum_columns(column, rows, half / 2 + 1);
    for (out -= 4; left <= end; left += 2, right += 2, out += 4) { /* the first four only fill the cascade */
        const uint32_t even_left = left[0];
        const uint32_t odd_left = left[1];
        const uint32_t even_right = right[0];
        const uint32_t odd_right = right[1];
        const uint32_t zeroth = cascade_step(&c, drogue_lanes_lower(even_left, even_right));
        const uint32_t first = cascade_step(&c, drogue_lanes_lower(odd_left, odd_right));
        const uint32_t second = cascade_step(&c, drogue_lanes_upper(even_left, even_right));
        const uint32_t third = cascade_step(&c, drogue_lanes_upper(odd_left, odd_right));
        if (left != column) {
            out[0] = zeroth;
            out[1] = first;
            out[2] = second;
            out[3] = third;
        }
    }
    replicate(f, smooth_row(f, y));
}

/* A column of three pixels: smoothed across the horizontal derivative, the step of the vertical one, and the sum of that
 * and the step before. */
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

/* Place of a word in memory; the difference of two is the bytes between them. */
static inline uint32_t place_of(const uint32_t *word) { return (uint32_t)(uintptr_t)word; }

/* Magnitude of the pixels between two columns; 'right' comes after the one on them. Those that matter are recorded. */
static inline lanes_record *gradient_word(lanes_record *next, uint32_t *magnitude, uint32_t left_sum,
                                          uint32_t left_steps, const column *right, uint32_t low)
{
    const uint32_t dx = signed_difference(right->sum, left_sum);
    const uint32_t dy = signed_sum(left_steps, right->steps);
    const uint32_t m = l1_magnitude(dx, dy);
    *magnitude = m;
    if (excess_of(m, low) != 0) {
        next->place = place_of(magnitude);
        next->dx = dx;
        next->dy = dy;
        next++;
    }
    return next;
}

void drogue_rows_gradient(drogue_frontend *f, int32_t y)
{
    const int32_t half = drogue_row_half(f);
    const uint32_t low = DROGUE_LANES((uint32_t)(f->config.canny_low < 2040 ? f->config.canny_low : 2040));
    const int32_t below = y + 1 < f->height_px ? y + 1 : y;
    const uint32_t *t = smooth_row(f, y > 0 ? y - 1 : 0) + 1;
    const uint32_t *c = smooth_row(f, y) + 1;
    const uint32_t *b = smooth_row(f, below) + 1;
    uint32_t *const magnitude = magnitude_row(f, y);
    uint32_t *const end = magnitude + half;
    uint32_t *at;
    lanes_record *const first = record_row(f, y);
    lanes_record *next = first;
    column left = column_of(0, t[-2], c[-2], b[-2]);
    column middle = column_of(left.step, t[-1], c[-1], b[-1]);
    for (at = magnitude; at < end; at += 2, t += 2, c += 2, b += 2) {
        column right = column_of(middle.step, t[0], c[0], b[0]);
        next = gradient_word(next, at, left.sum, middle.steps, &right, low);
        left = column_of(right.step, t[1], c[1], b[1]);
        next = gradient_word(next, at + 1, middle.sum, right.steps, &left, low);
        middle = left;
        left = right;
    }
    if (f->width_px < 2 * half) {
        set_pixel(magnitude, half, f->width_px, 0);
    }
    set_seams(magnitude, half, 0, 0);
    f->slope_count[y & 1] = (uint32_t)(next - first);
}

/* A lane of a word; 'lane' is 0 or 16. */
static inline int32_t lane_of(uint32_t word, uint32_t lane) { return (int32_t)((word >> lane) & 0xFFFFu); }

/* The magnitudes of a row and those about it. */
typedef struct magnitudes {
    const uint32_t *row;
    ptrdiff_t above; /* from a word to the one above it */
    ptrdiff_t below;
} magnitudes;

/* Neighbours of a pixel across the edge, 'at' its word. */
static inline void neighbours_of(int32_t *before, int32_t *after, const magnitudes *m, const uint32_t *at,
                                 drogue_sector sector, uint32_t lane)
{
    const uint32_t *a = at + m->above;
    const uint32_t *b = at + m->below;
    if (sector == DROGUE_SECTOR_HORIZONTAL) {
        a = at - 1;
        b = at + 1;
    } else if (sector == DROGUE_SECTOR_DIAGONAL) {
        a--;
        b++;
    } else if (sector == DROGUE_SECTOR_ANTIDIAGONAL) {
        a++;
        b--;
    }
    *before = lane_of(*a, lane);
    *after = lane_of(*b, lane);
}

/* List the maxima in a lane, with their sector for an offset; 'begin' is the lane's first column. Returns the end. */
static inline drogue_slope *maxima_of(drogue_slope *next, const lanes_record *r, const lanes_record *end,
                                      const magnitudes *rows, int32_t low, uint32_t begin, uint32_t lane)
{
    const uint32_t place = place_of(rows->row);
    for (; r < end; r++) {
        const uint32_t bytes = r->place - place;
        const uint32_t *at = rows->row + bytes / 4;
        const int32_t m = lane_of(*at, lane);
        drogue_sector sector;
        int32_t before;
        int32_t after;
        if (m <= low) {
            continue;
        }
        next->gx = signed_lane(r->dx, lane);
        next->gy = signed_lane(r->dy, lane);
        sector = drogue_canny_sector(next->gx, next->gy);
        neighbours_of(&before, &after, rows, at, sector, lane);
        if (drogue_canny_is_maximum(sector, before, m, after)) {
            next->x = (uint16_t)(begin + bytes / 4);
            next->dx_q5 = (int8_t)sector;
            next++;
        }
    }
    return next;
}

uint32_t drogue_rows_maxima(drogue_frontend *f, int32_t y, int32_t part)
{
    const drogue_ring_row ring = drogue_mask_ring_row(&f->config.ring, y);
    const uint32_t half = (uint32_t)drogue_row_half(f);
    const uint32_t begin = part != 0 ? half : 0;
    const uint32_t lane = part != 0 ? 16 : 0;
    const int32_t low = f->config.canny_low;
    const lanes_record *first = record_row(f, y);
    const lanes_record *end = first + f->slope_count[y & 1];
    drogue_slope *points = drogue_rows_points(f);
    drogue_slope *last;
    drogue_slope *p;
    uint8_t *code = drogue_code_row(f, y);
    magnitudes rows;
    rows.row = magnitude_row(f, y);
    rows.above = magnitude_row(f, y - 1) - rows.row;
    rows.below = magnitude_row(f, y + 1) - rows.row;
    if (part == 0) {
        memset(code, 0, (size_t)f->width_px);
        last = maxima_of(points, first, end, &rows, low, 0, 0);
    } else {
        last = maxima_of(points, first, end, &rows, low, half, 16);
    }
    while (last > points && last[-1].x >= f->width_px) { /* beyond the last column */
        last--;
    }
    for (p = points; p < last; p++) {
        const uint32_t *at = rows.row + p->x - begin;
        const drogue_sector sector = (drogue_sector)p->dx_q5;
        const int32_t m = lane_of(*at, lane);
        uint32_t c = drogue_rows_code(f, m);
        if (drogue_rows_in_ring(f, &ring, p->x)) {
            int32_t before;
            int32_t after;
            neighbours_of(&before, &after, &rows, at, sector, lane);
            c |= drogue_rows_place(p, sector, before, m, after);
        }
        code[p->x] = (uint8_t)c;
    }
    return (uint32_t)(last - points);
}

#endif
