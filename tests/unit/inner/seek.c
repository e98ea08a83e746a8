/* SPDX-License-Identifier: Apache-2.0 */
/* The inner disc without an outline: drawn discs in collars, what is none, and the outlines that a disc allows beside those of
 * the poses that it was seen from. */
#include "suite.h"

#include "drogue/drogue.h"
#include "drogue/inner.h"
#include "drogue/undistort.h"
#include "joint_model.h"

enum { SIDE = 150 };

static uint8_t pixels[SIDE * SIDE];
static drogue_ray rays[DROGUE_RAYS];

static double darker = 60; /* the disc, than what is about it */

static double step_at(double d, double radius) { return 0.5 * erfc((d - radius) / 1.1); }

/* A dark disc, in a collar that is 'collar' darker than what is about it, and noise; 'share' of the turn is hidden. */
static drogue_image draw(double xc, double yc, double radius, double collar_radius, double collar, double share)
{
    const drogue_image view = {pixels, SIDE, SIDE, SIDE};
    uint64_t rng = 5;
    int x, y;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            const double d = hypot(x - xc, y - yc), turn = atan2(y - yc, x - xc) / (2 * TEST_PI) + 0.5;
            const double grey =
                turn < share ? 170 : 170 - collar * step_at(d, collar_radius) - darker * step_at(d, radius);
            pixels[y * SIDE + x] = (uint8_t)lround(grey + rng_real(&rng, -2, 2));
        }
    }
    return view;
}

static drogue_setup setup;
static drogue_config config;

/* A region as it would be for an outline of 62.5 px about its middle: a disc of 0.12 / 0.35 of it. */
static int seek(drogue_ellipse *out, const drogue_image *view, double inner_radius)
{
    const drogue_mask mask = drogue_mask_of_size(SIDE, SIDE);
    static drogue_model model;
    model.rim_radius_m_q16 = q16_of(0.35);
    model.inner_radius_m_q16 = q16_of(inner_radius);
    drogue_config_default(&config);
    setup.model = &model;
    setup.config = &config;
    return drogue_inner_seek(out, rays, view, &mask, &setup);
}

static int is_at(const drogue_ellipse *e, double xc, double yc, double radius)
{
    return fabs(real_of_q16(e->xc_px_q16) - xc) < 0.2 && fabs(real_of_q16(e->yc_px_q16) - yc) < 0.2 &&
           fabs(real_of_q16(e->a_px_q16) - radius) < 0.2 && e->b_px_q16 == e->a_px_q16 && e->angle_rad_q16 == 0;
}

START_TEST(discs_where_and_as_large_as_drawn)
{
    uint64_t rng = 1;
    int i;
    for (i = 0; i < 300; i++) {
        const double off = rng_real(&rng, 0, 20), way = rng_real(&rng, 0, 2 * TEST_PI);
        const double xc = 74.5 + off * cos(way), yc = 74.5 + off * sin(way);
        const double radius = rng_real(&rng, 15, 26);
        const drogue_image view = draw(xc, yc, radius, 1, 0, i % 2 == 0 ? 0 : 0.12);
        drogue_ellipse out;
        const int count = seek(&out, &view, 0.12);
        MUST(count == 1 && is_at(&out, xc, yc, radius), "%d: %d, %g %g %g for %g %g %g", i, count,
             real_of_q16(out.xc_px_q16), real_of_q16(out.yc_px_q16), real_of_q16(out.a_px_q16), xc, yc, radius);
    }
}
END_TEST

/* The steeper edge is taken, of the disc or of the collar about it. */
START_TEST(disc_in_a_collar)
{
    double collar;
    for (collar = 20; collar <= 100; collar += 40) {
        const drogue_image view = draw(80.2, 70.4, 18, 28, collar, 0);
        drogue_ellipse out;
        ck_assert_int_eq(seek(&out, &view, 0.12), 1);
        MUST(is_at(&out, 80.2, 70.4, collar >= 60 ? 28 : 18), "collar %g: %g", collar, real_of_q16(out.a_px_q16));
    }
}
END_TEST

