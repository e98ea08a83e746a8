/* SPDX-License-Identifier: Apache-2.0 */
/* Default thresholds. */
#include "drogue/config.h"

void drogue_config_default(drogue_config *config)
{
    config->canny_low = 40;
    config->canny_high = 100;
    config->smooth = 1;
    config->min_arc_px = 10;
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
    config->refit_band_px_q16 = DROGUE_Q16(3, 2);
    config->refit_cos_q16 = DROGUE_Q16(87, 100);
    config->refit_rounds = 3;
    config->min_cover_q16 = DROGUE_Q16(45, 100);
    config->optics_blur_px_q16 = 0;
    config->min_dark_area_px = 9;
    config->inner_gate_q16 = DROGUE_Q16(1, 4);
}
