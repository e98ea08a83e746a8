/* SPDX-License-Identifier: Apache-2.0 */
/* Measurement model of the joint pose: a circle seen in the frame of an ellipse.
 *
 * With n the axis, c the centre and d = n.c, the ray p meets the circle's plane at p d / (n.p). That point lies on the
 * circle of radius r when |d p - (n.p) c|^2 = (r n.p)^2: a quadratic form of the ray's lift (d p - (n.p) c, r n.p),
 * which is linear in the ray and, near the circle's image, as small as the circle is. */
#include "joint_model.h"

#include <string.h>

#include "drogue/ellipse.h"

#define FARTHEST 16                   /* an outline of 1 px is nearer than 2^16 radii with any focal length in Q16 */
#define NEAREST (-8)                  /* finest scale of a position */
#define LIFT_LIMIT (INT64_C(1) << 30) /* 4 radii, Q28 */

static const drogue_real one = DROGUE_REAL_ONE;

static int32_t mul_q30(int32_t a, int32_t b) { return (int32_t)drogue_shr_round_s64(drogue_product(a, b), 30); }

/* a . b / 2^30; |a| <= 1 Q30 */
static int32_t dot_q30(const int32_t a_q30[3], const int32_t b[3])
{
    return (int32_t)drogue_shr_round_s64((int64_t)a_q30[0] * b[0] + (int64_t)a_q30[1] * b[1] + (int64_t)a_q30[2] * b[2],
                                         30);
}

int drogue_joint_squeeze(int32_t *out, const int64_t *in, int n)
{
    uint64_t all = 0;
    int shift;
    int i;
    for (i = 0; i < n; i++) {
        all |= drogue_abs_u64(in[i]);
    }
    shift = all == 0 ? 0 : 34 - drogue_clz_u64(all);
    for (i = 0; i < n; i++) {
        if (shift > 0) { /* to 32 bits, then rounded */
            const int32_t twice = (int32_t)(in[i] >> (shift - 1));
            out[i] = (twice >> 1) + (twice & 1);
        } else {
            out[i] = (int32_t)drogue_shl_s64(in[i], -shift);
        }
    }
    return shift;
}

void drogue_joint_turn(drogue_joint_state *s)
{
    int32_t sy;
    int32_t cy;
    int32_t sp;
    int32_t cp;
    drogue_sincos_q30(&sy, &cy, s->angle_rad_q29[0]);
    drogue_sincos_q30(&sp, &cp, s->angle_rad_q29[1]);
    s->axis_q30[0] = mul_q30(sy, cp);
    s->axis_q30[1] = sp;
    s->axis_q30[2] = mul_q30(cy, cp);
    s->turn_q30[0][0] = s->axis_q30[2];
    s->turn_q30[0][1] = 0;
    s->turn_q30[0][2] = -s->axis_q30[0];
    s->turn_q30[1][0] = -mul_q30(sy, sp);
    s->turn_q30[1][1] = cp;
    s->turn_q30[1][2] = -mul_q30(cy, sp);
}

void drogue_joint_rescale(drogue_joint_state *s)
{
    const int64_t position[3] = {s->position_q30[0], s->position_q30[1], s->position_q30[2]};
    const int shift = drogue_joint_squeeze(s->position_q30, position, 3);
    s->scale += shift;
    if (s->scale < NEAREST) {
        int k;
        for (k = 0; k < 3; k++) {
            s->position_q30[k] = (int32_t)drogue_shr_round_s64(s->position_q30[k], NEAREST - s->scale);
        }
        s->scale = NEAREST;
    }
}

drogue_status drogue_joint_place(drogue_joint_state *s, const drogue_pose *pose, const drogue_model *model)
{
    drogue_real position[3];
    int k;
    s->scale = NEAREST;
    for (k = 0; k < 3; k++) {
        drogue_real_ratio(&position[k], pose->position_m_q16[k], model->rim_radius_m_q16);
        if (position[k].mantissa != 0 && position[k].exponent + 31 > s->scale) {
            s->scale = position[k].exponent + 31;
        }
    }
    for (k = 0; k < 3; k++) {
        s->position_q30[k] = drogue_real_to_s32(position[k], 30 - s->scale);
    }
    if (s->scale > FARTHEST || !drogue_pose_angles_valid(pose)) {
        return DROGUE_E_DOMAIN;
    }
    s->angle_rad_q29[0] = (int32_t)drogue_shl_s64(pose->yaw_rad_q16, 13);
    s->angle_rad_q29[1] = (int32_t)drogue_shl_s64(pose->pitch_rad_q16, 13);
    drogue_joint_turn(s);
    return DROGUE_OK;
}

