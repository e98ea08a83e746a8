/* SPDX-License-Identifier: Apache-2.0 */
/* Q16 fixed-point arithmetic: the number format of every public real number.
 *
 * Rounding is to nearest, ties toward +infinity (HLS AP_RND); overflow saturates (AP_SAT).
 */
#ifndef DROGUE_FIXED_H
#define DROGUE_FIXED_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef int32_t drogue_q16; /* value * 2^16, range [-32768, 32768) */

#define DROGUE_Q16_ONE 65536      /* 1.0 */
#define DROGUE_Q16_MAX INT32_MAX  /* what overflow saturates to */
#define DROGUE_Q16_MIN INT32_MIN  /* the same below 0 */
#define DROGUE_Q16_PI 205887      /* pi, rad Q16 */
#define DROGUE_Q16_HALF_PI 102944 /* pi / 2, rad Q16 */

/* Integer n / d as a Q16 constant, rounded to nearest; for initialisers, n and d positive literals. A negative number:
 * -DROGUE_Q16(n, d). */
#define DROGUE_Q16(n, d) ((drogue_q16)(((int64_t)(n)*131072 + (d)) / (2 * (int64_t)(d))))

/* Names a quantity and the number of bits that hold its magnitude. Nothing here; the checked build (tests/checked)
 * verifies it and records the peak. */
#ifndef DROGUE_NOTE
#define DROGUE_NOTE(name, value, bits) ((void)0)
#endif

/* What the core relies on beyond C99; each line fails to compile where it does not hold. */
typedef char drogue_assume_arithmetic_shift[((-3) >> 1) == -2 ? 1 : -1];
typedef char drogue_assume_arithmetic_shift_64[((-(int64_t)3) >> 1) == -2 ? 1 : -1];
typedef char drogue_assume_wrapping_conversion_32[(int32_t)UINT32_C(0xFFFFFFFF) == -1 ? 1 : -1];
typedef char drogue_assume_wrapping_conversion_64[(int64_t)UINT64_C(0xFFFFFFFFFFFFFFFF) == -1 ? 1 : -1];
typedef char drogue_assume_int_32[sizeof(int) >= 4 ? 1 : -1];

/* a b, exact. Armv6-M has no instruction for it, and compilers there call the product of two 64-bit numbers. */
#ifdef __ARM_ARCH_6M__
uint64_t drogue_product_u32(uint32_t a, uint32_t b);

static inline int64_t drogue_product(int32_t a, int32_t b)
{
    const uint64_t p = drogue_product_u32((uint32_t)a, (uint32_t)b);
    return (int64_t)(p - ((uint64_t)((a < 0 ? (uint32_t)b : 0u) + (b < 0 ? (uint32_t)a : 0u)) << 32));
}
#else
static inline uint64_t drogue_product_u32(uint32_t a, uint32_t b) { return (uint64_t)a * b; }

/* The same of signed numbers. */
static inline int64_t drogue_product(int32_t a, int32_t b) { return (int64_t)a * b; }
#endif

/* v within [least, most]. */
static inline int32_t drogue_clamp_s32(int32_t v, int32_t least, int32_t most)
{
    return v < least ? least : v > most ? most : v;
}

/* v within 2^30 of 0: two of them have a difference of 32 bits. */
static inline int32_t drogue_clamp_2_30(int64_t v)
{
    const int64_t most = 1 << 30;
    return (int32_t)(v > most ? most : v < -most ? -most : v);
}

/* Saturate to 32 bits. */
static inline int32_t drogue_sat_s32(int64_t v)
{
    return v > INT32_MAX ? INT32_MAX : v < INT32_MIN ? INT32_MIN : (int32_t)v;
}

/* v * 2^n for 0 <= n <= 63; bits shifted out are lost, the caller guarantees there are none. */
static inline int64_t drogue_shl_s64(int64_t v, int n) { return (int64_t)((uint64_t)v << n); }

/* v / 2^n rounded to nearest, ties toward +infinity, for 0 <= n <= 63; cannot overflow. */
static inline int64_t drogue_shr_round_s64(int64_t v, int n)
{
    const int64_t twice = n == 0 ? v : v >> (n - 1);
    return n == 0 ? v : (twice >> 1) + (twice & 1);
}

/* |v|; not of INT32_MIN. */
static inline int32_t drogue_abs_s32(int32_t v) { return v < 0 ? -v : v; }

/* |v|, defined for INT64_MIN too. */
static inline uint64_t drogue_abs_u64(int64_t v) { return v < 0 ? (uint64_t)0 - (uint64_t)v : (uint64_t)v; }

