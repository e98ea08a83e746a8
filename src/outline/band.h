/* SPDX-License-Identifier: Apache-2.0 */
/* What is done to every edge point near an ellipse, step by step: here so that loops over points take it in, those of
 * hardware (hls/outline/near.c) a step a turn. */
#ifndef DROGUE_BAND_H
#define DROGUE_BAND_H

#include "drogue/support.h"

/* Bits n and up of v, rounded as drogue_shr_round_s64() does, where the result fits 32 bits; 1 <= n <= 31. */
static inline int32_t low_shr_round(int64_t v, int n)
{
    return (int32_t)((uint32_t)((uint64_t)v >> n) + ((uint32_t)v >> (n - 1) & 1u));
}

/* A point within 2^14 px seen from an ellipse: its offset from the centre, and what F and its gradient are made of
 * there. */
typedef struct band_place {
    int32_t dx_px_q16;
    int32_t dy_px_q16;
    int64_t nx_q46; /* half the gradient of F times b: along the normal, on the ellipse b / a to 1 long */
    int64_t ny_q46;
} band_place;

static inline band_place place_of(const drogue_ellipse_frame *frame, drogue_q16 x_px_q16, drogue_q16 y_px_q16)
{
    band_place p;
    p.dx_px_q16 = x_px_q16 - frame->xc_px_q16;
    p.dy_px_q16 = y_px_q16 - frame->yc_px_q16;
    p.nx_q46 = drogue_product(p.dx_px_q16, frame->xx_q30) + drogue_product(p.dy_px_q16, frame->xy_q30);
    p.ny_q46 = drogue_product(p.dx_px_q16, frame->xy_q30) + drogue_product(p.dy_px_q16, frame->yy_q30);
    return p;
}

/* Is a component of the normal at least 1.5? By its upper word. Then F is above 1. */
static inline int far_off(int64_t n_q46)
{
    const uint32_t most_q14 = 3u << 13;
    return (uint32_t)((uint64_t)n_q46 >> 32) + most_q14 > 2 * most_q14;
}

static inline int32_t q22_of_q46(int64_t n_q46) { return low_shr_round(n_q46, 24); } /* where it is not far off */

/* (F + 1) b, px Q38: offset times normal. */
static inline int64_t size_q38_of(const band_place *p, int32_t nx_q22, int32_t ny_q22)
{
    return drogue_product(p->dx_px_q16, nx_q22) + drogue_product(p->dy_px_q16, ny_q22);
}

/* Is it 2^15 px or more? */
static inline int far_size(int64_t size_q38) { return (uint32_t)((uint64_t)size_q38 >> 32) >> 21 != 0; }

/* F b, where the size is not far off; anything else elsewhere */
static inline int32_t form_px_q16(const drogue_ellipse_frame *frame, int64_t size_q38)
{
    return (int32_t)((uint32_t)low_shr_round(size_q38, 22) - (uint32_t)frame->b_px_q16);
}

/* Is |F| b below a limit? */
static inline uint32_t near_form(const drogue_ellipse_frame *frame, int64_t size_q38, drogue_q16 most_px_q16)
{
    const int32_t f_b_px_q16 = form_px_q16(frame, size_q38);
    return (uint32_t)(!far_size(size_q38) & (f_b_px_q16 < most_px_q16) & (f_b_px_q16 > -most_px_q16));
}

/* F / 2 of F b within reach */
static inline int32_t offset_q16_of(const drogue_ellipse_frame *frame, int32_t f_b_px_q16)
{
    return low_shr_round(drogue_product(f_b_px_q16, frame->half_over_b_q31), 31);
}

static inline int32_t q14_of_q22(int32_t n_q22) { return (n_q22 + 128) >> 8; }

/* Direction of a point from its normal, in the ellipse's frame. */
static inline int32_t u_q14_of(const drogue_ellipse_frame *frame, int32_t nx_q14, int32_t ny_q14)
{
    return (nx_q14 * frame->cos_q14 + ny_q14 * frame->sin_q14 + (1 << 13)) >> 14;
}

static inline int32_t v_q14_of(const drogue_ellipse_frame *frame, int32_t nx_q14, int32_t ny_q14)
{
    return (ny_q14 * frame->cos_ratio_q14 - nx_q14 * frame->sin_ratio_q14 + (1 << 13)) >> 14;
}

static inline int32_t square_sum(int32_t x, int32_t y) { return x * x + y * y; }

static inline uint32_t gradient_square(int16_t gx, int16_t gy) { return (uint32_t)(gx * gx) + (uint32_t)(gy * gy); }

/* Gradient along the normal. */
static inline int32_t along_of(int16_t gx, int16_t gy, int32_t nx_q14, int32_t ny_q14)
{
    return gx * nx_q14 + gy * ny_q14;
}

/* F b of what can be within the band: the gradient of F is at most about 4 / b; and from inside half to outside 1.4 of
 * the outline. */
typedef struct band_reach {
    int32_t least_px_q16;
    uint32_t range_px_q16;
} band_reach;

static inline band_reach reach_of(const drogue_ellipse_frame *frame, const drogue_band *band)
{
    const int32_t most = 4 * band->half_width_px_q16;
    const int32_t inside = (frame->b_px_q16 >> 2) * 3;
    band_reach r;
    r.least_px_q16 = most < inside ? -most : -inside;
    r.range_px_q16 = (uint32_t)(most < frame->b_px_q16 ? most : frame->b_px_q16) - (uint32_t)r.least_px_q16;
    return r;
}

static inline int in_reach(const band_reach *reach, int32_t f_b_px_q16)
{
    return (uint32_t)f_b_px_q16 - (uint32_t)reach->least_px_q16 <= reach->range_px_q16;
}

