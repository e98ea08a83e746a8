/* SPDX-License-Identifier: Apache-2.0 */
/* Subpixel offset across the edge. */
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
