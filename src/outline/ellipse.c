/* SPDX-License-Identifier: Apache-2.0 */
/* Direct least-squares ellipse fit from exact moments (Halir and Flusser 1998). */
#include "drogue/ellipse.h"

#include <string.h>

#include "drogue/cholesky.h"
#include "drogue/eigen.h"

#define PIVOT_BITS 48 /* points whose spread across is 2^-48 of that along are collinear */
#define FLOOR_BITS 58 /* the last pivot of the reduced scatter this small is rounding: the points lie on a conic */

/* Eliminate 1, x, y: leaves the multipliers in columns 0..2 and the reduced scatter matrix in rows 3..5. */
static drogue_status eliminate_linear_part(drogue_wide scatter[21])
{
    drogue_wide column[6];
    int k;
    int i;
    int j;
    for (k = 0; k < 3; k++) {
        const drogue_wide *pivot = &scatter[DROGUE_PACKED(k, k)];
        drogue_wide least;
        drogue_wide_copy(&least, &scatter[DROGUE_PACKED(1, 1)]); /* x has the larger spread */
        drogue_wide_shift(&least, -PIVOT_BITS);
        if (k > 0 && drogue_wide_order(pivot, &least) <= 0) {
            return DROGUE_E_DEGENERATE;
        }
        for (i = k + 1; i < 6; i++) {
            drogue_wide_copy(&column[i], &scatter[DROGUE_PACKED(i, k)]);
            drogue_wide_quotient(&scatter[DROGUE_PACKED(i, k)], &column[i], pivot);
            for (j = k + 1; j <= i; j++) {
                drogue_wide_subtract_product(&scatter[DROGUE_PACKED(i, j)], &scatter[DROGUE_PACKED(i, k)], &column[j]);
            }
        }
    }
    return DROGUE_OK;
}

/* Products of wide numbers through pointers: what they need of the stack is given back. */
static void minus_product(drogue_wide *out, const drogue_wide *a, const drogue_wide *b, const drogue_wide *c)
{
    drogue_wide_product(out, b, c);
    drogue_wide_product(out, a, out);
    drogue_wide_negate(out);
}

/* a b 2^shift - c d */
static void difference(drogue_wide *out, const drogue_wide *a, const drogue_wide *b, int shift, const drogue_wide *c,
                       const drogue_wide *d)
{
    drogue_wide second;
    drogue_wide_product(&second, c, d);
    drogue_wide_product(out, a, b);
    drogue_wide_shift(out, shift);
    drogue_wide_difference(out, out, &second);
}

/* Cholesky factor of the reduced scatter matrix, inverted: lower triangle h with h M h' = 1. Pivots are judged against
 * 'spread', the diagonal before the reduction; 'singular' tells that the last one vanished. */
static drogue_status inverse_cholesky(drogue_wide h[6], int *singular, const drogue_wide scatter[21],
                                      const drogue_wide spread[3])
{
    drogue_wide one;
    drogue_wide g[6]; /* the factor below its diagonal */
    int i;
    int j;
    int k;
    drogue_wide_set(&one, 1, 0);
    for (i = 0; i < 3; i++) {
        for (j = 0; j <= i; j++) {
            drogue_wide sum;
            drogue_wide_copy(&sum, &scatter[DROGUE_PACKED(3 + i, 3 + j)]);
            for (k = 0; k < j; k++) {
                drogue_wide_subtract_product(&sum, &g[DROGUE_PACKED(i, k)], &g[DROGUE_PACKED(j, k)]);
            }
            if (i == j) {
                drogue_wide least;
                int order;
                drogue_wide_copy(&least, &spread[i]);
                drogue_wide_shift(&least, i < 2 ? -PIVOT_BITS : -FLOOR_BITS);
                order = drogue_wide_order(&sum, &least);
                if (least.mantissa <= 0 || (i < 2 && order <= 0)) {
                    return DROGUE_E_DEGENERATE; /* more than one conic through the points, or one that is no ellipse */
                }
                *singular = order < 0;
                drogue_wide_root(&sum, *singular ? &least : &sum);
                drogue_wide_quotient(&h[DROGUE_PACKED(i, i)], &one, &sum);
            } else {
                drogue_wide_product(&g[DROGUE_PACKED(i, j)], &sum, &h[DROGUE_PACKED(j, j)]);
            }
        }
    }
    minus_product(&h[1], &g[1], &h[0], &h[2]);
    minus_product(&h[4], &g[4], &h[2], &h[5]);
    drogue_wide_product(&h[3], &g[4], &h[2]);
    drogue_wide_product(&h[3], &g[1], &h[3]);
    drogue_wide_difference(&h[3], &h[3], &g[3]);
    drogue_wide_product(&g[0], &h[0], &h[5]);
    drogue_wide_product(&h[3], &h[3], &g[0]);
    return DROGUE_OK;
}

