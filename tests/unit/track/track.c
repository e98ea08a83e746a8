/* SPDX-License-Identifier: Apache-2.0 */
/* The track's states, where it looks next, and which of two poses it believes. */
#include "suite.h"

#include "drogue/track.h"
#include "results.h"

static const drogue_region first_region = {10, 20, 600, 500};
static const drogue_model model = {22938, 13107, 16384};

/* Without growth of the region, whose own test is below. */
static drogue_track new_track(const drogue_camera *camera)
{
    drogue_track_config config;
    drogue_track t;
    drogue_track_config_default(&config);
    config.region_sigmas_q16 = 0;
    (void)drogue_track_init(&t, &config, camera, &model, &first_region);
    return t;
}

static drogue_track_state step(drogue_track *t, const drogue_result *r)
{
    drogue_region region;
    drogue_track_begin(&region, t, 20000);
    return drogue_track_end(t, r);
}

static void must_be_first_region(drogue_track *t)
{
    drogue_region region;
    drogue_track_begin(&region, t, 20000);
    ck_assert_int_eq(memcmp(&region, &first_region, sizeof region), 0);
}

START_TEST(defaults_are_the_documented_ones)
{
    drogue_track_config c;
    int k;
    memset(&c, 0x5A, sizeof c);
    drogue_track_config_default(&c);
    ck_assert_uint_eq(c.max_missed, 10);
    ck_assert_int_eq(c.region_scale_q16, q16_of(2.5));
    ck_assert_int_eq(c.min_region_px, 32);
    ck_assert_int_eq(c.max_region_px, DROGUE_MAX_SIDE);
    ck_assert_int_eq(c.lateral_std_q16, q16_of(0.0005));
    ck_assert_int_eq(c.depth_std_q16, q16_of(0.002));
    ck_assert_int_eq(c.angle_std_rad_q16, q16_of(0.02));
    ck_assert_uint_eq(c.agree_frames, 4);
    ck_assert_uint_eq(c.reconsider_frames, 50);
    ck_assert_int_eq(c.gate_q16, q16_of(20.515));
    ck_assert_int_eq(c.position_gate_q16, q16_of(16.266));
    ck_assert_int_eq(c.region_sigmas_q16, q16_of(3));
    ck_assert_int_eq(c.position_floor_m_q16, q16_of(0.0001));
    ck_assert_int_eq(c.angle_floor_rad_q16, q16_of(0.0005));
    for (k = 0; k < DROGUE_PARAMETERS; k++) {
        ck_assert_int_eq(c.process_std_q16[k], q16_of(k < 2 ? 0.2 : k == 2 ? 0.02 : 0.15));
    }
    ck_assert_int_eq(c.start_rate_std_q16, q16_of(2));
    ck_assert_int_eq(c.start_accel_std_q16, q16_of(15));
    ck_assert_int_eq(c.process_step_q16, q16_of(6));
    ck_assert_int_eq(c.lasting_share_q16, q16_of(0.75));
    ck_assert_uint_eq(c.known_frames, 25);
    ck_assert_int_eq(c.min_reliability_q16, 0);
}
END_TEST

#define LIMIT(member, good, bad) CHECK_LIMIT(drogue_track_config_valid, c, member, good, bad)

START_TEST(each_limit)
{
    drogue_track_config c;
    int p;
    drogue_track_config_default(&c);
    ck_assert(drogue_track_config_valid(&c));
    LIMIT(gate_q16, 0, -1);
    LIMIT(position_gate_q16, 0, -1);
    LIMIT(region_scale_q16, 1, 0);
    LIMIT(region_scale_q16, INT32_MAX, INT32_MIN);
    LIMIT(region_sigmas_q16, 0, -1);
    LIMIT(min_region_px, 1, 0);
    LIMIT(min_region_px, c.max_region_px, c.max_region_px + 1);
    LIMIT(max_region_px, c.min_region_px, c.min_region_px - 1);
    LIMIT(max_region_px, DROGUE_MAX_SIDE, DROGUE_MAX_SIDE + 1);
    LIMIT(lateral_std_q16, 0, -1);
    LIMIT(depth_std_q16, 0, -1);
    LIMIT(angle_std_rad_q16, 0, -1);
    LIMIT(position_floor_m_q16, 0, -1);
    LIMIT(angle_floor_rad_q16, 0, -1);
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        LIMIT(process_std_q16[p], 0, INT32_MIN);
    }
    LIMIT(process_step_q16, DROGUE_Q16_ONE, DROGUE_Q16_ONE - 1);
    LIMIT(lasting_share_q16, 0, -1);
    LIMIT(lasting_share_q16, DROGUE_Q16_ONE, DROGUE_Q16_ONE + 1);
    LIMIT(min_reliability_q16, 0, -1);
    LIMIT(min_reliability_q16, DROGUE_Q16_ONE, DROGUE_Q16_ONE + 1);
    LIMIT(start_rate_std_q16, 0, -1);
    LIMIT(start_accel_std_q16, 0, -1);
    c.max_missed = c.reconsider_frames = 0;
    c.agree_frames = 1;
    ck_assert(drogue_track_config_valid(&c));
    c.agree_frames = 0;
    ck_assert(!drogue_track_config_valid(&c));
}
END_TEST

