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
        drogue_wide least = drogue_wide_scale(scatter[DROGUE_PACKED(1, 1)], -PIVOT_BITS); /* x has the larger spread */
        drogue_wide pivot = scatter[DROGUE_PACKED(k, k)];
        if (drogue_wide_cmp(pivot, least) <= 0 && k > 0) {
            return DROGUE_E_DEGENERATE;
        }
        for (i = k + 1; i < 6; i++) {
            column[i] = scatter[DROGUE_PACKED(i, k)];
            scatter[DROGUE_PACKED(i, k)] = drogue_wide_div(column[i], pivot);
            for (j = k + 1; j <= i; j++) {
                scatter[DROGUE_PACKED(i, j)] = drogue_wide_sub(
                    scatter[DROGUE_PACKED(i, j)], drogue_wide_mul(scatter[DROGUE_PACKED(i, k)], column[j]));
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
    out->mantissa = -out->mantissa;
}

/* a b 2^shift - c d */
static void difference(drogue_wide *out, const drogue_wide *a, const drogue_wide *b, int shift, const drogue_wide *c,
                       const drogue_wide *d)
{
    drogue_wide second;
    drogue_wide_product(&second, c, d);
    drogue_wide_product(out, a, b);
    *out = drogue_wide_scale(*out, shift);
    drogue_wide_difference(out, out, &second);
}

/* Cholesky factor of the reduced scatter matrix, inverted: lower triangle h with h M h' = 1. Pivots are judged against
 * 'spread', the diagonal before the reduction; 'singular' tells that the last one vanished. */
static drogue_status inverse_cholesky(drogue_wide h[6], int *singular, const drogue_wide scatter[21],
                                      const drogue_wide spread[3])
{
    const drogue_wide one = drogue_wide_from_s64(1, 0);
    drogue_wide g[6]; /* the factor below its diagonal */
    int i;
    int j;
    int k;
    for (i = 0; i < 3; i++) {
        for (j = 0; j <= i; j++) {
            drogue_wide sum = scatter[DROGUE_PACKED(3 + i, 3 + j)];
            for (k = 0; k < j; k++) {
                sum = drogue_wide_sub(sum, drogue_wide_mul(g[DROGUE_PACKED(i, k)], g[DROGUE_PACKED(j, k)]));
            }
            if (i == j) {
                drogue_wide least = drogue_wide_scale(spread[i], i < 2 ? -PIVOT_BITS : -FLOOR_BITS);
                if (least.mantissa <= 0 || (i < 2 && drogue_wide_cmp(sum, least) <= 0)) {
                    return DROGUE_E_DEGENERATE; /* more than one conic through the points, or one that is no ellipse */
                }
                *singular = drogue_wide_cmp(sum, least) < 0;
                h[DROGUE_PACKED(i, i)] = drogue_wide_div(one, drogue_wide_sqrt(*singular ? least : sum));
            } else {
                g[DROGUE_PACKED(i, j)] = drogue_wide_mul(sum, h[DROGUE_PACKED(j, j)]);
            }
        }
    }
    minus_product(&h[1], &g[1], &h[0], &h[2]);
    minus_product(&h[4], &g[4], &h[2], &h[5]);
    h[3] = drogue_wide_mul(g[4], h[2]);
    h[3] = drogue_wide_sub(drogue_wide_mul(g[1], h[3]), g[3]);
    h[3] = drogue_wide_mul(h[3], drogue_wide_mul(h[0], h[5]));
    return DROGUE_OK;
}

/* Reduce the scatter matrix to its quadratic part: the multipliers stay in columns 0..2. */
static drogue_status reduce(drogue_wide h[6], int *singular, drogue_wide scatter[21])
{
    drogue_wide spread[3];
    drogue_status status;
    int k;
    for (k = 0; k < 3; k++) {
        spread[k] = scatter[DROGUE_PACKED(3 + k, 3 + k)];
    }
    status = eliminate_linear_part(scatter);
    return status == DROGUE_OK ? inverse_cholesky(h, singular, scatter, spread) : status;
}

/* h K h' in block-normalised integers, K the constraint 4AC - B^2 as a matrix. */
static void constraint_matrix(drogue_sym3 *matrix, const drogue_wide h[6])
{
    const drogue_wide zero = {0, 0};
    drogue_wide n[6];
    n[0] = zero;
    n[1] = zero;
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
        drogue_wide sum = {0, 0};
        for (k = 2; k >= i; k--) {
            drogue_wide v = drogue_wide_from_s64(eigen.vector_q60[0][k], -DROGUE_EIGEN_FRAC);
            sum = drogue_wide_add(drogue_wide_mul(h[DROGUE_PACKED(k, i)], v), sum);
        }
        h[3 + i] = sum;
    }
    return DROGUE_OK;
}

/* The linear part follows from the quadratic one; the sign makes the quadratic part positive. */
static void solve_linear_part(drogue_wide theta[6], const drogue_wide scatter[21])
{
    int k;
    int i;
    for (k = 2; k >= 0; k--) {
        theta[k] = drogue_wide_from_s64(0, 0);
        for (i = k + 1; i < 6; i++) {
            theta[k] = drogue_wide_sub(theta[k], drogue_wide_mul(scatter[DROGUE_PACKED(i, k)], theta[i]));
        }
    }
    if (drogue_wide_add(theta[3], theta[5]).mantissa < 0) {
        for (k = 0; k < 6; k++) {
            theta[k] = drogue_wide_neg(theta[k]);
        }
    }
}

static void exchange(drogue_wide *a, drogue_wide *b)
{
    drogue_wide t = *a;
    *a = *b;
    *b = t;
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
