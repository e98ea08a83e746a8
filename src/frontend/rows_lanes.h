/* SPDX-License-Identifier: Apache-2.0 */
/* Inside rows_lanes.c and maxima_lanes.c: words of two 16-bit lanes. The lower lane has a pixel of the left half of the
 * row, the upper one the pixel as far from the row's end: neighbours are in neighbouring words, both sides of a ring in
 * the same. */
#ifndef DROGUE_ROWS_LANES_H
#define DROGUE_ROWS_LANES_H

#include "rows.h"

#if !DROGUE_ROWS_PLAIN

/* Signed lanes: derivatives and what they are made of, in [-1023, 1023]. Without instructions for them a word is the
 * sum of both, so that plain sums and differences serve. */
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
    int32_t word; /* where they are in their row */
    uint32_t dx;  /* derivatives in signed lanes */
    uint32_t dy;
} lanes_record;

static inline uint32_t *smooth_row(const drogue_frontend *f, int32_t y)
{
    uint32_t *rows = (uint32_t *)(void *)f->workspace->smooth_rows;
    return rows + (int32_t)((uint32_t)y % 3u) * (drogue_row_half(f) + 2) + 1;
}

static inline uint32_t *magnitude_row(const drogue_frontend *f, int32_t y)
{
    uint32_t *rows = (uint32_t *)(void *)f->workspace->magnitude_rows;
    return rows + (int32_t)((uint32_t)y % 3u) * (drogue_row_half(f) + 2) + 1; /* a fourth stays 0 */
}

static inline lanes_record *record_row(const drogue_frontend *f, int32_t y)
{
    return (lanes_record *)(void *)f->workspace->slope_rows + (y & 1) * drogue_row_half(f);
}

#endif
#endif
