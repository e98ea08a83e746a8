/* SPDX-License-Identifier: Apache-2.0 */
/* The choice between the two poses, on outlines and inner parts whose truth is known. */
#include "suite.h"

#include "drogue/config.h"
#include "drogue/decide.h"
#include "joint_model.h"

typedef struct seen {
    drogue_decision result;
    drogue_support support;
    drogue_evidence evidence;
    double outline_px; /* semi-axis */
} seen;

/* What a pose shows: points all round, each 0.1 px off, each bin by up to 0.02. */
static int look_at(seen *s, const field *f, const pose_real *p, uint64_t *rng)
{
    ellipse_real outline, inner;
    int k;
    if (!field_outline(&outline, f, p) || !field_inner(&inner, f, p)) {
        return 0;
    }
    memset(s, 0, sizeof *s);
    s->outline_px = outline.a;
    s->evidence.ideal = ellipse_to_q16(&outline);
    s->support.points = 32 * DROGUE_SUPPORT_BINS;
    s->support.gradient = UINT64_C(400) * s->support.points;
    s->support.squares_q32 = (int64_t)(s->support.points * pow(0.1 / outline.a * 65536, 2));
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        s->support.bin[k].count[0] = 32;
        s->support.bin[k].sum_q16 = (int32_t)(32 * 65536 * rng_real(rng, -0.02, 0.02) / outline.a);
    }
    s->evidence.inner.x_px_q16 = q16_of(inner.xc);
    s->evidence.inner.y_px_q16 = q16_of(inner.yc);
    s->evidence.inner.std_px_q16 = q16_of(0.05);
    return drogue_pose_from_ellipse(s->evidence.poses, &s->evidence.ideal, &f->camera, f->model.rim_radius_m_q16) ==
           DROGUE_OK;
}

static drogue_status decide(seen *s, const field *f, uint32_t nearer, const drogue_joint_inner *inner)
{
    drogue_evidence evidence;
    drogue_config config;
    drogue_config_default(&config);
    s->evidence.nearer = nearer;
    s->evidence.support = &s->support;
    evidence = s->evidence;
    evidence.inner = *inner;
    return drogue_decide(&s->result, &evidence, &(drogue_setup){&f->camera, &f->model, &config});
}

/* Between two axes, rad. */
static double apart(const drogue_q16 *a, const drogue_q16 *b)
{
    double sum = 0;
    int k;
    for (k = 0; k < 3; k++) {
        sum += pow(real_of_q16(a[k]) - real_of_q16(b[k]), 2);
    }
    return sqrt(sum);
}

/* The joint pose has its axis from its angles: that may be 2 LSB. */
static int same(const drogue_pose *p, const drogue_pose *q)
{
    return memcmp(p->position_m_q16, q->position_m_q16, sizeof p->position_m_q16) == 0 &&
           p->yaw_rad_q16 == q->yaw_rad_q16 && p->pitch_rad_q16 == q->pitch_rad_q16 &&
           apart(p->axis_q16, q->axis_q16) * 65536 <= 2;
}

/* Straight ahead at 6 m. */
static void look_ahead(seen *s, const field *f, double yaw, double pitch)
{
    const pose_real p = {{0, 0, 6, yaw, pitch}};
    uint64_t rng = 12;
    ck_assert(look_at(s, f, &p, &rng));
}

/* Whichever pose it is told to be the nearer one, the right one wins; told right, it hands on the other one. */
START_TEST(the_right_pose_from_both_sides)
{
    const field f = usual_field();
    uint64_t rng = 11;
    int i, solved = 0;
    for (i = 0; i < 400; i++) {
        const pose_real p = random_pose(&rng, 0.4);
        seen s;
        uint32_t nearer;
        if (p.v[2] > 8 || !look_at(&s, &f, &p, &rng) ||
            apart(s.evidence.poses[0].axis_q16, s.evidence.poses[1].axis_q16) < 0.3) {
            continue;
        }
        for (nearer = 0; nearer < 2; nearer++) {
            uint32_t right;
            MUST(decide(&s, &f, nearer, &s.evidence.inner) == DROGUE_OK, "case %d refused", i);
            MUST(s.result.orientation_resolved, "case %d from %u: not resolved", i, (unsigned)nearer);
            MUST(pose_error_lsb(&s.result.pose, &p) < 3000, "case %d from %u: %g LSB off", i, (unsigned)nearer,
                 pose_error_lsb(&s.result.pose, &p));
            right = apart(s.result.pose.axis_q16, s.evidence.poses[1].axis_q16) <
                    apart(s.result.pose.axis_q16, s.evidence.poses[0].axis_q16);
            MUST(nearer != right ||
                     memcmp(&s.result.alternative, &s.evidence.poses[1 - right], sizeof s.evidence.poses[0]) == 0,
                 "case %d: alternative", i);
        }
        solved++;
    }
    ck_assert_int_gt(solved, 60);
}
END_TEST

