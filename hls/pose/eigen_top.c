/* SPDX-License-Identifier: Apache-2.0 */
/* Top: the Jacobi eigen-solver alone. */
#include "../words.h"
#include "drogue/eigen.h"

/* matrix: Q60; eigen: mantissa and exponent of each value, then the vectors Q30 */
int32_t drogue_hls_eigen(const int64_t matrix[6], int32_t eigen[15])
{
#ifndef __BAMBU__ /* registers; the other arrays are memory ports, which is the default */
#pragma HLS interface mode = s_axilite port = matrix
#pragma HLS interface mode = s_axilite port = eigen
#pragma HLS interface mode = s_axilite port = return
#endif
    drogue_real m[6];
    drogue_eigen3 e;
    int32_t sweeps;
    int i;
    for (i = 0; i < 6; i++) {
        drogue_real_set(&m[i], matrix[i], -60);
    }
    sweeps = drogue_eigen_sym3(&e, m);
    for (i = 0; i < 3; i++) {
        eigen[2 * i] = e.value[i].mantissa;
        eigen[2 * i + 1] = e.value[i].exponent;
        eigen[6 + 3 * i] = e.vector_q30[i][0];
        eigen[7 + 3 * i] = e.vector_q30[i][1];
        eigen[8 + 3 * i] = e.vector_q30[i][2];
    }
    return sweeps;
}
