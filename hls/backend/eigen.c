/* SPDX-License-Identifier: Apache-2.0 */
/* Top: the Jacobi eigen-solver alone. */
#include "drogue/eigen.h"
#include "backend.h"

#pragma HLS interface port = matrix mode = ap_memory
#pragma HLS interface port = eigen mode = ap_memory
int32_t drogue_hls_eigen(const int64_t matrix[6], int64_t eigen[12])
{
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
