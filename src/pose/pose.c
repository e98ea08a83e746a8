/* SPDX-License-Identifier: Apache-2.0 */
/* Pose from the cone through the ellipse (paper (18)-(34); Shiu and Ahmad 1989). */
#include "drogue/pose.h"

#include <string.h>

#include "drogue/eigen.h"

/* Rays to pixels, and an ellipse about the principal point in both. */
typedef struct view {
    drogue_wide fx;
    drogue_wide fy;
    drogue_wide u; /* centre */
    drogue_wide v;
    drogue_wide a2; /* squared semi-axes */
    drogue_wide b2;
} view;

static void view_of(view *out, const drogue_ellipse *ellipse, const drogue_camera *camera)
{
    drogue_wide_set_q16(&out->fx, camera->fx_px_q16);
    drogue_wide_set_q16(&out->fy, camera->fy_px_q16);
    drogue_wide_set(&out->u, (int64_t)ellipse->xc_px_q16 - camera->cx_px_q16, -16);
    drogue_wide_set(&out->v, (int64_t)ellipse->yc_px_q16 - camera->cy_px_q16, -16);
    drogue_wide_set(&out->a2, (int64_t)ellipse->a_px_q16 * ellipse->a_px_q16, -32);
    drogue_wide_set(&out->b2, (int64_t)ellipse->b_px_q16 * ellipse->b_px_q16, -32);
}

/* Cone through the ellipse in camera coordinates, up to scale: m00 m01 m02 m11 m12 m22 (22). */
static void cone_of_ellipse(drogue_wide m[6], const drogue_ellipse *ellipse, const drogue_camera *camera)
{
    view w;
    drogue_wide turned[2]; /* half the difference of the squared semi-axes, times cos and sin of twice the angle */
    drogue_wide scale;
    int32_t s_q30;
    int32_t c_q30;
    view_of(&w, ellipse, camera);
    /* Double angles: their rounding scales with a^2 - b^2, not with a^2. */
    drogue_sincos_q30(&s_q30, &c_q30, (int32_t)drogue_shl_s64(ellipse->angle_rad_q16, 14));
    drogue_wide_difference(&scale, &w.a2, &w.b2);
    drogue_wide_set(&turned[0], c_q30, -31);
    drogue_wide_set(&turned[1], s_q30, -31);
    drogue_wide_product(&turned[0], &turned[0], &scale);
    drogue_wide_product(&m[1], &turned[1], &scale);
    drogue_wide_negate(&m[1]);
    drogue_wide_sum(&scale, &w.a2, &w.b2);
    drogue_wide_shift(&scale, -1);
    drogue_wide_difference(&m[0], &scale, &turned[0]);
    drogue_wide_sum(&m[3], &scale, &turned[0]);
    /* a x^2 + 2 b xy + c y^2 + 2 d x + 2 e y + f: moved from the centre to the principal point */
    drogue_wide_products(&m[2], &m[0], &w.u, &m[1], &w.v);
    drogue_wide_products(&m[4], &m[1], &w.u, &m[3], &w.v);
    drogue_wide_negate(&m[2]);
    drogue_wide_negate(&m[4]);
    drogue_wide_products(&m[5], &m[2], &w.u, &m[4], &w.v);
    drogue_wide_product(&scale, &w.a2, &w.b2);
    drogue_wide_sum(&m[5], &m[5], &scale);
    drogue_wide_negate(&m[5]);
    drogue_wide_product(&scale, &w.fx, &w.fx);
    drogue_wide_product(&m[0], &m[0], &scale);
    drogue_wide_product(&scale, &w.fx, &w.fy);
    drogue_wide_product(&m[1], &m[1], &scale);
    drogue_wide_product(&scale, &w.fy, &w.fy);
    drogue_wide_product(&m[3], &m[3], &scale);
    drogue_wide_product(&m[2], &m[2], &w.fx);
    drogue_wide_product(&m[4], &m[4], &w.fy);
}

/* Both circles of a radius on a cone in its own axes (27)-(30): centre (+-x, 0, z), axis (+-tilt, 0, upright). */
typedef struct circle_pair {
    drogue_wide x;
    drogue_wide z;
    drogue_wide tilt;
    drogue_wide upright;
} circle_pair;

