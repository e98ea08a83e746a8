/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the outline stage: edge points near an ellipse, counted, and collected for a fit. Hardware takes its own form of
 * these functions and of drogue_support_count(), hls/outline/near.c. */
#ifndef DROGUE_NEAR_H
#define DROGUE_NEAR_H

#include "drogue/ellipse.h"
#include "drogue/support.h"
#include "drogue/undistort.h"

/* Moments of the points, 1 / 2^frac_bits px from the origin. */
typedef struct drogue_collection {
    drogue_moments moments;
    drogue_q16 x_px_q16; /* origin of the moments */
    drogue_q16 y_px_q16;
    int frac_bits; /* 0 .. 10 */
} drogue_collection;

/* A lens, and the region's first pixel in the image that it distorts. */
typedef struct drogue_region_lens {
    const drogue_camera *camera;
    drogue_q16 x_px_q16;
    drogue_q16 y_px_q16;
} drogue_region_lens;

/* How many of an arc's edge points lie nearer to the ellipse than a threshold of (10); count >= 1. */
uint32_t drogue_near_count(const drogue_ellipse_frame *frame, drogue_q16 threshold, const drogue_edge *edges,
                           uint32_t count);

/* Collect the edge points within a band, and add them to the ellipse's support: those that have their bin's polarity,
 * without the distortion of a lens where one is given, and within 16 bits of the origin.
 *
 *  count  >= 1
 *  lens   NULL: none
 */
void drogue_collect_edges(drogue_collection *c, drogue_support *support, const drogue_ellipse_frame *frame,
                          const drogue_band *band, const drogue_edge *edges, uint32_t count,
                          const drogue_region_lens *lens);

/* Offset in the fit's unit, rounded; beyond 16 bits where a - b leaves 32. */
static inline int32_t in_unit(drogue_q16 a, drogue_q16 b, int frac_bits)
{
    const int64_t d = (int64_t)a - b;
    const int32_t low = (int32_t)d;
    return low == d ? (low >> (16 - frac_bits)) + ((low >> (15 - frac_bits)) & 1) : INT32_MAX;
}

static inline int fits_16(int32_t v) { return v >= INT16_MIN && v <= INT16_MAX; }

/* Add a point at x, y in the fit's unit where held is 1, if it fits. Without a branch. */
static inline void collect_point(drogue_moments *m, uint32_t held, int32_t x, int32_t y)
{
    const int take = (held != 0) & (m->n < DROGUE_MAX_FIT_POINTS) & fits_16(x) & fits_16(y);
    const int64_t n = m->n + take;
    drogue_moments_add_point(m, take ? x : 0, take ? y : 0); /* (0, 0) adds nothing but itself */
    m->n = n;
}

/* Where a lens has put an edge point, put right; 0 where that cannot be. */
static inline int undistort_edge(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, const drogue_region_lens *lens)
{
    *x_px_q16 = drogue_q16_add(*x_px_q16, lens->x_px_q16);
    *y_px_q16 = drogue_q16_add(*y_px_q16, lens->y_px_q16);
    return drogue_undistort_point(x_px_q16, y_px_q16, lens->camera) == DROGUE_OK;
}

#endif