START_TEST(names_of_states)
{
    ck_assert_str_eq(drogue_track_state_name(DROGUE_LOST), "lost");
    ck_assert_str_eq(drogue_track_state_name(DROGUE_TRACKING), "tracking");
    ck_assert_str_eq(drogue_track_state_name(DROGUE_COASTING), "coasting");
    ck_assert_ptr_nonnull(drogue_track_state_name((drogue_track_state)99));
}
END_TEST

START_TEST(states_in_turn)
{
    static const drogue_track_estimate nothing;
    const drogue_camera camera = pinhole(1000, 1000, 640, 512);
    drogue_track t = new_track(&camera);
    drogue_track_estimate e;
    drogue_result hit = seen(0.5, -0.3, 10, 0.1, -0.05), miss = missed(DROGUE_E_NO_ELLIPSE);
    int round, k;
    for (k = 0; k < 30; k++) { /* nothing found: lost stays lost */
        must_be_first_region(&t);
        ck_assert_int_eq(drogue_track_end(&t, &miss), DROGUE_LOST);
    }
    drogue_track_get(&e, &t);
    ck_assert_int_eq(memcmp(&e, &nothing, sizeof e), 0);
    for (round = 0; round < 3; round++) {
        ck_assert_int_eq(step(&t, &hit), DROGUE_TRACKING);
        drogue_track_get(&e, &t);
        ck_assert_int_le(abs(e.position_m_q16[0] - q16_of(0.5)), 2);
        ck_assert_int_le(abs(e.position_m_q16[1] - q16_of(-0.3)), 2);
        ck_assert_int_le(abs(e.position_m_q16[2] - q16_of(10)), 2);
        ck_assert_int_le(abs(e.yaw_rad_q16 - q16_of(0.1)), 2);
        ck_assert_int_le(abs(e.pitch_rad_q16 - q16_of(-0.05)), 2);
        ck_assert_int_le(abs(e.axis_q16[0] - hit.pose.axis_q16[0]), 4);
        ck_assert_int_le(abs(e.axis_q16[1] - hit.pose.axis_q16[1]), 4);
        ck_assert_int_le(abs(e.axis_q16[2] - hit.pose.axis_q16[2]), 4);
        ck_assert_int_eq(step(&t, &hit), DROGUE_TRACKING);
        for (k = 1; k <= 10; k++) {
            ck_assert_int_eq(step(&t, &miss), DROGUE_COASTING);
            ck_assert_uint_eq(t.missed, (unsigned)k);
        }
        ck_assert_int_eq(step(&t, &hit), DROGUE_TRACKING); /* found in time: the count starts again */
        ck_assert_uint_eq(t.missed, 0);
        for (k = 1; k <= 10; k++) {
            ck_assert_int_eq(step(&t, &miss), DROGUE_COASTING);
        }
        ck_assert_int_eq(step(&t, &miss), DROGUE_LOST);
        drogue_track_get(&e, &t);
        ck_assert_int_eq(memcmp(&e, &nothing, sizeof e), 0);
        must_be_first_region(&t);
        ck_assert_int_eq(drogue_track_end(&t, &miss), DROGUE_LOST);
    }
}
END_TEST

START_TEST(every_failure_is_a_miss)
{
    const drogue_camera camera = pinhole(1000, 1000, 640, 512);
    drogue_track t = new_track(&camera);
    drogue_result hit = seen(0, 0, 5, 0, 0);
    int status;
    for (status = DROGUE_OK + 1; status < DROGUE_STATUS_COUNT; status++) {
        drogue_result miss = missed((drogue_status)status);
        ck_assert_int_eq(step(&t, &hit), DROGUE_TRACKING);
        ck_assert_int_eq(step(&t, &miss), DROGUE_COASTING);
    }
}
END_TEST

