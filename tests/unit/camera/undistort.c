/* SPDX-License-Identifier: Apache-2.0 */
/* Lens distortion and its inverse against long double; domain and failures. */
#include "suite.h"

#include "drogue/undistort.h"
#include "geometry.h"

/* Distorted position of the normalised (x, y) and the Jacobian xx xy yx yy. */
static void model_distort(long double out[2], long double jacobian[4], const drogue_camera *c, long double x,
                          long double y)
{
    long double k1 = c->k1_q16 / 65536.0L, k2 = c->k2_q16 / 65536.0L, k3 = c->k3_q16 / 65536.0L;
    long double p1 = c->p1_q16 / 65536.0L, p2 = c->p2_q16 / 65536.0L, r2 = x * x + y * y;
    long double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3)), slope = k1 + r2 * (2 * k2 + r2 * 3 * k3);
    out[0] = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
    out[1] = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
    jacobian[0] = radial + 2 * x * x * slope + 2 * p1 * y + 6 * p2 * x;
    jacobian[1] = jacobian[2] = 2 * x * y * slope + 2 * p1 * x + 2 * p2 * y;
    jacobian[3] = radial + 2 * y * y * slope + 6 * p1 * y + 2 * p2 * x;
}

static drogue_camera random_camera(uint64_t *rng, double least_focal, double most_focal, double strength)
{
    double f = exp(rng_real(rng, log(least_focal), log(most_focal)));
    drogue_camera c = pinhole(f, f * rng_real(rng, 0.9, 1.1), rng_real(rng, 300, 1100), rng_real(rng, 300, 1100));
    c.k1_q16 = q16_of(strength * rng_real(rng, -0.3, 0.3));
    c.k2_q16 = q16_of(strength * rng_real(rng, -0.1, 0.1));
    c.p1_q16 = q16_of(strength * rng_real(rng, -0.01, 0.01));
    c.p2_q16 = q16_of(strength * rng_real(rng, -0.01, 0.01));
    c.k3_q16 = q16_of(strength * rng_real(rng, -0.03, 0.03));
    return c;
}

/* Is the map one to one, with room to spare, on the way from the axis to (x, y)? */
static int model_unfolded(const drogue_camera *c, long double x, long double y)
{
    long double d[2], j[4];
    int k;
    for (k = 1; k <= 40; k++) {
        model_distort(d, j, c, x * k / 40, y * k / 40);
        if (!(j[0] * j[3] - j[1] * j[2] > 0.2L) || !(j[0] > 0.2L) || !(j[3] > 0.2L)) {
            return 0;
        }
    }
    return 1;
}

/* Ideal normalised position of the seen pixel by Newton's method from there; 0 where the map folds on the way. */
static int model_undistort(long double out[2], const drogue_camera *c, drogue_q16 u, drogue_q16 v)
{
    long double sx = ((long double)u - c->cx_px_q16) / c->fx_px_q16,
                sy = ((long double)v - c->cy_px_q16) / c->fy_px_q16;
    long double x = sx, y = sy, d[2], j[4];
    int step;
    for (step = 0; step < 60; step++) {
        long double ex, ey, det;
        model_distort(d, j, c, x, y);
        ex = sx - d[0];
        ey = sy - d[1];
        det = j[0] * j[3] - j[1] * j[2];
        if (!(det > 0.1L) || !(j[0] > 0.1L) || !(j[3] > 0.1L)) {
            return 0;
        }
        x += (j[3] * ex - j[1] * ey) / det;
        y += (j[0] * ey - j[2] * ex) / det;
    }
    model_distort(d, j, c, x, y);
    out[0] = x;
    out[1] = y;
    return fabsl(d[0] - sx) + fabsl(d[1] - sy) < 1e-15L && fabsl(x) < 4 && fabsl(y) < 4 && model_unfolded(c, x, y);
}

/* What the header allows at a normalised point, LSB. */
static long double allowed(const drogue_camera *c, long double x, long double y)
{
    const long double focal = fmaxl(c->fx_px_q16, c->fy_px_q16), r2 = x * x + y * y, r = sqrtl(r2);
    const long double terms[5] = {c->k1_q16 * r2 * r, c->k2_q16 * r2 * r2 * r, c->k3_q16 * r2 * r2 * r2 * r,
                                  c->p1_q16 * r2, c->p2_q16 * r2};
    long double most = 0;
    int k;
    for (k = 0; k < 5; k++) {
        most = fmaxl(most, fabsl(terms[k]) / 65536);
    }
    return 1 + focal * (0x1p-29L + most * 0x1p-23L);
}