/* Without an inner part: the outline's pose that was asked for, unresolved. */
START_TEST(outline_alone)
{
    const field f = usual_field();
    const drogue_joint_inner none = {0, 0, 0};
    seen s;
    uint32_t nearer;
    look_ahead(&s, &f, 0.25, -0.1);
    for (nearer = 0; nearer < 2; nearer++) {
        ck_assert_int_eq(decide(&s, &f, nearer, &none), DROGUE_OK);
        ck_assert(!s.result.orientation_resolved);
        ck_assert(same(&s.result.pose, &s.evidence.poses[nearer]));
        ck_assert_mem_eq(&s.result.alternative, &s.evidence.poses[1 - nearer], sizeof s.result.alternative);
        ck_assert_int_gt(s.result.position_std_m_q32[2], 0);
        ck_assert_int_gt(s.result.axis_std_rad_q32, 0);
    }
}
END_TEST

/* An inner part where neither pose can have it contradicts the outline: the outline alone is believed. */
START_TEST(contradiction)
{
    const field f = usual_field();
    seen s;
    drogue_joint_inner moved;
    look_ahead(&s, &f, 0.25, -0.1);
    ck_assert_int_eq(decide(&s, &f, 0, &s.evidence.inner), DROGUE_OK);
    ck_assert(s.result.orientation_resolved);
    moved = s.evidence.inner; /* across the line on which both poses have it, so that no tilt explains it */
    moved.x_px_q16 += q16_of(0.3 * s.outline_px);
    moved.y_px_q16 += q16_of(0.75 * s.outline_px);
    ck_assert_int_eq(decide(&s, &f, 1, &moved), DROGUE_OK);
    ck_assert(!s.result.orientation_resolved);
    ck_assert(same(&s.result.pose, &s.evidence.poses[1]));
    ck_assert_mem_eq(&s.result.alternative, &s.evidence.poses[0], sizeof s.result.alternative);
}
END_TEST

/* An inner part farther off than it can be by what is known, where the other pose would have it many times farther off:
 * outline and inner part are both wrong by more than they say, which the covariance takes on, and which pose it is stays
 * clear. */
START_TEST(a_clear_choice_for_all_disagreement)
{
    const field f = usual_field();
    seen s;
    drogue_joint_inner moved;
    double agreed;
    uint32_t near, nearer;
    int i;
    look_ahead(&s, &f, 0.4, -0.3);
    ck_assert_int_eq(decide(&s, &f, 0, &s.evidence.inner), DROGUE_OK);
    agreed = (double)s.result.covariance_q48[2][2];
    near = apart(s.result.pose.axis_q16, s.evidence.poses[0].axis_q16) <
                   apart(s.result.pose.axis_q16, s.evidence.poses[1].axis_q16)
               ? 0
               : 1;
    moved = s.evidence.inner;
    for (i = 1; i <= 4; i++) { /* across the line on which both poses have it: chi2 from about 60 to 1000 */
        moved.x_px_q16 += q16_of(0.0025 * s.outline_px);
        moved.y_px_q16 += q16_of(0.0033 * s.outline_px);
        for (nearer = 0; nearer < 2; nearer++) {
            double wider;
            ck_assert_int_eq(decide(&s, &f, nearer, &moved), DROGUE_OK);
            wider = (double)s.result.covariance_q48[2][2] / agreed;
            MUST(s.result.orientation_resolved, "%d from %u", i, (unsigned)nearer);
            MUST(apart(s.result.pose.axis_q16, s.evidence.poses[near].axis_q16) < 0.05, "%d from %u: %g off", i,
                 (unsigned)nearer, apart(s.result.pose.axis_q16, s.evidence.poses[near].axis_q16));
            MUST(wider > 16, "%d: %g", i, wider);
            ck_assert_int_eq(s.result.doubt_q16, DROGUE_Q16(1, 64));
        }
    }
}
END_TEST

