/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the outline stage: slopes across an edge, the sum of those of some rays, half a pixel apart. */
#ifndef DROGUE_SLOPES_H
#define DROGUE_SLOPES_H

#include <stdint.h>

#define DROGUE_SLOPE_MIDDLE 11                                           /* the slope on the ellipse */
#define DROGUE_SLOPES (2 * DROGUE_SLOPE_MIDDLE + 1)                      /* inside first */
#define DROGUE_SLOPE_NEAR 3                                              /* so near the ellipse lies its edge */
#define DROGUE_SLOPE_FIRST (DROGUE_SLOPE_MIDDLE - DROGUE_SLOPE_NEAR - 1) /* looked at, blurred */
#define DROGUE_SLOPE_LAST (DROGUE_SLOPE_MIDDLE + DROGUE_SLOPE_NEAR + 1)
#define DROGUE_SLOPE_GAIN 738 /* of the front end's blur of them */

#define DROGUE_EDGE_GROUPS 8 /* equal parts of the outline whose rays are taken together */

/* Variance of an edge's blur, px^2 Q16, from its width: rise over steepest slope, squared, over 8. That is between a
 * Gaussian's, 2 pi, and a box's, 12. At most 32 px^2; 0 without an edge.
 *
 *  slope  as seen, an edge's own slopes positive, each at most 2^20
 *  seen   from DROGUE_SLOPE_FIRST to _LAST the same with the front end's blur
 */
int32_t drogue_edge_variance(const int32_t slope[DROGUE_SLOPES], const int32_t seen[DROGUE_SLOPES]);

/* Motion blur, from the variances round the outline: what they have of a wave of twice the angle, less
 * half a px^2 and what one of four times the angle shows in eight groups.
 *
 *  smear     variance along the motion less that across it, px^2 Q16, times cosine and sine of twice the angle from the
 *            major axis; 0 where it is less than what is no motion's, or where two opposite groups have no edge
 *  variance  px^2 Q16, of equal parts of the outline from the major axis's end towards +v
 */
void drogue_find_smear(int32_t smear_px2_q16[2], const int32_t variance_px2_q16[DROGUE_EDGE_GROUPS]);

#endif
