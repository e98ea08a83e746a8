/* SPDX-License-Identifier: Apache-2.0 */
/* What is done to every edge point near an ellipse, step by step: here so that loops over points take it in, those of
 * hardware (hls/outline/near.c) a step a turn. */
#ifndef DROGUE_BAND_H
#define DROGUE_BAND_H

#include "drogue/support.h"

/* a - b, saturated, with 32-bit operations alone. */
static inline int32_t away(int32_t a, int32_t b)
{
    const int32_t d = (int32_t)((uint32_t)a - (uint32_t)b);
    const int overflows = ((a ^ b) & (a ^ d)) < 0;
    return !overflows ? d : a < 0 ? INT32_MIN : INT32_MAX;
}

/* Offsets from the centre along the axes, in semi-axes. */
static inline void offsets(int64_t *u_q46, int64_t *v_q46, const drogue_ellipse_frame *frame, drogue_q16 x_px_q16,
                           drogue_q16 y_px_q16)
{
    const int32_t dx = away(x_px_q16, frame->xc_px_q16);
    const int32_t dy = away(y_px_q16, frame->yc_px_q16);
    *u_q46 = (int64_t)dx * frame->cos_over_a_q30 + (int64_t)dy * frame->sin_over_a_q30;
    *v_q46 = (int64_t)dy * frame->cos_over_b_q30 - (int64_t)dx * frame->sin_over_b_q30;
}

/* drogue_shr_round_s64() for what is done to every point; 1 <= n <= 63 */
static inline int64_t shr_round(int64_t v, int n) { return (v >> n) + ((v >> (n - 1)) & 1); }

/* u^2 + v^2 - 1, Q48 */
static inline int64_t conic_q48(int32_t u_q24, int32_t v_q24)
{
    return (int64_t)u_q24 * u_q24 + (int64_t)v_q24 * v_q24 - (INT64_C(1) << 48);
}

static inline int32_t clamp_q24(int64_t v_q46)
{
    const int64_t most = INT64_C(16) << 24;
    int64_t v = shr_round(v_q46, 22);
    return (int32_t)(v > most ? most : v < -most ? -most : v);
}

/* drogue_ellipse_frame_point() */
static inline void frame_point(int32_t *u_q24, int32_t *v_q24, const drogue_ellipse_frame *frame, drogue_q16 x_px_q16,
                               drogue_q16 y_px_q16)
{
    int64_t u_q46;
    int64_t v_q46;
    offsets(&u_q46, &v_q46, frame, x_px_q16, y_px_q16);
    *u_q24 = clamp_q24(u_q46);
    *v_q24 = clamp_q24(v_q46);
    DROGUE_NOTE("quality: u, Q24", *u_q24, 29);
    DROGUE_NOTE("quality: v, Q24", *v_q24, 29);
}

/* |u^2 + v^2 - 1| */
static inline drogue_q16 off_ellipse(int32_t u_q24, int32_t v_q24)
{
    const int64_t d_q48 = conic_q48(u_q24, v_q24);
    return drogue_sat_s32(shr_round(d_q48 < 0 ? -d_q48 : d_q48, 32));
}

/* drogue_ellipse_deviation() */
static inline drogue_q16 deviation(const drogue_ellipse_frame *frame, drogue_q16 x_px_q16, drogue_q16 y_px_q16)
{
    int32_t u_q24;
    int32_t v_q24;
    frame_point(&u_q24, &v_q24, frame, x_px_q16, y_px_q16);
    return off_ellipse(u_q24, v_q24);
}

/* Bits n and up of v, rounded as drogue_shr_round_s64() does, where the result fits 32 bits; 1 <= n <= 31. */
static inline int32_t low_shr_round(int64_t v, int n)
{
    return (int32_t)((uint32_t)((uint64_t)v >> n) + ((uint32_t)v >> (n - 1) & 1u));
}

/* Is an offset Q46 at least 1.5 semi-axes? By its upper word. */
static inline int far_off(int64_t v_q46)
{
    const uint32_t most_q14 = 3u << 13;
    return (uint32_t)((uint64_t)v_q46 >> 32) + most_q14 > 2 * most_q14;
}

