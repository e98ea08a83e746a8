/* SPDX-License-Identifier: Apache-2.0 */
/* Direct least-squares ellipse fit from exact moments (Halir and Flusser 1998). */
#include "drogue/ellipse.h"

#include <string.h>

#include "drogue/eigen.h"

#define PIVOT_BITS 48 /* points whose spread across is 2^-48 of that along are collinear */
#define FLOOR_BITS 58 /* the last pivot of the reduced scatter this small is rounding: the points lie on a conic */

void drogue_moments_clear(drogue_moments *m) { memset(m, 0, sizeof *m); }

void drogue_moments_add_point(drogue_moments *m, int32_t x, int32_t y)
{
    const int32_t xx = x * x; /* at most 2^30 */
    const int32_t xy = x * y;
    const int32_t yy = y * y;
    DROGUE_NOTE("ellipse: x", x, 16);
    DROGUE_NOTE("ellipse: y", y, 16);
    m->n++;
    m->m10 += x;
    m->m01 += y;
    m->m20 += xx;
    m->m11 += xy;
    m->m02 += yy;
    m->m30 += (int64_t)xx * x;
    m->m21 += (int64_t)xx * y;
    m->m12 += (int64_t)yy * x;
    m->m03 += (int64_t)yy * y;
    m->m40 = drogue_s128_add(m->m40, drogue_s128_from_s64((int64_t)xx * xx));
    m->m31 = drogue_s128_add(m->m31, drogue_s128_from_s64((int64_t)xx * xy));
    m->m22 = drogue_s128_add(m->m22, drogue_s128_from_s64((int64_t)xx * yy));
    m->m13 = drogue_s128_add(m->m13, drogue_s128_from_s64((int64_t)xy * yy));
    m->m04 = drogue_s128_add(m->m04, drogue_s128_from_s64((int64_t)yy * yy));
}

void drogue_moments_add(drogue_moments *m, const drogue_moments *other)
{
    m->n += other->n;
    m->m10 += other->m10;
    m->m01 += other->m01;
    m->m20 += other->m20;
    m->m11 += other->m11;
    m->m02 += other->m02;
    m->m30 += other->m30;
    m->m21 += other->m21;
    m->m12 += other->m12;
    m->m03 += other->m03;
    m->m40 = drogue_s128_add(m->m40, other->m40);
    m->m31 = drogue_s128_add(m->m31, other->m31);
    m->m22 = drogue_s128_add(m->m22, other->m22);
    m->m13 = drogue_s128_add(m->m13, other->m13);
    m->m04 = drogue_s128_add(m->m04, other->m04);
}

/* v * c modulo 2^128 */
static drogue_s128 s128_scale(drogue_s128 v, int64_t c)
{
    drogue_s128 r = drogue_s128_mul((int64_t)v.lo, c);
    uint64_t carry = (uint64_t)v.hi * (uint64_t)c + ((int64_t)v.lo < 0 ? (uint64_t)c : 0u);
    r.hi = (int64_t)((uint64_t)r.hi + carry);
    return r;
}

/* Moments about the origin -> about (cx, cy), exact: sums of x^p y^q in s[p][q]. Intermediate sums may wrap
 * modulo 2^128, the results fit. */
static void centre_moments(drogue_s128 s[5][5], int64_t cx, int64_t cy)
{
    int fixed;
    int pass;
    int i;
    for (fixed = 0; fixed <= 4; fixed++) { /* binomial shift: repeated s_i -= c s_(i-1) */
        for (pass = 1; pass <= 4 - fixed; pass++) {
            for (i = 4 - fixed; i >= pass; i--) {
                s[i][fixed] = drogue_s128_sub(s[i][fixed], s128_scale(s[i - 1][fixed], cx));
            }
        }
    }
    for (fixed = 0; fixed <= 4; fixed++) {
        for (pass = 1; pass <= 4 - fixed; pass++) {
            for (i = 4 - fixed; i >= pass; i--) {
                s[fixed][i] = drogue_s128_sub(s[fixed][i], s128_scale(s[fixed][i - 1], cy));
            }
        }
    }
}

