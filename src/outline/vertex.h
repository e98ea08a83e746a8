/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the outline stage: the vertex of a parabola. */
#ifndef DROGUE_VERTEX_H
#define DROGUE_VERTEX_H

#include "drogue/fixed.h"

/* Where a curve is highest, by the parabola through three values a step apart: the middle one is above the one before
 * and no lower than the one after.
 *
 *  half    half a step, in the unit of the result
 *  return  from the middle one towards the one after, at most half a step either way
 */
static inline int32_t drogue_vertex(int32_t before, int32_t middle, int32_t after, int32_t half)
{
    const int64_t bend = 2 * (int64_t)middle - before - after; /* > 0 */
    return (int32_t)drogue_div_round_s64(((int64_t)after - before) * half, bend);
}

#endif
