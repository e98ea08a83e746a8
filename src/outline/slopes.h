/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the outline stage: slopes across an edge, the sum of those of some rays, half a pixel apart; its place as the
 * front end sees it and sharpened, and its width. */
#ifndef DROGUE_SLOPES_H
#define DROGUE_SLOPES_H

#include <stdint.h>

#define DROGUE_SLOPE_MIDDLE 11                                           /* the slope on the ellipse */
#define DROGUE_SLOPES (2 * DROGUE_SLOPE_MIDDLE + 1)                      /* inside first */
#define DROGUE_SLOPE_NEAR 2                                              /* so near the ellipse lies its edge */
#define DROGUE_SLOPE_FIRST (DROGUE_SLOPE_MIDDLE - DROGUE_SLOPE_NEAR - 2) /* looked at, blurred */
#define DROGUE_SLOPE_LAST (DROGUE_SLOPE_MIDDLE + DROGUE_SLOPE_NEAR + 2)
#define DROGUE_SLOPE_GAIN 738 /* of the front end's blur of them: the sum of its weights, 128 + 2 * 305 */

#define DROGUE_EDGE_GROUPS 8 /* equal parts of the outline whose rays are taken together */

/* An edge as the front end sees it. */
typedef struct drogue_seen_edge {
    int32_t at_q20;           /* its steepest place, slopes; 0: there is none */
    int32_t seen_q20;         /* where the front end finds that */
    int32_t variance_px2_q16; /* drogue_edge_variance() */
} drogue_seen_edge;

/* The edge of some rays near the ellipse. */
void drogue_see_edge(drogue_seen_edge *edge, const int32_t slope[DROGUE_SLOPES]);

/* How far outwards of the sharpened edge the one seen lies, slopes Q20; 0 when there are not both. And what noise makes
 * of it, px Q24, one standard deviation. */
int32_t drogue_edge_moved(int32_t *noise_px_q24, const int32_t slope[DROGUE_SLOPES], const drogue_seen_edge *edge);

/* Is there another edge outside: slopes of either sign that have a peak of 3 grey levels a pixel, and a sixth of what
 * the outline's own edge has?
 *
 *  slope  sums over 8 rays, Q8
 */
int drogue_edge_outside(const int32_t slope[DROGUE_SLOPES]);

/* Variance of an edge's blur, px^2 Q16, from its width: rise over steepest slope, squared, over 8. That is between a
 * Gaussian's, 2 pi, and a box's, 12. At most 32 px^2; 0 without an edge.
 *
 *  slope  as seen, an edge's own slopes positive, each at most 2^20
 *  seen   from DROGUE_SLOPE_FIRST to _LAST the same with the front end's blur
 */
int32_t drogue_edge_variance(const int32_t slope[DROGUE_SLOPES], const int32_t seen[DROGUE_SLOPES]);

#endif