static void spread_moments(drogue_s128 s[5][5], const drogue_moments *m)
{
    memset(s, 0, 25 * sizeof(drogue_s128));
    s[0][0] = drogue_s128_from_s64(m->n);
    s[1][0] = drogue_s128_from_s64(m->m10);
    s[0][1] = drogue_s128_from_s64(m->m01);
    s[2][0] = drogue_s128_from_s64(m->m20);
    s[1][1] = drogue_s128_from_s64(m->m11);
    s[0][2] = drogue_s128_from_s64(m->m02);
    s[3][0] = drogue_s128_from_s64(m->m30);
    s[2][1] = drogue_s128_from_s64(m->m21);
    s[1][2] = drogue_s128_from_s64(m->m12);
    s[0][3] = drogue_s128_from_s64(m->m03);
    s[4][0] = m->m40;
    s[3][1] = m->m31;
    s[2][2] = m->m22;
    s[1][3] = m->m13;
    s[0][4] = m->m04;
}

/* Monomials in the order of elimination: 1, x, y, then x^2, xy, y^2. */
static const int power_x[6] = {0, 1, 0, 2, 1, 0};
static const int power_y[6] = {0, 0, 1, 0, 1, 2};

/* Scatter matrix of the monomials, lower triangle; x and y change roles when 'swap' is set. */
static void scatter_matrix(drogue_wide scatter[6][6], drogue_s128 s[5][5], int swap)
{
    int i;
    int j;
    for (i = 0; i < 6; i++) {
        for (j = 0; j <= i; j++) {
            int p = power_x[i] + power_x[j];
            int q = power_y[i] + power_y[j];
            scatter[i][j] = drogue_wide_from_s128(swap ? s[q][p] : s[p][q], 0);
        }
    }
}

/* Eliminate 1, x, y: leaves the multipliers in columns 0..2 and the reduced scatter matrix in rows 3..5. */
static drogue_status eliminate_linear_part(drogue_wide scatter[6][6])
{
    drogue_wide column[6];
    int k;
    int i;
    int j;
    for (k = 0; k < 3; k++) {
        drogue_wide least = drogue_wide_scale(scatter[1][1], -PIVOT_BITS); /* x has the larger spread */
        drogue_wide pivot = scatter[k][k];
        if (drogue_wide_cmp(pivot, least) <= 0 && k > 0) {
            return DROGUE_E_DEGENERATE;
        }
        for (i = k + 1; i < 6; i++) {
            column[i] = scatter[i][k];
            scatter[i][k] = drogue_wide_div(column[i], pivot);
            for (j = k + 1; j <= i; j++) {
                scatter[i][j] = drogue_wide_sub(scatter[i][j], drogue_wide_mul(scatter[i][k], column[j]));
            }
        }
    }
    return DROGUE_OK;
}

/* Cholesky factor of the reduced scatter matrix, inverted: lower triangle h with h M h' = 1. Pivots are judged against
 * 'spread', the diagonal before the reduction; 'singular' tells that the last one vanished. */
static drogue_status inverse_cholesky(drogue_wide h[3][3], int *singular, drogue_wide scatter[6][6],
                                      const drogue_wide spread[3])
{
    const drogue_wide one = drogue_wide_from_s64(1, 0);
    drogue_wide g[3][3];
    int i;
    int j;
    int k;
    for (i = 0; i < 3; i++) {
        for (j = 0; j <= i; j++) {
            drogue_wide sum = scatter[3 + i][3 + j];
            for (k = 0; k < j; k++) {
                sum = drogue_wide_sub(sum, drogue_wide_mul(g[i][k], g[j][k]));
            }
            if (i == j) {
                drogue_wide least = drogue_wide_scale(spread[i], i < 2 ? -PIVOT_BITS : -FLOOR_BITS);
                if (least.mantissa <= 0 || (i < 2 && drogue_wide_cmp(sum, least) <= 0)) {
                    return DROGUE_E_DEGENERATE; /* more than one conic through the points, or one that is no ellipse */
                }
                *singular = drogue_wide_cmp(sum, least) < 0;
                g[i][i] = drogue_wide_sqrt(*singular ? least : sum);
                h[i][i] = drogue_wide_div(one, g[i][i]);
            } else {
                g[i][j] = drogue_wide_mul(sum, h[j][j]);
            }
        }
    }
    h[1][0] = drogue_wide_neg(drogue_wide_mul(g[1][0], drogue_wide_mul(h[0][0], h[1][1])));
    h[2][1] = drogue_wide_neg(drogue_wide_mul(g[2][1], drogue_wide_mul(h[1][1], h[2][2])));
    h[2][0] = drogue_wide_mul(drogue_wide_sub(drogue_wide_mul(g[1][0], drogue_wide_mul(g[2][1], h[1][1])), g[2][0]),
                              drogue_wide_mul(h[0][0], h[2][2]));
    return DROGUE_OK;
}

