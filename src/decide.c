/* SPDX-License-Identifier: Apache-2.0 */
/* Choice between the two poses by outline and inner part together. */
#include "drogue/decide.h"

static int64_t q48_of(drogue_wide v) { return drogue_wide_to_s64(v, 48); }

static void put_covariance(drogue_result *out, const drogue_joint *joint)
{
    drogue_wide angle2;
    int32_t s_q30;
    int32_t c_q30;
    drogue_wide c;
    int i;
    int j;
    for (i = 0; i < 5; i++) {
        for (j = 0; j < 5; j++) {
            out->covariance_q48[i][j] = q48_of(joint->covariance[DROGUE_PACKED(i, j)]);
        }
    }
    for (i = 0; i < 3; i++) {
        out->position_std_m_q32[i] = drogue_wide_to_s64(drogue_wide_sqrt(joint->covariance[DROGUE_PACKED(i, i)]), 32);
    }
    drogue_sincos_q30(&s_q30, &c_q30, (int32_t)drogue_shl_s64(joint->pose.pitch_rad_q16, 13));
    c = drogue_wide_from_s64(c_q30, -30);
    angle2 = drogue_wide_add(drogue_wide_mul(joint->covariance[DROGUE_PACKED(3, 3)], drogue_wide_mul(c, c)),
                             joint->covariance[DROGUE_PACKED(4, 4)]);
    out->axis_std_rad_q32 = drogue_wide_to_s64(drogue_wide_sqrt(angle2), 32);
}

/* Do two solutions differ by less than their standard deviations? Then there is nothing to choose. */
static int same_solution(const drogue_joint *p, const drogue_joint *q)
{
    const drogue_wide yaw = drogue_wide_from_s64((int64_t)p->pose.yaw_rad_q16 - q->pose.yaw_rad_q16, -16);
    const drogue_wide pitch = drogue_wide_from_s64((int64_t)p->pose.pitch_rad_q16 - q->pose.pitch_rad_q16, -16);
    return drogue_wide_cmp(drogue_wide_mul(yaw, yaw), p->covariance[DROGUE_PACKED(3, 3)]) <= 0 &&
           drogue_wide_cmp(drogue_wide_mul(pitch, pitch), p->covariance[DROGUE_PACKED(4, 4)]) <= 0;
}

#define STEPS 5       /* most Gauss-Newton steps of the pose taken: the start is within a few degrees */
#define OTHER_STEPS 1 /* of the other one, of which only matters how much worse it is and whether it is the same */

/* Solve from the pose nearer to the inner part, and far enough from the other one to know how much worse it is. */
static drogue_status solve_both(drogue_joint joint[2], uint32_t *best, const drogue_pose poses[2],
                                const drogue_joint_outline *outline, const drogue_joint_inner *inner,
                                const drogue_camera *camera, const drogue_model *model, uint32_t nearer)
{
    const int with_inner = inner->std_px_q16 > 0;
    drogue_status status =
        drogue_joint_solve(&joint[nearer], &poses[nearer], outline, inner, camera, model, with_inner ? STEPS : 0);
    *best = nearer;
    if (status == DROGUE_OK) {
        status = drogue_joint_solve(&joint[1 - nearer], &poses[1 - nearer], outline, inner, camera, model,
                                    with_inner ? OTHER_STEPS : 0);
    }
    if (status == DROGUE_OK && drogue_wide_cmp(joint[1 - nearer].chi2, joint[nearer].chi2) < 0) {
        *best = 1 - nearer;
        status = drogue_joint_solve(&joint[*best], &poses[*best], outline, inner, camera, model, STEPS);
    }
    return status;
}

drogue_status drogue_decide(drogue_result *out, const drogue_pose poses[2], uint32_t nearer,
                            const drogue_support *support, const drogue_joint_inner *inner, const drogue_config *config,
                            const drogue_camera *camera, const drogue_model *model)
{
    const drogue_joint_inner none = {0, 0, 0};
    drogue_joint_outline outline;
    drogue_joint joint[2];
    drogue_status status;
    uint32_t best = 0;
    int trusted = inner->std_px_q16 > 0;
    outline.ellipse = out->ideal;
    status = drogue_joint_outline_covariance(&outline, support, config->outline_shading_q16,
                                             config->optics_blur_std_px2_q16);
    if (status != DROGUE_OK) {
        return DROGUE_E_DOMAIN;
    }
    if (trusted) {
        status = solve_both(joint, &best, poses, &outline, inner, camera, model, nearer);
        trusted =
            status == DROGUE_OK && drogue_wide_cmp(joint[best].chi2, drogue_wide_from_q16(config->max_chi2_q16)) <= 0;
    }
    if (!trusted) {
        status = solve_both(joint, &best, poses, &outline, &none, camera, model, nearer);
    }
    if (status != DROGUE_OK) {
        return DROGUE_E_DOMAIN;
    }
    out->orientation_resolved = trusted && (same_solution(&joint[best], &joint[1 - best]) ||
                                            drogue_wide_cmp(drogue_wide_sub(joint[1 - best].chi2, joint[best].chi2),
                                                            drogue_wide_from_q16(config->min_chi2_gap_q16)) >= 0);
    out->pose = joint[best].pose;
    out->alternative = joint[1 - best].pose;
    put_covariance(out, &joint[best]);
    return DROGUE_OK;
}
