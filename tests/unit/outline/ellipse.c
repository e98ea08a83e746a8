/* SPDX-License-Identifier: Apache-2.0 */
/* Moments as exact sums, exact conics, invariances, and points that determine no ellipse. */
#include "suite.h"

#include "drogue/ellipse.h"
#include "geometry.h"

__extension__ typedef __int128 s128;

static s128 value_of(drogue_long_sum v) { return (s128)v.high * ((s128)1 << 32) + (s128)v.low; }

static void check_moments(const drogue_moments *m, const s128 s[5][5])
{
    ck_assert(m->n == s[0][0] && m->m10 == s[1][0] && m->m01 == s[0][1]);
    ck_assert(m->m20 == s[2][0] && m->m11 == s[1][1] && m->m02 == s[0][2]);
    ck_assert(m->m30 == s[3][0] && m->m21 == s[2][1] && m->m12 == s[1][2] && m->m03 == s[0][3]);
    ck_assert(value_of(m->m40) == s[4][0] && value_of(m->m31) == s[3][1] && value_of(m->m22) == s[2][2]);
    ck_assert(value_of(m->m13) == s[1][3] && value_of(m->m04) == s[0][4]);
}

static void model_add(s128 s[5][5], int32_t x, int32_t y)
{
    s128 px = 1;
    int p, q;
    for (p = 0; p <= 4; p++, px *= x) {
        s128 v = px;
        for (q = 0; p + q <= 4; q++, v *= y) {
            s[p][q] += v;
        }
    }
}

START_TEST(moments_are_exact_sums)
{
    uint64_t rng = 1;
    int round, i;
    for (round = 0; round < 300; round++) {
        s128 s[5][5];
        drogue_moments sum;
        memset(s, 0, sizeof s);
        drogue_moments_clear(&sum);
        for (i = 0; i < 200; i++) {
            int32_t x = rng_range(&rng, -32768, 32767), y = rng_range(&rng, -32768, 32767);
            model_add(s, x, y);
            drogue_moments_add_point(&sum, x, y);
        }
        check_moments(&sum, (const s128(*)[5])s);
    }
}
END_TEST

START_TEST(moments_hold_the_most_points)
{
    static const int32_t corner[4][2] = {{-32768, -32768}, {-32768, 32767}, {32767, -32768}, {32767, 32767}};
    int c, i;
    for (c = 0; c < 4; c++) {
        s128 s[5][5];
        drogue_moments m;
        memset(s, 0, sizeof s);
        drogue_moments_clear(&m);
        for (i = 0; i < DROGUE_MAX_FIT_POINTS; i++) {
            model_add(s, corner[c][0], corner[c][1]);
            drogue_moments_add_point(&m, corner[c][0], corner[c][1]);
        }
        check_moments(&m, (const s128(*)[5])s);
    }
}
END_TEST

static drogue_moments moments_of(const int32_t (*points)[2], int count, int32_t dx, int32_t dy, int32_t scale)
{
    drogue_moments m;
    int i;
    drogue_moments_clear(&m);
    for (i = 0; i < count; i++) {
        drogue_moments_add_point(&m, scale * points[i][0] + dx, scale * points[i][1] + dy);
    }
    return m;
}

static const int32_t circle5[12][2] = {{5, 0},  {4, 3},   {3, 4},   {0, 5},  {-3, 4}, {-4, 3},
                                       {-5, 0}, {-4, -3}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}};

