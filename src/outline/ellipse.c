/* SPDX-License-Identifier: Apache-2.0 */
/* Direct least-squares ellipse fit from exact moments (Halir and Flusser 1998). */
#include "drogue/ellipse.h"

#include <string.h>

#include "drogue/cholesky.h"
#include "drogue/eigen.h"

#define PIVOT_BITS 26 /* points whose squared spread across is 2^-26 of that along are collinear */
#define FLOOR_BITS 28 /* the last pivot of the reduced scatter this small is rounding: the points lie on a conic */

/* Eliminate 1, x, y: leaves the multipliers in columns 0..2 and the reduced scatter matrix in rows 3..5. */
static drogue_status eliminate_linear_part(drogue_real scatter[21])
{
    drogue_real column[6];
    int k;
    int i;
    int j;
    for (k = 0; k < 3; k++) {
        const drogue_real *pivot = &scatter[DROGUE_PACKED(k, k)];
        drogue_real least;
        drogue_real_copy(&least, &scatter[DROGUE_PACKED(1, 1)]); /* x has the larger spread */
        drogue_real_shift(&least, -PIVOT_BITS);
        if (k > 0 && drogue_real_order(pivot, &least) <= 0) {
            return DROGUE_E_DEGENERATE;
        }
        for (i = k + 1; i < 6; i++) {
            drogue_real_copy(&column[i], &scatter[DROGUE_PACKED(i, k)]);
            drogue_real_quotient(&scatter[DROGUE_PACKED(i, k)], &column[i], pivot);
            for (j = k + 1; j <= i; j++) {
                drogue_real_subtract_product(&scatter[DROGUE_PACKED(i, j)], &scatter[DROGUE_PACKED(i, k)], &column[j]);
            }
        }
    }
    return DROGUE_OK;
}

/* -a b c */
static void minus_product(drogue_real *out, const drogue_real *a, const drogue_real *b, const drogue_real *c)
{
    drogue_real_product(out, b, c);
    drogue_real_product(out, a, out);
    drogue_real_negate(out);
}

/* Cholesky factor of the reduced scatter matrix, inverted: lower triangle h with h M h' = 1. Pivots are judged against
 * 'spread', the diagonal before the reduction; 'singular' tells that the last one vanished. */
static drogue_status inverse_cholesky(drogue_real h[6], int *singular, const drogue_real scatter[21],
                                      const drogue_real spread[3])
{
    drogue_real one;
    drogue_real g[6]; /* the factor below its diagonal */
    int i;
    int j;
    int k;
    drogue_real_set(&one, 1, 0);
    for (i = 0; i < 3; i++) {
        for (j = 0; j <= i; j++) {
            drogue_real sum;
            drogue_real_copy(&sum, &scatter[DROGUE_PACKED(3 + i, 3 + j)]);
            for (k = 0; k < j; k++) {
                drogue_real_subtract_product(&sum, &g[DROGUE_PACKED(i, k)], &g[DROGUE_PACKED(j, k)]);
            }
            if (i == j) {
                drogue_real least;
                int order;
                drogue_real_copy(&least, &spread[i]);
                drogue_real_shift(&least, i < 2 ? -PIVOT_BITS : -FLOOR_BITS);
                order = drogue_real_order(&sum, &least);
                if (least.mantissa <= 0 || (i < 2 && order <= 0)) {
                    return DROGUE_E_DEGENERATE; /* more than one conic through the points, or one that is no ellipse */
                }
                *singular = order < 0;
                drogue_real_root(&sum, *singular ? &least : &sum);
                drogue_real_quotient(&h[DROGUE_PACKED(i, i)], &one, &sum);
            } else {
                drogue_real_product(&g[DROGUE_PACKED(i, j)], &sum, &h[DROGUE_PACKED(j, j)]);
            }
        }
    }
    minus_product(&h[1], &g[1], &h[0], &h[2]);
    minus_product(&h[4], &g[4], &h[2], &h[5]);
    drogue_real_product(&g[0], &g[4], &h[2]);
    drogue_real_determinant(&h[3], &g[1], &g[0], &g[3], &one);
    drogue_real_product(&g[0], &h[0], &h[5]);
    drogue_real_product(&h[3], &h[3], &g[0]);
    return DROGUE_OK;
}

/* Reduce the scatter matrix to its quadratic part: the multipliers stay in columns 0..2. */
static drogue_status reduce(drogue_real h[6], int *singular, drogue_real scatter[21])
{
    drogue_real spread[3];
    drogue_status status;
    int k;
    for (k = 0; k < 3; k++) {
        drogue_real_copy(&spread[k], &scatter[DROGUE_PACKED(3 + k, 3 + k)]);
    }
    status = eliminate_linear_part(scatter);
    return status == DROGUE_OK ? inverse_cholesky(h, singular, scatter, spread) : status;
}

