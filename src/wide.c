/* SPDX-License-Identifier: Apache-2.0 */
/* 128-bit products and normalised 62-bit mantissas. */
#include "drogue/wide.h"

#define WIDE_TOP (INT64_C(1) << 62) /* mantissas stay below */

drogue_s128 drogue_s128_mul(int64_t a, int64_t b)
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

/* v / 2^n rounded, ties toward +infinity, for 1 <= n <= 127; the result must fit 64 bits. */
static int64_t s128_shr_round(drogue_s128 v, int n)
{
    if (n < 64) {
        return drogue_s128_shr_round(v, n);
    }
    if (n == 64) {
        return v.hi + (int64_t)(v.lo >> 63);
    }
    return (v.hi >> (n - 64)) + (int64_t)(((uint64_t)v.hi >> (n - 65)) & 1u);
}

int64_t drogue_mul_shr_round_s64(int64_t a, int64_t b, int n)
{
    return drogue_s128_shr_round(drogue_s128_mul(a, b), n);
}

/* Finish a mantissa that rounding may have carried to 2^62. */
static drogue_wide wide_finish(int64_t mantissa, int32_t exponent)
{
    drogue_wide r;
    if (mantissa >= WIDE_TOP || mantissa <= -WIDE_TOP) {
        mantissa /= 2; /* exact: it is +-2^62 */
        exponent++;
    }
    DROGUE_NOTE("wide: mantissa", mantissa, 62);
    DROGUE_NOTE("wide: exponent", exponent, 20);
    r.mantissa = mantissa;
    r.exponent = mantissa == 0 ? 0 : exponent;
    return r;
}

drogue_wide drogue_wide_from_s64(int64_t v, int32_t exponent)
{
    int shift = drogue_clz_u64(drogue_abs_u64(v)) - 2;
    if (v == 0) {
        return wide_finish(0, 0);
    }
    if (shift >= 0) {
        return wide_finish(drogue_shl_s64(v, shift), exponent - shift);
    }
    return wide_finish(drogue_shr_round_s64(v, -shift), exponent - shift);
}

drogue_wide drogue_wide_from_s128(drogue_s128 v, int32_t exponent)
{
    /* |v| / 2^64 */
    uint64_t high = v.hi >= 0 ? (uint64_t)v.hi : v.lo != 0 ? ~(uint64_t)v.hi : (uint64_t)0 - (uint64_t)v.hi;
    int shift;             /* bits to drop */
    if (high >> 61 == 1) { /* what most sums of two mantissas need */
        return wide_finish(v.hi + (int64_t)(v.lo >> 63), exponent + 64);
    }
    if (high >> 62 == 1) {
        return wide_finish((v.hi >> 1) + (v.hi & 1), exponent + 65);
    }
    if (high == 0) {
        uint64_t low = v.hi < 0 ? (uint64_t)0 - v.lo : v.lo;
        if ((low >> 63) == 0) {
            return drogue_wide_from_s64((int64_t)v.lo, exponent);
        }
        shift = 2;
    } else {
        shift = 66 - drogue_clz_u64(high);
    }
    return wide_finish(s128_shr_round(v, shift), exponent + shift);
}

int64_t drogue_wide_to_s64(drogue_wide v, int frac_bits)
{
    int shift = v.exponent + frac_bits;
    if (v.mantissa == 0 || shift < -63) {
        return 0;
    }
    if (shift > 1) {
        return v.mantissa < 0 ? INT64_MIN : INT64_MAX;
    }
    return shift >= 0 ? drogue_shl_s64(v.mantissa, shift) : drogue_shr_round_s64(v.mantissa, -shift);
}

drogue_q16 drogue_wide_to_q16(drogue_wide v) { return drogue_sat_s32(drogue_wide_to_s64(v, 16)); }

drogue_wide drogue_wide_add(drogue_wide a, drogue_wide b)
{
    drogue_s128 sum;
    drogue_s128 low;
    int shift;
    if (a.mantissa == 0) {
        return b;
    }
    if (b.mantissa == 0) {
        return a;
    }
    if (a.exponent < b.exponent) {
        drogue_wide t = a;
        a = b;
        b = t;
    }
    shift = a.exponent - b.exponent;
    if (shift > 64) {
        return a; /* b is below a quarter of a's last bit */
    }
    sum.hi = a.mantissa;
    sum.lo = 0;
    if (shift == 0) {
        low.hi = b.mantissa;
        low.lo = 0;
    } else if (shift < 64) {
        low.hi = b.mantissa >> shift;
        low.lo = (uint64_t)b.mantissa << (64 - shift);
    } else {
        low = drogue_s128_from_s64(b.mantissa);
    }
    return drogue_wide_from_s128(drogue_s128_add(sum, low), a.exponent - 64);
}

