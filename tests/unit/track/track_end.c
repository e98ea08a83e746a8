/* SPDX-License-Identifier: Apache-2.0 */
/* What the tracker believes: the gate, jumps, coasting, long runs. */
#include "track_steps.h"

START_TEST(an_outlier_is_refused)
{
    const drogue_result hit = seen(0.2, -0.1, 12, 0.1, 0.05);
    const drogue_result outliers[5] = {seen(0.4, -0.1, 12, 0.1, 0.05), seen(0.2, -0.4, 12, 0.1, 0.05),
                                       seen(0.2, -0.1, 11, 0.1, 0.05), seen(0.2, -0.1, 12, 0.4, 0.05),
                                       seen(0.2, -0.1, 12, 0.1, -0.3)};
    int k;
    for (k = 0; k < 5; k++) {
        drogue_track t = steady_track(&hit);
        drogue_track_estimate e;
        ck_assert_int_eq(step(&t, &outliers[k]), DROGUE_COASTING);
        ck_assert_int_eq(t.gated, 1);
        ck_assert_uint_eq(t.missed, 1);
        must_be_at(&t, 0.2, -0.1, 12, 0.001);
        drogue_track_get(&e, &t);
        MUST(fabs(real_of_q16(e.yaw_rad_q16) - 0.1) < 0.001 && fabs(real_of_q16(e.pitch_rad_q16) - 0.05) < 0.001,
             "the angles moved in case %d", k);
        ck_assert_int_eq(step(&t, &hit), DROGUE_TRACKING);
        ck_assert_int_eq(t.gated, 0);
        ck_assert_uint_eq(t.missed, 0);
    }
}
END_TEST

/* A measurement below the least reliability neither starts nor corrects a track. */
START_TEST(an_unreliable_one_counts_as_missed)
{
    drogue_result hit = seen(0.2, -0.1, 12, 0.1, 0.05), weak = seen(0.21, -0.1, 12, 0.1, 0.05);
    drogue_track t = new_track();
    t.config.min_reliability_q16 = hit.quality.reliability_q16 = DROGUE_Q16(6, 10);
    weak.quality.reliability_q16 = hit.quality.reliability_q16 - 1;
    ck_assert_int_eq(step(&t, &weak), DROGUE_LOST);
    ck_assert_int_eq(step(&t, &hit), DROGUE_TRACKING);
    ck_assert_int_eq(step(&t, &weak), DROGUE_COASTING);
    ck_assert_uint_eq(t.missed, 1);
    ck_assert_int_eq(t.gated, 0);
    must_be_at(&t, 0.2, -0.1, 12, 0.001);
    ck_assert_int_eq(step(&t, &hit), DROGUE_TRACKING);
}
END_TEST

/* Half an outline that its region cut, 4 to 8 px off with the small covariance of its own edge points, comes while the track
 * is uncertain: in its first frames, or after some without the drogue. It may be believed, but not so much that the true
 * drogue is refused after it. */
static void cut_then_whole(drogue_second_look look, int steady, int missing, double off_px, double dz)
{
    static const double std[5] = {0.001, 0.001, 0.02, 0.01, 0.01};
    const drogue_result miss = missed(DROGUE_E_NO_ELLIPSE);
    drogue_result hit = seen(0.2, -0.1, 12, 0.1, 0.05),
                  cut = seen(0.2 + off_px * 12 / 1465.5, -0.1, 12 + dz, 0.1, 0.05);
    drogue_track t = new_track();
    int k;
    set_covariance(&hit, std);
    set_covariance(&cut, std);
    hit.cover_q16 = DROGUE_Q16_ONE;
    hit.second_look = DROGUE_SECOND_BETTER;
    cut.cover_q16 = DROGUE_Q16(1, 2);
    cut.second_look = look;
    for (k = 0; k < steady; k++) {
        (void)step(&t, &hit);
    }
    for (k = 0; k < missing; k++) {
        (void)step(&t, &miss);
    }
    (void)step(&t, &cut);
    for (k = 0; k < 6; k++) {
        const drogue_track_state state = step(&t, &hit);
        MUST(state == DROGUE_TRACKING && !t.gated, "%s, %d seen, %d missed, %g px and %g m off: true frame %d is %s",
             drogue_second_look_name(look), steady, missing, off_px, dz, k, drogue_track_state_name(state));
    }
    must_be_at(&t, 0.2, -0.1, 12, 0.03);
}

