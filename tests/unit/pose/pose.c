/* SPDX-License-Identifier: Apache-2.0 */
/* Pose of known circles from their projected ellipses, the twin pose, projection and choice. */
#include "suite.h"

#include "drogue/pose.h"
#include "geometry.h"

static const double focal = 1465.5, middle = 1023.5;

static void real_pose(double position[3], double axis[3], const drogue_pose *p)
{
    int k;
    for (k = 0; k < 3; k++) {
        position[k] = real_of_q16(p->position_m_q16[k]);
        axis[k] = real_of_q16(p->axis_q16[k]);
    }
}

static double distance3(const double *p, const double *q)
{
    return sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) + (p[2] - q[2]) * (p[2] - q[2]));
}

static void must_be_consistent(const drogue_pose *p)
{
    double position[3], axis[3];
    real_pose(position, axis, p);
    MUST(fabs(dot3(axis, axis) - 1) < 1e-4, "axis of length^2 %g", dot3(axis, axis));
    MUST(fabs(angle_difference(real_of_q16(p->yaw_rad_q16), atan2(axis[0], axis[2]), 2 * TEST_PI)) *
                 hypot(axis[0], axis[2]) <
             4e-5,
         "yaw against axis");
    MUST(fabs(real_of_q16(p->pitch_rad_q16) - atan2(axis[1], hypot(axis[0], axis[2]))) < 4e-5, "pitch against axis");
    MUST(dot3(axis, position) > 0, "axis points out of the drogue");
}

/* A circle projected, its ellipse rounded to Q16, both poses. The rounding of the ellipse bounds what can be known. */
static void check_circle(double z, double x, double y, double yaw, double pitch, double radius)
{
    double centre[3], axis[3], position[3], found[3], sight, tilt, ratio, error, most;
    drogue_camera camera = pinhole(focal, focal * 1.01, middle, middle - 40);
    drogue_pose pose[2];
    drogue_ellipse ellipse;
    ellipse_real e, f;
    int i, match = 0;
    radius = real_of_q16(q16_of(radius));
    centre[0] = x * z;
    centre[1] = y * z;
    centre[2] = z;
    axis_of_angles(axis, yaw, pitch);
    sight = dot3(axis, centre) / sqrt(dot3(centre, centre));
    if (sight < 0.3 || /* near edge-on or from behind */
        !ellipse_of_circle(&e, centre, axis, radius, real_of_q16(camera.fx_px_q16), real_of_q16(camera.fy_px_q16),
                           real_of_q16(camera.cx_px_q16), real_of_q16(camera.cy_px_q16))) {
        return;
    }
    ellipse = ellipse_to_q16(&e);
    MUST(drogue_pose_from_ellipse(pose, &ellipse, &camera, q16_of(radius)) == DROGUE_OK, "z %g yaw %g pitch %g refused",
         z, yaw, pitch);
    tilt = acos(fmin(1, sight));
    ratio = 4 / 65536.0 / e.b; /* relative rounding of the ellipse, generously */
    for (i = 0; i < 2; i++) {
        must_be_consistent(&pose[i]);
        real_pose(position, found, &pose[i]);
        error = distance3(position, centre);
        most = 7 / 65536.0 + z * 2 * ratio + 2 * radius * fmin(ratio / sin(tilt), sqrt(2 * ratio));
        if (error <= most && distance3(found, axis) <= 7 / 65536.0 + 2 * fmin(ratio / sin(tilt), sqrt(2 * ratio))) {
            match = 1;
        }
        /* Each pose, the twin too, projects to the same ellipse again. */
        MUST(ellipse_of_circle(&f, position, found, radius, real_of_q16(camera.fx_px_q16),
                               real_of_q16(camera.fy_px_q16), real_of_q16(camera.cx_px_q16),
                               real_of_q16(camera.cy_px_q16)),
             "pose %d cannot be seen", i);
        most = 4 / 65536.0 * (focal / z + e.a);
        MUST(hypot(f.xc - e.xc, f.yc - e.yc) < most && fabs(f.a - e.a) < most && fabs(f.b - e.b) < most,
             "z %g x %g y %g yaw %g pitch %g: pose %d projects %g %g %g px away", z, x, y, yaw, pitch, i,
             hypot(f.xc - e.xc, f.yc - e.yc), f.a - e.a, f.b - e.b);
    }
    MUST(match, "z %g x %g y %g yaw %g pitch %g: neither pose is the circle's", z, x, y, yaw, pitch);
}