START_TEST(no_miss_allowed)
{
    const drogue_camera camera = pinhole(1000, 1000, 640, 512);
    drogue_track t = new_track(&camera);
    drogue_result hit = seen(0, 0, 5, 0, 0), miss = missed(DROGUE_E_NO_EDGES);
    t.config.max_missed = 0;
    ck_assert_int_eq(step(&t, &hit), DROGUE_TRACKING);
    ck_assert_int_eq(step(&t, &miss), DROGUE_LOST);
}
END_TEST

/* The region asked for next is square, about the predicted outline, within a pixel. */
static void must_be_about(const drogue_region *r, double x, double y, double side)
{
    MUST(r->width_px == r->height_px, "%d x %d is no square", (int)r->width_px, (int)r->height_px);
    MUST(fabs(r->width_px - side) <= 1, "side %d instead of %.2f", (int)r->width_px, side);
    MUST(fabs(r->x_px + (r->width_px - 1) / 2.0 - x) <= 1.5 && fabs(r->y_px + (r->height_px - 1) / 2.0 - y) <= 1.5,
         "middle (%g, %g) instead of (%.2f, %.2f)", r->x_px + (r->width_px - 1) / 2.0,
         r->y_px + (r->height_px - 1) / 2.0, x, y);
}

START_TEST(region_follows_a_steady_drogue)
{
    uint64_t rng = 1;
    int i;
    for (i = 0; i < 2000; i++) {
        double f = rng_real(&rng, 500, 2500), z = rng_real(&rng, 2, 25), u = rng_real(&rng, 0, 1280),
               v = rng_real(&rng, 0, 1024);
        const drogue_camera camera = pinhole(f, f, 640, 512);
        drogue_track t = new_track(&camera);
        drogue_result hit = seen((u - 640) * z / f, (v - 512) * z / f, z, 0.1, 0.1);
        double side = fmin(fmax(2.5 * f * 0.35 / z, 32), DROGUE_MAX_SIDE);
        drogue_region region;
        ck_assert_int_eq(step(&t, &hit), DROGUE_TRACKING);
        drogue_track_begin(&region, &t, 20000);
        must_be_about(&region, u, v, side);
    }
}
END_TEST

/* Pixels that are no squares: the longer semi-axis counts. */
START_TEST(region_of_the_larger_focal_length)
{
    int k;
    for (k = 0; k < 2; k++) {
        const drogue_camera camera = pinhole(k == 0 ? 1000 : 500, k == 0 ? 500 : 1000, 640, 512);
        drogue_track t = new_track(&camera);
        drogue_result hit = seen(0, 0, 5, 0.1, 0.1);
        drogue_region region;
        ck_assert_int_eq(step(&t, &hit), DROGUE_TRACKING);
        drogue_track_begin(&region, &t, 20000);
        must_be_about(&region, 640, 512, 175);
    }
}
END_TEST

START_TEST(region_is_clamped)
{
    const drogue_camera camera = pinhole(1000, 1000, 640, 512);
    drogue_track t = new_track(&camera);
    drogue_result hit = seen(0, 0, 20, 0, 0);
    drogue_region region;
    t.config.min_region_px = 100;
    t.config.max_region_px = 200;
    (void)step(&t, &hit);
    drogue_track_begin(&region, &t, 20000);
    must_be_about(&region, 640, 512, 100); /* 43.75 */
    hit = seen(0, 0, 2, 0, 0);
    t.state = DROGUE_LOST;
    (void)step(&t, &hit);
    drogue_track_begin(&region, &t, 20000);
    must_be_about(&region, 640, 512, 200); /* 437.5 */
}
END_TEST

