/* SPDX-License-Identifier: Apache-2.0 */
/* Q16 division and square root, CORDIC (Volder 1959), exponential. */
#include "drogue/fixed.h"

#define CORDIC_STEPS 32
#define PI_Q32 INT64_C(13493037705)
#define LN2_Q30 INT64_C(744261118)

/* atan(2^-i), rad Q32 */
static const uint32_t cordic_angle_q32[CORDIC_STEPS] = {
    3373259426u, 1991351318u, 1052175346u, 534100635u, 268086748u, 134174063u, 67103403u, 33553749u,
    16777131u,   8388597u,    4194303u,    2097152u,   1048576u,   524288u,    262144u,   131072u,
    65536u,      32768u,      16384u,      8192u,      4096u,      2048u,      1024u,     512u,
    256u,        128u,        64u,         32u,        16u,        8u,         4u,        2u,
};

/* 1 / product of sqrt(1 + 4^-i): what a vector must start with to end up of length 1, Q40 */
static const int64_t cordic_gain_q40 = INT64_C(667681663043);

int drogue_clz_u32(uint32_t v)
{
    int n = 0;
    if (v == 0) {
        return 32;
    }
    if (v >> 16 == 0) {
        n += 16;
        v <<= 16;
    }
    if (v >> 24 == 0) {
        n += 8;
        v <<= 8;
    }
    if (v >> 28 == 0) {
        n += 4;
        v <<= 4;
    }
    if (v >> 30 == 0) {
        n += 2;
        v <<= 2;
    }
    return v >> 31 == 0 ? n + 1 : n;
}

int drogue_clz_u64(uint64_t v)
{
    return v >> 32 != 0 ? drogue_clz_u32((uint32_t)(v >> 32)) : 32 + drogue_clz_u32((uint32_t)v);
}

int64_t drogue_shr_round_s64(int64_t v, int n) { return n == 0 ? v : (v >> n) + ((v >> (n - 1)) & 1); }

drogue_q16 drogue_q16_from_int(int32_t v) { return drogue_sat_s32((int64_t)v * DROGUE_Q16_ONE); }

drogue_q16 drogue_q16_add(drogue_q16 a, drogue_q16 b) { return drogue_sat_s32((int64_t)a + b); }

drogue_q16 drogue_q16_sub(drogue_q16 a, drogue_q16 b) { return drogue_sat_s32((int64_t)a - b); }

drogue_q16 drogue_q16_mul(drogue_q16 a, drogue_q16 b)
{
    return drogue_sat_s32(drogue_shr_round_s64((int64_t)a * b, 16));
}

int64_t drogue_floor_div_s64(int64_t num, int64_t den)
{
    const int64_t q = num / den;
    return num - q * den < 0 ? q - 1 : q;
}

int64_t drogue_div_round_s64(int64_t num, int64_t den) { return drogue_floor_div_s64(2 * num + den, 2 * den); }

drogue_q16 drogue_q16_div(drogue_q16 a, drogue_q16 b)
{
    int64_t num = (int64_t)a * DROGUE_Q16_ONE;
    int64_t den = b;
    if (b == 0) {
        return a > 0 ? DROGUE_Q16_MAX : a < 0 ? DROGUE_Q16_MIN : 0;
    }
    if (den < 0) {
        num = -num;
        den = -den;
    }
    return drogue_sat_s32(drogue_div_round_s64(num, den));
}

/* floor(sqrt(v)), a binary digit at a time. */
static uint32_t isqrt_u32(uint32_t v)
{
    uint32_t root = 0;
    uint32_t bit;
    for (bit = UINT32_C(1) << 30; bit != 0; bit >>= 2) {
        uint32_t trial = root + bit;
        root >>= 1;
        if (v >= trial) {
            v -= trial;
            root += bit;
        }
    }
    return root;
}

uint32_t drogue_isqrt_u64(uint64_t v)
{
    /* Root of the upper half, then a division for the lower (Zimmermann 1999, Karatsuba square root). */
    int shift;
    uint32_t high;
    uint32_t low;
    uint32_t root;
    uint32_t rest;
    uint32_t digit;
    if (v >> 32 == 0) {
        return isqrt_u32((uint32_t)v);
    }
    shift = drogue_clz_u64(v) & ~1;
    high = (uint32_t)((v << shift) >> 32);
    low = (uint32_t)(v << shift);
    root = isqrt_u32(high); /* 2^15 or more */
    rest = ((high - root * root) << 15) | (low >> 17);
    digit = rest / root;
    rest -= digit * root;
    root = (root << 16) + digit; /* modulo 2^32, when the digit is 2^16 */
    if ((((uint64_t)rest << 17) | (low & 0x1FFFFu)) < (uint64_t)digit * digit) {
        root--;
    }
    return root >> (shift / 2);
}