/* h K h', K the constraint 4AC - B^2 as a matrix. */
static void constraint_matrix(drogue_real matrix[6], const drogue_real h[6])
{
    drogue_real twice;
    drogue_real_set(&matrix[0], 0, 0);
    drogue_real_set(&matrix[1], 0, 0);
    drogue_real_copy(&twice, &h[5]);
    drogue_real_shift(&twice, 1);
    drogue_real_product(&matrix[2], &h[0], &twice);
    drogue_real_product(&matrix[3], &h[2], &h[2]);
    drogue_real_negate(&matrix[3]);
    drogue_real_determinant(&matrix[4], &h[1], &twice, &h[2], &h[4]);
    drogue_real_shift(&twice, 1);
    drogue_real_determinant(&matrix[5], &h[3], &twice, &h[4], &h[4]);
}

/* The quadratic part, eigenvector of the largest eigenvalue of h K h': the coefficients take the place of the last
 * three entries of h, each when its column has served. */
static drogue_status solve_quadratic_part(drogue_real h[6], int singular)
{
    drogue_real matrix[6];
    drogue_eigen3 eigen;
    int i;
    int k;
    constraint_matrix(matrix, h);
    (void)drogue_eigen_sym3(&eigen, matrix);
    drogue_real_negate(&eigen.value[2]);
    drogue_real_shift(&eigen.value[2], 8);
    if (eigen.value[0].mantissa <= 0 || (singular && drogue_real_order(&eigen.value[2], &eigen.value[0]) >= 0)) {
        return DROGUE_E_DEGENERATE; /* the conic that the points lie on is no ellipse */
    }
    for (i = 0; i < 3; i++) {
        drogue_real sum;
        drogue_real_set(&sum, 0, 0);
        for (k = 2; k >= i; k--) {
            drogue_real v;
            drogue_real_set(&v, eigen.vector_q30[0][k], -30);
            drogue_real_negate(&v);
            drogue_real_subtract_product(&sum, &h[DROGUE_PACKED(k, i)], &v);
        }
        drogue_real_copy(&h[3 + i], &sum);
    }
    return DROGUE_OK;
}

/* The linear part follows from the quadratic one; the sign makes the quadratic part positive. */
static void solve_linear_part(drogue_real theta[6], const drogue_scatter *scatter)
{
    drogue_real trace;
    int k;
    int i;
    for (k = 2; k >= 0; k--) {
        drogue_real_set(&theta[k], 0, 0);
        for (i = k + 1; i < 6; i++) {
            drogue_real_subtract_product(&theta[k], &scatter->entry[DROGUE_PACKED(i, k)], &theta[i]);
        }
    }
    for (k = 0; k < 3; k++) { /* what was taken before */
        for (i = 0; i < 3; i++) {
            drogue_real_set(&trace, scatter->taken[i][k], 0);
            drogue_real_subtract_product(&theta[k], &trace, &theta[3 + i]);
        }
    }
    drogue_real_sum(&trace, &theta[3], &theta[5]);
    if (trace.mantissa < 0) {
        for (k = 0; k < 6; k++) {
            drogue_real_negate(&theta[k]);
        }
    }
}

static void exchange(drogue_real *a, drogue_real *b)
{
    drogue_real t;
    drogue_real_copy(&t, a);
    drogue_real_copy(a, b);
    drogue_real_copy(b, &t);
}

drogue_status drogue_ellipse_fit(drogue_ellipse *out, const drogue_moments *m, int frac_bits)
{
    drogue_scatter scatter;
    drogue_real theta[6]; /* h, then the conic */
    drogue_status status;
    int singular = 0;
    int swap;
    memset(out, 0, sizeof *out);
    if (frac_bits < 0 || frac_bits > 15 || m->n > DROGUE_MAX_FIT_POINTS) {
        return DROGUE_E_ARGUMENT;
    }
    if (m->n < 6) {
        return DROGUE_E_TOO_FEW_POINTS;
    }
    DROGUE_NOTE("ellipse: first moment", m->m10, 33);
    DROGUE_NOTE("ellipse: second moment", m->m20, 48);
    DROGUE_NOTE("ellipse: third moment", m->m30, 63);
    DROGUE_NOTE("ellipse: fourth moment / 2^32, before carries", m->m40.high, 46);
    swap = drogue_moments_scatter(&scatter, m);
    status = reduce(theta, &singular, scatter.entry);
    if (status == DROGUE_OK) {
        status = solve_quadratic_part(theta, singular);
    }
    if (status != DROGUE_OK) {
        return status;
    }
    solve_linear_part(theta, &scatter);
    if (swap) {
        exchange(&theta[1], &theta[2]);
        exchange(&theta[3], &theta[5]);
    }
    return drogue_conic_ellipse(out, theta, scatter.centre, frac_bits);
}
