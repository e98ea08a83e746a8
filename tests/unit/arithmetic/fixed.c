/* SPDX-License-Identifier: Apache-2.0 */
/* Q16 primitives against 128-bit integers, CORDIC and the exponential against libm. */
#include "suite.h"

#include "drogue/fixed.h"

#define RANDOM_CASES 3000000

__extension__ typedef __int128 wide128;

static const int64_t edges64[] = {0,
                                  1,
                                  -1,
                                  2,
                                  -2,
                                  3,
                                  -3,
                                  32767,
                                  32768,
                                  -32768,
                                  65535,
                                  65536,
                                  -65536,
                                  65537,
                                  INT32_MAX - 1,
                                  INT32_MAX,
                                  (int64_t)INT32_MAX + 1,
                                  INT32_MIN,
                                  (int64_t)INT32_MIN - 1,
                                  (int64_t)UINT32_MAX,
                                  (int64_t)UINT32_MAX + 1,
                                  INT64_C(1) << 61,
                                  -(INT64_C(1) << 61),
                                  (INT64_C(1) << 62) - 1,
                                  INT64_C(1) << 62,
                                  INT64_MAX - 1,
                                  INT64_MAX,
                                  INT64_MIN + 1,
                                  INT64_MIN};
#define EDGES (sizeof edges64 / sizeof edges64[0])

static int32_t model_sat(wide128 v) { return v > INT32_MAX ? INT32_MAX : v < INT32_MIN ? INT32_MIN : (int32_t)v; }

/* floor(num / den), den > 0, without the sign rules of C's division. */
static wide128 model_floor_div(wide128 num, wide128 den) { return num >= 0 ? num / den : -((-num + den - 1) / den); }

static wide128 model_div_round(wide128 num, wide128 den) { return model_floor_div(2 * num + den, 2 * den); }

static int32_t model_q16_div(int32_t a, int32_t b)
{
    if (b == 0) {
        return a > 0 ? INT32_MAX : a < 0 ? INT32_MIN : 0;
    }
    return model_sat(b > 0 ? model_div_round((wide128)a * 65536, b)
                           : model_div_round((wide128)a * -65536, -(wide128)b));
}

static void check_q16_pair(int32_t a, int32_t b)
{
    MUST(drogue_q16_add(a, b) == model_sat((wide128)a + b), "add %d %d", a, b);
    MUST(drogue_q16_sub(a, b) == model_sat((wide128)a - b), "sub %d %d", a, b);
    MUST(drogue_q16_mul(a, b) == model_sat(model_div_round((wide128)a * b, 65536)), "mul %d %d", a, b);
    MUST(drogue_q16_div(a, b) == model_q16_div(a, b), "div %d %d", a, b);
}

static void check_shift_and_sign(int64_t v)
{
    int n, bits = 0;
    uint64_t u = (uint64_t)v;
    for (n = 0; n <= 63; n++) {
        wide128 expected = model_div_round(v, (wide128)1 << n);
        MUST(drogue_shr_round_s64(v, n) == (int64_t)expected, "shr_round %lld %d", (long long)v, n);
    }
    while (u != 0) {
        bits++;
        u >>= 1;
    }
    MUST(drogue_clz_u64((uint64_t)v) == 64 - bits, "clz %lld", (long long)v);
    MUST((wide128)drogue_abs_u64(v) == (v < 0 ? -(wide128)v : (wide128)v), "abs %lld", (long long)v);
    MUST(drogue_sat_s32(v) == model_sat(v), "sat %lld", (long long)v);
}

static void check_integer_division(int64_t num, int64_t den)
{
    if (den <= 0) {
        return;
    }
    MUST(drogue_floor_div_s64(num, den) == (int64_t)model_floor_div(num, den), "floor_div %lld %lld", (long long)num,
         (long long)den);
    if (den <= (INT64_C(1) << 61) && num <= (INT64_C(1) << 61) && num >= -(INT64_C(1) << 61)) {
        MUST(drogue_div_round_s64(num, den) == (int64_t)model_div_round(num, den), "div_round %lld %lld",
             (long long)num, (long long)den);
    }
}

static void check_isqrt(uint64_t v)
{
    wide128 r = drogue_isqrt_u64(v);
    MUST(r * r <= (wide128)v && (r + 1) * (r + 1) > (wide128)v, "isqrt %llu", (unsigned long long)v);
}

