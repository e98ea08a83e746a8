/* SPDX-License-Identifier: Apache-2.0 */
/* Quality of a fitted ellipse: paper (10)-(15). */
#include "drogue/quality.h"

#include "drogue/wide.h"

#define PI_Q29 INT64_C(1686629713)

static int32_t over_q30(int32_t v_q30, drogue_q16 length_px_q16)
{
    return (int32_t)drogue_div_round_s64((int64_t)v_q30 * DROGUE_Q16_ONE, length_px_q16);
}

drogue_status drogue_ellipse_frame_of(drogue_ellipse_frame *out, const drogue_ellipse *ellipse)
{
    int32_t s_q30;
    int32_t c_q30;
    if (ellipse->b_px_q16 < DROGUE_Q16_ONE || ellipse->a_px_q16 < ellipse->b_px_q16) {
        return DROGUE_E_DOMAIN;
    }
    drogue_sincos_q30(&s_q30, &c_q30, (int32_t)drogue_shl_s64(ellipse->angle_rad_q16, 13));
    out->xc_px_q16 = ellipse->xc_px_q16;
    out->yc_px_q16 = ellipse->yc_px_q16;
    out->b_px_q16 = ellipse->b_px_q16;
    out->cos_over_a_q30 = over_q30(c_q30, ellipse->a_px_q16);
    out->sin_over_a_q30 = over_q30(s_q30, ellipse->a_px_q16);
    out->cos_over_b_q30 = over_q30(c_q30, ellipse->b_px_q16);
    out->sin_over_b_q30 = over_q30(s_q30, ellipse->b_px_q16);
    out->cos_q14 = (int32_t)drogue_shr_round_s64(c_q30, 16);
    out->sin_q14 = (int32_t)drogue_shr_round_s64(s_q30, 16);
    out->cos_ratio_q14 = (int32_t)drogue_shr_round_s64((int64_t)out->cos_over_a_q30 * out->b_px_q16, 32);
    out->sin_ratio_q14 = (int32_t)drogue_shr_round_s64((int64_t)out->sin_over_a_q30 * out->b_px_q16, 32);
    return DROGUE_OK;
}

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

static inline int32_t clamp_q24(int64_t v_q46)
{
    const int64_t most = INT64_C(16) << 24;
    int64_t v = shr_round(v_q46, 22);
    return (int32_t)(v > most ? most : v < -most ? -most : v);
}

