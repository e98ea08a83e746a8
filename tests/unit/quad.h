/* SPDX-License-Identifier: Apache-2.0 */
/* Quadruple precision, so that a reference's own rounding never counts: Jacobi's method for symmetric 3x3. C99, C++17. */
#ifndef DROGUE_TESTS_QUAD_H
#define DROGUE_TESTS_QUAD_H

#include <float.h>
#include <math.h>

#if LDBL_MANT_DIG >= 113
typedef long double quad;
#else
__extension__ typedef __float128 quad;
#endif

static inline quad quad_abs(quad v) { return v < 0 ? -v : v; }

/* v * 2^n, |n| <= 2000 */
static inline quad quad_scale(quad v, int n)
{
    for (; n >= 60; n -= 60) {
        v *= (quad)1152921504606846976.0L;
    }
    for (; n <= -60; n += 60) {
        v /= (quad)1152921504606846976.0L;
    }
    return v * (quad)ldexpl(1.0L, n);
}

/* Square root by Newton's method from the long double one. */
static inline quad quad_sqrt(quad v)
{
    quad r;
    int n = 0;
    if (!(v > 0)) {
        return 0;
    }
    for (; v > (quad)1e300L; v /= 16) {
        n += 2;
    }
    for (; v < (quad)1e-300L; v *= 16) {
        n -= 2;
    }
    r = (quad)sqrtl((long double)v);
    r = (r + v / r) / 2;
    r = (r + v / r) / 2;
    return quad_scale(r, n);
}

/* Eigenvalues in descending order and their unit vectors (row k of 'vector') of the symmetric matrix a. */
static inline void quad_eigen3(quad value[3], quad vector[3][3], const quad matrix[3][3])
{
    quad a[3][3], v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    int order[3] = {0, 1, 2}, sweep, p, q, k;
    for (p = 0; p < 3; p++) {
        for (q = 0; q < 3; q++) {
            a[p][q] = matrix[p][q];
        }
    }
    for (sweep = 0; sweep < 40 && (a[0][1] != 0 || a[0][2] != 0 || a[1][2] != 0); sweep++) {
        for (p = 0; p < 2; p++) {
            for (q = p + 1; q < 3; q++) {
                quad d = a[q][q] - a[p][p], b = 2 * a[p][q], h = quad_sqrt(d * d + b * b), t, c, s;
                if (h == 0 || quad_abs(a[p][q]) <= quad_scale(quad_abs(a[p][p]) + quad_abs(a[q][q]), -120)) {
                    a[p][q] = a[q][p] = 0;
                    continue;
                }
                t = b / (d < 0 ? d - h : d + h);
                c = 1 / quad_sqrt(1 + t * t);
                s = t * c;
                for (k = 0; k < 3; k++) {
                    quad x = a[p][k], y = a[q][k];
                    a[p][k] = c * x - s * y;
                    a[q][k] = s * x + c * y;
                    x = v[p][k];
                    y = v[q][k];
                    v[p][k] = c * x - s * y;
                    v[q][k] = s * x + c * y;
                }
                for (k = 0; k < 3; k++) {
                    quad x = a[k][p], y = a[k][q];
                    a[k][p] = c * x - s * y;
                    a[k][q] = s * x + c * y;
                }
            }
        }
    }
    for (k = 0; k < 3; k++) {
        int i = k & 1;
        if (a[order[i]][order[i]] < a[order[i + 1]][order[i + 1]]) {
            int t = order[i];
            order[i] = order[i + 1];
            order[i + 1] = t;
        }
    }
    for (k = 0; k < 3; k++) {
        value[k] = a[order[k]][order[k]];
        for (p = 0; p < 3; p++) {
            vector[k][p] = v[order[k]][p];
        }
    }
}

#endif
