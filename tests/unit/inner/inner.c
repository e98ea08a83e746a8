/* SPDX-License-Identifier: Apache-2.0 */
/* The inner part as a measurement: where it is expected, and each reason not to believe it. */
#include "suite.h"

#include "drogue/inner.h"
#include "drogue/undistort.h"
#include "joint_model.h"

static drogue_pose pose_of(const pose_real *p)
{
    drogue_pose q;
    double axis[3];
    int k;
    axis_of_angles(axis, p->v[3], p->v[4]);
    for (k = 0; k < 3; k++) {
        q.position_m_q16[k] = q16_of(p->v[k]);
        q.axis_q16[k] = q16_of(axis[k]);
    }
    q.yaw_rad_q16 = q16_of(p->v[3]);
    q.pitch_rad_q16 = q16_of(p->v[4]);
    return q;
}

/* Largest distance of an ellipse from what the lens makes of an ideal one, px. */
static double off_the_image(const drogue_ellipse *got, const ellipse_real *ideal, const drogue_camera *camera)
{
    const double c = cos(real_of_q16(got->angle_rad_q16)), s = sin(real_of_q16(got->angle_rad_q16));
    double worst = 0;
    int i;
    for (i = 0; i < 32; i++) {
        double x, y, dx, dy;
        drogue_q16 u, v;
        ellipse_point(&x, &y, ideal, i * TEST_PI / 16);
        u = q16_of(x);
        v = q16_of(y);
        ck_assert_int_eq(drogue_distort_point(&u, &v, camera), DROGUE_OK);
        dx = real_of_q16(drogue_q16_sub(u, got->xc_px_q16));
        dy = real_of_q16(drogue_q16_sub(v, got->yc_px_q16));
        x = (dx * c + dy * s) / real_of_q16(got->a_px_q16);
        y = (dy * c - dx * s) / real_of_q16(got->b_px_q16);
        worst = fmax(worst, fabs(hypot(x, y) - 1) * real_of_q16(got->a_px_q16));
    }
    return worst;
}

/* Through a lens to first order about the disc's centre. */
START_TEST(expected_where_the_poses_show_it)
{
    uint64_t rng = 1;
    int i, k;
    for (i = 0; i < 2000; i++) {
        field f = usual_field();
        const int32_t x_px = rng_range(&rng, 0, 1000), y_px = rng_range(&rng, 0, 1000);
        drogue_config config;
        drogue_pose poses[2];
        drogue_inner_expected got;
        ellipse_real truth[2];
        if (i & 1) {
            f.camera.k1_q16 = q16_of(rng_real(&rng, -0.1, 0.1));
            f.camera.p2_q16 = q16_of(rng_real(&rng, -0.002, 0.002));
        }
        for (k = 0; k < 2; k++) {
            pose_real p = {{0, 0, 0, 0, 0}};
            p.v[2] = rng_real(&rng, 3, 25);
            p.v[0] = p.v[2] * rng_real(&rng, -0.3, 0.3);
            p.v[1] = p.v[2] * rng_real(&rng, -0.3, 0.3);
            p.v[3] = rng_real(&rng, -0.5, 0.5);
            p.v[4] = rng_real(&rng, -0.5, 0.5);
            poses[k] = pose_of(&p);
            ck_assert(field_inner(&truth[k], &f, &p));
        }
        drogue_config_default(&config);
        drogue_inner_expect(&got, poses, &(drogue_setup){&f.camera, &f.model, &config}, x_px, y_px);
        MUST(got.count == 2, "case %d: not both", i);
        for (k = 0; k < 2; k++) {
            drogue_q16 u = q16_of(truth[k].xc), v = q16_of(truth[k].yc);
            ck_assert_int_eq(drogue_distort_point(&u, &v, &f.camera), DROGUE_OK);
            /* the pose was rounded: 2^-17 m or rad at its distance */
            MUST(hypot(real_of_q16(got.disc[k].xc_px_q16) + x_px - real_of_q16(u),
                       real_of_q16(got.disc[k].yc_px_q16) + y_px - real_of_q16(v)) < 0.02,
                 "case %d: disc %d is elsewhere", i, k);
            got.disc[k].xc_px_q16 += x_px * 65536;
            got.disc[k].yc_px_q16 += y_px * 65536;
            MUST(off_the_image(&got.disc[k], &truth[k], &f.camera) < (i & 1 ? 0.4 : 0.03),
                 "case %d: disc %d's outline %g px off", i, k, off_the_image(&got.disc[k], &truth[k], &f.camera));
        }
    }
}
END_TEST