/* |F| / |grad F| <= t  <=>  (F b)^2 <= 4 t^2 n^2, for what is in reach */
static inline int within_band(const drogue_band *band, int32_t f_b_px_q16, int32_t n2_q28)
{
    const int32_t f_b_px_q25 = (int32_t)((uint32_t)f_b_px_q16 << 9);
    DROGUE_NOTE("quality: squared normal, Q28", n2_q28, 31);
    DROGUE_NOTE("quality: F b in reach, Q16", f_b_px_q16, 21);
    return drogue_product(f_b_px_q25, f_b_px_q25) <= drogue_product(band->width2_px2_q24, n2_q28);
}

/* Is a gradient, of which so much lies along the normal, near enough to it, either way? */
static inline int aligned(const drogue_band *band, int32_t along, uint32_t g2, int32_t n2_q28)
{
    DROGUE_NOTE("quality: gradient along normal", along, 26);
    DROGUE_NOTE("quality: squared gradient times squared cosine, Q10", band->cos2_q10 * g2, 32);
    return (along != 0) &
           ((uint64_t)drogue_product(along, along) << 10 >= drogue_product_u32(band->cos2_q10 * g2, (uint32_t)n2_q28));
}

static inline drogue_polarity polarity_of(int32_t along)
{
    return along > 0 ? DROGUE_POLARITY_DARK : DROGUE_POLARITY_BRIGHT;
}

/* An edge point that belongs to an outline. */
typedef struct band_point {
    int32_t u_q14; /* its direction in the ellipse's frame: b / a times u, v */
    int32_t v_q14;
    int32_t offset_q16;       /* F / 2: how far it lies off the outline, along the radius, in semi-axes */
    drogue_polarity polarity; /* DARK: the gradient points outward; BRIGHT: inward */
    int32_t f_b_px_q16;       /* F b */
    int32_t n2_q28;           /* half the gradient of F times b, squared */
} band_point;

/* Does an edge point belong to the outline? 'out' is complete when it does. Error of F times b: 2^-14 a / b px and
 * 2^-20 of b; of the direction: 2^-13 a / b rad. */
static inline int band_holds(band_point *out, const drogue_ellipse_frame *frame, const drogue_band *band,
                             const band_reach *reach, drogue_q16 x_px_q16, drogue_q16 y_px_q16, int16_t gx, int16_t gy)
{
    const band_place p = place_of(frame, x_px_q16, y_px_q16);
    int64_t size_q38;
    int32_t nx;
    int32_t ny;
    int32_t f_b_px_q16;
    int32_t n2_q28;
    int32_t along;
    if (far_off(p.nx_q46) || far_off(p.ny_q46)) {
        return 0;
    }
    nx = q22_of_q46(p.nx_q46);
    ny = q22_of_q46(p.ny_q46);
    size_q38 = size_q38_of(&p, nx, ny);
    f_b_px_q16 = form_px_q16(frame, size_q38);
    if (far_size(size_q38) || !in_reach(reach, f_b_px_q16)) {
        return 0;
    }
    nx = q14_of_q22(nx);
    ny = q14_of_q22(ny);
    n2_q28 = square_sum(nx, ny);
    if (!within_band(band, f_b_px_q16, n2_q28)) {
        return 0;
    }
    along = along_of(gx, gy, nx, ny);
    if (!aligned(band, along, gradient_square(gx, gy), n2_q28)) {
        return 0;
    }
    out->u_q14 = u_q14_of(frame, nx, ny);
    out->v_q14 = v_q14_of(frame, nx, ny);
    out->offset_q16 = offset_q16_of(frame, f_b_px_q16);
    out->polarity = polarity_of(along);
    out->f_b_px_q16 = f_b_px_q16;
    out->n2_q28 = n2_q28;
    return 1;
}

/* tan 11.25, 22.5, 33.75 degrees, Q16 */
#define TAN_1 13036u
#define TAN_2 27146u
#define TAN_3 43790u

/* Index of the bin of a direction, |u| and |v| < 2^15 in any common unit; not (0, 0). */
static inline uint32_t bin_of(int32_t u, int32_t v)
{
    const uint32_t x = (uint32_t)(u < 0 ? -u : u);
    const uint32_t y = (uint32_t)(v < 0 ? -v : v);
    const int steep = y > x;
    const uint32_t most = steep ? y : x;
    const uint32_t least = (steep ? x : y) << 16;
    const uint32_t half = least >= most * TAN_2;
    uint32_t bin = 2 * half + (least >= most * (half ? TAN_3 : TAN_1));
    bin = steep ? 7 - bin : bin;  /* first quadrant */
    bin = u < 0 ? 15 - bin : bin; /* upper half */
    return v < 0 ? 31 - bin : bin;
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

/* Count a point where held is 1; when its polarity is that of its bin also add it to the sums, and return 1. Without a
 * branch. */
static inline uint32_t add_to_support(drogue_support_bin *bin, support_sums *s, uint32_t held, uint32_t bright_bin,
                                      int32_t off_q16, drogue_polarity polarity, int16_t gx, int16_t gy)
{
    const uint32_t own = held & (uint32_t)(bright_bin == (uint32_t)polarity);
    const int32_t offset_q16 = off_q16 & -(int32_t)own;
    const uint32_t gradient = (uint32_t)(gx < 0 ? -gx : gx) + (uint32_t)(gy < 0 ? -gy : gy);
    bin->count[polarity] += held;
    bin->sum_q16 += offset_q16;
    s->squares_q32 += drogue_product(offset_q16, offset_q16);
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
