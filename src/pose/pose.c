/* SPDX-License-Identifier: Apache-2.0 */
/* Pose from the cone through the ellipse (paper (18)-(34); Shiu and Ahmad 1989). */
#include "drogue/pose.h"

#include <string.h>

#include "drogue/eigen.h"

void drogue_pose_axis(drogue_q16 axis_q16[3], drogue_q16 yaw_rad_q16, drogue_q16 pitch_rad_q16)
{
    int32_t sin_yaw;
    int32_t cos_yaw;
    int32_t sin_pitch;
    int32_t cos_pitch;
    drogue_sincos_of_q16(&sin_yaw, &cos_yaw, yaw_rad_q16);
    drogue_sincos_of_q16(&sin_pitch, &cos_pitch, pitch_rad_q16);
    axis_q16[0] = (drogue_q16)drogue_shr_round_s64(drogue_product(sin_yaw, cos_pitch), 44);
    axis_q16[1] = (drogue_q16)drogue_shr_round_s64(sin_pitch, 14);
    axis_q16[2] = (drogue_q16)drogue_shr_round_s64(drogue_product(cos_yaw, cos_pitch), 44);
}

/* The cone through an ellipse in a frame of its own, whose z axis is the ray through the ellipse's centre. */
typedef struct view {
    drogue_real axis[3][3]; /* the frame's axes, in camera coordinates */
    drogue_real dual[6]; /* the cone's inverse, up to scale: m00 m01 m02 m11 m12 m22. Its entries are graded: those of
                               the two axes across as the squared semi-axis over the focal length, the last about 1 */
} view;

/* Squares of the semi-axes as a matrix, over the focal lengths: of rays at the ellipse, about its centre. */
static void squares_of(drogue_real out[3], const drogue_ellipse *e, const drogue_camera *camera)
{
    drogue_real half;   /* half the sum of the squares */
    drogue_real across; /* half their difference, times cos and sin of twice the angle: its rounding scales with it */
    drogue_real turned;
    drogue_real fx;
    drogue_real fy;
    int32_t s_q30;
    int32_t c_q30;
    drogue_sincos_q30(&s_q30, &c_q30, (int32_t)drogue_shl_s64(e->angle_rad_q16, 14));
    drogue_real_set(&half, (int64_t)drogue_square_sum(e->a_px_q16, e->b_px_q16), -33);
    drogue_real_set(&across, ((int64_t)e->a_px_q16 - e->b_px_q16) * ((int64_t)e->a_px_q16 + e->b_px_q16), -33);
    drogue_real_set(&turned, c_q30, -30);
    drogue_real_product(&turned, &turned, &across);
    drogue_real_sum(&out[0], &half, &turned);
    drogue_real_difference(&out[2], &half, &turned);
    drogue_real_set(&turned, s_q30, -30);
    drogue_real_product(&out[1], &turned, &across);
    drogue_real_set_q16(&fx, camera->fx_px_q16);
    drogue_real_set_q16(&fy, camera->fy_px_q16);
    drogue_real_quotient(&out[0], &out[0], &fx);
    drogue_real_quotient(&out[0], &out[0], &fx);
    drogue_real_quotient(&out[1], &out[1], &fx);
    drogue_real_quotient(&out[1], &out[1], &fy);
    drogue_real_quotient(&out[2], &out[2], &fy);
    drogue_real_quotient(&out[2], &out[2], &fy);
}

/* Axes (1, 0, -x) / w, (-xy, w^2, -y) / (w rho), (x, y, 1) / rho with w^2 = 1 + x^2, rho^2 = w^2 + y^2. */
static void axes_of(drogue_real axis[3][3], drogue_real *rho2, const drogue_real *x, const drogue_real *y)
{
    const drogue_real one = DROGUE_REAL_ONE;
    drogue_real w;
    drogue_real rho;
    drogue_real_products(&w, x, x, &one, &one);
    drogue_real_products(rho2, y, y, &w, &one);
    drogue_real_root(&w, &w);
    drogue_real_root(&rho, rho2);
    drogue_real_quotient(&axis[2][0], x, &rho);
    drogue_real_quotient(&axis[2][1], y, &rho);
    drogue_real_quotient(&axis[2][2], &one, &rho);
    drogue_real_quotient(&axis[0][0], &one, &w);
    drogue_real_set(&axis[0][1], 0, 0);
    drogue_real_quotient(&axis[0][2], x, &w);
    drogue_real_negate(&axis[0][2]);
    drogue_real_product(&axis[1][0], &axis[2][1], &axis[0][2]);
    drogue_real_quotient(&axis[1][1], &w, &rho);
    drogue_real_product(&axis[1][2], &axis[2][1], &axis[0][0]);
    drogue_real_negate(&axis[1][2]);
}

