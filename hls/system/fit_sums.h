/* SPDX-License-Identifier: Apache-2.0 */
/* What the unit for least squares over rays has summed up, beside which the soft core's own sums stand. */
#ifndef DROGUE_SYSTEM_FIT_SUMS_H
#define DROGUE_SYSTEM_FIT_SUMS_H

#include "../../src/inner/fit.h"
#include "unit.h"

static inline int64_t sum_of_unit(void)
{
    uint32_t low;
    uint32_t high;
    UNIT(low, UNIT_FIT_SUMS, 0, 0, 0);
    UNIT(high, UNIT_FIT_SUMS, 0, 0, 0);
    return (int64_t)((uint64_t)high << 32 | low);
}

/* Add the unit's sums; each ray weighs 1. */
static inline void add_sums_of_unit(drogue_ray_sums *s)
{
    uint32_t count;
    int k;
    for (k = 0; k < 5; k++) {
        s->normal[k] += sum_of_unit();
    }
    for (k = 0; k < 3; k++) {
        s->right[k] += sum_of_unit();
    }
    s->squares_q16 += sum_of_unit();
    UNIT(count, UNIT_FIT_SUMS, 0, 0, 0);
    s->normal[5] += count;
    s->rays += count;
}

#endif
