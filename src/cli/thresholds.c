/* SPDX-License-Identifier: Apache-2.0 */
/* The table, in the order of drogue_config. */
#include "thresholds.h"

#include "drogue/config.h"

#define WHOLE(name, member, least, most, unit)                      \
    {                                                               \
        name, offsetof(drogue_config, member), 0, least, most, unit \
    }
#define REAL(name, member, least, most, unit)                       \
    {                                                               \
        name, offsetof(drogue_config, member), 1, least, most, unit \
    }
#define ONE DROGUE_Q16_ONE

const threshold thresholds[] = {
    WHOLE("canny_low", canny_low, 0, 16320, "L1 Sobel magnitude: lower links weaker edges"),
    WHOLE("canny_high", canny_high, 0, 16320, "L1 Sobel magnitude: an edge needs one pixel above it"),
    WHOLE("canny_least", canny_least, 0, 16320, "L1 Sobel magnitude: least upper threshold of a second try"),
    WHOLE("smooth", smooth, 0, 1, "1: smooth 5x5 before the gradient"),
    WHOLE("transfer", transfer, 0, 1, "0: grey levels are light's, 1: encoded by sRGB"),
    WHOLE("min_arc_px", min_arc_px, 0, INT32_MAX, "edge points: shorter arcs are not fitted"),
    REAL("min_arc_share", min_arc_share_q16, 0, ONE, "of the region's longest side: the same"),
    REAL("min_short_px", min_short_px_q16, 0, INT32_MAX, "px: straighter arcs are not fitted"),
    WHOLE("polarity", polarity, 0, 2, "0: outlines darker inside only, 1: brighter only, 2: both"),
    REAL("quality.fit_error_px", quality.fit_error_px_q16, 0, 1024 * ONE,
         "px: points this near count as on the ellipse"),
    REAL("quality.k1", quality.k1_q16, 0, 64 * ONE, "decay of the score of flat ellipses"),
    REAL("quality.k2", quality.k2_q16, 0, ONE - 1, "axis ratio at which that score is 0"),
    REAL("min_fit_ratio", min_fit_ratio_q16, 0, ONE, "share of fitted points near the ellipse"),
    REAL("min_axis_ratio", min_axis_ratio_q16, 0, ONE, "flatter ellipses are no drogue"),
    REAL("min_size", min_size_q16, 0, INT32_MAX, "major semi-axis, share of the region's longest side"),
    REAL("max_size", max_size_q16, 0, INT32_MAX, "major semi-axis, share of the region's longest side"),
    REAL("cluster.centre_px", cluster.centre_px_q16, 0, INT32_MAX, "px: ellipses this alike count as one"),
    REAL("cluster.a_px", cluster.a_px_q16, 0, INT32_MAX, "px: the same of the major semi-axis"),
    REAL("cluster.b_px", cluster.b_px_q16, 0, INT32_MAX, "px: the same of the minor semi-axis"),
    REAL("cluster.angle_rad", cluster.angle_rad_q16, 0, INT32_MAX, "rad: the same of the angle"),
    REAL("cluster.round", cluster.round_q16, 0, ONE, "axis ratio above which the angle does not count"),
    REAL("search_band", search_band_q16, 0, ONE, "of the major semi-axis: a candidate's edge points lie this near"),
    REAL("refit_band_px", refit_band_px_q16, 1, 8 * ONE, "px: the last fit takes all edge points this near"),
    REAL("refit_cos", refit_cos_q16, 0, ONE, "cosine between gradient and normal that agrees"),
    WHOLE("refit_rounds", refit_rounds, 0, 16, "times the band is applied; 0 keeps the fit of the arcs"),
    REAL("min_cover", min_cover_q16, 0, ONE, "edge points of the outline over its circumference"),
    REAL("recentre_cover", recentre_cover_q16, 0, ONE,
         "an outline covered less that the ring cuts is looked for again"),
    REAL("optics_blur_px", optics_blur_px_q16, 0, 16 * ONE, "px: standard deviation of lens and sensor blur"),
    WHOLE("min_inner_area_px", min_inner_area_px, 0, INT32_MAX, "px: smaller inner parts are noise"),
    WHOLE("min_inner_contrast", min_inner_contrast, 0, 255, "grey levels: less is no inner part"),
    REAL("inner_gate_px", inner_gate_px_q16, 0, INT32_MAX, "px: how far from its place the inner part is believed"),
    REAL("inner_gate", inner_gate_q16, 0, INT32_MAX, "of the major semi-axis: the same"),
    REAL("min_inner_cover", min_inner_cover_q16, 0, ONE, "rays across the inner part's edge that agree"),
    REAL("inner_rms_px", inner_rms_px_q16, 0, INT32_MAX, "px: root mean square distance of these from it"),
    REAL("inner_size_px", inner_size_px_q16, 0, INT32_MAX, "px: how far from its size the inner part is believed"),
    REAL("inner_size", inner_size_q16, 0, INT32_MAX, "of its semi-axis: the same"),
    REAL("outline_shading", outline_shading_q16, 1, 1024 * ONE, "px grey * 8: error of the outline by uneven light"),
    REAL("optics_blur_std_px2", optics_blur_std_px2_q16, 0, 16 * ONE, "px^2: uncertainty of half the blur's variance"),
    REAL("inner_std_px", inner_std_px_q16, 1, 16 * ONE, "px: standard deviation of the inner disc's centre"),
    REAL("inner_std_share", inner_std_share_q16, 0, ONE, "of the disc's semi-axis: what its size adds"),
    REAL("max_chi2", max_chi2_q16, 0, INT32_MAX, "outline and inner part contradict each other above this"),
    REAL("min_chi2_gap", min_chi2_gap_q16, 0, INT32_MAX, "the orientation is resolved when the twin is worse by this"),
};
const int threshold_count = sizeof thresholds / sizeof thresholds[0];