inline void drogue_ellipse_frame_point(int32_t *u_q24, int32_t *v_q24, const drogue_ellipse_frame *frame, drogue_q16 x_px_q16,
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

/* u^2 + v^2 - 1, Q48 */
static inline int64_t conic_q48(int32_t u_q24, int32_t v_q24)
{
    return (int64_t)u_q24 * u_q24 + (int64_t)v_q24 * v_q24 - (INT64_C(1) << 48);
}

inline drogue_q16 drogue_ellipse_deviation(const drogue_ellipse_frame *frame, drogue_q16 x_px_q16, drogue_q16 y_px_q16)
{
    int32_t u_q24;
    int32_t v_q24;
    int64_t d_q48;
    drogue_ellipse_frame_point(&u_q24, &v_q24, frame, x_px_q16, y_px_q16);
    d_q48 = conic_q48(u_q24, v_q24);
    return drogue_sat_s32(shr_round(d_q48 < 0 ? -d_q48 : d_q48, 32));
}

drogue_band drogue_band_of(drogue_q16 half_width_px_q16, drogue_q16 cos_q16)
{
    drogue_band band;
    band.half_width_px_q16 = half_width_px_q16;
    band.width2_px2_q24 = (int32_t)drogue_shr_round_s64((int64_t)half_width_px_q16 * half_width_px_q16, 8);
    band.cos2_q10 = (uint32_t)drogue_shr_round_s64((int64_t)cos_q16 * cos_q16, 22);
    return band;
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

inline int drogue_ellipse_band_holds(drogue_band_point *out, const drogue_ellipse_frame *frame, const drogue_band *band,
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

drogue_q16 drogue_quality_threshold(const drogue_ellipse *ellipse, drogue_q16 fit_error_px_q16)
{
    return drogue_q16_div(drogue_q16_add(fit_error_px_q16, fit_error_px_q16), ellipse->a_px_q16);
}

drogue_q16 drogue_ellipse_circumference(const drogue_ellipse *ellipse)
{
    int64_t a = ellipse->a_px_q16;
    int64_t b = ellipse->b_px_q16;
    uint64_t square_q32;
    uint64_t root_q16;
    if (a < 0 || b < 0 || a + b >= (INT64_C(1) << 29)) {
        return DROGUE_Q16_MAX;
    }
    square_q32 = (uint64_t)(3 * a + b) * (uint64_t)(a + 3 * b);
    root_q16 = drogue_isqrt_u64(square_q32);
    if (square_q32 - root_q16 * root_q16 > root_q16) {
        root_q16++;
    }
    return drogue_sat_s32(drogue_shr_round_s64((3 * (a + b) - (int64_t)root_q16) * PI_Q29, 29));
}

/* s(s_r) of (14): 0 at the ratio k2, 0.5 for a circle. The slope in the ratio is up to k1 / (1 - k2): the ratio is kept
 * wide. */
static drogue_q16 axis_ratio_score(const drogue_ellipse *e, const drogue_quality_config *config)
{
    drogue_wide a;
    drogue_wide k;
    drogue_wide t;
    int64_t t_q30;
    int64_t decay_q30;
    drogue_wide_set_q16(&a, e->a_px_q16);
    drogue_wide_set_q16(&k, config->k2_q16);
    drogue_wide_product(&k, &k, &a);
    drogue_wide_set_q16(&t, e->b_px_q16);
    drogue_wide_difference(&t, &t, &k);
    if (t.mantissa <= 0) {
        return 0;
    }
    drogue_wide_set_q16(&k, DROGUE_Q16_ONE - config->k2_q16);
    drogue_wide_product(&a, &a, &k);
    drogue_wide_quotient(&t, &t, &a);
    t_q30 = drogue_wide_to_s64(t, 30);
    drogue_wide_set_q16(&k, config->k1_q16);
    drogue_wide_product(&t, &k, &t);
    decay_q30 = drogue_exp_neg_q30(drogue_wide_to_s64(t, 30));
    return (drogue_q16)drogue_shr_round_s64(
        drogue_shr_round_s64((t_q30 - (INT64_C(1) << 30)) * decay_q30, 30) + (INT64_C(1) << 30), 15);
}

static drogue_q16 ratio_to_one(int64_t num_q16, int64_t den)
{
    if (den <= 0 || num_q16 >= den * DROGUE_Q16_ONE) {
        return DROGUE_Q16_ONE;
    }
    return (drogue_q16)drogue_div_round_s64(num_q16, den);
}

drogue_q16 drogue_length_ratio(uint32_t points, const drogue_ellipse *ellipse)
{
    const uint32_t most = (uint32_t)1 << 26; /* more points than any region has */
    return ratio_to_one(drogue_shl_s64(points > most ? most : points, 32), drogue_ellipse_circumference(ellipse));
}

void drogue_quality_of_cover(drogue_quality *out, const drogue_ellipse *ellipse, uint32_t near_count, uint32_t total,
                             drogue_q16 cover_q16, const drogue_quality_config *config)
{
    out->fit_ratio_q16 = ratio_to_one((int64_t)near_count * DROGUE_Q16_ONE, total);
    out->length_ratio_q16 = cover_q16;
    out->axis_ratio_q16 = drogue_q16_div(ellipse->b_px_q16, ellipse->a_px_q16);
    out->score_q16 = (drogue_q16)drogue_shr_round_s64(out->length_ratio_q16, 1) + axis_ratio_score(ellipse, config);
    out->reliability_q16 = (drogue_q16)drogue_shr_round_s64((int64_t)out->score_q16 + out->fit_ratio_q16, 1);
}

void drogue_quality_score(drogue_quality *out, const drogue_ellipse *ellipse, uint32_t near_count, uint32_t total,
                          const drogue_quality_config *config)
{
    drogue_quality_of_cover(out, ellipse, near_count, total, drogue_length_ratio(total, ellipse), config);
}
