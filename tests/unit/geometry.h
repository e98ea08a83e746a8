/* SPDX-License-Identifier: Apache-2.0 */
/* Circles, cones and ellipses in double precision: what the geometry of the library is checked with. C99 and C++17. */
#ifndef DROGUE_TESTS_GEOMETRY_H
#define DROGUE_TESTS_GEOMETRY_H

#include "common.h"

#include "drogue/types.h"

typedef struct ellipse_real {
    double xc, yc, a, b, angle;
} ellipse_real;

static inline double dot3(const double *p, const double *q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

/* Unit axis of yaw and pitch. */
static inline void axis_of_angles(double axis[3], double yaw, double pitch)
{
    axis[0] = sin(yaw) * cos(pitch);
    axis[1] = sin(pitch);
    axis[2] = cos(yaw) * cos(pitch);
}

/* Ellipse of A x^2 + B xy + C y^2 + D x + E y + F = 0; 0 when the conic is none. */
static inline int ellipse_of_conic(ellipse_real *out, const double q[6])
{
    double det = 4 * q[0] * q[2] - q[1] * q[1], root = hypot(q[0] - q[2], q[1]), f, larger, sign;
    if (!(det > 0)) {
        return 0;
    }
    sign = q[0] + q[2] < 0 ? -1.0 : 1.0;
    out->xc = (q[1] * q[4] - 2 * q[2] * q[3]) / det;
    out->yc = (q[1] * q[3] - 2 * q[0] * q[4]) / det;
    f = -sign * (q[5] + (q[3] * out->xc + q[4] * out->yc) / 2);
    larger = sign * (q[0] + q[2]) + root; /* twice the larger eigenvalue; the smaller one is det / (2 larger) */
    if (!(f > 0)) {
        return 0;
    }
    out->b = sqrt(2 * f / larger);
    out->a = sqrt(2 * f * larger / det);
    out->angle = atan2(-sign * q[1], sign * (q[2] - q[0])) / 2;
    return 1;
}

/* Image of a circle by a pinhole camera; 0 when it does not lie wholly before the camera. */
static inline int ellipse_of_circle(ellipse_real *out, const double centre[3], const double axis[3], double radius,
                                    double fx, double fy, double cx, double cy)
{
    /* Rays r meet the plane at r d / (n r): d^2 r r - 2 d (n r)(c r) + (c c - radius^2)(n r)^2 = 0. */
    double d = dot3(axis, centre), k = dot3(centre, centre) - radius * radius, m[3][3], q[6];
    int i, j;
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++) {
            m[i][j] = (i == j ? d * d : 0) - d * (axis[i] * centre[j] + axis[j] * centre[i]) + k * axis[i] * axis[j];
        }
    }
    q[0] = m[0][0] / (fx * fx);
    q[1] = 2 * m[0][1] / (fx * fy);
    q[2] = m[1][1] / (fy * fy);
    q[3] = 2 * m[0][2] / fx;
    q[4] = 2 * m[1][2] / fy;
    q[5] = m[2][2];
    if (centre[2] <= radius || !ellipse_of_conic(out, q)) {
        return 0;
    }
    out->xc += cx;
    out->yc += cy;
    return 1;
}

static inline drogue_ellipse ellipse_to_q16(const ellipse_real *e)
{
    drogue_ellipse q;
    q.xc_px_q16 = q16_of(e->xc);
    q.yc_px_q16 = q16_of(e->yc);
    q.a_px_q16 = q16_of(e->a);
    q.b_px_q16 = q16_of(e->b);
    q.angle_rad_q16 = q16_of(e->angle);
    return q;
}

static inline ellipse_real ellipse_from_q16(const drogue_ellipse *q)
{
    ellipse_real e;
    e.xc = real_of_q16(q->xc_px_q16);
    e.yc = real_of_q16(q->yc_px_q16);
    e.a = real_of_q16(q->a_px_q16);
    e.b = real_of_q16(q->b_px_q16);
    e.angle = real_of_q16(q->angle_rad_q16);
    return e;
}

/* Point of an ellipse at the parameter t. */
static inline void ellipse_point(double *x, double *y, const ellipse_real *e, double t)
{
    double u = e->a * cos(t), v = e->b * sin(t);
    *x = e->xc + u * cos(e->angle) - v * sin(e->angle);
    *y = e->yc + u * sin(e->angle) + v * cos(e->angle);
}

static inline drogue_camera pinhole(double fx, double fy, double cx, double cy)
{
    drogue_camera c;
    memset(&c, 0, sizeof c);
    c.fx_px_q16 = q16_of(fx);
    c.fy_px_q16 = q16_of(fy);
    c.cx_px_q16 = q16_of(cx);
    c.cy_px_q16 = q16_of(cy);
    return c;
}

#endif
