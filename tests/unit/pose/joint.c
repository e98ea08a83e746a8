/* SPDX-License-Identifier: Apache-2.0 */
/* The joint pose: poses and their covariances against the measurement model in double precision. */
#include "suite.h"

#include "drogue/joint.h"
#include "joint_model.h"

#include "../../../src/pose/joint_model.h"

/* What the pose shows, exact but for the rounding to Q16; offsets known to 1 / 10 px over 200 points. */
static int measurement_of(drogue_joint_outline *outline, drogue_real covariance[DROGUE_PACKED_MAX],
                          drogue_joint_inner *inner, drogue_pose poses[2], const field *f, const pose_real *p)
{
    drogue_ellipse ellipse;
    ellipse_real e, d;
    double variance;
    int i;
    if (!field_outline(&e, f, p) || !field_inner(&d, f, p)) {
        return 0;
    }
    ellipse = ellipse_to_q16(&e);
    inner->x_px_q16 = q16_of(d.xc);
    inner->y_px_q16 = q16_of(d.yc);
    inner->std_px_q16 = q16_of(0.03);
    variance = pow(0.1 / e.a, 2) / 200;
    memset(covariance, 0, DROGUE_PACKED_MAX * sizeof *covariance);
    for (i = 0; i < 5; i++) {
        covariance[DROGUE_PACKED(i, i)] = real_of((quad)(i == 0 ? variance : 2 * variance));
    }
    return drogue_joint_outline_weigh(outline, &ellipse, covariance) == DROGUE_OK &&
           drogue_pose_from_ellipse(poses, &ellipse, &f->camera, f->model.rim_radius_m_q16) == DROGUE_OK;
}

/* From the right start within the few steps that a frame takes; from the other one within those that may be asked for,
 * to 35 degrees off the line of sight. */
START_TEST(exact_data_gives_the_exact_pose_from_both_starts)
{
    const field f = usual_field();
    uint64_t rng = 6;
    double worst[2] = {0, 0};
    int i, k, solved = 0;
    for (i = 0; i < 2000; i++) {
        const pose_real p = random_pose(&rng, 0.5);
        drogue_joint_outline outline;
        drogue_real covariance[DROGUE_PACKED_MAX];
        drogue_joint_inner inner;
        drogue_pose poses[2];
        drogue_joint joint;
        double axis[3], start[2];
        axis_of_angles(axis, p.v[3], p.v[4]);
        if (!measurement_of(&outline, covariance, &inner, poses, &f, &p) ||
            dot3(axis, p.v) < cos(35 * TEST_PI / 180) * sqrt(dot3(p.v, p.v))) {
            continue;
        }
        for (k = 0; k < 2; k++) {
            start[k] = pose_error_lsb(&poses[k], &p);
        }
        for (k = 0; k < 2; k++) { /* nearer, farther */
            const drogue_pose *from = &poses[(start[1] < start[0]) ^ k];
            MUST(drogue_joint_solve(&joint, from, &outline, &inner, &f.camera, &f.model, k ? 16 : 5) == DROGUE_OK,
                 "case %d from start %d refused", i, k);
            /* a step of 2^-20 rad is 0.2 of a standard deviation at most, and chi2 that of the point before it */
            MUST(quad_of(joint.chi2) < (quad)0.1L, "case %d: chi2 %g", i, (double)quad_of(joint.chi2));
            worst[k] = fmax(worst[k], pose_error_lsb(&joint.pose, &p));
        }
        solved++;
    }
    ck_assert_int_gt(solved, 1300);
    MUST(worst[0] <= 2, "nearer start: %g LSB off", worst[0]);
    MUST(worst[1] <= 2, "farther start: %g LSB off", worst[1]);
}
END_TEST