static void view_of(view *out, const drogue_ellipse *ellipse, const drogue_camera *camera)
{
    drogue_real square[3];
    drogue_real rho2;
    drogue_real x;
    drogue_real y;
    int i;
    int j;
    squares_of(square, ellipse, camera);
    drogue_real_ratio(&x, (int64_t)ellipse->xc_px_q16 - camera->cx_px_q16, camera->fx_px_q16);
    drogue_real_ratio(&y, (int64_t)ellipse->yc_px_q16 - camera->cy_px_q16, camera->fy_px_q16);
    axes_of(out->axis, &rho2, &x, &y);
    for (j = 0; j < 3; j++) {
        drogue_real_products(&x, &square[0], &out->axis[j][0], &square[1], &out->axis[j][1]);
        drogue_real_products(&y, &square[1], &out->axis[j][0], &square[2], &out->axis[j][1]);
        for (i = 0; i <= j; i++) {
            drogue_real_products(&out->dual[i == 0 ? j : i + j + 1], &out->axis[i][0], &x, &out->axis[i][1], &y);
        }
    }
    drogue_real_difference(&out->dual[5], &out->dual[5], &rho2);
}

/* Both circles of a radius on a cone in its own axes (27)-(30): centre (+-x, 0, z), axis (+-tilt, 0, upright). */
typedef struct circle_pair {
    drogue_real x;
    drogue_real z;
    drogue_real tilt;
    drogue_real upright;
} circle_pair;

/* sqrt(a b / c) */
static void root_of_ratio(drogue_real *out, const drogue_real *a, const drogue_real *b, const drogue_real *c)
{
    drogue_real_product(out, a, b);
    drogue_real_quotient(out, out, c);
    drogue_real_root(out, out);
}

/* From the inverse's eigenvalues p >= q > 0 > -m: the cone's are 1 / q, 1 / p, -1 / m. */
static void circles_on_cone(circle_pair *out, const drogue_real value[3], drogue_q16 radius_m_q16)
{
    const drogue_real one = DROGUE_REAL_ONE;
    drogue_real m;
    drogue_real difference;
    drogue_real sum;
    drogue_real all; /* p (q + m) */
    drogue_real t;
    drogue_real_copy(&m, &value[2]);
    drogue_real_negate(&m);
    drogue_real_difference(&difference, &value[0], &value[1]);
    drogue_real_sum(&sum, &value[0], &m);
    drogue_real_products(&all, &value[0], &value[1], &value[0], &m);
    root_of_ratio(&out->tilt, &difference, &m, &all);
    root_of_ratio(&out->upright, &value[1], &sum, &all);
    root_of_ratio(&out->z, &m, &sum, &all);
    root_of_ratio(&out->x, &value[1], &one, &m);
    drogue_real_product(&out->x, &out->tilt, &out->x);
    drogue_real_set_q16(&t, radius_m_q16);
    drogue_real_product(&out->x, &out->x, &t);
    drogue_real_product(&out->z, &out->z, &t);
    drogue_real_negate(&out->tilt);
}

/* p * e1 + q * e3, from the cone's frame to the camera's */
static void combine(drogue_real out[3], const drogue_real *p, const drogue_real *q, const drogue_eigen3 *eigen,
                    const view *w)
{
    drogue_real own[3];
    int k;
    for (k = 0; k < 3; k++) {
        drogue_real e1;
        drogue_real e3;
        drogue_real_set(&e1, eigen->vector_q30[1][k], -30);
        drogue_real_set(&e3, eigen->vector_q30[2][k], -30);
        if (eigen->vector_q30[2][2] < 0) { /* the cone's axis points away from the camera */
            drogue_real_negate(&e3);
        }
        drogue_real_products(&own[k], p, &e1, q, &e3);
    }
    for (k = 0; k < 3; k++) {
        drogue_real_products(&out[k], &own[0], &w->axis[0][k], &own[1], &w->axis[1][k]);
        drogue_real_negate(&own[2]);
        drogue_real_subtract_product(&out[k], &own[2], &w->axis[2][k]);
        drogue_real_negate(&own[2]);
    }
}

