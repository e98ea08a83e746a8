/* SPDX-License-Identifier: Apache-2.0 */
/* Real numbers to and from quadruple precision, and small dense matrices in it. */
#ifndef DROGUE_TESTS_REAL_QUAD_H
#define DROGUE_TESTS_REAL_QUAD_H

#include "drogue/cholesky.h"
#include "quad.h"

static inline quad quad_of(drogue_real v) { return quad_scale((quad)v.mantissa, v.exponent); }

static inline drogue_real real_set(int64_t v, int32_t exponent)
{
    drogue_real r;
    drogue_real_set(&r, v, exponent);
    return r;
}

/* Rounded to 31 bits. */
static inline drogue_real real_of(quad v)
{
    int exponent = 0;
    if (v == 0) {
        return real_set(0, 0);
    }
    for (; quad_abs(v) >= (quad)2305843009213693952.0L; v /= 2) { /* 2^61 */
        exponent++;
    }
    for (; quad_abs(v) < (quad)2305843009213693952.0L; v *= 2) {
        exponent--;
    }
    return real_set((int64_t)v, exponent);
}

/* inverse = matrix^-1 by Gauss and Jordan with exchange of rows; 0 when singular. */
static inline int quad_invert(quad inverse[5][5], quad matrix[5][5], int n)
{
    quad m[5][10];
    int i, j, k;
    for (i = 0; i < n; i++) {
        for (j = 0; j < n; j++) {
            m[i][j] = matrix[i][j];
            m[i][n + j] = i == j;
        }
    }
    for (k = 0; k < n; k++) {
        int best = k;
        for (i = k; i < n; i++) {
            best = quad_abs(m[i][k]) > quad_abs(m[best][k]) ? i : best;
        }
        if (m[best][k] == 0) {
            return 0;
        }
        for (j = 0; j < 2 * n; j++) {
            quad t = m[k][j];
            m[k][j] = m[best][j];
            m[best][j] = t;
        }
        for (j = 2 * n - 1; j >= k; j--) {
            m[k][j] /= m[k][k];
        }
        for (i = 0; i < n; i++) {
            for (j = 2 * n - 1; i != k && j >= k; j--) {
                m[i][j] -= m[i][k] * m[k][j];
            }
        }
    }
    for (i = 0; i < n; i++) {
        for (j = 0; j < n; j++) {
            inverse[i][j] = m[i][n + j];
        }
    }
    return 1;
}

#endif
