/* SPDX-License-Identifier: Apache-2.0 */
/* How sure a result is. */
#include "sure.h"

#include "drogue/decide.h"
#include "drogue/search.h"

#define SURE_COVER DROGUE_Q16(3, 4) /* without an inner part */
#define SURE_RELIABILITY DROGUE_Q16(9, 10)
#define UNWEIGHED (-3 * DROGUE_Q16_ONE) /* log odds without one, but for the cover */
#define FARTHEST (64 * DROGUE_Q16_ONE)  /* from even odds */

int drogue_result_decided(const drogue_result *r)
{
    return r->orientation_resolved && r->doubt_q16 < DROGUE_CONTRADICTED_Q16;
}

/* Radius of the inner part that the model expects in this outline, px Q16, at least 1 px; 0 where none is believed, or
 * one behind the camera. A ring about some dark disc has another; and of concentric outlines the rim's is largest. */
static int32_t expected(const drogue_result *r, const drogue_model *model)
{
    const int64_t z = r->pose.position_m_q16[2];
    const int64_t end = z + model->inner_depth_m_q16;
    int64_t px_q16; /* no image has more than INT32_MAX */
    if (!r->has_inner || z <= 0 || end <= 0) {
        return 0;
    }
    px_q16 = (int64_t)drogue_isqrt_u64((uint64_t)((int64_t)r->ellipse.a_px_q16 * r->ellipse.b_px_q16));
    px_q16 = drogue_sat_s32(drogue_div_round_s64(px_q16 * model->inner_radius_m_q16, model->rim_radius_m_q16));
    px_q16 = drogue_sat_s32(drogue_div_round_s64(px_q16 * z, end));
    return px_q16 < DROGUE_Q16_ONE ? DROGUE_Q16_ONE : (int32_t)px_q16;
}

/* log2 of a number of at least 1, Q16, by its leading bit and straight from one power to the next: at most 0.086
 * less. */
static int32_t log2_q16(int32_t v_q16)
{
    const int whole = 15 - drogue_clz_u32((uint32_t)v_q16);
    return whole * DROGUE_Q16_ONE + (v_q16 >> whole) - DROGUE_Q16_ONE;
}

int32_t drogue_result_log_odds_q16(const drogue_result *r, const drogue_model *model)
{
    const int32_t radius_px_q16 = expected(r, model);
    int64_t sum_q16;
    if (radius_px_q16 == 0) {
        return UNWEIGHED + r->cover_q16;
    }
    sum_q16 = 5 * log2_q16(radius_px_q16) + 9 * (int64_t)r->cover_q16 - 14 * (int64_t)r->inner.spread_px_q16 -
              7 * (int64_t)r->ambiguity_q16 + 10 * r->inner.rays * (DROGUE_Q16_ONE / DROGUE_RAYS) -
              (2 * (int64_t)r->outside - 3 * drogue_result_decided(r)) * DROGUE_Q16_ONE;
    return drogue_clamp_s32(drogue_sat_s32(drogue_div_round_s64(sum_q16, 4) - 5 * DROGUE_Q16_ONE), -FARTHEST, FARTHEST);
}

int drogue_result_sure(const drogue_result *r, const drogue_model *model)
{
    if (model->inner_radius_m_q16 == 0) {
        return r->cover_q16 >= SURE_COVER && r->quality.reliability_q16 >= SURE_RELIABILITY;
    }
    return drogue_result_log_odds_q16(r, model) >= DROGUE_SURE_Q16;
}
