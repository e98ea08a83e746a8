/* SPDX-License-Identifier: Apache-2.0 */
/* Conics that are no ellipse, or none that Q16 holds, are refused; others give the ellipse. */
#include "suite.h"

#include "drogue/ellipse.h"

/* Conic F + D x + E y + A x^2 + B x y + C y^2, whole numbers, in units of 2^-bits px about a whole pixel. */
static drogue_status of(drogue_ellipse *e, const int64_t c[6], int32_t centre_px, int bits)
{
    const int32_t centre[2] = {centre_px << bits, centre_px << bits};
    drogue_real q[6];
    int k;
    for (k = 0; k < 6; k++) {
        drogue_real_set(&q[k], c[k], 0);
    }
    return drogue_conic_ellipse(e, q, centre, bits);
}

START_TEST(ellipses)
{
    drogue_ellipse e;
    ck_assert_int_eq(of(&e, (const int64_t[6]){-3600, 0, 0, 9, 0, 16}, 7, 0), DROGUE_OK); /* semi-axes 20 and 15 */
    ck_assert(e.xc_px_q16 == 7 * 65536 && e.yc_px_q16 == 7 * 65536);
    ck_assert(abs(e.a_px_q16 - 20 * 65536) <= 1 && abs(e.b_px_q16 - 15 * 65536) <= 1 && e.angle_rad_q16 == 0);
    ck_assert_int_eq(of(&e, (const int64_t[6]){-3600, 0, 0, 16, 0, 9}, 0, 0), DROGUE_OK); /* upright */
    ck_assert(abs(e.a_px_q16 - 20 * 65536) <= 1 && e.angle_rad_q16 == DROGUE_Q16_HALF_PI);
    ck_assert_int_eq(of(&e, (const int64_t[6]){-400, 0, 0, 1, 0, 1}, 0, 0), DROGUE_OK); /* a circle has no angle */
    ck_assert(e.a_px_q16 == e.b_px_q16 && e.angle_rad_q16 == 0);
}
END_TEST

START_TEST(no_ellipses)
{
    static const int64_t conics[][6] = {
        {-100, 0, 0, 1, 0, -1}, /* hyperbola */
        {-100, 0, 1, 1, 0, 0},  /* parabola */
        {100, 0, 0, -1, 0, -1}, /* the circle of 10 px with the other sign */
        {100, 0, 0, 1, 0, 1},   /* no real point */
        {0, 0, 0, 1, 0, 1},     /* one point */
    };
    drogue_ellipse e;
    size_t k;
    for (k = 0; k < sizeof conics / sizeof *conics; k++) {
        MUST(of(&e, conics[k], 0, 0) == DROGUE_E_DEGENERATE, "conic %zu accepted", k);
    }
}
END_TEST

START_TEST(beyond_q16)
{
    const int64_t one = INT64_C(1) << 30, far = INT64_C(1) << 60;
    drogue_ellipse e;
    ck_assert_int_eq(of(&e, (const int64_t[6]){-one, 0, 0, 1, 0, 1}, 0, 0), DROGUE_E_DEGENERATE);   /* 2^15 px */
    ck_assert_int_eq(of(&e, (const int64_t[6]){-one, 0, 0, 1, 0, 1}, 0, 1), DROGUE_OK);             /* 2^14 px */
    ck_assert_int_eq(of(&e, (const int64_t[6]){-1, 0, 0, far, 0, far}, 0, 0), DROGUE_E_DEGENERATE); /* 2^-30 px */
    /* centre at +-2^59, clamped before it is added to: not a wrapped coordinate */
    ck_assert_int_eq(of(&e, (const int64_t[6]){0, far, 0, 1, 0, 1}, 0, 0), DROGUE_E_DEGENERATE);
    ck_assert_int_eq(e.xc_px_q16, INT32_MIN);
    ck_assert_int_eq(of(&e, (const int64_t[6]){0, 0, -far, 1, 0, 1}, 0, 0), DROGUE_E_DEGENERATE);
    ck_assert_int_eq(e.yc_px_q16, INT32_MAX);
}
END_TEST

SUITE_MAIN("conic", ellipses, no_ellipses, beyond_q16)
