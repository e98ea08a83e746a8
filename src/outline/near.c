/* SPDX-License-Identifier: Apache-2.0 */
/* Edge points near an ellipse: counted, and collected for a fit. */
#include "near.h"

#include <string.h>

#include "band.h"

uint32_t drogue_near_count(const drogue_ellipse_frame *frame, drogue_q16 threshold, const drogue_edge *edges,
                           uint32_t count)
{
    uint32_t near_count = 0;
    uint32_t i;
    for (i = 0; i < count; i++) { /* bound: points of an arc */
        near_count += deviation(frame, drogue_edge_x_q16(&edges[i]), drogue_edge_y_q16(&edges[i])) < threshold;
    }
    return near_count;
}

void drogue_support_count(drogue_support *out, const drogue_ellipse_frame *frame, const drogue_band *band,
                          const drogue_edge *edges, uint32_t edge_count, uint32_t stride)
{
    const drogue_ellipse_frame f = *frame; /* apart: the counts might be part of them, for all a compiler knows */
    const drogue_band b = *band;
    uint32_t i;
    memset(out, 0, sizeof *out);
    for (i = 0; i < edge_count; i += stride) { /* bound: edge_count / stride, stride >= 1 */
        drogue_band_point p;
        if (band_holds(&p, &f, &b, drogue_edge_x_q16(&edges[i]), drogue_edge_y_q16(&edges[i]), edges[i].gx,
                       edges[i].gy)) {
            out->bin[bin_of(p.u_q24, p.v_q24)].count[p.polarity]++;
        }
    }
}

void drogue_collect_edges(drogue_collection *c, drogue_support *support, const drogue_ellipse_frame *frame,
                          const drogue_band *band, const drogue_edge *edges, uint32_t count,
                          const drogue_region_lens *lens)
{
    const drogue_ellipse_frame f = *frame; /* apart, as above */
    const drogue_band b = *band;
    drogue_moments m = c->moments;
    uint32_t i;
    for (i = 0; i < count; i++) { /* bound: edge points */
        const drogue_edge *e = &edges[i];
        drogue_q16 x = drogue_edge_x_q16(e);
        drogue_q16 y = drogue_edge_y_q16(e);
        drogue_band_point p;
        if (band_holds(&p, &f, &b, x, y, e->gx, e->gy) && drogue_support_add(support, &p, e) &&
            (lens == NULL || undistort_edge(&x, &y, lens))) {
            const int32_t u = in_unit(x, c->x_px_q16, c->frac_bits);
            DROGUE_NOTE("outline: point in the fit's unit", u, 16);
            collect_point(&m, 1, u, in_unit(y, c->y_px_q16, c->frac_bits));
        }
    }
    c->moments = m;
}