START_TEST(what_is_no_disc)
{
    drogue_ellipse out;
    drogue_image view = draw(74.5, 74.5, 20, 1, 0, 0.35); /* seen by less than three quarters of the rays */
    ck_assert_int_eq(seek(&out, &view, 0.12), 0);
    view = draw(74.5, 74.5, 60, 1, 0, 0); /* far larger than the region suggests */
    ck_assert_int_eq(seek(&out, &view, 0.12), 0);
    view = draw(300, 300, 20, 1, 0, 0); /* noise */
    ck_assert_int_eq(seek(&out, &view, 0.12), 0);
    view = draw(74.5, 74.5, 20, 1, 0, 0); /* of a model without one, under 3 px, larger than its rim */
    ck_assert_int_eq(seek(&out, &view, 0.12), 1);
    ck_assert_int_eq(seek(&out, &view, 0), 0);
    ck_assert_int_eq(seek(&out, &view, 0.36), 0);
    view = draw(74.5, 74.5, 3, 1, 0, 0);
    ck_assert_int_eq(seek(&out, &view, 0.0165), 0);
    ck_assert_int_eq(seek(&out, &view, 0.0175), 1);
}
END_TEST

/* Three quarters of the rays are enough, where no other sees an edge, and no fewer. */
START_TEST(as_many_rays_as_must_agree)
{
    double share;
    int enough = 0;
    for (share = 0.2; share < 0.3; share += 0.004) {
        const drogue_image view = draw(74.5, 74.5, 20, 1, 0, share);
        const drogue_ellipse disc = {q16_of(74.5), q16_of(74.5), q16_of(20), q16_of(20), 0};
        drogue_ellipse out;
        const int found = seek(&out, &view, 0.12);
        int seen = 0;
        int k;
        drogue_rays_cast(rays, &view, &disc, q16_of(5), 4, 2, config.min_inner_contrast, DROGUE_RAY_RISES);
        for (k = 0; k < DROGUE_RAYS; k++) {
            seen += rays[k].count > 0;
        }
        MUST(found == (seen >= 24), "%g hidden: %d, %d rays", share, found, seen);
        enough += seen == 24;
    }
    ck_assert_int_gt(enough, 0);
}
END_TEST

/* Nothing is sought where rays from the middle see little: that must not be a disc well off it, or a faint one. */
START_TEST(what_is_blank)
{
    drogue_ellipse out;
    drogue_image view = draw(74.5 + 20, 74.5, 7, 1, 0, 0); /* crossed by four of 32 */
    ck_assert_int_eq(seek(&out, &view, 0.039), 1);
    darker = 14;
    view = draw(74.5 + 14, 74.5 - 14, 21, 1, 0, 0);
    ck_assert_int_eq(seek(&out, &view, 0.12), 1);
    darker = 5; /* less than twice the least contrast */
    view = draw(74.5, 74.5, 21, 1, 0, 0);
    ck_assert_int_eq(seek(&out, &view, 0.12), 0);
    darker = 60;
}
END_TEST

/* A disc of so many steps' turn, as a circle of its mean size. */
static drogue_pose turned(const drogue_camera *camera, const drogue_model *model, double x, double y, double z, int yaw,
                          int pitch, drogue_ellipse *disc)
{
    drogue_pose pose;
    double axis[3], at[3] = {x * z, y * z, z};
    int k;
    const double angles[2] = {atan2(x, 1) + 0.08 * yaw, atan2(y, hypot(x, 1)) + 0.08 * pitch};
    axis_of_angles(axis, angles[0], angles[1]);
    for (k = 0; k < 3; k++) {
        pose.axis_q16[k] = q16_of(axis[k]);
        pose.position_m_q16[k] = q16_of(at[k] - axis[k] * real_of_q16(model->inner_depth_m_q16));
    }
    pose.yaw_rad_q16 = q16_of(angles[0]);
    pose.pitch_rad_q16 = q16_of(angles[1]);
    ck_assert_int_eq(drogue_inner_disc_image(disc, &pose, camera, model), DROGUE_OK);
    return pose;
}