drogue_q16 drogue_q16_sqrt(drogue_q16 v)
{
    uint64_t square;
    uint32_t root;
    if (v <= 0) {
        return 0;
    }
    square = (uint64_t)v << 16;
    root = drogue_isqrt_u64(square);
    if (square - (uint64_t)root * root > root) {
        root++; /* square > (root + 1/2)^2 */
    }
    return (drogue_q16)root;
}

int32_t drogue_atan2_q29(int64_t y, int64_t x)
{
    const int below = y < 0;
    int64_t angle_q32 = 0;
    int shift;
    int i;
    if (x == 0 && y == 0) {
        return 0;
    }
    /* The longer component to 45 bits: room for the gain of 1.65 and bits to spare below. */
    shift = drogue_clz_u64(drogue_abs_u64(x) | drogue_abs_u64(y)) - 19;
    if (shift >= 0) {
        x = drogue_shl_s64(x, shift);
        y = drogue_shl_s64(y, shift);
    } else {
        x = drogue_shr_round_s64(x, -shift);
        y = drogue_shr_round_s64(y, -shift);
    }
    if (x < 0) {
        angle_q32 = below ? -PI_Q32 : PI_Q32;
        x = -x;
        y = -y;
    }
    for (i = 0; i < CORDIC_STEPS; i++) {
        int64_t dx = drogue_shr_round_s64(x, i);
        int64_t dy = drogue_shr_round_s64(y, i);
        DROGUE_NOTE("fixed: CORDIC vector", x, 47);
        if (y > 0) {
            x += dy;
            y -= dx;
            angle_q32 += cordic_angle_q32[i];
        } else if (y < 0) {
            x -= dy;
            y += dx;
            angle_q32 -= cordic_angle_q32[i];
        }
    }
    return (int32_t)drogue_shr_round_s64(angle_q32, 3);
}

drogue_q16 drogue_q16_atan2(drogue_q16 y, drogue_q16 x)
{
    return (drogue_q16)drogue_shr_round_s64(drogue_atan2_q29(y, x), 13);
}

void drogue_sincos_q30(int32_t *sin_q30, int32_t *cos_q30, int32_t angle_rad_q29)
{
    int64_t rest_q32 = (int64_t)angle_rad_q29 * 8;
    int64_t x = cordic_gain_q40;
    int64_t y = 0;
    int negate = 0;
    int i;
    if (rest_q32 > PI_Q32 / 2) {
        rest_q32 -= PI_Q32;
        negate = 1;
    } else if (rest_q32 < -PI_Q32 / 2) {
        rest_q32 += PI_Q32;
        negate = 1;
    }
    for (i = 0; i < CORDIC_STEPS; i++) {
        int64_t dx = drogue_shr_round_s64(x, i);
        int64_t dy = drogue_shr_round_s64(y, i);
        if (rest_q32 >= 0) {
            x -= dy;
            y += dx;
            rest_q32 -= cordic_angle_q32[i];
        } else {
            x += dy;
            y -= dx;
            rest_q32 += cordic_angle_q32[i];
        }
    }
    *sin_q30 = (int32_t)drogue_shr_round_s64(negate ? -y : y, 10);
    *cos_q30 = (int32_t)drogue_shr_round_s64(negate ? -x : x, 10);
}

int32_t drogue_exp_neg_q30(int64_t x_q30)
{
    const int64_t one_q30 = INT64_C(1) << 30;
    int64_t halvings = x_q30 < 0 ? 0 : x_q30 / LN2_Q30;
    int64_t rest_q30 = x_q30 < 0 ? 0 : x_q30 % LN2_Q30;
    int64_t sum_q30 = one_q30;
    int k;
    if (halvings > 31) {
        return 0;
    }
    for (k = 12; k >= 1; k--) { /* Taylor series in Horner's form on [0, ln 2) */
        sum_q30 = one_q30 - drogue_div_round_s64(drogue_shr_round_s64(rest_q30 * sum_q30, 30), k);
    }
    return (int32_t)drogue_shr_round_s64(sum_q30, (int)halvings);
}
