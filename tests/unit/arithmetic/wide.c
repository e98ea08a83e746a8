/* SPDX-License-Identifier: Apache-2.0 */
/* 128-bit and 62-bit mantissa arithmetic against the compiler's 128-bit integers: every bit. */
#include "suite.h"

#include "drogue/wide.h"

#define RANDOM_CASES 1000000

__extension__ typedef __int128 wide128;
__extension__ typedef unsigned __int128 uwide128;

static const int64_t edges64[] = {0,
                                  1,
                                  -1,
                                  2,
                                  -2,
                                  3,
                                  -3,
                                  INT64_C(0x7FFFFFFF),
                                  INT64_C(0x80000000),
                                  INT64_C(0xFFFFFFFF),
                                  INT64_C(0x100000000),
                                  -INT64_C(0x80000000),
                                  -INT64_C(0xFFFFFFFF),
                                  -INT64_C(0x100000000),
                                  INT64_C(1) << 61,
                                  -(INT64_C(1) << 61),
                                  (INT64_C(1) << 61) + 1,
                                  (INT64_C(1) << 62) - 1,
                                  1 - (INT64_C(1) << 62),
                                  INT64_C(1) << 62,
                                  -(INT64_C(1) << 62),
                                  (INT64_C(1) << 62) + 1,
                                  INT64_MAX - 2,
                                  INT64_MAX - 1,
                                  INT64_MAX,
                                  INT64_MIN + 1,
                                  INT64_MIN};
#define EDGES (sizeof edges64 / sizeof edges64[0])

static wide128 value_of(drogue_s128 v) { return (wide128)(((uwide128)(uint64_t)v.hi << 64) | v.lo); }

static drogue_s128 s128_of(wide128 v)
{
    drogue_s128 r;
    r.hi = (int64_t)(v >> 64);
    r.lo = (uint64_t)v;
    return r;
}

static wide128 shift_left(wide128 v, int n) { return (wide128)((uwide128)v << n); }

/* v / 2^n to nearest, ties toward +infinity. */
static wide128 shift_round(wide128 v, int n) { return n == 0 ? v : (v >> n) + ((v >> (n - 1)) & 1); }

/* v * 2^exponent with a mantissa of 62 bits. */
static drogue_wide model_normalise(wide128 v, int32_t exponent)
{
    drogue_wide r = {0, 0};
    uwide128 magnitude = v < 0 ? (uwide128)0 - (uwide128)v : (uwide128)v;
    int shift = -62;
    wide128 m;
    while (magnitude != 0) {
        shift++;
        magnitude >>= 1;
    }
    if (v == 0) {
        return r;
    }
    m = shift > 0 ? shift_round(v, shift) : shift_left(v, -shift);
    if (m == (wide128)1 << 62 || m == -((wide128)1 << 62)) {
        m /= 2;
        shift++;
    }
    r.mantissa = (int64_t)m;
    r.exponent = exponent + shift;
    return r;
}

static void must_equal(const char *what, drogue_wide got, drogue_wide expected)
{
    MUST(got.mantissa == expected.mantissa && got.exponent == expected.exponent,
         "%s: %lld * 2^%d instead of %lld * 2^%d", what, (long long)got.mantissa, (int)got.exponent,
         (long long)expected.mantissa, (int)expected.exponent);
}

static void check_s128_pair(int64_t a, int64_t b, wide128 p, wide128 q)
{
    int n;
    MUST(value_of(drogue_s128_mul(a, b)) == (wide128)a * b, "s128_mul %lld %lld", (long long)a, (long long)b);
    MUST(value_of(drogue_s128_from_s64(a)) == a, "s128_from_s64 %lld", (long long)a);
    MUST(value_of(drogue_s128_add(s128_of(p), s128_of(q))) == (wide128)((uwide128)p + (uwide128)q), "s128_add");
    MUST(value_of(drogue_s128_sub(s128_of(p), s128_of(q))) == (wide128)((uwide128)p - (uwide128)q), "s128_sub");
    MUST(drogue_s128_cmp(s128_of(p), s128_of(q)) == (p > q) - (p < q), "s128_cmp");
    MUST(drogue_s128_cmp(s128_of(p), s128_of(p)) == 0, "s128_cmp of equals");
    for (n = 1; n <= 63; n++) {
        wide128 r = shift_round((wide128)a * b, n);
        if (r >= INT64_MIN && r <= INT64_MAX) {
            MUST(drogue_mul_shr_round_s64(a, b, n) == (int64_t)r, "mul_shr_round %lld %lld %d", (long long)a,
                 (long long)b, n);
        }
    }
}

