/* SPDX-License-Identifier: Apache-2.0 */
/* Twin poses in the tracker: which is followed, when the orientation is known. */
#include "track_steps.h"

static double yaw_of_track(const drogue_track *t)
{
    drogue_track_estimate e;
    drogue_track_get(&e, t);
    return real_of_q16(e.yaw_rad_q16);
}

static void must_be_resolved(const drogue_track *t, int resolved)
{
    drogue_track_estimate e;
    drogue_track_get(&e, t);
    ck_assert_int_eq(e.orientation_resolved, resolved);
}

START_TEST(twins_go_by_continuity)
{
    const drogue_result hit = seen(0, 0, 8, 0.3, 0);
    drogue_result turned = seen(0, 0, 8, -0.3, 0);
    drogue_track t = steady_track(&hit);
    unsigned k;
    turned.alternative = hit.pose;
    turned.orientation_resolved = 0;
    for (k = 1; k < t.config.known_frames; k++) {
        ck_assert_int_eq(step(&t, &turned), DROGUE_TRACKING);
        ck_assert_int_eq(t.orientation_known, 1);
    }
    MUST(fabs(yaw_of_track(&t) - 0.3) < 0.005, "open twins: yaw %g", yaw_of_track(&t));
    turned.orientation_resolved = 1;
    for (k = 1; k < t.config.agree_frames; k++) { /* resolved, but against a confident prediction */
        ck_assert_int_eq(step(&t, &turned), DROGUE_TRACKING);
        MUST(fabs(yaw_of_track(&t) - 0.3) < 0.005, "resolved %u times: yaw %g", k, yaw_of_track(&t));
        must_be_resolved(&t, 0); /* contradicted */
    }
    ck_assert_int_eq(step(&t, &hit), DROGUE_TRACKING); /* the count begins again */
    must_be_resolved(&t, 1);
    for (k = 1; k < t.config.agree_frames; k++) {
        ck_assert_int_eq(step(&t, &turned), DROGUE_TRACKING);
        MUST(fabs(yaw_of_track(&t) - 0.3) < 0.005, "again %u times: yaw %g", k, yaw_of_track(&t));
    }
    ck_assert_int_eq(step(&t, &turned), DROGUE_TRACKING);
    MUST(fabs(yaw_of_track(&t) + 0.3) < 0.005, "after as many as it takes: yaw %g", yaw_of_track(&t));
    must_be_at(&t, 0, 0, 8, 0.001);
}
END_TEST

/* What is known of the orientation goes when nothing decides for long, or both twins fit the prediction. */
START_TEST(orientation_is_forgotten)
{
    const drogue_result hit = seen(0, 0, 8, 0.3, 0);
    drogue_result open = hit;
    drogue_track t = steady_track(&hit), forever;
    unsigned k;
    open.orientation_resolved = 0;
    open.alternative = seen(0, 0, 8, -0.3, 0).pose;
    forever = t;
    forever.config.known_frames = 0;
    for (k = 1; k <= t.config.known_frames; k++) {
        ck_assert_int_eq(t.orientation_known, 1);
        ck_assert_int_eq(step(&t, &open), DROGUE_TRACKING);
        ck_assert_int_eq(step(&forever, &open), DROGUE_TRACKING);
    }
    ck_assert_int_eq(t.orientation_known, 0);
    ck_assert_int_eq(forever.orientation_known, 1);
    t = steady_track(&hit);
    open.alternative = seen(0, 0, 8, 0.28, 0).pose;
    ck_assert_int_eq(step(&t, &open), DROGUE_TRACKING);
    ck_assert_int_eq(t.orientation_known, 0);
    ck_assert_int_eq(step(&t, &hit), DROGUE_TRACKING);
    ck_assert_int_eq(t.orientation_known, 1);
}
END_TEST

/* A covariance whose entries are halved is what it says, whether it holds the distance of the twins or not. */
START_TEST(halved_covariances)
{
    int open;
    for (open = 0; open < 2; open++) {
        drogue_result whole = seen(0, 0, 8, 0.3, 0);
        drogue_result halved;
        drogue_track a = new_track();
        drogue_track b = a;
        int i, k;
        whole.orientation_resolved = !open;
        whole.alternative = seen(0.25, 0, 8.25, -0.25, 0.125).pose;
        for (i = 0; i < 5; i++) {
            for (k = 0; k < 5; k++) {
                whole.covariance_q48[i][k] = (INT64_C(1) << 47) / (i == k ? 1 : 16);
            }
        }
        halved = whole;
        halved.covariance_halved = 3;
        for (i = 0; i < 25; i++) {
            halved.covariance_q48[i / 5][i % 5] /= 8;
        }
        for (k = 0; k < 5; k++) {
            ck_assert_int_eq(step(&a, &whole), step(&b, &halved));
            ck_assert_mem_eq(&a, &b, sizeof a);
        }
    }
}
END_TEST