START_TEST(poses_that_show_none)
{
    const pose_real good = {{0.1, 0.2, 6, 0.1, 0.1}}, far = {{0, 0, 200, 0, 0}}, behind = {{0, 0, 6, 0, 0}};
    field f = usual_field();
    drogue_pose poses[2];
    drogue_config config;
    const drogue_setup setup = {&f.camera, &f.model, &config};
    drogue_inner_expected one, got;
    drogue_config_default(&config);
    poses[0] = poses[1] = pose_of(&good);
    drogue_inner_expect(&one, poses, &setup, 0, 0);
    ck_assert_uint_eq(one.count, 2);
    poses[0] = pose_of(&far); /* 0.9 px */
    drogue_inner_expect(&got, poses, &setup, 0, 0);
    ck_assert_uint_eq(got.count, 1);
    ck_assert_int_eq(memcmp(&got.disc[0], &one.disc[0], sizeof got.disc[0]), 0); /* the other one comes first */
    poses[1] = pose_of(&far);
    drogue_inner_expect(&got, poses, &setup, 0, 0);
    ck_assert_uint_eq(got.count, 0);
    f.model.inner_depth_m_q16 = q16_of(-7);
    poses[0] = poses[1] = pose_of(&behind);
    drogue_inner_expect(&got, poses, &setup, 0, 0);
    ck_assert_uint_eq(got.count, 0);
}
END_TEST

/* An outline of 100 by 80 px, a disc of 30 px expected 10 px off its centre, and the part found there. */
typedef struct finding {
    drogue_inner_edge edge;
    drogue_ellipse expected, outline;
    drogue_config config;
} finding;

static finding usual_finding(void)
{
    finding f;
    memset(&f, 0, sizeof f);
    drogue_config_default(&f.config);
    f.outline.xc_px_q16 = q16_of(200);
    f.outline.yc_px_q16 = q16_of(150);
    f.outline.a_px_q16 = q16_of(100);
    f.outline.b_px_q16 = q16_of(80);
    f.expected.xc_px_q16 = q16_of(210);
    f.expected.yc_px_q16 = q16_of(150);
    f.expected.a_px_q16 = f.expected.b_px_q16 = q16_of(30);
    f.edge.x_px_q16 = q16_of(210);
    f.edge.y_px_q16 = q16_of(150);
    f.edge.rays = 50;
    f.edge.contrast = 40;
    return f;
}

static double std_of(const finding *f)
{
    return real_of_q16(drogue_inner_std(&f->edge, &f->expected, &f->outline, &f->config));
}

START_TEST(standard_deviation)
{
    uint64_t rng = 3;
    int i, far = 0;
    for (i = 0; i < 20000; i++) {
        finding f = usual_finding();
        const double a = rng_real(&rng, 3, 5), grown = rng_real(&rng, -1.4, 1.4);
        const double doubt = grown < -0.5 ? (-grown - 0.5) / a / 2 : grown / a;
        const double off = doubt > 0.125 ? doubt * a : 0; /* so far off its size it may be something else */
        double expected;
        f.expected.a_px_q16 = f.expected.b_px_q16 = q16_of(a);
        f.edge.grown_px_q16 = q16_of(grown);
        f.edge.std_px_q16 = q16_of(rng_real(&rng, 0, 3));
        f.config.inner_std_px_q16 = q16_of(rng_real(&rng, 0.001, 2));
        f.config.inner_std_share_q16 = q16_of(rng_real(&rng, 0, 0.1));
        expected = sqrt(pow(real_of_q16(f.config.inner_std_px_q16), 2) +
                        pow(real_of_q16(f.config.inner_std_share_q16) * a, 2) + pow(real_of_q16(f.edge.std_px_q16), 2) +
                        off * off);
        MUST(fabs(std_of(&f) - expected) < 8.0 / 65536 || fabs(doubt - 0.125) < 0.0001, "case %d: %g, not %g", i,
             std_of(&f), expected);
        far += off > 0;
    }
    ck_assert_int_gt(far, 1000);
}
END_TEST

