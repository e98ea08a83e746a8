/* SPDX-License-Identifier: Apache-2.0 */
/* Q16 division and square root; arc tangent, sine, cosine and exponential by their series (Taylor 1715) near 0. */
#include "drogue/fixed.h"

#define PI_Q32 INT64_C(13493037705)
#define HALF_PI_Q32 INT64_C(6746518852)
#define QUARTER_PI_Q32 INT64_C(3373259426)
#define LN2_Q32 2977044472u
#define TAN_PI_8_Q32 1779033704u

/* Coefficients of the alternating series below, Q32: what follows the first terms, which are 1. */
#define COS_TERMS 6   /* 1 / 2!, 1 / 4!, ... */
#define SIN_TERMS 5   /* 1 / 3!, 1 / 5!, ... */
#define EXP_TERMS 11  /* 1 / 2!, 1 / 3!, ... */
#define ATAN_TERMS 10 /* 1 / 3, 1 / 5, ... */
static const uint32_t cos_q32[COS_TERMS] = {2147483648u, 178956971u, 5965232u, 106522u, 1184u, 9u};
static const uint32_t sin_q32[SIN_TERMS] = {715827883u, 35791394u, 852176u, 11836u, 108u};
static const uint32_t exp_q32[EXP_TERMS] = {2147483648u, 715827883u, 178956971u, 35791394u, 5965232u, 852176u,
                                            106522u,     11836u,     1184u,      108u,      9u};
static const uint32_t atan_q32[ATAN_TERMS] = {1431655765u, 858993459u, 613566757u, 477218588u, 390451572u,
                                              330382100u,  286331153u, 252645135u, 226050910u, 204522252u};

#ifdef __ARM_ARCH_6M__
uint64_t drogue_product_u32(uint32_t a, uint32_t b)
{
    const uint32_t mask = 0xFFFFu;
    const uint32_t low = (a & mask) * (b & mask);
    const uint32_t cross = (a >> 16) * (b & mask) + (low >> 16); /* below 2^32 */
    const uint32_t other = (a & mask) * (b >> 16) + (cross & mask);
    return (uint64_t)((a >> 16) * (b >> 16) + (cross >> 16) + (other >> 16)) << 32 | (other << 16 | (low & mask));
}
#endif

#if !defined __GNUC__ || defined __BAMBU__ || defined __SYNTHESIS__
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
#endif

uint32_t drogue_reciprocal_u32(uint32_t d)
{
    const uint32_t seed = 2 * (UINT32_MAX / ((d + (1u << 14)) >> 15)) + 1; /* 2^48 / d to 1.25 * 2^-16 */
    const uint32_t error = ~(uint32_t)(drogue_product_u32(d, seed) >> 17); /* 2 - d seed, Q31 */
    return (uint32_t)(drogue_product_u32(seed, error) >> 17);              /* by Newton, from below */
}

drogue_q16 drogue_q16_from_int(int32_t v) { return drogue_sat_s32((int64_t)v * DROGUE_Q16_ONE); }

#if !DROGUE_SATURATING_INSTRUCTIONS
/* A sum that wrapped, of whose numbers one has this sign. */
static inline drogue_q16 saturated(drogue_q16 sign) { return (sign >> 31) ^ DROGUE_Q16_MAX; }

drogue_q16 drogue_q16_add(drogue_q16 a, drogue_q16 b)
{
    const drogue_q16 sum = (drogue_q16)((uint32_t)a + (uint32_t)b);
    return ((sum ^ a) & (sum ^ b)) < 0 ? saturated(a) : sum;
}

drogue_q16 drogue_q16_sub(drogue_q16 a, drogue_q16 b)
{
    const drogue_q16 difference = (drogue_q16)((uint32_t)a - (uint32_t)b);
    return ((a ^ b) & (difference ^ a)) < 0 ? saturated(a) : difference;
}
#endif

drogue_q16 drogue_q16_mul(drogue_q16 a, drogue_q16 b)
{
    return drogue_sat_s32(drogue_shr_round_s64(drogue_product(a, b), 16));
}

