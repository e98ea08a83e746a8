/* SPDX-License-Identifier: Apache-2.0 */
/* The unit for grey levels along a ray and the peaks of their slope: the library's own functions, of which unit.sh makes
 * Verilog. */
#include "ray_unit.h"

#include "../../src/outline/rays.c"

/* As inside_q8(), the image being a memory whose words come later. */
void ray_unit_place(const ray_place_asked *restrict asked, ray_place_said *restrict out)
{
    const ray_place_asked a = *asked;
    const int32_t x = drogue_clamp_s32(a.x_px_q16, 0, (a.width_px - 1) * DROGUE_Q16_ONE);
    const int32_t y = drogue_clamp_s32(a.y_px_q16, 0, (a.height_px - 1) * DROGUE_Q16_ONE);
    const int32_t right = (x & 0xFFFF) > 255;
    const int32_t below = (y & 0xFFFF) > 255 ? a.stride : 0;
    const int32_t at = a.first + (int32_t)(uint16_t)(y >> 16) * (int32_t)(uint16_t)a.stride + (x >> 16);
    out->at[0] = at;
    out->at[1] = at + right;
    out->at[2] = at + below;
    out->at[3] = at + below + right;
    out->x_px_q16 = x;
    out->y_px_q16 = y;
}

void ray_unit_rows(const ray_rows_asked *restrict asked, ray_rows_said *restrict out)
{
    const ray_rows_asked a = *asked;
    const int32_t part_q8 = part_q8_of(a.x_px_q16);
    out->upper_q8 = row_q8(a.pixels, 1, part_q8);
    out->lower_q8 = row_q8(a.pixels + 2, 1, part_q8);
}

void ray_unit_grey(const ray_grey_asked *restrict asked, ray_grey_said *restrict out)
{
    const ray_grey_asked a = *asked;
    out->grey_q8 = mixed_q8(a.rows.upper_q8, a.rows.lower_q8, part_q8_of(a.y_px_q16));
}

void ray_unit_slope(const ray_slope_asked *restrict asked, ray_slope_said *restrict out)
{
    const ray_slope_asked a = *asked;
    const int32_t sum = sum_of(a.grey_q8);
    const int32_t slope_q8 = sum - a.sum_before;
    out->sum = sum;
    out->slope_q8 = slope_q8;
    out->peak = (uint32_t)is_peak(a.before_q8, a.at_q8, slope_q8, a.least_q8) << RAY_RISES |
                (uint32_t)is_peak(-a.before_q8, -a.at_q8, -slope_q8, a.least_q8) << RAY_FALLS;
}