START_TEST(reasons_not_to_believe)
{
    finding f = usual_finding();
    int k;
    ck_assert(std_of(&f) > 0);
    for (k = -1; k <= 1; k += 2) { /* 7 % and 5/4 px larger or smaller */
        f.edge.grown_px_q16 = k * q16_of(3.34);
        ck_assert(std_of(&f) > 0);
        f.edge.grown_px_q16 = k * q16_of(3.36);
        ck_assert_int_eq(drogue_inner_std(&f.edge, &f.expected, &f.outline, &f.config), k > 0 ? -1 : 0);
    }
    f.edge.grown_px_q16 = q16_of(3.36);
    f.edge.rays = 25; /* too large, and too little of it: no disc */
    ck_assert(std_of(&f) == 0);
    f = usual_finding();
    f.edge.rays = 32;
    ck_assert(std_of(&f) > 0);
    f.edge.rays = 31; /* of 64: less than a half */
    ck_assert(std_of(&f) == 0);
    f = usual_finding();
    f.edge.spread_px_q16 = q16_of(0.649);
    ck_assert(std_of(&f) > 0);
    f.edge.spread_px_q16 = q16_of(0.651); /* which what lies about at random has, too */
    ck_assert(std_of(&f) == 0);
    f = usual_finding();
    f.edge.contrast = 6;
    ck_assert(std_of(&f) > 0);
    f.edge.contrast = 5; /* hardly darker than its surround */
    ck_assert(std_of(&f) == 0);
    for (k = 0; k < 4; k++) { /* 1.5 px and a twentieth of the semi-axis off, each way */
        f = usual_finding();
        f.edge.rays = 55;
        f.edge.x_px_q16 += k == 0 ? q16_of(6.4) : k == 1 ? -q16_of(6.4) : 0;
        f.edge.y_px_q16 += k == 2 ? q16_of(6.4) : k == 3 ? -q16_of(6.4) : 0;
        ck_assert(std_of(&f) > 0);
        f.edge.x_px_q16 += k == 0 ? q16_of(0.2) : k == 1 ? -q16_of(0.2) : 0;
        f.edge.y_px_q16 += k == 2 ? q16_of(0.2) : k == 3 ? -q16_of(0.2) : 0;
        ck_assert(std_of(&f) == 0);
    }
    f = usual_finding(); /* the rim would cut it: (100 - 30) / 100 of the semi-axes is the room there is */
    f.config.inner_gate_q16 = INT32_MAX;
    f.edge.x_px_q16 = q16_of(200 + 69.9);
    ck_assert(std_of(&f) > 0);
    f.edge.x_px_q16 = q16_of(200 + 70.1);
    ck_assert(std_of(&f) == 0);
    f.edge.x_px_q16 = q16_of(200);
    f.edge.y_px_q16 = q16_of(150 + 55.9);
    ck_assert(std_of(&f) > 0);
    f.edge.y_px_q16 = q16_of(150 + 56.1);
    ck_assert(std_of(&f) == 0);
    f = usual_finding(); /* as large as the outline */
    f.expected.a_px_q16 = f.expected.b_px_q16 = q16_of(101);
    ck_assert(std_of(&f) == 0);
}
END_TEST

/* A disc that is evident may lie twice as far from where it is expected: seen by seven rays of eight, within half of what
 * rays may scatter, of its size to 0.3 px and a 64th. */
START_TEST(evident_elsewhere)
{
    finding f = usual_finding();
    int k;
    f.edge.rays = 56;
    f.edge.spread_px_q16 = q16_of(0.324);
    for (k = -1; k <= 1; k += 2) {
        f.edge.grown_px_q16 = k * q16_of(0.76); /* 0.3 + 30 / 64 is 0.769 */
        f.edge.x_px_q16 = q16_of(210 + 12.9);
        ck_assert(std_of(&f) > 0);
        f.edge.x_px_q16 = q16_of(210 + 13.1);
        ck_assert(std_of(&f) == 0);
        f.edge.x_px_q16 = q16_of(210 + 6.6);
        ck_assert(std_of(&f) > 0);
        f.edge.grown_px_q16 = k * q16_of(0.78);
        ck_assert(std_of(&f) == 0);
    }
    f.edge.grown_px_q16 = 0;
    f.edge.spread_px_q16 = q16_of(0.326);
    ck_assert(std_of(&f) == 0);
    f.edge.spread_px_q16 = 0;
    f.edge.rays = 55;
    ck_assert(std_of(&f) == 0);
}
END_TEST

/* The farther a drogue is tilted, the nearer to the rim its disc lies: 0.25 sin t from the middle of 0.35 cos t, with 0.12
 * cos t to either side, it touches the rim at a tilt of 42.6 degrees. */
