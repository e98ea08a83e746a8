/* SPDX-License-Identifier: Apache-2.0 */
/* Top: the Jacobi eigen-solver alone. */
#include "drogue/eigen.h"
#include "../words.h"

int32_t drogue_hls_eigen(const int64_t matrix[6], int64_t eigen[12])
{
#ifndef __BAMBU__ /* registers; the other arrays are memory ports, which is the default */
#pragma HLS interface mode = s_axilite port = matrix
#pragma HLS interface mode = s_axilite port = eigen
#pragma HLS interface mode = s_axilite port = return
#endif
    drogue_sym3 m;
    drogue_eigen3 e;
    int32_t sweeps;
    int i;
    for (i = 0; i < 6; i++) {
        m.a[i] = matrix[i];
    }
    sweeps = drogue_eigen_sym3(&e, &m);
    for (i = 0; i < 3; i++) {
        eigen[i] = e.value[i];
        eigen[3 + 3 * i] = e.vector_q60[i][0];
        eigen[4 + 3 * i] = e.vector_q60[i][1];
        eigen[5 + 3 * i] = e.vector_q60[i][2];
    }
    return sweeps;
}
