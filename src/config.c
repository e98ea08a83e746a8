/* SPDX-License-Identifier: Apache-2.0 */
/* Default thresholds and their ranges. */
#include "drogue/config.h"

void drogue_config_default(drogue_config *config)
{
    config->canny_low = 30;
    config->canny_high = 80;
    config->canny_least = 8;
    config->smooth = 1;
    config->transfer = DROGUE_TRANSFER_LINEAR;
    config->min_arc_px = 10;
    config->min_arc_share_q16 = DROGUE_Q16(1, 8);
    config->min_short_px_q16 = DROGUE_Q16(3, 2);
    config->polarity = DROGUE_POLARITY_BOTH;
    config->quality.fit_error_px_q16 = DROGUE_Q16(1, 1);
    config->quality.k1_q16 = DROGUE_Q16(6, 1);
    config->quality.k2_q16 = DROGUE_Q16(3, 10);
    config->min_fit_ratio_q16 = DROGUE_Q16(7, 10);
    config->min_axis_ratio_q16 = DROGUE_Q16(4, 10);
    config->min_size_q16 = DROGUE_Q16(2, 10);
    config->max_size_q16 = DROGUE_Q16(75, 100);
    config->cluster.centre_px_q16 = DROGUE_Q16(3, 1);
    config->cluster.a_px_q16 = DROGUE_Q16(3, 1);
    config->cluster.b_px_q16 = DROGUE_Q16(3, 1);
    config->cluster.angle_rad_q16 = DROGUE_Q16(2, 10);
    config->cluster.round_q16 = DROGUE_Q16(9, 10);
    config->search_band_q16 = DROGUE_Q16(3, 100);
    config->refit_band_px_q16 = DROGUE_Q16(3, 2);
    config->refit_cos_q16 = DROGUE_Q16(87, 100);
    config->refit_rounds = 4;
    config->min_cover_q16 = DROGUE_Q16(45, 100);
    config->recentre_cover_q16 = DROGUE_Q16(85, 100);
    config->optics_blur_px_q16 = DROGUE_Q16(6, 10);
    config->min_inner_area_px = 9;
    config->min_inner_contrast = 6;
    config->inner_gate_px_q16 = DROGUE_Q16(15, 10);
    config->inner_gate_q16 = DROGUE_Q16(5, 100);
    config->min_inner_cover_q16 = DROGUE_Q16(5, 10);
    config->inner_rms_px_q16 = DROGUE_Q16(65, 100);
    config->inner_size_px_q16 = DROGUE_Q16(5, 4);
    config->inner_size_q16 = DROGUE_Q16(7, 100);
    config->outline_shading_q16 = DROGUE_Q16(16, 10);
    config->optics_blur_std_px2_q16 = DROGUE_Q16(2, 10);
    config->inner_std_px_q16 = DROGUE_Q16(5, 100);
    config->inner_std_share_q16 = DROGUE_Q16(5, 1000);
    config->max_chi2_q16 = DROGUE_Q16(16, 1);
    config->min_chi2_gap_q16 = DROGUE_Q16(9, 1);
}

static int within(int32_t v, int32_t low, int32_t high) { return v >= low && v <= high; }

int drogue_config_valid(const drogue_config *c)
{
    return within(c->canny_low, 0, c->canny_high) && within(c->canny_least, 0, c->canny_high) &&
           within((int32_t)c->transfer, DROGUE_TRANSFER_LINEAR, DROGUE_TRANSFER_SRGB) &&
           within(c->min_arc_share_q16, 0, DROGUE_Q16_ONE) && within(c->min_short_px_q16, 0, INT32_MAX) &&
           within((int32_t)c->polarity, DROGUE_POLARITY_DARK, DROGUE_POLARITY_BOTH) &&
           within(c->quality.fit_error_px_q16, 0, DROGUE_Q16(1024, 1)) &&
           within(c->quality.k1_q16, 0, DROGUE_Q16(64, 1)) && within(c->quality.k2_q16, 0, DROGUE_Q16_ONE - 1) &&
           within(c->min_fit_ratio_q16, 0, DROGUE_Q16_ONE) && within(c->min_axis_ratio_q16, 0, DROGUE_Q16_ONE) &&
           within(c->min_size_q16, 0, c->max_size_q16) && within(c->cluster.centre_px_q16, 0, INT32_MAX) &&
           within(c->cluster.a_px_q16, 0, INT32_MAX) && within(c->cluster.b_px_q16, 0, INT32_MAX) &&
           within(c->cluster.angle_rad_q16, 0, INT32_MAX) && within(c->cluster.round_q16, 0, DROGUE_Q16_ONE) &&
           within(c->search_band_q16, 0, DROGUE_Q16_ONE) && within(c->refit_band_px_q16, 1, DROGUE_Q16(8, 1)) &&
           within(c->refit_cos_q16, 0, DROGUE_Q16_ONE) && c->refit_rounds <= 16 &&
           within(c->min_cover_q16, 0, DROGUE_Q16_ONE) && within(c->recentre_cover_q16, 0, DROGUE_Q16_ONE) &&
           within(c->optics_blur_px_q16, 0, DROGUE_Q16(16, 1)) && within(c->min_inner_contrast, 0, 255) &&
           within(c->inner_gate_px_q16, 0, INT32_MAX) && within(c->inner_gate_q16, 0, INT32_MAX) &&
           within(c->min_inner_cover_q16, 0, DROGUE_Q16_ONE) && within(c->inner_rms_px_q16, 0, INT32_MAX) &&
           within(c->inner_size_px_q16, 0, INT32_MAX) && within(c->inner_size_q16, 0, INT32_MAX) &&
           within(c->outline_shading_q16, 1, DROGUE_Q16(1024, 1)) &&
           within(c->optics_blur_std_px2_q16, 0, DROGUE_Q16(16, 1)) &&
           within(c->inner_std_px_q16, 1, DROGUE_Q16(16, 1)) && within(c->inner_std_share_q16, 0, DROGUE_Q16_ONE) &&
           within(c->max_chi2_q16, 0, INT32_MAX) && within(c->min_chi2_gap_q16, 0, INT32_MAX);
}
