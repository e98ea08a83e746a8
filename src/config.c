/* SPDX-License-Identifier: Apache-2.0 */
/* Default thresholds and their ranges. */
#include "drogue/config.h"

static const drogue_config defaults = {
    .canny_low = 30,
    .canny_high = 80,
    .canny_least = 8,
    .smooth = 1,
    .transfer = DROGUE_TRANSFER_LINEAR,
    .min_arc_px = 10,
    .min_arc_share_q16 = DROGUE_Q16(1, 8),
    .min_short_px_q16 = DROGUE_Q16(3, 2),
    .polarity = DROGUE_POLARITY_BOTH,
    .quality.fit_error_px_q16 = DROGUE_Q16(1, 1),
    .quality.k1_q16 = DROGUE_Q16(6, 1),
    .quality.k2_q16 = DROGUE_Q16(3, 10),
    .min_fit_ratio_q16 = DROGUE_Q16(7, 10),
    .min_axis_ratio_q16 = DROGUE_Q16(4, 10),
    .min_size_q16 = DROGUE_Q16(2, 10),
    .max_size_q16 = DROGUE_Q16(75, 100),
    .cluster.centre_px_q16 = DROGUE_Q16(3, 1),
    .cluster.a_px_q16 = DROGUE_Q16(3, 1),
    .cluster.b_px_q16 = DROGUE_Q16(3, 1),
    .cluster.angle_rad_q16 = DROGUE_Q16(2, 10),
    .cluster.round_q16 = DROGUE_Q16(9, 10),
    .search_band_q16 = DROGUE_Q16(3, 100),
    .refit_band_px_q16 = DROGUE_Q16(3, 2),
    .refit_cos_q16 = DROGUE_Q16(87, 100),
    .refit_rounds = 4,
    .min_cover_q16 = DROGUE_Q16(45, 100),
    .recentre_cover_q16 = DROGUE_Q16(85, 100),
    .optics_blur_px_q16 = DROGUE_Q16(6, 10),
    .min_inner_area_px = 9,
    .min_inner_contrast = 6,
    .inner_gate_px_q16 = DROGUE_Q16(15, 10),
    .inner_gate_q16 = DROGUE_Q16(5, 100),
    .min_inner_cover_q16 = DROGUE_Q16(5, 10),
    .inner_rms_px_q16 = DROGUE_Q16(65, 100),
    .inner_size_px_q16 = DROGUE_Q16(5, 4),
    .inner_size_q16 = DROGUE_Q16(7, 100),
    .outline_shading_q16 = DROGUE_Q16(16, 10),
    .optics_blur_std_px2_q16 = DROGUE_Q16(2, 10),
    .inner_std_px_q16 = DROGUE_Q16(5, 100),
    .inner_std_share_q16 = DROGUE_Q16(5, 1000),
    .max_chi2_q16 = DROGUE_Q16(16, 1),
    .min_chi2_gap_q16 = DROGUE_Q16(9, 1),
};

void drogue_config_default(drogue_config *config) { *config = defaults; }

static int within(int32_t v, int32_t low, int32_t high) { return v >= low && v <= high; }

int drogue_config_valid(const drogue_config *c)
{
    /* the sign of all that have no upper bound */
    const int32_t any = c->min_short_px_q16 | c->cluster.centre_px_q16 | c->cluster.a_px_q16 | c->cluster.b_px_q16 |
                        c->cluster.angle_rad_q16 | c->inner_gate_px_q16 | c->inner_gate_q16 | c->inner_rms_px_q16 |
                        c->inner_size_px_q16 | c->inner_size_q16 | c->max_chi2_q16 | c->min_chi2_gap_q16;
    return any >= 0 && within(c->canny_low, 0, c->canny_high) && within(c->canny_least, 0, c->canny_high) &&
           within((int32_t)c->transfer, DROGUE_TRANSFER_LINEAR, DROGUE_TRANSFER_SRGB) &&
           within(c->min_arc_share_q16, 0, DROGUE_Q16_ONE) &&
           within((int32_t)c->polarity, DROGUE_POLARITY_DARK, DROGUE_POLARITY_BOTH) &&
           within(c->quality.fit_error_px_q16, 0, DROGUE_Q16(1024, 1)) &&
           within(c->quality.k1_q16, 0, DROGUE_Q16(64, 1)) && within(c->quality.k2_q16, 0, DROGUE_Q16_ONE - 1) &&
           within(c->min_fit_ratio_q16, 0, DROGUE_Q16_ONE) && within(c->min_axis_ratio_q16, 0, DROGUE_Q16_ONE) &&
           within(c->min_size_q16, 0, c->max_size_q16) && within(c->cluster.round_q16, 0, DROGUE_Q16_ONE) &&
           within(c->search_band_q16, 0, DROGUE_Q16_ONE) && within(c->refit_band_px_q16, 1, DROGUE_Q16(8, 1)) &&
           within(c->refit_cos_q16, 0, DROGUE_Q16_ONE) && c->refit_rounds <= 16 &&
           within(c->min_cover_q16, 0, DROGUE_Q16_ONE) && within(c->recentre_cover_q16, 0, DROGUE_Q16_ONE) &&
           within(c->optics_blur_px_q16, 0, DROGUE_Q16(16, 1)) && within(c->min_inner_contrast, 0, 255) &&
           within(c->min_inner_cover_q16, 0, DROGUE_Q16_ONE) &&
           within(c->outline_shading_q16, 1, DROGUE_Q16(1024, 1)) &&
           within(c->optics_blur_std_px2_q16, 0, DROGUE_Q16(16, 1)) &&
           within(c->inner_std_px_q16, 1, DROGUE_Q16(16, 1)) && within(c->inner_std_share_q16, 0, DROGUE_Q16_ONE);
}
