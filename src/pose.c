/* SPDX-License-Identifier: Apache-2.0 */
/* Pose from the cone through the ellipse (paper (18)-(34); Shiu and Ahmad 1989). */
#include "drogue/pose.h"

#include <string.h>

#include "drogue/eigen.h"

/* Cone through the ellipse in camera coordinates, up to scale: m00 m01 m02 m11 m12 m22 (22). */
static void cone_of_ellipse(drogue_wide m[6], const drogue_ellipse *ellipse, const drogue_camera *camera)
{
    drogue_wide fx = drogue_wide_from_q16(camera->fx_px_q16);
    drogue_wide fy = drogue_wide_from_q16(camera->fy_px_q16);
    drogue_wide u = drogue_wide_from_s64((int64_t)ellipse->xc_px_q16 - camera->cx_px_q16, -16);
    drogue_wide v = drogue_wide_from_s64((int64_t)ellipse->yc_px_q16 - camera->cy_px_q16, -16);
    drogue_wide a2 = drogue_wide_from_s64((int64_t)ellipse->a_px_q16 * ellipse->a_px_q16, -32);
    drogue_wide b2 = drogue_wide_from_s64((int64_t)ellipse->b_px_q16 * ellipse->b_px_q16, -32);
    drogue_wide half_sum = drogue_wide_scale(drogue_wide_add(a2, b2), -1);
    drogue_wide half_difference = drogue_wide_scale(drogue_wide_sub(a2, b2), -1);
    drogue_wide a; /* a x^2 + 2 b xy + c y^2 + 2 d x + 2 e y + f, about the principal point */
    drogue_wide b;
    drogue_wide c;
    drogue_wide d;
    drogue_wide e;
    drogue_wide f;
    int32_t s_q30;
    int32_t c_q30;
    /* Double angles: their rounding scales with a^2 - b^2, not with a^2. */
    drogue_sincos_q30(&s_q30, &c_q30, (int32_t)drogue_shl_s64(ellipse->angle_rad_q16, 14));
    c = drogue_wide_mul(half_difference, drogue_wide_from_s64(c_q30, -30));
    a = drogue_wide_sub(half_sum, c);
    c = drogue_wide_add(half_sum, c);
    b = drogue_wide_neg(drogue_wide_mul(half_difference, drogue_wide_from_s64(s_q30, -30)));
    d = drogue_wide_neg(drogue_wide_add(drogue_wide_mul(a, u), drogue_wide_mul(b, v)));
    e = drogue_wide_neg(drogue_wide_add(drogue_wide_mul(b, u), drogue_wide_mul(c, v)));
    f = drogue_wide_neg(
        drogue_wide_add(drogue_wide_add(drogue_wide_mul(d, u), drogue_wide_mul(e, v)), drogue_wide_mul(a2, b2)));
    m[0] = drogue_wide_mul(a, drogue_wide_mul(fx, fx));
    m[1] = drogue_wide_mul(b, drogue_wide_mul(fx, fy));
    m[2] = drogue_wide_mul(d, fx);
    m[3] = drogue_wide_mul(c, drogue_wide_mul(fy, fy));
    m[4] = drogue_wide_mul(e, fy);
    m[5] = f;
}

/* Both circles of a radius on a cone in its own axes (27)-(30): centre (+-x, 0, z), axis (-+tilt, 0, upright). */
typedef struct circle_pair {
    drogue_wide x;
    drogue_wide z;
    drogue_wide tilt;
    drogue_wide upright;
} circle_pair;

static circle_pair circles_on_cone(const int64_t value[3], drogue_q16 radius_m_q16)
{
    drogue_wide first = drogue_wide_from_s64(value[0], 0);
    drogue_wide third = drogue_wide_from_s64(-value[2], 0);
    drogue_wide sum = drogue_wide_add(first, third);
    drogue_wide radius = drogue_wide_from_q16(radius_m_q16);
    circle_pair r;
    r.tilt = drogue_wide_sqrt(drogue_wide_div(drogue_wide_from_s64(value[0] - value[1], 0), sum));
    r.upright = drogue_wide_sqrt(drogue_wide_div(drogue_wide_from_s64(value[1] - value[2], 0), sum));
    r.x = drogue_wide_mul(drogue_wide_mul(radius, r.tilt), drogue_wide_sqrt(drogue_wide_div(third, first)));
    r.z = drogue_wide_mul(drogue_wide_mul(radius, r.upright), drogue_wide_sqrt(drogue_wide_div(first, third)));
    return r;
}

/* p * e1 + q * e3 */
static void combine(drogue_wide out[3], drogue_wide p, drogue_wide q, const int64_t e1_q60[3], const int64_t e3_q60[3])
{
    int k;
    for (k = 0; k < 3; k++) {
        out[k] = drogue_wide_add(drogue_wide_mul(p, drogue_wide_from_s64(e1_q60[k], -DROGUE_EIGEN_FRAC)),
                                 drogue_wide_mul(q, drogue_wide_from_s64(e3_q60[k], -DROGUE_EIGEN_FRAC)));
    }
}