static inline int32_t q24_of_q46(int64_t v_q46) { return low_shr_round(v_q46, 22); } /* where it is not far off */

/* F, and is it from inside half to outside 1.4 of the outline? */
static inline int32_t form_q24(int32_t u_q24, int32_t v_q24) { return low_shr_round(conic_q48(u_q24, v_q24), 24); }

static inline int far_form(int32_t f_q24) { return f_q24 > (1 << 24) || f_q24 < -(3 << 22); }

/* |F b| */
static inline int32_t form_px_q16(const drogue_ellipse_frame *frame, int32_t f_q24)
{
    const int32_t f_b_px_q16 = low_shr_round((int64_t)f_q24 * frame->b_px_q16, 24);
    return f_b_px_q16 < 0 ? -f_b_px_q16 : f_b_px_q16;
}

/* Half the gradient of F times b: between b / a and about 1 in length. */
static inline void normal_of(int32_t *nx_q14, int32_t *ny_q14, const drogue_ellipse_frame *frame, int32_t u_q24,
                             int32_t v_q24)
{
    *nx_q14 = low_shr_round((int64_t)u_q24 * frame->cos_ratio_q14 - (int64_t)v_q24 * frame->sin_q14, 24);
    *ny_q14 = low_shr_round((int64_t)u_q24 * frame->sin_ratio_q14 + (int64_t)v_q24 * frame->cos_q14, 24);
}

static inline int32_t square_sum(int32_t x, int32_t y) { return x * x + y * y; }

static inline uint32_t gradient_square(int16_t gx, int16_t gy) { return (uint32_t)(gx * gx) + (uint32_t)(gy * gy); }

/* Gradient along the normal. */
static inline int32_t along_of(int16_t gx, int16_t gy, int32_t nx_q14, int32_t ny_q14)
{
    return gx * nx_q14 + gy * ny_q14;
}

/* Can a point be within the band? The gradient of F is at most about 4 / b. */
static inline int in_reach(const drogue_band *band, int32_t f_b_px_q16)
{
    return f_b_px_q16 <= 4 * band->half_width_px_q16;
}

/* |F| / |grad F| <= t  <=>  (F b)^2 <= 4 t^2 n^2 */
static inline int within_band(const drogue_band *band, int32_t f_b_px_q16, int32_t n2_q28)
{
    const int32_t n2_q20 = (n2_q28 + 128) >> 8;
    DROGUE_NOTE("quality: squared normal, Q28", n2_q28, 30);
    return (int64_t)f_b_px_q16 * f_b_px_q16 <= shr_round((int64_t)band->width2_px2_q24 * n2_q20, 10);
}

/* Is a gradient, of which so much lies along the normal, near enough to it, either way? */
static inline int aligned(const drogue_band *band, int32_t along, uint32_t g2, int32_t n2_q28)
{
    DROGUE_NOTE("quality: gradient along normal", along, 26);
    DROGUE_NOTE("quality: squared gradient times squared cosine, Q10", band->cos2_q10 * g2, 32);
    return (along != 0) &
           ((uint64_t)((int64_t)along * along) * 1024 >= (uint64_t)(band->cos2_q10 * g2) * (uint32_t)n2_q28);
}

static inline drogue_polarity polarity_of(int32_t along)
{
    return along > 0 ? DROGUE_POLARITY_DARK : DROGUE_POLARITY_BRIGHT;
}

