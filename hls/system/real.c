/* SPDX-License-Identifier: Apache-2.0 */
/* The library's arithmetic of reals by the unit beside the soft core, in the place of its own functions; the same bits. */
#include "unit.h"

int __clzsi2(unsigned v);

#define RESULT_OF(out, what, v)                                               \
    do {                                                                      \
        UNIT((out)->mantissa, UNIT_REAL, what, (v)->mantissa, (v)->exponent); \
        UNIT((out)->exponent, UNIT_EXPONENT, 0, 0, 0);                        \
    } while (0)

void drogue_real_put(drogue_real *out, int32_t exponent, int64_t v)
{
    const drogue_real words = {(int32_t)((uint64_t)v >> 32), (int32_t)(uint32_t)v};
    const drogue_real by = {0, exponent};
    unit_push(&words);
    RESULT_OF(out, REAL_SET, &by);
}

void drogue_real_set_q16(drogue_real *out, drogue_q16 v)
{
    const drogue_real words = {v, 0};
    const drogue_real by = {0, -48};
    unit_push(&words);
    RESULT_OF(out, REAL_SET, &by);
}

void drogue_real_sum(drogue_real *out, const drogue_real *a, const drogue_real *b)
{
    unit_push(a);
    RESULT_OF(out, REAL_SUM, b);
}

void drogue_real_difference(drogue_real *out, const drogue_real *a, const drogue_real *b)
{
    unit_push(a);
    RESULT_OF(out, REAL_DIFFERENCE, b);
}

void drogue_real_product(drogue_real *out, const drogue_real *a, const drogue_real *b)
{
    unit_push(a);
    RESULT_OF(out, REAL_PRODUCT, b);
}

void drogue_real_quotient(drogue_real *out, const drogue_real *a, const drogue_real *b)
{
    unit_push(a);
    RESULT_OF(out, REAL_QUOTIENT, b);
}

void drogue_real_subtract_product(drogue_real *out, const drogue_real *a, const drogue_real *b)
{
    unit_push(out);
    unit_push(a);
    RESULT_OF(out, REAL_SUBTRACT_PRODUCT, b);
}

void drogue_real_products(drogue_real *out, const drogue_real *a, const drogue_real *b, const drogue_real *c,
                          const drogue_real *d)
{
    unit_push(a);
    unit_push(b);
    unit_push(c);
    RESULT_OF(out, REAL_PRODUCTS, d);
}

void drogue_real_determinant(drogue_real *out, const drogue_real *a, const drogue_real *b, const drogue_real *c,
                             const drogue_real *d)
{
    unit_push(a);
    unit_push(b);
    unit_push(c);
    RESULT_OF(out, REAL_DETERMINANT, d);
}

/* What gcc calls for leading zeros, where the core has no instruction for them. */
int __clzsi2(unsigned v)
{
    int zeros;
    UNIT(zeros, UNIT_ZEROS, 0, v, 0);
    return zeros;
}
