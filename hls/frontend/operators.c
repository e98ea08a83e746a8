/* SPDX-License-Identifier: Apache-2.0 */
/* The pure operators of the pixel loop. */
#include "operators.h"

#include "drogue/canny.h"
#include "drogue/gradient.h"
#include "drogue/label.h"
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

uint32_t drogue_hls_suppress(uint16_t t0, uint16_t t1, uint16_t t2, uint16_t c0, uint16_t c1, uint16_t c2, uint16_t b0,
                             uint16_t b1, uint16_t b2, uint32_t gradient, uint16_t low, uint16_t high)
{
    const int16_t gx = (int16_t)(uint16_t)(gradient & 0xFFFFu);
    const int16_t gy = (int16_t)(uint16_t)(gradient >> 16);
    const drogue_sector sector = drogue_canny_sector(gx, gy);
    const int32_t before = sector == DROGUE_SECTOR_HORIZONTAL ? c0
                           : sector == DROGUE_SECTOR_VERTICAL ? t1
                           : sector == DROGUE_SECTOR_DIAGONAL ? t0
                                                              : t2;
    const int32_t after = sector == DROGUE_SECTOR_HORIZONTAL ? c2
                          : sector == DROGUE_SECTOR_VERTICAL ? b1
                          : sector == DROGUE_SECTOR_DIAGONAL ? b2
                                                             : b0;
    const int32_t offset_q5 = drogue_canny_offset_q5(before, c1, after);
    const uint32_t dx = (uint8_t)(drogue_canny_step_x(sector) * offset_q5);
    const uint32_t dy = (uint8_t)(drogue_canny_step_y(sector) * offset_q5);
    const uint32_t direction = drogue_direction_class(gx, gy) + 1u;
    const uint32_t code = 1u | (c1 > high ? 2u : 0u) | direction << 2 | dx << 8 | dy << 16;
    return c1 > low && drogue_canny_is_maximum(sector, before, c1, after) ? code : 0;
}

uint32_t drogue_hls_in_ring(int32_t x, int32_t centre2_x, int64_t least_x9, int64_t most)
{
    drogue_ring_row row;
    row.least_x9 = least_x9;
    row.most = most;
    row.centre2_x = centre2_x;
    return (uint32_t)drogue_ring_row_holds(&row, x);
}

uint64_t drogue_hls_choose_label(uint32_t above, uint32_t left, uint32_t above_left, uint32_t above_right)
{
    uint32_t merge_with;
    const uint32_t label = drogue_label_choose(&merge_with, above, left, above_left, above_right);
    return label | (uint64_t)merge_with << 32;
}
