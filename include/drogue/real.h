/* SPDX-License-Identifier: Apache-2.0 */
/* Real numbers where Q16 cancels (the direct fit, the cone, the joint pose): a software floating-point format in 32-bit
 * words.
 *
 * A drogue_real is mantissa * 2^exponent with 2^30 <= |mantissa| < 2^31, or 0 with exponent 0: 31 significant bits and
 * a sign. Its unit in the last place is 2^exponent, 2^-30 of the number at most. Results are rounded to nearest, ties
 * toward +infinity: within half a unit.
 * Range: exponents within +-2^20. No operation checks them: numbers of the library begin within 2^+-128, each operation
 * at most adds two exponents, and no chain of operations comes near. There are no infinities and no NaN; where a number
 * becomes fixed point it saturates.
 *
 * Operands and results go through pointers: a structure of two words is returned through memory on Arm and RISC-V's
 * small ABIs anyhow, and callers keep theirs in arrays. 'out' may be an operand.
 */
#ifndef DROGUE_REAL_H
#define DROGUE_REAL_H

#include "drogue/fixed.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A real number, as above. */
typedef struct drogue_real {
    int32_t mantissa; /* 0, or 2^30 and more in magnitude */
    int32_t exponent; /* of two */
} drogue_real;

/* Initialiser of 1. */
#define DROGUE_REAL_ONE \
    {                   \
        1 << 30, -30    \
    }

/* v * 2^exponent, rounded to 31 bits; in this order Arm and RISC-V pass all of it in registers */
void drogue_real_put(drogue_real *out, int32_t exponent, int64_t v);
static inline void drogue_real_set(drogue_real *out, int64_t v, int32_t exponent) { drogue_real_put(out, exponent, v); }
/* The same of a Q16 number. */
void drogue_real_set_q16(drogue_real *out, drogue_q16 v);

/* a + b, a - b, a b */
void drogue_real_sum(drogue_real *out, const drogue_real *a, const drogue_real *b);
void drogue_real_difference(drogue_real *out, const drogue_real *a, const drogue_real *b);
void drogue_real_product(drogue_real *out, const drogue_real *a, const drogue_real *b);
/* a / b; b = 0 gives 0, and callers test b first. */
void drogue_real_quotient(drogue_real *out, const drogue_real *a, const drogue_real *b);
/* a / b of whole numbers; b = 0 gives 0. */
void drogue_real_ratio(drogue_real *out, int64_t a, int64_t b);
/* Square root; 0 for v <= 0. */
void drogue_real_root(drogue_real *out, const drogue_real *v);

/* Two-term sums rounded once, from products of 62 bits: what cancels does so before it is rounded. The smaller term
 * loses what lies below 2^-61 of the larger. */
void drogue_real_subtract_product(drogue_real *out, const drogue_real *a, const drogue_real *b); /* out -= a b */
void drogue_real_products(drogue_real *out, const drogue_real *a, const drogue_real *b, const drogue_real *c,
                          const drogue_real *d); /* a b + c d */
void drogue_real_determinant(drogue_real *out, const drogue_real *a, const drogue_real *b, const drogue_real *c,
                             const drogue_real *d); /* a b - c d */

/* Member by member: compilers of hardware copy a whole one byte by byte. */
static inline void drogue_real_copy(drogue_real *out, const drogue_real *v)
{
    out->mantissa = v->mantissa;
    out->exponent = v->exponent;
}

/* v * 2^n, exact */
static inline void drogue_real_shift(drogue_real *v, int n)
{
    if (v->mantissa != 0) {
        v->exponent += n;
    }
}

/* -v; a function: Bambu loses a bare store beside calls */
void drogue_real_negate(drogue_real *v);

/* round(v * 2^frac_bits), saturated to 64 (32) bits. */
int64_t drogue_real_to_s64(drogue_real v, int frac_bits);
int32_t drogue_real_to_s32(drogue_real v, int frac_bits);
static inline drogue_q16 drogue_real_to_q16(drogue_real v) { return drogue_real_to_s32(v, 16); }

/* Sign of a - b: -1, 0 or 1. */
int drogue_real_order(const drogue_real *a, const drogue_real *b);

/* atan2(y, x), rad Q29 in [-pi, pi]; error <= 2^-26 rad. */
int32_t drogue_real_atan2_q29(drogue_real y, drogue_real x);

#ifdef __cplusplus
}
#endif
#endif
