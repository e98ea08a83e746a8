/* SPDX-License-Identifier: Apache-2.0 */
/* Every threshold of the method in one struct, with its default, unit and effect. */
#ifndef DROGUE_CONFIG_H
#define DROGUE_CONFIG_H

#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How a fit is scored: quality.h. */
typedef struct drogue_quality_config {
    drogue_q16 fit_error_px_q16; /* points this near the ellipse count as on it: Th_error = 2 fit_error / a in (10);
                                    of a frame at least search_band, not limited to 8 px */
    drogue_q16 k1_q16;           /* (14): decay of the score of flat ellipses, [0, 64] */
    drogue_q16 k2_q16;           /* (14): axis ratio at which that score is 0, [0, 1) */
} drogue_quality_config;

/* When two ellipses are one: cluster.h. */
typedef struct drogue_cluster_config {
    drogue_q16 centre_px_q16; /* T_d */
    drogue_q16 a_px_q16;      /* T_a */
    drogue_q16 b_px_q16;      /* T_b */
    drogue_q16 angle_rad_q16; /* T_rho; angles are compared modulo pi */
    drogue_q16 round_q16;     /* angles are not compared when both axis ratios exceed this: a circle has none */
} drogue_cluster_config;

/* How an image's grey levels stand for light: its transfer function. Blur mixes light, so that where levels are encoded
 * for display a blurred edge's steepest place lies a tenth to a third of a pixel towards its dark side. */
typedef enum drogue_transfer {
    DROGUE_TRANSFER_LINEAR, /* in proportion: a sensor's own */
    DROGUE_TRANSFER_SRGB    /* sRGB (IEC 61966-2-1): what is made to be looked at, as most stored pictures and rendered
                               frames are; outlines and the inner disc are put where the light changes */
} drogue_transfer;