/* An inner part off by more than it should be makes all variances chi2 times as large, one that contradicts the outline the
 * outline's max_chi2 times, and the distance 1.1 %; without one the outline's size and shape are known to 1.1 %. */
START_TEST(disagreement_widens)
{
    const field f = usual_field();
    const drogue_joint_inner none = {0, 0, 0};
    seen s;
    drogue_joint_inner moved;
    double agreed, alone, axis, wider[3];
    int i;
    look_ahead(&s, &f, 0.25, -0.1);
    ck_assert_int_eq(decide(&s, &f, 0, &s.evidence.inner), DROGUE_OK);
    agreed = (double)s.result.covariance_q48[2][2];
    moved = s.evidence.inner;
    for (i = 0; i < 3; i++) { /* across the line on which both poses have it, farther each time */
        moved.x_px_q16 += q16_of(i == 0 ? 0.06 : 0.01);
        moved.y_px_q16 += q16_of(i == 0 ? 0.15 : 0.025);
        ck_assert_int_eq(decide(&s, &f, 0, &moved), DROGUE_OK);
        ck_assert(s.result.orientation_resolved);
        wider[i] = (double)s.result.covariance_q48[2][2] / agreed;
    }
    MUST(wider[0] > 3, "%g", wider[0]); /* by the square of how far it is off */
    MUST(fabs(wider[1] / wider[0] - 49 / 36.0) < 0.02 && fabs(wider[2] / wider[0] - 64 / 36.0) < 0.02, "%g, %g, %g",
         wider[0], wider[1], wider[2]);
    ck_assert_int_eq(decide(&s, &f, 0, &none), DROGUE_OK);
    alone = (double)s.result.covariance_q48[2][2];
    axis = (double)s.result.axis_std_rad_q32 / 0x1p32;
    MUST(fabs(sqrt(alone) / 0x1p24 / 6 - 0.0156) < 0.001, "%g of the distance", sqrt(alone) / 0x1p24 / 6); /* by both */
    MUST(axis > 0.1, "%g rad", axis); /* 1 - b / a of a tilt of 0.27 is 0.036, known to about 0.02 */
    moved.y_px_q16 += q16_of(0.75 * s.outline_px);
    ck_assert_int_eq(decide(&s, &f, 0, &moved), DROGUE_OK);
    ck_assert(!s.result.orientation_resolved);
    axis /= (double)s.result.axis_std_rad_q32 / 0x1p32;
    MUST(axis > 1, "%g times", axis); /* the twins' distance is in both */
    MUST(fabs(sqrt((double)s.result.covariance_q48[2][2]) / 0x1p24 / 6 - 0.0115) < 0.001, "%g of the distance",
         sqrt((double)s.result.covariance_q48[2][2]) / 0x1p24 / 6);
}
END_TEST

/* An inner part of another size may be that of a larger outline: half the square of that share of the whole position. */
START_TEST(size_in_doubt)
{
    const field f = usual_field();
    seen s;
    int64_t before[3];
    int k;
    look_ahead(&s, &f, 0.25, -0.1);
    ck_assert_int_eq(decide(&s, &f, 0, &s.evidence.inner), DROGUE_OK);
    for (k = 0; k < 3; k++) {
        before[k] = s.result.covariance_q48[k][k];
    }
    s.evidence.doubt_q16 = q16_of(0.05);
    ck_assert_int_eq(decide(&s, &f, 0, &s.evidence.inner), DROGUE_OK);
    for (k = 0; k < 3; k++) {
        const double at = real_of_q16(s.result.pose.position_m_q16[k]);
        const double more = (double)(s.result.covariance_q48[k][k] - before[k]) / 0x1p48;
        MUST(fabs(more - pow(at * 0.05, 2) / 2) < 1e-4, "%d: %g", k, more);
    }
}
END_TEST

