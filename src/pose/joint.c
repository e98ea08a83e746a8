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

#define STEEPEST (DROGUE_JOINT_ONE << 10) /* semi-axes, or focal lengths, a radius or radian */

/* Is every row small enough for the normal equations? */
static int measurable(const drogue_joint_rows *rows)
{
    int p;
    int i;
    for (p = 0; p <= FIT; p++) {
        for (i = 0; i < DROGUE_JOINT_ROWS; i++) {
            DROGUE_NOTE("joint: row", rows->column[p][i], 61);
            if (rows->column[p][i] > STEEPEST || rows->column[p][i] < -STEEPEST) {
                return 0;
            }
        }
    }
    return 1;
}

/* Weighted products of all columns with each other, packed: the normal equations, their negative right side, and chi2.
 * Angles get the information 1 / rad^2, which only matters where nothing else says anything. */
static void normal_equations(drogue_wide normal[CHI2 + 1], const drogue_joint_rows *rows, const drogue_joint_weights *w)
{
    const int drop = 50; /* columns below 2^52, weights below 2^58: sums of five, below 2^113, fit 63 bits */
    drogue_wide one;
    int64_t weighted[DROGUE_JOINT_ROWS];
    int i;
    int p;
    int q;
    drogue_wide_set(&one, 1, 0);
    for (p = 0; p <= FIT; p++) {
        const int64_t *column = rows->column[p];
        for (i = 0; i < DROGUE_JOINT_ROWS; i++) {
            weighted[i] = drogue_s128_shr_round(i < FIT ? drogue_joint_products(w->outline[i], column, FIT)
                                                        : drogue_s128_mul(w->inner[i - FIT], column[i]),
                                                drop);
        }
        for (q = 0; q <= p; q++) {
            drogue_wide *sum = &normal[DROGUE_PACKED(p, q)];
            const int64_t *other = rows->column[q];
            const drogue_s128 total = drogue_s128_add(drogue_joint_products(weighted, other, FIT),
                                                      drogue_joint_products(weighted + FIT, other + FIT, 2));
            drogue_wide_set_s128(sum, total.hi, total.lo, w->exponent + drop - 2 * DROGUE_JOINT_FRAC);
            if (p == q && (p == 3 || p == 4)) {
                drogue_wide_sum(sum, sum, &one);
            }
        }
    }
}

static int64_t limited(int64_t v, int64_t most) { return v > most ? most : v < -most ? -most : v; }

/* One step, at most half a radian in each angle and half the distance in each direction, so that no step passes the
 * camera. Returns whether it is small. */
static int move(drogue_joint_state *s, const drogue_wide step[FIT])
{
    const int64_t half = s->position[2] / 2;
    const int64_t right_angle = drogue_shl_s64(DROGUE_Q16_HALF_PI, DROGUE_JOINT_FRAC - 16);
    const int64_t near = s->position[2] >> SETTLED_BITS;
    int is_small = 1;
    int k;
    for (k = 0; k < 3; k++) {
        const int64_t v = limited(drogue_wide_to_s64(step[k], DROGUE_JOINT_FRAC), half);
        is_small = is_small && v == limited(v, near);
        s->position[k] += v;
    }
    for (k = 0; k < 2; k++) {
        const int64_t v = limited(drogue_wide_to_s64(step[3 + k], DROGUE_JOINT_FRAC), DROGUE_JOINT_ONE);
        is_small = is_small && v == limited(v, DROGUE_JOINT_ONE >> SETTLED_BITS);
        s->angle[k] = limited(s->angle[k] + limited(v, DROGUE_JOINT_ONE / 2), right_angle);
    }
    drogue_joint_turn(s);
    return is_small;
}

/* Inverse of the normal equations; lengths from radii to metres. */
static void put_covariance(drogue_wide out[DROGUE_PACKED_MAX], const drogue_wide *root, drogue_q16 radius_m_q16)
{
    drogue_wide radius;
    int i;
    int j;
    drogue_wide_set_q16(&radius, radius_m_q16);
    drogue_cholesky_invert(out, root, FIT);
    for (i = 0; i < FIT; i++) {
        for (j = 0; j < 3; j++) {
            drogue_wide *entry = &out[DROGUE_PACKED(i, j)];
            if (i >= j) {
                drogue_wide_product(entry, entry, &radius);
            }
            if (i <= j) {
                drogue_wide_product(entry, entry, &radius);
            }
        }
    }
}

static drogue_status finish(drogue_pose *out, const drogue_joint_state *s, drogue_q16 radius_m_q16)
{
    int k;
    for (k = 0; k < 3; k++) {
        const int64_t p_q16 = drogue_mul_shr_round_s64(s->position[k], radius_m_q16, DROGUE_JOINT_FRAC);
        out->position_m_q16[k] = drogue_sat_s32(p_q16);
        out->axis_q16[k] = (drogue_q16)drogue_shr_round_s64(s->axis[k], DROGUE_JOINT_FRAC - 16);
        if (p_q16 >= DROGUE_Q16_MAX || p_q16 <= DROGUE_Q16_MIN) {
            return DROGUE_E_DOMAIN;
        }
    }
    out->yaw_rad_q16 = (drogue_q16)drogue_shr_round_s64(s->angle[0], DROGUE_JOINT_FRAC - 16);
    out->pitch_rad_q16 = (drogue_q16)drogue_shr_round_s64(s->angle[1], DROGUE_JOINT_FRAC - 16);
    return s->position[2] > 0 ? DROGUE_OK : DROGUE_E_BEHIND_CAMERA;
}

drogue_status drogue_joint_solve(drogue_joint *out, const drogue_pose *start, const drogue_joint_outline *outline,
                                 const drogue_joint_inner *inner, const drogue_camera *camera,
                                 const drogue_model *model, int steps)
{
    drogue_wide normal[CHI2 + 1];
    drogue_joint_weights weights;
    drogue_joint_frame frame;
    drogue_joint_rows rows;
    drogue_joint_state s;
    int last = 0;
    int step;
    drogue_status status = drogue_joint_weigh(&weights, normal, out->covariance, outline, inner, camera);
    if (status == DROGUE_OK && start->position_m_q16[2] <= 0) {
        status = DROGUE_E_BEHIND_CAMERA;
    }
    if (status == DROGUE_OK) {
        status = drogue_joint_begin(&s, &frame, start, &outline->ellipse, camera, model);
    }
    for (step = 0; !last && status == DROGUE_OK; step++) { /* bound: steps + 1 */
        status = drogue_joint_outline_rows(&rows, &s, &frame);
        if (status == DROGUE_OK && inner->std_px_q16 > 0) {
            status = drogue_joint_inner_rows(&rows, &s, inner, camera, model);
        }
        if (status == DROGUE_OK && !measurable(&rows)) {
            status = DROGUE_E_DOMAIN;
        }
        if (status != DROGUE_OK) {
            break;
        }
        normal_equations(normal, &rows, &weights);
        status = drogue_cholesky_factor(normal, FIT);
        last = step == steps;
        if (status == DROGUE_OK && steps > 0) {
            drogue_wide *down = &normal[RIGHT];
            int k;
            drogue_cholesky_solve(down, normal, FIT);
            for (k = 0; k < FIT; k++) {
                drogue_wide_negate(&down[k]);
            }
            last = move(&s, down) || last;
        }
    }
    if (status != DROGUE_OK) {
        return status;
    }
    put_covariance(out->covariance, normal, model->rim_radius_m_q16);
    out->chi2 = normal[CHI2];
    return finish(&out->pose, &s, model->rim_radius_m_q16);
}
