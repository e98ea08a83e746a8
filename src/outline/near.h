/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the outline stage: edge points near an ellipse, counted, and collected for a fit. Hardware takes its own form
 * of these functions, hls/outline/near.c. */
#ifndef DROGUE_NEAR_H
#define DROGUE_NEAR_H

#include "drogue/outline.h"
#include "drogue/undistort.h"

/* A lens, and the region's first pixel in the image that it distorts. */
typedef struct drogue_region_lens {
    const drogue_camera *camera;
    drogue_q16 x_px_q16;
    drogue_q16 y_px_q16;
} drogue_region_lens;

/* How many of an arc's edge points lie nearer to the ellipse than a threshold of (10); count >= 1. */
uint32_t drogue_near_count(const drogue_ellipse_frame *frame, drogue_q16 threshold, const drogue_edge *edges,
                           uint32_t count);

/* Add the points of an arc to moments about the middle of the largest region, unit 1/32 px; they hold all of them. */
void drogue_collect_arc(drogue_moments *moments, const drogue_edge *edges, uint32_t count);

/* Collect the edge points within a band that have their bin's polarity: add them to the ellipse's support, and bring
 * the moments to hold them and no others.
 *
 *  moments  about the middle of the largest region, unit 1/32 px
 *  stride   every stride-th edge point is looked at, >= 1
 *  counted  1: these points are in the moments already, which lose those that are not collected; 0: none is
 */
void drogue_collect_edges(drogue_moments *moments, drogue_support *support, const drogue_ellipse_frame *frame,
                          const drogue_band *band, const drogue_edge *edges, uint32_t count, uint32_t stride,
                          uint32_t counted);

/* Add the same points to a collection, without the distortion of a lens: those within 16 bits of its origin. Returns
 * how many there are, with those that the lens model cannot undo. */
uint32_t drogue_collect_undistorted(drogue_collection *c, drogue_support *support, const drogue_ellipse_frame *frame,
                                    const drogue_band *band, const drogue_edge *edges, uint32_t count,
                                    const drogue_region_lens *lens);

#define DROGUE_MIDDLE_Q5 (DROGUE_MAX_SIDE / 2 * 32) /* makes the coordinates 16-bit for every region */

/* Put an edge point into the moments, or take it out. A bound on how many there are keeps the sums in their words. */
static inline void recount_edge(drogue_moments *m, uint32_t put, uint16_t x_q5, uint16_t y_q5)
{
    if (!put || m->n < DROGUE_MAX_FIT_POINTS) {
        drogue_moments_count_point(m, x_q5 - DROGUE_MIDDLE_Q5, y_q5 - DROGUE_MIDDLE_Q5, put ? 1 : -1);
    }
}

/* Offset in the fit's unit, rounded; beyond 16 bits where a - b leaves 32. */
static inline int32_t in_unit(drogue_q16 a, drogue_q16 b, int frac_bits)
{
    const int64_t d = (int64_t)a - b;
    const int32_t low = (int32_t)d;
    return low == d ? (low >> (16 - frac_bits)) + ((low >> (15 - frac_bits)) & 1) : INT32_MAX;
}

static inline int fits_16(int32_t v) { return v >= INT16_MIN && v <= INT16_MAX; }

/* Add a point, if it fits. */
static inline void collect_point(drogue_collection *c, drogue_q16 x_px_q16, drogue_q16 y_px_q16)
{
    const int32_t x = in_unit(x_px_q16, c->x_px_q16, c->frac_bits);
    const int32_t y = in_unit(y_px_q16, c->y_px_q16, c->frac_bits);
    if (c->moments.n < DROGUE_MAX_FIT_POINTS && fits_16(x) && fits_16(y)) {
        DROGUE_NOTE("outline: point in the fit's unit", x, 16);
        drogue_moments_add_point(&c->moments, x, y);
    }
}

/* Where a lens has put an edge point, put right; 0 where that cannot be. */
static inline int undistort_edge(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, const drogue_region_lens *lens)
{
    *x_px_q16 = drogue_q16_add(*x_px_q16, lens->x_px_q16);
    *y_px_q16 = drogue_q16_add(*y_px_q16, lens->y_px_q16);
    return drogue_undistort_point(x_px_q16, y_px_q16, lens->camera) == DROGUE_OK;
}

#endif