drogue_wide drogue_wide_mul(drogue_wide a, drogue_wide b)
{
    const int64_t half = INT64_C(1) << 59; /* 2^123 / 2^64 */
    drogue_s128 product = drogue_s128_mul(a.mantissa, b.mantissa);
    if (product.hi >= half || product.hi < -half) {
        return wide_finish(drogue_s128_shr_round(product, 62), a.exponent + b.exponent + 62);
    }
    return wide_finish(drogue_s128_shr_round(product, 61), a.exponent + b.exponent + 61);
}

drogue_wide drogue_wide_div(drogue_wide a, drogue_wide b)
{
    uint64_t rest = drogue_abs_u64(a.mantissa);
    uint64_t divisor = drogue_abs_u64(b.mantissa);
    uint64_t high = divisor >> 31;
    int64_t low = (int64_t)(divisor & 0x7FFFFFFFu);
    uint64_t quotient = 1;
    int32_t exponent = a.exponent - b.exponent - 61;
    int negative = (a.mantissa < 0) != (b.mantissa < 0);
    int digit;
    if (rest == 0 || divisor == 0) {
        return wide_finish(0, 0);
    }
    if (rest < divisor) {
        rest <<= 1;
        exponent--;
    }
    rest -= divisor;                      /* the leading 1 of the quotient */
    for (digit = 0; digit < 2; digit++) { /* two digits in base 2^31: 63 bits with the leading one */
        uint64_t trial = rest / high;
        int64_t next;
        if (trial > 0x7FFFFFFFu) {
            trial = 0x7FFFFFFFu;
        }
        next = drogue_shl_s64((int64_t)(rest - trial * high), 31) - (int64_t)trial * low;
        while (next < 0) { /* bound: 2, the trial digit is at most two too large */
            next += (int64_t)divisor;
            trial--;
        }
        rest = (uint64_t)next;
        quotient = (quotient << 31) | trial;
    }
    /* 63 bits with 'rest' below them: the last bit is the half, ties exist only when rest is 0. */
    if ((quotient & 1u) != 0 && !(negative && rest == 0)) {
        quotient++;
    }
    quotient >>= 1;
    return wide_finish(negative ? -(int64_t)quotient : (int64_t)quotient, exponent);
}

drogue_wide drogue_wide_sqrt(drogue_wide v)
{
    /* Root of m * 2^61 (124 bits) from the root of its upper half (Zimmermann 1999, Karatsuba square root). */
    uint64_t m;
    uint64_t upper;
    uint64_t rest;
    uint64_t root;
    uint64_t digit;
    uint64_t tail;
    int32_t exponent = v.exponent;
    if (v.mantissa <= 0) {
        return wide_finish(0, 0);
    }
    m = (uint64_t)v.mantissa;
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
    if (tail > root) {
        root++;
    }
    return wide_finish((int64_t)root, (exponent - 61) / 2);
}

void drogue_wide_set(drogue_wide *out, int64_t v, int32_t exponent) { *out = drogue_wide_from_s64(v, exponent); }

void drogue_wide_set_q16(drogue_wide *out, drogue_q16 v) { *out = drogue_wide_from_s64(v, -16); }

void drogue_wide_sum(drogue_wide *out, const drogue_wide *a, const drogue_wide *b) { *out = drogue_wide_add(*a, *b); }

void drogue_wide_difference(drogue_wide *out, const drogue_wide *a, const drogue_wide *b)
{
    *out = drogue_wide_sub(*a, *b);
}

void drogue_wide_product(drogue_wide *out, const drogue_wide *a, const drogue_wide *b)
{
    *out = drogue_wide_mul(*a, *b);
}

void drogue_wide_quotient(drogue_wide *out, const drogue_wide *a, const drogue_wide *b)
{
    *out = drogue_wide_div(*a, *b);
}

void drogue_wide_root(drogue_wide *out, const drogue_wide *a) { *out = drogue_wide_sqrt(*a); }

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

int drogue_wide_cmp(drogue_wide a, drogue_wide b)
{
    int64_t d = drogue_wide_sub(a, b).mantissa;
    return d < 0 ? -1 : d > 0 ? 1 : 0;
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