START_TEST(a_cut_outline_does_not_lock_the_drogue_out)
{
    static const int steady[] = {1, 2, 3, 6, 17, 50};
    int i, missing;
    double px, dz;
    for (i = 0; i < 6; i++) {
        for (missing = 0; missing <= 10; missing++) {
            for (px = 4; px <= 8; px += 2) {
                for (dz = -0.4; dz < 0.5; dz += 0.4) {
                    cut_then_whole((drogue_second_look)(DROGUE_SECOND_NO_MORE + missing % 4), steady[i], missing, px,
                                   dz);
                }
            }
        }
    }
}
END_TEST

/* Standard deviation of z after one measurement: as large as its own unless the region cut it. */
START_TEST(too_little_room_cuts_nothing)
{
    static const double std[5] = {0.001, 0.001, 0.02, 0.01, 0.01};
    int look;
    for (look = 0; look < DROGUE_SECOND_COUNT; look++) {
        const int cut = look > DROGUE_SECOND_BETTER && look != DROGUE_SECOND_ROOM;
        drogue_result r = seen(0.2, -0.1, 12, 0.1, 0.05);
        drogue_track t = new_track();
        drogue_track_estimate e;
        set_covariance(&r, std);
        r.cover_q16 = DROGUE_Q16(9, 10);
        r.second_look = (drogue_second_look)look;
        ck_assert_int_eq(step(&t, &r), DROGUE_TRACKING);
        drogue_track_get(&e, &t);
        MUST((e.position_std_m_q32[2] > INT64_C(1) << 30) == cut, "%s: %g m",
             drogue_second_look_name((drogue_second_look)look), (double)e.position_std_m_q32[2] / 4294967296.0);
    }
}
END_TEST

START_TEST(what_noise_allows_is_believed)
{
    const drogue_result hit = seen(0.2, -0.1, 12, 0.1, 0.05); /* configured: 6 mm, 24 mm, 0.02 rad */
    const drogue_result near = seen(0.207, -0.107, 12.03, 0.12, 0.07);
    drogue_track t = steady_track(&hit);
    ck_assert_int_eq(step(&t, &near), DROGUE_TRACKING);
    ck_assert_int_eq(t.gated, 0);
}
END_TEST

/* The gate compares with the whole covariance: along its long axis far is near. */
START_TEST(correlation_counts)
{
    const double std[5] = {0.02, 0.02, 0.1, 0.01, 0.01};
    int sign, k;
    for (sign = -1; sign <= 1; sign += 2) {
        drogue_result hit = seen(2, 0, 10, 0, 0), far = seen(2 + sign * 0.05, 0, 10.25, 0, 0);
        drogue_track t;
        set_covariance(&hit, std);
        hit.covariance_q48[0][2] = hit.covariance_q48[2][0] = (int64_t)(0.99 * std[0] * std[2] * 281474976710656.0);
        memcpy(far.covariance_q48, hit.covariance_q48, sizeof far.covariance_q48);
        t = steady_track(&hit);
        for (k = 0; k < 200; k++) {
            t.config.process_std_q16[0] = t.config.process_std_q16[2] = q16_of(0.001); /* a confident prediction */
            (void)step(&t, &hit);
        }
        ck_assert_int_eq(step(&t, &far), sign > 0 ? DROGUE_TRACKING : DROGUE_COASTING);
    }
}
END_TEST

/* Off the axis x errs with z: what the filter takes out of z, it takes out of x. */
START_TEST(lateral_errors_follow_depth)
{
    const double bearing = 0.3, std[5] = {0.3 * 0.05, 0.001, 0.05, 0.01, 0.01};
    drogue_track t = new_track();
    uint64_t rng = 5;
    double raw = 0, filtered = 0;
    int k;
    for (k = 0; k < 1000; k++) {
        const double dz = std[2] * rng_normal(&rng), dx = bearing * dz + 0.0002 * rng_normal(&rng);
        drogue_result r = seen(bearing * 10 + dx, 0, 10 + dz, 0, 0);
        drogue_track_estimate e;
        set_covariance(&r, std);
        r.covariance_q48[0][2] = r.covariance_q48[2][0] = (int64_t)(0.999 * std[0] * std[2] * 281474976710656.0);
        ck_assert_int_ne(step(&t, &r), DROGUE_LOST);
        drogue_track_get(&e, &t);
        if (k > 100) {
            raw += dx * dx;
            filtered += pow(real_of_q16(e.position_m_q16[0]) - bearing * 10, 2);
        }
    }
    /* 0.63 without the regression on z */
    MUST(filtered < 0.5 * 0.5 * raw, "filtered over raw %g", sqrt(filtered / raw));
}
END_TEST

