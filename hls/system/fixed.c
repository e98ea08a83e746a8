/* SPDX-License-Identifier: Apache-2.0 */
/* The square root of a whole number by the unit beside the soft core, in the place of the library's function, and what gcc calls
 * for a quotient of 64 bits. */
#include "drogue/fixed.h"

#include "unit.h"

int64_t __divdi3(int64_t a, int64_t b);
uint64_t __udivdi3(uint64_t a, uint64_t b);

uint32_t drogue_isqrt_u64(uint64_t v)
{
    uint32_t root;
    UNIT(root, UNIT_ROOT, 0, (uint32_t)v, (uint32_t)(v >> 32));
    return root;
}

uint64_t __udivdi3(uint64_t a, uint64_t b)
{
    uint32_t low;
    uint32_t high;
    UNIT(low, UNIT_DIVISOR, 0, (uint32_t)b, (uint32_t)(b >> 32));
    UNIT(low, UNIT_DIVIDE, 0, (uint32_t)a, (uint32_t)(a >> 32));
    UNIT(high, UNIT_EXPONENT, 0, 0, 0);
    return (uint64_t)high << 32 | low;
}

int64_t __divdi3(int64_t a, int64_t b)
{
    const uint64_t q = __udivdi3(drogue_abs_u64(a), drogue_abs_u64(b));
    return (int64_t)((a ^ b) < 0 ? -q : q);
}
