/* SPDX-License-Identifier: Apache-2.0 */
/* Measurement model of the joint pose: a circle seen in the frame of an ellipse.
 *
 * With n the axis, c the centre and d = n.c, the ray p meets the circle's plane at p d / (n.p). That point lies on the
 * circle of radius r when |d p - (n.p) c|^2 = (r n.p)^2: a quadratic form of the ray's lift (d p - (n.p) c, r n.p),
 * which is linear in the ray and, near the circle's image, as small as the circle is. */
#include "joint_model.h"

#include <string.h>

#define LARGEST (INT64_C(1) << 60)
#define FARTHEST (DROGUE_JOINT_ONE << 16) /* radii; an outline of 1 px is nearer with any focal length in Q16 */
#define WIDEST (DROGUE_JOINT_ONE << 6)    /* focal lengths off the axis */

static int64_t limited(int64_t v, int64_t most) { return v > most ? most : v < -most ? -most : v; }

/* Q84 -> Q42 */
static int64_t rounded(drogue_s128 v)
{
    const int64_t most = LARGEST >> (64 - DROGUE_JOINT_FRAC);
    return v.hi >= most ? LARGEST : v.hi < -most ? -LARGEST : drogue_s128_shr_round(v, DROGUE_JOINT_FRAC);
}

static int64_t dot(const int64_t a[3], const int64_t b[3]) { return rounded(drogue_joint_products(a, b, 3)); }

static int64_t mul(int64_t a, int64_t b) { return rounded(drogue_s128_mul(a, b)); }

/* a b - c d */
static int64_t det(int64_t a, int64_t b, int64_t c, int64_t d)
{
    return rounded(drogue_s128_sub(drogue_s128_mul(a, b), drogue_s128_mul(c, d)));
}

int64_t drogue_joint_ratio(int64_t num, int64_t den)
{
    drogue_wide q;
    drogue_wide d;
    drogue_wide_set(&q, num, 0);
    drogue_wide_set(&d, den, 0);
    drogue_wide_quotient(&q, &q, &d);
    return limited(drogue_wide_to_s64(q, DROGUE_JOINT_FRAC), LARGEST);
}

void drogue_joint_turn(drogue_joint_state *s)
{
    const int from_q60 = 60 - DROGUE_JOINT_FRAC;
    int32_t sy;
    int32_t cy;
    int32_t sp;
    int32_t cp;
    drogue_sincos_q30(&sy, &cy, (int32_t)drogue_shr_round_s64(s->angle[0], DROGUE_JOINT_FRAC - 29));
    drogue_sincos_q30(&sp, &cp, (int32_t)drogue_shr_round_s64(s->angle[1], DROGUE_JOINT_FRAC - 29));
    s->axis[0] = drogue_shr_round_s64((int64_t)sy * cp, from_q60);
    s->axis[1] = drogue_shl_s64(sp, DROGUE_JOINT_FRAC - 30);
    s->axis[2] = drogue_shr_round_s64((int64_t)cy * cp, from_q60);
    s->turn[0][0] = s->axis[2];
    s->turn[0][1] = 0;
    s->turn[0][2] = -s->axis[0];
    s->turn[1][0] = -drogue_shr_round_s64((int64_t)sy * sp, from_q60);
    s->turn[1][1] = drogue_shl_s64(cp, DROGUE_JOINT_FRAC - 30);
    s->turn[1][2] = -drogue_shr_round_s64((int64_t)cy * sp, from_q60);
}

static int within(const int64_t v[3], int64_t most)
{
    return limited(v[0], most) == v[0] && limited(v[1], most) == v[1] && limited(v[2], most) == v[2];
}

static drogue_status place(drogue_joint_state *s, const drogue_pose *pose, const drogue_model *model)
{
    int k;
    for (k = 0; k < 3; k++) {
        s->position[k] = drogue_joint_ratio(pose->position_m_q16[k], model->rim_radius_m_q16);
    }
    s->angle[0] = drogue_shl_s64(pose->yaw_rad_q16, DROGUE_JOINT_FRAC - 16);
    s->angle[1] = drogue_shl_s64(pose->pitch_rad_q16, DROGUE_JOINT_FRAC - 16);
    drogue_joint_turn(s);
    return within(s->position, FARTHEST) ? DROGUE_OK : DROGUE_E_DOMAIN;
}