int64_t drogue_floor_div_s64(int64_t num, int64_t den)
{
    const int64_t sign = num >> 63; /* floor(-n / d) = -1 - floor((n - 1) / d) */
    const int64_t size = num ^ sign;
    const int narrow = size == (int32_t)size && den == (int32_t)den; /* 64 bits are a long call on a 32-bit core */
    return (narrow ? (int32_t)size / (int32_t)den : size / den) ^ sign;
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

void drogue_rotate_q30(int64_t out[2], int32_t u, int32_t v, int32_t cos_q30, int32_t sin_q30)
{
    out[0] = drogue_shr_round_s64(drogue_product(u, cos_q30) - drogue_product(v, sin_q30), 30);
    out[1] = drogue_shr_round_s64(drogue_product(u, sin_q30) + drogue_product(v, cos_q30), 30);
}

/* floor(sqrt(v)) for 2^30 <= v: v times its inverse root, which is Newton's from a line within 0.09 of it. */
static uint32_t isqrt_u32(uint32_t v)
{
    const uint32_t v_q16 = v >> 16;
    uint32_t inverse_q15 = 70000u - (v_q16 * 40000u >> 16);
    uint32_t root;
    int k;
    for (k = 0; k < 3; k++) {
        const uint32_t square_q14 = inverse_q15 * (inverse_q15 >> 1) >> 15;
        inverse_q15 = (inverse_q15 >> 1) * (((3u << 30) - v_q16 * square_q14) >> 16) >> 14;
    }
    root = (v_q16 * inverse_q15 >> 15) + 1;
    while (root * root > v) { /* bound: 3; what Newton and the rounding to 16 bits leave */
        root--;
    }
    while (v - root * root > 2 * root) { /* bound: 4 */
        root++;
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
    if (v == 0) {
        return 0;
    }
    shift = drogue_clz_u64(v) & ~1;
    high = (uint32_t)((v << shift) >> 32);
    low = (uint32_t)(v << shift);
    root = isqrt_u32(high); /* 2^15 or more */
    rest = ((high - root * root) << 15) | (low >> 17);
    digit = rest / root;
    rest -= digit * root;
    root = (root << 16) + digit; /* modulo 2^32, when the digit is 2^16 */
    if ((((uint64_t)rest << 17) | (low & 0x1FFFFu)) < drogue_product_u32(digit, digit)) {
        root--;
    }
    return root >> (shift / 2);
}

/* Upper word of a product. */
static uint32_t upper(uint32_t a, uint32_t b) { return (uint32_t)(drogue_product_u32(a, b) >> 32); }

/* c[0] - c[1] x + c[2] x^2 - ... to c[last], by Horner's rule, Q32. */
static uint32_t alternating(const uint32_t *c, int last, uint32_t x)
{
    uint32_t sum = c[last];
    int k;
    for (k = last - 1; k >= 0; k--) {
        sum = c[k] - upper(x, sum);
    }
    return sum;
}

/* atan(num / den) for num <= den tan(pi / 8), 2^30 <= den < 2^31; Q32 */
static uint32_t atan_of_ratio(uint32_t num, uint32_t den)
{
    const uint32_t z = (uint32_t)(drogue_product_u32(num, drogue_reciprocal_u32(den)) >> 30);
    const uint32_t z2 = upper(z, z);
    return z - upper(z, upper(z2, alternating(atan_q32, ATAN_TERMS - 1, z2)));
}

int32_t drogue_atan2_q29(int64_t y, int64_t x)
{
    const uint64_t abs_y = drogue_abs_u64(y);
    const uint64_t abs_x = drogue_abs_u64(x);
    const int shift = drogue_clz_u64(abs_y | abs_x);
    uint32_t more;
    uint32_t less;
    int64_t angle_q32;
    if (shift == 64) {
        return 0;
    }
    more = (uint32_t)((abs_x << shift) >> 33); /* 31 bits of the longer component */
    less = (uint32_t)((abs_y << shift) >> 33);
    if (abs_y > abs_x) {
        const uint32_t t = more;
        more = less;
        less = t;
    }
    if (less > upper(more, TAN_PI_8_Q32)) {
        /* turned by pi / 4; half of sum and difference, and twice that where it is 30 bits */
        const int up = (more + less) >> 31 == 0;
        angle_q32 =
            QUARTER_PI_Q32 - atan_of_ratio(up ? more - less : (more - less) >> 1, (more + less) >> (up ? 0 : 1));
    } else {
        angle_q32 = atan_of_ratio(less, more);
    }
    if (abs_y > abs_x) {
        angle_q32 = HALF_PI_Q32 - angle_q32;
    }
    if (x < 0) {
        angle_q32 = PI_Q32 - angle_q32;
    }
    return (int32_t)drogue_shr_round_s64(y < 0 ? -angle_q32 : angle_q32, 3);
}

void drogue_sincos_q30(int32_t *sin_q30, int32_t *cos_q30, int32_t angle_rad_q29)
{
    /* The first quarter turn, then its nearest end: the angle from there is at most pi / 4. */
    const int32_t size_q29 = angle_rad_q29 < 0 ? -angle_rad_q29 : angle_rad_q29;
    const int obtuse = size_q29 > HALF_PI_Q32 >> 3;
    const int64_t turned_q32 = obtuse ? PI_Q32 - (int64_t)size_q29 * 8 : (int64_t)size_q29 * 8;
    const int past = turned_q32 < 0; /* pi, as twice half a turn in Q16 may be */
    const int64_t acute_q32 = past ? -turned_q32 : turned_q32;
    const int steep = acute_q32 > QUARTER_PI_Q32;
    const uint32_t rest_q32 = (uint32_t)(steep ? HALF_PI_Q32 - acute_q32 : acute_q32);
    const uint32_t square_q32 = upper(rest_q32, rest_q32);
    const uint32_t sin_less_q32 = upper(rest_q32, upper(square_q32, alternating(sin_q32, SIN_TERMS - 1, square_q32)));
    const uint32_t cos_less_q32 = upper(square_q32, alternating(cos_q32, COS_TERMS - 1, square_q32));
    const int32_t s = (int32_t)((rest_q32 - sin_less_q32 + 2) >> 2);
    const int32_t c = (1 << 30) - (int32_t)((cos_less_q32 + 1) >> 2);
    const int32_t across = steep ? c : s;
    const int32_t along = steep ? s : c;
    *sin_q30 = (angle_rad_q29 < 0) != past ? -across : across;
    *cos_q30 = obtuse ? -along : along;
}

int32_t drogue_exp_neg_q30(int64_t x_q30)
{
    uint32_t halvings;
    uint32_t rest_q32;
    uint32_t less_q32; /* than 1 */
    if (x_q30 <= 0) {
        return 1 << 30;
    }
    if (x_q30 >> 35 != 0) {
        return 0;
    }
    halvings = ((uint32_t)(x_q30 >> 15) * 2954u) >> 26; /* x / ln 2, seldom one too few */
    rest_q32 = (uint32_t)x_q30 * 4u - halvings * LN2_Q32;
    less_q32 = rest_q32 - upper(upper(rest_q32, rest_q32), alternating(exp_q32, EXP_TERMS - 1, rest_q32));
    return (int32_t)drogue_shr_round_s64((INT64_C(1) << 32) - less_q32, 2 + (int)halvings);
}
