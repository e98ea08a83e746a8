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

/* What the ring leaves to the columns of one row: bounds of (2x - centre2_x)^2. */
typedef struct drogue_ring_row {
    int64_t least_x9;  /* nine times the least one */
    int64_t most;      /* the largest one */
    int32_t centre2_x; /* of the mask */
} drogue_ring_row;

/* Ring: longest / 3 <= distance <= longest / 2 (paper, section III-A-1). */
static inline drogue_ring_row drogue_mask_ring_row(const drogue_mask *mask, int32_t y)
{
    int64_t side2 = (int64_t)mask->longest_px * mask->longest_px;
    int64_t dy = 2 * (int64_t)y - mask->centre2_y;
    drogue_ring_row row;
    row.least_x9 = 4 * side2 - 9 * dy * dy;
    row.most = side2 - dy * dy;
    row.centre2_x = mask->centre2_x;
    return row;
}

/* Is the column whose (2x - centre2_x)^2 is d in the ring? */
static inline int drogue_ring_row_holds_square(const drogue_ring_row *row, int64_t d)
{
    return (9 * d >= row->least_x9) & (d <= row->most);
}

/* x in [-2^29, 2^29]. */
static inline int drogue_ring_row_holds(const drogue_ring_row *row, int32_t x)
{
    const int32_t dx = 2 * x - row->centre2_x;
    return drogue_ring_row_holds_square(row, (int64_t)dx * dx);
}

/* Is a pixel in the ring?  x as above, y in [-2^29, 2^29]. */
static inline int drogue_mask_in_ring(const drogue_mask *mask, int32_t x, int32_t y)
{
    drogue_ring_row row = drogue_mask_ring_row(mask, y);
    return drogue_ring_row_holds(&row, x);
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