START_TEST(circles_over_distance_and_tilt)
{
    double z, tilt, turn;
    for (z = 2; z <= 25; z *= 1.25) {
        for (tilt = 0; tilt <= 60; tilt += 5) {
            for (turn = 0; turn < 6.28; turn += 0.37) {
                double t = tilt * TEST_PI / 180, axis[3];
                axis[0] = sin(t) * cos(turn);
                axis[1] = sin(t) * sin(turn);
                axis[2] = cos(t);
                check_circle(z, 0, 0, atan2(axis[0], axis[2]), asin(axis[1]), 0.35);
                check_circle(z, 0.3 * sin(9 * turn), 0.3 * cos(7 * turn), atan2(axis[0], axis[2]), asin(axis[1]), 0.35);
            }
        }
    }
}
END_TEST

START_TEST(random_circles)
{
    uint64_t rng = 1;
    int i;
    for (i = 0; i < 20000; i++) {
        double radius = rng_real(&rng, 0.1, 1);
        check_circle(rng_real(&rng, 5, 60) * radius, rng_real(&rng, -0.6, 0.6), rng_real(&rng, -0.6, 0.6),
                     rng_real(&rng, -0.7, 0.7), rng_real(&rng, -0.7, 0.7), radius);
    }
}
END_TEST

START_TEST(head_on_has_one_pose)
{
    const drogue_camera camera = pinhole(1000, 1000, 500, 400);
    const drogue_ellipse circle = {500 * 65536, 400 * 65536, 50 * 65536, 50 * 65536, 0};
    drogue_pose p[2];
    int i;
    ck_assert_int_eq(drogue_pose_from_ellipse(p, &circle, &camera, 65536 / 4), DROGUE_OK);
    for (i = 0; i < 2; i++) {
        ck_assert_int_le(abs(p[i].position_m_q16[0]), 4);
        ck_assert_int_le(abs(p[i].position_m_q16[1]), 4);
        ck_assert_int_le(abs(p[i].position_m_q16[2] - 5 * 65536), 4);
        ck_assert_int_le(abs(p[i].axis_q16[0]), 4);
        ck_assert_int_le(abs(p[i].axis_q16[1]), 4);
        ck_assert_int_le(abs(p[i].axis_q16[2] - 65536), 4);
        ck_assert_int_le(abs(p[i].yaw_rad_q16), 4);
        ck_assert_int_le(abs(p[i].pitch_rad_q16), 4);
    }
}
END_TEST

