/* SPDX-License-Identifier: Apache-2.0 */
/* Front end as a block: a stream of pixels in, edge list and arc table out. No frame store. */
#ifndef DROGUE_HLS_FRONTEND_H
#define DROGUE_HLS_FRONTEND_H

#include "../drogue_hls.h"

/* Words of 'results'. */
enum {
    DROGUE_HLS_FRONTEND_STATUS = 0,     /* drogue_status and DROGUE_HLS_*_FULL */
    DROGUE_HLS_FRONTEND_EDGE_COUNT = 1, /* words in 'edges' */
    DROGUE_HLS_FRONTEND_ARC_COUNT = 2,  /* words in 'arcs' */
    DROGUE_HLS_FRONTEND_RESULTS = 3
};

/* One frame, as drogue_frontend_begin(), _row() and _end() with a workspace of DROGUE_HLS_WIDTH, _EDGES, _LABELS, _ARCS.
 *
 *  pixels      in, stream: width_px * height_px grey levels in raster order; none are taken when the status is
 *              DROGUE_E_ARGUMENT, DROGUE_E_REGION or DROGUE_E_WORKSPACE
 *  edges       out, memory: so many words of drogue_hls_pack_edge(), sorted by arc
 *  arcs        out, memory: so many words of drogue_hls_pack_arc()
 *  width_px    [1, DROGUE_HLS_WIDTH];  height_px  [1, DROGUE_HLS_HEIGHT]
 *  canny_low, canny_high, smooth, min_arc_px, use_ring, centre2_x, centre2_y, longest_px
 *              drogue_frontend_config and drogue_mask
 *  results     out, registers
 */
void drogue_hls_frontend(const uint8_t pixels[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT], uint64_t edges[DROGUE_HLS_EDGES],
                         uint64_t arcs[DROGUE_HLS_ARCS], int32_t width_px, int32_t height_px, int32_t canny_low,
                         int32_t canny_high, int32_t smooth, uint32_t min_arc_px, int32_t use_ring, int32_t centre2_x,
                         int32_t centre2_y, int32_t longest_px, uint32_t results[DROGUE_HLS_FRONTEND_RESULTS]);

#endif
