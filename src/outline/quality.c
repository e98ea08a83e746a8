/* SPDX-License-Identifier: Apache-2.0 */
/* Quality of a fitted ellipse: paper (10)-(15). */
#include "band.h"

#include "drogue/real.h"

#define PI_Q29 1686629713

/* 1 / v; v > 0 */
static void inverse_of(drogue_real *out, drogue_q16 v_q16)
{
    const drogue_real one = DROGUE_REAL_ONE;
    drogue_real_set_q16(out, v_q16);
    drogue_real_quotient(out, &one, out);
}

static int32_t times_q30(const drogue_real *v, const drogue_real *factor)
{
    drogue_real t;
    drogue_real_product(&t, v, factor);
    return drogue_real_to_s32(t, 30);
}

static int32_t mul_q30(int32_t a, int32_t b_q30) { return low_shr_round(drogue_product(a, b_q30), 30); }

static int far(drogue_q16 v_px_q16) { return v_px_q16 >= 1 << 30 || v_px_q16 <= -(1 << 30); }

drogue_status drogue_ellipse_frame_of(drogue_ellipse_frame *out, const drogue_ellipse *ellipse)
{
    int32_t s_q30;
    int32_t c_q30;
    int32_t s_ratio_q30;
    int32_t c_ratio_q30;
    drogue_real s;
    drogue_real c;
    drogue_real inverse;
    drogue_real ratio;
    if (ellipse->b_px_q16 < DROGUE_Q16_ONE || ellipse->a_px_q16 < ellipse->b_px_q16 || far(ellipse->xc_px_q16) ||
        far(ellipse->yc_px_q16) || !drogue_ellipse_angle_valid(ellipse)) {
        return DROGUE_E_DOMAIN;
    }
    drogue_sincos_of_q16(&s_q30, &c_q30, ellipse->angle_rad_q16);
    out->xc_px_q16 = ellipse->xc_px_q16;
    out->yc_px_q16 = ellipse->yc_px_q16;
    out->b_px_q16 = ellipse->b_px_q16;
    drogue_real_set(&s, s_q30, -30);
    drogue_real_set(&c, c_q30, -30);
    inverse_of(&inverse, ellipse->a_px_q16);
    out->cos_over_a_q30 = times_q30(&c, &inverse);
    out->sin_over_a_q30 = times_q30(&s, &inverse);
    drogue_real_set_q16(&ratio, ellipse->b_px_q16);
    drogue_real_product(&ratio, &ratio, &inverse);
    s_ratio_q30 = times_q30(&s, &ratio);
    c_ratio_q30 = times_q30(&c, &ratio);
    inverse_of(&inverse, ellipse->b_px_q16);
    out->half_over_b_q31 = drogue_real_to_s32(inverse, 30);
    out->cos_over_b_q30 = times_q30(&c, &inverse);
    out->sin_over_b_q30 = times_q30(&s, &inverse);
    out->xx_q30 = mul_q30(c_ratio_q30, out->cos_over_a_q30) + mul_q30(s_q30, out->sin_over_b_q30);
    out->xy_q30 = mul_q30(c_ratio_q30, out->sin_over_a_q30) - mul_q30(s_q30, out->cos_over_b_q30);
    out->yy_q30 = mul_q30(s_ratio_q30, out->sin_over_a_q30) + mul_q30(c_q30, out->cos_over_b_q30);
    out->cos_q14 = low_shr_round(c_q30, 16);
    out->sin_q14 = low_shr_round(s_q30, 16);
    out->cos_ratio_q14 = low_shr_round(c_ratio_q30, 16);
    out->sin_ratio_q14 = low_shr_round(s_ratio_q30, 16);
    return DROGUE_OK;
}

static int32_t clamp_q24(int64_t v_q46)
{
    const int64_t most = INT64_C(16) << 24;
    const int64_t v = drogue_shr_round_s64(v_q46, 22);
    return (int32_t)(v > most ? most : v < -most ? -most : v);
}

void drogue_ellipse_frame_point(int32_t *u_q24, int32_t *v_q24, const drogue_ellipse_frame *frame, drogue_q16 x_px_q16,
                                drogue_q16 y_px_q16)
{
    const int32_t dx = drogue_q16_sub(x_px_q16, frame->xc_px_q16);
    const int32_t dy = drogue_q16_sub(y_px_q16, frame->yc_px_q16);
    *u_q24 = clamp_q24(drogue_product(dx, frame->cos_over_a_q30) + drogue_product(dy, frame->sin_over_a_q30));
    *v_q24 = clamp_q24(drogue_product(dy, frame->cos_over_b_q30) - drogue_product(dx, frame->sin_over_b_q30));
    DROGUE_NOTE("quality: u, Q24", *u_q24, 29);
    DROGUE_NOTE("quality: v, Q24", *v_q24, 29);
}

