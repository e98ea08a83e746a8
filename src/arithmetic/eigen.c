/* SPDX-License-Identifier: Apache-2.0 */
/* Symmetric 3x3 eigenproblem by cyclic Jacobi rotations (Jacobi 1846; Rutishauser's update). */
#include "drogue/eigen.h"

#define MAX_SWEEPS 8
#define ONE_Q60 (INT64_C(1) << DROGUE_EIGEN_FRAC)

static inline int64_t mul_q60(int64_t a, int64_t b)
{
    return drogue_s128_shr_round(drogue_s128_mul(a, b), DROGUE_EIGEN_FRAC);
}

/* sqrt(a2 + b^2) */
static void hypotenuse(drogue_wide *out, const drogue_wide *a2, const drogue_wide *b)
{
    drogue_wide square;
    drogue_wide_product(&square, b, b);
    drogue_wide_sum(out, a2, &square);
    drogue_wide_root(out, out);
}

/* a / (b + c) */
static void share(drogue_wide *out, const drogue_wide *a, const drogue_wide *b, const drogue_wide *c)
{
    drogue_wide sum;
    drogue_wide_sum(&sum, b, c);
    drogue_wide_quotient(out, a, &sum);
}

/* Rotation that zeroes a_pq: t = tan, s = sin, r = tan(angle / 2), Q60, |angle| <= 45 degrees. */
static void rotation(int64_t *t_q60, int64_t *s_q60, int64_t *r_q60, int64_t a_pp, int64_t a_pq, int64_t a_qq)
{
    drogue_wide one;
    drogue_wide d;
    drogue_wide t;
    drogue_wide c; /* the hypotenuse, then the cosine */
    drogue_wide_set(&one, 1, 0);
    drogue_wide_set(&d, a_qq - a_pp, 0);
    drogue_wide_set(&t, a_pq, 1);
    drogue_wide_product(&c, &d, &d);
    hypotenuse(&c, &c, &t);
    if (d.mantissa < 0) {
        drogue_wide_negate(&c);
    }
    share(&t, &t, &d, &c);
    *t_q60 = drogue_wide_to_s64(t, DROGUE_EIGEN_FRAC);
    hypotenuse(&c, &one, &t);
    drogue_wide_quotient(&c, &one, &c);
    drogue_wide_product(&t, &t, &c); /* the sine */
    *s_q60 = drogue_wide_to_s64(t, DROGUE_EIGEN_FRAC);
    share(&t, &t, &one, &c);
    *r_q60 = drogue_wide_to_s64(t, DROGUE_EIGEN_FRAC);
}

static void rotate(int64_t *g, int64_t *h, int64_t s_q60, int64_t r_q60)
{
    int64_t g0 = *g;
    int64_t h0 = *h;
    *g = g0 - mul_q60(s_q60, h0 + mul_q60(r_q60, g0));
    *h = h0 + mul_q60(s_q60, g0 - mul_q60(r_q60, h0));
}

/* One rotation in the plane (p, q), r being the third index. v[k] is the vector of diagonal element k. */
static void jacobi_step(int64_t a[3][3], int64_t v[3][3], int p, int q, int r)
{
    int64_t t_q60;
    int64_t s_q60;
    int64_t r_q60;
    int64_t shift;
    int k;
    DROGUE_NOTE("eigen: diagonal", a[p][p], 61);
    DROGUE_NOTE("eigen: off diagonal", a[p][q], 61);
    if (a[p][q] == 0) {
        return;
    }
    rotation(&t_q60, &s_q60, &r_q60, a[p][p], a[p][q], a[q][q]);
    shift = mul_q60(t_q60, a[p][q]);
    a[p][p] -= shift;
    a[q][q] += shift;
    a[p][q] = 0;
    a[q][p] = 0;
    rotate(&a[r][p], &a[r][q], s_q60, r_q60);
    a[p][r] = a[r][p];
    a[q][r] = a[r][q];
    for (k = 0; k < 3; k++) {
        rotate(&v[p][k], &v[q][k], s_q60, r_q60);
        DROGUE_NOTE("eigen: vector, Q60", v[p][k], 61);
    }
}

static void negate3(int64_t v[3])
{
    v[0] = -v[0];
    v[1] = -v[1];
    v[2] = -v[2];
}

static void copy3(int64_t to[3], const int64_t from[3])
{
    to[0] = from[0];
    to[1] = from[1];
    to[2] = from[2];
}

/* Make the component of largest magnitude positive. */
static void fix_sign(int64_t v[3])
{
    int at = 0;
    int k;
    for (k = 1; k < 3; k++) {
        if (drogue_abs_u64(v[k]) > drogue_abs_u64(v[at])) {
            at = k;
        }
    }
    if (v[at] < 0) {
        negate3(v);
    }
}

/* v0 . (v1 x v2), Q60 */
static int64_t triple_q60(int64_t v[3][3])
{
    int64_t sum = 0;
    int k;
    for (k = 0; k < 3; k++) {
        int i = (k + 1) % 3;
        int j = (k + 2) % 3;
        sum += mul_q60(v[0][k], mul_q60(v[1][i], v[2][j]) - mul_q60(v[1][j], v[2][i]));
    }
    return sum;
}

int drogue_eigen_sym3(drogue_eigen3 *out, const drogue_sym3 *matrix)
{
    const int64_t *m = matrix->a;
    int64_t a[3][3];
    int64_t v[3][3] = {{ONE_Q60, 0, 0}, {0, ONE_Q60, 0}, {0, 0, ONE_Q60}};
    int order[3] = {0, 1, 2};
    int sweep;
    int k;
    a[0][0] = m[0];
    a[0][1] = a[1][0] = m[1];
    a[0][2] = a[2][0] = m[2];
    a[1][1] = m[3];
    a[1][2] = a[2][1] = m[4];
    a[2][2] = m[5];
    for (sweep = 0; sweep < MAX_SWEEPS && (a[0][1] | a[0][2] | a[1][2]) != 0; sweep++) {
        jacobi_step(a, v, 0, 1, 2);
        jacobi_step(a, v, 0, 2, 1);
        jacobi_step(a, v, 1, 2, 0);
    }
    for (k = 0; k < 3; k++) { /* three exchanges of neighbours sort three */
        int i = k & 1;
        if (a[order[i]][order[i]] < a[order[i + 1]][order[i + 1]]) {
            int t = order[i];
            order[i] = order[i + 1];
            order[i + 1] = t;
        }
    }
    for (k = 0; k < 3; k++) {
        out->value[k] = a[order[k]][order[k]];
        copy3(out->vector_q60[k], v[order[k]]);
    }
    fix_sign(out->vector_q60[0]);
    fix_sign(out->vector_q60[1]);
    if (triple_q60(out->vector_q60) < 0) {
        negate3(out->vector_q60[2]);
    }
    return sweep;
}

int32_t drogue_sym3_normalise(drogue_sym3 *matrix, const drogue_wide entries[6])
{
    int32_t top = 0;
    int found = 0;
    int i;
    for (i = 0; i < 6; i++) {
        if (entries[i].mantissa != 0 && (!found || entries[i].exponent > top)) {
            top = entries[i].exponent;
            found = 1;
        }
    }
    for (i = 0; i < 6; i++) { /* the largest mantissa, in [2^61, 2^62), loses three bits */
        matrix->a[i] = drogue_wide_to_s64(entries[i], -(top + 3));
    }
    return top + 3;
}