/* Integer points exactly on circles and ellipses: the scatter is singular, the answer exact. */
START_TEST(exact_conics)
{
    static const int32_t offset[5][2] = {{0, 0}, {1000, -700}, {-20000, 15000}, {31000, 31000}, {-3, 25000}};
    int first, count, k, i;
    int32_t scale;
    for (k = 0; k < 5; k++) {
        for (scale = 1; scale <= 200; scale += scale < 8 ? 1 : 17) {
            for (first = 0; first < 12; first++) {
                for (count = 6; count <= 12; count++) {
                    int32_t points[12][2];
                    drogue_ellipse e;
                    drogue_moments m;
                    for (i = 0; i < count; i++) {
                        points[i][0] = circle5[(first + i) % 12][0];
                        points[i][1] = circle5[(first + i) % 12][1];
                    }
                    m = moments_of((const int32_t(*)[2])points, count, offset[k][0], offset[k][1], scale);
                    MUST(drogue_ellipse_fit(&e, &m, 3) == DROGUE_OK, "circle refused: scale %d first %d count %d",
                         (int)scale, first, count);
                    MUST(abs(e.xc_px_q16 - offset[k][0] * 8192) <= 1 && abs(e.yc_px_q16 - offset[k][1] * 8192) <= 1 &&
                             abs(e.a_px_q16 - scale * 5 * 8192) <= 1 && abs(e.b_px_q16 - scale * 5 * 8192) <= 1,
                         "circle: scale %d first %d count %d gives %d %d %d %d", (int)scale, first, count,
                         (int)e.xc_px_q16, (int)e.yc_px_q16, (int)e.a_px_q16, (int)e.b_px_q16);
                    for (i = 0; i < count; i++) { /* twice as long upward */
                        points[i][1] *= 2;
                    }
                    m = moments_of((const int32_t(*)[2])points, count, offset[k][0], offset[k][1] / 2, scale);
                    if (offset[k][1] / 2 + 10 * scale <= 32767) {
                        MUST(drogue_ellipse_fit(&e, &m, 3) == DROGUE_OK, "ellipse refused: scale %d first %d count %d",
                             (int)scale, first, count);
                        MUST(abs(e.a_px_q16 - scale * 10 * 8192) <= 1 && abs(e.b_px_q16 - scale * 5 * 8192) <= 1 &&
                                 e.angle_rad_q16 == DROGUE_Q16_HALF_PI,
                             "ellipse: scale %d first %d count %d gives %d %d %d", (int)scale, first, count,
                             (int)e.a_px_q16, (int)e.b_px_q16, (int)e.angle_rad_q16);
                    }
                }
            }
        }
    }
}
END_TEST

START_TEST(five_points_determine_an_ellipse)
{
    const int32_t points[6][2] = {{10, 0}, {8, 3}, {0, 5}, {-6, -4}, {6, -4}, {10, 0}};
    drogue_moments m = moments_of(points, 6, 0, 0, 1);
    drogue_ellipse e;
    ck_assert_int_eq(drogue_ellipse_fit(&e, &m, 0), DROGUE_OK);
    ck_assert_int_le(abs(e.a_px_q16 - 10 * 65536), 1);
    ck_assert_int_le(abs(e.b_px_q16 - 5 * 65536), 1);
    ck_assert_int_eq(e.angle_rad_q16, 0);
}
END_TEST

START_TEST(arguments)
{
    drogue_moments m = moments_of(circle5, 12, 0, 0, 1);
    drogue_ellipse e;
    int n;
    ck_assert_int_eq(drogue_ellipse_fit(&e, &m, 0), DROGUE_OK);
    ck_assert_int_eq(drogue_ellipse_fit(&e, &m, 15), DROGUE_OK);
    ck_assert_int_eq(drogue_ellipse_fit(&e, &m, -1), DROGUE_E_ARGUMENT);
    ck_assert_int_eq(drogue_ellipse_fit(&e, &m, 16), DROGUE_E_ARGUMENT);
    m.n = DROGUE_MAX_FIT_POINTS + 1;
    ck_assert_int_eq(drogue_ellipse_fit(&e, &m, 0), DROGUE_E_ARGUMENT);
    for (n = 0; n < 6; n++) {
        m = moments_of(circle5, n, 0, 0, 1);
        ck_assert_int_eq(drogue_ellipse_fit(&e, &m, 0), DROGUE_E_TOO_FEW_POINTS);
    }
}
END_TEST

