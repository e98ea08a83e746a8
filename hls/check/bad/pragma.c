/* SPDX-License-Identifier: Apache-2.0 */
/* Bad: pragmas in Vitis's places, for every tool to see. */
#include <stdint.h>

int32_t top(const int32_t values[16]);

int32_t top(const int32_t values[16])
{
#pragma HLS interface mode = s_axilite port = return /* expect: pragma */
#pragma HLS interface mode = ap_memory port = values
    int32_t sum = 0;
    int32_t k;
    for (k = 0; k < 16; k++) {
#pragma HLS unroll /* expect: pragma */
        sum += values[k];
    }
    for (k = 0; k < 16; k++) {
#pragma HLS pipeline II = 1 /* expect: pragma */
        sum ^= values[k];
    }
#pragma HLS unroll
    for (k = 0; k < 16; k++) {
#ifndef __BAMBU__
#pragma HLS unroll
#endif
        sum += values[k];
    }
    return sum;
}
