/* SPDX-License-Identifier: Apache-2.0 */
/* Software floating point with mantissas of 31 bits. */
#include "drogue/real.h"

/* v * 2^exponent, normalised and rounded: the upper of two words that begin with it. */
void drogue_real_put(drogue_real *out, int32_t exponent, int64_t v)
{
    uint32_t high = (uint32_t)((uint64_t)v >> 32);
    uint32_t low = (uint32_t)v;
    uint32_t magnitude = high ^ (0u - (high >> 31)); /* one too small for negative numbers */
    int32_t mantissa;
    if (magnitude >> 30 == 0) {
        int shift;
        if (magnitude == 0) { /* a word more */
            if (v == 0) {
                out->mantissa = 0;
                out->exponent = 0;
                return;
            }
            high = high << 31 | low >> 1;
            low <<= 31;
            magnitude = high ^ (0u - (high >> 31));
            exponent -= 31;
        }
        shift = drogue_clz_u32(magnitude) - 1;
        high = high << shift | low >> 1 >> (31 - shift);
        low <<= shift;
        exponent -= shift;
    }
    mantissa = (int32_t)(high + (low >> 31));
    exponent += 32;
    if (mantissa == INT32_MIN) { /* rounded up to 2^31, or -2^31 */
        mantissa = (int32_t)high < 0 ? -(1 << 30) : 1 << 30;
        exponent++;
    }
    DROGUE_NOTE("real: mantissa", mantissa, 31);
    DROGUE_NOTE("real: exponent", exponent, 20);
    out->mantissa = mantissa;
    out->exponent = exponent;
}

void drogue_real_set_q16(drogue_real *out, drogue_q16 v) { drogue_real_put(out, -47, drogue_shl_s64(v, 31)); }

/* a 2^a_exponent + b 2^b_exponent for |a|, |b| < 2^62; neither is small beside 2^62 unless it is 0. */
static void put_sum(drogue_real *out, int32_t a_exponent, int64_t a, int64_t b, int32_t b_exponent)
{
    int shift = a_exponent - b_exponent;
    if (a == 0 || (b != 0 && shift < 0)) {
        const int64_t t = a;
        a = b;
        b = t;
        a_exponent = b_exponent;
        shift = -shift;
    }
    if (b != 0) {
        a += shift > 63 ? 0 : b >> shift; /* beyond 63 it lies below a quarter of the last place */
    }
    drogue_real_put(out, a_exponent, a);
}

void drogue_real_sum(drogue_real *out, const drogue_real *a, const drogue_real *b)
{
    put_sum(out, a->exponent - 31, drogue_shl_s64(a->mantissa, 31), drogue_shl_s64(b->mantissa, 31), b->exponent - 31);
}

void drogue_real_difference(drogue_real *out, const drogue_real *a, const drogue_real *b)
{
    put_sum(out, a->exponent - 31, drogue_shl_s64(a->mantissa, 31), drogue_shl_s64(-b->mantissa, 31), b->exponent - 31);
}

void drogue_real_product(drogue_real *out, const drogue_real *a, const drogue_real *b)
{
    drogue_real_put(out, a->exponent + b->exponent, drogue_product(a->mantissa, b->mantissa));
}

void drogue_real_subtract_product(drogue_real *out, const drogue_real *a, const drogue_real *b)
{
    put_sum(out, out->exponent - 31, drogue_shl_s64(out->mantissa, 31), drogue_product(a->mantissa, -b->mantissa),
            a->exponent + b->exponent);
}

void drogue_real_products(drogue_real *out, const drogue_real *a, const drogue_real *b, const drogue_real *c,
                          const drogue_real *d)
{
    put_sum(out, a->exponent + b->exponent, drogue_product(a->mantissa, b->mantissa),
            drogue_product(c->mantissa, d->mantissa), c->exponent + d->exponent);
}

void drogue_real_determinant(drogue_real *out, const drogue_real *a, const drogue_real *b, const drogue_real *c,
                             const drogue_real *d)
{
    put_sum(out, a->exponent + b->exponent, drogue_product(a->mantissa, b->mantissa),
            drogue_product(c->mantissa, -d->mantissa), c->exponent + d->exponent);
}

void drogue_real_negate(drogue_real *v) { v->mantissa = -v->mantissa; }