START_TEST(outside_the_domain)
{
    const drogue_camera camera = pinhole(1000, 1000, 500, 400);
    const drogue_ellipse ellipse = {520 * 65536, 380 * 65536, 50 * 65536, 40 * 65536, 30000};
    drogue_camera c = camera;
    drogue_ellipse e = ellipse;
    drogue_pose p[2];
    ck_assert_int_eq(drogue_pose_from_ellipse(p, &ellipse, &camera, 65536), DROGUE_OK);
    c.fx_px_q16 = 0;
    ck_assert_int_eq(drogue_pose_from_ellipse(p, &ellipse, &c, 65536), DROGUE_E_DOMAIN);
    c.fx_px_q16 = -65536;
    ck_assert_int_eq(drogue_pose_from_ellipse(p, &ellipse, &c, 65536), DROGUE_E_DOMAIN);
    c = camera;
    c.fy_px_q16 = 0;
    ck_assert_int_eq(drogue_pose_from_ellipse(p, &ellipse, &c, 65536), DROGUE_E_DOMAIN);
    {
        drogue_ellipse turned = ellipse; /* by 2 rad, whose double is beyond Q29 */
        turned.angle_rad_q16 = 2 * 65536;
        ck_assert_int_eq(drogue_pose_from_ellipse(p, &turned, &camera, 65536), DROGUE_E_DOMAIN);
        turned.angle_rad_q16 = INT32_MIN;
        ck_assert_int_eq(drogue_pose_from_ellipse(p, &turned, &camera, 65536), DROGUE_E_DOMAIN);
    }
    {
        const drogue_camera wide = pinhole(10, 10, 258, 240);
        const drogue_ellipse near = {258 * 65536, 240 * 65536, 85 * 65536, 79 * 65536, 0};
        ck_assert_int_eq(drogue_pose_from_ellipse(p, &near, &wide, 3), DROGUE_E_DOMAIN); /* z is a third of an LSB */
        ck_assert_int_eq(p[0].axis_q16[2], 0);
        ck_assert_int_eq(drogue_pose_from_ellipse(p, &near, &wide, 30), DROGUE_OK);
        ck_assert_int_gt(p[0].position_m_q16[2], 0);
    }
    ck_assert_int_eq(drogue_pose_from_ellipse(p, &ellipse, &camera, 0), DROGUE_E_DOMAIN);
    ck_assert_int_eq(drogue_pose_from_ellipse(p, &ellipse, &camera, -1), DROGUE_E_DOMAIN);
    e.b_px_q16 = 0;
    ck_assert_int_eq(drogue_pose_from_ellipse(p, &e, &camera, 65536), DROGUE_E_DOMAIN);
    e.b_px_q16 = e.a_px_q16 + 1;
    ck_assert_int_eq(drogue_pose_from_ellipse(p, &e, &camera, 65536), DROGUE_E_DOMAIN);
    e.a_px_q16 = e.b_px_q16 = 0;
    ck_assert_int_eq(drogue_pose_from_ellipse(p, &e, &camera, 65536), DROGUE_E_DOMAIN);
    e.a_px_q16 = e.b_px_q16 = 65536; /* one pixel: 1000 radii away */
    ck_assert_int_eq(drogue_pose_from_ellipse(p, &e, &camera, 32 * 65536), DROGUE_OK);
    ck_assert_int_eq(drogue_pose_from_ellipse(p, &e, &camera, 33 * 65536), DROGUE_E_DOMAIN);
    e.xc_px_q16 = camera.cx_px_q16; /* next to a line: the lesser square is nothing beside the larger one */
    e.yc_px_q16 = camera.cy_px_q16;
    e.a_px_q16 = 400 * 65536;
    e.b_px_q16 = 1;
    e.angle_rad_q16 = 0;
    ck_assert_int_eq(drogue_pose_from_ellipse(p, &e, &camera, 65536), DROGUE_E_DOMAIN);
    { /* so far off the axis in one direction that beside it the one before the camera is nothing */
        const drogue_camera narrow = {3, 888, -1, 0, 0, 0, 0, 0, 0};
        const drogue_ellipse wide = {119, -1, 37139756, 530871, 85989};
        ck_assert_int_eq(drogue_pose_from_ellipse(p, &wide, &narrow, 65536), DROGUE_E_DOMAIN);
    }
}
END_TEST

/* Every Q16 pattern is defined: no trap, and what is accepted is a unit axis. */
START_TEST(any_bits)
{
    uint64_t rng = 2;
    int i;
    for (i = 0; i < 30000; i++) {
        drogue_camera c = pinhole(0, 0, 0, 0);
        drogue_ellipse e;
        drogue_pose p[2];
        int32_t a = rng_s32_any_width(&rng), b = rng_s32_any_width(&rng);
        c.fx_px_q16 = rng_s32_any_width(&rng);
        c.fy_px_q16 = rng_s32_any_width(&rng);
        c.cx_px_q16 = rng_s32_any_width(&rng);
        c.cy_px_q16 = rng_s32_any_width(&rng);
        e.xc_px_q16 = rng_s32_any_width(&rng);
        e.yc_px_q16 = rng_s32_any_width(&rng);
        e.a_px_q16 = a > b ? a : b;
        e.b_px_q16 = a > b ? b : a;
        e.angle_rad_q16 = rng_range(&rng, -102943, 102944);
        if (drogue_pose_from_ellipse(p, &e, &c, rng_s32_any_width(&rng)) == DROGUE_OK) {
            int k;
            for (k = 0; k < 2; k++) {
                double axis[3], position[3];
                real_pose(position, axis, &p[k]);
                MUST(fabs(dot3(axis, axis) - 1) < 1e-4, "case %d: axis of length^2 %g", i, dot3(axis, axis));
            }
        }
    }
}
END_TEST

