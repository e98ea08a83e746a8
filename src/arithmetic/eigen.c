/* SPDX-License-Identifier: Apache-2.0 */
/* Symmetric 3x3 eigenproblem by cyclic Jacobi rotations (Jacobi 1846). */
#include "drogue/eigen.h"

#define MAX_SWEEPS 8
#define ONE_Q30 (1 << 30)
#define NEGLIGIBLE_BITS 33 /* an off-diagonal entry this far below the geometric mean of its diagonal ones */

/* v / 2^32, rounded */
static inline int32_t upper(int64_t v) { return (int32_t)((v + (INT64_C(1) << 31)) >> 32); }

/* Index of entry (i, j). */
static inline int at(int i, int j) { return i == 0 ? j : j == 0 ? i : i + j + 1; }

/* sqrt(a^2 + b^2) */
static void hypotenuse(drogue_real *out, const drogue_real *a, const drogue_real *b)
{
    drogue_real_products(out, a, a, b, b);
    drogue_real_root(out, out);
}

/* a / (b + c) */
static void share(drogue_real *out, const drogue_real *a, const drogue_real *b, const drogue_real *c)
{
    drogue_real sum;
    drogue_real_sum(&sum, b, c);
    drogue_real_quotient(out, a, &sum);
}

/* A rotation by at most 45 degrees. */
typedef struct turn {
    drogue_real tangent;
    drogue_real sine;
    drogue_real cosine;
    int32_t sine_q31;
    int32_t less_q32; /* 1 - the cosine */
} turn;

/* That which zeroes a_pq. */
static void turn_of(turn *out, const drogue_real *a_pp, const drogue_real *a_pq, const drogue_real *a_qq)
{
    const drogue_real one = {ONE_Q30, -30};
    drogue_real d;
    drogue_real t;
    drogue_real c; /* the hypotenuse, then what the cosine lacks */
    drogue_real_difference(&d, a_qq, a_pp);
    drogue_real_copy(&t, a_pq);
    drogue_real_shift(&t, 1);
    hypotenuse(&c, &d, &t);
    if (d.mantissa < 0) {
        drogue_real_negate(&c);
    }
    share(&out->tangent, &t, &d, &c);
    hypotenuse(&c, &one, &out->tangent);
    drogue_real_quotient(&out->cosine, &one, &c);
    drogue_real_product(&out->sine, &out->tangent, &out->cosine);
    share(&c, &out->sine, &one, &out->cosine);
    drogue_real_product(&c, &c, &out->sine); /* times the tangent of half the angle */
    out->sine_q31 = drogue_real_to_s32(out->sine, 31);
    out->less_q32 = drogue_real_to_s32(c, 32);
}

static int negligible(const drogue_real *off, const drogue_real *pp, const drogue_real *qq)
{
    return off->mantissa == 0 || (pp->mantissa != 0 && qq->mantissa != 0 &&
                                  2 * (off->exponent + NEGLIGIBLE_BITS) < pp->exponent + qq->exponent);
}

/* One rotation in the plane (p, q), r being the third index; v[k] is the vector of diagonal element k. 0 when there is
 * nothing to be rotated. */
static int jacobi_step(drogue_real a[6], int32_t v[3][3], int p, int q, int r)
{
    drogue_real *const pp = &a[at(p, p)];
    drogue_real *const qq = &a[at(q, q)];
    drogue_real *const pq = &a[at(p, q)];
    drogue_real *const rp = &a[at(r, p)];
    drogue_real *const rq = &a[at(r, q)];
    drogue_real t;
    turn by;
    int k;
    if (negligible(pq, pp, qq)) {
        return 0;
    }
    turn_of(&by, pp, pq, qq);
    drogue_real_subtract_product(pp, &by.tangent, pq);
    drogue_real_negate(pq);
    drogue_real_subtract_product(qq, &by.tangent, pq);
    pq->mantissa = 0;
    pq->exponent = 0;
    drogue_real_determinant(&t, &by.cosine, rp, &by.sine, rq);
    drogue_real_products(rq, &by.sine, rp, &by.cosine, rq);
    drogue_real_copy(rp, &t);
    for (k = 0; k < 3; k++) {
        const int32_t g = v[p][k];
        const int32_t h = v[q][k];
        v[p][k] = g - upper(2 * drogue_product(by.sine_q31, h) + drogue_product(by.less_q32, g));
        v[q][k] = h + upper(2 * drogue_product(by.sine_q31, g) - drogue_product(by.less_q32, h));
        DROGUE_NOTE("eigen: vector, Q30", v[p][k], 31);
    }
    return 1;
}