/* The least that the lens makes of a length: the Jacobian's smaller eigenvalue. */
static long double least_stretch(const long double jacobian[4])
{
    return (jacobian[0] + jacobian[3]) / 2 - hypotl((jacobian[0] - jacobian[3]) / 2, jacobian[1]);
}

/* Worst errors of both directions, LSB, and as shares of what is allowed in any case. */
typedef struct errors {
    double forth, back, forth_share, back_share;
} errors;

typedef drogue_camera camera_maker(uint64_t *rng);

static double error_of(drogue_q16 x, drogue_q16 y, const drogue_camera *c, const long double at[2])
{
    return (double)fmaxl(fabsl(x - (at[0] * c->fx_px_q16 + c->cx_px_q16)),
                         fabsl(y - (at[1] * c->fy_px_q16 + c->cy_px_q16)));
}

/* Over random cameras and points as far off the axis. */
static errors measure_errors(camera_maker *make, double most_reach)
{
    errors worst = {0, 0, 0, 0};
    uint64_t rng = 1;
    int i, inverted = 0, refused = 0;
    for (i = 0; i < 200000; i++) {
        drogue_camera c = make(&rng);
        double reach = fmin(most_reach, 20000 / real_of_q16(c.fx_px_q16));
        drogue_q16 u = q16_of(real_of_q16(c.cx_px_q16) + real_of_q16(c.fx_px_q16) * rng_real(&rng, -reach, reach));
        drogue_q16 v = q16_of(real_of_q16(c.cy_px_q16) + real_of_q16(c.fy_px_q16) * rng_real(&rng, -reach, reach));
        drogue_q16 x = u, y = v;
        long double d[2], j[4], f[2], at[2];
        double off;
        f[0] = c.fx_px_q16;
        f[1] = c.fy_px_q16;
        at[0] = ((long double)u - c.cx_px_q16) / f[0];
        at[1] = ((long double)v - c.cy_px_q16) / f[1];
        model_distort(d, j, &c, at[0], at[1]);
        if (drogue_distort_point(&x, &y, &c) == DROGUE_OK) {
            off = error_of(x, y, &c, d);
            worst.forth = fmax(worst.forth, off);
            worst.forth_share = fmax(worst.forth_share, off / (double)allowed(&c, at[0], at[1]));
        } else {
            MUST(fabsl(d[0] * f[0]) > 2.0e9L || fabsl(d[1] * f[1]) > 2.0e9L, "case %d: distortion refused", i);
        }
        x = u;
        y = v;
        if (model_undistort(at, &c, u, v) && fabsl(at[0] * f[0]) < 2.0e9L && fabsl(at[1] * f[1]) < 2.0e9L) {
            if (drogue_undistort_point(&x, &y, &c) != DROGUE_OK) {
                refused++;
                continue;
            }
            off = error_of(x, y, &c, at);
            model_distort(d, j, &c, at[0], at[1]);
            worst.back = fmax(worst.back, off);
            worst.back_share =
                fmax(worst.back_share, off * (double)(fminl(least_stretch(j), 1) / allowed(&c, at[0], at[1])));
            inverted++;
        }
    }
    ck_assert_int_gt(inverted, 100000);
    MUST(refused == 0, "%d of %d inversions refused", refused, refused + inverted);
    MUST(worst.forth_share <= 1, "distortion off by %.3f of what is allowed", worst.forth_share);
    MUST(worst.back_share <= 1, "inversion off by %.3f of what is allowed", worst.back_share);
    return worst;
}

/* Wide to long lenses as calibration finds them. */
static drogue_camera calibrated(uint64_t *rng)
{
    drogue_camera c = random_camera(rng, 500, 3000 / 1.1, 0);
    c.k1_q16 = q16_of(rng_real(rng, -0.25, 0.25));
    c.k2_q16 = q16_of(rng_real(rng, -0.05, 0.1));
    c.p1_q16 = q16_of(rng_real(rng, -0.002, 0.002));
    c.p2_q16 = q16_of(rng_real(rng, -0.002, 0.002));
    c.k3_q16 = q16_of(rng_real(rng, -0.01, 0.01));
    return c;
}

