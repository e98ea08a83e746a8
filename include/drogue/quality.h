/* SPDX-License-Identifier: Apache-2.0 */
/* How much a fitted ellipse is to be believed: paper (10)-(15). */
#ifndef DROGUE_QUALITY_H
#define DROGUE_QUALITY_H

#include "drogue/config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The ellipse F = 0 in the form that points are tested with; c, s are cosine and sine of its angle. */
typedef struct drogue_ellipse_frame {
    drogue_q16 xc_px_q16;    /* centre */
    drogue_q16 yc_px_q16;    /* centre, downward */
    drogue_q16 b_px_q16;     /* semi-minor axis */
    int32_t half_over_b_q31; /* 1 / (2 b), 1/px */
    int32_t xx_q30;          /* b times the matrix of F's quadratic part, 1/px */
    int32_t xy_q30;          /* 1/px */
    int32_t yy_q30;          /* 1/px */
    int32_t cos_over_a_q30;  /* 1/px */
    int32_t sin_over_a_q30;  /* 1/px */
    int32_t cos_over_b_q30;  /* 1/px */
    int32_t sin_over_b_q30;  /* 1/px */
    int32_t cos_q14;         /* c */
    int32_t sin_q14;         /* s */
    int32_t cos_ratio_q14;   /* c * b / a */
    int32_t sin_ratio_q14;   /* s * b / a */
} drogue_ellipse_frame;

/* Prepare an ellipse for point tests.
 *
 *  return  DROGUE_OK; DROGUE_E_DOMAIN when b < 1 px, a < b, a coordinate of the centre is 2^14 px or more, or the angle
 *          beyond pi / 2
 */
drogue_status drogue_ellipse_frame_of(drogue_ellipse_frame *out, const drogue_ellipse *ellipse);

/* Coordinates of a point in units of the semi-axes: on the ellipse u^2 + v^2 = 1. Q24, saturated at +-16. */
void drogue_ellipse_frame_point(int32_t *u_q24, int32_t *v_q24, const drogue_ellipse_frame *frame, drogue_q16 x_px_q16,
                                drogue_q16 y_px_q16);

/* |X + Y - 1| of (10) at a point, Q16, saturated. */
drogue_q16 drogue_ellipse_deviation(const drogue_ellipse_frame *frame, drogue_q16 x_px_q16, drogue_q16 y_px_q16);

/* Which edge points belong to an outline: near it, with a gradient along its normal. */
typedef struct drogue_band {
    drogue_q16 half_width_px_q16; /* largest first-order distance |F| / |grad F| */
    int32_t width2_px2_q24;       /* its square */
    uint32_t cos2_q10;            /* squared least cosine of the angle between gradient and normal, either way */
} drogue_band;

/* Band of a half width in (0, 8] px and a least cosine in [0, 1]. */
drogue_band drogue_band_of(drogue_q16 half_width_px_q16, drogue_q16 cos_q16);

/* Threshold Th_error of (10) that stands for a distance of fit_error pixels from the ellipse: 2 * fit_error / a,
 * Q16. */
drogue_q16 drogue_quality_threshold(const drogue_ellipse *ellipse, drogue_q16 fit_error_px_q16);

/* Circumference by Ramanujan's formula pi (3(a+b) - sqrt((3a+b)(a+3b))), px Q16, saturated; a + b < 2^13 px. */
drogue_q16 drogue_ellipse_circumference(const drogue_ellipse *ellipse);

/* Scores of a fit. */
typedef struct drogue_quality {
    drogue_q16 fit_ratio_q16;    /* phi (11), [0, 1] */
    drogue_q16 length_ratio_q16; /* l_r (12), clamped to [0, 1] */
    drogue_q16 axis_ratio_q16;   /* s_r (13), [0, 1] */
    drogue_q16 score_q16;        /* S (14), [0, 1] */
    drogue_q16 reliability_q16;  /* S_reliable (15), [0, 1] */
} drogue_quality;

/* Score an ellipse from counts.
 *
 *  near_count  points that meet (10)
 *  total       points that were fitted, >= 1
 *  source      (11)-(15); the axis-ratio score is 0 below k2
 *  error       <= 2 LSB
 */
void drogue_quality_score(drogue_quality *out, const drogue_ellipse *ellipse, uint32_t near_count, uint32_t total,
                          const drogue_quality_config *config);

/* phi (11): the share of the points that were fitted, total >= 1, that meet (10). Q16, [0, 1]. */
drogue_q16 drogue_quality_fit_ratio(uint32_t near_count, uint32_t total);

/* Score an ellipse from phi and, in place of l_r (12), the share of its circumference that edge points cover; both in
 * [0, 1]. */
void drogue_quality_of_cover(drogue_quality *out, const drogue_ellipse *ellipse, drogue_q16 fit_ratio_q16,
                             drogue_q16 cover_q16, const drogue_quality_config *config);

#ifdef __cplusplus
}
#endif
#endif
