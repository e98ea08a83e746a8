/* SPDX-License-Identifier: Apache-2.0 */
/* Motion blur from the outline's edge: slopes and widths of known form, and discs smeared along a line. */
#include "suite.h"

#include "../../../src/outline/slopes.h"
#include "drogue/outline.h"

enum { SIDE = 110, MIDDLE = DROGUE_SLOPE_MIDDLE };

static const double front2 = 4 / 3.0; /* px^2: the front end's blur */

/* Slopes of an edge of variance 'blur2' convolved with a box, 'at' half pixels outwards; and with the front end's blur. */
static void edge(int32_t slope[DROGUE_SLOPES], int32_t seen[DROGUE_SLOPES], double blur2, double box, double at,
                 double rise)
{
    int i;
    for (i = 0; i < DROGUE_SLOPES; i++) {
        const double x = (i - MIDDLE - at) / 2, s = sqrt(2 * blur2), f = sqrt(2 * (blur2 + front2));
        const double own = (erf((x + box / 2) / s) - erf((x - box / 2) / s)) / (2 * box);
        const double blurred = (erf((x + box / 2) / f) - erf((x - box / 2) / f)) / (2 * box);
        slope[i] = (int32_t)lround(rise * own);
        seen[i] = (int32_t)lround(rise * DROGUE_SLOPE_GAIN * blurred);
    }
}

START_TEST(variance_of_known_edges)
{
    int32_t slope[DROGUE_SLOPES], seen[DROGUE_SLOPES];
    double at, box;
    for (at = -3; at <= 3; at++) {
        edge(slope, seen, 0.5, 0.01, at, 100000); /* a Gaussian's width: root of 2 pi times its deviation */
        const double gaussian = ldexp(drogue_edge_variance(slope, seen), -16);
        MUST(fabs(gaussian - 2 * TEST_PI * (0.5 + front2) / 8) < 0.02, "at %g: %g", at, gaussian);
    }
    for (box = 5; box <= 9; box++) { /* a box's width is its own, so far as it is seen */
        edge(slope, seen, 0.3, box, 0, 100000);
        const double measured = ldexp(drogue_edge_variance(slope, seen), -16);
        MUST(fabs(measured - box * box / 8) < 0.05 * measured + 0.35, "box of %g: %g", box, measured);
    }
}
END_TEST

START_TEST(only_what_rises_counts)
{
    int32_t slope[DROGUE_SLOPES], seen[DROGUE_SLOPES];
    int32_t alone, beside;
    int i;
    edge(slope, seen, 0.5, 0.01, 0, 100000);
    alone = drogue_edge_variance(slope, seen);
    for (i = 0; i < 4; i++) { /* what falls beyond the edge, on either side, or rises again beyond that by less */
        slope[i] = -30000;
        slope[DROGUE_SLOPES - 1 - i] = -30000;
    }
    slope[0] = 20000;
    beside = drogue_edge_variance(slope, seen);
    ck_assert_int_eq(alone, beside);
    for (i = 0; i < 4; i++) { /* what rises on belongs to it: inside and outside */
        edge(slope, seen, 0.5, 0.01, 0, 100000);
        slope[i % 2 == 0 ? i : DROGUE_SLOPES - 1 - i] += 20000;
        MUST(drogue_edge_variance(slope, seen) > alone + alone / 8, "end %d", i);
    }
}
END_TEST

START_TEST(no_edge_and_the_widest)
{
    int32_t slope[DROGUE_SLOPES], seen[DROGUE_SLOPES];
    int i;
    memset(slope, 0, sizeof slope);
    memset(seen, 0, sizeof seen);
    ck_assert_int_eq(drogue_edge_variance(slope, seen), 0);
    edge(slope, seen, 0.5, 0.01, 0, 1000);
    for (i = 0; i < DROGUE_SLOPES; i++) {
        slope[i] = -slope[i];
    }
    slope[0] = slope[DROGUE_SLOPES - 1] = 0;
    ck_assert_int_eq(drogue_edge_variance(slope, seen), 0); /* it falls where it was seen to rise */
    for (i = 0; i < DROGUE_SLOPES; i++) {
        slope[i] = 1 << 20;
        seen[i] = 1;
    }
    ck_assert_int_eq(drogue_edge_variance(slope, seen), 32 * 65536);
    for (i = 0; i < DROGUE_SLOPES; i++) {
        seen[i] = i == DROGUE_SLOPE_LAST ? 2 : -5;
        slope[i] = i == DROGUE_SLOPE_LAST ? 100 : 0;
    }
    ck_assert_int_gt(drogue_edge_variance(slope, seen), 0); /* the last place, and nothing beside it */
}
END_TEST

/* Variances of a motion's wave: half a turn has four groups. */
static void waves(int32_t variance[DROGUE_EDGE_GROUPS], double mean, double v, double angle, double other)
{
    int k;
    for (k = 0; k < DROGUE_EDGE_GROUPS; k++) {
        const double t = (2 * k + 1) * TEST_PI / 8;
        variance[k] = q16_of(mean + v / 2 * cos(2 * (t - angle)) + (k % 2 == 0 ? other : -other));
    }
}