START_TEST(a_true_jump_is_followed)
{
    const drogue_result hit = seen(0.2, -0.1, 12, 0.1, 0.05);
    int blanks;
    for (blanks = 0; blanks <= 2; blanks++) {
        drogue_track t = steady_track(&hit);
        const drogue_result miss = missed(DROGUE_E_NO_ELLIPSE);
        unsigned k;
        for (k = 1; k < t.config.agree_frames; k++) { /* it moves on after the jump */
            drogue_result far = seen(1.2 + 0.02 * k, -0.8, 14, -0.2, 0.05);
            int b;
            ck_assert_int_eq(step(&t, &far), DROGUE_COASTING);
            ck_assert_int_eq(t.gated, 1);
            must_be_at(&t, 0.2, -0.1, 12, 0.01);
            for (b = 0; b < blanks; b++) {
                ck_assert_int_eq(step(&t, &miss), DROGUE_COASTING);
                ck_assert_int_eq(t.gated, 0);
            }
        }
        {
            drogue_result far = seen(1.28, -0.8, 14, -0.2, 0.05);
            ck_assert_int_eq(step(&t, &far), DROGUE_TRACKING);
            must_be_at(&t, 1.28, -0.8, 14, 0.02);
        }
    }
}
END_TEST

START_TEST(outliers_that_disagree_are_not_followed)
{
    const drogue_result hit = seen(0.2, -0.1, 12, 0.1, 0.05);
    drogue_track t = steady_track(&hit);
    unsigned k;
    for (k = 0; k < t.config.max_missed; k++) {
        const drogue_result far = seen(k % 2 == 0 ? 3 : -3, 1.0 * k, 8, 0.1, 0.05);
        ck_assert_int_eq(step(&t, &far), DROGUE_COASTING);
        must_be_at(&t, 0.2, -0.1, 12, 0.01);
    }
    ck_assert_int_eq(step(&t, &hit), DROGUE_TRACKING);
    must_be_at(&t, 0.2, -0.1, 12, 0.01);
    for (k = 0; k < t.config.max_missed; k++) {
        const drogue_result far = seen(k % 2 == 0 ? 3 : -3, 1.0 * k, 8, 0.1, 0.05);
        ck_assert_int_eq(step(&t, &far), DROGUE_COASTING);
    }
    { /* instead of being lost it begins anew */
        const drogue_result far = seen(-2, -2, 20, 0.1, 0.05);
        ck_assert_int_eq(step(&t, &far), DROGUE_TRACKING);
        must_be_at(&t, -2, -2, 20, 0.001);
    }
}
END_TEST

START_TEST(coasting_grows_and_never_breaks)
{
    const drogue_result hit = seen(0.2, -0.1, 12, 0.1, 0.05), miss = missed(DROGUE_E_NO_ARCS);
    drogue_track t = steady_track(&hit);
    drogue_track_estimate e, before;
    drogue_region region;
    int k, j;
    t.config.max_missed = UINT32_MAX;
    drogue_track_get(&before, &t);
    for (k = 0; k < 3000; k++) {
        drogue_track_begin(&region, &t, k < 100 ? DT_US : INT32_MAX);
        ck_assert_int_eq(drogue_track_end(&t, &miss), DROGUE_COASTING);
        drogue_track_get(&e, &t);
        for (j = 0; j < 3; j++) {
            MUST(e.position_std_m_q32[j] > before.position_std_m_q32[j] || e.position_std_m_q32[j] == INT64_MAX,
                 "position %d no less certain after frame %d", j, k);
        }
        MUST(e.yaw_std_rad_q32 > before.yaw_std_rad_q32 || e.yaw_std_rad_q32 == INT64_MAX, "yaw, frame %d", k);
        MUST(e.pitch_std_rad_q32 > before.pitch_std_rad_q32 || e.pitch_std_rad_q32 == INT64_MAX, "pitch, frame %d", k);
        MUST(region.width_px >= 32 && region.width_px <= DROGUE_MAX_SIDE, "side %d", (int)region.width_px);
        MUST(t.reach.width_px >= 32 && t.reach.width_px <= DROGUE_MAX_SIDE, "reach %d", (int)t.reach.width_px);
        before = e;
    }
    ck_assert_int_eq(step(&t, &hit), DROGUE_TRACKING);
    must_be_at(&t, 0.2, -0.1, 12, 0.001);
}
END_TEST

