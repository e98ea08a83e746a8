/* SPDX-License-Identifier: Apache-2.0 */
/* Choice between the two poses by outline and inner part together. */
#include "drogue/decide.h"
#include "joint_model.h"

#include <string.h>

#define MOST_BITS 15 /* of a variance in Q48 before the point */

/* A variance too large for Q48 shifts all entries down: none saturates by itself, which no covariance would bear. */
static void put_covariance(drogue_decision *out, const drogue_joint *joint)
{
    const drogue_real *yaw = &joint->covariance[DROGUE_PACKED(3, 3)];
    drogue_real t;
    int32_t s_q30;
    int32_t c_q30;
    int32_t top = MOST_BITS;
    int i;
    int j;
    for (i = 0; i < 5; i++) {
        const int32_t own = joint->covariance[DROGUE_PACKED(i, i)].exponent + 31;
        top = own > top ? own : top;
    }
    out->covariance_halved = top - MOST_BITS;
    for (i = 0; i < 5; i++) {
        for (j = 0; j < 5; j++) {
            out->covariance_q48[i][j] =
                drogue_real_to_s64(joint->covariance[DROGUE_PACKED(i, j)], 48 - out->covariance_halved);
        }
    }
    for (i = 0; i < 3; i++) {
        drogue_real_root(&t, &joint->covariance[DROGUE_PACKED(i, i)]);
        out->position_std_m_q32[i] = drogue_real_to_s64(t, 32);
    }
    drogue_sincos_of_q16(&s_q30, &c_q30, joint->pose.pitch_rad_q16);
    drogue_real_set(&t, c_q30, -30);
    drogue_real_product(&t, &t, &t);
    drogue_real_product(&t, yaw, &t);
    drogue_real_sum(&t, &t, &joint->covariance[DROGUE_PACKED(4, 4)]);
    drogue_real_root(&t, &t);
    out->axis_std_rad_q32 = drogue_real_to_s64(t, 32);
}

/* Is the difference of two angles within a variance? */
static int within(drogue_q16 a_rad_q16, drogue_q16 b_rad_q16, const drogue_real *variance)
{
    drogue_real d;
    drogue_real_set(&d, (int64_t)a_rad_q16 - b_rad_q16, -16);
    drogue_real_product(&d, &d, &d);
    return drogue_real_order(&d, variance) <= 0;
}

/* What matters of the solution not taken. */
typedef struct other_solution {
    drogue_q16 yaw_rad_q16;
    drogue_q16 pitch_rad_q16;
    drogue_real chi2;
} other_solution;

static void put_by(other_solution *other, const drogue_joint *joint)
{
    other->yaw_rad_q16 = joint->pose.yaw_rad_q16;
    other->pitch_rad_q16 = joint->pose.pitch_rad_q16;
    other->chi2 = joint->chi2;
}

/* Do two solutions differ by less than their standard deviations? Then there is nothing to choose. */
static int same_solution(const drogue_joint *p, const other_solution *q)
{
    return within(p->pose.yaw_rad_q16, q->yaw_rad_q16, &p->covariance[DROGUE_PACKED(3, 3)]) &&
           within(p->pose.pitch_rad_q16, q->pitch_rad_q16, &p->covariance[DROGUE_PACKED(4, 4)]);
}

#define STEPS 5       /* most Gauss-Newton steps of the pose taken: the start is within a few degrees */
#define OTHER_STEPS 1 /* of the other one, of which only matters how much worse it is and whether it is the same */

/* Solve for outline and inner part from the nearer pose, and far enough from the other one to know how much worse it
 * is; the other way round when it is better. 'agree' tells whether they do; where not, the covariances are too small by
 * chi2, and in that measure the other pose is worse. 'resolved' tells whether that decides. 0 when there is nothing to
 * go by. */
static int solve_together(drogue_joint *best, uint32_t *index, int *agree, int32_t *resolved,
                          const drogue_joint_outline *outline, const drogue_evidence *seen, const drogue_setup *setup)
{
    other_solution other;
    drogue_real limit;
    drogue_status near_status;
    int alone; /* has the other pose no solution? */
    const drogue_status far_status = drogue_joint_settle(best, &seen->poses[1 - *index], outline, &seen->inner,
                                                         setup->camera, setup->model, OTHER_STEPS, 0);
    put_by(&other, best);
    near_status =
        drogue_joint_settle(best, &seen->poses[*index], outline, &seen->inner, setup->camera, setup->model, STEPS, 1);
    if (far_status == DROGUE_OK && (near_status != DROGUE_OK || drogue_real_order(&other.chi2, &best->chi2) < 0)) {
        put_by(&other, best);
        *index = 1 - *index;
        if (drogue_joint_settle(best, &seen->poses[*index], outline, &seen->inner, setup->camera, setup->model, STEPS,
                                1) != DROGUE_OK) {
            return 0;
        }
    } else if (near_status != DROGUE_OK) {
        return 0;
    }
    drogue_real_set_q16(&limit, setup->config->max_chi2_q16);
    *agree = drogue_real_order(&best->chi2, &limit) <= 0;
    drogue_real_difference(&other.chi2, &other.chi2, &best->chi2);
    drogue_real_set_q16(&limit, setup->config->min_chi2_gap_q16);
    if (!*agree) {
        drogue_real_product(&limit, &limit, &best->chi2);
    }
    alone = far_status != DROGUE_OK || near_status != DROGUE_OK;
    *resolved = alone ? *agree : same_solution(best, &other) || drogue_real_order(&other.chi2, &limit) >= 0;
    return *agree || *resolved;
}