/* Reduce the scatter matrix to its quadratic part: the multipliers stay in columns 0..2. */
static drogue_status reduce(drogue_wide h[6], int *singular, drogue_wide scatter[21])
{
    drogue_wide spread[3];
    drogue_status status;
    int k;
    for (k = 0; k < 3; k++) {
        drogue_wide_copy(&spread[k], &scatter[DROGUE_PACKED(3 + k, 3 + k)]);
    }
    status = eliminate_linear_part(scatter);
    return status == DROGUE_OK ? inverse_cholesky(h, singular, scatter, spread) : status;
}

/* h K h' in block-normalised integers, K the constraint 4AC - B^2 as a matrix. */
static void constraint_matrix(drogue_sym3 *matrix, const drogue_wide h[6])
{
    const drogue_wide zero = {0, 0};
    drogue_wide n[6];
    drogue_wide_copy(&n[0], &zero);
    drogue_wide_copy(&n[1], &zero);
    difference(&n[2], &h[0], &h[5], 1, &zero, &zero);
    difference(&n[3], &zero, &zero, 0, &h[2], &h[2]);
    difference(&n[4], &h[1], &h[5], 1, &h[2], &h[4]);
    difference(&n[5], &h[3], &h[5], 2, &h[4], &h[4]);
    (void)drogue_sym3_normalise(matrix, n);
}

/* The quadratic part, eigenvector of the largest eigenvalue of h K h': the coefficients take the place of the last three
 * entries of h, each when its column has served. */
static drogue_status solve_quadratic_part(drogue_wide h[6], int singular)
{
    drogue_sym3 matrix;
    drogue_eigen3 eigen;
    int i;
    int k;
    constraint_matrix(&matrix, h);
    (void)drogue_eigen_sym3(&eigen, &matrix);
    if (eigen.value[0] <= 0 || (singular && -eigen.value[2] >= eigen.value[0] >> 8)) {
        return DROGUE_E_DEGENERATE; /* the conic that the points lie on is no ellipse */
    }
    for (i = 0; i < 3; i++) {
        drogue_wide sum;
        drogue_wide_set(&sum, 0, 0);
        for (k = 2; k >= i; k--) {
            drogue_wide v;
            drogue_wide_set(&v, eigen.vector_q60[0][k], -DROGUE_EIGEN_FRAC);
            drogue_wide_product(&v, &h[DROGUE_PACKED(k, i)], &v);
            drogue_wide_sum(&sum, &v, &sum);
        }
        drogue_wide_copy(&h[3 + i], &sum);
    }
    return DROGUE_OK;
}

/* The linear part follows from the quadratic one; the sign makes the quadratic part positive. */
static void solve_linear_part(drogue_wide theta[6], const drogue_wide scatter[21])
{
    drogue_wide trace;
    int k;
    int i;
    for (k = 2; k >= 0; k--) {
        drogue_wide_set(&theta[k], 0, 0);
        for (i = k + 1; i < 6; i++) {
            drogue_wide_subtract_product(&theta[k], &scatter[DROGUE_PACKED(i, k)], &theta[i]);
        }
    }
    drogue_wide_sum(&trace, &theta[3], &theta[5]);
    if (trace.mantissa < 0) {
        for (k = 0; k < 6; k++) {
            drogue_wide_negate(&theta[k]);
        }
    }
}

static void exchange(drogue_wide *a, drogue_wide *b)
{
    drogue_wide t;
    drogue_wide_copy(&t, a);
    drogue_wide_copy(a, b);
    drogue_wide_copy(b, &t);
}

drogue_status drogue_ellipse_fit(drogue_ellipse *out, const drogue_moments *m, int frac_bits)
{
    drogue_wide scatter[21];
    drogue_wide theta[6]; /* h, then the conic */
    drogue_status status;
    int64_t centre[2];
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
    DROGUE_NOTE("ellipse: fourth moment / 2^64", m->m40.hi, 14);
    swap = drogue_moments_scatter(scatter, centre, m);
    status = reduce(theta, &singular, scatter);
    if (status == DROGUE_OK) {
        status = solve_quadratic_part(theta, singular);
    }
    if (status != DROGUE_OK) {
        return status;
    }
    solve_linear_part(theta, scatter);
    if (swap) {
        exchange(&theta[1], &theta[2]);
        exchange(&theta[3], &theta[5]);
    }
    return drogue_conic_ellipse(out, theta, centre, frac_bits);
}