drogue_status drogue_joint_begin(drogue_joint_state *state, drogue_joint_frame *frame, const drogue_pose *pose,
                                 const drogue_ellipse *e, const drogue_camera *camera, const drogue_model *model)
{
    const int64_t fx_q46 = drogue_shl_s64(camera->fx_px_q16, 30);
    const int64_t fy_q46 = drogue_shl_s64(camera->fy_px_q16, 30);
    int32_t s_q30;
    int32_t c_q30;
    drogue_sincos_q30(&s_q30, &c_q30, (int32_t)drogue_shl_s64(e->angle_rad_q16, 13));
    memset(frame, 0, sizeof *frame);
    frame->ray[0][0] = drogue_joint_ratio((int64_t)e->a_px_q16 * c_q30, fx_q46);
    frame->ray[0][1] = drogue_joint_ratio((int64_t)e->a_px_q16 * s_q30, fy_q46);
    frame->ray[1][0] = drogue_joint_ratio(-(int64_t)e->b_px_q16 * s_q30, fx_q46);
    frame->ray[1][1] = drogue_joint_ratio((int64_t)e->b_px_q16 * c_q30, fy_q46);
    frame->ray[2][0] = drogue_joint_ratio((int64_t)e->xc_px_q16 - camera->cx_px_q16, camera->fx_px_q16);
    frame->ray[2][1] = drogue_joint_ratio((int64_t)e->yc_px_q16 - camera->cy_px_q16, camera->fy_px_q16);
    frame->ray[2][2] = DROGUE_JOINT_ONE;
    if (!within(frame->ray[0], WIDEST) || !within(frame->ray[1], WIDEST) || !within(frame->ray[2], WIDEST)) {
        return DROGUE_E_DOMAIN;
    }
    return place(state, pose, model);
}

/* Lift of a ray, or its derivative: (d p - m c, r m). */
typedef struct lift {
    int64_t v[4];
} lift;

static void lift_ray(lift *out, int64_t d, const int64_t p[3], int64_t m, const int64_t c[3], int64_t r)
{
    int k;
    for (k = 0; k < 3; k++) {
        out->v[k] = det(d, p[k], m, c[k]);
    }
    out->v[3] = mul(r, m);
}

/* The form of two lifts: on the circle that of a lift and itself is 0. */
static int64_t form(const lift *a, const lift *b)
{
    return rounded(drogue_s128_sub(drogue_joint_products(a->v, b->v, 3), drogue_s128_mul(a->v[3], b->v[3])));
}

/* Conic of three lifts by themselves, doubled; by their derivatives: its derivative. Packed. */
static void conic_of(int64_t q[6], const lift a[3], const lift b[3])
{
    int i;
    int j;
    for (i = 0; i < 3; i++) {
        for (j = 0; j <= i; j++) {
            q[DROGUE_PACKED(i, j)] = form(&a[i], &b[j]) + form(&b[i], &a[j]);
        }
    }
}

/* Coefficients of 1, cos t, sin t, cos 2t, sin 2t of a conic on the unit circle, less those of 'residual' for the change
 * of its size, over that size. */
static void harmonics(int64_t out[DROGUE_JOINT_ROWS], const int64_t q[6], const int64_t residual[DROGUE_JOINT_ROWS],
                      int64_t over)
{
    const int64_t radial = q[0] + q[2]; /* dF/dr on the unit circle, constant to first order */
    int64_t h[DROGUE_JOINT_FIT];
    int i;
    h[0] = drogue_shr_round_s64(radial, 1) + q[5];
    h[1] = 2 * q[3];
    h[2] = 2 * q[4];
    h[3] = drogue_shr_round_s64(q[0] - q[2], 1);
    h[4] = q[1];
    for (i = 0; i < DROGUE_JOINT_FIT; i++) {
        out[i] = -mul(limited(h[i], LARGEST) + mul(residual[i], limited(radial, LARGEST)), over);
    }
}

