/* SPDX-License-Identifier: Apache-2.0 */
/* Ring mask as integer inequalities on squared distances: where the front end looks for edges. */
#ifndef DROGUE_MASK_H
#define DROGUE_MASK_H

#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Circle family of a region: centre ((w-1)/2, (h-1)/2) and longest side, kept exact by doubling. */
typedef struct drogue_mask {
    int32_t centre2_x;  /* twice the centre, px, [-2^15, 2^15] */
    int32_t centre2_y;  /* the same downward */
    int32_t longest_px; /* longest side of the region, [1, 2^20] */
} drogue_mask;

/* Are the members within their ranges? */
static inline int drogue_mask_valid(const drogue_mask *mask)
{
    const int32_t most = 1 << 15;
    return mask->longest_px >= 1 && mask->longest_px <= (1 << 20) && mask->centre2_x >= -most &&
           mask->centre2_x <= most && mask->centre2_y >= -most && mask->centre2_y <= most;
}

/* Is a pixel in the ring, longest / 3 <= distance <= longest / 2 (paper, section III-A-1)?  x, y in [-2^28, 2^28]. */
static inline int drogue_mask_in_ring(const drogue_mask *mask, int32_t x, int32_t y)
{
    const int64_t side2 = (int64_t)mask->longest_px * mask->longest_px;
    const int64_t dx = 2 * x - mask->centre2_x;
    const int64_t dy = 2 * y - mask->centre2_y;
    const int64_t twice2 = dx * dx + dy * dy;
    return (9 * twice2 >= 4 * side2) & (twice2 <= side2);
}

/* Columns of a row: [begin[0], end[0]), then [begin[1], end[1]); of what is empty both are equal. */
typedef struct drogue_columns {
    uint16_t begin[2]; /* px: the first of each */
    uint16_t end[2];   /* px: behind the last of each */
} drogue_columns;

/* The two circles of a ring, disc and hole, and their chords along the row that was looked at last. */
typedef struct drogue_ring_chords {
    int64_t square[2];  /* largest (2x - centre2_x)^2 + (2y - centre2_y)^2 within */
    int32_t half_px[2]; /* |2x - centre2_x| is at most this; of the last row that met the circle, 0 before */
} drogue_ring_chords;

/* The circles of a valid mask, before its first row. */
void drogue_ring_chords_of(drogue_ring_chords *out, const drogue_mask *mask);

/* Those of a valid mask's ring in row y, on both sides of its hole: exactly where drogue_mask_in_ring() holds.
 *
 *  out       in [0, width_px]
 *  chords    the mask's; its rows come in any order, fastest from one to the next
 *  y         [0, DROGUE_MAX_SIDE)
 *  width_px  [1, DROGUE_MAX_SIDE]
 */
void drogue_mask_columns(drogue_columns *out, drogue_ring_chords *chords, const drogue_mask *mask, int32_t y,
                         int32_t width_px);

/* Mask of a region of its own coordinates, (0, 0) its top-left pixel. */
static inline drogue_mask drogue_mask_of_size(int32_t width_px, int32_t height_px)
{
    drogue_mask m;
    m.centre2_x = width_px - 1;
    m.centre2_y = height_px - 1;
    m.longest_px = width_px > height_px ? width_px : height_px;
    return m;
}

#ifdef __cplusplus
}
#endif
#endif
