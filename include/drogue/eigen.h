/* SPDX-License-Identifier: Apache-2.0 */
/* Eigenvalues and eigenvectors of a symmetric 3x3 matrix by cyclic Jacobi rotations. */
#ifndef DROGUE_EIGEN_H
#define DROGUE_EIGEN_H

#include "drogue/real.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Eigenvalues and their vectors. */
typedef struct drogue_eigen3 {
    int32_t vector_q30[3][3]; /* vector_q30[k] belongs to value[k]; orthonormal, right-handed; the component of largest
                                 magnitude of vectors 0 and 1 is positive (the first of equals) */
    drogue_real value[3];     /* descending */
} drogue_eigen3;

/* Diagonalise.
 *
 *  matrix  a00 a01 a02 a11 a12 a22
 *  return  the number of sweeps done, at most 8
 *  error   eigenvalues within 2^-27 of the largest; where rows and columns are graded, as the cone's in its own frame,
 *          each within 2^-27 of itself. Vectors orthonormal to 2^-28
 */
int drogue_eigen_sym3(drogue_eigen3 *out, const drogue_real matrix[6]);

#ifdef __cplusplus
}
#endif
#endif
