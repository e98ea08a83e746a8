/* SPDX-License-Identifier: Apache-2.0 */
/* Top: both poses from the ellipse alone. */
#include "../words.h"

int32_t drogue_hls_cone(const int32_t ellipse[5], const int32_t camera[4], int32_t radius_m_q16, int32_t poses[16])
{
#ifndef __BAMBU__ /* registers; the other arrays are memory ports, which is the default */
#pragma HLS interface mode = s_axilite port = ellipse
#pragma HLS interface mode = s_axilite port = camera
#pragma HLS interface mode = s_axilite port = poses
#pragma HLS interface mode = s_axilite port = return
#endif
    const drogue_ellipse e = drogue_hls_unpack_ellipse(ellipse);
    drogue_camera c = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    drogue_pose both[2];
    drogue_status status;
    c.fx_px_q16 = camera[0];
    c.fy_px_q16 = camera[1];
    c.cx_px_q16 = camera[2];
    c.cy_px_q16 = camera[3];
    status = drogue_pose_from_ellipse(both, &e, &c, radius_m_q16);
    drogue_hls_pack_pose(poses, &both[0]);
    drogue_hls_pack_pose(poses + 8, &both[1]);
    return (int32_t)status;
}