/* Unresolved, the truth is as likely the one pose as the other: half the square of what lies between them. */
static void add_spread(drogue_joint *joint, const drogue_pose *other)
{
    const drogue_pose *p = &joint->pose;
    drogue_real apart[5];
    drogue_real half;
    int i;
    int j;
    for (i = 0; i < 3; i++) {
        drogue_real_set(&apart[i], (int64_t)other->position_m_q16[i] - p->position_m_q16[i], -16);
    }
    drogue_real_set(&apart[3], (int64_t)other->yaw_rad_q16 - p->yaw_rad_q16, -16);
    drogue_real_set(&apart[4], (int64_t)other->pitch_rad_q16 - p->pitch_rad_q16, -16);
    for (i = 0; i < 5; i++) {
        for (j = 0; j <= i; j++) {
            drogue_real *sum = &joint->covariance[DROGUE_PACKED(i, j)];
            drogue_real_product(&half, &apart[i], &apart[j]);
            drogue_real_shift(&half, -1);
            drogue_real_sum(sum, sum, &half);
        }
    }
}

drogue_q16 drogue_doubt_outside(drogue_q16 doubt_q16, uint32_t outside)
{
    const int32_t of_outside_q16 = (int32_t)(outside * outside) * DROGUE_Q16(1, 640);
    const uint32_t twice_q16 = drogue_isqrt_u64(4 * drogue_square_sum(doubt_q16, of_outside_q16));
    return drogue_clamp_s32((int32_t)((twice_q16 + 1) / 2), 0, DROGUE_Q16_ONE - 1);
}

void drogue_doubt_add(drogue_real covariance[DROGUE_DOUBT_PACKED], const drogue_q16 position_m_q16[3],
                      drogue_q16 doubt_q16, drogue_q16 rim_radius_m_q16)
{
    drogue_real own;
    drogue_real other;
    int i;
    int j;
    for (i = 0; i < 3; i++) {
        for (j = 0; j <= i; j++) {
            drogue_real *sum = &covariance[DROGUE_PACKED(i, j)];
            drogue_real_set(&own, drogue_product(position_m_q16[i], doubt_q16), -32);
            drogue_real_set(&other, drogue_product(position_m_q16[j], doubt_q16), -33); /* half of it */
            drogue_real_product(&own, &own, &other);
            drogue_real_sum(sum, sum, &own);
        }
    }
    drogue_real_set(&own, drogue_product(rim_radius_m_q16, doubt_q16), -32);
    drogue_real_set_q16(&other, doubt_q16);
    drogue_real_product(&own, &own, &other);
    drogue_real_product(&own, &own, &own);
    drogue_real_shift(&own, 1);
    for (i = 0; i < 2; i++) {
        drogue_real_sum(&covariance[DROGUE_PACKED(i, i)], &covariance[DROGUE_PACKED(i, i)], &own);
    }
}

/* What outline and inner part disagree by, beyond what is usual, is in both: chi2 times their covariance. */
static void widen(drogue_joint *joint)
{
    const drogue_real one = DROGUE_REAL_ONE;
    int i;
    if (drogue_real_order(&joint->chi2, &one) <= 0) {
        return;
    }
    for (i = 0; i < DROGUE_PACKED_MAX; i++) {
        drogue_real_product(&joint->covariance[i], &joint->covariance[i], &joint->chi2);
    }
}

/* An outline within which no inner part is seen may be another edge than the rim, or the rim on one side and another
 * edge on the other: 1.1 % of a semi-axis in every parameter. */
static void doubt_outline(drogue_real covariance[DROGUE_PACKED_MAX])
{
    const drogue_real doubt = {1 << 30, -43}; /* 2^-13 is the square of 1.1 % */
    int i;
    for (i = 0; i < DROGUE_JOINT_FIT; i++) {
        drogue_real *own = &covariance[DROGUE_PACKED(i, i)];
        drogue_real_sum(own, own, &doubt);
    }
}