START_TEST(outline_alone_stays_where_the_cone_puts_it)
{
    const field f = usual_field();
    uint64_t rng = 7;
    double worst = 0, apart = 0;
    int i, k, m, solved = 0;
    for (i = 0; i < 1500; i++) {
        const pose_real p = random_pose(&rng, 0.5);
        const drogue_joint_inner none = {0, 0, 0};
        drogue_joint_outline outline;
        drogue_real covariance[DROGUE_PACKED_MAX];
        drogue_joint_inner inner;
        drogue_pose poses[2];
        drogue_joint joint;
        if (!measurement_of(&outline, covariance, &inner, poses, &f, &p)) {
            continue;
        }
        for (k = 0; k < 2; k++) {
            pose_real start;
            double expected[5][5], sight[3];
            int j;
            MUST(drogue_joint_solve(&joint, &poses[k], &outline, &none, &f.camera, &f.model, 16) == DROGUE_OK,
                 "case %d from start %d refused", i, k);
            for (j = 0; j < 3; j++) {
                start.v[j] = real_of_q16(poses[k].position_m_q16[j]);
                sight[j] = real_of_q16(poses[k].axis_q16[j]);
            }
            start.v[3] = real_of_q16(poses[k].yaw_rad_q16);
            start.v[4] = real_of_q16(poses[k].pitch_rad_q16);
            /* near head-on a rounding of the ellipse is many of the axis */
            if (dot3(sight, start.v) / sqrt(dot3(start.v, start.v)) > cos(0.1)) {
                continue;
            }
            for (m = 0; m < 3; m++) {
                worst = fmax(worst, abs(joint.pose.position_m_q16[m] - poses[k].position_m_q16[m]));
                worst = fmax(worst, abs(joint.pose.axis_q16[m] - poses[k].axis_q16[m]));
            }
            MUST(quad_of(joint.chi2) < (quad)0.1L, "case %d: chi2 %g", i, (double)quad_of(joint.chi2));
            MUST(propagated(expected, &f, &start, covariance, 0), "case %d: no model", i);
            apart = fmax(apart, covariance_apart(joint.covariance, expected));
            MUST(drogue_joint_solve(&joint, &poses[k], &outline, &none, &f.camera, &f.model, 0) == DROGUE_OK &&
                     memcmp(joint.pose.position_m_q16, poses[k].position_m_q16, sizeof joint.pose.position_m_q16) ==
                         0 &&
                     joint.pose.yaw_rad_q16 == poses[k].yaw_rad_q16 &&
                     joint.pose.pitch_rad_q16 == poses[k].pitch_rad_q16 &&
                     covariance_apart(joint.covariance, expected) < 0.002,
                 "case %d: not the start after no step", i);
            solved++;
        }
    }
    ck_assert_int_gt(solved, 2000);
    MUST(worst <= 8, "%g LSB off the start", worst);
    MUST(apart < 0.002, "covariance off by %g", apart);
}
END_TEST

/* Pose of an ellipse a little off, by the cone; nearest of the two to a start. */
static int cone_pose(double out[5], const ellipse_real *e, const field *f, const drogue_pose *start)
{
    ellipse_real turned = *e;
    drogue_ellipse q;
    drogue_pose poses[2], *p;
    int k, far[2];
    turned.angle = angle_difference(e->angle, 0, TEST_PI);
    q = ellipse_to_q16(&turned);
    if (drogue_pose_from_ellipse(poses, &q, &f->camera, f->model.rim_radius_m_q16) != DROGUE_OK) {
        return 0;
    }
    for (k = 0; k < 2; k++) {
        far[k] = abs(poses[k].yaw_rad_q16 - start->yaw_rad_q16) + abs(poses[k].pitch_rad_q16 - start->pitch_rad_q16);
    }
    p = &poses[far[1] < far[0]];
    for (k = 0; k < 3; k++) {
        out[k] = real_of_q16(p->position_m_q16[k]);
    }
    out[3] = real_of_q16(p->yaw_rad_q16);
    out[4] = real_of_q16(p->pitch_rad_q16);
    return 1;
}

