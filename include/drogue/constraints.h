/* SPDX-License-Identifier: Apache-2.0 */
/* Which arcs can belong to the end plane's outline: length, straightness, position (paper (4)-(6)), and the
 * farthest of them in each quadrant (Algorithm 1). */
#ifndef DROGUE_CONSTRAINTS_H
#define DROGUE_CONSTRAINTS_H

#include "drogue/frontend.h"
#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_HULL_MAX 576 /* vertices of a strictly convex lattice polygon in 2048 x 2048: at most 569 */

/* Point of a convex hull, whole pixels. */
typedef struct drogue_point {
    int32_t x; /* column */
    int32_t y; /* row, downward */
} drogue_point;

typedef char drogue_assume_hull_fits[DROGUE_HULL_MAX * sizeof(drogue_point) <= DROGUE_SCRATCH_BYTES ? 1 : -1];

/* Smallest rotated rectangle around an arc's pixels. */
typedef struct drogue_min_rect {
    drogue_q16 xc_px_q16;    /* centre, region coordinates */
    drogue_q16 yc_px_q16;    /* downward */
    drogue_q16 short_px_q16; /* short side, between pixel centres */
    drogue_q16 long_px_q16;  /* long side, the same way */
} drogue_min_rect;

/* Smallest-area bounding rectangle by rotating calipers on the convex hull, exact up to the final rounding.
 *
 *  out     rectangle; of equal areas the one on the hull edge met first wins: clockwise as seen, from the
 *          top left point
 *  hull    work area, DROGUE_HULL_MAX points
 *  edges   count points in raster order (as an arc's are); whole-pixel positions count
 *  count   >= 1
 *  return  DROGUE_OK, DROGUE_E_ARGUMENT
 *  error   <= 1 LSB
 */
drogue_status drogue_min_area_rect(drogue_min_rect *out, drogue_point *hull, const drogue_edge *edges, uint32_t count);

/* Quadrant 0..3 (I upper right, II upper left, III lower left, IV lower right) of a point about a centre, -1 on
 * an axis (6). Coordinates px Q16, y downward. */
int drogue_quadrant(drogue_q16 dx_px_q16, drogue_q16 dy_px_q16);

/* Verdict on one arc. */
typedef struct drogue_arc_verdict {
    drogue_min_rect rect;     /* about the arc */
    int32_t quadrant;         /* of the rectangle's centre about the mask's centre, -1: rejected */
    drogue_polarity polarity; /* DARK: the direction class equals the quadrant; BRIGHT: is opposite; BOTH: neither */
    int64_t distance2_q32;    /* squared distance of the rectangle's centre from the mask's centre, px^2 Q32 */
} drogue_arc_verdict;

/* Judge one arc by straightness and position; its length was judged when it entered the arc table.
 *
 *  out           verdict; quadrant is -1 when the arc is rejected
 *  mask          centre of the region
 *  min_short     least short side of the rectangle, px Q16 (Th_minb)
 */
void drogue_judge_arc(drogue_arc_verdict *out, drogue_point *hull, const drogue_edge *edges, const drogue_arc *arc,
                      const drogue_mask *mask, drogue_q16 min_short_px_q16);

#define DROGUE_ARC_CHOICES 2 /* arcs kept per quadrant */

/* Arcs that may be the outline's, by quadrant: indices into the arc table, or DROGUE_NO_ARC. */
typedef struct drogue_arc_choices {
    uint32_t arc[4][DROGUE_ARC_CHOICES]; /* the better choice first */
} drogue_arc_choices;

/* Select arcs of each quadrant: first the farthest of those, among the four longest, with at least half as many points
 * as the longest (Algorithm 1 takes the farthest whatever its length, so that stubs beyond the outline beat it), then
 * the longest of the others. The first of equals wins.
 *
 *  polarity  DARK or BRIGHT: only arcs of that polarity; BOTH: of either
 *  return    DROGUE_OK; DROGUE_E_NO_ARCS when no arc is acceptable
 */
drogue_status drogue_select_arcs(drogue_arc_choices *out, drogue_point *hull, const drogue_edge *edges,
                                 const drogue_arc *arcs, uint32_t arc_count, const drogue_mask *mask,
                                 drogue_q16 min_short_px_q16, drogue_polarity polarity);

#ifdef __cplusplus
}
#endif
#endif