START_TEST(outlines_that_a_disc_allows)
{
    uint64_t rng = 3;
    int i;
    for (i = 0; i < 3000; i++) {
        field f = usual_field();
        drogue_model rim = f.model;
        drogue_ellipse disc, truth;
        drogue_inner_sight sight;
        drogue_inner_expected got;
        const int yaw = rng_range(&rng, -4, 4), pitch = rng_range(&rng, -4, 4);
        const double x = rng_real(&rng, -0.5, 0.5), y = rng_real(&rng, -0.5, 0.5);
        const drogue_pose pose = turned(&f.camera, &f.model, x, y, rng_real(&rng, 5, 30), yaw, pitch, &disc);
        const drogue_setup own = {&f.camera, &f.model, &config};
        double off, larger;
        rim.inner_radius_m_q16 = rim.rim_radius_m_q16;
        rim.inner_depth_m_q16 = 0;
        ck_assert_int_eq(drogue_inner_disc_image(&truth, &pose, &f.camera, &rim), DROGUE_OK);
        disc.a_px_q16 = disc.b_px_q16 = (disc.a_px_q16 + disc.b_px_q16) / 2; /* as the rays see it */
        ck_assert(drogue_inner_sight_of(&sight, &disc, &f.camera));
        drogue_inner_rims(&got, &sight, yaw, pitch, &own, 7, -5);
        ck_assert_int_eq(got.count, 2);
        off = hypot(real_of_q16(got.disc[0].xc_px_q16 - truth.xc_px_q16) + 7,
                    real_of_q16(got.disc[0].yc_px_q16 - truth.yc_px_q16) - 5) /
              real_of_q16(truth.a_px_q16);
        larger = real_of_q16(got.disc[0].a_px_q16) / real_of_q16(truth.a_px_q16) - 1;
        MUST(off < 0.03 && fabs(larger) < 0.05, "%d: turned %d %d at %g %g: off by %g, larger by %g", i, yaw, pitch, x,
             y, off, larger);
        /* the opposite turn */
        drogue_inner_rims(&got, &sight, -yaw, -pitch, &own, 7, -5);
        off = hypot(real_of_q16(got.disc[1].xc_px_q16 - truth.xc_px_q16) + 7,
                    real_of_q16(got.disc[1].yc_px_q16 - truth.yc_px_q16) - 5) /
              real_of_q16(truth.a_px_q16);
        ck_assert(off < 0.03);
    }
}
END_TEST

/* A circle of a lens that magnifies there by less is a larger disc. */
START_TEST(sight_through_a_lens)
{
    field f = usual_field();
    drogue_inner_sight sight;
    drogue_ellipse disc = {0, 0, q16_of(20), q16_of(20), 0};
    drogue_q16 x, y, u, v;
    f.camera.k1_q16 = q16_of(-0.2);
    x = drogue_q16_add(f.camera.cx_px_q16, f.camera.fx_px_q16 / 3);
    y = drogue_q16_add(f.camera.cy_px_q16, f.camera.fy_px_q16 / 4);
    u = x;
    v = y;
    ck_assert_int_eq(drogue_distort_point(&u, &v, &f.camera), DROGUE_OK);
    disc.xc_px_q16 = u;
    disc.yc_px_q16 = v;
    ck_assert(drogue_inner_sight_of(&sight, &disc, &f.camera));
    ck_assert(fabs(real_of_q16(sight.x_q16) - 1 / 3.0) < 1e-4 && fabs(real_of_q16(sight.y_q16) - 0.25) < 1e-4);
    ck_assert(fabs(real_of_q16(sight.yaw_rad_q16) - atan(1 / 3.0)) < 1e-4);
    ck_assert(fabs(real_of_q16(sight.pitch_rad_q16) - atan2(0.25, hypot(1, 1 / 3.0))) < 1e-4);
    ck_assert(fabs(real_of_q16(sight.length_q16) - sqrt(1 + 1 / 9.0 + 1 / 16.0)) < 1e-4);
    {
        const double r2 = 1 / 9.0 + 1 / 16.0, across = 1 - 0.2 * r2; /* 1 / magnification, to first order: */
        const double along_x = across - 0.4 / 9.0, along_y = across - 0.4 / 16.0; /* along either axis */
        const double truth = 20 / real_of_q16(f.camera.fx_px_q16) * (1 / along_x + 1 / along_y) / 2;
        MUST(fabs(real_of_q16(sight.radius_q16) / truth - 1) < 0.01, "%g for %g", real_of_q16(sight.radius_q16), truth);
    }
    disc.xc_px_q16 = drogue_q16_add(f.camera.cx_px_q16, f.camera.fx_px_q16); /* reaches beyond 45 degrees */
    f.camera.k1_q16 = 0;
    ck_assert(!drogue_inner_sight_of(&sight, &disc, &f.camera));
}
END_TEST

SUITE_MAIN("seek", discs_where_and_as_large_as_drawn, disc_in_a_collar, what_is_no_disc, as_many_rays_as_must_agree,
           what_is_blank, outlines_that_a_disc_allows, sight_through_a_lens)