static drogue_camera usual(uint64_t *rng) { return random_camera(rng, 200, 3000, 1); }
static drogue_camera long_one(uint64_t *rng) { return random_camera(rng, 3000, 30000, 1); }

START_TEST(calibrated_cameras)
{
    const errors worst = measure_errors(calibrated, 0.6);
    MUST(worst.forth <= 1.0, "distortion off by %.3f LSB", worst.forth);
    MUST(worst.back <= 3.0, "inversion off by %.3f LSB", worst.back);
}
END_TEST

START_TEST(usual_cameras) { (void)measure_errors(usual, 1.2); }
END_TEST

START_TEST(long_focal_lengths) { (void)measure_errors(long_one, 1.2); }
END_TEST

START_TEST(no_distortion_is_the_identity)
{
    uint64_t rng = 2;
    int i;
    for (i = 0; i < 100000; i++) {
        drogue_camera c = random_camera(&rng, 200, 3000, 0);
        drogue_q16 u = rng_range(&rng, 0, 1400 * 65536), v = rng_range(&rng, 0, 1400 * 65536), x = u, y = v;
        ck_assert_int_eq(drogue_camera_distorts(&c), 0);
        if (drogue_distort_point(&x, &y, &c) == DROGUE_OK) {
            MUST(x == u && y == v, "distortion moved a point");
        }
        x = u;
        y = v;
        if (drogue_undistort_point(&x, &y, &c) == DROGUE_OK) {
            MUST(x == u && y == v, "inversion moved a point");
        }
    }
}
END_TEST

START_TEST(any_coefficient_distorts)
{
    drogue_camera c = pinhole(1000, 1000, 500, 500);
    drogue_q16 *k[5];
    int i;
    k[0] = &c.k1_q16;
    k[1] = &c.k2_q16;
    k[2] = &c.p1_q16;
    k[3] = &c.p2_q16;
    k[4] = &c.k3_q16;
    for (i = 0; i < 5; i++) {
        *k[i] = -1;
        ck_assert(drogue_camera_distorts(&c));
        *k[i] = 0;
    }
    ck_assert(!drogue_camera_distorts(&c));
}
END_TEST

static void must_refuse(const drogue_camera *c, double u, double v, int forth)
{
    drogue_q16 x = q16_of(u), y = q16_of(v);
    MUST((forth ? drogue_distort_point(&x, &y, c) : drogue_undistort_point(&x, &y, c)) == DROGUE_E_DOMAIN,
         "(%g, %g) accepted", u, v);
    MUST(forth || (x == q16_of(u) && y == q16_of(v)), "(%g, %g) changed", u, v);
}

/* Along one axis the map is steeper than a step can be taken at, along the other it is not: found with half the steps. */
START_TEST(steep_along_one_axis)
{
    drogue_camera c = pinhole(400, 400, 500, 500);
    int k;
    c.k1_q16 = q16_of(10);
    for (k = 0; k < 4; k++) { /* right, down, left, up, 1.5 focal lengths: r (1 + 10 r^2) = 1.5 */
        const double r = 0.4689206;
        const double dx = k == 0 ? 1 : k == 2 ? -1 : 0, dy = k == 1 ? 1 : k == 3 ? -1 : 0;
        drogue_q16 u = q16_of(500 + 600 * dx), v = q16_of(500 + 600 * dy);
        MUST(drogue_undistort_point(&u, &v, &c) == DROGUE_OK, "direction %d refused", k);
        MUST(fabs(real_of_q16(u) - 500 - 400 * r * dx) < 0.001 && fabs(real_of_q16(v) - 500 - 400 * r * dy) < 0.001,
             "direction %d: (%g, %g)", k, real_of_q16(u), real_of_q16(v));
    }
}
END_TEST

