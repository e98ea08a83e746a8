/* SPDX-License-Identifier: Apache-2.0 */
/* The disc of a drogue_mask along the pixels of a region: squares of consecutive numbers by their differences, so that
 * no loop has a product on its way. Exact for every valid mask. */
#ifndef DROGUE_HLS_DISC_WALK_H
#define DROGUE_HLS_DISC_WALK_H

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

/* Down the rows, from row 0: 'left' is drogue_mask_disc_row(). */
static inline drogue_hls_walk drogue_hls_walk_rows(const drogue_mask *disc)
{
    return drogue_hls_walk_from(drogue_mask_disc_row(disc, 0), disc->centre2_y);
}

/* Along a row, from column 0: a pixel is in the disc where 'left' is not negative. */
static inline drogue_hls_walk drogue_hls_walk_columns(const drogue_hls_walk *rows, int32_t centre2_x)
{
    return drogue_hls_walk_from(rows->left - 9 * (int64_t)centre2_x * centre2_x, centre2_x);
}

#endif