START_TEST(within_the_rim_however_tilted)
{
    const field usual = usual_field();
    int tilt, turn;
    for (tilt = 20; tilt <= 46; tilt += 2) {
        for (turn = 0; turn < 12; turn++) {
            const double sine = sin(tilt * TEST_PI / 180), around = turn * TEST_PI / 6;
            const pose_real p = {
                {0, 0, 20, atan2(sine * cos(around), cos(tilt * TEST_PI / 180)), asin(sine * sin(around))}};
            finding g = usual_finding();
            ellipse_real outline, disc;
            MUST(field_outline(&outline, &usual, &p) && field_inner(&disc, &usual, &p), "tilt %d", tilt);
            g.outline = ellipse_to_q16(&outline);
            g.expected = ellipse_to_q16(&disc);
            g.edge.x_px_q16 = g.expected.xc_px_q16;
            g.edge.y_px_q16 = g.expected.yc_px_q16;
            MUST((std_of(&g) > 0) == (tilt <= 42), "tilt %d, turned %d: %g", tilt, turn, std_of(&g));
        }
    }
}
END_TEST

/* A disc is no evidence where one of the poses shows none, where the lens model does not reach, and where it is small. */
START_TEST(no_evidence)
{
    const drogue_region region = {100, 200, 400, 300};
    const pose_real p = {{0, 0, 6, 0, 0}};
    int reason;
    for (reason = 0; reason <= 3; reason++) {
        finding g = usual_finding();
        field f = usual_field();
        const drogue_setup setup = {&f.camera, &f.model, &g.config};
        const drogue_pose poses[2] = {pose_of(&p), pose_of(&p)};
        drogue_inner_expected expected;
        drogue_inner_evidence evidence;
        memset(&expected, 0, sizeof expected);
        expected.count = 1;
        expected.disc[0] = g.expected;
        if (reason == 1) {
            f.model.inner_depth_m_q16 = q16_of(-7);
        } else if (reason == 2) {
            f.camera.k1_q16 = q16_of(-2); /* seen to 0.27 focal lengths off the axis */
        } else if (reason == 3) {
            g.config.min_inner_area_px = 3000; /* a circle of 30 px has 2827 */
        }
        memset(&evidence, 0xA5, sizeof evidence);
        drogue_inner_weigh(&evidence, &g.edge, &region, &expected, &g.outline, poses, &setup);
        MUST((evidence.weighed.std_px_q16 > 0) == (reason == 0) && (evidence.part.area_px > 0) == (reason == 0),
             "reason %d: std %g, area %u", reason, real_of_q16(evidence.weighed.std_px_q16),
             (unsigned)evidence.part.area_px);
        MUST(evidence.nearer == 0 && evidence.too_large == 0 && evidence.ambiguity_q16 == DROGUE_Q16_ONE,
             "reason %d: ambiguity %g", reason, real_of_q16(evidence.ambiguity_q16));
    }
}
END_TEST

/* Through a lens that folds where the disc is seen, it is seen flat: none is expected. */
START_TEST(flat_where_the_lens_folds)
{
    field f = usual_field();
    drogue_config config;
    const drogue_setup setup = {&f.camera, &f.model, &config};
    int k, none = 0;
    drogue_config_default(&config);
    for (k = 0; k < 16000; k++) {
        pose_real p = {{0, 0, 6, 0, 0}};
        drogue_inner_expected got;
        drogue_pose poses[2];
        f.camera.k1_q16 = q16_of(-0.4) + k % 400;
        p.v[0] = 6 * sqrt(65536.0 / -3 / f.camera.k1_q16) + (k / 400 - 225) / 65536.0;
        p.v[3] = atan2(p.v[0], 6);
        p.v[0] -= 0.25 * sin(p.v[3]);
        p.v[2] -= 0.25 * cos(p.v[3]);
        poses[0] = poses[1] = pose_of(&p);
        drogue_inner_expect(&got, poses, &setup, 0, 0);
        none += got.count == 0;
        MUST(got.count == 0 || got.disc[0].b_px_q16 > 0, "case %d: flat", k);
    }
    ck_assert_int_gt(none, 10); /* to the 2^-17 of a pixel */
}
END_TEST

START_TEST(any_bits)
{
    uint64_t rng = 4;
    int i;
    for (i = 0; i < 100000; i++) {
        finding f = usual_finding();
        int32_t any[9];
        int k;
        for (k = 0; k < 9; k++) {
            any[k] = rng_s32_any_width(&rng);
        }
        f.edge.x_px_q16 = rng_range(&rng, 0, 2047 * 65536);
        f.edge.y_px_q16 = rng_range(&rng, 0, 2047 * 65536);
        f.edge.rays = 64;
        f.edge.std_px_q16 = rng_range(&rng, 0, INT32_MAX);
        f.expected.xc_px_q16 = any[0];
        f.expected.yc_px_q16 = any[1];
        f.expected.a_px_q16 = 65536 | (any[2] & INT32_MAX);
        f.expected.b_px_q16 = 1 | (any[3] & INT32_MAX);
        f.outline.xc_px_q16 = any[4];
        f.outline.yc_px_q16 = any[5];
        f.outline.b_px_q16 = 65536 | (any[6] & INT32_MAX);
        f.outline.a_px_q16 = f.outline.b_px_q16 | (any[7] & INT32_MAX);
        f.config.inner_gate_q16 = any[8] & INT32_MAX;
        f.config.inner_std_share_q16 = 65536;
        f.config.inner_std_px_q16 = 16 * 65536;
        MUST(std_of(&f) >= 0, "case %d", i);
    }
}
END_TEST