/* Make the component of largest magnitude positive. */
static void fix_sign(int32_t v[3])
{
    int most = 0;
    int k;
    for (k = 1; k < 3; k++) {
        if (drogue_abs_u64(v[k]) > drogue_abs_u64(v[most])) {
            most = k;
        }
    }
    if (v[most] < 0) {
        v[0] = -v[0];
        v[1] = -v[1];
        v[2] = -v[2];
    }
}

static int64_t dot_q60(const int32_t a_q30[3], const int32_t b_q30[3])
{
    return drogue_product(a_q30[0], b_q30[0]) + drogue_product(a_q30[1], b_q30[1]) + drogue_product(a_q30[2], b_q30[2]);
}

/* v -= excess u for a small excess */
static void take(int32_t v[3], int64_t excess_q60, const int32_t u[3])
{
    const int64_t excess_q44 = excess_q60 >> 16;
    int k;
    for (k = 0; k < 3; k++) {
        v[k] -= (int32_t)((excess_q44 * u[k] + (INT64_C(1) << 43)) >> 44);
    }
}

/* Rotations leave the vectors orthonormal to their rounding, which adds up: once more. With signs; the third
 * follows. */
static void straighten(int32_t v[3][3])
{
    const int64_t one_q60 = INT64_C(1) << 60;
    int i = 1;
    int j = 2;
    int k;
    take(v[0], (dot_q60(v[0], v[0]) - one_q60) / 2, v[0]);
    take(v[1], dot_q60(v[0], v[1]), v[0]);
    take(v[1], (dot_q60(v[1], v[1]) - one_q60) / 2, v[1]);
    fix_sign(v[0]);
    fix_sign(v[1]);
    for (k = 0; k < 3; k++) {
        v[2][k] =
            (int32_t)drogue_shr_round_s64(drogue_product(v[0][i], v[1][j]) - drogue_product(v[0][j], v[1][i]), 30);
        i = j;
        j = k;
    }
}

int drogue_eigen_sym3(drogue_eigen3 *out, const drogue_real matrix[6])
{
    drogue_real a[6];
    int32_t v[3][3] = {{ONE_Q30, 0, 0}, {0, ONE_Q30, 0}, {0, 0, ONE_Q30}};
    int order[3] = {0, 1, 2};
    int sweep;
    int turned = 1;
    int i;
    int k;
    for (k = 0; k < 6; k++) {
        drogue_real_copy(&a[k], &matrix[k]);
    }
    for (sweep = -1; sweep < MAX_SWEEPS && turned; sweep++) { /* the last one finds nothing to do */
        turned = jacobi_step(a, v, 0, 1, 2);
        turned |= jacobi_step(a, v, 0, 2, 1);
        turned |= jacobi_step(a, v, 1, 2, 0);
    }
    for (k = 0; k < 3; k++) { /* three exchanges of neighbours sort three */
        i = k & 1;
        if (drogue_real_order(&a[at(order[i], order[i])], &a[at(order[i + 1], order[i + 1])]) < 0) {
            const int t = order[i];
            order[i] = order[i + 1];
            order[i + 1] = t;
        }
    }
    for (k = 0; k < 3; k++) {
        drogue_real_copy(&out->value[k], &a[at(order[k], order[k])]);
        for (i = 0; i < 3; i++) {
            out->vector_q30[k][i] = v[order[k]][i];
        }
    }
    straighten(out->vector_q30);
    return sweep;
}