/* However often a result says, a covariance is halved 0 to 63 times: more of it is not less. */
START_TEST(halved_beyond_what_can_be_read)
{
    static const int32_t said[2] = {64, -1}, read[2] = {63, 0};
    int i;
    for (i = 0; i < 2; i++) {
        drogue_result a = seen(0, 0, 8, 0.3, 0), b;
        drogue_track s = new_track();
        drogue_track t = s;
        int k;
        for (k = 0; k < 5; k++) {
            a.covariance_q48[k][k] = INT64_C(1) << 20;
        }
        b = a;
        a.covariance_halved = said[i];
        b.covariance_halved = read[i];
        (void)step(&s, &a);
        (void)step(&t, &b);
        ck_assert_mem_eq(&s, &t, sizeof s);
    }
}
END_TEST

/* An unresolved result's covariance holds the distance of the twins: the filter follows one of them without it, and its
 * estimate's standard deviation keeps it while the orientation is open. */
START_TEST(distance_of_twins)
{
    const double std[5] = {0.001, 0.001, 0.01, 0.01, 0.01};
    drogue_result r = seen(0.1, 0, 8, 0.3, 0);
    drogue_track t;
    drogue_track_estimate e;
    uint64_t rng = 5;
    int spread, k;
    for (spread = 0; spread <= 1; spread++) {
        set_covariance(&r, std);
        r.orientation_resolved = 0;
        r.has_inner = 1;
        r.alternative = seen(0.12, 0, 8, -0.3, 0).pose;
        if (spread) {
            r.covariance_q48[0][0] += (int64_t)(0.5 * 0.02 * 0.02 * 281474976710656.0);
            r.covariance_q48[3][3] += (int64_t)(0.5 * 0.6 * 0.6 * 281474976710656.0);
            r.covariance_q48[0][3] = r.covariance_q48[3][0] = (int64_t)(-0.5 * 0.02 * 0.6 * 281474976710656.0);
        }
        t = new_track();
        for (k = 0; k < 60; k++) { /* with noise, which tells calm flight from gusts */
            const int32_t noise = q16_of(0.001 * rng_normal(&rng));
            r.pose.position_m_q16[0] = q16_of(0.1) + noise;
            r.alternative.position_m_q16[0] = q16_of(0.12) + noise;
            ck_assert_int_eq(step(&t, &r), DROGUE_TRACKING);
        }
        MUST(fabs(yaw_of_track(&t) - 0.3) < 0.001, "yaw %g", yaw_of_track(&t));
        drogue_track_get(&e, &t);
        ck_assert_double_lt(ldexp((double)e.position_std_m_q32[1], -32), 0.0012);
        MUST((ldexp((double)e.position_std_m_q32[0], -32) > 0.01) == spread, "std of x %g",
             ldexp((double)e.position_std_m_q32[0], -32));
        r.pose.position_m_q16[0] += q16_of(0.03); /* 30 standard deviations: not that of both, and refused */
        r.alternative.position_m_q16[0] += q16_of(0.03);
        ck_assert_int_eq(step(&t, &r), DROGUE_COASTING);
    }
}
END_TEST

START_TEST(the_first_resolved_frame_turns_open_twins)
{
    drogue_result open = seen(0, 0, 8, 0.3, 0.1), resolved = seen(0, 0, 8, -0.3, -0.1);
    drogue_track t;
    drogue_track_estimate e;
    open.orientation_resolved = 0;
    open.alternative = resolved.pose;
    resolved.alternative = open.pose;
    t = steady_track(&open);
    drogue_track_get(&e, &t);
    ck_assert_int_eq(e.orientation_resolved, 0);
    ck_assert_int_eq(step(&t, &resolved), DROGUE_TRACKING);
    drogue_track_get(&e, &t);
    ck_assert_int_eq(e.orientation_resolved, 1);
    MUST(fabs(real_of_q16(e.yaw_rad_q16) + 0.3) < 0.005 && fabs(real_of_q16(e.pitch_rad_q16) + 0.1) < 0.005,
         "not turned");
    ck_assert_int_eq(step(&t, &open), DROGUE_TRACKING);
    MUST(fabs(yaw_of_track(&t) + 0.3) < 0.005, "turned back");
}
END_TEST