/* The same covariance by the other way round: each parameter of the ellipse is moved, and the cone gives the pose. */
START_TEST(covariance_against_the_cone)
{
    const field f = usual_field();
    const drogue_joint_inner none = {0, 0, 0};
    uint64_t rng = 8;
    int i, j, k, l, compared = 0;
    for (i = 0; i < 300; i++) {
        const pose_real p = random_pose(&rng, 0.5);
        drogue_joint_outline outline;
        drogue_real covariance[DROGUE_PACKED_MAX];
        drogue_joint_inner inner;
        drogue_pose poses[2];
        drogue_joint joint;
        ellipse_real e;
        double slope[5][5], expected[5][5], sight = 0, axis[3]; /* pose by harmonic */
        if (!measurement_of(&outline, covariance, &inner, poses, &f, &p)) {
            continue;
        }
        axis_of_angles(axis, p.v[3], p.v[4]);
        sight = dot3(axis, p.v) / sqrt(dot3(p.v, p.v));
        if (sight > cos(0.35) || p.v[2] > 8) { /* farther or more head-on the cone is too crooked for its Q16 steps */
            continue;
        }
        e = ellipse_from_q16(&outline.ellipse);
        k = fabs(real_of_q16(poses[0].yaw_rad_q16) - p.v[3]) + fabs(real_of_q16(poses[0].pitch_rad_q16) - p.v[4]) >
            fabs(real_of_q16(poses[1].yaw_rad_q16) - p.v[3]) + fabs(real_of_q16(poses[1].pitch_rad_q16) - p.v[4]);
        MUST(drogue_joint_solve(&joint, &poses[k], &outline, &none, &f.camera, &f.model, 16) == DROGUE_OK, "case %d",
             i);
        {
            quad by_parameter[5][5], back[5][5];
            double pose_slope[5][5];
            memset(by_parameter, 0, sizeof by_parameter);
            memset(pose_slope, 0, sizeof pose_slope);
            for (j = 0; j < 5; j++) { /* xc, yc, a, b, angle; differences over two steps, the third order taken out */
                double step = j == 4 ? fmin(0.1, 0.4 / (e.a - e.b)) : 0.4, share = 4.0 / 3;
                int turn;
                for (turn = 0; turn < 2; turn++, step *= 2, share = -1.0 / 3) {
                    ellipse_real moved[2] = {e, e};
                    double m[2][5], pose[2][5];
                    for (l = 0; l < 2; l++) {
                        double *member = j == 0   ? &moved[l].xc
                                         : j == 1 ? &moved[l].yc
                                         : j == 2 ? &moved[l].a
                                         : j == 3 ? &moved[l].b
                                                  : &moved[l].angle;
                        *member += l ? step : -step;
                        harmonics_of(m[l], &moved[l], &e);
                        MUST(cone_pose(pose[l], &moved[l], &f, &poses[k]), "case %d: no pose", i);
                    }
                    for (l = 0; l < 5; l++) {
                        by_parameter[l][j] += (quad)(share * (m[1][l] - m[0][l]) / step);
                        pose_slope[l][j] += share * (pose[1][l] - pose[0][l]) / step;
                    }
                }
            }
            MUST(quad_invert(back, by_parameter, 5), "case %d: harmonics", i);
            for (j = 0; j < 5; j++) {
                for (l = 0; l < 5; l++) {
                    int q;
                    slope[j][l] = 0;
                    for (q = 0; q < 5; q++) {
                        slope[j][l] += pose_slope[j][q] * (double)back[q][l];
                    }
                }
            }
        }
        for (j = 0; j < 5; j++) {
            for (l = 0; l < 5; l++) {
                int q;
                expected[j][l] = 0;
                for (q = 0; q < 5; q++) { /* the harmonics' covariance is diagonal here */
                    expected[j][l] += slope[j][q] * slope[l][q] * (double)quad_of(covariance[DROGUE_PACKED(q, q)]);
                }
            }
        }
        MUST(covariance_apart(joint.covariance, expected) < 0.05, "case %d, z %g: covariance off by %g", i, p.v[2],
             covariance_apart(joint.covariance, expected));
        compared++;
    }
    ck_assert_int_gt(compared, 60);
}
END_TEST

