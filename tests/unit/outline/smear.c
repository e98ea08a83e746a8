/* SPDX-License-Identifier: Apache-2.0 */
/* Motion blur from the outline's edge: widths and lobes of known form, and discs smeared along a line. */
#include "suite.h"

#include "../../../src/outline/smear.h"
#include "drogue/outline.h"

enum { SIDE = 110 };

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

/* The outline is fitted 'more' px too large. */
static drogue_outline pulled(double radius, double ramp, double length, double angle, double more)
{
    const drogue_image view = draw(radius, ramp, length, angle);
    drogue_config config;
    drogue_outline o;
    uint32_t k;
    drogue_config_default(&config);
    memset(&o, 0, sizeof o);
    o.fitted.xc_px_q16 = q16_of(54.5);
    o.fitted.yc_px_q16 = q16_of(55.2);
    o.fitted.a_px_q16 = o.fitted.b_px_q16 = q16_of(radius + more);
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
            const drogue_outline o = pulled(38, 0, lengths[i], angle, 0);
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

/* Within what motion leaves of them, a seam of the squares' corners and noise of one grey level. */
START_TEST(a_smeared_outline_is_put_back)
{
    static const double lengths[] = {4, 6, 9};
    double angle;
    size_t i;
    int fat;
    for (i = 0; i < 3; i++) {
        for (angle = -1.4; angle < 1.5; angle += 0.7) {
            for (fat = -1; fat <= 1; fat++) { /* fitted too small, right, and too large */
                const drogue_outline o = pulled(38, 0, lengths[i], angle, fat * 0.8);
                MUST(o.support.smear_px2_q16[0] != 0, "%g px at %g", lengths[i], angle);
                MUST(fabs(real_of_q16(o.ellipse.a_px_q16) - 38) < 0.2 &&
                         fabs(real_of_q16(o.ellipse.b_px_q16) - 38) < 0.2,
                     "%g px at %g: %g %g", lengths[i], angle, real_of_q16(o.ellipse.a_px_q16),
                     real_of_q16(o.ellipse.b_px_q16));
                MUST(hypot(real_of_q16(o.ellipse.xc_px_q16) - 54.5, real_of_q16(o.ellipse.yc_px_q16) - 55.2) < 0.1,
                     "%g px at %g: centre", lengths[i], angle);
            }
        }
    }
}
END_TEST

/* Slopes of a bright band of a width that motion of a length smears, its outer edge 'at' half pixels outwards. */
static void band(int32_t slope[DROGUE_SMEARED_SLOPES], double width, double length, double at, double inner_share)
{
    const double s = sqrt(2 * 0.6);
    int i;
    for (i = 0; i < DROGUE_SMEARED_SLOPES; i++) {
        const double x = (i - DROGUE_SMEARED_MIDDLE - at) / 2;
        const double outer = erf((x + length / 2) / s) - erf((x - length / 2) / s);
        const double inner = erf((x + width + length / 2) / s) - erf((x + width - length / 2) / s);
        slope[i] = (int32_t)lround(50000 * (outer - inner_share * inner) / length);
    }
}

static double px(int32_t half_px_q16) { return ldexp(half_px_q16, -17); }

START_TEST(lobes_of_bands)
{
    double width, length, at;
    for (width = 3; width < 14; width += 2) {
        for (length = 4; length < 11; length += 2) {
            for (at = -2; at <= 2; at += 0.5) {
                const double less = fmin(width, length), more = fmax(width, length);
                const double out = length > width ? (length - width) / 2 : 0;
                int32_t slope[DROGUE_SMEARED_SLOPES];
                drogue_lobe lobe;
                if (at / 2 + out > 3) {
                    continue; /* too far to be the ellipse's */
                }
                band(slope, width, length, at, 1);
                drogue_find_lobe(&lobe, slope);
                MUST(fabs(px(lobe.at_q16) - at / 2 - out) < 0.2, "%g under %g: at %g", width, length, px(lobe.at_q16));
                MUST(fabs(px(lobe.width_q16) - less) < 0.5, "%g under %g: %g wide", width, length, px(lobe.width_q16));
                MUST(fabs(px(lobe.farther_q16) - more) < 0.4, "%g under %g: %g apart", width, length,
                     px(lobe.farther_q16));
            }
        }
    }
}
END_TEST

START_TEST(what_is_no_lobe)
{
    int32_t slope[DROGUE_SMEARED_SLOPES];
    drogue_lobe lobe;
    int i;
    band(slope, 9, 5, 0, 0.36); /* the other edge, a third as steep: just seen, and just not */
    drogue_find_lobe(&lobe, slope);
    ck_assert_int_gt(lobe.farther_q16, 0);
    band(slope, 9, 5, 0, 0.30);
    drogue_find_lobe(&lobe, slope);
    ck_assert_int_eq(lobe.farther_q16, 0);
    ck_assert_int_gt(lobe.width_q16, 0);
    band(slope, 14.7, 5, 0, 1); /* and within 15 px */
    drogue_find_lobe(&lobe, slope);
    MUST(fabs(px(lobe.farther_q16) - 14.7) < 0.2, "%g", px(lobe.farther_q16));
    band(slope, 15.3, 5, 0, 1);
    drogue_find_lobe(&lobe, slope);
    ck_assert_int_eq(lobe.farther_q16, 0);
    for (i = 0; i < DROGUE_SMEARED_SLOPES; i++) { /* it falls all over; it does not end on either side */
        slope[i] = -7;
    }
    drogue_find_lobe(&lobe, slope);
    MUST(lobe.at_q16 == 0 && lobe.width_q16 == 0 && lobe.farther_q16 == 0, "none");
    for (i = 0; i < DROGUE_SMEARED_SLOPES; i++) {
        slope[i] = i < DROGUE_SMEARED_MIDDLE ? 0 : 1 << 20;
    }
    drogue_find_lobe(&lobe, slope);
    ck_assert_int_eq(lobe.width_q16, 0);
    for (i = 0; i < DROGUE_SMEARED_SLOPES; i++) {
        slope[i] = i > DROGUE_SMEARED_MIDDLE ? 0 : 1 << 20;
    }
    drogue_find_lobe(&lobe, slope);
    ck_assert_int_eq(lobe.width_q16, 0);
    for (i = 8; i <= 13; i++) { /* 4 to 6.5 px away: another's, wide or narrow */
        band(slope, 9, 5, i, 1);
        drogue_find_lobe(&lobe, slope);
        ck_assert_int_eq(lobe.width_q16, 0);
        band(slope, 9, 1, i, 1);
        drogue_find_lobe(&lobe, slope);
        ck_assert_int_eq(lobe.width_q16, 0);
    }
}
END_TEST

/* Lobes round an outline whose band is 'narrow' wide at angle 0 and 'wide' half a turn on. */
static void bands(drogue_lobe lobe[DROGUE_EDGE_GROUPS], double out[DROGUE_EDGE_GROUPS], double narrow, double wide,
                  double length, double angle)
{
    int k;
    for (k = 0; k < DROGUE_EDGE_GROUPS; k++) {
        const double t = (2 * k + 1) * TEST_PI / 8, l = fmax(2.5, length * fabs(cos(t - angle)));
        const double w = (narrow + wide) / 2 + (narrow - wide) / 2 * cos(t);
        out[k] = fmax(0, l - w) / 2;
        lobe[k].at_q16 = q16_of(2 * (0.3 + out[k]));
        lobe[k].width_q16 = q16_of(2 * fmin(l, w));
        lobe[k].farther_q16 = q16_of(2 * fmax(l, w));
    }
}

START_TEST(bands_that_motion_fills)
{
    static const double shape[][2] = {{4, 4}, {6, 6}, {12, 12}, {3.5, 7}, {7, 12}};
    drogue_lobe lobe[DROGUE_EDGE_GROUPS];
    double out[DROGUE_EDGE_GROUPS], angle;
    int32_t moved[DROGUE_EDGE_GROUPS];
    int filled = 0;
    size_t i;
    int k;
    for (i = 0; i < 5; i++) {
        for (angle = -1.5; angle < 1.6; angle += 0.25) {
            bands(lobe, out, shape[i][0], shape[i][1], 9, angle);
            drogue_find_smeared(moved, lobe);
            for (k = 0; k < DROGUE_EDGE_GROUPS; k++) {
                filled += out[k] > 1;
                MUST(fabs(px(moved[k]) - (out[k] - (0.3 + out[k]))) < 0.55, "%g to %g px at %g, group %d: %g for -0.3",
                     shape[i][0], shape[i][1], angle, k, px(moved[k]));
            }
        }
    }
    ck_assert_int_gt(filled, 100);
}
END_TEST

START_TEST(bands_that_say_nothing)
{
    drogue_lobe lobe[DROGUE_EDGE_GROUPS];
    double out[DROGUE_EDGE_GROUPS];
    int32_t moved[DROGUE_EDGE_GROUPS];
    int k;
    bands(lobe, out, 4, 4, 9, 0);
    lobe[0].farther_q16 = 0; /* a side whose other edge is not seen: neither it nor its opposite */
    lobe[3].width_q16 = lobe[3].at_q16 = lobe[3].farther_q16 = 0; /* no edge at all */
    drogue_find_smeared(moved, lobe);
    ck_assert_int_eq(moved[0], -lobe[0].at_q16);
    ck_assert_int_eq(moved[4], -lobe[4].at_q16);
    ck_assert_int_eq(moved[3], 0);
    bands(lobe, out, 4, 4, 9, 0);
    for (k = 0; k < DROGUE_EDGE_GROUPS; k += 4) { /* nothing fits: opposite sides without anything in common */
        lobe[k].width_q16 = q16_of(k == 0 ? 4 : 10);
        lobe[k].farther_q16 = q16_of(k == 0 ? 16 : 28);
    }
    drogue_find_smeared(moved, lobe);
    MUST(moved[0] == -lobe[0].at_q16 && moved[4] == -lobe[4].at_q16, "%g %g", px(moved[0]), px(moved[4]));
    for (k = 0; k < DROGUE_EDGE_GROUPS; k++) { /* 8 px that motion of 6 does not fill, or 6 of 8: hardly better */
        lobe[k].width_q16 = q16_of(2 * (k % 4 == 1 ? 3 : 6));
        lobe[k].farther_q16 = q16_of(2 * (k % 4 == 1 ? 6.9 : 8));
    }
    drogue_find_smeared(moved, lobe);
    ck_assert_int_eq(moved[0], -lobe[0].at_q16);
    for (k = 0; k < DROGUE_EDGE_GROUPS; k++) { /* much better */
        lobe[k].farther_q16 = q16_of(2 * (k % 4 == 1 ? 6.5 : 8));
    }
    drogue_find_smeared(moved, lobe);
    ck_assert_int_eq(moved[0], q16_of(2) - lobe[0].at_q16);
    memset(lobe, 0, sizeof lobe);
    drogue_find_smeared(moved, lobe);
    for (k = 0; k < DROGUE_EDGE_GROUPS; k++) {
        ck_assert_int_eq(moved[k], 0);
    }
}
END_TEST

SUITE_MAIN("smear", waves_by_angle, groups_without_an_edge, of_a_smeared_disc, a_smeared_outline_is_put_back,
           lobes_of_bands, what_is_no_lobe, bands_that_motion_fills, bands_that_say_nothing)