/* A resolved pose that turns open twins must be where the track is: chi squared of x, y and z, 16.27 at 0.1 %, not the
 * 20.52 of all five, and of the depth as of the rest. */
START_TEST(what_turns_open_twins_is_where_the_track_is)
{
    static const struct {
        int parameter;
        double chi2;
        int believed;
    } cases[] = {{DROGUE_X, 15.5, 1}, {DROGUE_X, 17, 0}, {DROGUE_X, 20, 0}, {DROGUE_Y, 15.5, 1}, {DROGUE_Y, 17, 0},
                 {DROGUE_Z, 15.5, 1}, {DROGUE_Z, 17, 0}, {DROGUE_Z, 20, 0}, {DROGUE_Z, 100, 0}};
    const double std[5] = {0.01, 0.01, 0.02, 0.01, 0.01};
    drogue_result open = seen(0, 0, 8, 0.3, 0.1);
    drogue_track start;
    size_t i;
    set_covariance(&open, std);
    open.orientation_resolved = 0;
    open.has_inner = 1;
    open.alternative = seen(0, 0, 8, -0.3, -0.1).pose;
    start = steady_track(&open);
    for (i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        drogue_track t = start;
        drogue_result resolved = open;
        drogue_kalman gate;
        drogue_region region;
        double variance, off;
        int p = cases[i].parameter;
        drogue_track_begin(&region, &t, DT_US);
        drogue_bank_mix(&gate, &t.bank, 1);
        variance = ldexp(gate.parameter[p].variance[0].mantissa, gate.parameter[p].variance[0].exponent) +
                   std[p] * std[p] + pow(real_of_q16(t.config.position_floor_m_q16), 2) +
                   (p == DROGUE_Z ? pow(real_of_q16(t.config.depth_std_q16) * 8, 2) : 0);
        off = sqrt(cases[i].chi2 * variance);
        resolved.orientation_resolved = 1;
        resolved.pose = open.alternative;
        resolved.alternative = open.pose;
        resolved.pose.position_m_q16[p] += q16_of(off);
        resolved.alternative.position_m_q16[p] += q16_of(off);
        MUST(drogue_track_end(&t, &resolved) == (cases[i].believed ? DROGUE_TRACKING : DROGUE_COASTING),
             "case %d, %g m off: %s", (int)i, off, drogue_track_state_name(t.state));
        MUST((yaw_of_track(&t) < 0) == cases[i].believed, "case %d: yaw %g", (int)i, yaw_of_track(&t));
    }
}
END_TEST

/* What correlates a pose's angles with its place is its own: of the twin's nothing is known, and a twin four standard
 * deviations off, which those of the pose would make more than its gate takes, is followed. */
START_TEST(correlations_are_not_the_twins)
{
    const double std[5] = {0.02, 0.02, 0.05, 0.02, 0.02}, q48 = 281474976710656.0;
    drogue_result steady = seen(0, 0, 8, -0.3, 0), r;
    drogue_track start, t;
    int k;
    set_covariance(&steady, std);
    start = steady_track(&steady);
    for (k = 0; k < 200; k++) { /* a confident prediction */
        start.config.process_std_q16[DROGUE_X] = start.config.process_std_q16[DROGUE_YAW] = q16_of(0.001);
        (void)step(&start, &steady);
    }
    r = seen(0.08, 0, 8, 0.3, 0); /* four deviations in x, none in yaw of one of them */
    r.orientation_resolved = 0;
    r.has_inner = 1;
    r.alternative = seen(0.08, 0, 8, -0.3, 0).pose;
    set_covariance(&r, std);
    r.covariance_q48[0][3] = r.covariance_q48[3][0] = (int64_t)(0.99 * std[0] * std[3] * q48);
    t = start;
    ck_assert_int_eq(step(&t, &r), DROGUE_TRACKING);
    ck_assert_int_eq(t.gated, 0);
    MUST(yaw_of_track(&t) < -0.25, "yaw %g", yaw_of_track(&t));
    t = start; /* and of the pose they are known */
    steady = r;
    steady.pose = r.alternative;
    steady.alternative = r.pose;
    ck_assert_int_eq(step(&t, &steady), DROGUE_COASTING);
    ck_assert_int_eq(t.gated, 1);
}
END_TEST

SUITE_MAIN("orientation", twins_go_by_continuity, orientation_is_forgotten, distance_of_twins, halved_covariances,
           halved_beyond_what_can_be_read, the_first_resolved_frame_turns_open_twins,
           what_turns_open_twins_is_where_the_track_is, correlations_are_not_the_twins)