static void check_conversions(int64_t v, wide128 w, int32_t exponent)
{
    int frac;
    drogue_wide r = drogue_wide_from_s64(v, exponent);
    must_equal("from_s64", r, model_normalise(v, exponent));
    must_equal("from_s128", drogue_wide_from_s128(s128_of(w), exponent), model_normalise(w, exponent));
    must_equal("from_q16", drogue_wide_from_q16((drogue_q16)v), model_normalise((drogue_q16)v, -16));
    must_equal("scale", drogue_wide_scale(r, 5), model_normalise(v, exponent + 5));
    must_equal("neg", drogue_wide_neg(r), (drogue_wide){-r.mantissa, r.exponent});
    for (frac = -70; frac <= 70; frac += 7) {
        int shift = r.exponent + frac;
        wide128 exact = shift > 1    ? (r.mantissa == 0  ? 0
                                        : r.mantissa < 0 ? (wide128)INT64_MIN
                                                         : (wide128)INT64_MAX)
                        : shift >= 0 ? shift_left(r.mantissa, shift)
                                     : shift_round(r.mantissa, shift < -127 ? 127 : -shift);
        int64_t q = drogue_wide_to_s64(r, frac);
        MUST(q == (int64_t)exact, "to_s64 of %lld * 2^%d by %d", (long long)r.mantissa, (int)r.exponent, frac);
        if (frac == 0) {
            int32_t to_q16 = drogue_wide_to_q16(drogue_wide_scale(r, -16));
            MUST(to_q16 == (q > INT32_MAX ? INT32_MAX : q < INT32_MIN ? INT32_MIN : q), "to_q16");
        }
    }
}

static drogue_wide model_add(drogue_wide a, drogue_wide b)
{
    int shift = a.exponent - b.exponent;
    if (a.mantissa == 0 || b.mantissa == 0) {
        return a.mantissa == 0 ? b : a;
    }
    if (shift < 0) {
        return model_add(b, a);
    }
    return shift > 64 ? a : model_normalise(shift_left(a.mantissa, shift) + b.mantissa, b.exponent);
}

static drogue_wide model_div(drogue_wide a, drogue_wide b)
{
    uint64_t ma = drogue_abs_u64(a.mantissa), mb = drogue_abs_u64(b.mantissa);
    int shift = ma >= mb ? 61 : 62;
    wide128 num = shift_left(b.mantissa < 0 ? -a.mantissa : a.mantissa, shift + 1) + (wide128)mb;
    wide128 den = 2 * (wide128)mb;
    if (ma == 0 || mb == 0) {
        return model_normalise(0, 0);
    }
    num = num >= 0 ? num / den : -((den - 1 - num) / den);
    return model_normalise(num, a.exponent - b.exponent - shift);
}

static void check_sqrt(drogue_wide v)
{
    drogue_wide r = drogue_wide_sqrt(v);
    int shift = ((v.exponent & 1) == 0) ? 62 : 61;
    uwide128 four, m = (uwide128)r.mantissa;
    if (v.mantissa <= 0) {
        must_equal("sqrt of nothing", r, model_normalise(0, 0));
        return;
    }
    four = (uwide128)v.mantissa << (shift + 2);
    MUST(r.exponent == (v.exponent - shift) / 2 && (2 * m - 1) * (2 * m - 1) <= four &&
             (2 * m + 1) * (2 * m + 1) > four,
         "sqrt %lld * 2^%d gives %lld * 2^%d", (long long)v.mantissa, (int)v.exponent, (long long)r.mantissa,
         (int)r.exponent);
}

static void check_wide_pair(drogue_wide a, drogue_wide b)
{
    drogue_wide d = model_add(a, drogue_wide_neg(b));
    must_equal("add", drogue_wide_add(a, b), model_add(a, b));
    must_equal("sub", drogue_wide_sub(a, b), d);
    must_equal("mul", drogue_wide_mul(a, b),
               model_normalise((wide128)a.mantissa * b.mantissa, a.exponent + b.exponent));
    must_equal("div", drogue_wide_div(a, b), model_div(a, b));
    MUST(drogue_wide_cmp(a, b) == (d.mantissa > 0) - (d.mantissa < 0), "cmp");
    check_sqrt(a);
}

