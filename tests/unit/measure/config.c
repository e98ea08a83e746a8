/* SPDX-License-Identifier: Apache-2.0 */
/* Documented defaults, and one step beyond each documented range. */
#include "suite.h"

#include "drogue/config.h"

START_TEST(defaults_are_the_documented_ones)
{
    drogue_config c;
    memset(&c, 0x5A, sizeof c);
    drogue_config_default(&c);
    ck_assert_int_eq(c.canny_low, 30);
    ck_assert_int_eq(c.canny_high, 80);
    ck_assert_int_eq(c.smooth, 1);
    ck_assert_uint_eq(c.min_arc_px, 10);
    ck_assert_int_eq(c.min_arc_share_q16, q16_of(0.125));
    ck_assert_int_eq(c.min_short_px_q16, q16_of(1.5));
    ck_assert_int_eq(c.polarity, DROGUE_POLARITY_BOTH);
    ck_assert_int_eq(c.quality.fit_error_px_q16, q16_of(1));
    ck_assert_int_eq(c.quality.k1_q16, q16_of(6));
    ck_assert_int_eq(c.quality.k2_q16, q16_of(0.3));
    ck_assert_int_eq(c.min_fit_ratio_q16, q16_of(0.7));
    ck_assert_int_eq(c.min_axis_ratio_q16, q16_of(0.4));
    ck_assert_int_eq(c.min_size_q16, q16_of(0.2));
    ck_assert_int_eq(c.max_size_q16, q16_of(0.75));
    ck_assert_int_eq(c.cluster.centre_px_q16, q16_of(3));
    ck_assert_int_eq(c.cluster.a_px_q16, q16_of(3));
    ck_assert_int_eq(c.cluster.b_px_q16, q16_of(3));
    ck_assert_int_eq(c.cluster.angle_rad_q16, q16_of(0.2));
    ck_assert_int_eq(c.cluster.round_q16, q16_of(0.9));
    ck_assert_int_eq(c.search_band_q16, q16_of(0.03));
    ck_assert_int_eq(c.refit_band_px_q16, q16_of(1.5));
    ck_assert_int_eq(c.refit_cos_q16, q16_of(0.87));
    ck_assert_uint_eq(c.refit_rounds, 4);
    ck_assert_int_eq(c.min_cover_q16, q16_of(0.45));
    ck_assert_int_eq(c.recentre_cover_q16, q16_of(0.85));
    ck_assert_int_eq(c.optics_blur_px_q16, q16_of(0.6));
    ck_assert_uint_eq(c.min_inner_area_px, 9);
    ck_assert_int_eq(c.min_inner_contrast, 6);
    ck_assert_int_eq(c.inner_gate_px_q16, q16_of(1.5));
    ck_assert_int_eq(c.inner_gate_q16, q16_of(0.05));
    ck_assert_int_eq(c.canny_least, 8);
    ck_assert_int_eq(c.transfer, DROGUE_TRANSFER_LINEAR);
    ck_assert_int_eq(c.min_inner_cover_q16, q16_of(0.5));
    ck_assert_int_eq(c.inner_rms_px_q16, q16_of(0.65));
    ck_assert_int_eq(c.inner_size_px_q16, q16_of(1.25));
    ck_assert_int_eq(c.inner_size_q16, q16_of(0.07));
    ck_assert_int_eq(c.outline_shading_q16, q16_of(1.6));
    ck_assert_int_eq(c.optics_blur_std_px2_q16, q16_of(0.2));
    ck_assert_int_eq(c.inner_std_px_q16, q16_of(0.05));
    ck_assert_int_eq(c.inner_std_share_q16, q16_of(0.005));
    ck_assert_int_eq(c.max_chi2_q16, q16_of(16));
    ck_assert_int_eq(c.min_chi2_gap_q16, q16_of(9));
    ck_assert(drogue_config_valid(&c));
}
END_TEST

#define LIMIT(member, good, bad) CHECK_LIMIT(drogue_config_valid, c, member, good, bad)