START_TEST(points_that_determine_no_ellipse)
{
    static const int32_t step[7][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {3, -2}, {-7, 5}, {100, 1}};
    static const int32_t offset[4][2] = {{0, 0}, {123, -456}, {-20000, 20000}, {31, 29}};
    int32_t points[60][2];
    drogue_ellipse e;
    drogue_moments m;
    int d, k, i, distinct;
    for (d = 0; d < 7; d++) {
        for (k = 0; k < 4; k++) {
            for (i = 0; i < 60; i++) {
                points[i][0] = i * step[d][0];
                points[i][1] = i * step[d][1];
            }
            m = moments_of((const int32_t(*)[2])points, 60, offset[k][0], offset[k][1], 1);
            MUST(drogue_ellipse_fit(&e, &m, 5) == DROGUE_E_DEGENERATE, "line %d at offset %d accepted", d, k);
        }
    }
    for (distinct = 1; distinct <= 4; distinct++) { /* fewer than the five that a conic needs */
        for (k = 0; k < 4; k++) {
            for (i = 0; i < 60; i++) {
                points[i][0] = 7 * circle5[3 * (i % distinct)][0] + i % distinct;
                points[i][1] = 7 * circle5[3 * (i % distinct)][1];
            }
            m = moments_of((const int32_t(*)[2])points, 60, offset[k][0], offset[k][1], 1);
            MUST(drogue_ellipse_fit(&e, &m, 5) == DROGUE_E_DEGENERATE, "%d distinct points at offset %d accepted",
                 distinct, k);
        }
    }
    for (i = 0; i < 60; i++) { /* two crossing lines, then two parallel ones */
        points[i][0] = i - 30;
        points[i][1] = i & 1 ? i - 30 : 30 - i;
    }
    m = moments_of((const int32_t(*)[2])points, 60, 50, 60, 3);
    (void)drogue_ellipse_fit(&e, &m, 5); /* an ellipse of least squares or none, but defined: checked by sanitizers */
    ck_assert(e.a_px_q16 >= e.b_px_q16);
}
END_TEST

START_TEST(parameters_that_leave_q16)
{
    drogue_moments m;
    drogue_ellipse e;
    int32_t x;
    drogue_moments_clear(&m);
    for (x = -10000; x <= 10000; x += 10) { /* radius 50000 px */
        drogue_moments_add_point(&m, x, (int32_t)floor(50000 - sqrt(2.5e9 - (double)x * x) + 0.5));
    }
    ck_assert_int_eq(drogue_ellipse_fit(&e, &m, 0), DROGUE_E_DEGENERATE);
    ck_assert_int_eq(drogue_ellipse_fit(&e, &m, 2), DROGUE_OK); /* 12500 px fit */
    ck_assert_int_lt(abs(e.a_px_q16 - 12500 * 65536), 3000 * 65536);
}
END_TEST

/* Points rounded to 1/32 px on a known ellipse. Returns the fit. */
static drogue_ellipse fit_points(const ellipse_real *truth, double from, double span, int count, int32_t dx, int32_t dy,
                                 int frac_bits)
{
    drogue_moments m;
    drogue_ellipse e;
    int i;
    drogue_moments_clear(&m);
    for (i = 0; i < count; i++) {
        double x, y;
        ellipse_point(&x, &y, truth, from + span * i / count);
        drogue_moments_add_point(&m, (int32_t)floor(x * 32 + 0.5) + dx, (int32_t)floor(y * 32 + 0.5) + dy);
    }
    MUST(drogue_ellipse_fit(&e, &m, frac_bits) == DROGUE_OK, "a %.2f b %.2f from %.3f span %.3f refused", truth->a,
         truth->b, from, span);
    MUST(e.a_px_q16 >= e.b_px_q16 && e.b_px_q16 > 0 && e.angle_rad_q16 <= DROGUE_Q16_HALF_PI &&
             e.angle_rad_q16 > -DROGUE_Q16_HALF_PI,
         "ellipse out of form");
    return e;
}

