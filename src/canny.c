/* SPDX-License-Identifier: Apache-2.0 */
/* Canny's non-maximum suppression and double threshold; subpixel offset across the edge. */
#include "drogue/canny.h"

int32_t drogue_canny_offset_q5(int32_t before, int32_t m, int32_t after)
{
    int32_t curvature = 2 * m - before - after;
    int32_t slope = after - before;
    int32_t rest = 32 * slope + 33 * curvature; /* floor(rest / (2 curvature)) - 16 rounds 16 slope / curvature */
    int32_t offset = -16;
    int32_t bit;
    DROGUE_NOTE("canny: offset numerator", rest, 18);
    for (bit = 4; bit >= 0; bit--) { /* a division whose quotient is in [0, 32) */
        const int32_t part = curvature * (2 << bit);
        const int32_t fits = rest >= part;
        rest -= fits ? part : 0;
        offset += fits ? 1 << bit : 0;
    }
    offset = offset < -15 || slope <= -curvature ? -15 : slope >= curvature ? 15 : offset; /* 16 and more */
    return curvature <= 0 ? 0 : offset;
}

void drogue_canny_row(uint8_t *out, const uint16_t *const magnitude[3], const int16_t *gx, const int16_t *gy,
                      int32_t width_px, int32_t low, int32_t high)
{
    int32_t x;
    for (x = 0; x < width_px; x++) {
        int32_t m = magnitude[1][x];
        int32_t before;
        int32_t after;
        drogue_sector sector;
        out[x] = DROGUE_CANNY_NONE;
        if (m <= low) {
            continue;
        }
        sector = drogue_canny_sector(gx[x], gy[x]);
        drogue_canny_neighbours(&before, &after, sector, magnitude, x, width_px);
        if (drogue_canny_is_maximum(sector, before, m, after)) {
            out[x] = m > high ? DROGUE_CANNY_STRONG : DROGUE_CANNY_WEAK;
        }
    }
}
