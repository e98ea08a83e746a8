/* SPDX-License-Identifier: Apache-2.0 */
/* What is done to every edge point near an ellipse; here so that the loops over points take it in. */
#ifndef DROGUE_BAND_H
#define DROGUE_BAND_H

#include "drogue/quality.h"

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

/* drogue_ellipse_deviation() */
static inline drogue_q16 deviation(const drogue_ellipse_frame *frame, drogue_q16 x_px_q16, drogue_q16 y_px_q16)
{
    int32_t u_q24;
    int32_t v_q24;
    int64_t d_q48;
    frame_point(&u_q24, &v_q24, frame, x_px_q16, y_px_q16);
    d_q48 = conic_q48(u_q24, v_q24);
    return drogue_sat_s32(shr_round(d_q48 < 0 ? -d_q48 : d_q48, 32));
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
    int32_t n2_q20;
    int32_t along;
    uint32_t g2;
    offsets(&u_q46, &v_q46, frame, x_px_q16, y_px_q16);
    if (far_off(u_q46) || far_off(v_q46)) {
        return 0;
    }
    out->u_q24 = low_shr_round(u_q46, 22);
    out->v_q24 = low_shr_round(v_q46, 22);
    out->f_q24 = low_shr_round(conic_q48(out->u_q24, out->v_q24), 24);
    if (out->f_q24 > (1 << 24) || out->f_q24 < -(3 << 22)) {
        return 0; /* inside half or outside 1.4 of the outline */
    }
    f_b_px_q16 = low_shr_round((int64_t)out->f_q24 * frame->b_px_q16, 24);
    f_b_px_q16 = f_b_px_q16 < 0 ? -f_b_px_q16 : f_b_px_q16;
    if (f_b_px_q16 > 4 * band->half_width_px_q16) {
        return 0;
    }
    /* Half the gradient of F times b: between b / a and about 1 in length. */
    nx_q14 = low_shr_round((int64_t)out->u_q24 * frame->cos_ratio_q14 - (int64_t)out->v_q24 * frame->sin_q14, 24);
    ny_q14 = low_shr_round((int64_t)out->u_q24 * frame->sin_ratio_q14 + (int64_t)out->v_q24 * frame->cos_q14, 24);
    n2_q28 = nx_q14 * nx_q14 + ny_q14 * ny_q14;
    /* |F| / |grad F| <= t  <=>  (F b)^2 <= 4 t^2 n^2 */
    DROGUE_NOTE("quality: squared normal, Q28", n2_q28, 30);
    n2_q20 = (n2_q28 + 128) >> 8;
    if ((int64_t)f_b_px_q16 * f_b_px_q16 > shr_round((int64_t)band->width2_px2_q24 * n2_q20, 10)) {
        return 0;
    }
    along = gx * nx_q14 + gy * ny_q14;
    out->polarity = along > 0 ? DROGUE_POLARITY_DARK : DROGUE_POLARITY_BRIGHT;
    g2 = (uint32_t)(gx * gx + gy * gy);
    DROGUE_NOTE("quality: gradient along normal", along, 26);
    DROGUE_NOTE("quality: squared gradient times squared cosine, Q10", band->cos2_q10 * g2, 32);
    return along != 0 &&
           (uint64_t)((int64_t)along * along) * 1024 >= (uint64_t)(band->cos2_q10 * g2) * (uint32_t)n2_q28;
}

#endif
