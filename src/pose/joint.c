/* SPDX-License-Identifier: Apache-2.0 */
/* Joint pose of outline and inner part by Gauss-Newton. */
#include "drogue/joint.h"

#include <string.h>

#include "joint_model.h"

#define SETTLED_BITS 20 /* a step that turns by less than 2^-20 rad and moves by less of the distance is the last */
#define FIT DROGUE_JOINT_FIT

/* Index of the residuals' row in the packed normal equations, and of their square. */
#define RIGHT DROGUE_PACKED(FIT, 0)
#define CHI2 DROGUE_PACKED(FIT, FIT)

/* a . b, exact; one within 2^30, the other, a row, within 3 2^29: five products stay below 2^63 */
static int64_t products(const int32_t a[FIT], const int32_t b[FIT])
{
    int64_t sum = 0;
    int k;
    for (k = 0; k < FIT; k++) {
        sum += drogue_product(a[k], b[k]);
    }
    return sum;
}

/* Weighted products of all columns with each other, packed: the normal equations, their negative right side, and chi2.
 * Angles get the information 1 / rad^2, which only matters where nothing else says anything. */
static void normal_equations(drogue_real normal[CHI2 + 1], const drogue_joint_rows *rows, const drogue_joint_outline *w,
                             const drogue_real inner_weight[2])
{
    const drogue_real one = DROGUE_REAL_ONE;
    int i;
    int p;
    int q;
    for (p = 0; p <= FIT; p++) {
        const drogue_joint_column *column = &rows->column[p];
        drogue_real inner[2];
        int32_t weighted[FIT];
        int64_t sum[FIT];
        int32_t exponent;
        for (i = 0; i < FIT; i++) {
            const int32_t *weight = &w->weight[DROGUE_PACKED(i, 0)];
            int64_t own = 0; /* the same bounds */
            for (q = 0; q < i; q++) {
                own += drogue_product(*weight++, column->outline[q]);
            }
            own += drogue_product(*weight, column->outline[i]);
            for (q = i + 1; q < FIT; q++) {
                weight += q; /* to (q, i), packed */
                own += drogue_product(*weight, column->outline[q]);
            }
            sum[i] = own;
        }
        exponent = drogue_joint_squeeze(weighted, sum, FIT) + w->weight_exponent + column->exponent;
        drogue_real_product(&inner[0], &inner_weight[0], &column->inner[0]);
        drogue_real_product(&inner[1], &inner_weight[1], &column->inner[1]);
        for (q = 0; q <= p; q++) {
            const drogue_joint_column *other = &rows->column[q];
            drogue_real *total = &normal[DROGUE_PACKED(p, q)];
            drogue_real own;
            drogue_real_set(&own, products(weighted, other->outline), exponent + other->exponent);
            drogue_real_products(total, &inner[0], &other->inner[0], &inner[1], &other->inner[1]);
            drogue_real_sum(total, total, &own);
            if (p == q && (p == 3 || p == 4)) {
                drogue_real_sum(total, total, &one);
            }
        }
    }
}

static int32_t limited(int32_t v, int32_t most) { return drogue_clamp_s32(v, -most, most); }

/* One step, at most half a radian in each angle and half the distance in each direction, so that no step passes the
 * camera. Returns whether it is small. */
static int move(drogue_joint_state *s, const drogue_real step[FIT])
{
    const int32_t half = s->position_q30[2] / 2;
    const int32_t near = s->position_q30[2] >> SETTLED_BITS;
    const int32_t right_angle_q29 = 843314857;
    int is_small = 1;
    int k;
    for (k = 0; k < 3; k++) {
        const int32_t v = limited(drogue_real_to_s32(step[k], 30 - s->scale), half);
        is_small = is_small && v == limited(v, near);
        s->position_q30[k] += v; /* below 1, moved by less than a half */
    }
    drogue_joint_rescale(s);
    for (k = 0; k < 2; k++) {
        const int32_t v_q29 = limited(drogue_real_to_s32(step[3 + k], 29), 1 << 28);
        is_small = is_small && v_q29 == limited(v_q29, 1 << (29 - SETTLED_BITS));
        s->angle_rad_q29[k] = limited(drogue_sat_s32((int64_t)s->angle_rad_q29[k] + v_q29), right_angle_q29);
    }
    drogue_joint_turn(s);
    return is_small;
}

