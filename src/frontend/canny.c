/* SPDX-License-Identifier: Apache-2.0 */
/* What is noted of a maximum: its offset across the edge, its code. */
#include "rows.h"

uint8_t drogue_rows_place(drogue_slope *at, const drogue_frontend *f, drogue_sector sector, int32_t before, int32_t m,
                          int32_t after)
{
    const int32_t offset_q5 = drogue_canny_offset_q5(before, m, after);
    const uint32_t strong = m > f->config.canny_high ? DROGUE_CODE_STRONG : 0u;
    const uint32_t key = (drogue_direction_class(at->gx, at->gy) + 1u) << DROGUE_CODE_CLASS_SHIFT;
    at->dx_q5 = (int8_t)(drogue_canny_step_x(sector) * offset_q5);
    at->dy_q5 = (int8_t)(drogue_canny_step_y(sector) * offset_q5);
    return (uint8_t)(DROGUE_CODE_CANDIDATE | strong | key);
}
