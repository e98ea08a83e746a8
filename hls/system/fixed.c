/* SPDX-License-Identifier: Apache-2.0 */
/* The square root of a whole number by the unit beside the soft core, in the place of the library's function. */
#include "drogue/fixed.h"

#include "unit.h"

uint32_t drogue_isqrt_u64(uint64_t v)
{
    uint32_t root;
    UNIT(root, UNIT_ROOT, 0, (uint32_t)v, (uint32_t)(v >> 32));
    return root;
}