START_TEST(edge_values)
{
    size_t i, j;
    for (i = 0; i < EDGES; i++) {
        check_shift_and_sign(edges64[i]);
        check_isqrt((uint64_t)edges64[i]);
        MUST(drogue_q16_from_int((int32_t)edges64[i]) == model_sat((wide128)(int32_t)edges64[i] * 65536), "from_int");
        for (j = 0; j < EDGES; j++) {
            check_q16_pair((int32_t)edges64[i], (int32_t)edges64[j]);
            check_integer_division(edges64[i], edges64[j]);
        }
    }
}
END_TEST

START_TEST(random_values)
{
    uint64_t rng = 1;
    int32_t i;
    for (i = 0; i < RANDOM_CASES; i++) {
        int64_t a = rng_s64_any_width(&rng);
        int64_t b = rng_s64_any_width(&rng);
        check_q16_pair(rng_s32_any_width(&rng), rng_s32_any_width(&rng));
        check_integer_division(a, b);
        check_integer_division(a >> 2, (int64_t)(drogue_abs_u64(b) >> 2));
        check_isqrt((uint64_t)a);
    }
    for (i = 0; i < RANDOM_CASES / 30; i++) {
        check_shift_and_sign(rng_s64_any_width(&rng));
    }
}
END_TEST

START_TEST(isqrt_next_to_every_kind_of_square)
{
    uint64_t rng = 2;
    int32_t i;
    for (i = 0; i < 1000000; i++) {
        uint64_t r = i < 1000 ? UINT32_MAX - (uint64_t)i : rng_u64(&rng) >> (32 + (i & 31));
        check_isqrt(r * r);
        check_isqrt(r * r - 1u);
        check_isqrt(r * r + 2u * r);
    }
}
END_TEST

START_TEST(shift_left_keeps_the_value)
{
    int n;
    for (n = 0; n <= 62; n++) {
        ck_assert_int_eq(drogue_shl_s64(1, n), (int64_t)((wide128)1 << n));
        ck_assert_int_eq(drogue_shl_s64(-1, n), (int64_t)(-((wide128)1 << n)));
    }
    ck_assert_int_eq(drogue_shl_s64(-1, 63), INT64_MIN);
    ck_assert_int_eq(drogue_shl_s64(0, 63), 0);
}
END_TEST

START_TEST(constants)
{
    ck_assert_int_eq(DROGUE_Q16(1, 1), DROGUE_Q16_ONE);
    ck_assert_int_eq(DROGUE_Q16(1, 3), 21845);
    ck_assert_int_eq(DROGUE_Q16(2, 3), 43691);
    ck_assert_int_eq(DROGUE_Q16(1, 131072), 1); /* half a unit goes up */
    ck_assert_int_eq(DROGUE_Q16(1, 131073), 0);
    ck_assert_int_eq(DROGUE_Q16(32767, 1), 32767 * 65536);
    ck_assert_int_eq(DROGUE_Q16_PI, q16_of(TEST_PI));
    ck_assert_int_eq(DROGUE_Q16_HALF_PI, q16_of(TEST_PI / 2));
}
END_TEST

/* Distance of atan2_q29 from libm in units of 2^-29 rad. */
static double atan2_error(int64_t y, int64_t x)
{
    int32_t r = drogue_atan2_q29(y, x);
    long double e = atan2l((long double)y, (long double)x) * 536870912.0L;
    MUST(r >= -1686629713 && r <= 1686629713, "atan2_q29(%lld, %lld) leaves [-pi, pi]", (long long)y, (long long)x);
    return (double)fabsl((long double)r - e);
}

START_TEST(atan2_within_2_to_minus_26)
{
    double worst = 0;
    uint64_t rng = 3;
    size_t i, j;
    int32_t k;
    for (i = 0; i < EDGES; i++) {
        for (j = 0; j < EDGES; j++) {
            if (edges64[i] != 0 || edges64[j] != 0) {
                worst = fmax(worst, atan2_error(edges64[i], edges64[j]));
            }
        }
    }
    for (k = 0; k < 500000; k++) { /* all around, at a large and at a small radius */
        double t = -TEST_PI + 2 * TEST_PI * (k + 0.5) / 500000.0;
        worst = fmax(worst, atan2_error((int64_t)(sin(t) * 4.0e18), (int64_t)(cos(t) * 4.0e18)));
        worst = fmax(worst, atan2_error((int64_t)(sin(t) * 1000.0), 1 + (int64_t)(cos(t) * 1000.0)));
        worst = fmax(worst, atan2_error(rng_s64_any_width(&rng), 1 | rng_s64_any_width(&rng)));
    }
    MUST(worst <= 8.0, "error %.3f of 2^-29 rad", worst);
    ck_assert_int_eq(drogue_atan2_q29(0, 0), 0);
}
END_TEST

