/* SPDX-License-Identifier: Apache-2.0 */
/* The outline as a measurement: its covariance against refits of noisy points. */
#include "suite.h"

#include "../../band_points.h"
#include "drogue/ellipse.h"
#include "drogue/joint.h"
#include "joint_model.h"

enum { POINTS = 960, RUNS = 1200 };

typedef struct noise {
    double each;   /* standard deviation of a point's radial offset, in semi-axes */
    double binned; /* of an offset that the points of a bin share */
    int bins;      /* of the 32, from bin 3 on, hold points */
} noise;

/* An outline and what is stated of it. */
typedef struct stated_outline {
    drogue_ellipse ellipse;
    drogue_real covariance[DROGUE_PACKED_MAX];
} stated_outline;

static drogue_status state(stated_outline *outline, const drogue_support *support, drogue_q16 shading_q16,
                           drogue_q16 blur_px2_q16)
{
    return drogue_joint_outline_covariance(outline->covariance, &outline->ellipse, support, shading_q16, blur_px2_q16);
}

static drogue_status weigh(const stated_outline *outline)
{
    drogue_joint_outline weighed;
    return drogue_joint_outline_weigh(&weighed, &outline->ellipse, outline->covariance);
}

/* Fit noisy points about an ellipse; harmonics of the fit off the truth, and the covariance stated for it. */
static void refit_noisy(double m[5], stated_outline *outline, const ellipse_real *truth, const noise *n, uint64_t *rng)
{
    const drogue_band band = drogue_band_of(q16_of(8), 0);
    drogue_edge edges[POINTS];
    drogue_moments moments;
    drogue_support support;
    drogue_ellipse_frame frame;
    ellipse_real scaled = *truth, fitted;
    double shared = 0;
    uint32_t count = 0, i;
    drogue_moments_clear(&moments);
    for (i = 0; i < POINTS; i++) {
        const double t = 2 * TEST_PI * (i + 0.5) / POINTS;
        double x, y, r;
        if (i % (POINTS / 32) == 0) {
            shared = n->binned * rng_normal(rng);
        }
        if ((i / (POINTS / 32) + 29) % 32 >= (uint32_t)n->bins) {
            continue;
        }
        r = 1 + shared + n->each * rng_normal(rng);
        scaled.a = truth->a * r;
        scaled.b = truth->b * r;
        ellipse_point(&x, &y, &scaled, t);
        edges[count].x_q5 = (uint16_t)floor(32 * x + 0.5);
        edges[count].y_q5 = (uint16_t)floor(32 * y + 0.5);
        edges[count].gx = (int16_t)(500 * cos(t + truth->angle));
        edges[count].gy = (int16_t)(500 * sin(t + truth->angle));
        drogue_moments_add_point(&moments, edges[count].x_q5 - 32768, edges[count].y_q5 - 32768);
        count++;
    }
    MUST(drogue_ellipse_fit(&outline->ellipse, &moments, 5) == DROGUE_OK, "no fit");
    outline->ellipse.xc_px_q16 += 1024 * 65536;
    outline->ellipse.yc_px_q16 += 1024 * 65536;
    fitted = ellipse_from_q16(&outline->ellipse);
    harmonics_of(m, &fitted, truth);
    MUST(drogue_ellipse_frame_of(&frame, &outline->ellipse) == DROGUE_OK, "no frame");
    support_count(&support, &frame, &band, edges, count, 1);
    drogue_support_judge(&support, &outline->ellipse, DROGUE_POLARITY_BOTH, 1);
    MUST(support.bright_bins == 0, "polarity");
    memset(&support, 0, sizeof support);
    support.axis_rad_q16 = outline->ellipse.angle_rad_q16;
    for (i = 0; i < count; i++) {
        band_point p;
        MUST(point_holds(&p, &frame, &band, &edges[i]) && point_add(&support, &p, &edges[i]), "point %u left out",
             (unsigned)i);
    }
    MUST(state(outline, &support, 1, 0) == DROGUE_OK, "no covariance");
}

