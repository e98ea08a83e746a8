/* SPDX-License-Identifier: Apache-2.0 */
/* 31-bit floating point against the compiler's 128-bit integers: every bit. */
#include "suite.h"

#include "drogue/real.h"

#define RANDOM_CASES 5000000 /* two pairs each */

__extension__ typedef __int128 s128;
__extension__ typedef unsigned __int128 u128;

static const int64_t edges64[] = {0,
                                  1,
                                  -1,
                                  2,
                                  -2,
                                  3,
                                  -3,
                                  INT64_C(1) << 30,
                                  -(INT64_C(1) << 30),
                                  (INT64_C(1) << 30) + 1,
                                  -(INT64_C(1) << 30) - 1,
                                  INT64_C(0x7FFFFFFE),
                                  INT64_C(0x7FFFFFFF),
                                  INT64_C(0x80000000),
                                  INT64_C(0xFFFFFFFF),
                                  INT64_C(0x100000000),
                                  INT64_C(0x17FFFFFFF),
                                  -INT64_C(0x7FFFFFFF),
                                  -INT64_C(0x80000000),
                                  -INT64_C(0xFFFFFFFF),
                                  -INT64_C(0x100000000),
                                  INT64_C(1) << 62,
                                  -(INT64_C(1) << 62),
                                  (INT64_C(1) << 62) - 1,
                                  (INT64_C(1) << 62) + 1,
                                  INT64_MAX - 1,
                                  INT64_MAX,
                                  INT64_MIN + 1,
                                  INT64_MIN};
#define EDGES (sizeof edges64 / sizeof edges64[0])

static s128 shift_left(s128 v, int n) { return (s128)((u128)v << n); }

/* v / 2^n to nearest, ties toward +infinity. */
static s128 shift_round(s128 v, int n) { return n == 0 ? v : (v >> n) + ((v >> (n - 1)) & 1); }

static drogue_real real(int64_t v, int32_t exponent)
{
    drogue_real r;
    drogue_real_set(&r, v, exponent);
    return r;
}

/* v * 2^exponent with a mantissa of 31 bits. */
static drogue_real model_normalise(s128 v, int32_t exponent)
{
    drogue_real r = {0, 0};
    u128 magnitude = v < 0 ? (u128)0 - (u128)v : (u128)v;
    int shift = -31;
    s128 m;
    while (magnitude >> 32 != 0) {
        shift += 32;
        magnitude >>= 32;
    }
    while (magnitude != 0) {
        shift++;
        magnitude >>= 1;
    }
    if (v == 0) {
        return r;
    }
    m = shift > 0 ? shift_round(v, shift) : shift_left(v, -shift);
    if (m == (s128)1 << 31 || m == -((s128)1 << 31)) {
        m /= 2;
        shift++;
    }
    r.mantissa = (int32_t)m;
    r.exponent = exponent + shift;
    return r;
}

static void must_equal(const char *what, drogue_real got, drogue_real expected)
{
    MUST(got.mantissa == expected.mantissa && got.exponent == expected.exponent, "%s: %d * 2^%d instead of %d * 2^%d",
         what, (int)got.mantissa, (int)got.exponent, (int)expected.mantissa, (int)expected.exponent);
}

static void check_conversions(int64_t v, int32_t exponent)
{
    const drogue_real r = real(v, exponent);
    drogue_real t;
    int frac;
    must_equal("set", r, model_normalise(v, exponent));
    drogue_real_set_q16(&t, (drogue_q16)v);
    must_equal("set_q16", t, model_normalise((drogue_q16)v, -16));
    drogue_real_copy(&t, &r);
    drogue_real_shift(&t, 5);
    must_equal("shift", t, model_normalise(v, exponent + 5));
    drogue_real_copy(&t, &r);
    drogue_real_negate(&t);
    must_equal("negate", t, (drogue_real){-r.mantissa, r.exponent});
    for (frac = -70; frac <= 70; frac += 5) {
        const int shift = r.exponent + frac;
        const s128 exact = shift > 32   ? (r.mantissa == 0  ? 0
                                           : r.mantissa < 0 ? (s128)INT64_MIN
                                                            : (s128)INT64_MAX)
                           : shift >= 0 ? shift_left(r.mantissa, shift)
                                        : shift_round(r.mantissa, shift < -127 ? 127 : -shift);
        const int32_t saturated = (int32_t)(exact > INT32_MAX ? INT32_MAX : exact < INT32_MIN ? INT32_MIN : exact);
        MUST(drogue_real_to_s64(r, frac) == (int64_t)exact, "to_s64 of %d * 2^%d by %d", (int)r.mantissa,
             (int)r.exponent, frac);
        MUST(drogue_real_to_s32(r, frac) == saturated, "to_s32");
        if (frac == 0) {
            drogue_real_copy(&t, &r);
            drogue_real_shift(&t, -16);
            MUST(drogue_real_to_q16(t) == saturated, "to_q16");
        }
    }
}

