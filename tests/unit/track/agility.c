/* SPDX-License-Identifier: Apache-2.0 */
/* The tracker in gusts, and what it takes to begin, to take over and to pass the gate. */
#include "track_steps.h"

/* Calm flight but from 4 to 10 s: a swing of 0.5 m at 1.5 Hz that rises within a second. */
static double blown(double s)
{
    const double t = s < 4 || s > 10 ? 0 : s - 4;
    return 0.5 * (1 - cos(2 * TEST_PI * 1.5 * t)) * (t < 1 ? t * t * (3 - 2 * t) : 1);
}

/* Gusts are followed as soon as they begin, none refused, and calm flight is smooth again. */
START_TEST(gusts_are_followed)
{
    const double std[5] = {0.0003, 0.0003, 0.004, 0.002, 0.002};
    drogue_track t = new_track();
    uint64_t rng = 9;
    double rough = 0, calm = 0, raw = 0;
    int k;
    for (k = 0; k < 900; k++) {
        const double s = k * 0.02, x = blown(s), v = (blown(s + 1e-4) - blown(s - 1e-4)) / 2e-4;
        const double noise = std[0] * rng_normal(&rng);
        drogue_result r = seen(x + noise, 0, 8, 0, 0);
        drogue_region region;
        drogue_track_estimate e;
        set_covariance(&r, std);
        drogue_track_begin(&region, &t, 20000);
        MUST(drogue_track_end(&t, &r) == DROGUE_TRACKING || k > 500, "refused in frame %d", k);
        drogue_track_get(&e, &t);
        if (k >= 50 && (k < 200 || k >= 700)) {
            calm += pow(real_of_q16(e.position_m_q16[0]) - x, 2);
            raw += noise * noise;
        } else if (k >= 250 && k < 500) {
            rough += pow(real_of_q16(e.velocity_mps_q16[0]) - v, 2) / 250;
        }
    }
    MUST(sqrt(rough) < 0.08, "velocity in gusts off by %g m/s", sqrt(rough));
    MUST(calm < 0.7 * raw, "filtered over raw in calm flight %g", sqrt(calm / raw));
}
END_TEST

/* A camera that shakes by some milliradians: no model predicts where the drogue is seen. From the first second on it is
 * followed, after a gap, too, and the estimate is as near as the measurement though the rates are smooth. */
START_TEST(a_shaking_camera_is_followed)
{
    const double std[5] = {0.001, 0.001, 0.02, 0.004, 0.004};
    drogue_track t = new_track();
    uint64_t rng = 5;
    double off = 0, raw = 0, rate = 0;
    int refused = 0, k;
    for (k = 0; k < 500; k++) {
        const double s = k * 0.02, yaw = 0.004 * sin(45 * s) + 0.002 * sin(71 * s), x = 12 * yaw;
        const double noise = std[0] * rng_normal(&rng);
        const int gap = k >= 300 && k < 305;
        drogue_result r = gap ? missed(DROGUE_E_NO_ARCS) : seen(x + noise, 0, 12, 0.1 + yaw, 0);
        drogue_region region;
        drogue_track_estimate e;
        set_covariance(&r, std);
        drogue_track_begin(&region, &t, 20000);
        refused += drogue_track_end(&t, &r) != DROGUE_TRACKING && !gap && k >= 50;
        drogue_track_get(&e, &t);
        if (t.state == DROGUE_TRACKING && k >= 50) {
            off += pow(real_of_q16(e.position_m_q16[0]) - x, 2);
            raw += noise * noise;
            rate += pow(real_of_q16(e.velocity_mps_q16[0]), 2) / 450;
        }
        MUST(k < 50 ||
                 fabs(real_of_q16(e.position_m_q16[0]) - x) < 5 * (double)e.position_std_m_q32[0] / 4294967296.0 + 1e-4,
             "frame %d: off by %g", k, real_of_q16(e.position_m_q16[0]) - x);
    }
    MUST(refused == 0, "%d refused", refused);
    MUST(off < 1.2 * raw, "filtered over raw %g", sqrt(off / raw));
    MUST(sqrt(rate) < 1.7, "rate %g m/s", sqrt(rate)); /* the shaking's own is 1.6 */
}
END_TEST

/* What shows no inner part, where the model has one, neither opens a second filter nor leads to another range. */
START_TEST(without_inner_part_nothing_takes_over)
{
    const drogue_result hit = seen(0.2, -0.1, 12, 0.1, 0.05);
    drogue_result empty = seen(0.2, -0.1, 15, 0.1, 0.05);
    drogue_track t = steady_track(&hit);
    unsigned k;
    empty.orientation_resolved = 0;
    for (k = 0; k < t.config.max_missed; k++) {
        ck_assert_int_eq(step(&t, &empty), DROGUE_COASTING);
        ck_assert_int_eq(t.gated, 1);
        ck_assert_uint_eq(t.agreeing, 0);
        must_be_at(&t, 0.2, -0.1, 12, 0.01);
    }
    ck_assert_int_eq(step(&t, &empty), DROGUE_LOST);
    t = steady_track(&hit);
    empty.pose.position_m_q16[2] = empty.alternative.position_m_q16[2] = q16_of(12.7); /* within a wide covariance */
    empty.covariance_q48[2][2] = INT64_C(281474976710656);
    empty.covariance_q48[0][0] = empty.covariance_q48[1][1] = INT64_C(28147497671);
    empty.covariance_q48[3][3] = empty.covariance_q48[4][4] = INT64_C(28147497671065);
    ck_assert_int_eq(step(&t, &empty), DROGUE_COASTING);
    empty.has_inner = 1;
    ck_assert_int_eq(step(&t, &empty), DROGUE_TRACKING);
}
END_TEST

/* A track that began with an inner part and does not show it again within five measurements is lost; once is enough. */
START_TEST(what_begins_must_show_itself_again)
{
    const drogue_result hit = seen(0.2, -0.1, 12, 0.1, 0.05);
    drogue_result empty = hit;
    int again, k;
    empty.orientation_resolved = 0;
    for (again = 0; again <= 1; again++) {
        drogue_track t = new_track();
        ck_assert_int_eq(step(&t, &hit), DROGUE_TRACKING);
        for (k = 1; k < 5; k++) {
            ck_assert_int_eq(step(&t, again && k == 4 ? &hit : &empty), DROGUE_TRACKING);
        }
        ck_assert_int_eq(step(&t, &empty), again ? DROGUE_TRACKING : DROGUE_LOST);
    }
}
END_TEST

/* Light and lens may move a range by some tenths of a percent from one frame to the next, whatever its deviation says. */
START_TEST(gate_has_room_in_depth)
{
    const double std[5] = {0.0005, 0.0005, 0.002, 0.002, 0.002};
    drogue_result hit = seen(0.2, -0.1, 12, 0.1, 0.05), brighter = seen(0.2, -0.1, 12.07, 0.1, 0.05),
                  other = seen(0.2, -0.1, 12.3, 0.1, 0.05);
    drogue_track t;
    set_covariance(&hit, std);
    set_covariance(&brighter, std);
    set_covariance(&other, std);
    t = steady_track(&hit);
    ck_assert_int_eq(step(&t, &brighter), DROGUE_TRACKING);
    t = steady_track(&hit);
    ck_assert_int_eq(step(&t, &other), DROGUE_COASTING);
}
END_TEST

SUITE_MAIN("agility", gusts_are_followed, a_shaking_camera_is_followed, without_inner_part_nothing_takes_over,
           what_begins_must_show_itself_again, gate_has_room_in_depth)