START_TEST(projection_within_2_lsb)
{
    uint64_t rng = 3;
    double worst = 0;
    int i, k, seen = 0;
    for (i = 0; i < 200000; i++) {
        drogue_camera c = pinhole(rng_real(&rng, 100, 3000), rng_real(&rng, 100, 3000), rng_real(&rng, 0, 2000), 700);
        drogue_q16 depth = rng_range(&rng, -3 * 65536, 3 * 65536), x, y;
        drogue_pose p;
        double point[3], u, v;
        memset(&p, 0, sizeof p);
        for (k = 0; k < 3; k++) {
            p.position_m_q16[k] = rng_range(&rng, -4 * 65536, 4 * 65536) + (k == 2 ? 4 * 65536 : 0);
            p.axis_q16[k] = rng_range(&rng, -65536, 65536);
            point[k] = real_of_q16(p.position_m_q16[k]) + real_of_q16(depth) * real_of_q16(p.axis_q16[k]);
        }
        if (point[2] <= 0) {
            MUST(drogue_project_axis_point(&x, &y, &p, depth, &c) == DROGUE_E_BEHIND_CAMERA, "case %d seen", i);
            continue;
        }
        MUST(drogue_project_axis_point(&x, &y, &p, depth, &c) == DROGUE_OK, "case %d not seen", i);
        u = real_of_q16(c.fx_px_q16) * point[0] / point[2] + real_of_q16(c.cx_px_q16);
        v = real_of_q16(c.fy_px_q16) * point[1] / point[2] + real_of_q16(c.cy_px_q16);
        if (fabs(u) < 32767 && fabs(v) < 32767) {
            worst = fmax(worst, fmax(fabs(x - u * 65536), fabs(y - v * 65536)));
            seen++;
        }
    }
    ck_assert_int_gt(seen, 100000);
    MUST(worst <= 2.0, "off by %.3f LSB", worst);
}
END_TEST

/* Any focal length, images anywhere in Q16. */
START_TEST(projection_to_the_ends_of_q16)
{
    uint64_t rng = 4;
    double worst[2] = {0, 0}; /* within 2^13 px, beyond */
    int i, seen = 0;
    for (i = 0; i < 1000000; i++) {
        const double f = exp(rng_real(&rng, log(100), log(32767)));
        const drogue_camera c = pinhole(f, f, rng_real(&rng, -8192, 8192), 0);
        const double most = i & 1 ? 8192 : 32767;
        drogue_pose p;
        drogue_q16 x, y;
        double u;
        memset(&p, 0, sizeof p);
        p.position_m_q16[2] = rng_range(&rng, 1, INT32_MAX) >> rng_range(&rng, 0, 20);
        u = (rng_real(&rng, -most, most) - real_of_q16(c.cx_px_q16)) / f * p.position_m_q16[2];
        if (p.position_m_q16[2] < 1 || fabs(u) > INT32_MAX) {
            continue;
        }
        p.position_m_q16[0] = (int32_t)u;
        u = (double)p.position_m_q16[0] / p.position_m_q16[2] * c.fx_px_q16 + c.cx_px_q16;
        ck_assert_int_eq(drogue_project_axis_point(&x, &y, &p, 0, &c), DROGUE_OK);
        if (fabs(u) < INT32_MAX) {
            double *own = &worst[fabs(u) > 8192.0 * 65536];
            *own = fmax(*own, fabs(x - u));
            seen++;
        }
    }
    ck_assert_int_gt(seen, 500000);
    MUST(worst[0] <= 2.0, "within 2^13 px off by %.3f LSB", worst[0]);
    MUST(worst[1] <= 4.0, "beyond off by %.3f LSB", worst[1]);
}
END_TEST

static drogue_pose pose_at(double z, double yaw, double pitch)
{
    drogue_pose p;
    double axis[3];
    int k;
    memset(&p, 0, sizeof p);
    axis_of_angles(axis, yaw, pitch);
    for (k = 0; k < 3; k++) {
        p.axis_q16[k] = q16_of(axis[k]);
    }
    p.position_m_q16[2] = q16_of(z);
    return p;
}