static drogue_status finish_pose(drogue_pose *out, const drogue_real position[3], const drogue_real axis[3])
{
    drogue_real across;
    int k;
    drogue_real_products(&across, &axis[0], &axis[0], &axis[2], &axis[2]);
    drogue_real_root(&across, &across);
    for (k = 0; k < 3; k++) {
        int64_t p = drogue_real_to_s64(position[k], 16);
        out->position_m_q16[k] = drogue_sat_s32(p);
        out->axis_q16[k] = drogue_real_to_q16(axis[k]);
        if (out->position_m_q16[k] != p) {
            return DROGUE_E_DOMAIN;
        }
    }
    if (out->position_m_q16[2] <= 0) { /* nearer than numbers go */
        return DROGUE_E_DOMAIN;
    }
    out->yaw_rad_q16 = (drogue_q16)drogue_shr_round_s64(drogue_real_atan2_q29(axis[0], axis[2]), 13);
    out->pitch_rad_q16 = (drogue_q16)drogue_shr_round_s64(drogue_real_atan2_q29(axis[1], across), 13);
    return DROGUE_OK;
}

drogue_status drogue_pose_from_ellipse(drogue_pose out[2], const drogue_ellipse *ellipse, const drogue_camera *camera,
                                       drogue_q16 radius_m_q16)
{
    view w;
    drogue_eigen3 eigen;
    circle_pair pair;
    int i;
    memset(out, 0, 2 * sizeof *out);
    if (camera->fx_px_q16 <= 0 || camera->fy_px_q16 <= 0 || ellipse->b_px_q16 <= 0 ||
        ellipse->a_px_q16 < ellipse->b_px_q16 || !drogue_ellipse_angle_valid(ellipse)) {
        return DROGUE_E_DOMAIN;
    }
    view_of(&w, ellipse, camera);
    (void)drogue_eigen_sym3(&eigen, w.dual);
    if (eigen.value[1].mantissa <= 0 || eigen.value[2].mantissa >= 0) {
        return DROGUE_E_DOMAIN; /* no cone: flat beyond the matrix's precision */
    }
    circles_on_cone(&pair, eigen.value, radius_m_q16);
    for (i = 0; i < 2; i++) {
        drogue_real position[3];
        drogue_real axis[3];
        drogue_status status;
        combine(position, &pair.x, &pair.z, &eigen, &w);
        combine(axis, &pair.tilt, &pair.upright, &eigen, &w);
        status = finish_pose(&out[i], position, axis);
        drogue_real_negate(&pair.x); /* the other circle */
        drogue_real_negate(&pair.tilt);
        if (status != DROGUE_OK) {
            memset(out, 0, 2 * sizeof *out);
            return status;
        }
    }
    return DROGUE_OK;
}

/* focal * x / z + centre */
static drogue_q16 project(const drogue_real *x, const drogue_real *z, drogue_q16 focal_px_q16, drogue_q16 centre_px_q16)
{
    drogue_real pixel;
    drogue_real other;
    drogue_real_quotient(&pixel, x, z);
    drogue_real_set_q16(&other, focal_px_q16);
    drogue_real_product(&pixel, &other, &pixel);
    drogue_real_set_q16(&other, centre_px_q16);
    drogue_real_sum(&pixel, &pixel, &other);
    return drogue_real_to_q16(pixel);
}

drogue_status drogue_project_axis_point(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, const drogue_pose *pose,
                                        drogue_q16 depth_m_q16, const drogue_camera *camera)
{
    drogue_real point[3];
    int k;
    for (k = 0; k < 3; k++) {
        drogue_real_set(&point[k],
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
    drogue_real dx;
    drogue_real dy;
    drogue_real_set(&dx, (int64_t)x1 - x0, -16);
    drogue_real_set(&dy, (int64_t)y1 - y0, -16);
    drogue_real_products(&dx, &dx, &dx, &dy, &dy);
    drogue_real_root(&dx, &dx);
    return drogue_real_to_q16(dx);
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
