/* SPDX-License-Identifier: Apache-2.0 */
/* Top: the ellipse fit alone, from points. */
#include "../words.h"
#include "drogue/ellipse.h"

int32_t drogue_hls_fit(const uint32_t points[DROGUE_HLS_EDGES], uint32_t count, int32_t frac_bits, int32_t ellipse[5])
{
#ifndef __BAMBU__ /* registers; the other arrays are memory ports, which is the default */
#pragma HLS interface mode = s_axilite port = ellipse
#pragma HLS interface mode = s_axilite port = return
#endif
    drogue_moments moments;
    drogue_ellipse e;
    drogue_status status = DROGUE_E_ARGUMENT;
    uint32_t i;
    if (count <= (uint32_t)DROGUE_HLS_EDGES) {
        drogue_moments_clear(&moments);
        for (i = 0; i < count; i++) {
#ifndef __BAMBU__
#pragma HLS pipeline II = 1
#pragma HLS loop_tripcount max = DROGUE_HLS_EDGES
#endif
            drogue_moments_add_point(&moments, (int16_t)(uint16_t)(points[i] & 0xFFFFu),
                                     (int16_t)(uint16_t)(points[i] >> 16));
        }
        status = drogue_ellipse_fit(&e, &moments, frac_bits);
    }
    if (status != DROGUE_OK) {
        e.xc_px_q16 = e.yc_px_q16 = e.a_px_q16 = e.b_px_q16 = e.angle_rad_q16 = 0;
    }
    drogue_hls_pack_ellipse(ellipse, &e);
    return (int32_t)status;
}
