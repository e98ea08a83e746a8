/* SPDX-License-Identifier: Apache-2.0 */
/* Real numbers of 31 bits: results are normalised and within half a unit of the exact value, ties toward +infinity. */
#include "arithmetic/real.c"
#include "arithmetic/fixed.c"
#include "proof.h"

static int normal(const drogue_real *v)
{
    const uint32_t m = v->mantissa < 0 ? 0u - (uint32_t)v->mantissa : (uint32_t)v->mantissa;
    return m == 0 ? v->exponent == 0 : m >> 30 == 1;
}

static drogue_real any_real(void)
{
    drogue_real v;
    v.mantissa = nondet_s32();
    v.exponent = any_signed(21);
    ASSUME(normal(&v));
    return v;
}

/* Is r = exact * 2^exponent, rounded to nearest, ties toward +infinity?  |exact| <= 2^62 */
static int rounds(const drogue_real *r, int64_t exact, int32_t exponent)
{
    const int32_t s = r->exponent - exponent;
    int64_t rest;
    if (exact == 0) {
        return r->mantissa == 0;
    }
    if (s < -31 || s > 32) {
        return 0;
    }
    if (s <= 0) {
        return r->mantissa >> -s == exact && ((uint32_t)r->mantissa & ((UINT32_C(1) << -s) - 1)) == 0;
    }
    rest = exact - (int64_t)((uint64_t)r->mantissa << s);
    return rest >= -(INT64_C(1) << (s - 1)) && rest < INT64_C(1) << (s - 1);
}

void set(void)
{
    const int64_t v = nondet_s64() >> 1;
    const int32_t exponent = any_within(-(1 << 20), 1 << 20);
    drogue_real r;
    drogue_real_set(&r, v, exponent);
    PROVE(normal(&r));
    PROVE(rounds(&r, v, exponent));
}

void product(void)
{
    const drogue_real a = any_real();
    const drogue_real b = any_real();
    drogue_real r;
    drogue_real_product(&r, &a, &b);
    PROVE(normal(&r));
    PROVE(rounds(&r, (int64_t)a.mantissa * b.mantissa, a.exponent + b.exponent));
}

/* Of a product and a sum; what the value is other proofs say. */
void no_overflow(void)
{
    drogue_real a = any_real();
    const drogue_real b = any_real();
    drogue_real r;
    drogue_real_product(&r, &a, &b);
    drogue_real_sum(&r, &a, &b);
    PROVE(normal(&a));
}

/* In units of 2^31 of the larger number's last place the smaller one is an integer, or cut down to one: the sum is then
 * below the exact one by less than 1, and rounded to nearest, ties up, exactly when the cut sum is. */
void sum(void)
{
    const drogue_real a = any_real();
    const drogue_real b = any_real();
    const int32_t apart = a.exponent - b.exponent;
    drogue_real r;
    ASSUME(a.mantissa != 0 && b.mantissa != 0 && apart >= 0 && apart <= 62);
    drogue_real_sum(&r, &a, &b);
    PROVE(normal(&r));
    if (apart <= 31) {
        PROVE(rounds(&r, (int64_t)((uint64_t)a.mantissa << apart) + b.mantissa, b.exponent));
    } else {
        PROVE(r.exponent >= a.exponent - 1); /* far from cancelling: the units are far below the last place */
        PROVE(rounds(&r, (int64_t)((uint64_t)a.mantissa << 31) + (b.mantissa >> (apart - 31)), a.exponent - 31));
    }
}

void sum_reversed(void)
{
    const drogue_real a = any_real();
    const drogue_real b = any_real();
    drogue_real r;
    drogue_real s;
    drogue_real_sum(&r, &a, &b);
    drogue_real_sum(&s, &b, &a);
    PROVE(r.mantissa == s.mantissa && r.exponent == s.exponent);
}

/* Further apart, or with a 0, the sum is the larger number itself. */
void sum_apart(void)
{
    const drogue_real a = any_real();
    const drogue_real b = any_real();
    drogue_real r;
    ASSUME(b.mantissa == 0 || (a.mantissa != 0 && a.exponent - b.exponent > 62));
    drogue_real_sum(&r, &a, &b);
    PROVE(r.mantissa == a.mantissa && r.exponent == a.exponent);
}

void difference(void)
{
    const drogue_real a = any_real();
    drogue_real b = any_real();
    drogue_real r;
    drogue_real s;
    drogue_real_difference(&r, &a, &b);
    drogue_real_negate(&b);
    PROVE(normal(&b));
    drogue_real_sum(&s, &a, &b);
    PROVE(r.mantissa == s.mantissa && r.exponent == s.exponent);
}

void fixed_point(void)
{
    const drogue_real v = any_real();
    const int bits = any_within(0, 62);
    const int32_t s = v.exponent + bits;
    const int64_t r = drogue_real_to_s64(v, bits);
    if (v.mantissa == 0 || s < -31) {
        PROVE(r == 0);
    } else if (s > 32) {
        PROVE(r == (v.mantissa < 0 ? INT64_MIN : INT64_MAX));
    } else if (s >= 0) {
        PROVE(r >> s == v.mantissa && (s == 0 || (uint64_t)r << (64 - s) == 0));
    } else {
        const int64_t rest = v.mantissa - (int64_t)((uint64_t)r << -s);
        PROVE(rest >= -(INT64_C(1) << (-s - 1)) && rest < INT64_C(1) << (-s - 1));
    }
}

void order(void)
{
    const drogue_real a = any_real();
    const drogue_real b = any_real();
    const int32_t apart = a.exponent - b.exponent;
    const int r = drogue_real_order(&a, &b);
    PROVE(r == -drogue_real_order(&b, &a));
    if (apart >= 0 && apart <= 31) {
        const int64_t difference = (int64_t)((uint64_t)a.mantissa << apart) - b.mantissa;
        PROVE(a.mantissa == 0 || b.mantissa == 0 || r == (difference > 0) - (difference < 0));
    }
}