START_TEST(covariance_with_the_inner_part)
{
    const field f = usual_field();
    uint64_t rng = 9;
    double apart = 0;
    int i, solved = 0;
    for (i = 0; i < 1500; i++) {
        const pose_real p = random_pose(&rng, 0.4);
        drogue_joint_outline outline;
        drogue_real covariance[DROGUE_PACKED_MAX];
        drogue_joint_inner inner;
        drogue_pose poses[2];
        drogue_joint joint;
        double expected[5][5];
        int k;
        if (!measurement_of(&outline, covariance, &inner, poses, &f, &p)) {
            continue;
        }
        inner.std_px_q16 = q16_of(rng_real(&rng, 0.02, 0.5));
        k = fabs(real_of_q16(poses[0].yaw_rad_q16) - p.v[3]) + fabs(real_of_q16(poses[0].pitch_rad_q16) - p.v[4]) >
            fabs(real_of_q16(poses[1].yaw_rad_q16) - p.v[3]) + fabs(real_of_q16(poses[1].pitch_rad_q16) - p.v[4]);
        MUST(drogue_joint_solve(&joint, &poses[k], &outline, &inner, &f.camera, &f.model, 16) == DROGUE_OK, "case %d",
             i);
        MUST(propagated(expected, &f, &p, covariance, real_of_q16(inner.std_px_q16)), "case %d: no model", i);
        /* the core's slopes of the centroid are those of the disc's centre: right to first order in radius over z */
        apart = fmax(apart,
                     covariance_apart(joint.covariance, expected) * p.v[2] / real_of_q16(f.model.inner_radius_m_q16));
        solved++;
    }
    ck_assert_int_gt(solved, 1300);
    MUST(apart < 1.2, "covariance off by %g of the disc's radius over its distance", apart);
}
END_TEST

/* Head-on both starts are one, and the outline says nothing about the sign of the tilt: with and without the inner part
 * there is a pose, and a covariance that says how much is known. */
START_TEST(head_on)
{
    const field f = usual_field();
    double z;
    int k;
    for (z = 2; z < 30; z *= 1.3) {
        const pose_real p = {{0.02 * z, -0.01 * z, z, 0.02, -0.01}}; /* along the line of sight, or nearly */
        drogue_joint_inner none = {0, 0, 0}, inner;
        drogue_joint_outline outline;
        drogue_real covariance[DROGUE_PACKED_MAX];
        drogue_pose poses[2];
        drogue_joint with, without;
        MUST(measurement_of(&outline, covariance, &inner, poses, &f, &p), "z %g: not seen", z);
        for (k = 0; k < 2; k++) {
            MUST(drogue_joint_solve(&without, &poses[k], &outline, &none, &f.camera, &f.model, 16) == DROGUE_OK, "z %g",
                 z);
            MUST(drogue_joint_solve(&with, &poses[k], &outline, &inner, &f.camera, &f.model, 16) == DROGUE_OK, "z %g",
                 z);
            MUST(abs(with.pose.position_m_q16[2] - q16_of(z)) < 65, "z %g", real_of_q16(with.pose.position_m_q16[2]));
            MUST(pose_error_lsb(&with.pose, &p) < 20, "z %g: %g LSB off", z, pose_error_lsb(&with.pose, &p));
            MUST(quad_of(without.covariance[DROGUE_PACKED(3, 3)]) <= 1 &&
                     quad_of(with.covariance[DROGUE_PACKED(3, 3)]) < quad_of(without.covariance[DROGUE_PACKED(3, 3)]),
                 "z %g: variance of the yaw", z);
        }
    }
}
END_TEST

