/* SPDX-License-Identifier: Apache-2.0 */
/* Collected edge points: the unit of their moments, their fit, and what blur took from it. */
#include "collection.h"

void drogue_collection_of_region(drogue_collection *c)
{
    drogue_moments_clear(&c->moments);
    c->x_px_q16 = c->y_px_q16 = drogue_q16_from_int(DROGUE_MAX_SIDE / 2);
    c->frac_bits = 5;
}

void drogue_collection_begin(drogue_collection *c, const drogue_ellipse *e, int64_t reach_px_q16)
{
    drogue_moments_clear(&c->moments);
    c->x_px_q16 = drogue_q16_from_int((int32_t)drogue_shr_round_s64(e->xc_px_q16, 16));
    c->y_px_q16 = drogue_q16_from_int((int32_t)drogue_shr_round_s64(e->yc_px_q16, 16));
    c->frac_bits = 10;
    /* bound: 10 */
    while (c->frac_bits > 0 && reach_px_q16 >> (16 - c->frac_bits) > INT16_MAX) {
        c->frac_bits--;
    }
}

drogue_status drogue_collection_fit(drogue_ellipse *out, const drogue_collection *c)
{
    drogue_status status = drogue_ellipse_fit(out, &c->moments, c->frac_bits);
    out->xc_px_q16 = drogue_q16_add(out->xc_px_q16, c->x_px_q16);
    out->yc_px_q16 = drogue_q16_add(out->yc_px_q16, c->y_px_q16);
    return status;
}

void drogue_ellipse_shift(drogue_ellipse *e, drogue_q16 along_px_q16, drogue_q16 across_px_q16)
{
    int32_t s_q30;
    int32_t c_q30;
    int64_t moved_px_q16[2];
    drogue_sincos_of_q16(&s_q30, &c_q30, e->angle_rad_q16);
    drogue_rotate_q30(moved_px_q16, along_px_q16, across_px_q16, c_q30, s_q30);
    e->xc_px_q16 = drogue_sat_s32(e->xc_px_q16 + moved_px_q16[0]);
    e->yc_px_q16 = drogue_sat_s32(e->yc_px_q16 + moved_px_q16[1]);
}

void drogue_undo_blur(drogue_ellipse *e, const drogue_config *config)
{
    drogue_real own;
    drogue_real half;
    drogue_real axis[2];
    drogue_real grown[2];
    int k;
    drogue_real_set_q16(&own, config->smooth ? DROGUE_Q16(82, 100) : DROGUE_Q16(32, 100));
    drogue_real_set_q16(&half, config->optics_blur_px_q16);
    drogue_real_product(&half, &half, &half);
    drogue_real_shift(&half, -1);
    drogue_real_sum(&half, &own, &half);
    drogue_real_set_q16(&axis[0], e->a_px_q16);
    drogue_real_set_q16(&axis[1], e->b_px_q16);
    for (k = 0; k < 2; k++) {
        drogue_real_product(&own, &axis[1 - k], &axis[1 - k]);
        drogue_real_product(&grown[k], &half, &axis[k]);
        drogue_real_quotient(&grown[k], &grown[k], &own);
        drogue_real_sum(&grown[k], &axis[k], &grown[k]);
    }
    e->a_px_q16 = drogue_real_to_q16(grown[0]);
    e->b_px_q16 = drogue_real_to_q16(grown[1]);
}

#define SETTLED_Q16 DROGUE_Q16(1, 64) /* px */

static int stays(drogue_q16 p_px_q16, drogue_q16 q_px_q16)
{
    const drogue_q16 d = drogue_q16_sub(p_px_q16, q_px_q16);
    return d <= SETTLED_Q16 && d >= -SETTLED_Q16;
}

int drogue_ellipse_settled(const drogue_ellipse *p, const drogue_ellipse *q)
{
    return stays(p->xc_px_q16, q->xc_px_q16) && stays(p->yc_px_q16, q->yc_px_q16) && stays(p->a_px_q16, q->a_px_q16) &&
           stays(p->b_px_q16, q->b_px_q16);
}

void drogue_band_narrow(drogue_band *band, const drogue_support *support, const drogue_ellipse *e,
                        const drogue_config *config)
{
    const int64_t variance_q32 = support->points > 0 ? support->squares_q32 / (int64_t)support->points : 0;
    const int64_t spread_px_q16 =
        drogue_shr_round_s64(3 * (int64_t)drogue_isqrt_u64((uint64_t)variance_q32) * e->a_px_q16, 16);
    const drogue_q16 least = config->refit_band_px_q16 / 3 + 1;
    if (spread_px_q16 < band->half_width_px_q16) {
        *band = drogue_band_of(spread_px_q16 < least ? least : (drogue_q16)spread_px_q16, config->refit_cos_q16);
    }
}
