/* SPDX-License-Identifier: Apache-2.0 */
/* Edge points near an ellipse, collected for a fit. */
#include "collect.h"

#include "band.h"

void drogue_collect_edges(drogue_collection *c, drogue_support *support, const drogue_ellipse_frame *frame,
                          const drogue_band *band, const drogue_edge *edges, uint32_t count,
                          const drogue_region_lens *lens)
{
    const drogue_ellipse_frame f = *frame;
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
            collect_point(&m, 1, in_unit(x, c->x_px_q16, c->frac_bits), in_unit(y, c->y_px_q16, c->frac_bits));
        }
    }
    c->moments = m;
}