START_TEST(outside_the_domain)
{
    drogue_camera c = pinhole(1000, 1000, 500, 500), bad;
    must_refuse(&c, 500 + 4001, 500, 1);
    must_refuse(&c, 500, 500 - 4001, 1);
    must_refuse(&c, 500 + 4001, 500, 0);
    must_refuse(&c, 500, 500 - 4001, 0);
    bad = c;
    bad.fx_px_q16 = 0;
    must_refuse(&bad, 500, 500, 0);
    must_refuse(&bad, 500, 500, 1);
    bad = c;
    bad.fy_px_q16 = -1;
    must_refuse(&bad, 500, 500, 0);
    must_refuse(&bad, 500, 500, 1);
    bad = c;
    bad.k1_q16 = q16_of(-0.4); /* the seen radius reaches 0.61 at most */
    must_refuse(&bad, 500 + 700, 500, 0);
    must_refuse(&bad, 500 + 600, 500 + 600, 0);
    bad = c;
    bad.k1_q16 = q16_of(-240); /* where it is seen the map slopes by 1 along both axes, but by 160 across */
    bad.k2_q16 = q16_of(80);
    must_refuse(&bad, 500 + 1000, 500 + 1000, 0);
    bad = c;
    bad.k3_q16 = INT32_MAX; /* the result leaves Q16 */
    must_refuse(&bad, 500 + 3900, 500 + 3900, 1);
    bad.k1_q16 = bad.k2_q16 = bad.p1_q16 = bad.p2_q16 = bad.k3_q16 = INT32_MIN;
    must_refuse(&bad, 500 + 3999, 500 + 3999, 1);
    must_refuse(&bad, 500 + 3999, 500 + 3999, 0);
}
END_TEST

/* Lenses that fold so steeply that a step across the fold lands where one derivative is below -128: the ideal point before
 * the fold is found all the same. */
START_TEST(a_steep_fold_is_not_crossed)
{
    static const struct {
        drogue_q16 k[3], p[2], u, v;
    } cases[] = {{{8264599, -6067752, -8872191}, {-166066, -70583}, 117226882, 36245031},
                 {{3921555, -3426275, -2741061}, {-239682, 201834}, 125628358, 25757786},
                 {{6281613, -7091004, -399828}, {-36415, 49465}, -14799002, 32130754},
                 {{3662426, -707844, -3335528}, {-98740, 21478}, -66034060, 27006626}};
    size_t i;
    int k;
    for (i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        drogue_camera c = pinhole(400, 400, 500, 500);
        drogue_q16 u = cases[i].u, v = cases[i].v;
        long double d[2], j[4], x, y;
        c.k1_q16 = cases[i].k[0];
        c.k2_q16 = cases[i].k[1];
        c.k3_q16 = cases[i].k[2];
        c.p1_q16 = cases[i].p[0];
        c.p2_q16 = cases[i].p[1];
        MUST(drogue_undistort_point(&u, &v, &c) == DROGUE_OK, "case %d refused", (int)i);
        x = ((long double)u - c.cx_px_q16) / c.fx_px_q16;
        y = ((long double)v - c.cy_px_q16) / c.fy_px_q16;
        for (k = 0; k <= 1000; k++) {
            model_distort(d, j, &c, x * k / 1000, y * k / 1000);
            MUST(j[0] > 0 && j[3] > 0 && j[0] * j[3] > j[1] * j[2], "case %d: folded before (%d, %d)", (int)i, (int)u,
                 (int)v);
        }
        MUST(hypotl(d[0] * c.fx_px_q16 + c.cx_px_q16 - cases[i].u, d[1] * c.fy_px_q16 + c.cy_px_q16 - cases[i].v) <
                 2 * (j[0] + j[3]),
             "case %d: (%d, %d) is seen elsewhere", (int)i, (int)u, (int)v);
    }
}
END_TEST

/* Where rounding sends the steps to and fro about a regular point, the answer lies between. */
START_TEST(to_and_fro_is_there)
{
    drogue_camera c = pinhole(0, 0, 0, 0);
    drogue_q16 u = 132086166;
    drogue_q16 v = 209699345;
    c.fx_px_q16 = 172076256;
    c.fy_px_q16 = 176724429;
    c.k1_q16 = -11154;
    c.k2_q16 = 4630;
    c.p1_q16 = 652;
    c.p2_q16 = -547;
    c.k3_q16 = -792;
    ck_assert_int_eq(drogue_undistort_point(&u, &v, &c), DROGUE_OK);
    ck_assert_int_eq(drogue_distort_point(&u, &v, &c), DROGUE_OK);
    ck_assert_int_le(abs(u - 132086166), 12);
    ck_assert_int_le(abs(v - 209699345), 12);
}
END_TEST

SUITE_MAIN("undistort", calibrated_cameras, usual_cameras, long_focal_lengths, no_distortion_is_the_identity,
           any_coefficient_distorts, steep_along_one_axis, outside_the_domain, a_steep_fold_is_not_crossed,
           to_and_fro_is_there)
