/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the inner stage: least squares over rays, for place and size or a plane of grey. */
#ifndef DROGUE_FIT_H
#define DROGUE_FIT_H

#include "drogue/cholesky.h"
#include "drogue/rays.h"

#define RAYS DROGUE_RAYS
#define BINS (RAYS / 4)
#define FEWEST 8 /* rays that determine place and size with something to spare */

/* Sums of least squares over rays, each weighted by its squared slope, as noise asks for. */
typedef struct drogue_ray_sums {
    int64_t normal[6];   /* equations of the offset, packed: entries 0-2 Q28, 3-4 Q14, 5 whole */
    int64_t right[3];    /* Q30, Q30, Q16 */
    int64_t squares_q16; /* of the residuals, not weighted */
    int32_t slopes_q8;   /* of 512 rays, each below 2^20 */
    int32_t levels_q8;
    uint32_t rays;
} drogue_ray_sums;

/* Residuals of four neighbours, of all phases together: they see one edge. */
typedef struct drogue_ray_bins {
    int64_t off_q16[BINS]; /* weighted */
    int32_t weight[BINS];  /* at most 2^16 of 4 rays in 8 phases */
} drogue_ray_bins;

/* Where an offset puts the edge on a ray, within 2^14 px. */
drogue_q16 drogue_ray_along(const drogue_ray *r, const drogue_q16 v_px_q16[3]);

/* Index of the edge that an offset is about: the steeper and the nearer the better; -1 when none is within the
 * tolerance. */
int32_t drogue_ray_chosen(const drogue_ray *r, drogue_q16 expected_px_q16, drogue_q16 within_px_q16);

/* Of the edges on the rays keep those between two places, seen from where an offset puts the edge; NULL: from the
 * ellipse. */
void drogue_rays_keep(drogue_ray rays[RAYS], const drogue_q16 v_px_q16[3], drogue_q16 above_px_q16,
                      drogue_q16 below_px_q16);

/* Add what a ray says: 'off' from what is known. Its weight is at most 255^2. */
void drogue_ray_sums_add(drogue_ray_sums *s, const drogue_ray *r, int32_t weight, int32_t off_q16);

/* Add the edges that agree with an offset: weighted by their slopes, and to bins, where there are bins; all alike where
 * 'bins' is NULL. */
void drogue_ray_sums_add_edges(drogue_ray_sums *s, drogue_ray_bins *bins, const drogue_ray rays[RAYS],
                               const drogue_q16 v_px_q16[3], drogue_q16 within_px_q16);

/* Solve for the offset: 'size' 0 leaves the size as it is. 'normal' becomes the root of the normal equations. 0 when
 * there are too few rays. */
int drogue_ray_sums_solve(drogue_q16 v_px_q16[3], drogue_real normal[6], const drogue_ray_sums *s, int size);

/* Solve for place and size, and say how far off the place may be, by the residuals of the bins. 0 when there are too
 * few rays or bins. */
int drogue_ray_sums_place(drogue_q16 v_px_q16[3], drogue_q16 *std_px_q16, const drogue_ray_sums *s,
                          const drogue_ray_bins *bins);

/* From all edges within the gate to those about one place: place alone, then, where 'size' says so, with its size. 0
 * where too few are left. */
int drogue_ray_sums_settle(drogue_ray_sums *s, drogue_q16 v_px_q16[3], const drogue_ray rays[RAYS],
                           drogue_q16 gate_px_q16, drogue_q16 last_px_q16, int size);

/* Root mean square of the residuals. */
drogue_q16 drogue_ray_sums_rms(const drogue_ray_sums *s);

static inline drogue_q16 larger(drogue_q16 a, drogue_q16 b) { return a > b ? a : b; }

#endif