static inline uint32_t absolute(int32_t v) { return v < 0 ? 0u - (uint32_t)v : (uint32_t)v; }

/* n 2^30 / d, rounded to nearest, for 2^30 <= d < 2^31, d <= n < 2d: no quotient of 31-bit numbers is a tie. */
static uint32_t divide(uint32_t n, uint32_t d)
{
    uint32_t quotient = (uint32_t)(drogue_product_u32(n, drogue_reciprocal_u32(d)) >> 32); /* 3 too small at most */
    uint64_t rest = ((uint64_t)n << 30) - drogue_product_u32(quotient, d);
    if (rest >= (uint64_t)d << 1) {
        rest -= (uint64_t)d << 1;
        quotient += 2;
    }
    if (rest >= d) {
        rest -= d;
        quotient++;
    }
    return quotient + (rest << 1 >= d);
}

void drogue_real_quotient(drogue_real *out, const drogue_real *a, const drogue_real *b)
{
    const int negative = (a->mantissa ^ b->mantissa) < 0;
    const uint32_t divisor = absolute(b->mantissa);
    uint32_t dividend = absolute(a->mantissa);
    int32_t exponent = a->exponent - b->exponent - 30;
    int32_t quotient;
    if (dividend == 0 || divisor == 0) {
        out->mantissa = 0;
        out->exponent = 0;
        return;
    }
    if (dividend < divisor) {
        dividend <<= 1;
        exponent--;
    }
    quotient = (int32_t)divide(dividend, divisor);
    out->mantissa = negative ? -quotient : quotient;
    out->exponent = exponent;
}

void drogue_real_ratio(drogue_real *out, int64_t a, int64_t b)
{
    drogue_real divisor;
    drogue_real_set(&divisor, b, 0);
    drogue_real_set(out, a, 0);
    drogue_real_quotient(out, out, &divisor);
}

void drogue_real_root(drogue_real *out, const drogue_real *v)
{
    const int shift = 30 + (v->exponent & 1);
    uint64_t square;
    uint32_t root;
    if (v->mantissa <= 0) {
        out->mantissa = 0;
        out->exponent = 0;
        return;
    }
    square = (uint64_t)v->mantissa << shift;
    root = drogue_isqrt_u64(square);
    out->exponent = (v->exponent - shift) / 2;
    /* what is left is below 2^32, as root is below 2^31; square > (root + 1/2)^2 */
    out->mantissa = (int32_t)(root + ((uint32_t)square - root * root > root));
}

int64_t drogue_real_to_s64(drogue_real v, int frac_bits)
{
    const int shift = v.exponent + frac_bits;
    if (v.mantissa == 0 || shift < -31) {
        return 0;
    }
    if (shift > 32) {
        return v.mantissa < 0 ? INT64_MIN : INT64_MAX;
    }
    return shift >= 0 ? drogue_shl_s64(v.mantissa, shift) : (v.mantissa >> -shift) + ((v.mantissa >> (-shift - 1)) & 1);
}

int32_t drogue_real_to_s32(drogue_real v, int frac_bits) { return drogue_sat_s32(drogue_real_to_s64(v, frac_bits)); }

int drogue_real_order(const drogue_real *a, const drogue_real *b)
{
    const int sign_a = (a->mantissa > 0) - (a->mantissa < 0);
    const int sign_b = (b->mantissa > 0) - (b->mantissa < 0);
    if (sign_a != sign_b || sign_a == 0) {
        return (sign_a > sign_b) - (sign_a < sign_b);
    }
    if (a->exponent != b->exponent) {
        return a->exponent > b->exponent ? sign_a : -sign_a;
    }
    return (a->mantissa > b->mantissa) - (a->mantissa < b->mantissa);
}

int32_t drogue_real_atan2_q29(drogue_real y, drogue_real x)
{
    int64_t y_wide = drogue_shl_s64(y.mantissa, 31);
    int64_t x_wide = drogue_shl_s64(x.mantissa, 31);
    const int shift = y.exponent - x.exponent;
    if (x.mantissa != 0 && y.mantissa != 0) {
        if (shift > 0) {
            x_wide = shift > 63 ? 0 : drogue_shr_round_s64(x_wide, shift);
        } else {
            y_wide >>= shift < -63 ? 63 : -shift; /* toward -infinity: a negative y stays negative */
        }
    }
    return drogue_atan2_q29(y_wide, x_wide);
}