START_TEST(region_leads_a_moving_drogue)
{
    const drogue_camera camera = pinhole(1000, 1000, 640, 512);
    drogue_track t = new_track(&camera);
    drogue_region region;
    int k;
    for (k = 0; k <= 50; k++) { /* 1 m/s to the right, 0.5 m/s nearer, 50 frames a second */
        drogue_result hit = seen(0.02 * k - 0.5, 0, 10 - 0.01 * k, 0, 0);
        drogue_track_begin(&region, &t, 20000);
        if (k > 20) {
            must_be_about(&region, 640 + 1000 * (0.02 * k - 0.5) / (10 - 0.01 * k), 512, 2.5 * 350 / (10 - 0.01 * k));
        }
        ck_assert_int_eq(drogue_track_end(&t, &hit), DROGUE_TRACKING);
    }
    for (k = 51; k <= 60; k++) { /* and on while it is not seen */
        drogue_result miss = missed(DROGUE_E_NO_ARCS);
        drogue_track_estimate e;
        drogue_track_begin(&region, &t, 20000);
        must_be_about(&region, 640 + 1000 * (0.02 * k - 0.5) / (10 - 0.01 * k), 512, 2.5 * 350 / (10 - 0.01 * k));
        ck_assert_int_eq(drogue_track_end(&t, &miss), DROGUE_COASTING);
        drogue_track_get(&e, &t);
        ck_assert(fabs(real_of_q16(e.velocity_mps_q16[0]) - 1) < 0.01 &&
                  fabs(real_of_q16(e.velocity_mps_q16[2]) + 0.5) < 0.01);
    }
}
END_TEST

START_TEST(region_allows_for_distortion)
{
    drogue_camera camera = pinhole(1000, 1000, 640, 512);
    drogue_track t;
    drogue_result hit = seen(2, 1, 5, 0, 0);
    drogue_region region;
    camera.k1_q16 = q16_of(-0.2);
    t = new_track(&camera);
    (void)step(&t, &hit);
    drogue_track_begin(&region, &t, 20000);
    must_be_about(&region, 640 + 400 * (1 - 0.2 * 0.2), 512 + 200 * (1 - 0.2 * 0.2), 175);
}
END_TEST

START_TEST(region_grows_with_uncertainty)
{
    const drogue_camera camera = pinhole(1000, 1000, 640, 512);
    drogue_track t = new_track(&camera);
    drogue_result hit = seen(0.1, 0, 10, 0, 0), miss = missed(DROGUE_E_NO_ARCS);
    drogue_region region;
    int32_t side, reach;
    int k;
    t.config.region_sigmas_q16 = q16_of(3);
    t.config.max_missed = 1000;
    t.config.max_region_px = 300;
    for (k = 0; k < 100; k++) {
        (void)step(&t, &hit);
    }
    drogue_track_begin(&region, &t, 20000);
    must_be_about(&region, 650, 512, 2.5 * 35 * 1.03); /* what lasts of 5 mm and 20 mm, against a rim of 350 mm */
    ck_assert_int_eq(t.search, 0);
    ck_assert_int_eq(drogue_track_end(&t, &miss), DROGUE_COASTING);
    side = region.width_px;
    reach = t.reach.width_px;
    for (k = 0; k < 200; k++) {
        drogue_track_begin(&region, &t, 20000);
        MUST(region.width_px >= side && region.width_px <= (int32_t)(2.75 * 35 + 1), "side %d after %d",
             (int)region.width_px, (int)side);
        MUST(t.reach.width_px >= reach && t.reach.width_px <= 300, "reach %d after %d", (int)t.reach.width_px,
             (int)reach);
        MUST(t.search ? region.width_px >= 96 : t.reach.width_px <= (2.5 + 0.8) * 35 + 1,
             "search %d, side %d, reach %d", (int)t.search, (int)region.width_px, (int)t.reach.width_px);
        (void)drogue_track_end(&t, &miss);
        side = region.width_px;
        reach = t.reach.width_px;
    }
    ck_assert_int_eq(t.search, 1);
    ck_assert_int_eq(reach, 300);
}
END_TEST

START_TEST(without_a_first_region_the_whole_frame)
{
    const drogue_camera camera = pinhole(1000, 1000, 640, 512);
    drogue_track_config config;
    drogue_track t;
    const drogue_region empty = {5, 6, 0, 7}, none = {0, 0, 0, 0};
    drogue_region region = {1, 2, 3, 4};
    drogue_track_config_default(&config);
    (void)drogue_track_init(&t, &config, &camera, &model, NULL);
    drogue_track_begin(&region, &t, 20000);
    ck_assert_int_eq(region.width_px, 0);
    ck_assert_int_eq(region.height_px, 0);
    ck_assert_int_eq(t.search, 1);
    (void)drogue_track_init(&t, &config, &camera, &model, &empty);
    drogue_track_begin(&region, &t, 20000);
    ck_assert_mem_eq(&region, &none, sizeof region);
    ck_assert_int_eq(t.search, 1);
}
END_TEST