/* Conic A x^2 + B xy + C y^2 + D x + E y + F with 4AC - B^2 > 0 that minimises the algebraic error. */
typedef struct conic {
    drogue_wide a, b, c, d, e, f;
} conic;

/* The quadratic part: largest eigenvalue of h K h', K the constraint 4AC - B^2 as a matrix. */
static drogue_status solve_quadratic_part(drogue_wide theta[6], drogue_wide h[3][3], int singular)
{
    drogue_wide n[6];
    drogue_wide v[3];
    drogue_sym3 matrix;
    drogue_eigen3 eigen;
    int k;
    n[0] = drogue_wide_from_s64(0, 0);
    n[1] = n[0];
    n[2] = drogue_wide_scale(drogue_wide_mul(h[0][0], h[2][2]), 1);
    n[3] = drogue_wide_neg(drogue_wide_mul(h[1][1], h[1][1]));
    n[4] = drogue_wide_sub(drogue_wide_scale(drogue_wide_mul(h[1][0], h[2][2]), 1), drogue_wide_mul(h[1][1], h[2][1]));
    n[5] = drogue_wide_sub(drogue_wide_scale(drogue_wide_mul(h[2][0], h[2][2]), 2), drogue_wide_mul(h[2][1], h[2][1]));
    (void)drogue_sym3_normalise(&matrix, n);
    (void)drogue_eigen_sym3(&eigen, &matrix);
    if (eigen.value[0] <= 0 || (singular && -eigen.value[2] >= eigen.value[0] >> 8)) {
        return DROGUE_E_DEGENERATE; /* the conic that the points lie on is no ellipse */
    }
    for (k = 0; k < 3; k++) {
        v[k] = drogue_wide_from_s64(eigen.vector_q60[0][k], -DROGUE_EIGEN_FRAC);
    }
    theta[3] = drogue_wide_add(drogue_wide_mul(h[0][0], v[0]),
                               drogue_wide_add(drogue_wide_mul(h[1][0], v[1]), drogue_wide_mul(h[2][0], v[2])));
    theta[4] = drogue_wide_add(drogue_wide_mul(h[1][1], v[1]), drogue_wide_mul(h[2][1], v[2]));
    theta[5] = drogue_wide_mul(h[2][2], v[2]);
    return DROGUE_OK;
}

/* Value of a length or coordinate in Q16; 0 return when it leaves the format. */
static int fits_q16(drogue_q16 *out, drogue_wide v)
{
    int64_t q = drogue_wide_to_s64(v, 16);
    *out = (drogue_q16)drogue_sat_s32(q);
    return *out == q;
}

