/* SPDX-License-Identifier: Apache-2.0 */
/* The ring mask's columns, by the roots of what a row leaves to them. */
#include "drogue/mask.h"

#include "drogue/fixed.h"

/* floor(sqrt(v)), v in [0, 2^40], in a few steps from a guess in [0, 2^20] that is near. */
static int32_t root_near(int64_t v, int32_t guess)
{
    const int64_t off = v - drogue_product(guess, guess);
    const int32_t most = 16 * guess;
    int32_t root = guess;
    int32_t rest;
    if ((uint64_t)(off + most) > 2 * (uint32_t)most) {
        return (int32_t)drogue_isqrt_u64((uint64_t)v);
    }
    rest = (int32_t)off;
    while (rest < 0) { /* bound: 16 */
        root--;
        rest += 2 * root + 1;
    }
    while (rest > 2 * root) { /* bound: 8 */
        rest -= 2 * root + 1;
        root++;
    }
    return root;
}

void drogue_ring_chords_of(drogue_ring_chords *out, const drogue_mask *mask)
{
    const int64_t side2 = drogue_product(mask->longest_px, mask->longest_px);
    out->square[0] = side2;
    out->square[1] = (4 * side2 - 1) / 9;
    out->half_px[0] = 0;
    out->half_px[1] = 0;
}

void drogue_mask_columns(drogue_columns *out, drogue_ring_chords *chords, const drogue_mask *mask, int32_t y,
                         int32_t width_px)
{
    const int32_t dy = 2 * y - mask->centre2_y;
    const int64_t dy2 = drogue_product(dy, dy);
    int32_t at[4]; /* where the disc begins, its hole, where the hole ends, the disc */
    int32_t begin = 0;
    int32_t end = width_px;
    int32_t k;
    /* columns with (2x - centre2_x)^2 + dy^2 <= square, among those before; none are at their end */
    for (k = 0; k < 2; k++) {
        int32_t from = end;
        int32_t to = end;
        if (chords->square[k] >= dy2) {
            const int32_t half = root_near(chords->square[k] - dy2, chords->half_px[k]);
            chords->half_px[k] = half;
            from = (mask->centre2_x - half + 1) >> 1;
            to = ((mask->centre2_x + half) >> 1) + 1;
        }
        begin = drogue_clamp_s32(from, begin, end);
        end = drogue_clamp_s32(to, begin, end);
        at[k] = begin;
        at[3 - k] = end;
    }
    out->begin[0] = (uint16_t)at[0];
    out->end[0] = (uint16_t)at[1];
    out->begin[1] = (uint16_t)at[2];
    out->end[1] = (uint16_t)at[3];
}
