/* SPDX-License-Identifier: Apache-2.0 */
/* Top: the outline's words and the region's pixels in, the inner disc by its own edge out. The same call as
 * drogue_measure() makes; rays go through the pixels in any order, so that these lie in a memory. */
#include "../words.h"

#include <string.h>

#include "drogue/inner.h"

void drogue_hls_edge(const uint8_t pixels[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT],
                     const int32_t parameters[DROGUE_HLS_PARAMETERS], const int32_t outline[DROGUE_HLS_OUTLINE_WORDS],
                     int32_t width_px, int32_t height_px, int32_t edge[DROGUE_HLS_EDGE_WORDS])
{
#ifndef __BAMBU__ /* registers; the other arrays are memory ports, which is the default */
#pragma HLS interface mode = s_axilite port = parameters
#pragma HLS interface mode = s_axilite port = outline
#pragma HLS interface mode = s_axilite port = edge
#pragma HLS interface mode = s_axilite port = return
#endif
    const drogue_ellipse ellipse = drogue_hls_unpack_ellipse(outline + DROGUE_HLS_O_ELLIPSE);
    drogue_hls_parameters p;
    drogue_inner_expected expected;
    drogue_inner_edge found;
    static drogue_ray rays[DROGUE_RAYS];
    static uint8_t pixel_memory[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT];
    drogue_image view;
    drogue_status status = DROGUE_E_ARGUMENT;
    drogue_hls_unpack_parameters(&p, parameters);
    memset(&found, 0, sizeof found);
    expected.count = (uint32_t)outline[DROGUE_HLS_O_EXPECTED_COUNT];
    expected.disc[0] = drogue_hls_unpack_ellipse(outline + DROGUE_HLS_O_EXPECTED);
    expected.disc[1] = drogue_hls_unpack_ellipse(outline + DROGUE_HLS_O_EXPECTED + 5);
    if (expected.count <= 2 && outline[DROGUE_HLS_O_STATUS] == DROGUE_OK &&
        drogue_hls_take_pixels(&view, pixel_memory, pixels, width_px, height_px)) {
        status = drogue_inner_edge_find(&found, rays, &view, &expected, &ellipse, &p.config);
    }
    edge[DROGUE_HLS_E_STATUS] = (int32_t)status;
    drogue_hls_pack_edge_words(edge, &found);
}