static drogue_real model_sum(drogue_real a, drogue_real b)
{
    const int shift = a.exponent - b.exponent;
    if (a.mantissa == 0 || b.mantissa == 0) {
        return a.mantissa == 0 ? b : a;
    }
    if (shift < 0) {
        return model_sum(b, a);
    }
    return shift > 64 ? a : model_normalise(shift_left(a.mantissa, shift) + b.mantissa, b.exponent);
}

static drogue_real model_quotient(drogue_real a, drogue_real b)
{
    const uint64_t ma = drogue_abs_u64(a.mantissa), mb = drogue_abs_u64(b.mantissa);
    const int shift = ma >= mb ? 30 : 31;
    s128 num = shift_left(b.mantissa < 0 ? -(s128)a.mantissa : a.mantissa, shift + 1) + (s128)mb;
    const s128 den = 2 * (s128)mb;
    if (ma == 0 || mb == 0) {
        return model_normalise(0, 0);
    }
    num = num >= 0 ? num / den : -((den - 1 - num) / den);
    return model_normalise(num, a.exponent - b.exponent - shift);
}

static void check_root(drogue_real v)
{
    const int shift = (v.exponent & 1) == 0 ? 30 : 31;
    drogue_real r;
    u128 four, m;
    drogue_real_root(&r, &v);
    if (v.mantissa <= 0) {
        must_equal("root of nothing", r, model_normalise(0, 0));
        return;
    }
    m = (u128)r.mantissa;
    four = (u128)v.mantissa << (shift + 2);
    MUST(r.exponent == (v.exponent - shift) / 2 && (2 * m - 1) * (2 * m - 1) <= four &&
             (2 * m + 1) * (2 * m + 1) > four,
         "root of %d * 2^%d is %d * 2^%d", (int)v.mantissa, (int)v.exponent, (int)r.mantissa, (int)r.exponent);
}

/* Two products: to half a unit of the result and 2^-61 of the larger one, which is exact where nothing is lost. */
static void check_two_terms(const char *what, drogue_real got, s128 p, int32_t p_exponent, s128 q, int32_t q_exponent)
{
    const int shift = p_exponent - q_exponent;
    s128 exact, slack, value;
    if (p == 0 || (q != 0 && shift < 0)) {
        if (q != 0) {
            check_two_terms(what, got, q, q_exponent, p, p_exponent);
        } else {
            must_equal(what, got, model_normalise(0, 0));
        }
        return;
    }
    if (q == 0 || shift > 63) {
        must_equal(what, got, model_normalise(p, p_exponent));
        return;
    }
    exact = shift_left(p, shift) + q;
    must_equal(what, got, model_normalise(p + (q >> shift), p_exponent));
    if (got.mantissa == 0) {
        MUST(exact < shift_left(1, shift) && exact >= 0, "%s: 0", what);
        return;
    }
    if (got.exponent <= q_exponent) {
        MUST(got.mantissa == shift_left(exact, q_exponent - got.exponent), "%s: not exact", what);
        return;
    }
    value = shift_left(got.mantissa, got.exponent - q_exponent);
    slack = shift_left(1, got.exponent - q_exponent - 1) + shift_left(1, shift) - 1;
    MUST(value - exact <= slack && exact - value <= slack, "%s: %d * 2^%d", what, (int)got.mantissa, (int)got.exponent);
    must_equal(what, got, model_normalise(p + (q >> shift), p_exponent));
}

static void check_pair(drogue_real a, drogue_real b)
{
    const drogue_real minus_b = {-b.mantissa, b.exponent};
    const drogue_real difference = model_sum(a, minus_b);
    const s128 ab = (s128)a.mantissa * b.mantissa;
    drogue_real r;
    drogue_real_sum(&r, &a, &b);
    must_equal("sum", r, model_sum(a, b));
    drogue_real_difference(&r, &a, &b);
    must_equal("difference", r, difference);
    drogue_real_product(&r, &a, &b);
    must_equal("product", r, model_normalise(ab, a.exponent + b.exponent));
    drogue_real_quotient(&r, &a, &b);
    must_equal("quotient", r, model_quotient(a, b));
    MUST(drogue_real_order(&a, &b) == (difference.mantissa > 0) - (difference.mantissa < 0), "order");
    check_root(a);
    drogue_real_copy(&r, &a);
    drogue_real_subtract_product(&r, &a, &b);
    check_two_terms("subtract_product", r, shift_left(a.mantissa, 31), a.exponent - 31, -ab, a.exponent + b.exponent);
    drogue_real_copy(&r, &b);
    drogue_real_products(&r, &a, &r, &r, &r);
    check_two_terms("products", r, ab, a.exponent + b.exponent, (s128)b.mantissa * b.mantissa, 2 * b.exponent);
    drogue_real_determinant(&r, &a, &a, &a, &b);
    check_two_terms("determinant", r, (s128)a.mantissa * a.mantissa, 2 * a.exponent, -ab, a.exponent + b.exponent);
}

