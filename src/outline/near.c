/* SPDX-License-Identifier: Apache-2.0 */
/* Edge points near an ellipse: counted, and collected for a fit. */
#include "near.h"

#include "band.h"

uint32_t drogue_near_count(const drogue_ellipse_frame *frame, drogue_q16 threshold, const drogue_edge *edges,
                           uint32_t count)
{
    const drogue_q16 most_px_q16 = drogue_q16_mul(threshold, frame->b_px_q16);
    uint32_t near_count = 0;
    uint32_t i;
    for (i = 0; i < count; i++) { /* bound: points of an arc */
        const band_place p = place_of(frame, drogue_edge_x_q16(&edges[i]), drogue_edge_y_q16(&edges[i]));
        if (!far_off(p.nx_q46) && !far_off(p.ny_q46)) {
            near_count += near_form(frame, size_q38_of(&p, q22_of_q46(p.nx_q46), q22_of_q46(p.ny_q46)), most_px_q16);
        }
    }
    return near_count;
}

#define BLOCK 4 /* points whose fourth powers 64 bits hold */

void drogue_collect_arc(drogue_moments *m, const drogue_edge *edges, uint32_t count)
{
    uint32_t i = 0;
    m->n += count;
    while (i < count) { /* bound: points of an arc */
        const uint32_t end = count - i < BLOCK ? count : i + BLOCK;
        int64_t m40 = 0;
        int64_t m31 = 0;
        int64_t m22 = 0;
        int64_t m13 = 0;
        int64_t m04 = 0;
        for (; i < end; i++) {
            const int32_t x = edges[i].x_q5 - DROGUE_MIDDLE_Q5;
            const int32_t y = edges[i].y_q5 - DROGUE_MIDDLE_Q5;
            const int32_t xx = x * x;
            const int32_t xy = x * y;
            const int32_t yy = y * y;
            m->m10 += x;
            m->m01 += y;
            m->m20 += xx;
            m->m11 += xy;
            m->m02 += yy;
            m->m30 += drogue_product(xx, x);
            m->m21 += drogue_product(xx, y);
            m->m12 += drogue_product(yy, x);
            m->m03 += drogue_product(yy, y);
            m40 += drogue_product(xx, xx);
            m31 += drogue_product(xx, xy);
            m22 += drogue_product(xx, yy);
            m13 += drogue_product(xy, yy);
            m04 += drogue_product(yy, yy);
        }
        drogue_long_sum_add(&m->m40, m40);
        drogue_long_sum_add(&m->m31, m31);
        drogue_long_sum_add(&m->m22, m22);
        drogue_long_sum_add(&m->m13, m13);
        drogue_long_sum_add(&m->m04, m04);
    }
}

void drogue_collect_edges(drogue_moments *moments, drogue_support *support, const drogue_ellipse_frame *frame,
                          const drogue_band *band, const drogue_edge *edges, uint32_t count, uint32_t stride,
                          uint32_t counted)
{
    const drogue_ellipse_frame f = *frame; /* which what is written cannot alias */
    const drogue_band b = *band;
    const band_reach reach = reach_of(frame, band);
    const uint32_t bright_bins = support->bright_bins;
    support_sums sums = sums_of(support);
    uint32_t i;
    for (i = 0; i < count; i += stride) { /* bound: edge points */
        const drogue_edge *e = &edges[i];
        uint32_t own = 0;
        band_point p;
        if (band_holds(&p, &f, &b, &reach, drogue_edge_x_q16(e), drogue_edge_y_q16(e), e->gx, e->gy)) {
            const uint32_t k = bin_of(p.u_q14, p.v_q14);
            own = add_to_support(&support->bin[k], &sums, 1, (bright_bins >> k) & 1u, p.offset_q16, p.polarity, e->gx,
                                 e->gy);
        }
        if (own != counted) {
            recount_edge(moments, own, e->x_q5, e->y_q5);
        }
    }
    put_sums(support, &sums);
}

uint32_t drogue_collect_undistorted(drogue_collection *c, drogue_support *support, const drogue_ellipse_frame *frame,
                                    const drogue_band *band, const drogue_edge *edges, uint32_t count,
                                    const drogue_region_lens *lens)
{
    const uint32_t before = support->points;
    drogue_moments as_seen; /* of no use here */
    uint32_t i;
    drogue_moments_clear(&as_seen);
    for (i = 0; i < count; i++) { /* bound: edge points, each alone; the lens undone takes longer than all else */
        const uint32_t points = support->points;
        drogue_collect_edges(&as_seen, support, frame, band, &edges[i], 1, 1, 0);
        if (support->points > points) {
            drogue_q16 x = drogue_edge_x_q16(&edges[i]);
            drogue_q16 y = drogue_edge_y_q16(&edges[i]);
            if (undistort_edge(&x, &y, lens)) {
                collect_point(c, x, y);
            }
        }
    }
    return support->points - before;
}
