/* SPDX-License-Identifier: Apache-2.0 */
/* The ring mask's columns, by the roots of what a row leaves to them. */
#include "drogue/mask.h"

void drogue_mask_columns(drogue_columns *out, const drogue_mask *mask, int32_t y, int32_t width_px)
{
    const int64_t side2 = (int64_t)mask->longest_px * mask->longest_px;
    const int64_t dy = 2 * (int64_t)y - mask->centre2_y;
    int64_t square = side2;
    int32_t at[4]; /* where the disc begins, its hole, where the hole ends, the disc */
    int32_t begin = 0;
    int32_t end = width_px;
    int32_t k;
    /* columns with (2x - centre2_x)^2 + dy^2 <= square, among those before; none are at their end */
    for (k = 0; k < 2; k++) {
        int32_t from = end;
        int32_t to = end;
        if (square >= dy * dy) {
            const int32_t half = (int32_t)drogue_isqrt_u64((uint64_t)(square - dy * dy));
            from = (mask->centre2_x - half + 1) >> 1;
            to = ((mask->centre2_x + half) >> 1) + 1;
        }
        begin = drogue_clamp_s32(from, begin, end);
        end = drogue_clamp_s32(to, begin, end);
        at[k] = begin;
        at[3 - k] = end;
        square = (4 * side2 - 1) / 9;
    }
    out->begin[0] = (uint16_t)at[0];
    out->end[0] = (uint16_t)at[1];
    out->begin[1] = (uint16_t)at[2];
    out->end[1] = (uint16_t)at[3];
}