START_TEST(what_cannot_be_solved)
{
    field f = usual_field();
    const pose_real p = {{0.1, -0.2, 5, 0.2, 0.1}};
    drogue_joint_outline outline, broken;
    drogue_real covariance[DROGUE_PACKED_MAX];
    drogue_joint_inner inner;
    drogue_pose poses[2], away;
    drogue_joint joint;
    drogue_ellipse disc;
    ck_assert(measurement_of(&outline, covariance, &inner, poses, &f, &p));
    drogue_real_negate(&covariance[DROGUE_PACKED(4, 4)]);
    ck_assert_int_eq(drogue_joint_outline_weigh(&broken, &outline.ellipse, covariance), DROGUE_E_DEGENERATE);
    memset(covariance, 0, sizeof covariance);
    ck_assert_int_eq(drogue_joint_outline_weigh(&broken, &outline.ellipse, covariance), DROGUE_E_DEGENERATE);
    f.model.inner_depth_m_q16 = q16_of(-6);
    ck_assert_int_eq(drogue_joint_solve(&joint, &poses[0], &outline, &inner, &f.camera, &f.model, 0),
                     DROGUE_E_BEHIND_CAMERA);
    ck_assert_int_eq(drogue_joint_solve(&joint, &poses[0], &outline, &inner, &f.camera, &f.model, 5),
                     DROGUE_E_BEHIND_CAMERA);
    ck_assert_int_eq(drogue_inner_disc_image(&disc, &poses[0], &f.camera, &f.model), DROGUE_E_BEHIND_CAMERA);
    inner.std_px_q16 = 0; /* the outline alone does not mind */
    ck_assert_int_eq(drogue_joint_solve(&joint, &poses[0], &outline, &inner, &f.camera, &f.model, 5), DROGUE_OK);
    f = usual_field();
    away = poses[0];
    away.yaw_rad_q16 = q16_of(TEST_PI / 2);
    away.pitch_rad_q16 = 0;
    away.position_m_q16[0] = 0;
    ck_assert_int_eq(drogue_inner_disc_image(&disc, &away, &f.camera, &f.model),
                     DROGUE_OK);               /* 2.9 degrees off edge-on */
    away.yaw_rad_q16 = q16_of(TEST_PI * 0.75); /* from behind */
    ck_assert_int_eq(drogue_inner_disc_image(&disc, &away, &f.camera, &f.model), DROGUE_E_DOMAIN);
    away = poses[0];
    away.position_m_q16[2] = INT32_MAX; /* cannot be solved to anywhere else in Q16 */
    (void)drogue_joint_solve(&joint, &away, &outline, &inner, &f.camera, &f.model, 5);
}
END_TEST