/* Derivatives of the lifts by parameter p. */
static void turn_lifts(lift out[3], int p, const drogue_joint_state *s, const drogue_joint_frame *frame)
{
    const int64_t *turn = s->turn[p < 3 ? 0 : p - 3];
    const int64_t by_d = p < 3 ? s->axis[p] : dot(turn, s->position);
    int i;
    for (i = 0; i < 3; i++) {
        const int64_t *ray = frame->ray[i];
        lift_ray(&out[i], by_d, ray, p < 3 ? 0 : dot(ray, turn), s->position, DROGUE_JOINT_ONE);
        if (p < 3) {
            out[i].v[p] -= dot(ray, s->axis);
        }
    }
}

/* Where the circle's image lies off the fitted ellipse, r(t) of joint.h, and how that changes with the pose. */
drogue_status drogue_joint_outline_rows(drogue_joint_rows *out, const drogue_joint_state *s,
                                        const drogue_joint_frame *frame)
{
    const int64_t smallest = DROGUE_JOINT_ONE >> 16;
    const int64_t largest = DROGUE_JOINT_ONE << 7;
    const int64_t d = dot(s->axis, s->position);
    int64_t *residual = out->column[DROGUE_JOINT_FIT];
    lift at[3];
    lift by[3];
    int64_t q[6];
    int64_t over;
    int i;
    for (i = 0; i < 3; i++) {
        lift_ray(&at[i], d, frame->ray[i], dot(frame->ray[i], s->axis), s->position, DROGUE_JOINT_ONE);
    }
    memset(out, 0, sizeof *out);
    conic_of(q, at, at);
    if (!within(s->position, FARTHEST) || q[0] + q[2] < smallest || q[0] + q[2] > largest) {
        return DROGUE_E_DOMAIN;
    }
    over = drogue_joint_ratio(DROGUE_JOINT_ONE, q[0] + q[2]);
    harmonics(residual, q, residual, over); /* which is 0 yet */
    for (i = 0; i < DROGUE_JOINT_FIT; i++) {
        turn_lifts(by, i, s, frame);
        conic_of(q, at, by);
        harmonics(out->column[i], q, residual, 2 * over); /* the conic itself is doubled */
    }
    return DROGUE_OK;
}

/* The inner disc as rays: lengths over the depth of its middle. */
typedef struct disc {
    int64_t over_depth;
    int64_t middle[3];
    int64_t radius;
    int64_t facing;   /* axis . middle */
    int64_t image[2]; /* centre of its image, which is not the image of its middle */
} disc;

static drogue_status see_disc(disc *out, const drogue_joint_state *s, const drogue_model *model)
{
    static const int64_t unit[3][3] = {{DROGUE_JOINT_ONE, 0, 0}, {0, DROGUE_JOINT_ONE, 0}, {0, 0, DROGUE_JOINT_ONE}};
    const int64_t depth = drogue_joint_ratio(model->inner_depth_m_q16, model->rim_radius_m_q16);
    lift at[3];
    int64_t q[6];
    int64_t determinant;
    int k;
    for (k = 0; k < 3; k++) {
        out->middle[k] = s->position[k] + mul(depth, s->axis[k]);
    }
    if (out->middle[2] <= 0) {
        return DROGUE_E_BEHIND_CAMERA;
    }
    out->over_depth = drogue_joint_ratio(DROGUE_JOINT_ONE, out->middle[2]);
    for (k = 0; k < 3; k++) {
        out->middle[k] = mul(out->middle[k], out->over_depth);
    }
    out->radius = mul(drogue_joint_ratio(model->inner_radius_m_q16, model->rim_radius_m_q16), out->over_depth);
    out->facing = dot(s->axis, out->middle);
    for (k = 0; k < 3; k++) {
        lift_ray(&at[k], out->facing, unit[k], s->axis[k], out->middle, out->radius);
    }
    conic_of(q, at, at);
    determinant = det(q[0], q[2], q[1], q[1]);
    if (!within(out->middle, WIDEST) || determinant <= 0) {
        return DROGUE_E_DOMAIN;
    }
    out->image[0] = drogue_joint_ratio(det(q[1], q[4], q[2], q[3]), determinant);
    out->image[1] = drogue_joint_ratio(det(q[1], q[3], q[0], q[4]), determinant);
    return DROGUE_OK;
}

