/* SPDX-License-Identifier: Apache-2.0 */
/* Wide arithmetic for the places where Q16 cancels (the direct fit, the cone): 128-bit products from
 * 32-bit limbs, and normalised 62-bit mantissas with a binary exponent of their own.
 *
 * A drogue_wide is mantissa * 2^exponent with 2^61 <= |mantissa| < 2^62, or 0 with exponent 0.
 * Results are rounded to nearest (ties toward +infinity) to 62 bits. Exponents stay within +-2^20 for
 * every use in the library; none is checked because no chain of operations here can come near.
 */
#ifndef DROGUE_WIDE_H
#define DROGUE_WIDE_H

#include "drogue/fixed.h"

#ifdef __cplusplus
extern "C" {
#endif

/* 128-bit two's complement: hi * 2^64 + lo. */
typedef struct drogue_s128 {
    int64_t hi;
    uint64_t lo;
} drogue_s128;

typedef struct drogue_wide {
    int64_t mantissa;
    int32_t exponent;
} drogue_wide;

/* Exact product. */
inline drogue_s128 drogue_s128_mul(int64_t a, int64_t b)
{
    const uint32_t a0 = (uint32_t)a;
    const uint32_t b0 = (uint32_t)b;
    const uint32_t a1 = (uint32_t)((uint64_t)a >> 32);
    const uint32_t b1 = (uint32_t)((uint64_t)b >> 32);
    uint64_t low = (uint64_t)a0 * b0;
    uint64_t mid = (uint64_t)a1 * b0 + (low >> 32);
    uint64_t mid_low = (uint64_t)a0 * b1 + (uint32_t)mid;
    uint64_t high = (uint64_t)a1 * b1 + (mid >> 32) + (mid_low >> 32);
    drogue_s128 r;
    high -= a < 0 ? (uint64_t)b : 0; /* a as an unsigned number is 2^64 more */
    high -= b < 0 ? (uint64_t)a : 0;
    r.hi = (int64_t)high;
    r.lo = (mid_low << 32) | (uint32_t)low;
    return r;
}

/* Sum modulo 2^128. */
static inline drogue_s128 drogue_s128_add(drogue_s128 a, drogue_s128 b)
{
    drogue_s128 r;
    r.lo = a.lo + b.lo;
    r.hi = (int64_t)((uint64_t)a.hi + (uint64_t)b.hi + (r.lo < a.lo ? 1u : 0u));
    return r;
}

/* Difference modulo 2^128. */
static inline drogue_s128 drogue_s128_sub(drogue_s128 a, drogue_s128 b)
{
    drogue_s128 r;
    r.lo = a.lo - b.lo;
    r.hi = (int64_t)((uint64_t)a.hi - (uint64_t)b.hi - (a.lo < b.lo ? 1u : 0u));
    return r;
}

static inline drogue_s128 drogue_s128_from_s64(int64_t v)
{
    drogue_s128 r;
    r.lo = (uint64_t)v;
    r.hi = v < 0 ? -1 : 0;
    return r;
}

/* Order of two 128-bit numbers: -1, 0 or 1. */
static inline int drogue_s128_cmp(drogue_s128 a, drogue_s128 b)
{
    if (a.hi != b.hi) {
        return a.hi < b.hi ? -1 : 1;
    }
    return a.lo < b.lo ? -1 : a.lo > b.lo ? 1 : 0;
}

/* v / 2^n rounded to nearest, ties toward +infinity; 1 <= n <= 63, the result must fit 64 bits. */
static inline int64_t drogue_s128_shr_round(drogue_s128 v, int n)
{
    return (int64_t)(((uint64_t)v.hi << (64 - n)) | (v.lo >> n)) + (int64_t)((v.lo >> (n - 1)) & 1u);
}

/* a * b / 2^n rounded to nearest, ties toward +infinity; 1 <= n <= 63, the result must fit 64 bits. */
int64_t drogue_mul_shr_round_s64(int64_t a, int64_t b, int n);

/* round(v * 2^shift), saturated to 64 bits; |v| < 2^62 */
int64_t drogue_scale_round_s64(int64_t v, int shift);

/* Results go through pointers, without copies of operands; 'out' may be an operand. Conversions are exact up to 62
 * significant bits, then rounded. */
void drogue_wide_set(drogue_wide *out, int64_t v, int32_t exponent); /* v * 2^exponent */
void drogue_wide_set_q16(drogue_wide *out, drogue_q16 v);
void drogue_wide_set_s128(drogue_wide *out, int64_t high, uint64_t low, int32_t exponent);
void drogue_wide_sum(drogue_wide *out, const drogue_wide *a, const drogue_wide *b);
void drogue_wide_difference(drogue_wide *out, const drogue_wide *a, const drogue_wide *b);
void drogue_wide_product(drogue_wide *out, const drogue_wide *a, const drogue_wide *b);
/* a / b; b = 0 gives 0, and callers test b first. */
void drogue_wide_quotient(drogue_wide *out, const drogue_wide *a, const drogue_wide *b);
/* Square root; 0 for v <= 0. */
void drogue_wide_root(drogue_wide *out, const drogue_wide *v);
/* out -= a b, both operations rounded */
void drogue_wide_subtract_product(drogue_wide *out, const drogue_wide *a, const drogue_wide *b);
/* a b + c d, each operation rounded */
void drogue_wide_products(drogue_wide *out, const drogue_wide *a, const drogue_wide *b, const drogue_wide *c,
                          const drogue_wide *d);

/* Member by member: compilers of hardware copy a whole one byte by byte. */
static inline void drogue_wide_copy(drogue_wide *out, const drogue_wide *v)
{
    out->mantissa = v->mantissa;
    out->exponent = v->exponent;
}

/* v * 2^n, exact */
static inline void drogue_wide_shift(drogue_wide *v, int n)
{
    if (v->mantissa != 0) {
        v->exponent += n;
    }
}

/* -v; a function: Bambu loses a bare store beside calls */
void drogue_wide_negate(drogue_wide *v);

/* The same by value, for what is done seldom. */
static inline drogue_wide drogue_wide_from_s64(int64_t v, int32_t exponent)
{
    drogue_wide r;
    drogue_wide_set(&r, v, exponent);
    return r;
}

static inline drogue_wide drogue_wide_from_q16(drogue_q16 v) { return drogue_wide_from_s64(v, -16); }

static inline drogue_wide drogue_wide_from_s128(drogue_s128 v, int32_t exponent)
{
    drogue_wide r;
    drogue_wide_set_s128(&r, v.hi, v.lo, exponent);
    return r;
}

/* round(v * 2^frac_bits), saturated to 64 (32) bits. */
static inline int64_t drogue_wide_to_s64(drogue_wide v, int frac_bits)
{
    return drogue_scale_round_s64(v.mantissa, v.exponent + frac_bits);
}

static inline drogue_q16 drogue_wide_to_q16(drogue_wide v) { return drogue_sat_s32(drogue_wide_to_s64(v, 16)); }

static inline drogue_wide drogue_wide_add(drogue_wide a, drogue_wide b)
{
    drogue_wide_sum(&a, &a, &b);
    return a;
}

static inline drogue_wide drogue_wide_sub(drogue_wide a, drogue_wide b)
{
    drogue_wide_difference(&a, &a, &b);
    return a;
}

static inline drogue_wide drogue_wide_mul(drogue_wide a, drogue_wide b)
{
    drogue_wide_product(&a, &a, &b);
    return a;
}

static inline drogue_wide drogue_wide_div(drogue_wide a, drogue_wide b)
{
    drogue_wide_quotient(&a, &a, &b);
    return a;
}

static inline drogue_wide drogue_wide_sqrt(drogue_wide v)
{
    drogue_wide_root(&v, &v);
    return v;
}

static inline drogue_wide drogue_wide_neg(drogue_wide v)
{
    v.mantissa = -v.mantissa;
    return v;
}

static inline drogue_wide drogue_wide_scale(drogue_wide v, int n)
{
    drogue_wide_shift(&v, n);
    return v;
}

/* Sign of a - b: -1, 0 or 1. */
int drogue_wide_order(const drogue_wide *a, const drogue_wide *b);
static inline int drogue_wide_cmp(drogue_wide a, drogue_wide b) { return drogue_wide_order(&a, &b); }

/* atan2(y, x), rad Q29 in [-pi, pi]. */
int32_t drogue_wide_atan2_q29(drogue_wide y, drogue_wide x);

#ifdef __cplusplus
}
#endif
#endif
