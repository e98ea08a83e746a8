/* SPDX-License-Identifier: Apache-2.0 */
/* Direct least-squares fit of an ellipse (Fitzgibbon, in Halir and Flusser's form; paper (7)-(9)) from exact
 * moments, which do not depend on the order of the points. */
#ifndef DROGUE_ELLIPSE_H
#define DROGUE_ELLIPSE_H

#include "drogue/real.h"
#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_MAX_FIT_POINTS (1 << 17) /* points that one set of moments can hold */

/* A sum of up to DROGUE_MAX_FIT_POINTS 64-bit terms, high * 2^32 + low: 96 bits, carries not yet passed on. */
typedef struct drogue_long_sum {
    int64_t high; /* sum of the terms' upper 32 bits */
    uint64_t low; /* sum of their lower 32 bits */
} drogue_long_sum;

/* Sums over points of x^p y^q for p + q <= 4, exact integers; coordinates are 16-bit. m[p][q] would be sparse:
 * the members name p and q. */
typedef struct drogue_moments {
    int64_t n;                               /* points */
    int64_t m10, m01;                        /* sums of x and of y */
    int64_t m20, m11, m02;                   /* of x^2, x y, y^2 */
    int64_t m30, m21, m12, m03;              /* of third degree, from x^3 to y^3 */
    drogue_long_sum m40, m31, m22, m13, m04; /* of fourth degree, from x^4 to y^4 */
} drogue_moments;

/* Sums over no points. */
void drogue_moments_clear(drogue_moments *m);

/* Add a product of four coordinates. */
static inline void drogue_long_sum_add(drogue_long_sum *sum, int64_t product)
{
    sum->high += product >> 32;
    sum->low += (uint32_t)product;
}

/* Add a point 'times' times, 1 or -1: what was added can be taken out again. x and y in [-32768, 32767], in units of
 * the caller's choice. */
static inline void drogue_moments_count_point(drogue_moments *m, int32_t x, int32_t y, int32_t times)
{
    const int32_t xx = x * x; /* at most 2^30 */
    const int32_t xy = x * y;
    const int32_t yy = y * y;
    const int32_t own_xx = times * xx;
    const int32_t own_xy = times * xy;
    const int32_t own_yy = times * yy;
    DROGUE_NOTE("ellipse: x", x, 16);
    DROGUE_NOTE("ellipse: y", y, 16);
    m->n += times;
    m->m10 += times * x;
    m->m01 += times * y;
    m->m20 += own_xx;
    m->m11 += own_xy;
    m->m02 += own_yy;
    m->m30 += drogue_product(own_xx, x);
    m->m21 += drogue_product(own_xx, y);
    m->m12 += drogue_product(own_yy, x);
    m->m03 += drogue_product(own_yy, y);
    drogue_long_sum_add(&m->m40, drogue_product(own_xx, xx));
    drogue_long_sum_add(&m->m31, drogue_product(own_xx, xy));
    drogue_long_sum_add(&m->m22, drogue_product(own_xx, yy));
    drogue_long_sum_add(&m->m13, drogue_product(own_xy, yy));
    drogue_long_sum_add(&m->m04, drogue_product(own_yy, yy));
}

/* Add one point once. */
static inline void drogue_moments_add_point(drogue_moments *m, int32_t x, int32_t y)
{
    drogue_moments_count_point(m, x, y, 1);
}

/* Scatter matrix of the monomials 1, x, y, x^2, xy, y^2 about the points' centre, packed by rows of its lower triangle
 * (cholesky.h). From each of the last three, 'taken' times 1, x and y is taken in the exact sums. */
typedef struct drogue_scatter {
    int32_t centre[2];     /* mean of x and of y, rounded */
    drogue_real entry[21]; /* packed */
    int32_t taken[3][3];   /* of x^2, x y, y^2: times 1, x, y */
} drogue_scatter;

/* Sums of 96 bits until all that whole numbers explain has been taken, then rounded.
 *
 *  m       n >= 1
 *  return  1 when x and y have changed roles, so that x has the larger spread; not in 'centre'
 */
int drogue_moments_scatter(drogue_scatter *out, const drogue_moments *m);

/* Centre, semi-axes and angle of a conic about 'centre'; its unit is 2^-frac_bits px.
 *
 *  q       coefficients of 1, x, y, x^2, xy, y^2; those of x^2 and y^2 positive in sum
 *  return  DROGUE_OK, DROGUE_E_DEGENERATE (no ellipse, or one whose parameters leave Q16)
 */
drogue_status drogue_conic_ellipse(drogue_ellipse *out, const drogue_real q[6], const int32_t centre[2], int frac_bits);

/* Ellipse about the origin of the points S^(1/2) (cos t, sin t): its squared semi-axes are the eigenvalues of S.
 *
 *  out     zero on failure
 *  shape   entries xx, xy, yy of S, px^2
 *  return  DROGUE_OK, DROGUE_E_DEGENERATE (S is not positive, or a semi-axis leaves Q16)
 */
drogue_status drogue_shape_ellipse(drogue_ellipse *out, const drogue_real shape[3]);

/* Fit an ellipse to summed moments.
 *
 *  out        centre, semi-axes, angle of the major axis; 0 for the angle of a circle
 *  m          6 <= n <= DROGUE_MAX_FIT_POINTS
 *  frac_bits  the moments' unit is 2^-frac_bits px; [0, 15]
 *  return     DROGUE_OK, DROGUE_E_TOO_FEW_POINTS, DROGUE_E_DEGENERATE (collinear points, no ellipse, or one
 *             whose parameters leave Q16), DROGUE_E_ARGUMENT
 *  scaling    centred and freed of its linear part in 96-bit integers, then 31-bit mantissas; no overflow for any input
 *  error      <= 4 LSB for arcs of 90 degrees, <= 1 for more, against exact arithmetic on the same moments
 *  source     Halir and Flusser 1998; paper (7)-(9) with the corrections of naming and arctangent
 */
drogue_status drogue_ellipse_fit(drogue_ellipse *out, const drogue_moments *m, int frac_bits);

#ifdef __cplusplus
}
#endif
#endif