/* Thresholds; drogue_config_default() fills in the defaults given here. */
typedef struct drogue_config {
    int32_t canny_low;             /* 30, L1 Sobel magnitude (grey levels * 8): lower links weaker edges */
    int32_t canny_high;            /* 80, same unit: an edge needs one pixel above it */
    int32_t canny_least;           /* 8, same unit, [0, canny_high]: least upper threshold of a second try by the
                                      region's noise, when the first finds no outline, doubts it or fills a table;
                                      canny_high: no second try */
    int32_t smooth;                /* 1: smooth before the gradient; 0 for images that are smooth already */
    drogue_transfer transfer;      /* LINEAR: of the images */
    uint32_t min_arc_px;           /* 10 edge points, Th_length: shorter arcs are not fitted */
    drogue_q16 min_arc_share_q16;  /* 1/8: the same as a share of the region's longest side; a quarter of an outline
                                     in a region of 2.5 semi-axes has about 0.57: stubs lie farther out than whole
                                     arcs */
    drogue_q16 min_short_px_q16;   /* 1.5 px, Th_minb: straighter arcs (short side of the rectangle) are not fitted */
    drogue_polarity polarity;      /* BOTH: or only outlines darker (DARK) or brighter (BRIGHT) inside */
    drogue_quality_config quality; /* fit_error 1 px, k1 6, k2 0.3 */
    drogue_q16 min_fit_ratio_q16;  /* 0.7, Th_score: least share of fitted points near the ellipse (11) */
    drogue_q16 min_axis_ratio_q16; /* 0.4: flatter ellipses are no drogue */
    drogue_q16 min_size_q16;       /* 0.2: least semi-major axis, as a share of the region's longest side */
    drogue_q16 max_size_q16;       /* 0.75: largest semi-major axis, as a share of the region's longest side */
    drogue_cluster_config cluster; /* T_d 3 px, T_a 3 px, T_b 3 px, T_rho 0.2 rad, round 0.9 */
    drogue_q16 search_band_q16;    /* 0.03: a candidate's edge points lie this near, as a share of its major semi-axis;
                                      at least refit_band, at most 8 px */
    drogue_q16 refit_band_px_q16;  /* 1.5 px: the last fit takes all edge points this near with agreeing gradient */
    drogue_q16 refit_cos_q16;      /* 0.87 (30 degrees): least cosine between gradient and normal that agrees */
    uint32_t refit_rounds;         /* 4: times the band is applied; 0 keeps the fit of the arcs */
    drogue_q16 min_cover_q16;      /* 0.45: least number of edge points that belong to the outline, over its
                                      circumference; half an outline gives about 0.45. 0.7 in any case where
                                      the model's inner part is not seen and all of the outline is in the image; five
                                      eighths of it about that part, of its size, where seven of eight parts show */
    /* 0.85: an outline covered less that the ring mask cuts is looked for again in a region about it; 0: never */
    drogue_q16 recentre_cover_q16;
    drogue_q16 optics_blur_px_q16;  /* 0.6 px: standard deviation of the lens's and sensor's blur, [0, 16]; blur
                                      draws a curved edge inward, and one whose bright side is cut off to the dark
                                      side, which are put back (outline.h) */
    uint32_t min_inner_area_px;     /* 9 px: smaller inner parts are noise */
    int32_t min_inner_contrast;     /* 6 grey levels, [0, 255]: less contrast with its surround is no inner part */
    drogue_q16 inner_gate_px_q16;   /* 1.5 px: the inner part is believed within this and inner_gate of where a pose
                                      expects it; twice as far where it is sharp, of its size and seen nearly all
                                      about */
    drogue_q16 inner_gate_q16;      /* 0.05: what a larger outline adds to that, as a share of its major semi-axis */
    drogue_q16 min_inner_cover_q16; /* 0.5: least share of the rays across the inner part's edge that agrees */
    drogue_q16 inner_rms_px_q16;    /* 0.65 px: most that these rays lie about the edge, root mean square; of an inner
                                       part of more than 15 px that is seen nearly all about as much more as it is
                                       larger, up to 25 px, for it may be jagged */
    drogue_q16 inner_size_px_q16;   /* 1.25 px: its semi-axis is the expected one within this and inner_size */
    drogue_q16 inner_size_q16;      /* 0.07: what a larger inner part adds to that, as a share of its semi-axis */
    drogue_q16 outline_shading_q16; /* 1.6 px grey * 8: error of the outline that its own residuals cannot show, over
                                       the gradient along it (joint.h) */
    drogue_q16 optics_blur_std_px2_q16; /* 0.2 px^2: uncertainty of half the variance of the optics' blur */
    drogue_q16 inner_std_px_q16;        /* 0.05 px: standard deviation of the inner disc's centre, whatever its size */
    drogue_q16 inner_std_share_q16; /* 0.005: what its size adds to that in quadrature, as a share of its semi-axis */
    drogue_q16 max_chi2_q16;        /* 16: outline and inner part contradict each other above this */
    drogue_q16 min_chi2_gap_q16;    /* 9: the orientation is resolved when the other pose is worse by so much, where
                                           they contradict each other by so many times chi2 */
} drogue_config;

/* Fill in the defaults given above. */
void drogue_config_default(drogue_config *config);

/* 1 when every threshold is within its range: counts and lengths not negative, fit_error to 1024 px, low <= high,
 * shares of a length or of points in [0, 1] (sizes, inner_gate and inner_size without upper bound),
 * min_size <= max_size, refit_band in (0, 8] px, at most 16 rounds, optics_blur in [0, 16] px and its uncertainty in
 * [0, 16] px^2, outline_shading in (0, 1024], inner_std in (0, 16] px, k1 in [0, 64], k2 in [0, 1). */
int drogue_config_valid(const drogue_config *config);

/* What stays the same from frame to frame, made once and passed from stage to stage. */
typedef struct drogue_setup {
    const drogue_camera *camera; /* whose images these are */
    const drogue_model *model;   /* of the drogue looked for */
    const drogue_config *config; /* thresholds */
} drogue_setup;

#ifdef __cplusplus
}
#endif
#endif