/* Inverse of the normal equations; lengths from radii to metres. */
static void put_covariance(drogue_real out[DROGUE_PACKED_MAX], const drogue_real *root, drogue_q16 radius_m_q16)
{
    drogue_real radius;
    int i;
    int j;
    drogue_real_set_q16(&radius, radius_m_q16);
    drogue_cholesky_invert(out, root, FIT);
    for (i = 0; i < FIT; i++) {
        for (j = 0; j < 3; j++) {
            drogue_real *entry = &out[DROGUE_PACKED(i, j)];
            if (i >= j) {
                drogue_real_product(entry, entry, &radius);
            }
            if (i <= j) {
                drogue_real_product(entry, entry, &radius);
            }
        }
    }
}

static drogue_status finish(drogue_pose *out, const drogue_joint_state *s, drogue_q16 radius_m_q16)
{
    int k;
    for (k = 0; k < 3; k++) {
        const int64_t p_q16 = drogue_shr_round_s64((int64_t)s->position_q30[k] * radius_m_q16, 30 - s->scale);
        out->position_m_q16[k] = drogue_sat_s32(p_q16);
        out->axis_q16[k] = (drogue_q16)drogue_shr_round_s64(s->axis_q30[k], 14);
        if (p_q16 >= DROGUE_Q16_MAX || p_q16 <= DROGUE_Q16_MIN) {
            return DROGUE_E_DOMAIN;
        }
    }
    out->yaw_rad_q16 = (drogue_q16)drogue_shr_round_s64(s->angle_rad_q29[0], 13);
    out->pitch_rad_q16 = (drogue_q16)drogue_shr_round_s64(s->angle_rad_q29[1], 13);
    return out->position_m_q16[2] > 0 ? DROGUE_OK : DROGUE_E_BEHIND_CAMERA; /* or nearer than numbers go */
}

drogue_status drogue_joint_settle(drogue_joint *out, const drogue_pose *start, const drogue_joint_outline *outline,
                                  const drogue_joint_inner *inner, const drogue_camera *camera,
                                  const drogue_model *model, int steps, int with_covariance)
{
    drogue_real normal[CHI2 + 1];
    drogue_real inner_weight[2];
    drogue_joint_frame frame;
    drogue_joint_rows rows;
    drogue_joint_state s;
    int last = 0;
    int step;
    drogue_status status = start->position_m_q16[2] > 0 ? DROGUE_OK : DROGUE_E_BEHIND_CAMERA;
    drogue_joint_weigh_inner(inner_weight, inner, camera);
    if (status == DROGUE_OK) {
        status = drogue_joint_begin(&s, &frame, start, &outline->ellipse, inner, camera, model);
    }
    memset(&rows, 0, sizeof rows);                         /* no inner part */
    for (step = 0; !last && status == DROGUE_OK; step++) { /* bound: steps + 1 */
        status = drogue_joint_outline_rows(&rows, &s, &frame);
        if (status == DROGUE_OK && inner->std_px_q16 > 0) {
            status = drogue_joint_inner_rows(&rows, &s, &frame);
        }
        if (status != DROGUE_OK) {
            break;
        }
        normal_equations(normal, &rows, outline, inner_weight);
        status = drogue_cholesky_factor(normal, FIT);
        last = step == steps;
        if (status == DROGUE_OK && steps > 0) {
            drogue_real *down = &normal[RIGHT];
            int k;
            drogue_cholesky_solve(down, normal, FIT);
            for (k = 0; k < FIT; k++) {
                drogue_real_negate(&down[k]);
            }
            last = move(&s, down) || last;
        }
    }
    if (status != DROGUE_OK) {
        return status;
    }
    if (with_covariance) {
        put_covariance(out->covariance, normal, model->rim_radius_m_q16);
    }
    out->chi2 = normal[CHI2];
    return finish(&out->pose, &s, model->rim_radius_m_q16);
}

drogue_status drogue_joint_solve(drogue_joint *out, const drogue_pose *start, const drogue_joint_outline *outline,
                                 const drogue_joint_inner *inner, const drogue_camera *camera,
                                 const drogue_model *model, int steps)
{
    return drogue_joint_settle(out, start, outline, inner, camera, model, steps, 1);
}
