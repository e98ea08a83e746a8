/* SPDX-License-Identifier: Apache-2.0 */
/* The outline's steps for one edge point (src/outline/band.h) as functions. */
#ifndef BAND_POINTS_H
#define BAND_POINTS_H

#include <string.h>

#include "../src/outline/band.h"

static inline int place_holds(band_point *out, const drogue_ellipse_frame *frame, const drogue_band *band,
                              drogue_q16 x_px_q16, drogue_q16 y_px_q16, int16_t gx, int16_t gy)
{
    const band_reach reach = reach_of(frame, band);
    return band_holds(out, frame, band, &reach, x_px_q16, y_px_q16, gx, gy);
}

static inline int point_holds(band_point *out, const drogue_ellipse_frame *frame, const drogue_band *band,
                              const drogue_edge *e)
{
    return place_holds(out, frame, band, drogue_edge_x_q16(e), drogue_edge_y_q16(e), e->gx, e->gy);
}

static inline uint32_t point_bin(const band_point *p) { return bin_of(p->u_q14, p->v_q14); }

static inline int point_add(drogue_support *support, const band_point *p, const drogue_edge *e)
{
    const uint32_t k = point_bin(p);
    support_sums sums = sums_of(support);
    const uint32_t own = add_to_support(&support->bin[k], &sums, 1, (support->bright_bins >> k) & 1u, p->offset_q16,
                                        p->polarity, e->gx, e->gy);
    put_sums(support, &sums);
    return (int)own;
}

/* Every stride-th edge point that belongs to an ellipse, counted by bin and polarity. */
static inline void support_count(drogue_support *out, const drogue_ellipse_frame *frame, const drogue_band *band,
                                 const drogue_edge *edges, uint32_t edge_count, uint32_t stride)
{
    uint32_t i;
    memset(out, 0, sizeof *out);
    for (i = 0; i < edge_count; i += stride) {
        band_point p;
        if (point_holds(&p, frame, band, &edges[i])) {
            out->bin[point_bin(&p)].count[p.polarity]++;
        }
    }
}

#endif
