/* SPDX-License-Identifier: Apache-2.0 */
/* The square root and the quotient of whole numbers by the unit beside the soft core, in the place of the library's functions, and
 * what gcc calls for a quotient of 64 bits. */
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

static inline uint64_t quotient(uint64_t a, uint64_t b)
{
    uint32_t low;
    uint32_t high;
    UNIT(low, UNIT_DIVISOR, 0, (uint32_t)b, (uint32_t)(b >> 32));
    UNIT(low, UNIT_DIVIDE, 0, (uint32_t)a, (uint32_t)(a >> 32));
    UNIT(high, UNIT_EXPONENT, 0, 0, 0);
    return (uint64_t)high << 32 | low;
}

uint64_t __udivdi3(uint64_t a, uint64_t b) { return quotient(a, b); }

int64_t __divdi3(int64_t a, int64_t b)
{
    const uint64_t q = quotient(drogue_abs_u64(a), drogue_abs_u64(b));
    return (int64_t)((a ^ b) < 0 ? -q : q);
}

static inline int64_t floor_of(int64_t num, int64_t den)
{
    const int64_t sign = num >> 63;
    return (int64_t)quotient((uint64_t)(num ^ sign), (uint64_t)den) ^ sign;
}

int64_t drogue_floor_div_s64(int64_t num, int64_t den) { return floor_of(num, den); }

int64_t drogue_div_round_s64(int64_t num, int64_t den) { return floor_of(2 * num + den, 2 * den); }

uint32_t drogue_reciprocal_u32(uint32_t d)
{
    const uint32_t seed = 2 * (uint32_t)quotient(UINT32_MAX, (d + (1u << 14)) >> 15) + 1;
    const uint32_t error = ~(uint32_t)(drogue_product_u32(d, seed) >> 17);
    return (uint32_t)(drogue_product_u32(seed, error) >> 17);
}