/* A time stamp that goes back is a step of over an hour, in which a turning drogue has turned thousands of times. */
START_TEST(no_turn_stays_from_a_long_step)
{
    const uint32_t back_us = (uint32_t)-1000;
    int backs, k;
    for (backs = 1; backs <= 5; backs++) {
        drogue_track t = new_track();
        drogue_track_estimate e;
        drogue_region region;
        for (k = 0; k < 300; k++) {
            const double turned = k < 60 ? 0.04 * (k - 60) : 0;
            const drogue_result hit = seen(0, 0, 10, turned, turned / 4);
            drogue_track_begin(&region, &t, k >= 60 && k < 60 + backs ? back_us : DT_US);
            (void)drogue_track_end(&t, &hit);
        }
        drogue_track_get(&e, &t);
        ck_assert_int_eq(t.state, DROGUE_TRACKING);
        must_be_at(&t, 0, 0, 10, 0.001);
        MUST(fabs(real_of_q16(e.yaw_rad_q16)) < 0.001 && fabs(real_of_q16(e.pitch_rad_q16)) < 0.001,
             "%d steps back: yaw %g, pitch %g", backs, real_of_q16(e.yaw_rad_q16), real_of_q16(e.pitch_rad_q16));
    }
}
END_TEST

START_TEST(standard_deviations_are_those_of_the_measurement)
{
    const double std[5] = {0.003, 0.004, 0.05, 0.01, 0.02};
    drogue_result hit = seen(0, 0, 10, 0, 0);
    drogue_track_estimate e;
    int k;
    for (k = 0; k < 2; k++) {
        drogue_track t = new_track();
        if (k == 1) {
            set_covariance(&hit, std);
        }
        (void)step(&t, &hit);
        drogue_track_get(&e, &t);
        ck_assert_double_eq_tol(ldexp((double)e.position_std_m_q32[0], -32), k ? 0.003 : 0.005, 5e-5);
        ck_assert_double_eq_tol(ldexp((double)e.position_std_m_q32[1], -32), k ? 0.004 : 0.005, 5e-5);
        ck_assert_double_eq_tol(ldexp((double)e.position_std_m_q32[2], -32), k ? 0.05 : 0.02, 5e-5);
        ck_assert_double_eq_tol(ldexp((double)e.yaw_std_rad_q32, -32), k ? 0.01 : 0.02, 5e-5);
        ck_assert_double_eq_tol(ldexp((double)e.pitch_std_rad_q32, -32), 0.02, 5e-5);
        ck_assert_double_eq_tol(ldexp((double)e.axis_std_rad_q32, -32), k ? hypot(0.01, 0.02) : 0.02 * sqrt(2), 5e-5);
    }
}
END_TEST

static drogue_result anything(uint64_t *rng)
{
    drogue_result r;
    unsigned char *bytes = (unsigned char *)&r;
    size_t i;
    for (i = 0; i < sizeof r; i++) {
        bytes[i] = (unsigned char)rng_u64(rng);
    }
    r.status = rng_range(rng, 0, 3) == 0 ? DROGUE_E_NO_ARCS : DROGUE_OK;
    r.orientation_resolved = rng_range(rng, 0, 1);
    if (rng_range(rng, 0, 1) == 0) { /* covariances of any size, mostly false */
        for (i = 0; i < 25; i++) {
            r.covariance_q48[i / 5][i % 5] = rng_s64_any_width(rng);
        }
    }
    return r;
}