/* Centre, semi-axes and angle of a conic about (cx, cy); its unit is 2^-frac_bits px. */
static drogue_status ellipse_of_conic(drogue_ellipse *out, const conic *q, int64_t cx, int64_t cy, int frac_bits)
{
    drogue_wide trace = drogue_wide_add(q->a, q->c);
    drogue_wide difference = drogue_wide_sub(q->c, q->a);
    drogue_wide det = drogue_wide_sub(drogue_wide_scale(drogue_wide_mul(q->a, q->c), 2), drogue_wide_mul(q->b, q->b));
    drogue_wide x;
    drogue_wide y;
    drogue_wide f;
    drogue_wide larger; /* twice the larger eigenvalue of the quadratic part */
    int32_t angle_q29;
    int ok = 1;
    if (det.mantissa <= 0 || trace.mantissa <= 0) {
        return DROGUE_E_DEGENERATE;
    }
    x = drogue_wide_div(drogue_wide_sub(drogue_wide_mul(q->b, q->e), drogue_wide_scale(drogue_wide_mul(q->c, q->d), 1)),
                        det);
    y = drogue_wide_div(drogue_wide_sub(drogue_wide_mul(q->b, q->d), drogue_wide_scale(drogue_wide_mul(q->a, q->e), 1)),
                        det);
    /* minus the conic's value at its centre, doubled */
    f = drogue_wide_neg(drogue_wide_add(drogue_wide_scale(q->f, 1),
                                        drogue_wide_add(drogue_wide_mul(q->d, x), drogue_wide_mul(q->e, y))));
    if (f.mantissa <= 0) {
        return DROGUE_E_DEGENERATE;
    }
    larger = drogue_wide_add(
        trace, drogue_wide_sqrt(drogue_wide_add(drogue_wide_mul(difference, difference), drogue_wide_mul(q->b, q->b))));
    ok &= fits_q16(&out->xc_px_q16, drogue_wide_scale(drogue_wide_add(x, drogue_wide_from_s64(cx, 0)), -frac_bits));
    ok &= fits_q16(&out->yc_px_q16, drogue_wide_scale(drogue_wide_add(y, drogue_wide_from_s64(cy, 0)), -frac_bits));
    ok &= fits_q16(&out->b_px_q16, drogue_wide_scale(drogue_wide_sqrt(drogue_wide_div(f, larger)), -frac_bits));
    /* the smaller eigenvalue is det / (4 * the larger): no cancellation */
    ok &= fits_q16(&out->a_px_q16,
                   drogue_wide_scale(drogue_wide_sqrt(drogue_wide_div(drogue_wide_mul(f, larger), det)), -frac_bits));
    angle_q29 = drogue_wide_atan2_q29(drogue_wide_neg(q->b), difference);
    out->angle_rad_q16 = (drogue_q16)drogue_shr_round_s64(angle_q29, 14);
    if (out->angle_rad_q16 <= -DROGUE_Q16_HALF_PI) {
        out->angle_rad_q16 = DROGUE_Q16_HALF_PI;
    }
    if (out->a_px_q16 <= out->b_px_q16) {
        out->b_px_q16 = out->a_px_q16;
        out->angle_rad_q16 = 0; /* a circle has no angle */
    }
    return ok && out->b_px_q16 > 0 ? DROGUE_OK : DROGUE_E_DEGENERATE;
}

drogue_status drogue_ellipse_fit(drogue_ellipse *out, const drogue_moments *m, int frac_bits)
{
    drogue_s128 s[5][5];
    drogue_wide scatter[6][6];
    drogue_wide h[3][3];
    drogue_wide spread[3];
    drogue_wide theta[6];
    conic q;
    drogue_status status;
    int64_t cx;
    int64_t cy;
    int singular = 0;
    int swap;
    int k;
    int i;
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
    cx = drogue_div_round_s64(m->m10, m->n);
    cy = drogue_div_round_s64(m->m01, m->n);
    spread_moments(s, m);
    centre_moments(s, cx, cy);
    swap = drogue_s128_cmp(s[2][0], s[0][2]) < 0;
    scatter_matrix(scatter, s, swap);
    for (k = 0; k < 3; k++) {
        spread[k] = scatter[3 + k][3 + k];
    }
    status = eliminate_linear_part(scatter);
    if (status == DROGUE_OK) {
        status = inverse_cholesky(h, &singular, scatter, spread);
    }
    if (status == DROGUE_OK) {
        status = solve_quadratic_part(theta, h, singular);
    }
    if (status != DROGUE_OK) {
        return status;
    }
    for (k = 2; k >= 0; k--) { /* the linear part follows from the quadratic one */
        theta[k] = drogue_wide_from_s64(0, 0);
        for (i = k + 1; i < 6; i++) {
            theta[k] = drogue_wide_sub(theta[k], drogue_wide_mul(scatter[i][k], theta[i]));
        }
    }
    if (drogue_wide_add(theta[3], theta[5]).mantissa < 0) {
        for (k = 0; k < 6; k++) {
            theta[k] = drogue_wide_neg(theta[k]);
        }
    }
    q.a = swap ? theta[5] : theta[3];
    q.b = theta[4];
    q.c = swap ? theta[3] : theta[5];
    q.d = swap ? theta[2] : theta[1];
    q.e = swap ? theta[1] : theta[2];
    q.f = theta[0];
    return ellipse_of_conic(out, &q, cx, cy, frac_bits);
}
