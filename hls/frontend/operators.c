/* SPDX-License-Identifier: Apache-2.0 */
/* The pure operators of the pixel loop. */
#include "operators.h"

#include "../drogue_hls.h"
#include "drogue/canny.h"
#include "drogue/gradient.h"
#include "drogue/mask.h"
#include "drogue/smooth.h"

uint16_t drogue_hls_smooth_column(uint8_t p0, uint8_t p1, uint8_t p2, uint8_t p3, uint8_t p4)
{
    return (uint16_t)drogue_binomial5(p0, p1, p2, p3, p4);
}

uint8_t drogue_hls_smooth_row(uint16_t c0, uint16_t c1, uint16_t c2, uint16_t c3, uint16_t c4)
{
    return drogue_smooth_normalise(drogue_binomial5(c0, c1, c2, c3, c4));
}

uint32_t drogue_hls_gradient(uint8_t t0, uint8_t t1, uint8_t t2, uint8_t c0, uint8_t c2, uint8_t b0, uint8_t b1,
                             uint8_t b2)
{
    const uint16_t gx = (uint16_t)drogue_sobel_gx(t0, c0, b0, t2, c2, b2);
    const uint16_t gy = (uint16_t)drogue_sobel_gy(t0, t1, t2, b0, b1, b2);
    return gx | (uint32_t)gy << 16;
}

uint16_t drogue_hls_magnitude(uint32_t gradient)
{
    return drogue_magnitude_l1((int16_t)(uint16_t)(gradient & 0xFFFFu), (int16_t)(uint16_t)(gradient >> 16));
}

uint64_t drogue_hls_suppress(uint16_t t0, uint16_t t1, uint16_t t2, uint16_t c0, uint16_t c1, uint16_t c2, uint16_t b0,
                             uint16_t b1, uint16_t b2, uint32_t gradient, uint16_t low, uint16_t high)
{
    const int16_t gx = (int16_t)(uint16_t)(gradient & 0xFFFFu);
    const int16_t gy = (int16_t)(uint16_t)(gradient >> 16);
    const drogue_sector sector = drogue_canny_sector(gx, gy);
    const uint32_t horizontal = drogue_hls_when(sector == DROGUE_SECTOR_HORIZONTAL);
    const uint32_t vertical = drogue_hls_when(sector == DROGUE_SECTOR_VERTICAL);
    const uint32_t diagonal = drogue_hls_when(sector == DROGUE_SECTOR_DIAGONAL);
    const uint32_t antidiagonal = drogue_hls_when(sector == DROGUE_SECTOR_ANTIDIAGONAL);
    const uint32_t before = (c0 & horizontal) | (t1 & vertical) | (t0 & diagonal) | (t2 & antidiagonal);
    const uint32_t after = (c2 & horizontal) | (b1 & vertical) | (b2 & diagonal) | (b0 & antidiagonal);
    const uint32_t code = 1u | (uint32_t)(c1 > high) << 1 | (drogue_direction_class(gx, gy) + 1u) << 2;
    const int kept = (c1 > low) & drogue_canny_is_maximum(sector, (int32_t)before, c1, (int32_t)after);
    return (code & drogue_hls_when(kept)) | (uint32_t)sector << 6 | (uint64_t)before << 16 | (uint64_t)c1 << 32 |
           (uint64_t)after << 48;
}

uint32_t drogue_hls_locate(uint64_t suppressed)
{
    const drogue_sector sector = (drogue_sector)(suppressed >> 6 & 3u);
    const int32_t offset_q5 = drogue_canny_offset_q5(
        (int32_t)(suppressed >> 16 & 0xFFFFu), (int32_t)(suppressed >> 32 & 0xFFFFu), (int32_t)(suppressed >> 48));
    /* drogue_canny_step_x(), _y() times the offset, without a multiplier at the end of the chain */
    const int32_t sideways = sector == DROGUE_SECTOR_ANTIDIAGONAL ? -offset_q5 : offset_q5;
    const uint32_t dx = (uint8_t)(sector == DROGUE_SECTOR_VERTICAL ? 0 : sideways);
    const uint32_t dy = (uint8_t)(sector == DROGUE_SECTOR_HORIZONTAL ? 0 : offset_q5);
    return (uint32_t)(suppressed & 0x1Fu) | dx << 8 | dy << 16;
}

uint32_t drogue_hls_in_ring(int32_t x, int32_t centre2_x, int64_t least_x9, int64_t most)
{
    drogue_ring_row row;
    row.least_x9 = least_x9;
    row.most = most;
    row.centre2_x = centre2_x;
    return (uint32_t)drogue_ring_row_holds(&row, x);
}