static void circles_on_cone(circle_pair *out, const int64_t value[3], drogue_q16 radius_m_q16)
{
    drogue_wide first;
    drogue_wide third;
    drogue_wide sum;
    drogue_wide ratio;
    drogue_wide radius;
    drogue_wide_set(&first, value[0], 0);
    drogue_wide_set(&third, -value[2], 0);
    drogue_wide_set_q16(&radius, radius_m_q16);
    drogue_wide_sum(&sum, &first, &third);
    drogue_wide_set(&out->tilt, value[0] - value[1], 0);
    drogue_wide_quotient(&out->tilt, &out->tilt, &sum);
    drogue_wide_root(&out->tilt, &out->tilt);
    drogue_wide_set(&out->upright, value[1] - value[2], 0);
    drogue_wide_quotient(&out->upright, &out->upright, &sum);
    drogue_wide_root(&out->upright, &out->upright);
    drogue_wide_quotient(&ratio, &third, &first);
    drogue_wide_root(&ratio, &ratio);
    drogue_wide_product(&out->x, &radius, &out->tilt);
    drogue_wide_product(&out->x, &out->x, &ratio);
    drogue_wide_quotient(&ratio, &first, &third);
    drogue_wide_root(&ratio, &ratio);
    drogue_wide_product(&out->z, &radius, &out->upright);
    drogue_wide_product(&out->z, &out->z, &ratio);
    drogue_wide_negate(&out->tilt);
}

/* p * e1 + q * e3 */
static void combine(drogue_wide out[3], const drogue_wide *p, const drogue_wide *q, const int64_t e1_q60[3],
                    const int64_t e3_q60[3])
{
    int k;
    for (k = 0; k < 3; k++) {
        drogue_wide e1;
        drogue_wide e3;
        drogue_wide_set(&e1, e1_q60[k], -DROGUE_EIGEN_FRAC);
        drogue_wide_set(&e3, e3_q60[k], -DROGUE_EIGEN_FRAC);
        drogue_wide_products(&out[k], p, &e1, q, &e3);
    }
}

static drogue_status finish_pose(drogue_pose *out, const drogue_wide position[3], const drogue_wide axis[3])
{
    drogue_wide across;
    int k;
    drogue_wide_products(&across, &axis[0], &axis[0], &axis[2], &axis[2]);
    drogue_wide_root(&across, &across);
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
    circles_on_cone(&pair, eigen.value, radius_m_q16);
    for (k = 0; k < 3; k++) { /* the cone's axis points away from the camera */
        e3[k] = eigen.vector_q60[2][2] < 0 ? -eigen.vector_q60[2][k] : eigen.vector_q60[2][k];
    }
    for (i = 0; i < 2; i++) {
        drogue_wide position[3];
        drogue_wide axis[3];
        drogue_status status;
        combine(position, &pair.x, &pair.z, eigen.vector_q60[0], e3);
        combine(axis, &pair.tilt, &pair.upright, eigen.vector_q60[0], e3);
        status = finish_pose(&out[i], position, axis);
        drogue_wide_negate(&pair.x); /* the other circle */
        drogue_wide_negate(&pair.tilt);
        if (status != DROGUE_OK) {
            memset(out, 0, 2 * sizeof *out);
            return status;
        }
    }
    return DROGUE_OK;
}

/* focal * x / z + centre */
static drogue_q16 project(const drogue_wide *x, const drogue_wide *z, drogue_q16 focal_px_q16, drogue_q16 centre_px_q16)
{
    drogue_wide pixel;
    drogue_wide other;
    drogue_wide_quotient(&pixel, x, z);
    drogue_wide_set_q16(&other, focal_px_q16);
    drogue_wide_product(&pixel, &other, &pixel);
    drogue_wide_set_q16(&other, centre_px_q16);
    drogue_wide_sum(&pixel, &pixel, &other);
    return drogue_wide_to_q16(pixel);
}

drogue_status drogue_project_axis_point(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, const drogue_pose *pose,
                                        drogue_q16 depth_m_q16, const drogue_camera *camera)
{
    drogue_wide point[3];
    int k;
    for (k = 0; k < 3; k++) {
        drogue_wide_set(&point[k],
                        (int64_t)pose->position_m_q16[k] * DROGUE_Q16_ONE + (int64_t)depth_m_q16 * pose->axis_q16[k],
                        -32);
    }
    if (point[2].mantissa <= 0) {
        *x_px_q16 = *y_px_q16 = 0;
        return DROGUE_E_BEHIND_CAMERA;
    }
    *x_px_q16 = project(&point[0], &point[2], camera->fx_px_q16, camera->cx_px_q16);
    *y_px_q16 = project(&point[1], &point[2], camera->fy_px_q16, camera->cy_px_q16);
    return DROGUE_OK;
}

static drogue_q16 distance_q16(drogue_q16 x0, drogue_q16 y0, drogue_q16 x1, drogue_q16 y1)
{
    drogue_wide dx;
    drogue_wide dy;
    drogue_wide_set(&dx, (int64_t)x1 - x0, -16);
    drogue_wide_set(&dy, (int64_t)y1 - y0, -16);
    drogue_wide_products(&dx, &dx, &dx, &dy, &dy);
    drogue_wide_root(&dx, &dx);
    return drogue_wide_to_q16(dx);
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