START_TEST(each_limit)
{
    drogue_config c;
    drogue_config_default(&c);
    LIMIT(canny_low, 0, -1);
    LIMIT(canny_low, c.canny_high, c.canny_high + 1);
    LIMIT(canny_high, c.canny_low, c.canny_low - 1);
    LIMIT(min_short_px_q16, 0, -1);
    LIMIT(quality.fit_error_px_q16, 0, -1);
    LIMIT(quality.k1_q16, 0, -1);
    LIMIT(quality.k1_q16, 64 * 65536, 64 * 65536 + 1);
    LIMIT(quality.k2_q16, 0, -1);
    LIMIT(quality.k2_q16, 65535, 65536);
    LIMIT(min_fit_ratio_q16, 0, -1);
    LIMIT(min_fit_ratio_q16, 65536, 65537);
    LIMIT(min_axis_ratio_q16, 0, -1);
    LIMIT(min_axis_ratio_q16, 65536, 65537);
    LIMIT(min_size_q16, 0, -1);
    LIMIT(cluster.centre_px_q16, 0, -1);
    LIMIT(cluster.a_px_q16, 0, -1);
    LIMIT(cluster.b_px_q16, 0, -1);
    LIMIT(cluster.angle_rad_q16, 0, -1);
    LIMIT(cluster.round_q16, 0, -1);
    LIMIT(cluster.round_q16, 65536, 65537);
    LIMIT(refit_band_px_q16, 1, 0);
    LIMIT(refit_band_px_q16, 8 * 65536, 8 * 65536 + 1);
    LIMIT(refit_cos_q16, 0, -1);
    LIMIT(refit_cos_q16, 65536, 65537);
    LIMIT(min_cover_q16, 0, -1);
    LIMIT(min_cover_q16, 65536, 65537);
    LIMIT(optics_blur_px_q16, 0, -1);
    LIMIT(optics_blur_px_q16, 16 * 65536, 16 * 65536 + 1);
    LIMIT(min_inner_contrast, 0, -1);
    LIMIT(min_inner_contrast, 255, 256);
    LIMIT(inner_gate_px_q16, 0, -1);
    LIMIT(inner_gate_q16, 0, -1);
    LIMIT(min_arc_share_q16, 0, -1);
    LIMIT(min_arc_share_q16, 65536, 65537);
    LIMIT(quality.fit_error_px_q16, 1024 * 65536, 1024 * 65536 + 1);
    LIMIT(min_size_q16, c.max_size_q16, c.max_size_q16 + 1);
    LIMIT(search_band_q16, 0, -1);
    LIMIT(search_band_q16, 65536, 65537);
    LIMIT(recentre_cover_q16, 0, -1);
    LIMIT(recentre_cover_q16, 65536, 65537);
    LIMIT(canny_least, 0, -1);
    LIMIT(canny_least, c.canny_high, c.canny_high + 1);
    LIMIT(min_inner_cover_q16, 0, -1);
    LIMIT(min_inner_cover_q16, 65536, 65537);
    LIMIT(inner_rms_px_q16, 0, -1);
    LIMIT(inner_size_px_q16, 0, -1);
    LIMIT(inner_size_q16, 0, -1);
    LIMIT(outline_shading_q16, 1, 0);
    LIMIT(outline_shading_q16, 1024 * 65536, 1024 * 65536 + 1);
    LIMIT(optics_blur_std_px2_q16, 0, -1);
    LIMIT(optics_blur_std_px2_q16, 16 * 65536, 16 * 65536 + 1);
    LIMIT(inner_std_px_q16, 1, 0);
    LIMIT(inner_std_px_q16, 16 * 65536, 16 * 65536 + 1);
    LIMIT(inner_std_share_q16, 0, -1);
    LIMIT(inner_std_share_q16, 65536, 65537);
    LIMIT(max_chi2_q16, 0, -1);
    LIMIT(min_chi2_gap_q16, 0, -1);
    c.refit_rounds = 16;
    ck_assert(drogue_config_valid(&c));
    c.refit_rounds = 17;
    ck_assert(!drogue_config_valid(&c));
    c.refit_rounds = 0;
    c.polarity = (drogue_polarity)3;
    ck_assert(!drogue_config_valid(&c));
    c.polarity = DROGUE_POLARITY_BOTH;
    c.transfer = DROGUE_TRANSFER_SRGB;
    ck_assert(drogue_config_valid(&c));
    c.transfer = (drogue_transfer)2;
    ck_assert(!drogue_config_valid(&c));
}
END_TEST

SUITE_MAIN("config", defaults_are_the_documented_ones, each_limit)