START_TEST(nothing_locks_it_up)
{
    const drogue_result hit = seen(0.2, -0.1, 12, 0.1, 0.05);
    uint64_t rng = 7;
    int round, k;
    for (round = 0; round < 2000; round++) {
        drogue_track t = new_track();
        drogue_region region;
        for (k = 0; k < 30; k++) {
            const drogue_result r = anything(&rng);
            drogue_track_begin(&region, &t, (uint32_t)rng_range(&rng, 1, INT32_MAX));
            MUST(t.state == DROGUE_LOST || (region.width_px >= 32 && region.width_px <= DROGUE_MAX_SIDE), "side %d",
                 (int)region.width_px);
            (void)drogue_track_end(&t, &r);
        }
        for (k = 0; k < (int)(t.config.agree_frames + t.config.max_missed); k++) {
            (void)step(&t, &hit);
        }
        MUST(t.state == DROGUE_TRACKING, "round %d ends %s", round, drogue_track_state_name(t.state));
        for (k = 0; k < 30; k++) {
            (void)step(&t, &hit);
        }
        must_be_at(&t, 0.2, -0.1, 12, 0.01);
    }
}
END_TEST

/* 10,000 frames of a swing at 25 frames a second with noise as measured, 5 % of them blanked, 1 % outliers. */
START_TEST(ten_thousand_frames)
{
    static const double amplitudes[3] = {0.1, 0.5, 1.1};
    int level, k, p;
    for (level = 0; level < 3; level++) {
        drogue_track t = new_track();
        uint64_t rng = 11 + (uint64_t)level;
        double raw[5] = {0}, filtered[5] = {0};
        int outliers = 0, refused_outliers = 0, good = 0, refused_good = 0;
        for (k = 0; k < 10000; k++) {
            const double s = k * (DT_US * 1e-6), a = amplitudes[level], w = 2 * TEST_PI;
            const double truth[5] = {a * sin(w * 0.2 * s), 0.7 * a * sin(w * 0.15 * s), 14 + 8 * cos(0.02 * s),
                                     0.15 * a * sin(w * 0.2 * s), 0.1 * a * sin(w * 0.15 * s)};
            const double std[5] = {5e-5 * truth[2], 5e-5 * truth[2], 8e-4 * truth[2], 2e-4 * truth[2], 2e-4 * truth[2]};
            const int blank = rng_range(&rng, 1, 100) <= 5, outlier = !blank && rng_range(&rng, 1, 100) == 1;
            drogue_result r = missed(DROGUE_E_NO_ELLIPSE);
            drogue_track_estimate e;
            double v[5];
            for (p = 0; p < 5; p++) {
                v[p] = truth[p] + std[p] * rng_normal(&rng) + (outlier ? rng_real(&rng, 0.3, 1) : 0);
            }
            if (!blank) {
                r = seen(v[0], v[1], v[2], v[3], v[4]);
                set_covariance(&r, std);
            }
            MUST(step(&t, &r) != DROGUE_LOST, "lost at frame %d of amplitude %g", k, a);
            outliers += outlier;
            refused_outliers += outlier && t.gated;
            good += !blank && !outlier;
            refused_good += !blank && !outlier && t.gated;
            drogue_track_get(&e, &t);
            if (t.state == DROGUE_TRACKING && k > 50) {
                const double f[5] = {real_of_q16(e.position_m_q16[0]), real_of_q16(e.position_m_q16[1]),
                                     real_of_q16(e.position_m_q16[2]), real_of_q16(e.yaw_rad_q16),
                                     real_of_q16(e.pitch_rad_q16)};
                for (p = 0; p < 5; p++) {
                    raw[p] += (v[p] - truth[p]) * (v[p] - truth[p]);
                    filtered[p] += (f[p] - truth[p]) * (f[p] - truth[p]);
                }
            }
        }
        MUST(refused_outliers == outliers && outliers > 50, "%d of %d outliers refused", refused_outliers, outliers);
        MUST(refused_good * 200 < good, "%d of %d good frames refused", refused_good, good);
        for (p = 0; p < 5; p++) {
            MUST(filtered[p] < 0.9 * raw[p], "parameter %d of amplitude %g: filtered over raw %g", p, amplitudes[level],
                 sqrt(filtered[p] / raw[p]));
        }
    }
}
END_TEST

SUITE_MAIN("track_end", an_outlier_is_refused, an_unreliable_one_counts_as_missed,
           a_cut_outline_does_not_lock_the_drogue_out, too_little_room_cuts_nothing, what_noise_allows_is_believed,
           correlation_counts, lateral_errors_follow_depth, a_true_jump_is_followed,
           outliers_that_disagree_are_not_followed, coasting_grows_and_never_breaks, no_turn_stays_from_a_long_step,
           standard_deviations_are_those_of_the_measurement, nothing_locks_it_up, ten_thousand_frames)