START_TEST(known_ellipses_are_found)
{
    uint64_t rng = 2;
    int i;
    for (i = 0; i < 3000; i++) {
        ellipse_real t;
        drogue_ellipse e;
        t.a = exp(rng_real(&rng, log(8.0), log(450.0)));
        t.b = t.a * rng_real(&rng, 0.4, 1);
        t.angle = rng_real(&rng, -TEST_PI / 2, TEST_PI / 2);
        t.xc = rng_real(&rng, -400, 400);
        t.yc = rng_real(&rng, -400, 400);
        e = fit_points(&t, rng_real(&rng, 0, 6), 2 * TEST_PI, 20 + (int)(6 * t.a), 0, 0, 5);
        MUST(fabs(real_of_q16(e.xc_px_q16) - t.xc) < 0.02 && fabs(real_of_q16(e.yc_px_q16) - t.yc) < 0.02 &&
                 fabs(real_of_q16(e.a_px_q16) - t.a) < 0.02 && fabs(real_of_q16(e.b_px_q16) - t.b) < 0.02,
             "case %d: off by %g %g %g %g px", i, real_of_q16(e.xc_px_q16) - t.xc, real_of_q16(e.yc_px_q16) - t.yc,
             real_of_q16(e.a_px_q16) - t.a, real_of_q16(e.b_px_q16) - t.b);
        if (t.b < 0.95 * t.a) {
            MUST(fabs(angle_difference(real_of_q16(e.angle_rad_q16), t.angle, TEST_PI)) < 0.1 / (t.a - t.b),
                 "angle of case %d", i);
        }
    }
}
END_TEST

/* The angle just above -pi/2 rounds to what is below it: it is given as pi/2. */
START_TEST(angles_next_to_half_a_turn)
{
    int i;
    for (i = -40; i <= 40; i++) {
        const ellipse_real t = {3, -2, 900, 450, TEST_PI / 2 + i * 5e-7};
        drogue_ellipse e = fit_points(&t, 0, 2 * TEST_PI, 6000, 0, 0, 5);
        MUST(abs(e.angle_rad_q16) >= DROGUE_Q16_HALF_PI - 3, "angle %d of case %d", (int)e.angle_rad_q16, i);
    }
}
END_TEST

START_TEST(a_shift_and_a_unit_change_nothing_else)
{
    uint64_t rng = 3;
    int i;
    for (i = 0; i < 1000; i++) {
        ellipse_real t = {0, 0, 100, 60, 0.7};
        double from = rng_real(&rng, 0, 6), span = rng_real(&rng, 1.6, 6.2);
        int32_t dx = rng_range(&rng, -29000, 29000), dy = rng_range(&rng, -29000, 29000);
        drogue_ellipse e = fit_points(&t, from, span, 300, 0, 0, 5), f = fit_points(&t, from, span, 300, dx, dy, 5);
        drogue_ellipse g = fit_points(&t, from, span, 300, 0, 0, 3);
        MUST(abs(f.a_px_q16 - e.a_px_q16) <= 1 && abs(f.b_px_q16 - e.b_px_q16) <= 1 &&
                 abs(f.xc_px_q16 - dx * 2048 - e.xc_px_q16) <= 1 && abs(f.yc_px_q16 - dy * 2048 - e.yc_px_q16) <= 1 &&
                 abs(f.angle_rad_q16 - e.angle_rad_q16) <= 1,
             "case %d moved", i);
        MUST(abs(g.a_px_q16 - 4 * e.a_px_q16) <= 4 && abs(g.xc_px_q16 - 4 * e.xc_px_q16) <= 4 &&
                 abs(g.angle_rad_q16 - e.angle_rad_q16) <= 1,
             "case %d rescaled", i);
    }
}
END_TEST

SUITE_MAIN("ellipse", moments_are_exact_sums, moments_hold_the_most_points, exact_conics,
           five_points_determine_an_ellipse, arguments, points_that_determine_no_ellipse, parameters_that_leave_q16,
           known_ellipses_are_found, angles_next_to_half_a_turn, a_shift_and_a_unit_change_nothing_else)