/* The inner part's rows: image of the disc's centroid less the measured one; slopes are those of its middle. */
drogue_status drogue_joint_inner_rows(drogue_joint_rows *out, const drogue_joint_state *s,
                                      const drogue_joint_inner *inner, const drogue_camera *camera,
                                      const drogue_model *model)
{
    const int64_t depth = drogue_joint_ratio(model->inner_depth_m_q16, model->rim_radius_m_q16);
    int64_t measured[2];
    disc seen;
    const drogue_status status = see_disc(&seen, s, model);
    int i;
    int p;
    if (status != DROGUE_OK) {
        return status;
    }
    measured[0] = drogue_joint_ratio((int64_t)inner->x_px_q16 - camera->cx_px_q16, camera->fx_px_q16);
    measured[1] = drogue_joint_ratio((int64_t)inner->y_px_q16 - camera->cy_px_q16, camera->fy_px_q16);
    for (i = 0; i < 2; i++) {
        int64_t *const row = &out->column[0][DROGUE_JOINT_FIT + i];
        row[DROGUE_JOINT_FIT * DROGUE_JOINT_ROWS] = seen.image[i] - measured[i];
        for (p = 0; p < DROGUE_JOINT_FIT; p++) {
            /* change of the disc's middle along x or y, and along z */
            const int64_t across = p < 3 ? (p == i ? DROGUE_JOINT_ONE : 0) : mul(depth, s->turn[p - 3][i]);
            const int64_t along = p < 3 ? (p == 2 ? DROGUE_JOINT_ONE : 0) : mul(depth, s->turn[p - 3][2]);
            row[p * DROGUE_JOINT_ROWS] = mul(across - mul(seen.image[i], along), seen.over_depth);
        }
    }
    return DROGUE_OK;
}

static drogue_q16 pixel_q16(int64_t ray, drogue_q16 focal_px_q16, drogue_q16 centre_px_q16)
{
    return drogue_sat_s32(drogue_mul_shr_round_s64(ray, focal_px_q16, DROGUE_JOINT_FRAC) + centre_px_q16);
}

drogue_status drogue_inner_disc_image(drogue_ellipse *out, const drogue_pose *pose, const drogue_camera *camera,
                                      const drogue_model *model)
{
    drogue_joint_state s;
    disc seen;
    drogue_status status = place(&s, pose, model);
    memset(out, 0, sizeof *out);
    if (status == DROGUE_OK) {
        status = see_disc(&seen, &s, model);
    }
    if (status != DROGUE_OK) {
        return status;
    }
    out->xc_px_q16 = pixel_q16(seen.image[0], camera->fx_px_q16, camera->cx_px_q16);
    out->yc_px_q16 = pixel_q16(seen.image[1], camera->fy_px_q16, camera->cy_px_q16);
    out->a_px_q16 = drogue_sat_s32(
        drogue_mul_shr_round_s64(seen.radius, (int64_t)camera->fx_px_q16 + camera->fy_px_q16, DROGUE_JOINT_FRAC + 1));
    seen.facing = drogue_joint_ratio(
        seen.facing,
        drogue_wide_to_s64(drogue_wide_sqrt(drogue_wide_from_s64(dot(seen.middle, seen.middle), -DROGUE_JOINT_FRAC)),
                           DROGUE_JOINT_FRAC));
    out->b_px_q16 = pixel_q16(seen.facing, out->a_px_q16, 0);
    return out->b_px_q16 > 0 ? DROGUE_OK : DROGUE_E_DOMAIN;
}
