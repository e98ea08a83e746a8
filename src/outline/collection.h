/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the outline stage: from edge points collected about an ellipse to the ellipse that they give. */
#ifndef DROGUE_COLLECTION_H
#define DROGUE_COLLECTION_H

#include "drogue/config.h"
#include "near.h"

/* An empty collection of edge points of a region, about the middle of the largest one: exact. */
void drogue_collection_of_region(drogue_collection *c);

/* Begin a collection of points that reach this far from a centre: the finest unit in which they fit 16 bits. The origin
 * is a whole pixel: edge points, multiples of 1/32 px, are then exact, where any other would shift them all alike. */
void drogue_collection_begin(drogue_collection *c, const drogue_ellipse *e, int64_t reach_px_q16);

/* Fit the points of a collection. As drogue_ellipse_fit(). */
drogue_status drogue_collection_fit(drogue_ellipse *out, const drogue_collection *c);

/* Shift an ellipse along its axes; its centre saturates. */
void drogue_ellipse_shift(drogue_ellipse *e, drogue_q16 along_px_q16, drogue_q16 across_px_q16);

/* Put back what blur takes: an edge of curvature c under blur of variance v shows v c / 2 further in. The front end's
 * own share of v / 2 is measured on discs of 20 to 160 px. Curvature is a / b^2 at the ends of the major axis, b / a^2
 * at those of the minor. */
void drogue_undo_blur(drogue_ellipse *e, const drogue_config *config);

/* Has a refit moved an ellipse by less than 1/64 px? */
int drogue_ellipse_settled(const drogue_ellipse *p, const drogue_ellipse *q);

/* Band for the next round: three times the spread of the points about the ellipse, from a third of the configured width
 * to the last one: what stands out of the outline, as a hose or a fitting behind the rim, drops out. */
void drogue_band_narrow(drogue_band *band, const drogue_support *support, const drogue_ellipse *e,
                        const drogue_config *config);

/* Is an ellipse round enough to be the drogue's? */
static inline int drogue_round_enough(const drogue_ellipse *e, const drogue_config *config)
{
    return (int64_t)e->b_px_q16 * DROGUE_Q16_ONE >= (int64_t)e->a_px_q16 * config->min_axis_ratio_q16;
}

#endif