static drogue_status finish_pose(drogue_pose *out, const drogue_wide position[3], const drogue_wide axis[3])
{
    drogue_wide across =
        drogue_wide_sqrt(drogue_wide_add(drogue_wide_mul(axis[0], axis[0]), drogue_wide_mul(axis[2], axis[2])));
    int k;
    for (k = 0; k < 3; k++) {
        int64_t p = drogue_wide_to_s64(position[k], 16);
        out->position_m_q16[k] = drogue_sat_s32(p);
        out->axis_q16[k] = drogue_wide_to_q16(axis[k]);
        if (out->position_m_q16[k] != p) {
            return DROGUE_E_DOMAIN;
        }
    }
    out->yaw_rad_q16 = (drogue_q16)drogue_shr_round_s64(drogue_wide_atan2_q29(axis[0], axis[2]), 13);
    out->pitch_rad_q16 = (drogue_q16)drogue_shr_round_s64(drogue_wide_atan2_q29(axis[1], across), 13);
    return DROGUE_OK;
}

drogue_status drogue_pose_from_ellipse(drogue_pose out[2], const drogue_ellipse *ellipse, const drogue_camera *camera,
                                       drogue_q16 radius_m_q16)
{
    drogue_wide cone[6];
    drogue_sym3 matrix;
    drogue_eigen3 eigen;
    circle_pair pair;
    int64_t e3[3];
    int i;
    int k;
    memset(out, 0, 2 * sizeof *out);
    if (camera->fx_px_q16 <= 0 || camera->fy_px_q16 <= 0 || radius_m_q16 <= 0 || ellipse->b_px_q16 <= 0 ||
        ellipse->a_px_q16 < ellipse->b_px_q16) {
        return DROGUE_E_DOMAIN;
    }
    cone_of_ellipse(cone, ellipse, camera);
    (void)drogue_sym3_normalise(&matrix, cone);
    (void)drogue_eigen_sym3(&eigen, &matrix);
    if (eigen.value[1] <= 0 || eigen.value[2] >= 0) {
        return DROGUE_E_DOMAIN; /* no cone: flat beyond the matrix's precision */
    }
    pair = circles_on_cone(eigen.value, radius_m_q16);
    for (k = 0; k < 3; k++) { /* the cone's axis points away from the camera */
        e3[k] = eigen.vector_q60[2][2] < 0 ? -eigen.vector_q60[2][k] : eigen.vector_q60[2][k];
    }
    for (i = 0; i < 2; i++) {
        drogue_wide position[3];
        drogue_wide axis[3];
        drogue_status status;
        combine(position, i == 0 ? pair.x : drogue_wide_neg(pair.x), pair.z, eigen.vector_q60[0], e3);
        combine(axis, i == 0 ? drogue_wide_neg(pair.tilt) : pair.tilt, pair.upright, eigen.vector_q60[0], e3);
        status = finish_pose(&out[i], position, axis);
        if (status != DROGUE_OK) {
            memset(out, 0, 2 * sizeof *out);
            return status;
        }
    }
    return DROGUE_OK;
}

drogue_status drogue_project_axis_point(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, const drogue_pose *pose,
                                        drogue_q16 depth_m_q16, const drogue_camera *camera)
{
    drogue_wide point[3];
    int k;
    for (k = 0; k < 3; k++) {
        point[k] = drogue_wide_from_s64(
            (int64_t)pose->position_m_q16[k] * DROGUE_Q16_ONE + (int64_t)depth_m_q16 * pose->axis_q16[k], -32);
    }
    if (point[2].mantissa <= 0) {
        *x_px_q16 = *y_px_q16 = 0;
        return DROGUE_E_BEHIND_CAMERA;
    }
    *x_px_q16 = drogue_wide_to_q16(
        drogue_wide_add(drogue_wide_mul(drogue_wide_from_q16(camera->fx_px_q16), drogue_wide_div(point[0], point[2])),
                        drogue_wide_from_q16(camera->cx_px_q16)));
    *y_px_q16 = drogue_wide_to_q16(
        drogue_wide_add(drogue_wide_mul(drogue_wide_from_q16(camera->fy_px_q16), drogue_wide_div(point[1], point[2])),
                        drogue_wide_from_q16(camera->cy_px_q16)));
    return DROGUE_OK;
}

static drogue_q16 distance_q16(drogue_q16 x0, drogue_q16 y0, drogue_q16 x1, drogue_q16 y1)
{
    drogue_wide dx = drogue_wide_from_s64((int64_t)x1 - x0, -16);
    drogue_wide dy = drogue_wide_from_s64((int64_t)y1 - y0, -16);
    return drogue_wide_to_q16(drogue_wide_sqrt(drogue_wide_add(drogue_wide_mul(dx, dx), drogue_wide_mul(dy, dy))));
}

drogue_status drogue_choose_pose(drogue_choice *out, const drogue_pose poses[2], drogue_q16 x_px_q16,
                                 drogue_q16 y_px_q16, drogue_q16 depth_m_q16, const drogue_camera *camera)
{
    int i;
    memset(out, 0, sizeof *out);
    for (i = 0; i < 2; i++) {
        drogue_q16 x;
        drogue_q16 y;
        drogue_status status = drogue_project_axis_point(&x, &y, &poses[i], depth_m_q16, camera);
        if (status != DROGUE_OK) {
            return status;
        }
        out->distance_px_q16[i] = distance_q16(x, y, x_px_q16, y_px_q16);
    }
    out->index = out->distance_px_q16[1] < out->distance_px_q16[0] ? 1 : 0;
    out->ambiguity_q16 = DROGUE_Q16_ONE;
    if (out->distance_px_q16[1 - out->index] > 0) {
        out->ambiguity_q16 = drogue_q16_div(out->distance_px_q16[out->index], out->distance_px_q16[1 - out->index]);
    }
    return DROGUE_OK;
}
