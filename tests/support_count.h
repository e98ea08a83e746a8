/* SPDX-License-Identifier: Apache-2.0 */
/* Every stride-th edge point that belongs to an ellipse counted by bin and polarity, with the library's functions for one
 * point. */
#ifndef SUPPORT_COUNT_H
#define SUPPORT_COUNT_H

#include <string.h>

#include "drogue/support.h"

static inline void support_count(drogue_support *out, const drogue_ellipse_frame *frame, const drogue_band *band,
                                 const drogue_edge *edges, uint32_t edge_count, uint32_t stride)
{
    uint32_t i;
    memset(out, 0, sizeof *out);
    for (i = 0; i < edge_count; i += stride) {
        drogue_band_point p;
        if (drogue_ellipse_band_holds(&p, frame, band, drogue_edge_x_q16(&edges[i]), drogue_edge_y_q16(&edges[i]),
                                      edges[i].gx, edges[i].gy)) {
            out->bin[drogue_support_bin_of(p.u_q14, p.v_q14)].count[p.polarity]++;
        }
    }
}

#endif