drogue_q16 drogue_ellipse_deviation(const drogue_ellipse_frame *frame, drogue_q16 x_px_q16, drogue_q16 y_px_q16)
{
    int32_t u_q24;
    int32_t v_q24;
    int64_t d_q48;
    drogue_ellipse_frame_point(&u_q24, &v_q24, frame, x_px_q16, y_px_q16);
    d_q48 = drogue_product(u_q24, u_q24) + drogue_product(v_q24, v_q24) - (INT64_C(1) << 48);
    return drogue_sat_s32(drogue_shr_round_s64(d_q48 < 0 ? -d_q48 : d_q48, 32));
}

drogue_band drogue_band_of(drogue_q16 half_width_px_q16, drogue_q16 cos_q16)
{
    drogue_band band;
    band.half_width_px_q16 = half_width_px_q16;
    band.width2_px2_q24 = (int32_t)drogue_shr_round_s64((int64_t)half_width_px_q16 * half_width_px_q16, 8);
    band.cos2_q10 = (uint32_t)drogue_shr_round_s64((int64_t)cos_q16 * cos_q16, 22);
    return band;
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
    uint32_t root_q16;
    if (a < 0 || b < 0 || a + b >= (INT64_C(1) << 29)) {
        return DROGUE_Q16_MAX;
    }
    square_q32 = (uint64_t)(uint32_t)(3 * a + b) * (uint32_t)(a + 3 * b);
    root_q16 = drogue_isqrt_u64(square_q32);
    if (square_q32 - (uint64_t)root_q16 * root_q16 > root_q16) {
        root_q16++;
    }
    return drogue_sat_s32(drogue_shr_round_s64((int64_t)(int32_t)(3 * (a + b) - root_q16) * PI_Q29, 29));
}

/* num / den, at most 1, as of nothing; neither is negative */
static int32_t share(int64_t num, int64_t den, int frac_bits)
{
    drogue_real t;
    if (num >= den) {
        return (int32_t)1 << frac_bits;
    }
    drogue_real_ratio(&t, num, den);
    return drogue_real_to_s32(t, frac_bits);
}

/* s(s_r) of (14): 0 at the ratio k2, 0.5 for a circle. Its slope in the ratio is up to k1 / (1 - k2): the ratio's
 * excess over k2 is formed before it is rounded. */
static drogue_q16 axis_ratio_score(const drogue_ellipse *e, const drogue_quality_config *config)
{
    const int64_t excess_q32 = (int64_t)e->b_px_q16 * DROGUE_Q16_ONE - (int64_t)e->a_px_q16 * config->k2_q16;
    int32_t t_q30;
    int32_t decay_q30;
    if (excess_q32 <= 0) {
        return 0;
    }
    t_q30 = share(excess_q32, (int64_t)e->a_px_q16 * (DROGUE_Q16_ONE - config->k2_q16), 30);
    decay_q30 = drogue_exp_neg_q30(drogue_shr_round_s64((int64_t)config->k1_q16 * t_q30, 16));
    return (drogue_q16)drogue_shr_round_s64(
        drogue_shr_round_s64((int64_t)(t_q30 - (1 << 30)) * decay_q30, 30) + (1 << 30), 15);
}

/* Points over circumference (12), Q16, at most 1. A whole outline of 8-connected pixels gives about 0.9. */
static drogue_q16 length_ratio(uint32_t points, const drogue_ellipse *ellipse)
{
    const uint32_t most = (uint32_t)1 << 26; /* more points than any region has */
    return share(drogue_shl_s64(points > most ? most : points, 16), drogue_ellipse_circumference(ellipse), 16);
}

drogue_q16 drogue_quality_fit_ratio(uint32_t near_count, uint32_t total) { return share(near_count, total, 16); }

void drogue_quality_of_cover(drogue_quality *out, const drogue_ellipse *ellipse, drogue_q16 fit_ratio_q16,
                             drogue_q16 cover_q16, const drogue_quality_config *config)
{
    out->fit_ratio_q16 = fit_ratio_q16;
    out->length_ratio_q16 = cover_q16;
    out->axis_ratio_q16 = drogue_q16_div(ellipse->b_px_q16, ellipse->a_px_q16);
    out->score_q16 = (drogue_q16)drogue_shr_round_s64(out->length_ratio_q16, 1) + axis_ratio_score(ellipse, config);
    out->reliability_q16 = (drogue_q16)drogue_shr_round_s64((int64_t)out->score_q16 + out->fit_ratio_q16, 1);
}

void drogue_quality_score(drogue_quality *out, const drogue_ellipse *ellipse, uint32_t near_count, uint32_t total,
                          const drogue_quality_config *config)
{
    drogue_quality_of_cover(out, ellipse, drogue_quality_fit_ratio(near_count, total), length_ratio(total, ellipse),
                            config);
}