START_TEST(lost_when_it_flies_behind_the_camera)
{
    const drogue_camera camera = pinhole(1000, 1000, 640, 512);
    drogue_track t = new_track(&camera);
    drogue_region region;
    int k;
    for (k = 0; k <= 20; k++) { /* 10 m/s towards the camera */
        drogue_result hit = seen(0, 0, 10 - 0.2 * k, 0, 0);
        (void)step(&t, &hit);
    }
    drogue_track_begin(&region, &t, 2000000);
    ck_assert_int_eq(memcmp(&region, &first_region, sizeof region), 0);
    ck_assert_int_eq(t.state, DROGUE_LOST);
}
END_TEST

/* Where the lens model ends a prediction cannot be seen either. */
START_TEST(lost_beyond_the_lens)
{
    drogue_camera camera = pinhole(1000, 1000, 640, 512);
    const drogue_result hit = seen(9, 0, 2, 0, 0); /* 4.5 focal lengths off the axis */
    drogue_region region;
    int lens;
    for (lens = 0; lens < 2; lens++) {
        drogue_track t;
        camera.k1_q16 = lens;
        t = new_track(&camera);
        ck_assert_int_eq(step(&t, &hit), DROGUE_TRACKING);
        drogue_track_begin(&region, &t, 20000);
        ck_assert_int_eq(t.state, lens ? DROGUE_LOST : DROGUE_TRACKING);
        ck_assert_int_eq(memcmp(&region, &first_region, sizeof region) == 0, lens);
    }
}
END_TEST

/* An axis that turns on while nothing is measured passes the vertical: yaw and pitch stay those of the axis. */
START_TEST(pitch_ends_at_a_right_angle)
{
    const drogue_camera camera = pinhole(1000, 1000, 640, 512);
    drogue_track t = new_track(&camera);
    drogue_region region;
    int k, over = 0;
    for (k = 0; k <= 20; k++) {
        drogue_result hit = seen(0, 0, 10, 0.1, 0.03 * k);
        (void)step(&t, &hit);
    }
    for (k = 0; k < 20 && t.state != DROGUE_LOST; k++) {
        const drogue_result miss = missed(DROGUE_E_NO_ELLIPSE);
        drogue_track_estimate e;
        drogue_track_begin(&region, &t, 300000);
        (void)drogue_track_end(&t, &miss);
        drogue_track_get(&e, &t);
        if (t.state == DROGUE_COASTING) {
            MUST(fabs(real_of_q16(e.pitch_rad_q16) - asin(fmax(-1, fmin(1, real_of_q16(e.axis_q16[1]))))) < 0.01,
                 "frame %d: pitch %g", k, real_of_q16(e.pitch_rad_q16));
            if (hypot(real_of_q16(e.axis_q16[0]), real_of_q16(e.axis_q16[2])) > 0.05) {
                MUST(fabs(real_of_q16(e.yaw_rad_q16) - atan2(real_of_q16(e.axis_q16[0]), real_of_q16(e.axis_q16[2]))) <
                         0.01,
                     "frame %d: yaw %g", k, real_of_q16(e.yaw_rad_q16));
            }
            over += e.axis_q16[2] < 0;
        }
    }
    ck_assert_int_gt(over, 0);
}
END_TEST

START_TEST(unresolved_poses_go_by_the_predicted_axis)
{
    const drogue_camera camera = pinhole(1000, 1000, 640, 512);
    int resolved;
    for (resolved = 0; resolved <= 1; resolved++) {
        drogue_track t = new_track(&camera);
        drogue_track_estimate e;
        drogue_result hit = seen(0, 0, 8, 0.3, 0), turned = seen(0, 0, 8, -0.3, 0);
        int k;
        for (k = 0; k < 30; k++) {
            (void)step(&t, &hit);
        }
        turned.alternative = hit.pose;
        turned.orientation_resolved = resolved;
        for (k = 0; k < 300; k++) {
            (void)step(&t, &turned);
        }
        drogue_track_get(&e, &t);
        ck_assert(fabs(real_of_q16(e.yaw_rad_q16) - (resolved ? -0.3 : 0.3)) < 0.03);
    }
}
END_TEST

SUITE_MAIN("track", defaults_are_the_documented_ones, each_limit, names_of_states, states_in_turn,
           every_failure_is_a_miss, no_miss_allowed, region_follows_a_steady_drogue, region_of_the_larger_focal_length,
           region_is_clamped, region_leads_a_moving_drogue, region_allows_for_distortion, region_grows_with_uncertainty,
           without_a_first_region_the_whole_frame, lost_when_it_flies_behind_the_camera, lost_beyond_the_lens,
           pitch_ends_at_a_right_angle, unresolved_poses_go_by_the_predicted_axis)
