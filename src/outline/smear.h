/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the outline stage: motion blur, from how wide the outline's edge is on which side, and where such edges
 * are. */
#ifndef DROGUE_SMEAR_H
#define DROGUE_SMEAR_H

#include "slopes.h"

#define DROGUE_SMEARED_MIDDLE 48 /* the slope on the ellipse: more than others reach inwards */
#define DROGUE_SMEARED_SLOPES 64

/* Motion blur, from the variances round the outline: what they have of a wave of twice the angle, less
 * half a px^2 and what one of four times the angle shows in eight groups.
 *
 *  smear     variance along the motion less that across it, px^2 Q16, times cosine and sine of twice the angle from the
 *            major axis; 0 where it is less than what is no motion's, or where two opposite groups have no edge
 *  variance  px^2 Q16, of equal parts of the outline from the major axis's end towards +v
 */
void drogue_find_smear(int32_t smear_px2_q16[2], const int32_t variance_px2_q16[DROGUE_EDGE_GROUPS]);

/* An edge that motion blurs, as its slopes: as wide as the motion across it, or as the bright band that it ends where
 * that is narrower. All in half pixels, Q16. */
typedef struct drogue_lobe {
    int32_t at_q16;      /* its middle, from the ellipse outwards */
    int32_t width_q16;   /* at half its height; 0: there is none */
    int32_t farther_q16; /* so far inwards is the middle of the band's other edge; 0: none is seen within 15 px */
} drogue_lobe;

/* The lobe of the steepest slope within 3 px of the ellipse, from where slopes are half of that to where they are
 * again, and of the steepest opposite slope within 18 px inwards of it, if a third as steep.
 *
 *  slope  an edge's own positive, each at most 2^20
 */
void drogue_find_lobe(drogue_lobe *lobe, const int32_t slope[DROGUE_SMEARED_SLOPES]);

/* How far outwards of the true outline the ellipse is by its lobes, half pixels Q16; 0 for a group without one.
 *
 * Motion over a length l across a band of width w makes lobes min(l, w) wide whose middles are max(l, w) apart: of a
 * band that is narrower both edges are seen (l - w) / 2 too far out. Which it is, opposite groups tell, which the same
 * motion blurs, and the width of the band where it is sharpest.
 *
 *  lobe  of equal parts of the outline, in order
 */
void drogue_find_smeared(int32_t moved_q16[DROGUE_EDGE_GROUPS], const drogue_lobe lobe[DROGUE_EDGE_GROUPS]);

#endif
