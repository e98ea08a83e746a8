/* SPDX-License-Identifier: Apache-2.0 */
/* Eigenvalues and eigenvectors of a symmetric 3x3 matrix by cyclic Jacobi rotations on block-normalised mantissas. */
#ifndef DROGUE_EIGEN_H
#define DROGUE_EIGEN_H

#include "drogue/wide.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_EIGEN_FRAC 60 /* fractional bits of matrix and vectors */

/* Symmetric matrix: a00 a01 a02 a11 a12 a22, one common scale. */
typedef struct drogue_sym3 {
    int64_t a[6];
} drogue_sym3;

typedef struct drogue_eigen3 {
    int64_t value[3];         /* descending, in the matrix's scale */
    int64_t vector_q60[3][3]; /* vector_q60[k] belongs to value[k]; orthonormal, right-handed; the component of
                                 largest magnitude of vectors 0 and 1 is positive (the first of equals) */
} drogue_eigen3;

/* Diagonalise.
 *
 *  matrix   |entries| <= 2^59; for full precision normalise so that the largest is at least 2^57
 *  return   the number of sweeps done, at most 8
 *  scaling  rotations keep the Frobenius norm, at most 3 * 2^59: nothing overflows
 *  error    eigenvalues within 2^6 units of the exact ones
 */
int drogue_eigen_sym3(drogue_eigen3 *out, const drogue_sym3 *matrix);

/* Bring six wide numbers to one scale for drogue_eigen_sym3(): the largest lands in [2^58, 2^59).
 *
 *  return  e such that entry = matrix->a[i] * 2^e
 */
int32_t drogue_sym3_normalise(drogue_sym3 *matrix, const drogue_wide entries[6]);

#ifdef __cplusplus
}
#endif
#endif