/* The inner part lies beside the line on which both poses have it. */
static void off_its_place(seen *s, double px)
{
    s->evidence.inner.x_px_q16 += q16_of(0.37 * px);
    s->evidence.inner.y_px_q16 += q16_of(0.93 * px);
}

/* Of an outline that is too far both poses come nearer by that share, in whatever way they differ; so much is in doubt
 * at least. */
START_TEST(too_far)
{
    static const double share = 0.03;
    const field f = usual_field();
    seen s;
    drogue_decision before;
    int k;
    int i;
    look_ahead(&s, &f, 0.25, -0.1);
    off_its_place(&s, 0.2);
    ck_assert_int_eq(decide(&s, &f, 0, &s.evidence.inner), DROGUE_OK);
    before = s.result;
    s.evidence.too_far_q16 = q16_of(share);
    for (i = 0; i < 2; i++) {
        s.evidence.doubt_q16 = q16_of(i * 0.05);
        ck_assert_int_eq(decide(&s, &f, 0, &s.evidence.inner), DROGUE_OK);
        ck_assert_int_eq(s.result.doubt_q16, q16_of(i > 0 ? 0.05 : share));
        for (k = 0; k < 3; k++) {
            const double at = real_of_q16(s.result.pose.position_m_q16[k]);
            const double more = (double)(s.result.covariance_q48[k][k] - before.covariance_q48[k][k]) / 0x1p48;
            MUST(fabs(at - (1 - share) * real_of_q16(before.pose.position_m_q16[k])) < 0x1p-14, "%d: %g", k, at);
            MUST(fabs(real_of_q16(s.result.alternative.position_m_q16[k]) -
                      (1 - share) * real_of_q16(before.alternative.position_m_q16[k])) < 0x1p-14,
                 "other %d", k);
            MUST(fabs(more - pow(at * (i > 0 ? 0.05 : share), 2) / 2) < 1e-4, "%d: %g", k, more);
        }
        ck_assert(memcmp(s.result.pose.axis_q16, before.pose.axis_q16, sizeof before.pose.axis_q16) == 0);
    }
}
END_TEST

/* By no more than noise the inner part is off its place up to a chi2 of 1; from 3 on all counts. */
START_TEST(not_too_far_by_noise)
{
    const field f = usual_field();
    const double share = 0.04;
    double last = 0;
    seen s;
    int i;
    for (i = 0; i <= 12; i++) {
        drogue_decision before;
        double moved;
        look_ahead(&s, &f, 0.25, -0.1);
        off_its_place(&s, 0.02 * i);
        ck_assert_int_eq(decide(&s, &f, 0, &s.evidence.inner), DROGUE_OK);
        before = s.result;
        s.evidence.too_far_q16 = q16_of(share);
        ck_assert_int_eq(decide(&s, &f, 0, &s.evidence.inner), DROGUE_OK);
        moved = 1 - (double)s.result.pose.position_m_q16[2] / before.pose.position_m_q16[2];
        MUST(i > 2 ? moved >= last : fabs(moved) < 1e-6, "%d: %g", i, moved);
        MUST(i < 12 || fabs(moved - share) < 1e-4, "%d: %g", i, moved);
        last = moved;
    }
}
END_TEST

