/* SPDX-License-Identifier: Apache-2.0 */
/* Canny's non-maximum suppression and double threshold; subpixel offset across the edge. */
#include "drogue/canny.h"

int32_t drogue_canny_offset_q5(int32_t before, int32_t m, int32_t after)
{
    drogue_canny_vertex v = drogue_canny_vertex_begin(before, m, after);
    DROGUE_NOTE("canny: offset numerator", v.rest, 18);
    if (v.curvature > 0 && v.rest > 0) { /* one division; the steps are for hardware without one */
        const uint32_t quotient = (uint32_t)v.rest / (2u * (uint32_t)v.curvature);
        v.quotient = quotient < 31u ? (int32_t)quotient : 31;
    }
    return drogue_canny_vertex_offset(&v);
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