static void check_scatter(const noise *n, double tolerance)
{
    /* an angle well away from its ends: the stated frame is the fitted one's */
    const ellipse_real truth = {1021.3, 1024.7, 700, 520, 0.5};
    double scatter[5][5], stated[5][5];
    uint64_t rng = 5;
    int run, i, j;
    memset(scatter, 0, sizeof scatter);
    memset(stated, 0, sizeof stated);
    for (run = 0; run < RUNS; run++) {
        stated_outline outline;
        double m[5];
        refit_noisy(m, &outline, &truth, n, &rng);
        for (i = 0; i < 5; i++) {
            for (j = 0; j < 5; j++) {
                scatter[i][j] += m[i] * m[j] / RUNS;
                stated[i][j] += (double)quad_of(outline.covariance[DROGUE_PACKED(i, j)]) / RUNS;
            }
        }
    }
    for (i = 0; i < 5; i++) {
        for (j = 0; j < 5; j++) {
            double off = (stated[i][j] - scatter[i][j]) / sqrt(scatter[i][i] * scatter[j][j]);
            MUST(fabs(off) < tolerance, "%d bins, noise %g and %g: entry %d %d: %g stated, %g found", n->bins, n->each,
                 n->binned, i, j, stated[i][j], scatter[i][j]);
        }
    }
}

/* Variances over 1200 runs are known to 4 %: 3.5 of these. */
START_TEST(covariance_of_independent_noise)
{
    const noise n = {0.002, 0, 32};
    check_scatter(&n, 0.14);
}
END_TEST

START_TEST(covariance_of_noise_shared_within_bins)
{
    const noise n = {0.0005, 0.001, 32};
    check_scatter(&n, 0.14);
}
END_TEST

START_TEST(covariance_of_a_partial_outline)
{
    const noise n = {0.0005, 0.0003, 20};
    check_scatter(&n, 0.14);
}
END_TEST

/* 'bins' bins from the first on, 20 points each, offsets of +-1/1000. */
static drogue_support support_of(uint32_t bins)
{
    drogue_support s;
    uint32_t k;
    memset(&s, 0, sizeof s);
    for (k = 0; k < bins; k++) {
        s.bin[k].count[0] = 20;
        s.bin[k].sum_q16 = (k & 1 ? 1 : -1) * 20 * 66;
        s.points += 20;
        s.gradient += 20 * 600;
        s.squares_q32 += 20 * 66 * 66;
    }
    return s;
}

START_TEST(shading_and_blur_are_added)
{
    const drogue_support s = support_of(32);
    stated_outline base = {{0, 0, 100 * 65536, 80 * 65536, 0}, {{0, 0}}}, more = base;
    double plain[15], share = 2.0 / 600 / 100, blur = 0.5 / (100 * 80), grid = 0.3 / (100 * 80);
    int i, j;
    ck_assert_int_eq(state(&base, &s, 0, 0), DROGUE_OK);
    for (i = 0; i < DROGUE_PACKED_MAX; i++) {
        plain[i] = (double)quad_of(base.covariance[i]);
    }
    /* a mean of 20 points of +-66 LSB each: m0 is known to 66 / sqrt(32) LSB, or 32 / 27 of that in variance */
    ck_assert(fabs(plain[0] - pow(66.0 / 65536, 2) / 27 - grid * grid) < 1e-6 * plain[0]);
    ck_assert_int_eq(state(&more, &s, 2 * 65536, 32768), DROGUE_OK);
    for (i = 0; i < 5; i++) {
        for (j = 0; j <= i; j++) {
            double added = (i == j ? share * share : 0) + (i == 0 ? blur * blur : 0);
            double got = (double)quad_of(more.covariance[DROGUE_PACKED(i, j)]) - plain[DROGUE_PACKED(i, j)];
            MUST(fabs(got - added) < 1e-9 * plain[0], "entry %d %d: %g added, not %g", i, j, got, added);
        }
    }
}
END_TEST