START_TEST(choice_by_the_inner_centre)
{
    const drogue_camera camera = pinhole(1000, 1000, 500, 400);
    const drogue_q16 depth = 65536 / 4;
    drogue_choice choice;
    drogue_pose p[2];
    drogue_q16 x[2], y[2];
    int turn, i;
    for (turn = 0; turn < 2; turn++) { /* tilted sideways, then up and down */
        p[0] = turn == 0 ? pose_at(5, 0.3, 0) : pose_at(5, 0, 0.3);
        p[1] = turn == 0 ? pose_at(5, -0.3, 0) : pose_at(5, 0, -0.3);
        for (i = 0; i < 2; i++) {
            ck_assert_int_eq(drogue_project_axis_point(&x[i], &y[i], &p[i], depth, &camera), DROGUE_OK);
        }
        for (i = 0; i < 2; i++) {
            double apart = hypot(real_of_q16(x[0]) - real_of_q16(x[1]), real_of_q16(y[0]) - real_of_q16(y[1]));
            ck_assert_int_eq(drogue_choose_pose(&choice, p, x[i], y[i], depth, &camera), DROGUE_OK);
            ck_assert_uint_eq(choice.index, (unsigned)i);
            ck_assert_int_eq(choice.distance_px_q16[i], 0);
            ck_assert_int_le(abs(choice.distance_px_q16[1 - i] - q16_of(apart)), 1);
            ck_assert_int_eq(choice.ambiguity_q16, 0);
        }
        ck_assert_int_eq(
            drogue_choose_pose(&choice, p, x[0] / 4 + (x[1] / 4) * 3, y[0] / 4 + (y[1] / 4) * 3, depth, &camera),
            DROGUE_OK);
        ck_assert_uint_eq(choice.index, 1);
        ck_assert_int_le(abs(choice.ambiguity_q16 - 65536 / 3), 8);
    }
    p[1] = p[0];
    ck_assert_int_eq(drogue_choose_pose(&choice, p, x[0], y[0], depth, &camera), DROGUE_OK);
    ck_assert_int_eq(choice.ambiguity_q16, 65536);
    ck_assert_int_eq(drogue_choose_pose(&choice, p, INT32_MIN, INT32_MAX, depth, &camera), DROGUE_OK);
    ck_assert_int_eq(choice.distance_px_q16[0], INT32_MAX); /* saturated */
    ck_assert_int_eq(choice.ambiguity_q16, 65536);
    p[1] = pose_at(5, TEST_PI, 0); /* its inner centre at z = -1 */
    ck_assert_int_eq(drogue_choose_pose(&choice, p, x[0], y[0], 6 * 65536, &camera), DROGUE_E_BEHIND_CAMERA);
    p[1].axis_q16[2] = -65536; /* exactly in the camera's plane, then next to it */
    ck_assert_int_eq(drogue_project_axis_point(&x[0], &y[0], &p[1], 5 * 65536, &camera), DROGUE_E_BEHIND_CAMERA);
    ck_assert_int_eq(drogue_project_axis_point(&x[0], &y[0], &p[1], 5 * 65536 - 1, &camera), DROGUE_OK);
}
END_TEST

START_TEST(ranges_of_the_angles)
{
    const drogue_q16 half = DROGUE_Q16_HALF_PI, pi = DROGUE_Q16_PI;
    const drogue_q16 cases[][2] = {{0, 0},       {pi, half},    {-pi, -half},  {pi + 1, 0},
                                   {-pi - 1, 0}, {0, half + 1}, {0, -half - 1}};
    size_t i;
    for (i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        drogue_pose p;
        memset(&p, 0, sizeof p);
        p.yaw_rad_q16 = cases[i][0];
        p.pitch_rad_q16 = cases[i][1];
        MUST(drogue_pose_angles_valid(&p) == (i < 3), "case %d", (int)i);
    }
}
END_TEST

SUITE_MAIN("pose", circles_over_distance_and_tilt, random_circles, head_on_has_one_pose, outside_the_domain, any_bits,
           projection_within_2_lsb, projection_to_the_ends_of_q16, choice_by_the_inner_centre, ranges_of_the_angles)
