/* SPDX-License-Identifier: Apache-2.0 */
/* What the filter takes of a result: values, standard deviations, covariance. */
#include "measurement.h"

#include <string.h>

#include "drogue/decide.h"

/* Noise from the configured standard deviations. */
static void configured_noise(drogue_measurement *m, const drogue_track_config *c)
{
    const drogue_q16 z = m->value_q16[DROGUE_Z];
    int p;
    m->std_q16[DROGUE_X] = m->std_q16[DROGUE_Y] = drogue_at_least_one(drogue_q16_mul(c->lateral_std_q16, z));
    m->std_q16[DROGUE_Z] = drogue_at_least_one(drogue_q16_mul(c->depth_std_q16, z));
    m->std_q16[DROGUE_PITCH] = m->std_q16[DROGUE_YAW] = drogue_at_least_one(c->angle_std_rad_q16);
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        drogue_real *variance = &m->noise[DROGUE_PACKED(p, p)];
        drogue_real_set_q16(variance, m->std_q16[p]);
        drogue_real_product(variance, variance, variance);
    }
}

/* Order of a result's covariance: it ends with yaw, pitch. */
static const int order[DROGUE_PARAMETERS] = {0, 1, 2, 4, 3};

/* How often a covariance is halved: any result's, whatever it holds, is one that can be read. */
static int halved(const drogue_result *result) { return drogue_clamp_s32(result->covariance_halved, 0, 63); }

/* What an unresolved result's covariance holds of the two poses' distance (decide.h): half the product of two of its
 * components, Q48, halved as often as the covariance. */
static int64_t half_product_q48(const int64_t apart_q16[DROGUE_PARAMETERS], int p, int q, const drogue_result *result)
{
    return drogue_shr_round_s64(apart_q16[p] * apart_q16[q] * (1 << 15), halved(result));
}

static int64_t clamped(int64_t v, int64_t most) { return v < -most ? -most : v > most ? most : v; }

/* Distance of the twins in the filter's order, where the covariance holds it; else zero. */
static void twins_apart(int64_t apart_q16[DROGUE_PARAMETERS], const drogue_result *result)
{
    const drogue_pose *a = &result->pose;
    const drogue_pose *b = &result->alternative;
    const int64_t most = INT64_C(1) << 22; /* 64 m */
    int p;
    memset(apart_q16, 0, DROGUE_PARAMETERS * sizeof *apart_q16);
    if (result->orientation_resolved) {
        return;
    }
    for (p = DROGUE_X; p <= DROGUE_Z; p++) {
        apart_q16[p] = (int64_t)b->position_m_q16[p] - a->position_m_q16[p];
    }
    apart_q16[DROGUE_PITCH] = (int64_t)b->pitch_rad_q16 - a->pitch_rad_q16;
    apart_q16[DROGUE_YAW] = (int64_t)b->yaw_rad_q16 - a->yaw_rad_q16;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        apart_q16[p] = clamped(apart_q16[p], most);
    }
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        if (result->covariance_q48[order[p]][order[p]] <= half_product_q48(apart_q16, p, p, result)) {
            memset(apart_q16, 0, DROGUE_PARAMETERS * sizeof *apart_q16);
            return;
        }
    }
}

/* What the inner part's size adds to the covariance of x, y, z, where that holds it; else zero. */
static void doubt_held(drogue_real doubt[DROGUE_DOUBT_PACKED], const drogue_result *result,
                       const int64_t apart_q16[DROGUE_PARAMETERS], drogue_q16 rim_radius_m_q16)
{
    const int exponent = halved(result) - 48;
    int p;
    memset(doubt, 0, DROGUE_DOUBT_PACKED * sizeof *doubt);
    drogue_doubt_add(doubt, result->pose.position_m_q16, result->doubt_q16, rim_radius_m_q16);
    for (p = 0; p < 3; p++) {
        drogue_real own;
        drogue_real_set(&own, result->covariance_q48[p][p] - half_product_q48(apart_q16, p, p, result), exponent);
        if (drogue_real_order(&doubt[DROGUE_PACKED(p, p)], &own) >= 0) {
            memset(doubt, 0, DROGUE_DOUBT_PACKED * sizeof *doubt);
            return;
        }
    }
}

/* Noise from the result's covariance, without the distance of the twins: the filter follows one of them; and without
 * the doubt by the inner part's size, which is no noise: it lasts from frame to frame. The pose's twin has the same
 * variances and the same correlations of position; those of its angles are its own, not known, and count as none. */