/* drogue_ellipse_band_holds() */
static inline int band_holds(drogue_band_point *out, const drogue_ellipse_frame *frame, const drogue_band *band,
                             drogue_q16 x_px_q16, drogue_q16 y_px_q16, int16_t gx, int16_t gy)
{
    int64_t u_q46;
    int64_t v_q46;
    int32_t f_b_px_q16;
    int32_t nx_q14;
    int32_t ny_q14;
    int32_t n2_q28;
    int32_t along;
    offsets(&u_q46, &v_q46, frame, x_px_q16, y_px_q16);
    if (far_off(u_q46) || far_off(v_q46)) {
        return 0;
    }
    out->u_q24 = q24_of_q46(u_q46);
    out->v_q24 = q24_of_q46(v_q46);
    out->f_q24 = form_q24(out->u_q24, out->v_q24);
    if (far_form(out->f_q24)) {
        return 0;
    }
    f_b_px_q16 = form_px_q16(frame, out->f_q24);
    if (!in_reach(band, f_b_px_q16)) {
        return 0;
    }
    normal_of(&nx_q14, &ny_q14, frame, out->u_q24, out->v_q24);
    n2_q28 = square_sum(nx_q14, ny_q14);
    if (!within_band(band, f_b_px_q16, n2_q28)) {
        return 0;
    }
    along = along_of(gx, gy, nx_q14, ny_q14);
    out->polarity = polarity_of(along);
    return aligned(band, along, gradient_square(gx, gy), n2_q28);
}

/* tan 11.25, 22.5, 33.75 degrees, Q16 */
#define TAN_1 13036
#define TAN_2 27146
#define TAN_3 43790

/* drogue_support_bin_of() */
static inline uint32_t bin_of(int32_t u_q24, int32_t v_q24)
{
    const int32_t x = u_q24 < 0 ? -u_q24 : u_q24;
    const int32_t y = v_q24 < 0 ? -v_q24 : v_q24;
    const int32_t most = x > y ? x : y;
    const int64_t least = (int64_t)(x > y ? y : x) * DROGUE_Q16_ONE;
    uint32_t bin = (uint32_t)(least >= (int64_t)most * TAN_1) + (uint32_t)(least >= (int64_t)most * TAN_2) +
                   (uint32_t)(least >= (int64_t)most * TAN_3);
    bin = most == 0 ? 0 : bin;
    bin = y > x ? 7 - bin : bin;      /* first quadrant */
    bin = u_q24 < 0 ? 15 - bin : bin; /* upper half */
    return v_q24 < 0 ? 31 - bin : bin;
}

/* A support's sums over all bins. */
typedef struct support_sums {
    int64_t squares_q32;
    uint64_t gradient;
    uint32_t points;
} support_sums;

static inline support_sums sums_of(const drogue_support *support)
{
    support_sums s;
    s.squares_q32 = support->squares_q32;
    s.gradient = support->gradient;
    s.points = support->points;
    return s;
}

static inline void put_sums(drogue_support *support, const support_sums *s)
{
    support->squares_q32 = s->squares_q32;
    support->gradient = s->gradient;
    support->points = s->points;
}

/* drogue_support_add() where held is 1; nothing where it is 0. Without a branch. */
static inline uint32_t add_to_support(drogue_support_bin *bin, support_sums *s, uint32_t held, uint32_t bright_bin,
                                      int32_t f_q24, drogue_polarity polarity, int16_t gx, int16_t gy)
{
    const uint32_t own = held & (uint32_t)(bright_bin == (uint32_t)polarity);
    const int32_t offset_q16 = ((f_q24 + 256) >> 9) & -(int32_t)own;
    const uint32_t gradient = (uint32_t)(gx < 0 ? -gx : gx) + (uint32_t)(gy < 0 ? -gy : gy);
    bin->count[polarity] += held;
    bin->sum_q16 += offset_q16;
    s->squares_q32 += (int64_t)offset_q16 * offset_q16;
    s->gradient += gradient & (0u - own);
    s->points += own;
    /* F is at most 1. A bin's points of one sign lie in a strip of less than 10 px across a region of 2048 px: at most
     * 2^15. There is one point a pixel: all bins hold at most 2^22. */
    DROGUE_NOTE("support: offset, Q16", offset_q16, 16);
    DROGUE_NOTE("support: sum of a bin's offsets, Q16", bin->sum_q16, 31);
    DROGUE_NOTE("support: sum of squared offsets, Q32", s->squares_q32, 53);
    DROGUE_NOTE("support: sum of gradients", s->gradient, 33);
    return own;
}

#endif
