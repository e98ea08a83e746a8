/* SPDX-License-Identifier: Apache-2.0 */
/* Scalars of fixed.h: for every argument the value that the header states, and no overflow on the way. */
#include "arithmetic/fixed.c"
#include "proof.h"

/* Is r the exact number n / 2^bits, rounded to nearest, ties toward +infinity, and saturated? */
static int rounded(int64_t r, int64_t n, int bits, int64_t least, int64_t most)
{
    const int64_t rest = n - r * (INT64_C(1) << bits);
    const int64_t half = INT64_C(1) << (bits - 1);
    return r == most ? rest >= -half : r == least ? rest < half : rest >= -half && rest < half;
}

void saturation(void)
{
    const int64_t v = nondet_s64();
    const int32_t r = drogue_sat_s32(v);
    PROVE(v >= INT32_MIN && v <= INT32_MAX ? r == v : r == (v < 0 ? INT32_MIN : INT32_MAX));
}

void shift_left(void)
{
    const int64_t v = nondet_s64();
    const int n = any_within(0, 63);
    const int64_t r = drogue_shl_s64(v, n);
    ASSUME(v >> (63 - n) == v >> 63); /* nothing is lost */
    PROVE(r >> n == v);
    PROVE((r & ((INT64_C(1) << (n < 63 ? n : 62)) - 1)) == 0);
}

void shift_right(void)
{
    const int64_t v = nondet_s64();
    const int n = any_within(0, 63);
    const int64_t r = drogue_shr_round_s64(v, n);
    if (n == 0) {
        PROVE(r == v);
    } else {
        const int64_t floor = v >> n;
        const int64_t rest = (int64_t)((uint64_t)v - ((uint64_t)floor << n));
        PROVE(r == floor || r == floor + 1);
        PROVE((r == floor) == ((uint64_t)rest < UINT64_C(1) << (n - 1)));
    }
}

void absolute(void)
{
    const int64_t v = nondet_s64();
    const uint64_t r = drogue_abs_u64(v);
    PROVE(v >= 0 ? r == (uint64_t)v : r + (uint64_t)v == 0);
    PROVE(r <= UINT64_C(1) << 63);
}

void leading_zeros(void)
{
    const uint64_t v = nondet_u64();
    const int n = drogue_clz_u64(v);
    const uint32_t half = nondet_u32();
    const int k = drogue_clz_u32(half);
    PROVE(v == 0 ? n == 64 : n >= 0 && n <= 63 && v >> (63 - n) == 1);
    PROVE(half == 0 ? k == 32 : k >= 0 && k <= 31 && half >> (31 - k) == 1);
}

void sum(void)
{
    const drogue_q16 a = nondet_s32();
    const drogue_q16 b = nondet_s32();
    const int64_t exact = (int64_t)a + b;
    const int64_t less = (int64_t)a - b;
    PROVE(drogue_q16_add(a, b) == (exact > INT32_MAX ? INT32_MAX : exact < INT32_MIN ? INT32_MIN : exact));
    PROVE(drogue_q16_sub(a, b) == (less > INT32_MAX ? INT32_MAX : less < INT32_MIN ? INT32_MIN : less));
}

void from_int(void)
{
    const int32_t v = nondet_s32();
    const drogue_q16 r = drogue_q16_from_int(v);
    PROVE(v > 32767 ? r == INT32_MAX : v < -32768 ? r == INT32_MIN : r >> 16 == v && (r & 0xFFFF) == 0);
}

void product(void)
{
    const drogue_q16 a = nondet_s32();
    const drogue_q16 b = nondet_s32();
    PROVE(rounded(drogue_q16_mul(a, b), (int64_t)a * b, 16, INT32_MIN, INT32_MAX));
}

/* Of 12 bits each, and of the largest. */
void square_sum(void)
{
    const int32_t a = any_signed(12);
    const int32_t b = any_signed(12);
    PROVE(drogue_square_sum(a, b) == (uint64_t)(uint32_t)(a * a + b * b));
    PROVE(drogue_square_sum(INT32_MIN, INT32_MIN) == UINT64_C(1) << 63);
    PROVE(drogue_square_sum(INT32_MIN, INT32_MAX) == (UINT64_C(1) << 63) - UINT32_MAX);
}

/* Of 8 bits each: a divider grows with the square of its width. */
void floor_division(void)
{
    const int64_t num = any_signed(8);
    const int64_t den = (int64_t)any_unsigned(7) + 1;
    const int64_t r = drogue_floor_div_s64(num, den);
    const int64_t rest = num - r * den;
    PROVE(rest >= 0 && rest < den);
}

void rounded_division(void)
{
    const int64_t num = any_signed(8);
    const int64_t den = (int64_t)any_unsigned(7) + 1;
    const int64_t r = drogue_div_round_s64(num, den);
    const int64_t rest = 2 * (num - r * den);
    PROVE(rest >= -den && rest < den);
}

/* For every pair: no overflow, no division by 0, and the value where it is no division. ESBMC 6.7 takes the negation of
 * -2^31 in 64 bits for an overflow: what leads to it is left out. */
void quotient(void)
{
    const drogue_q16 a = nondet_s32();
    const drogue_q16 b = nondet_s32();
    drogue_q16 r;
    ASSUME(a != -32768 && b != INT32_MIN);
    r = drogue_q16_div(a, b);
    PROVE(b != 0 || r == (a > 0 ? INT32_MAX : a < 0 ? INT32_MIN : 0));
}

void root(void)
{
    const uint32_t v = any_unsigned(20);
    const uint32_t r = drogue_isqrt_u64(v);
    PROVE((uint64_t)r * r <= v && v - (uint64_t)r * r <= 2 * (uint64_t)r);
}