/* What a finding says of the distance. */
static void weigh(drogue_inner_evidence *evidence, const finding *g)
{
    const drogue_region region = {100, 200, 400, 300};
    const pose_real p = {{0, 0, 6, 0, 0}};
    const drogue_pose poses[2] = {pose_of(&p), pose_of(&p)};
    const field f = usual_field();
    const drogue_setup setup = {&f.camera, &f.model, &g->config};
    drogue_inner_expected expected;
    memset(&expected, 0, sizeof expected);
    expected.count = 1;
    expected.disc[0] = g->expected;
    drogue_inner_weigh(evidence, &g->edge, &region, &expected, &g->outline, poses, &setup);
}

/* Of 30 px: what the disc's size says of the distance. */
START_TEST(doubt_by_size)
{
    static const double grown[][2] = {{0, 0},
                                      {0.45, 0},
                                      {-0.5, 0},
                                      {30 / 64.0 + 0.06, 0.004},
                                      {0.7, 0.01542},
                                      {1.5, 0.05},
                                      {30 / 32.0, 1 / 32.0},
                                      {-1.1, 0.01},
                                      {-3.5, 0.05},
                                      {29.99, 0.9997},
                                      {40, 0.99999}};
    size_t i;
    for (i = 0; i < sizeof grown / sizeof grown[0]; i++) {
        finding g = usual_finding();
        drogue_inner_evidence evidence;
        g.edge.grown_px_q16 = q16_of(grown[i][0]);
        weigh(&evidence, &g);
        MUST(fabs(real_of_q16(evidence.doubt_q16) - grown[i][1]) < 3.0 / 65536, "%g px: %g", grown[i][0],
             real_of_q16(evidence.doubt_q16));
        ck_assert_int_lt(evidence.doubt_q16, DROGUE_Q16_ONE);
    }
}
END_TEST

/* Of 30 px, seen all about: too large by so much and beside its place by so much the outline is too far by what is less,
 * three quarters of it; not where the disc is in its place, much too large, or not seen by seven of eight rays. */
START_TEST(too_far_by_size_and_place)
{
    static const struct {
        double grown, away;
        uint32_t rays;
        double px;
    } of[] = {{0, 0, 64, 0},
              {1, 0, 64, 0},
              {1, 1, 64, 0},
              {1, 1.5, 64, 0.25},
              {1, 2, 64, 0.5},
              {1, 2.7, 64, 0.85},
              {1, 3, 64, 1 - 30 / 256.0},
              {1, 3, 56, 1 - 30 / 256.0},
              {1, 3, 55, 0},
              {0.1, 2, 64, 0},
              {30 / 256.0, 4, 64, 0},
              {0.2, 4, 64, 0.2 - 30 / 256.0},
              {-1, 3, 64, 0},
              {3.74, 9.5, 64, 2.88},
              {3.76, 9.5, 64, 0}};
    size_t i;
    for (i = 0; i < sizeof of / sizeof of[0]; i++) {
        const double turn = (double)i;
        finding g = usual_finding();
        drogue_inner_evidence evidence;
        g.edge.grown_px_q16 = q16_of(of[i].grown);
        g.edge.rays = of[i].rays;
        g.edge.x_px_q16 = g.expected.xc_px_q16 + q16_of(of[i].away * cos(turn));
        g.edge.y_px_q16 = g.expected.yc_px_q16 + q16_of(of[i].away * sin(turn));
        weigh(&evidence, &g);
        MUST(fabs(real_of_q16(evidence.too_far_q16) - 0.75 * of[i].px / 30) < 3.0 / 65536, "%zu: %g px of %g", i,
             real_of_q16(evidence.too_far_q16) * 30 / 0.75, of[i].px);
    }
}
END_TEST

SUITE_MAIN("inner", expected_where_the_poses_show_it, poses_that_show_none, standard_deviation, reasons_not_to_believe,
           evident_elsewhere, within_the_rim_however_tilted, no_evidence, doubt_by_size, too_far_by_size_and_place,
           flat_where_the_lens_folds, any_bits)