/* Smeared by motion the disc's edge says less of the outline, and nothing from 1.25 px^2 on; nor does none. */
START_TEST(not_too_far_where_smeared)
{
    static const double smear[][3] = {{0.2, -0.1, 1}, {0.6, 0.45, 0.5}, {-0.75, 1.0, 0}, {3, 0, 0}};
    const field f = usual_field();
    const double share = 0.04;
    seen s;
    size_t i;
    look_ahead(&s, &f, 0.25, -0.1);
    off_its_place(&s, 0.45);
    for (i = 0; i < sizeof smear / sizeof smear[0]; i++) {
        drogue_decision before;
        s.support.smear_px2_q16[0] = q16_of(smear[i][0]);
        s.support.smear_px2_q16[1] = q16_of(smear[i][1]);
        s.evidence.too_far_q16 = 0;
        ck_assert_int_eq(decide(&s, &f, 0, &s.evidence.inner), DROGUE_OK);
        before = s.result;
        s.evidence.too_far_q16 = q16_of(share);
        ck_assert_int_eq(decide(&s, &f, 0, &s.evidence.inner), DROGUE_OK);
        MUST(fabs(real_of_q16(s.result.pose.position_m_q16[2]) -
                  (1 - share * smear[i][2]) * real_of_q16(before.pose.position_m_q16[2])) < 0x1p-12,
             "%g px^2", hypot(smear[i][0], smear[i][1]));
        ck_assert_int_eq(s.result.doubt_q16, q16_of(share * smear[i][2]));
    }
    memset(s.support.smear_px2_q16, 0, sizeof s.support.smear_px2_q16);
    s.evidence.too_far_q16 = 0;
    ck_assert_int_eq(decide(&s, &f, 0, &(drogue_joint_inner){0, 0, 0}), DROGUE_OK);
    {
        const drogue_decision before = s.result;
        s.evidence.too_far_q16 = q16_of(share);
        ck_assert_int_eq(decide(&s, &f, 0, &(drogue_joint_inner){0, 0, 0}), DROGUE_OK);
        ck_assert(memcmp(&s.result, &before, sizeof before) == 0);
    }
}
END_TEST

/* Head-on the two poses are one: nothing to choose, and so nothing open. */
START_TEST(head_on)
{
    const field f = usual_field();
    seen s;
    look_ahead(&s, &f, 0, 0);
    ck_assert_int_eq(decide(&s, &f, 0, &s.evidence.inner), DROGUE_OK);
    ck_assert(s.result.orientation_resolved);
}
END_TEST

/* A support of too few bins says nothing about the outline's errors. */
/* Variances beyond Q48 shift all entries: the same correlations as in a tenth of the unit, and the true deviations. */
START_TEST(large_variances_keep_the_correlations)
{
    field f = usual_field();
    const drogue_joint_inner none = {0, 0, 0};
    double correlation[2][10], std[2];
    int k;
    for (k = 0; k < 2; k++) {
        const double metres = k == 0 ? 1 : 10;
        const pose_real p = {{300 * metres, 200 * metres, 1500 * metres, 0.3, -0.2}};
        uint64_t rng = 3;
        seen s;
        int i, j, n = 0;
        f.model.rim_radius_m_q16 = q16_of(2.3 * metres);
        f.model.inner_radius_m_q16 = q16_of(0.8 * metres);
        f.model.inner_depth_m_q16 = q16_of(metres);
        ck_assert(look_at(&s, &f, &p, &rng));
        ck_assert_int_eq(decide(&s, &f, 0, &none), DROGUE_OK);
        for (i = 0; i < 5; i++) {
            for (j = 0; j < i; j++) {
                correlation[k][n++] =
                    (double)s.result.covariance_q48[i][j] /
                    sqrt((double)s.result.covariance_q48[i][i] * (double)s.result.covariance_q48[j][j]);
            }
        }
        for (i = 0; i < 3; i++) { /* the entries say how often they are halved */
            const double variance = ldexp((double)s.result.covariance_q48[i][i], s.result.covariance_halved - 48);
            ck_assert_double_eq_tol(sqrt(variance), (double)s.result.position_std_m_q32[i] / 0x1p32,
                                    1e-6 * sqrt(variance));
        }
        ck_assert(k == 0 || s.result.covariance_halved > 0);
        std[k] = (double)s.result.position_std_m_q32[2] / 4294967296.0;
        ck_assert(k == 0 || std[k] > 1000);
    }
    ck_assert_double_eq_tol(std[1], 10 * std[0], 0.05 * std[1]);
    for (k = 0; k < 10; k++) {
        ck_assert_double_eq_tol(correlation[0][k], correlation[1][k], 0.02);
    }
}
END_TEST