START_TEST(smear_is_doubt_across_two_sides)
{
    const double a = 100, b = 90, v = 4, angle = 0.6,
                 axis = -0.25; /* of the motion from the major axis; of that from +x */
    const double c = v * cos(2 * angle), d = v * sin(2 * angle);
    const double share = 3.0 / 1024 / (a * b), along[5] = {v, 0, 0, c, d};
    drogue_support s = support_of(32);
    stated_outline base = {{0, 0, 100 * 65536, 90 * 65536, -16384}, {{0, 0}}}, more = base;
    int i, j;
    ck_assert_int_eq(state(&base, &s, 0, 0), DROGUE_OK);
    s.smear_px2_q16[0] = q16_of(v * cos(2 * (angle + axis)));
    s.smear_px2_q16[1] = q16_of(v * sin(2 * (angle + axis)));
    ck_assert_int_eq(state(&more, &s, 0, 0), DROGUE_OK);
    for (i = 0; i < 5; i++) {
        for (j = 0; j <= i; j++) {
            const int k = DROGUE_PACKED(i, j);
            const double got = (double)quad_of(more.covariance[k]) - (double)quad_of(base.covariance[k]);
            double added = share * along[i] * along[j];
            if (i == 1 || i == 2) { /* cos^2, cos sin, sin^2 of the angle itself */
                const double side[3] = {0, cos(angle), sin(angle)};
                added = share * 4 * v * v * side[i] * side[j];
            }
            MUST(fabs(got - added) < 1e-4 * share * v * v, "entry %d %d: %g added, not %g", i, j, got, added);
        }
    }
}
END_TEST

/* Any smear leaves the covariance positive, beside hardly anything else. */
START_TEST(smear_of_any_size_and_direction)
{
    uint64_t rng = 9;
    int i;
    for (i = 0; i < 3000; i++) {
        stated_outline outline = {{0, 0, 100 * 65536, 80 * 65536, 0}, {{0, 0}}};
        drogue_support s = support_of(32);
        const double most = i % 3 == 0 ? 40 : i % 3 == 1 ? 10 : 1;
        uint32_t k;
        for (k = 0; k < DROGUE_SUPPORT_BINS; k++) { /* 1/65536 of a semi-axis */
            s.bin[k].sum_q16 = k & 1 ? 20 : -20;
        }
        s.smear_px2_q16[0] = q16_of(rng_real(&rng, -most, most));
        s.smear_px2_q16[1] = q16_of(rng_real(&rng, -most, most));
        outline.ellipse.angle_rad_q16 = q16_of(rng_real(&rng, -1.5, 1.5));
        MUST(state(&outline, &s, 65536, 7864) == DROGUE_OK && weigh(&outline) == DROGUE_OK, "case %d: %d %d at %d", i,
             s.smear_px2_q16[0], s.smear_px2_q16[1], outline.ellipse.angle_rad_q16);
    }
}
END_TEST

START_TEST(hostile_smear)
{
    static const int32_t ends[] = {INT32_MIN, INT32_MIN + 1, -1, 0, 1, INT32_MAX};
    int i, j;
    for (i = 0; i < 6; i++) {
        for (j = 0; j < 6; j++) { /* as 48 px^2: no overflow, and what is said is said */
            stated_outline outline = {{0, 0, 100 * 65536, 80 * 65536, 90000}, {{0, 0}}};
            drogue_support s = support_of(32);
            s.smear_px2_q16[0] = ends[i];
            s.smear_px2_q16[1] = ends[j];
            ck_assert_int_eq(state(&outline, &s, 65536, 7864), DROGUE_OK);
            ck_assert_int_eq(weigh(&outline), DROGUE_OK);
        }
    }
}
END_TEST