START_TEST(edge_values)
{
    size_t i, j;
    int32_t e;
    for (i = 0; i < EDGES; i++) {
        for (j = 0; j < EDGES; j++) {
            wide128 p = shift_left(edges64[i], 64) | (uint64_t)edges64[j];
            wide128 q = shift_left(edges64[j], 64) | (uint64_t)edges64[i];
            check_s128_pair(edges64[i], edges64[j], p, q);
            check_conversions(edges64[i], p, (int32_t)j - 60);
            for (e = -70; e <= 70; e++) {
                check_wide_pair(drogue_wide_from_s64(edges64[i], e), drogue_wide_from_s64(edges64[j], 0));
            }
        }
    }
    check_conversions(INT64_MIN, shift_left(1, 127), 1000000);
    must_equal("scale of 0", drogue_wide_scale(drogue_wide_from_s64(0, 3), 7), model_normalise(0, 0));
}
END_TEST

START_TEST(random_values)
{
    uint64_t rng = 1;
    int32_t i;
    for (i = 0; i < RANDOM_CASES; i++) {
        int64_t a = rng_s64_any_width(&rng), b = rng_s64_any_width(&rng);
        wide128 p = (shift_left(rng_s64_any_width(&rng), 64) | (wide128)rng_u64(&rng)) >> (rng_u64(&rng) & 127u);
        wide128 q = (shift_left(rng_s64_any_width(&rng), 64) | (wide128)rng_u64(&rng)) >> (rng_u64(&rng) & 127u);
        int32_t e = rng_range(&rng, -140, 140);
        if ((i & 7) == 0) {
            check_s128_pair(a, b, p, q);
            check_conversions(a, p, e);
        }
        check_wide_pair(drogue_wide_from_s64(a, e), drogue_wide_from_s64(b, rng_range(&rng, -140, 140)));
        check_wide_pair(drogue_wide_from_s64((int64_t)rng_u64(&rng), e),
                        drogue_wide_from_s64((int64_t)rng_u64(&rng), e + rng_range(&rng, -66, 66)));
    }
}
END_TEST

/* Sums that cancel and quotients and roots next to a tie: where a sticky bit lost would show. */
START_TEST(values_next_to_ties)
{
    const int64_t one = INT64_C(1) << 61;
    uint64_t rng = 2;
    int32_t i;
    for (i = 0; i < 300000; i++) {
        int64_t m = one + (int64_t)(rng_u64(&rng) >> 3);
        int64_t n = one + rng_range(&rng, 0, 3);
        drogue_wide a = {m, 0};
        drogue_wide b = {-n, rng_range(&rng, -66, -58)};
        int64_t c = -m + rng_range(&rng, -3, 3);
        int64_t r = one + (int64_t)(rng_u64(&rng) >> 3);
        wide128 square = (wide128)r * r;
        check_wide_pair(a, b);
        check_wide_pair(drogue_wide_neg(a), drogue_wide_neg(b));
        check_wide_pair(a, drogue_wide_from_s64(c, 0));
        check_sqrt(model_normalise(square, rng_range(&rng, 0, 1)));
        check_sqrt(model_normalise(square + (wide128)r, rng_range(&rng, 0, 1)));
        /* (2k + 1) * d / (2 d): quotients that end in an exact half */
        check_wide_pair(drogue_wide_from_s64(((int64_t)rng_u64(&rng) >> 32) * 2 + 1, 0), drogue_wide_from_s64(n, 0));
    }
}
END_TEST

START_TEST(atan2_within_2_to_minus_26)
{
    double worst = 0;
    uint64_t rng = 3;
    int32_t i;
    for (i = 0; i < 500000; i++) {
        drogue_wide y = drogue_wide_from_s64((int64_t)rng_u64(&rng), rng_range(&rng, -40, 40));
        drogue_wide x = drogue_wide_from_s64((int64_t)rng_u64(&rng), rng_range(&rng, -40, 40));
        long double exact =
            atan2l(ldexpl((long double)y.mantissa, y.exponent), ldexpl((long double)x.mantissa, x.exponent));
        worst = fmax(worst, (double)fabsl((long double)drogue_wide_atan2_q29(y, x) - exact * 536870912.0L));
    }
    MUST(worst <= 8.0, "error %.3f of 2^-29 rad", worst);
    ck_assert_int_eq(drogue_wide_atan2_q29(drogue_wide_from_s64(0, 0), drogue_wide_from_s64(0, 0)), 0);
    ck_assert_int_eq(drogue_wide_atan2_q29(drogue_wide_from_s64(0, 0), drogue_wide_from_s64(-1, -300)), 1686629713);
    ck_assert_int_eq(drogue_wide_atan2_q29(drogue_wide_from_s64(-1, -300), drogue_wide_from_s64(-1, 300)), -1686629713);
    ck_assert_int_eq(drogue_wide_atan2_q29(drogue_wide_from_s64(1, 300), drogue_wide_from_s64(1, -300)), 843314857);
}
END_TEST

SUITE_MAIN("wide", edge_values, random_values, values_next_to_ties, atan2_within_2_to_minus_26)
