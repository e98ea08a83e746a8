/* SPDX-License-Identifier: Apache-2.0 */
/* The arithmetic as compilers for hardware and for Armv6-M take it: in C alone what others have an instruction for. */
#include "suite.h"

#define __SYNTHESIS__
#define __ARM_ARCH_6M__
#include "src/arithmetic/fixed.c"

START_TEST(leading_zeros)
{
    uint64_t rng = 1;
    int n, i;
    ck_assert_int_eq(drogue_clz_u32(0), 32);
    ck_assert_int_eq(drogue_clz_u64(0), 64);
    for (n = 0; n < 32; n++) {
        const uint32_t top = UINT32_C(0x80000000) >> n;
        MUST(drogue_clz_u32(top) == n && drogue_clz_u32(top | (top - 1)) == n, "of %lx", (unsigned long)top);
        for (i = 0; i < 1000; i++) {
            const uint32_t v = top | ((uint32_t)rng_u64(&rng) & (top - 1));
            MUST(drogue_clz_u32(v) == n, "of %lx: %d", (unsigned long)v, drogue_clz_u32(v));
            MUST(drogue_clz_u64((uint64_t)v << 32 | rng_u64(&rng) >> 32) == n && drogue_clz_u64(v) == 32 + n,
                 "of %lx in 64 bits", (unsigned long)v);
        }
    }
}
END_TEST

START_TEST(products)
{
    static const int32_t edges[] = {INT32_MIN, INT32_MIN + 1, -65537, -65536, -65535,   -1, 0,
                                    1,         65535,         65536,  65537,  INT32_MAX};
    enum { EDGES = sizeof edges / sizeof edges[0] };
    uint64_t rng = 2;
    int i;
    for (i = 0; i < EDGES * EDGES + 1000000; i++) {
        const int32_t a = i < EDGES * EDGES ? edges[i / EDGES] : rng_s32_any_width(&rng),
                      b = i < EDGES * EDGES ? edges[i % EDGES] : rng_s32_any_width(&rng);
        MUST(drogue_product(a, b) == (int64_t)a * b, "%ld times %ld", (long)a, (long)b);
        MUST(drogue_product_u32((uint32_t)a, (uint32_t)b) == (uint64_t)(uint32_t)a * (uint32_t)b, "%lu times %lu",
             (unsigned long)(uint32_t)a, (unsigned long)(uint32_t)b);
    }
}
END_TEST

SUITE_MAIN("portable", leading_zeros, products)