void drogue_joint_size_disc(drogue_joint_frame *frame, const drogue_model *model)
{
    drogue_real_ratio(&frame->depth, model->inner_depth_m_q16, model->rim_radius_m_q16);
    drogue_real_ratio(&frame->radius, model->inner_radius_m_q16, model->rim_radius_m_q16);
}

/* Component of a ray, length px times factor Q30 over the focal length; 1 where it is within two focal lengths. */
static int put_ray(int32_t *out_q29, int64_t length_px_q16, int32_t factor_q30, drogue_q16 focal_px_q16)
{
    const int32_t limit = 1 << 30;
    drogue_real ray;
    drogue_real factor;
    int32_t v;
    drogue_real_ratio(&ray, length_px_q16, focal_px_q16);
    drogue_real_set(&factor, factor_q30, -30);
    drogue_real_product(&ray, &ray, &factor);
    v = drogue_real_to_s32(ray, 29);
    *out_q29 = v;
    return v < limit && v > -limit;
}

drogue_status drogue_joint_begin(drogue_joint_state *state, drogue_joint_frame *frame, const drogue_pose *pose,
                                 const drogue_ellipse *e, const drogue_joint_inner *inner, const drogue_camera *camera,
                                 const drogue_model *model)
{
    const drogue_q16 fx = camera->fx_px_q16;
    const drogue_q16 fy = camera->fy_px_q16;
    int32_t s_q30;
    int32_t c_q30;
    int near_axis;
    memset(frame, 0, sizeof *frame);
    if (!drogue_ellipse_angle_valid(e)) {
        return DROGUE_E_DOMAIN;
    }
    drogue_sincos_of_q16(&s_q30, &c_q30, e->angle_rad_q16);
    near_axis = put_ray(&frame->ray_q29[0][0], e->a_px_q16, c_q30, fx);
    near_axis &= put_ray(&frame->ray_q29[0][1], e->a_px_q16, s_q30, fy);
    near_axis &= put_ray(&frame->ray_q29[1][0], e->b_px_q16, -s_q30, fx);
    near_axis &= put_ray(&frame->ray_q29[1][1], e->b_px_q16, c_q30, fy);
    near_axis &= put_ray(&frame->ray_q29[2][0], (int64_t)e->xc_px_q16 - camera->cx_px_q16, 1 << 30, fx);
    near_axis &= put_ray(&frame->ray_q29[2][1], (int64_t)e->yc_px_q16 - camera->cy_px_q16, 1 << 30, fy);
    frame->ray_q29[2][2] = 1 << 29;
    if (!near_axis) {
        return DROGUE_E_DOMAIN;
    }
    drogue_joint_size_disc(frame, model);
    drogue_real_ratio(&frame->inner[0], (int64_t)inner->x_px_q16 - camera->cx_px_q16, fx);
    drogue_real_ratio(&frame->inner[1], (int64_t)inner->y_px_q16 - camera->cy_px_q16, fy);
    return drogue_joint_place(state, pose, model);
}

/* Lift of a ray, or its derivative: (d p - m c, r m), Q28. */
typedef struct lift {
    int32_t v_q28[4];
} lift;

/* d and c in units of 2^scale radii; 0 when a component is 4 radii or more. */
static int lift_ray(lift *out, int32_t d_q30, const int32_t p_q29[3], int32_t m_q29, const int32_t c_q30[3], int scale)
{
    int fits = 1;
    int k;
    for (k = 0; k < 3; k++) {
        const int64_t v_q28 = drogue_shr_round_s64((int64_t)d_q30 * p_q29[k] - (int64_t)m_q29 * c_q30[k], 31 - scale);
        fits &= v_q28 < LIFT_LIMIT && v_q28 > -LIFT_LIMIT;
        out->v_q28[k] = (int32_t)v_q28;
    }
    out->v_q28[3] = (int32_t)drogue_shr_round_s64(m_q29, 1);
    return fits;
}

/* The form of two lifts, Q54: on the circle that of a lift and itself is 0. */
static int64_t form_q54(const lift *a, const lift *b)
{
    const int64_t form_q56 = (int64_t)a->v_q28[0] * b->v_q28[0] + (int64_t)a->v_q28[1] * b->v_q28[1] +
                             (int64_t)a->v_q28[2] * b->v_q28[2] - (int64_t)a->v_q28[3] * b->v_q28[3];
    DROGUE_NOTE("joint: form, Q56", form_q56, 62);
    return drogue_shr_round_s64(form_q56, 2);
}

/* Conic of three lifts by themselves, doubled; by their derivatives: its derivative. Packed. */
static void conic_of(int64_t q_q54[6], const lift a[3], const lift b[3])
{
    int i;
    int j;
    for (i = 0; i < 3; i++) {
        for (j = 0; j <= i; j++) {
            const int64_t half = form_q54(&a[i], &b[j]);
            q_q54[DROGUE_PACKED(i, j)] = half + (i == j ? half : form_q54(&b[i], &a[j]));
        }
    }
}

