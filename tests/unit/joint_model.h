/* SPDX-License-Identifier: Apache-2.0 */
/* The joint pose's measurement model in double precision, by sampling and differences alone: how far one ellipse lies
 * off another, what a pose shows, and the covariance that follows. */
#ifndef DROGUE_TESTS_JOINT_MODEL_H
#define DROGUE_TESTS_JOINT_MODEL_H

#include "drogue/joint.h"
#include "geometry.h"
#include "real_quad.h"

typedef struct pose_real {
    double v[5]; /* x, y, z, yaw, pitch */
} pose_real;

typedef struct field {
    drogue_camera camera;
    drogue_model model;
} field;

static inline field usual_field(void)
{
    field f;
    f.camera = pinhole(1465.5, 1470, 1023.5, 1000);
    f.model.rim_radius_m_q16 = q16_of(0.35);
    f.model.inner_radius_m_q16 = q16_of(0.12);
    f.model.inner_depth_m_q16 = q16_of(0.25);
    return f;
}

static inline pose_real random_pose(uint64_t *rng, double most_angle)
{
    pose_real p;
    p.v[2] = exp(rng_real(rng, log(2.0), log(25.0)));
    p.v[0] = p.v[2] * rng_real(rng, -0.3, 0.3);
    p.v[1] = p.v[2] * rng_real(rng, -0.3, 0.3);
    p.v[3] = rng_real(rng, -most_angle, most_angle);
    p.v[4] = rng_real(rng, -most_angle, most_angle);
    return p;
}

/* Largest difference from the truth, LSB of m and rad; the axis counts, not the angles. */
static inline double pose_error_lsb(const drogue_pose *got, const pose_real *p)
{
    double axis[3], worst = 0;
    int k;
    axis_of_angles(axis, p->v[3], p->v[4]);
    for (k = 0; k < 3; k++) {
        worst = fmax(worst, fabs(got->position_m_q16[k] - 65536 * p->v[k]));
        worst = fmax(worst, fabs(got->axis_q16[k] - 65536 * axis[k]));
    }
    return worst;
}

static inline int field_ellipse(ellipse_real *out, const field *f, const pose_real *p, double depth, double radius)
{
    double axis[3], centre[3];
    int k;
    axis_of_angles(axis, p->v[3], p->v[4]);
    for (k = 0; k < 3; k++) {
        centre[k] = p->v[k] + depth * axis[k];
    }
    return ellipse_of_circle(out, centre, axis, radius, real_of_q16(f->camera.fx_px_q16),
                             real_of_q16(f->camera.fy_px_q16), real_of_q16(f->camera.cx_px_q16),
                             real_of_q16(f->camera.cy_px_q16));
}

static inline int field_outline(ellipse_real *out, const field *f, const pose_real *p)
{
    return field_ellipse(out, f, p, 0, real_of_q16(f->model.rim_radius_m_q16));
}

static inline int field_inner(ellipse_real *out, const field *f, const pose_real *p)
{
    return field_ellipse(out, f, p, real_of_q16(f->model.inner_depth_m_q16), real_of_q16(f->model.inner_radius_m_q16));
}

/* Harmonics of e off the reference: r(t) = m0 + m1 cos t + m2 sin t + m3 cos 2t + m4 sin 2t along rays of its frame. */
static inline void harmonics_of(double m[5], const ellipse_real *e, const ellipse_real *reference)
{
    enum { SAMPLES = 64 };
    int i;
    memset(m, 0, 5 * sizeof *m);
    for (i = 0; i < SAMPLES; i++) {
        double t = 2 * TEST_PI * i / SAMPLES, x, y, c[2], d[2], qa, qb, qc, r;
        ellipse_point(&x, &y, reference, t);
        /* in the frame of e, where it is the unit circle: centre of the reference, and the ray */
        c[0] = ((reference->xc - e->xc) * cos(e->angle) + (reference->yc - e->yc) * sin(e->angle)) / e->a;
        c[1] = ((reference->yc - e->yc) * cos(e->angle) - (reference->xc - e->xc) * sin(e->angle)) / e->b;
        d[0] = ((x - reference->xc) * cos(e->angle) + (y - reference->yc) * sin(e->angle)) / e->a;
        d[1] = ((y - reference->yc) * cos(e->angle) - (x - reference->xc) * sin(e->angle)) / e->b;
        qa = d[0] * d[0] + d[1] * d[1];
        qb = c[0] * d[0] + c[1] * d[1];
        qc = c[0] * c[0] + c[1] * c[1] - 1;
        r = (-qb + sqrt(qb * qb - qa * qc)) / qa - 1;
        m[0] += r / SAMPLES;
        m[1] += 2 * r * cos(t) / SAMPLES;
        m[2] += 2 * r * sin(t) / SAMPLES;
        m[3] += 2 * r * cos(2 * t) / SAMPLES;
        m[4] += 2 * r * sin(2 * t) / SAMPLES;
    }
}