START_TEST(edge_values)
{
    size_t i, j;
    int32_t e;
    for (i = 0; i < EDGES; i++) {
        for (j = 0; j < EDGES; j++) {
            check_conversions(edges64[i], (int32_t)j * 3 - 60);
            for (e = -70; e <= 70; e++) {
                check_pair(real(edges64[i], e), real(edges64[j], 0));
            }
        }
    }
    check_conversions(INT64_MIN, 1000000);
}
END_TEST

START_TEST(random_values)
{
    uint64_t rng = 1;
    int32_t i;
    for (i = 0; i < RANDOM_CASES; i++) {
        const int64_t a = rng_s64_any_width(&rng), b = rng_s64_any_width(&rng);
        const int32_t e = rng_range(&rng, -140, 140);
        if ((i & 7) == 0) {
            check_conversions(a, e);
        }
        check_pair(real(a, e), real(b, rng_range(&rng, -140, 140)));
        check_pair(real((int64_t)rng_u64(&rng), e), real((int64_t)rng_u64(&rng), e + rng_range(&rng, -36, 36)));
    }
}
END_TEST

/* Sums that cancel and quotients and roots next to a tie: where a bit lost would show. */
START_TEST(values_next_to_ties)
{
    const int32_t one = 1 << 30;
    uint64_t rng = 2;
    int32_t i;
    for (i = 0; i < 1000000; i++) {
        const int32_t m = one + (int32_t)(rng_u64(&rng) >> 34);
        const int32_t n = one + rng_range(&rng, 0, 3);
        const drogue_real a = {m, 0};
        const drogue_real b = {-n, rng_range(&rng, -36, -28)};
        const drogue_real minus_a = {-m, 0};
        const drogue_real minus_b = {n, b.exponent};
        const int64_t r = one + (int64_t)(rng_u64(&rng) >> 34);
        check_pair(a, b);
        check_pair(minus_a, minus_b);
        check_pair(a, real(-(int64_t)m + rng_range(&rng, -3, 3), 0));
        check_root(model_normalise((s128)r * r, rng_range(&rng, 0, 1)));
        check_root(model_normalise((s128)r * r + r, rng_range(&rng, 0, 1)));
        /* quotients on either side of one, and of 2: the ends of the divisor's range */
        check_pair(real(m, 0), real((int64_t)m + rng_range(&rng, -2, 2), 0));
        check_pair(real(INT32_MAX - rng_range(&rng, 0, 3), 0), real(n, 0));
        check_pair(real(n, 0), real(INT32_MAX - rng_range(&rng, 0, 3), 0));
    }
}
END_TEST

START_TEST(atan2_within_2_to_minus_26)
{
    const drogue_real zero = {0, 0};
    double worst = 0;
    uint64_t rng = 3;
    int32_t i;
    for (i = 0; i < 500000; i++) {
        const drogue_real y = real((int64_t)rng_u64(&rng), rng_range(&rng, -40, 40));
        const drogue_real x = real((int64_t)rng_u64(&rng), rng_range(&rng, -40, 40));
        const long double exact =
            atan2l(ldexpl((long double)y.mantissa, y.exponent), ldexpl((long double)x.mantissa, x.exponent));
        worst = fmax(worst, (double)fabsl((long double)drogue_real_atan2_q29(y, x) - exact * 536870912.0L));
    }
    MUST(worst <= 8.0, "error %.3f of 2^-29 rad", worst);
    ck_assert_int_eq(drogue_real_atan2_q29(zero, zero), 0);
    ck_assert_int_eq(drogue_real_atan2_q29(zero, real(-1, -300)), 1686629713);
    ck_assert_int_eq(drogue_real_atan2_q29(real(-1, -300), real(-1, 300)), -1686629713);
    ck_assert_int_eq(drogue_real_atan2_q29(real(1, 300), real(1, -300)), 843314857);
}
END_TEST

SUITE_MAIN("real", edge_values, random_values, values_next_to_ties, atan2_within_2_to_minus_26)