static int has_inner(const drogue_evidence *evidence) { return evidence->inner.std_px_q16 > 0; }

/* The outline as what is solved for takes it. */
static drogue_status weigh_outline(drogue_joint_outline *outline, const drogue_evidence *evidence,
                                   const drogue_setup *setup)
{
    drogue_real covariance[DROGUE_PACKED_MAX];
    const drogue_status status =
        drogue_joint_outline_covariance(covariance, &evidence->ideal, evidence->support,
                                        setup->config->outline_shading_q16, setup->config->optics_blur_std_px2_q16);
    if (status != DROGUE_OK) {
        return status;
    }
    if (setup->model->inner_radius_m_q16 > 0 && !has_inner(evidence)) {
        doubt_outline(covariance);
    }
    return drogue_joint_outline_weigh(outline, &evidence->ideal, covariance);
}

/* Of the distance: an inner part that contradicts the outline counts as if it were so far off its size. */
static drogue_q16 doubt_of(const drogue_evidence *evidence, int agree)
{
    const drogue_q16 doubt_q16 = has_inner(evidence) ? evidence->doubt_q16 : 0;
    return has_inner(evidence) && !agree && doubt_q16 < DROGUE_CONTRADICTED_Q16 ? DROGUE_CONTRADICTED_Q16 : doubt_q16;
}

/* The share by which the poses are too far: of what place and size say as much as the place is off by more than noise,
 * which it is by a chi2 of 3. */
static drogue_q16 too_far(const drogue_evidence *evidence, drogue_real chi2)
{
    const drogue_q16 smear = drogue_support_smear(evidence->support);
    const int32_t still_q16 = drogue_clamp_s32(DROGUE_SMEARED_Q16 - smear, 0, DROGUE_Q16_ONE);
    const int32_t off_q16 = drogue_clamp_s32((drogue_real_to_q16(chi2) - DROGUE_Q16_ONE) / 2, 0, DROGUE_Q16_ONE);
    return drogue_q16_mul(drogue_q16_mul(evidence->too_far_q16, still_q16), off_q16);
}

static void bring_nearer(drogue_pose *pose, drogue_q16 share_q16)
{
    int i;
    for (i = 0; i < 3; i++) {
        drogue_q16 *p = &pose->position_m_q16[i];
        *p = drogue_q16_sub(*p, drogue_q16_mul(*p, share_q16));
    }
}

drogue_status drogue_decide(drogue_decision *out, const drogue_evidence *evidence, const drogue_setup *setup)
{
    static const drogue_joint_inner none = {0, 0, 0};
    drogue_joint_outline outline;
    drogue_joint joint;
    uint32_t index = evidence->nearer;
    int together = 0;
    int agree = 0;
    drogue_q16 nearer_q16 = 0;
    memset(&joint, 0, sizeof joint);
    out->orientation_resolved = 0;
    if (weigh_outline(&outline, evidence, setup) != DROGUE_OK) {
        return DROGUE_E_DOMAIN;
    }
    if (has_inner(evidence)) {
        together = solve_together(&joint, &index, &agree, &out->orientation_resolved, &outline, evidence, setup);
    }
    if (!together) {
        index = evidence->nearer;
        if (drogue_joint_settle(&joint, &evidence->poses[index], &outline, &none, setup->camera, setup->model, 0, 1) !=
            DROGUE_OK) {
            return DROGUE_E_DOMAIN;
        }
    }
    if (has_inner(evidence)) {
        if (!together) {
            drogue_real_set_q16(&joint.chi2, setup->config->max_chi2_q16);
        }
        widen(&joint);
    }
    if (out->orientation_resolved) { /* else what is dark may be anything */
        nearer_q16 = too_far(evidence, joint.chi2);
    }
    out->alternative = evidence->poses[1 - index];
    bring_nearer(&joint.pose, nearer_q16);
    bring_nearer(&out->alternative, nearer_q16);
    if (joint.pose.position_m_q16[2] <= 0) { /* nearer than numbers go */
        return DROGUE_E_DOMAIN;
    }
    out->pose = joint.pose;
    out->doubt_q16 = doubt_of(evidence, agree);
    out->doubt_q16 = out->doubt_q16 > nearer_q16 ? out->doubt_q16 : nearer_q16;
    out->doubt_q16 = drogue_doubt_outside(out->doubt_q16, evidence->support->outside);
    drogue_doubt_add(joint.covariance, joint.pose.position_m_q16, out->doubt_q16, setup->model->rim_radius_m_q16);
    if (!out->orientation_resolved) {
        add_spread(&joint, &out->alternative);
    }
    put_covariance(out, &joint);
    return DROGUE_OK;
}