/* Full matrix of a packed one. */
static inline void unpacked(quad m[5][5], const drogue_real *packed)
{
    int i, j;
    for (i = 0; i < 5; i++) {
        for (j = 0; j < 5; j++) {
            m[i][j] = quad_of(packed[DROGUE_PACKED(i, j)]);
        }
    }
}

/* Covariance of the pose from that of the outline's harmonics and, when std > 0, from the inner centroid; slopes by
 * central differences. The angles' own information is 1 / rad^2. */
static inline int propagated(double out[5][5], const field *f, const pose_real *p,
                             const drogue_real *harmonics_covariance, double std)
{
    quad covariance[5][5], weight[5][5], information[5][5], inverse[5][5];
    double slope[7][5];
    ellipse_real reference;
    int i, j, k, l;
    if (!field_outline(&reference, f, p)) {
        return 0;
    }
    for (k = 0; k < 5; k++) {
        const double step = 1e-5;
        pose_real low = *p, high = *p;
        ellipse_real e[2], inner[2];
        double m[2][5];
        low.v[k] -= step;
        high.v[k] += step;
        if (!field_outline(&e[0], f, &low) || !field_outline(&e[1], f, &high) || !field_inner(&inner[0], f, &low) ||
            !field_inner(&inner[1], f, &high)) {
            return 0;
        }
        for (i = 0; i < 2; i++) {
            harmonics_of(m[i], &e[i], &reference);
        }
        for (i = 0; i < 5; i++) {
            slope[i][k] = (m[1][i] - m[0][i]) / (2 * step);
        }
        slope[5][k] = std > 0 ? (inner[1].xc - inner[0].xc) / (2 * step) / std : 0;
        slope[6][k] = std > 0 ? (inner[1].yc - inner[0].yc) / (2 * step) / std : 0;
    }
    unpacked(covariance, harmonics_covariance);
    if (!quad_invert(weight, covariance, 5)) {
        return 0;
    }
    for (i = 0; i < 5; i++) {
        for (j = 0; j < 5; j++) {
            quad sum = i == j && i >= 3;
            for (k = 0; k < 5; k++) {
                for (l = 0; l < 5; l++) {
                    sum += (quad)slope[k][i] * weight[k][l] * (quad)slope[l][j];
                }
            }
            information[i][j] = sum + (quad)slope[5][i] * (quad)slope[5][j] + (quad)slope[6][i] * (quad)slope[6][j];
        }
    }
    if (!quad_invert(inverse, information, 5)) {
        return 0;
    }
    for (i = 0; i < 25; i++) {
        out[i / 5][i % 5] = (double)inverse[i / 5][i % 5];
    }
    return 1;
}

/* Largest difference of two covariances, as a share of the product of the standard deviations. */
static inline double covariance_apart(const drogue_real *got, double expected[5][5])
{
    double worst = 0;
    int i, j;
    for (i = 0; i < 5; i++) {
        for (j = 0; j < 5; j++) {
            double d = (double)quad_of(got[DROGUE_PACKED(i, j)]) - expected[i][j];
            worst = fmax(worst, fabs(d) / sqrt(expected[i][i] * expected[j][j]));
        }
    }
    return worst;
}

#endif
