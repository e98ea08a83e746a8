/* SPDX-License-Identifier: Apache-2.0 */
/* The library's arithmetic of reals by the unit beside the soft core, in the place of its own functions; the same bits. With
 * REAL_WHERE_CALLED it goes before a source that calls them often, for them to stand where they are called. */
#include "unit.h"

#ifdef REAL_WHERE_CALLED
#define FUNCTION extern inline __attribute__((gnu_inline))
#define PART extern inline __attribute__((gnu_inline, always_inline))
#else
#define FUNCTION
#define PART static inline
#endif

PART void push(drogue_real v)
{
    uint32_t none;
    UNIT(none, UNIT_PUSH, 0, v.mantissa, v.exponent);
    (void)none;
}

/* Both words of the result before either is stored: a unit is not asked while a store before it is under way. */
#define RESULT_OF(out, what, v)                                      \
    do {                                                             \
        int32_t mantissa;                                            \
        int32_t exponent;                                            \
        UNIT(mantissa, UNIT_REAL, what, (v).mantissa, (v).exponent); \
        UNIT(exponent, UNIT_EXPONENT, 0, 0, 0);                      \
        (out)->mantissa = mantissa;                                  \
        (out)->exponent = exponent;                                  \
    } while (0)

/* Loaded here and not where it is told: its word comes two clocks later. */
PART drogue_real loaded(const drogue_real *v)
{
    drogue_real words = *v;
    __asm__ volatile("" : "+r"(words.mantissa), "+r"(words.exponent));
    return words;
}

#define OF_TWO(out, what, a, b)              \
    do {                                     \
        const drogue_real first = loaded(a); \
        const drogue_real last = loaded(b);  \
        push(first);                         \
        RESULT_OF(out, what, last);          \
    } while (0)

#define OF_FOUR(out, what, a, b, c, d)        \
    do {                                      \
        const drogue_real first = loaded(a);  \
        const drogue_real second = loaded(b); \
        const drogue_real third = loaded(c);  \
        const drogue_real last = loaded(d);   \
        push(first);                          \
        push(second);                         \
        push(third);                          \
        RESULT_OF(out, what, last);           \
    } while (0)

FUNCTION void drogue_real_put(drogue_real *out, int32_t exponent, int64_t v)
{
    const drogue_real words = {(int32_t)((uint64_t)v >> 32), (int32_t)(uint32_t)v};
    const drogue_real by = {0, exponent};
    push(words);
    RESULT_OF(out, REAL_SET, by);
}

FUNCTION void drogue_real_set_q16(drogue_real *out, drogue_q16 v)
{
    const drogue_real words = {v, 0};
    const drogue_real by = {0, -48};
    push(words);
    RESULT_OF(out, REAL_SET, by);
}

FUNCTION void drogue_real_sum(drogue_real *out, const drogue_real *a, const drogue_real *b)
{
    OF_TWO(out, REAL_SUM, a, b);
}

FUNCTION void drogue_real_difference(drogue_real *out, const drogue_real *a, const drogue_real *b)
{
    OF_TWO(out, REAL_DIFFERENCE, a, b);
}

FUNCTION void drogue_real_product(drogue_real *out, const drogue_real *a, const drogue_real *b)
{
    OF_TWO(out, REAL_PRODUCT, a, b);
}

FUNCTION void drogue_real_quotient(drogue_real *out, const drogue_real *a, const drogue_real *b)
{
    OF_TWO(out, REAL_QUOTIENT, a, b);
}

FUNCTION void drogue_real_subtract_product(drogue_real *out, const drogue_real *a, const drogue_real *b)
{
    const drogue_real first = loaded(out);
    const drogue_real second = loaded(a);
    const drogue_real last = loaded(b);
    push(first);
    push(second);
    RESULT_OF(out, REAL_SUBTRACT_PRODUCT, last);
}

FUNCTION void drogue_real_products(drogue_real *out, const drogue_real *a, const drogue_real *b, const drogue_real *c,
                                   const drogue_real *d)
{
    OF_FOUR(out, REAL_PRODUCTS, a, b, c, d);
}

FUNCTION void drogue_real_determinant(drogue_real *out, const drogue_real *a, const drogue_real *b,
                                      const drogue_real *c, const drogue_real *d)
{
    OF_FOUR(out, REAL_DETERMINANT, a, b, c, d);
}

#ifndef REAL_WHERE_CALLED

void drogue_real_root(drogue_real *out, const drogue_real *v)
{
    const drogue_real words = loaded(v);
    const uint32_t odd = (uint32_t)words.exponent & 1u;
    const uint32_t low = (uint32_t)words.mantissa << (30 + odd);
    uint32_t root;
    if (words.mantissa <= 0) {
        out->mantissa = 0;
        out->exponent = 0;
        return;
    }
    UNIT(root, UNIT_ROOT, 0, low, (uint32_t)words.mantissa >> (2 - odd));
    out->mantissa = (int32_t)(root + (low - root * root > root));
    out->exponent = (words.exponent - 30 - (int32_t)odd) >> 1;
}

/* A whole number. */
static inline drogue_real whole(int64_t v)
{
    const drogue_real words = {(int32_t)((uint64_t)v >> 32), (int32_t)(uint32_t)v};
    const drogue_real by = {0, 0};
    drogue_real out;
    push(words);
    RESULT_OF(&out, REAL_SET, by);
    return out;
}

void drogue_real_ratio(drogue_real *out, int64_t a, int64_t b)
{
    const drogue_real divisor = whole(b);
    const drogue_real dividend = whole(a);
    push(dividend);
    RESULT_OF(out, REAL_QUOTIENT, divisor);
}

int __clzsi2(unsigned v);

/* What gcc calls for leading zeros, where the core has no instruction for them. */
int __clzsi2(unsigned v)
{
    int zeros;
    UNIT(zeros, UNIT_ZEROS, 0, v, 0);
    return zeros;
}
#endif