/* Angles that are none, of the start and of the ellipse; a solution that leaves the numbers of metres. */
START_TEST(outside_the_domain)
{
    field f = usual_field();
    const pose_real p = {{0.5, 0.2, 5, 0.2, 0.1}};
    drogue_joint_outline outline, turned;
    drogue_real covariance[DROGUE_PACKED_MAX];
    drogue_joint_inner inner;
    drogue_pose poses[2], start;
    drogue_joint joint;
    int side;
    ck_assert(measurement_of(&outline, covariance, &inner, poses, &f, &p));
    start = poses[0];
    for (side = -1; side <= 1; side += 2) {
        start = poses[0];
        start.yaw_rad_q16 = side * (DROGUE_Q16_PI + 1);
        ck_assert_int_eq(drogue_joint_solve(&joint, &start, &outline, &inner, &f.camera, &f.model, 5), DROGUE_E_DOMAIN);
        start = poses[0];
        start.pitch_rad_q16 = side * (DROGUE_Q16_HALF_PI + 1);
        ck_assert_int_eq(drogue_joint_solve(&joint, &start, &outline, &inner, &f.camera, &f.model, 5), DROGUE_E_DOMAIN);
    }
    turned = outline;
    turned.ellipse.angle_rad_q16 = 2 * 65536;
    ck_assert_int_eq(drogue_joint_solve(&joint, &poses[0], &turned, &inner, &f.camera, &f.model, 5), DROGUE_E_DOMAIN);
    f.model.rim_radius_m_q16 =
        2000 * 65536; /* of a drogue 32,850 m away, or as much to the left, from the nearest start */
    f.model.inner_radius_m_q16 = 1000 * 65536;
    f.model.inner_depth_m_q16 = 500 * 65536;
    for (side = 0; side < 2; side++) {
        const pose_real far = {{side ? -32850 : 0, 0, side ? 30000 : 32850, 0.2, 0.1}};
        field wide = f;
        wide.camera = side ? pinhole(500, 500, 1000, 1000) : f.camera;
        ck_assert(measurement_of(&outline, covariance, &inner, poses, &wide, &far) == 0);
        memset(&start, 0, sizeof start);
        start.position_m_q16[0] = q16_of(side ? -32760 : 0);
        start.position_m_q16[2] = q16_of(side ? 30000 : 32760);
        start.yaw_rad_q16 = q16_of(0.2);
        start.pitch_rad_q16 = q16_of(0.1);
        ck_assert_int_eq(drogue_joint_solve(&joint, &start, &outline, &inner, &wide.camera, &wide.model, 5),
                         DROGUE_E_DOMAIN);
        MUST(joint.pose.position_m_q16[side ? 0 : 2] == (side ? DROGUE_Q16_MIN : DROGUE_Q16_MAX), "not saturated");
    }
}
END_TEST

/* A position finer than the finest scale comes to that scale, and stays where it is. */
START_TEST(finest_scale)
{
    int scale;
    for (scale = -12; scale <= 0; scale++) {
        drogue_joint_state s;
        memset(&s, 0, sizeof s);
        s.scale = scale;
        s.position_q30[0] = -(1 << 20);
        s.position_q30[1] = 3 << 19;
        s.position_q30[2] = 1 << 24;
        drogue_joint_rescale(&s);
        MUST(s.scale == (scale - 5 > -8 ? scale - 5 : -8), "scale %d from %d", s.scale, scale);
        MUST(ldexp(s.position_q30[2], s.scale) == ldexp(1 << 24, scale) &&
                 ldexp(s.position_q30[0], s.scale) == ldexp(-(1 << 20), scale) &&
                 ldexp(s.position_q30[1], s.scale) == ldexp(3 << 19, scale),
             "moved from scale %d", scale);
    }
}
END_TEST

/* Image of the inner disc as computed in double. */
START_TEST(image_of_the_inner_disc)
{
    const field f = usual_field();
    uint64_t rng = 10;
    double centre = 0, size = 0, outline = 0;
    int i, k, seen = 0;
    for (i = 0; i < 5000; i++) {
        const pose_real p = random_pose(&rng, 0.5);
        drogue_pose q;
        drogue_ellipse got;
        ellipse_real e;
        memset(&q, 0, sizeof q);
        for (k = 0; k < 3; k++) {
            q.position_m_q16[k] = q16_of(p.v[k]);
        }
        q.yaw_rad_q16 = q16_of(p.v[3]);
        q.pitch_rad_q16 = q16_of(p.v[4]);
        if (!field_inner(&e, &f, &p)) {
            continue;
        }
        MUST(drogue_inner_disc_image(&got, &q, &f.camera, &f.model) == DROGUE_OK, "case %d", i);
        /* the pose was rounded: half an LSB of each coordinate, seen at its distance */
        centre = fmax(centre, hypot(real_of_q16(got.xc_px_q16) - e.xc, real_of_q16(got.yc_px_q16) - e.yc) /
                                  (1 + 1500 / p.v[2]) * 65536);
        size = fmax(size, fmax(fabs(real_of_q16(got.a_px_q16) / e.a - 1), fabs(real_of_q16(got.b_px_q16) / e.b - 1)));
        /* and with its angle: what is off along the outline, as a share */
        outline = fmax(outline, fabs(sin(real_of_q16(got.angle_rad_q16) - e.angle)) * (1 - e.b / e.a));
        seen++;
    }
    ck_assert_int_gt(seen, 4500);
    MUST(centre < 2, "centre off by %g LSB", centre);
    MUST(size < 2e-5, "size off by a share of %g", size);
    MUST(outline < 2e-5, "turned by a share of %g", outline);
}
END_TEST

