/* SPDX-License-Identifier: Apache-2.0 */
/* Small symmetric positive definite systems in real numbers: the joint pose's normal equations and the tracker's gate.
 *
 * A symmetric n x n matrix is packed by rows of its lower triangle: entry (i, j), j <= i, at i (i + 1) / 2 + j. */
#ifndef DROGUE_CHOLESKY_H
#define DROGUE_CHOLESKY_H

#include "drogue/real.h"
#include "drogue/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_CHOLESKY_MAX 5 /* largest n */
#define DROGUE_PACKED_MAX 15  /* entries of a packed matrix of that size */
/* Index of entry (i, j) or (j, i) in a packed matrix. */
#define DROGUE_PACKED(i, j) ((i) >= (j) ? (i) * ((i) + 1) / 2 + (j) : (j) * ((j) + 1) / 2 + (i))

/* Factor in place: A = L L'.
 *
 *  a       in: A; out: L
 *  n       [1, DROGUE_CHOLESKY_MAX]
 *  return  DROGUE_OK; DROGUE_E_DEGENERATE when A is not positive definite to 2^-26 of its own diagonal (a undefined)
 */
drogue_status drogue_cholesky_factor(drogue_real *a, int n);

/* Solve L L' x = b in place: b becomes x. */
void drogue_cholesky_solve(drogue_real *b, const drogue_real *l, int n);

/* b' (L L')^-1 b: the squared Mahalanobis distance when L L' is b's covariance. */
void drogue_cholesky_square(drogue_real *out, const drogue_real *b, const drogue_real *l, int n);

/* Inverse of L L', packed; it may take the place of l. */
void drogue_cholesky_invert(drogue_real *inverse, const drogue_real *l, int n);

#ifdef __cplusplus
}
#endif
#endif
