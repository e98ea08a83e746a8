/* SPDX-License-Identifier: Apache-2.0 */
/* Equality of candidates (16) at its thresholds, and the winner against the definition. */
#include "suite.h"

#include "drogue/cluster.h"

static const drogue_cluster_config config = {5 * 32768, 2 * 65536, 65536, 13107, 58982};

static drogue_candidate candidate(double x, double y, double a, double b, double angle)
{
    drogue_candidate c;
    memset(&c, 0, sizeof c);
    c.ellipse.xc_px_q16 = q16_of(x);
    c.ellipse.yc_px_q16 = q16_of(y);
    c.ellipse.a_px_q16 = q16_of(a);
    c.ellipse.b_px_q16 = q16_of(b);
    c.ellipse.angle_rad_q16 = q16_of(angle);
    return c;
}

static int same(drogue_candidate i, drogue_candidate j)
{
    int forth = !!drogue_same_ellipse(&i, &j, &config), back = !!drogue_same_ellipse(&j, &i, &config);
    ck_assert_int_eq(forth, back);
    return forth;
}

START_TEST(each_threshold_is_strict)
{
    const drogue_candidate e = candidate(100, 90, 40, 20, 0.5);
    drogue_candidate f = e;
    ck_assert(same(e, e));
    f.ellipse.xc_px_q16 += config.centre_px_q16;
    ck_assert(!same(e, f));
    f.ellipse.xc_px_q16--;
    ck_assert(same(e, f));
    f.ellipse.yc_px_q16 += 65536;
    ck_assert(!same(e, f));                                 /* 2.5 px minus an LSB across, 1 down */
    ck_assert(!same(e, candidate(101.5, 92, 40, 20, 0.5))); /* 1.5, 2: just 2.5 */
    ck_assert(same(e, candidate(101.5, 91.9999, 40, 20, 0.5)));
    f = e;
    f.ellipse.a_px_q16 -= config.a_px_q16;
    ck_assert(!same(e, f));
    f.ellipse.a_px_q16++;
    ck_assert(same(e, f));
    f = e;
    f.ellipse.b_px_q16 += config.b_px_q16;
    ck_assert(!same(e, f));
    f.ellipse.b_px_q16--;
    ck_assert(same(e, f));
    f = e;
    f.ellipse.angle_rad_q16 -= config.angle_rad_q16;
    ck_assert(!same(e, f));
    f.ellipse.angle_rad_q16++;
    ck_assert(same(e, f));
    f = e;
    f.polarity = 1;
    ck_assert(!same(e, f));
}
END_TEST

START_TEST(angles_are_compared_modulo_pi)
{
    ck_assert(same(candidate(0, 0, 40, 20, 1.55), candidate(0, 0, 40, 20, -1.55)));
    ck_assert(!same(candidate(0, 0, 40, 20, 1.45), candidate(0, 0, 40, 20, -1.45)));
    ck_assert(!same(candidate(0, 0, 40, 20, 0.0), candidate(0, 0, 40, 20, 1.57)));
}
END_TEST

START_TEST(circles_have_no_angle)
{
    ck_assert(same(candidate(0, 0, 40, 39.5, 0), candidate(0, 0, 40, 39.2, 1.5)));
    ck_assert(!same(candidate(0, 0, 40, 36.5, 0), candidate(0, 0, 40, 35.9, 1.5)));
    ck_assert(!same(candidate(0, 0, 40, 35.9, 0), candidate(0, 0, 40, 35.9, 1.5)));
}
END_TEST

START_TEST(extremes_do_not_overflow)
{
    const drogue_candidate far = {{INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX, 102944}, 0, 0, 0, 0, 0};
    const drogue_candidate near = {{INT32_MIN, INT32_MIN, 1, 1, -102943}, 0, 0, 0, 0, 0};
    ck_assert(!same(far, near));
    ck_assert(same(far, far));
    ck_assert(same(near, near));
}
END_TEST

/* The definition: reliability first, then members, then order. */
static int32_t model_best(uint32_t *members, const drogue_candidate *c, uint32_t count)
{
    int32_t best = -1;
    uint32_t i, j;
    *members = 0;
    for (i = 0; i < count; i++) {
        uint32_t like = 0;
        for (j = 0; j < count; j++) {
            like += i == j || drogue_same_ellipse(&c[i], &c[j], &config);
        }
        if (best < 0 || c[i].reliability_q16 > c[best].reliability_q16 ||
            (c[i].reliability_q16 == c[best].reliability_q16 && like > *members)) {
            best = (int32_t)i;
            *members = like;
        }
    }
    return best;
}

START_TEST(winner_of_random_sets)
{
    drogue_candidate c[30];
    uint64_t rng = 1;
    uint32_t i, members, expected;
    int round;
    for (round = 0; round < 20000; round++) {
        uint32_t count = (uint32_t)rng_range(&rng, 0, 30);
        for (i = 0; i < count; i++) {
            c[i] = candidate(rng_range(&rng, 0, 3) * 2, rng_range(&rng, 0, 3), 40 + rng_range(&rng, 0, 3), 30,
                             0.1 * rng_range(&rng, 0, 3));
            c[i].reliability_q16 = rng_range(&rng, 0, 4) * 10000;
            c[i].polarity = (uint32_t)rng_range(&rng, 0, 1);
        }
        MUST(drogue_cluster_best(&members, c, count, &config) == model_best(&expected, c, count), "round %d", round);
        MUST(members == expected, "round %d: %u members instead of %u", round, (unsigned)members, (unsigned)expected);
    }
}
END_TEST

SUITE_MAIN("cluster", each_threshold_is_strict, angles_are_compared_modulo_pi, circles_have_no_angle,
           extremes_do_not_overflow, winner_of_random_sets)
