/* SPDX-License-Identifier: Apache-2.0 */
/* Cholesky factorisation of matrices up to 5 x 5. */
#include "drogue/cholesky.h"

#include <string.h>

#define PIVOT_BITS 26 /* a pivot this many bits below its diagonal entry is rounding */

drogue_status drogue_cholesky_factor(drogue_real *a, int n)
{
    int i;
    int j;
    int k;
    for (j = 0; j < n; j++) {
        for (i = j; i < n; i++) {
            drogue_real sum;
            drogue_real_copy(&sum, &a[DROGUE_PACKED(i, j)]);
            for (k = 0; k < j; k++) {
                drogue_real_subtract_product(&sum, &a[DROGUE_PACKED(i, k)], &a[DROGUE_PACKED(j, k)]);
            }
            if (i > j) {
                drogue_real_quotient(&a[DROGUE_PACKED(i, j)], &sum, &a[DROGUE_PACKED(j, j)]);
            } else {
                drogue_real_shift(&a[DROGUE_PACKED(j, j)], -PIVOT_BITS);
                if (drogue_real_order(&sum, &a[DROGUE_PACKED(j, j)]) <= 0) {
                    return DROGUE_E_DEGENERATE;
                }
                drogue_real_root(&a[DROGUE_PACKED(j, j)], &sum);
            }
        }
    }
    return DROGUE_OK;
}

/* Solve L x = b in place, b being 0 before 'first'. */
static void forward(drogue_real *b, const drogue_real *l, int n, int first)
{
    int i;
    int k;
    for (i = first; i < n; i++) {
        for (k = first; k < i; k++) {
            drogue_real_subtract_product(&b[i], &l[DROGUE_PACKED(i, k)], &b[k]);
        }
        drogue_real_quotient(&b[i], &b[i], &l[DROGUE_PACKED(i, i)]);
    }
}

/* Solve L' x = b in place, down to x[first]. */
static void backward(drogue_real *b, const drogue_real *l, int n, int first)
{
    int i;
    int k;
    for (i = n - 1; i >= first; i--) {
        for (k = i + 1; k < n; k++) {
            drogue_real_subtract_product(&b[i], &l[DROGUE_PACKED(k, i)], &b[k]);
        }
        drogue_real_quotient(&b[i], &b[i], &l[DROGUE_PACKED(i, i)]);
    }
}

void drogue_cholesky_solve(drogue_real *b, const drogue_real *l, int n)
{
    forward(b, l, n, 0);
    backward(b, l, n, 0);
}

void drogue_cholesky_square(drogue_real *out, const drogue_real *b, const drogue_real *l, int n)
{
    drogue_real y[DROGUE_CHOLESKY_MAX];
    int i;
    memcpy(y, b, (size_t)n * sizeof *y);
    forward(y, l, n, 0);
    drogue_real_set(out, 0, 0);
    for (i = 0; i < n; i++) {
        drogue_real_product(&y[i], &y[i], &y[i]);
        drogue_real_sum(out, out, &y[i]);
    }
}

void drogue_cholesky_invert(drogue_real *inverse, const drogue_real *l, int n)
{
    drogue_real column[DROGUE_CHOLESKY_MAX];
    int i;
    int j;
    for (j = 0; j < n; j++) {
        memset(column, 0, sizeof column);
        drogue_real_set(&column[j], 1, 0);
        forward(column, l, n, j);
        backward(column, l, n, j);
        for (i = j; i < n; i++) {
            drogue_real_copy(&inverse[DROGUE_PACKED(i, j)], &column[i]);
        }
    }
}
