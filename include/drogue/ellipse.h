/* SPDX-License-Identifier: Apache-2.0 */
/* Direct least-squares fit of an ellipse (Fitzgibbon, in Halir and Flusser's form; paper (7)-(9)) from exact
 * moments, which do not depend on the order of the points. */
#ifndef DROGUE_ELLIPSE_H
#define DROGUE_ELLIPSE_H

#include "drogue/types.h"
#include "drogue/wide.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_MAX_FIT_POINTS (1 << 17) /* points that one set of moments can hold */

/* Sums over points of x^p y^q for p + q <= 4, exact integers; coordinates are 16-bit. m[p][q] would be sparse:
 * the members name p and q. */
typedef struct drogue_moments {
    int64_t n;
    int64_t m10, m01;
    int64_t m20, m11, m02;
    int64_t m30, m21, m12, m03;
    drogue_s128 m40, m31, m22, m13, m04;
} drogue_moments;

void drogue_moments_clear(drogue_moments *m);

/* Add a product of four coordinates. */
static inline void drogue_s128_accumulate(drogue_s128 *sum, int64_t product)
{
    const uint64_t low = sum->lo + (uint64_t)product;
    const int32_t change = (int32_t)(low < (uint64_t)product) + (int32_t)(product >> 63);
    sum->lo = low;
    if (change != 0) { /* seldom */
        sum->hi += change;
    }
}

/* Add one point; x and y in [-32768, 32767], in units of the caller's choice. */
static inline void drogue_moments_add_point(drogue_moments *m, int32_t x, int32_t y)
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
    drogue_s128_accumulate(&m->m40, (int64_t)xx * xx);
    drogue_s128_accumulate(&m->m31, (int64_t)xx * xy);
    drogue_s128_accumulate(&m->m22, (int64_t)xx * yy);
    drogue_s128_accumulate(&m->m13, (int64_t)xy * yy);
    drogue_s128_accumulate(&m->m04, (int64_t)yy * yy);
}

/* Scatter matrix of the monomials 1, x, y, x^2, xy, y^2 about the points' centre, packed by rows of its lower triangle
 * (cholesky.h); x and y have changed roles where the return value is 1, so that x has the larger spread.
 *
 *  centre  out, mean of x and of y, rounded
 *  m       n >= 1
 */
int drogue_moments_scatter(drogue_wide scatter[21], int64_t centre[2], const drogue_moments *m);

/* Centre, semi-axes and angle of a conic about 'centre'; its unit is 2^-frac_bits px.
 *
 *  q       coefficients of 1, x, y, x^2, xy, y^2; those of x^2 and y^2 positive in sum
 *  return  DROGUE_OK, DROGUE_E_DEGENERATE (no ellipse, or one whose parameters leave Q16)
 */
drogue_status drogue_conic_ellipse(drogue_ellipse *out, const drogue_wide q[6], const int64_t centre[2], int frac_bits);

/* Fit an ellipse to summed moments.
 *
 *  out        centre, semi-axes, angle of the major axis; 0 for the angle of a circle
 *  m          6 <= n <= DROGUE_MAX_FIT_POINTS
 *  frac_bits  the moments' unit is 2^-frac_bits px; [0, 15]
 *  return     DROGUE_OK, DROGUE_E_TOO_FEW_POINTS, DROGUE_E_DEGENERATE (collinear points, no ellipse, or one
 *             whose parameters leave Q16), DROGUE_E_ARGUMENT
 *  scaling    centred exactly in 128-bit integers, then 62-bit mantissas throughout; no overflow for any input
 *  error      <= 1 LSB for arcs of 90 degrees and more, against exact arithmetic on the same moments
 *  source     Halir and Flusser 1998; paper (7)-(9) with the corrections of naming and arctangent
 */
drogue_status drogue_ellipse_fit(drogue_ellipse *out, const drogue_moments *m, int frac_bits);

#ifdef __cplusplus
}
#endif
#endif
