/* SPDX-License-Identifier: Apache-2.0 */
/* 128-bit products and normalised 62-bit mantissas. */
#include "drogue/wide.h"

#define WIDE_TOP (INT64_C(1) << 62) /* mantissas stay below */

extern inline drogue_s128 drogue_s128_mul(int64_t a, int64_t b);

int64_t drogue_mul_shr_round_s64(int64_t a, int64_t b, int n)
{
    return drogue_s128_shr_round(drogue_s128_mul(a, b), n);
}

/* v / 2, rounded, times 2^exponent; v has 63 bits and a sign, or is 0. */
static inline void put_rounded(drogue_wide *out, int64_t v, int32_t exponent)
{
    int64_t mantissa = (v >> 1) + (v & 1);
    if (mantissa == WIDE_TOP || mantissa == -WIDE_TOP) {
        mantissa >>= 1;
        exponent++;
    }
    DROGUE_NOTE("wide: mantissa", mantissa, 62);
    DROGUE_NOTE("wide: exponent", exponent, 20);
    out->mantissa = mantissa;
    out->exponent = mantissa == 0 ? 0 : exponent;
}

/* (high + low / 2^64) 2^exponent, rounded. */
static inline void put_s128(drogue_wide *out, int64_t high, uint64_t low, int32_t exponent)
{
    const uint64_t magnitude = (uint64_t)(high ^ (high >> 63)); /* one too small for negative numbers */
    /* a sum of two mantissas seldom needs to be counted */
    const int shift = magnitude >> 61 != 0 ? magnitude >> 62 == 0 : drogue_clz_u64(magnitude) - 1;
    put_rounded(out, drogue_shl_s64(high, shift) | (int64_t)(low >> 1 >> (63 - shift)), exponent + 1 - shift);
}

void drogue_wide_set(drogue_wide *out, int64_t v, int32_t exponent) { put_s128(out, v, 0, exponent); }

void drogue_wide_set_q16(drogue_wide *out, drogue_q16 v) { put_s128(out, v, 0, -16); }

void drogue_wide_set_s128(drogue_wide *out, int64_t high, uint64_t low, int32_t exponent)
{
    if (high == (int64_t)low >> 63) {
        put_s128(out, (int64_t)low, 0, exponent);
    } else {
        put_s128(out, high, low, exponent + 64);
    }
}

int64_t drogue_scale_round_s64(int64_t v, int shift)
{
    if (v == 0 || shift < -63) {
        return 0;
    }
    if (shift > 1) {
        return v < 0 ? INT64_MIN : INT64_MAX;
    }
    return shift >= 0 ? drogue_shl_s64(v, shift) : drogue_shr_round_s64(v, -shift);
}

/* a + b, numbers with a sign of their own for b's mantissa */
static inline void put_sum(drogue_wide *out, const drogue_wide *a, int64_t b_mantissa, int32_t b_exponent)
{
    int64_t high = a->mantissa; /* of the number with the larger exponent */
    int64_t low = b_mantissa;
    int32_t exponent = a->exponent;
    int shift = exponent - b_exponent;
    if (high == 0 || (low != 0 && shift < 0)) {
        high = b_mantissa;
        low = a->mantissa;
        exponent = b_exponent;
        shift = -shift;
    }
    if ((uint32_t)shift > 63) { /* 0, or below a quarter of the other's last bit */
        low = 0;
        shift = 0;
    }
    put_s128(out, high + (low >> shift), (uint64_t)low << 1 << (63 - shift), exponent);
}

void drogue_wide_sum(drogue_wide *out, const drogue_wide *a, const drogue_wide *b)
{
    put_sum(out, a, b->mantissa, b->exponent);
}

void drogue_wide_difference(drogue_wide *out, const drogue_wide *a, const drogue_wide *b)
{
    put_sum(out, a, -b->mantissa, b->exponent);
}

void drogue_wide_product(drogue_wide *out, const drogue_wide *a, const drogue_wide *b)
{
    const drogue_s128 product = drogue_s128_mul(a->mantissa, b->mantissa); /* 123 or 124 bits */
    const int shift = (product.hi ^ (product.hi >> 63)) >> 59 != 0 ? 3 : 4;
    put_rounded(out, drogue_shl_s64(product.hi, shift) | (int64_t)(product.lo >> (64 - shift)),
                a->exponent + b->exponent + 65 - shift);
}