/* Coefficients of 1, cos t, sin t, cos 2t, sin 2t of a conic on the unit circle, and its size: dF/dr there, constant to
 * first order. Their common exponent returns. */
static int harmonics(int32_t h[DROGUE_JOINT_FIT + 1], const int64_t q_q54[6])
{
    int64_t wide[DROGUE_JOINT_FIT + 1];
    wide[5] = q_q54[0] + q_q54[2];
    wide[0] = drogue_shr_round_s64(wide[5], 1) + q_q54[5];
    wide[1] = 2 * q_q54[3];
    wide[2] = 2 * q_q54[4];
    wide[3] = drogue_shr_round_s64(q_q54[0] - q_q54[2], 1);
    wide[4] = q_q54[1];
    return drogue_joint_squeeze(h, wide, DROGUE_JOINT_FIT + 1) - 54;
}

/* Derivatives of the lifts by parameter p. */
static int turn_lifts(lift out[3], int p, const drogue_joint_state *s, const drogue_joint_frame *frame)
{
    static const int32_t nowhere[3] = {0, 0, 0};
    int fits = 1;
    int i;
    for (i = 0; i < 3; i++) {
        const int32_t *ray = frame->ray_q29[i];
        if (p < 3) {
            fits &= lift_ray(&out[i], s->axis_q30[p], ray, 0, nowhere, 0);
            out[i].v_q28[p] -= (int32_t)drogue_shr_round_s64(dot_q30(s->axis_q30, ray), 1);
        } else {
            const int32_t *turn = s->turn_q30[p - 3];
            fits &=
                lift_ray(&out[i], dot_q30(turn, s->position_q30), ray, dot_q30(turn, ray), s->position_q30, s->scale);
        }
    }
    return fits;
}

/* Where the circle's image lies off the fitted ellipse, r(t) of joint.h, and how that changes with the pose: the
 * harmonics of the form over its size, less what the change of that size takes with it. */
drogue_status drogue_joint_outline_rows(drogue_joint_rows *out, const drogue_joint_state *s,
                                        const drogue_joint_frame *frame)
{
    const int64_t smallest_q54 = INT64_C(1) << 38;
    const int32_t d_q30 = dot_q30(s->axis_q30, s->position_q30);
    drogue_joint_column *const residual = &out->column[DROGUE_JOINT_FIT];
    int32_t residual_q29[DROGUE_JOINT_FIT];
    int32_t h[DROGUE_JOINT_FIT + 1];
    drogue_real over;
    drogue_real t;
    lift at[3];
    lift by[3];
    int64_t q_q54[6];
    int fits = s->scale <= FARTHEST;
    int p;
    int i;
    for (i = 0; i < 3 && fits; i++) {
        fits = lift_ray(&at[i], d_q30, frame->ray_q29[i], dot_q30(s->axis_q30, frame->ray_q29[i]), s->position_q30,
                        s->scale);
    }
    if (!fits) {
        return DROGUE_E_DOMAIN;
    }
    conic_of(q_q54, at, at);
    if (q_q54[0] + q_q54[2] < smallest_q54) {
        return DROGUE_E_DOMAIN;
    }
    drogue_real_set(&over, q_q54[0] + q_q54[2], -54);
    drogue_real_quotient(&over, &one, &over);
    residual->exponent = harmonics(h, q_q54) + over.exponent + 31;
    for (i = 0; i < DROGUE_JOINT_FIT; i++) {
        residual->outline[i] = -(int32_t)drogue_shr_round_s64(drogue_product(h[i], over.mantissa), 31);
        drogue_real_set(&t, residual->outline[i], residual->exponent);
        residual_q29[i] = drogue_real_to_s32(t, 29);
        if (residual_q29[i] >= 1 << 30 || residual_q29[i] <= -(1 << 30)) {
            return DROGUE_E_DOMAIN; /* two semi-axes off */
        }
    }
    for (p = 0; p < DROGUE_JOINT_FIT; p++) {
        drogue_joint_column *const column = &out->column[p];
        if (!turn_lifts(by, p, s, frame)) {
            return DROGUE_E_DOMAIN;
        }
        conic_of(q_q54, at, by);
        column->exponent = harmonics(h, q_q54) + over.exponent + 33; /* the conic itself is doubled */
        for (i = 0; i < DROGUE_JOINT_FIT; i++) {
            const int64_t own = drogue_shl_s64(h[i], 29) + (int64_t)residual_q29[i] * h[DROGUE_JOINT_FIT];
            column->outline[i] = -(int32_t)drogue_shr_round_s64(drogue_shr_round_s64(own, 30) * over.mantissa, 31);
            DROGUE_NOTE("joint: row", column->outline[i], 31);
        }
    }
    return DROGUE_OK;
}