START_TEST(waves_by_angle)
{
    int32_t variance[DROGUE_EDGE_GROUPS], smear[2];
    double angle;
    for (angle = -1.5; angle < 1.6; angle += 0.25) {
        waves(variance, 6, 5, angle, 0);
        drogue_find_smear(smear, variance);
        ck_assert_double_eq_tol(real_of_q16(smear[0]), 4.5 * cos(2 * angle), 1e-3);
        ck_assert_double_eq_tol(real_of_q16(smear[1]), 4.5 * sin(2 * angle), 1e-3);
        waves(variance, 6, 5, angle, -0.7); /* what is no wave of twice the angle is taken off */
        drogue_find_smear(smear, variance);
        ck_assert_double_eq_tol(real_of_q16(smear[0]), 3.1 * cos(2 * angle), 1e-3);
        ck_assert_double_eq_tol(real_of_q16(smear[1]), 3.1 * sin(2 * angle), 1e-3);
        waves(variance, 6, 0.49, angle, 0);
        drogue_find_smear(smear, variance);
        MUST(smear[0] == 0 && smear[1] == 0, "%g: too little", angle);
    }
}
END_TEST

START_TEST(groups_without_an_edge)
{
    int32_t variance[DROGUE_EDGE_GROUPS], whole[2], smear[2];
    int k;
    waves(variance, 6, 5, 0.4, 0);
    drogue_find_smear(whole, variance);
    for (k = 0; k < DROGUE_EDGE_GROUPS; k++) { /* the opposite one serves */
        waves(variance, 6, 5, 0.4, 0);
        variance[k] = 0;
        drogue_find_smear(smear, variance);
        MUST(abs(smear[0] - whole[0]) < 3 && abs(smear[1] - whole[1]) < 3, "without group %d", k);
        variance[(k + 4) % 8] = 0;
        drogue_find_smear(smear, variance);
        MUST(smear[0] == 0 && smear[1] == 0, "without groups %d and its opposite", k);
    }
}
END_TEST

static uint8_t pixels[SIDE * SIDE];
static drogue_ray rays[DROGUE_RAYS];

/* A bright disc, darker by a share 'ramp' a pixel inwards, smeared over 'length' px along an angle. */
static drogue_image draw(double radius, double ramp, double length, double angle)
{
    const drogue_image view = {pixels, SIDE, SIDE, SIDE};
    int x, y, k;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            double sum = 0;
            for (k = -10; k <= 10; k++) {
                const double off = length * k / 21;
                const double d = hypot(x - 54.5 - off * cos(angle), y - 55.2 - off * sin(angle));
                sum += 0.5 * erfc((d - radius) / sqrt(2 * 0.45)) * fmin(1, fmax(0, 1 - ramp * (radius - d))) / 21;
            }
            pixels[y * SIDE + x] = (uint8_t)lround(50 + 120 * sum);
        }
    }
    return view;
}

static drogue_outline pulled(double radius, double ramp, double length, double angle)
{
    const drogue_image view = draw(radius, ramp, length, angle);
    drogue_config config;
    drogue_outline o;
    uint32_t k;
    drogue_config_default(&config);
    memset(&o, 0, sizeof o);
    o.fitted.xc_px_q16 = q16_of(54.5);
    o.fitted.yc_px_q16 = q16_of(55.2);
    o.fitted.a_px_q16 = o.fitted.b_px_q16 = q16_of(radius);
    o.fitted.angle_rad_q16 = q16_of(0.3);
    o.support.bright_bins = UINT32_MAX;
    o.support.points = 320;
    o.support.smear_px2_q16[0] = 5; /* forgotten */
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        o.support.bin[k].count[1] = 10;
    }
    drogue_outline_pull(&o, rays, &view, &config);
    return o;
}

START_TEST(of_a_smeared_disc)
{
    static const double lengths[] = {0, 2, 6, 9};
    double angle;
    size_t i;
    for (i = 0; i < 4; i++) {
        for (angle = -1.4; angle < 1.5; angle += 0.7) {
            const double l2 = lengths[i] * lengths[i] / 12;
            const drogue_outline o = pulled(38, 0, lengths[i], angle);
            const double c = real_of_q16(o.support.smear_px2_q16[0]), s = real_of_q16(o.support.smear_px2_q16[1]);
            if (lengths[i] < 3) {
                MUST(o.support.smear_px2_q16[0] == 0 && o.support.smear_px2_q16[1] == 0, "%g px: %g %g", lengths[i], c,
                     s);
            } else {
                MUST(hypot(c, s) > 0.5 * l2 && hypot(c, s) < 1.2 * l2, "%g px: %g for %g px^2", lengths[i], hypot(c, s),
                     l2);
                MUST(cos(2 * angle) * c + sin(2 * angle) * s > cos(0.12) * hypot(c, s), "%g px at %g: at %g",
                     lengths[i], angle, atan2(s, c) / 2);
            }
        }
    }
}
END_TEST

START_TEST(only_sharp_sides_say_what_lies_beside_them)
{
    double angle;
    for (angle = -1.4; angle < 1.5; angle += 0.7) { /* shading moves the edge */
        const drogue_outline o = pulled(38, 0.06, 6, angle);
        int k, said = 0;
        for (k = 0; k < 5; k++) {
            said += o.support.pull_q24[k] != 0;
            MUST(abs(o.support.pull_q24[k]) < (1 << 24) / 500, "at %g: wave %d", angle, k);
        }
        MUST(o.support.smear_px2_q16[0] != 0 && said > 0, "at %g: nothing", angle);
    }
}
END_TEST

SUITE_MAIN("smear", variance_of_known_edges, only_what_rises_counts, no_edge_and_the_widest, waves_by_angle,
           groups_without_an_edge, of_a_smeared_disc, only_sharp_sides_say_what_lies_beside_them)