/* About 2^91 / d for 2^61 <= d < 2^62, to 26 bits: Newton from a line that is right to 4. */
static inline int32_t reciprocal(uint64_t d)
{
    const uint32_t high = (uint32_t)(d >> 30);
    uint32_t r = 1515870810u - (uint32_t)((uint64_t)high * 1010580540u >> 32); /* (48 - 32 d) / 17, Q29 */
    int k;
    for (k = 0; k < 3; k++) {
        const uint32_t error = (UINT32_C(1) << 30) - (uint32_t)((uint64_t)high * r >> 32); /* 2 - d r */
        r = (uint32_t)((uint64_t)r * error >> 29);
    }
    return (int32_t)r;
}

void drogue_wide_negate(drogue_wide *v) { v->mantissa = -v->mantissa; }

void drogue_wide_quotient(drogue_wide *out, const drogue_wide *a, const drogue_wide *b)
{
    const int64_t divisor = b->mantissa < 0 ? -b->mantissa : b->mantissa;
    int64_t rest = b->mantissa < 0 ? -a->mantissa : a->mantissa;
    const uint64_t sign = rest < 0 ? UINT64_C(1) << 63 : 0;
    uint64_t quotient = 0;
    int32_t exponent = a->exponent - b->exponent - 61;
    int32_t inverse;
    int k;
    if (rest == 0 || divisor == 0) {
        put_rounded(out, 0, 0);
        return;
    }
    if (rest < divisor && rest > -divisor) {
        rest *= 2;
        exponent--;
    }
    inverse = reciprocal((uint64_t)divisor);
    for (k = 0; k < 3; k++) { /* 64 bits and the sign; the rest stays within 1/16 of 0 .. divisor */
        const int32_t digit = (int32_t)((int64_t)(int32_t)(rest >> 32) * inverse >> 38);
        rest = (int64_t)(((uint64_t)rest << 21) - (uint64_t)digit * (uint64_t)divisor);
        quotient = (quotient << 21) + (uint64_t)digit;
    }
    quotient += (uint64_t)(rest >= divisor) - (uint64_t)(rest < 0);
    put_rounded(out, (int64_t)(quotient >> 1 | sign), exponent);
}

void drogue_wide_root(drogue_wide *out, const drogue_wide *v)
{
    /* Root of m * 2^61 (124 bits) from the root of its upper half (Zimmermann 1999, Karatsuba square root). */
    uint64_t m = (uint64_t)v->mantissa;
    uint64_t upper;
    uint64_t rest;
    uint64_t root;
    uint64_t digit;
    uint64_t tail;
    int32_t exponent = v->exponent;
    if (v->mantissa <= 0) {
        put_rounded(out, 0, 0);
        return;
    }
    if ((exponent & 1) == 0) {
        m <<= 1;
        exponent--;
    }
    upper = m >> 1; /* m * 2^61 = upper * 2^62 + (m & 1) * 2^61 */
    root = drogue_isqrt_u64(upper);
    rest = ((upper - root * root) << 31) + ((m & 1u) << 30);
    digit = rest / (2 * root);
    tail = (rest - digit * 2 * root) << 31;
    root = (root << 31) + digit;
    if (tail < digit * digit) { /* one too many */
        tail += 2 * root - 1;
        root--;
    }
    tail -= digit * digit;
    put_rounded(out, (int64_t)(2 * root + (tail > root)), (exponent - 61) / 2);
}

void drogue_wide_subtract_product(drogue_wide *out, const drogue_wide *a, const drogue_wide *b)
{
    drogue_wide product;
    drogue_wide_product(&product, a, b);
    drogue_wide_difference(out, out, &product);
}

void drogue_wide_products(drogue_wide *out, const drogue_wide *a, const drogue_wide *b, const drogue_wide *c,
                          const drogue_wide *d)
{
    drogue_wide second;
    drogue_wide_product(&second, c, d);
    drogue_wide_product(out, a, b);
    drogue_wide_sum(out, out, &second);
}

int drogue_wide_order(const drogue_wide *a, const drogue_wide *b)
{
    drogue_wide d;
    drogue_wide_difference(&d, a, b);
    return (d.mantissa > 0) - (d.mantissa < 0);
}

int32_t drogue_wide_atan2_q29(drogue_wide y, drogue_wide x)
{
    int shift = y.exponent - x.exponent;
    if (x.mantissa != 0 && y.mantissa != 0) {
        if (shift > 0) {
            x.mantissa = shift > 63 ? 0 : drogue_shr_round_s64(x.mantissa, shift);
        } else {
            y.mantissa >>= shift < -63 ? 63 : -shift; /* toward -infinity: a negative y stays negative */
        }
    }
    return drogue_atan2_q29(y.mantissa, x.mantissa);
}