/* What was put back turned the outline: its covariance is that of bins that count from where its axis is now. */
START_TEST(bins_count_from_their_axis)
{
    static const drogue_q16 from[2] = {0, 90000};
    int turn, i, k;
    for (turn = -15; turn <= 15; turn++) {
        stated_outline outline = {{0, 0, 100 * 65536, 95 * 65536, 0}, {{0, 0}}}, as_counted = outline;
        drogue_support s = support_of(20), turned = s;
        s.bright_bins = turned.bright_bins = 0x000F000Fu;
        for (k = 0; k < 32; k++) {
            s.bin[k].count[1] = s.bin[k].count[0] + (uint32_t)k;
            s.bin[k].sum_q16 += 1000 * (k % 3);
        }
        s.axis_rad_q16 = turn < -7 || turn > 7 ? (turn < 0 ? from[1] : -from[1]) : from[0];
        outline.ellipse.angle_rad_q16 = s.axis_rad_q16 + (drogue_q16)lround(turn * 65536 * TEST_PI / 16);
        turned = s;
        turned.bright_bins = 0;
        for (k = 0; k < 32; k++) {
            turned.bin[k] = s.bin[(k + turn) & 31];
            turned.bright_bins |= (s.bright_bins >> ((k + turn) & 31) & 1u) << k;
        }
        turned.axis_rad_q16 = as_counted.ellipse.angle_rad_q16 = outline.ellipse.angle_rad_q16;
        ck_assert_int_eq(state(&outline, &s, 65536, 0), DROGUE_OK);
        ck_assert_int_eq(state(&as_counted, &turned, 65536, 0), DROGUE_OK);
        for (i = 0; i < DROGUE_PACKED_MAX; i++) {
            const double own = (double)quad_of(outline.covariance[i]),
                         other = (double)quad_of(as_counted.covariance[i]);
            MUST(fabs(own - other) < 1e-6 * (double)quad_of(outline.covariance[0]), "%d bins: entry %d: %g, %g", turn,
                 i, own, other);
        }
    }
}
END_TEST

START_TEST(degenerate_support)
{
    stated_outline outline = {{0, 0, 100 * 65536, 80 * 65536, 0}, {{0, 0}}};
    drogue_support s;
    uint32_t k;
    for (k = 0; k <= 5; k++) {
        s = support_of(k);
        ck_assert_int_eq(state(&outline, &s, 65536, 0), DROGUE_E_DEGENERATE);
    }
    s = support_of(32);
    ck_assert_int_eq(state(&outline, &s, 65536, 0), DROGUE_OK);
    s.gradient = 0;
    ck_assert_int_eq(state(&outline, &s, 65536, 0), DROGUE_E_DEGENERATE);
    s = support_of(32);
    s.bright_bins = UINT32_MAX; /* the points are of the other polarity */
    ck_assert_int_eq(state(&outline, &s, 65536, 0), DROGUE_E_DEGENERATE);
    { /* six bins side by side, nearly all points in one: too little for five parameters, and the covariance says so */
        static const uint32_t count[6] = {2120, 9334, 69, 6, 29922, 3};
        memset(&s, 0, sizeof s);
        s.gradient = 1000;
        for (k = 0; k < 6; k++) {
            s.bin[9 + k].count[0] = count[k];
            s.bin[9 + k].sum_q16 = (k & 1 ? -66 : 66) * (int32_t)count[k];
        }
        ck_assert_int_eq(state(&outline, &s, 65536, 0), DROGUE_OK);
        ck_assert(quad_of(outline.covariance[0]) > 100);
    }
    s = support_of(6); /* the most points that one bin's sum can hold, all at the end of their range */
    for (k = 0; k < 6; k++) {
        s.bin[5 * k].count[0] = 1u << 15;
        s.bin[5 * k].sum_q16 = k & 1 ? -(1 << 30) : 1 << 30;
    }
    s.gradient = UINT32_MAX;
    ck_assert_int_eq(state(&outline, &s, INT32_MAX, INT32_MAX), DROGUE_OK);
    ck_assert_int_eq(weigh(&outline), DROGUE_OK);
    ck_assert(outline.covariance[0].mantissa > 0);
}
END_TEST

SUITE_MAIN("joint_outline", covariance_of_independent_noise, covariance_of_noise_shared_within_bins,
           covariance_of_a_partial_outline, shading_and_blur_are_added, bins_count_from_their_axis,
           smear_is_doubt_across_two_sides, smear_of_any_size_and_direction, hostile_smear, degenerate_support)
