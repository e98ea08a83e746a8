/* SPDX-License-Identifier: Apache-2.0 */
/* The disc of a drogue_mask along the pixels of a region: squares of consecutive numbers by their differences, so that
 * no loop has a product on its way. Exact for every valid mask. */
#ifndef DROGUE_HLS_DISC_WALK_H
#define DROGUE_HLS_DISC_WALK_H

#include "drogue/fixed.h"
#include "drogue/mask.h"

/* bound - 9 (2n - centre2)^2 for n = 0, 1, 2, ... */
typedef struct drogue_hls_walk {
    int64_t left;
    int64_t step; /* by how much the next one is less */
} drogue_hls_walk;

static inline drogue_hls_walk drogue_hls_walk_from(int64_t left, int32_t centre2)
{
    drogue_hls_walk w;
    w.left = left;
    w.step = 36 - 36 * (int64_t)centre2;
    return w;
}

static inline void drogue_hls_walk_on(drogue_hls_walk *w)
{
    w->left -= w->step;
    w->step += 72;
}

/* v^2, of a product of 32 bits by 32: a signed one would take 64 by 64 and more than twice the multipliers. */
static inline int64_t drogue_hls_square(int32_t v)
{
    const uint32_t size = (uint32_t)drogue_abs_u64(v);
    return (int64_t)((uint64_t)size * size);
}

/* What the disc's bound leaves to pixel (0, 0): drogue_mask_disc_row() of row 0 without the column's part. From there down
 * the rows with centre2_y, and from each row's along its columns with centre2_x: in the disc where nothing less than 0 is
 * left. */
static inline int64_t drogue_hls_disc_left(const drogue_mask *disc)
{
    return 4 * drogue_hls_square(disc->longest_px) -
           9 * (drogue_hls_square(disc->centre2_x) + drogue_hls_square(disc->centre2_y));
}

#endif