/* Every pattern of bits is defined; what is accepted is a pose before the camera with a unit axis. */
START_TEST(any_bits)
{
    uint64_t rng = 11;
    int i, k, solved = 0;
    for (i = 0; i < 20000; i++) {
        const pose_real p = random_pose(&rng, 0.5);
        field f = usual_field();
        drogue_joint_outline outline;
        drogue_real covariance[DROGUE_PACKED_MAX];
        drogue_joint_inner inner;
        drogue_pose poses[2], start;
        drogue_joint joint;
        drogue_ellipse disc;
        double axis[3];
        if (!measurement_of(&outline, covariance, &inner, poses, &f, &p)) {
            continue;
        }
        start = poses[i & 1];
        for (k = 0; k < 3; k++) { /* a few members at a time */
            drogue_q16 any = rng_s32_any_width(&rng), positive = any < 0 ? ~any : any;
            switch (rng_range(&rng, 0, 15)) {
            case 0: f.camera.fx_px_q16 = positive | 1; break;
            case 1: f.camera.fy_px_q16 = positive | 1; break;
            case 2: f.camera.cx_px_q16 = any; break;
            case 3: f.camera.cy_px_q16 = any; break;
            case 4: f.model.rim_radius_m_q16 = positive | 1; break;
            case 5: f.model.inner_radius_m_q16 = positive; break;
            case 6: f.model.inner_depth_m_q16 = any; break;
            case 7: inner.x_px_q16 = any; break;
            case 8: inner.y_px_q16 = any; break;
            case 9: inner.std_px_q16 = positive; break;
            case 10: start.position_m_q16[rng_range(&rng, 0, 2)] = any; break;
            case 11: start.yaw_rad_q16 = rng_range(&rng, -205887, 205887); break;
            case 12: start.pitch_rad_q16 = rng_range(&rng, -102944, 102944); break;
            case 13: outline.ellipse.xc_px_q16 = any; break;
            case 14: outline.ellipse.a_px_q16 = positive | 1; break;
            default: covariance[DROGUE_PACKED(k, k)].exponent += rng_range(&rng, -80, 80); break;
            }
        }
        outline.ellipse.b_px_q16 =
            outline.ellipse.b_px_q16 > outline.ellipse.a_px_q16 ? outline.ellipse.a_px_q16 : outline.ellipse.b_px_q16;
        (void)drogue_inner_disc_image(&disc, &start, &f.camera, &f.model);
        if (drogue_joint_outline_weigh(&outline, &outline.ellipse, covariance) == DROGUE_OK &&
            drogue_joint_solve(&joint, &start, &outline, &inner, &f.camera, &f.model, i % 17) == DROGUE_OK) {
            for (k = 0; k < 3; k++) {
                axis[k] = real_of_q16(joint.pose.axis_q16[k]);
            }
            MUST(fabs(dot3(axis, axis) - 1) < 1e-4 && joint.pose.position_m_q16[2] >= 0, "case %d: pose", i);
            for (k = 0; k < 5; k++) {
                MUST(joint.covariance[DROGUE_PACKED(k, k)].mantissa > 0, "case %d: variance %d", i, k);
            }
            solved++;
        }
    }
    ck_assert_int_gt(solved, 1000);
}
END_TEST

SUITE_MAIN("joint", exact_data_gives_the_exact_pose_from_both_starts, outline_alone_stays_where_the_cone_puts_it,
           covariance_against_the_cone, covariance_with_the_inner_part, head_on, what_cannot_be_solved,
           outside_the_domain, finest_scale, image_of_the_inner_disc, any_bits)