static double sincos_error(int32_t angle_q29)
{
    int32_t s, c;
    double t = (double)angle_q29 / 536870912.0;
    drogue_sincos_q30(&s, &c, angle_q29);
    return fmax(fabs(s - sin(t) * 1073741824.0), fabs(c - cos(t) * 1073741824.0));
}

START_TEST(sincos_within_2_to_minus_29)
{
    static const int32_t special[] = {0,           1,          -1,          421657428,  -421657428, 421657429,
                                      843314856,   843314857,  -843314857,  1264972285, 1686629712, 1686629713,
                                      -1686629713, 1686634496, -1686634496, INT32_MAX,  -INT32_MAX};
    double worst = 0;
    size_t j;
    int32_t i;
    for (j = 0; j < sizeof special / sizeof special[0]; j++) {
        worst = fmax(worst, sincos_error(special[j]));
    }
    for (i = 0; i < 1000000; i++) {
        worst = fmax(worst, sincos_error((int32_t)(-1686629713 + (int64_t)i * 3373259426 / 999999)));
    }
    MUST(worst <= 2.0, "error %.3f of 2^-30", worst);
}
END_TEST

START_TEST(rotation_rounds_what_is_exact)
{
    static const int32_t ends[6] = {INT32_MIN, INT32_MIN + 1, -1, 0, 1, INT32_MAX};
    uint64_t rng = 1;
    int32_t i;
    for (i = 0; i < 200000; i++) {
        const int32_t u = i % 3 == 0 ? ends[i / 3 % 6] : rng_s32_any_width(&rng);
        const int32_t v = i % 5 == 0 ? ends[i / 5 % 6] : rng_s32_any_width(&rng);
        const int32_t c = i % 7 == 0 ? (i % 2 ? 1 << 30 : -(1 << 30)) : rng_range(&rng, -(1 << 30), 1 << 30);
        const int32_t s = i % 11 == 0 ? (i % 2 ? 1 << 30 : -(1 << 30)) : rng_range(&rng, -(1 << 30), 1 << 30);
        const wide128 across = (wide128)u * c - (wide128)v * s + (1 << 29);
        const wide128 along = (wide128)u * s + (wide128)v * c + (1 << 29);
        int64_t out[2];
        drogue_rotate_q30(out, u, v, c, s);
        MUST(out[0] == (int64_t)(across >> 30) && out[1] == (int64_t)(along >> 30), "%d %d by %d %d", u, v, c, s);
    }
}
END_TEST

START_TEST(exp_within_2_to_minus_28)
{
    double worst = 0;
    int64_t i;
    for (i = 0; i <= 25 * 65536; i++) {
        int32_t r = drogue_exp_neg_q30((int64_t)i * 16384);
        MUST(r >= 0 && r <= 1073741824, "exp_neg(%d) leaves [0, 1]", (int)i);
        worst = fmax(worst, fabs(r - exp(-(double)i / 65536.0) * 1073741824.0));
    }
    for (i = 25 * 65536; i <= INT32_MAX; i += 65521) {
        worst = fmax(worst, fabs(drogue_exp_neg_q30((int64_t)i * 16384) - exp(-(double)i / 65536.0) * 1073741824.0));
    }
    MUST(worst <= 4.0, "error %.3f of 2^-30", worst);
    ck_assert_int_eq(drogue_exp_neg_q30(INT64_MAX), 0);
    ck_assert_int_eq(drogue_exp_neg_q30(-1), drogue_exp_neg_q30(0));
    ck_assert_int_eq(drogue_exp_neg_q30(INT64_MIN), drogue_exp_neg_q30(0));
}
END_TEST

SUITE_MAIN("fixed", edge_values, random_values, isqrt_next_to_every_kind_of_square, shift_left_keeps_the_value,
           constants, atan2_within_2_to_minus_26, sincos_within_2_to_minus_29, rotation_rounds_what_is_exact,
           exp_within_2_to_minus_28)