static void measured_noise(drogue_measurement *m, const drogue_result *result, int twin, drogue_q16 rim_radius_m_q16,
                           const drogue_track_config *c)
{
    const int exponent = halved(result) - 48;
    int64_t apart_q16[DROGUE_PARAMETERS];
    drogue_real doubt[DROGUE_DOUBT_PACKED];
    int p;
    int q;
    twins_apart(apart_q16, result);
    doubt_held(doubt, result, apart_q16, rim_radius_m_q16);
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        const int64_t own_q48 = result->covariance_q48[order[p]][order[p]];
        drogue_real *variance = &m->noise[DROGUE_PACKED(p, p)];
        drogue_real own;
        drogue_real_set(&m->apart[p], half_product_q48(apart_q16, p, p, result), exponent);
        drogue_real_set_q16(variance,
                            drogue_at_least_one(p == DROGUE_PITCH || p == DROGUE_YAW ? c->angle_floor_rad_q16
                                                                                     : c->position_floor_m_q16));
        drogue_real_product(variance, variance, variance);
        drogue_real_set(&own, own_q48 > 0 ? own_q48 : 0, exponent);
        drogue_real_difference(&own, &own, &m->apart[p]);
        if (p < DROGUE_PITCH) {
            m->doubt[p] = doubt[DROGUE_PACKED(p, p)];
            drogue_real_difference(&own, &own, &m->doubt[p]);
        }
        drogue_real_sum(variance, &own, variance);
        drogue_real_root(&own, variance);
        m->std_q16[p] = drogue_at_least_one(drogue_real_to_q16(own));
        for (q = 0; q < p && !(twin && p > DROGUE_Z); q++) {
            drogue_real *both = &m->noise[DROGUE_PACKED(p, q)];
            drogue_real_set(both, result->covariance_q48[order[p]][order[q]], exponent);
            drogue_real_set(&own, half_product_q48(apart_q16, p, q, result), exponent);
            drogue_real_difference(both, both, &own);
            if (p < DROGUE_PITCH) {
                drogue_real_difference(both, both, &doubt[DROGUE_PACKED(p, q)]);
            }
        }
    }
}

static int is_cut(const drogue_result *result)
{
    return result->second_look > DROGUE_SECOND_BETTER && result->second_look != DROGUE_SECOND_ROOM;
}

/* An outline that its region cut and no second look made whole may be another than it seems: what it lacks of its
 * circumference, by third parts, is off beside its own noise, in semi-axes sideways, in distances along the axis and in
 * rad. */
static void doubt_if_cut(drogue_measurement *m, const drogue_result *result, drogue_q16 rim_radius_m_q16)
{
    const drogue_q16 lacking_q16 = drogue_q16_sub(DROGUE_Q16_ONE, result->cover_q16) / 3;
    int p;
    if (!is_cut(result)) {
        return;
    }
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        drogue_real *variance = &m->noise[DROGUE_PACKED(p, p)];
        drogue_real more;
        drogue_real_set_q16(&more, lacking_q16);
        if (p <= DROGUE_Z) {
            drogue_real of;
            drogue_real_set_q16(&of, p == DROGUE_Z ? m->value_q16[p] : rim_radius_m_q16);
            drogue_real_product(&more, &more, &of);
        }
        drogue_real_product(&more, &more, &more);
        drogue_real_sum(variance, variance, &more);
        drogue_real_root(&more, variance);
        m->std_q16[p] = drogue_at_least_one(drogue_real_to_q16(more));
    }
}

void drogue_measurement_read(drogue_measurement *m, const drogue_result *result, int twin, const drogue_model *model,
                             const drogue_track_config *c)
{
    const drogue_pose *pose = twin ? &result->alternative : &result->pose;
    memset(m, 0, sizeof *m);
    m->solid = result->has_inner || result->orientation_resolved || model->inner_radius_m_q16 == 0;
    m->value_q16[DROGUE_X] = pose->position_m_q16[0];
    m->value_q16[DROGUE_Y] = pose->position_m_q16[1];
    m->value_q16[DROGUE_Z] = pose->position_m_q16[2];
    m->value_q16[DROGUE_PITCH] = pose->pitch_rad_q16;
    m->value_q16[DROGUE_YAW] = pose->yaw_rad_q16;
    if (result->covariance_q48[0][0] > 0) {
        measured_noise(m, result, twin, model->rim_radius_m_q16, c);
    } else {
        configured_noise(m, c);
    }
    doubt_if_cut(m, result, model->rim_radius_m_q16);
}