/* Leading zero bits of v; 32 for 0. By the core's instruction where the compiler has a name for it. */
#if defined __GNUC__ && !defined __BAMBU__ && !defined __SYNTHESIS__
static inline int drogue_clz_u32(uint32_t v) { return v == 0 ? 32 : __builtin_clz(v); }
#else
int drogue_clz_u32(uint32_t v);
#endif

/* The same of 64 bits; 64 for 0. */
static inline int drogue_clz_u64(uint64_t v)
{
    return v >> 32 != 0 ? drogue_clz_u32((uint32_t)(v >> 32)) : 32 + drogue_clz_u32((uint32_t)v);
}

/* 2^62 / d for 2^30 <= d < 2^31, from below, to 2^-29 of it: one 32-bit division and two products. */
uint32_t drogue_reciprocal_u32(uint32_t d);

/* Are there instructions for saturating sums (Armv7E-M)? */
#if defined __GNUC__ && defined __ARM_FEATURE_DSP && defined __ARM_FEATURE_QBIT
#define DROGUE_SATURATING_INSTRUCTIONS 1
#else
#define DROGUE_SATURATING_INSTRUCTIONS 0
#endif

/* Whole number, sum, difference and rounded product as Q16; all saturate. */
drogue_q16 drogue_q16_from_int(int32_t v);
#if DROGUE_SATURATING_INSTRUCTIONS
static inline drogue_q16 drogue_q16_add(drogue_q16 a, drogue_q16 b) { return __builtin_arm_qadd(a, b); }
static inline drogue_q16 drogue_q16_sub(drogue_q16 a, drogue_q16 b) { return __builtin_arm_qsub(a, b); }
#else
drogue_q16 drogue_q16_add(drogue_q16 a, drogue_q16 b);
drogue_q16 drogue_q16_sub(drogue_q16 a, drogue_q16 b);
#endif
drogue_q16 drogue_q16_mul(drogue_q16 a, drogue_q16 b);

/* |v|, saturated. */
static inline drogue_q16 drogue_q16_abs(drogue_q16 v) { return v < 0 ? drogue_q16_sub(0, v) : v; }

/* a^2 + b^2, exact. */
static inline uint64_t drogue_square_sum(int32_t a, int32_t b)
{
    return (uint64_t)drogue_product(a, a) + (uint64_t)drogue_product(b, b);
}

/* (u, v), any, turned by an angle from the first axis to the second, its cosine and sine within 2^30: rounded to
 * nearest, ties toward +infinity, exact until then. */
void drogue_rotate_q30(int64_t out[2], int32_t u, int32_t v, int32_t cos_q30, int32_t sin_q30);

/* floor(num / den) for den > 0. */
int64_t drogue_floor_div_s64(int64_t num, int64_t den);

/* num / den rounded to nearest, ties toward +infinity; den > 0, |num| <= 2^61, den <= 2^61. */
int64_t drogue_div_round_s64(int64_t num, int64_t den);

/* Q16 quotient a / b.
 *
 *  return  rounded quotient, saturated; b = 0 gives the largest value of a's sign, and 0 for 0 / 0
 */
drogue_q16 drogue_q16_div(drogue_q16 a, drogue_q16 b);

/* floor(sqrt(v)), exact over the whole domain. */
uint32_t drogue_isqrt_u64(uint64_t v);

/* Angle of the vector (x, y).
 *
 *  y, x    any pair in the same scale; (0, 0) gives 0
 *  return  atan2(y, x), rad Q29 in [-pi, pi]
 *  error   <= 2^-28 rad
 */
int32_t drogue_atan2_q29(int64_t y, int64_t x);

/* Sine and cosine.
 *
 *  sin_q30, cos_q30  out, Q30
 *  angle_rad_q29     rad Q29, any but INT32_MIN
 *  error             <= 2^-29
 */
void drogue_sincos_q30(int32_t *sin_q30, int32_t *cos_q30, int32_t angle_rad_q29);

/* The same of an angle in (-4, 4) rad. */
static inline void drogue_sincos_of_q16(int32_t *sin_q30, int32_t *cos_q30, drogue_q16 angle_rad_q16)
{
    drogue_sincos_q30(sin_q30, cos_q30, (int32_t)drogue_shl_s64(angle_rad_q16, 13));
}

/* exp(-x).
 *
 *  x_q30   Q30, >= 0; a negative x counts as 0
 *  return  Q30 in [0, 1]
 *  error   <= 2^-29
 */
int32_t drogue_exp_neg_q30(int64_t x_q30);

#ifdef __cplusplus
}
#endif
#endif