START_TEST(no_covariance)
{
    const field f = usual_field();
    seen s;
    look_ahead(&s, &f, 0.25, -0.1);
    memset(&s.support, 0, sizeof s.support);
    ck_assert_int_eq(decide(&s, &f, 0, &s.evidence.inner), DROGUE_E_DOMAIN);
}
END_TEST

/* A rim of some units of the last place, so near that its distance may round to 0: then there is no pose. */
START_TEST(nearer_than_numbers_go)
{
    uint64_t rng = 13;
    field f = usual_field();
    int i, given = 0;
    for (i = 0; i < 20000; i++) {
        const double rim = rng_range(&rng, 1, 3);
        const pose_real p = {{rng_real(&rng, -0.3, 0.3) * rim / 65536, 0, rng_real(&rng, 0.5, 1.5) * rim / 65536,
                              rng_real(&rng, -0.5, 0.5), rng_real(&rng, -0.5, 0.5)}};
        seen s;
        f.model.rim_radius_m_q16 = (drogue_q16)rim;
        f.model.inner_radius_m_q16 = 1;
        f.model.inner_depth_m_q16 = rng_range(&rng, 0, 1);
        if (!look_at(&s, &f, &p, &rng)) {
            continue;
        }
        s.evidence.inner.x_px_q16 += rng_range(&rng, -300 * 65536, 300 * 65536);
        s.evidence.inner.std_px_q16 = rng_range(&rng, 1, 8 * 65536);
        s.evidence.too_far_q16 = rng_range(&rng, 0, 65535);
        if (decide(&s, &f, 0, &s.evidence.inner) == DROGUE_OK) {
            MUST(s.result.pose.position_m_q16[2] > 0, "case %d", i);
            given++;
        }
    }
    ck_assert_int_gt(given, 1000);
}
END_TEST

/* Farther away than numbers go: from the nearer start at once, from the other one after its first step. The outline's
 * own pose stands, and nothing is decided. */
START_TEST(solutions_that_leave_the_numbers)
{
    const pose_real far = {{0, 0, 33500, 0.2, 0.1}};
    uint64_t rng = 12;
    field f = usual_field();
    drogue_joint_outline outline;
    drogue_real covariance[DROGUE_PACKED_MAX];
    drogue_joint joint;
    seen s;
    int k;
    f.model.rim_radius_m_q16 = 2000 * 65536;
    f.model.inner_radius_m_q16 = 1000 * 65536;
    f.model.inner_depth_m_q16 = 500 * 65536;
    ck_assert_int_eq(look_at(&s, &f, &far, &rng), 0); /* no pose of it: */
    for (k = 0; k < 2; k++) {
        s.evidence.poses[k].position_m_q16[2] = (k == 0 ? 32760 : 20000) * 65536;
        s.evidence.poses[k].yaw_rad_q16 = q16_of(0.2);
        s.evidence.poses[k].pitch_rad_q16 = q16_of(0.1);
    }
    ck_assert_int_eq(drogue_joint_outline_covariance(covariance, &s.evidence.ideal, &s.support, 0, 0), DROGUE_OK);
    ck_assert_int_eq(drogue_joint_outline_weigh(&outline, &s.evidence.ideal, covariance), DROGUE_OK);
    for (k = 1; k <= 5; k += 4) {
        MUST((drogue_joint_solve(&joint, &s.evidence.poses[1], &outline, &s.evidence.inner, &f.camera, &f.model, k) ==
              DROGUE_OK) == (k == 1),
             "%d steps", k);
    }
    ck_assert_int_eq(decide(&s, &f, 0, &s.evidence.inner), DROGUE_OK);
    ck_assert_int_eq(s.result.orientation_resolved, 0);
    ck_assert_int_le(abs(s.result.pose.position_m_q16[2] - 32760 * 65536), 1);
}
END_TEST

SUITE_MAIN("decide", the_right_pose_from_both_sides, outline_alone, contradiction, a_clear_choice_for_all_disagreement,
           disagreement_widens, size_in_doubt, too_far, not_too_far_by_noise, not_too_far_where_smeared, head_on,
           large_variances_keep_the_correlations, no_covariance, solutions_that_leave_the_numbers,
           nearer_than_numbers_go)
