/* SPDX-License-Identifier: Apache-2.0 */
/* src/outline/near.c for hardware: the same steps, but a turn of the loop takes each of them once, on one point each, so that
 * it lasts as long as the longest step and not as long as all. The steps run from the last to the first: they are
 * independent within a turn. A point that a step refuses goes on, its mark 'held' taken away: with a normal of 0 when it is far
 * off, with F = 0 when F is, so that no step overflows. The loops write the steps out: a function of two callers Bambu does not
 * take in, which makes 11 states and calls of a turn instead of 6. */
#include "../../src/outline/near.h"

#include "../../src/outline/band.h"
#include "../drogue_hls.h"

/* What a step leaves to the next. */
typedef struct station {
    uint16_t x_q5;
    uint16_t y_q5;
    int16_t gx;
    int16_t gy;
    uint32_t there; /* 1: a point */
    uint32_t held;  /* 1: belongs, as far as the steps so far can tell */
    band_place place;
    int32_t nx; /* Q22, then Q14 */
    int32_t ny;
    int32_t f_b_px_q16;
    int32_t n2_q28;
    int32_t along;
    uint32_t g2;
    uint32_t bin;
    uint32_t own;
} station;

enum { STEPS = 7 };

/* An edge point, or none. */
static inline void read_edge(station *s, const drogue_edge *edges, uint32_t i, uint32_t count)
{
    const drogue_edge *e = &edges[i < count ? i : 0];
    s->x_q5 = e->x_q5;
    s->y_q5 = e->y_q5;
    s->gx = e->gx;
    s->gy = e->gy;
    s->there = s->held = i < count;
}

static inline void step_place(station *s, const drogue_ellipse_frame *frame)
{
    int near;
    s->place = place_of(frame, s->x_q5 * 2048, s->y_q5 * 2048);
    near = !(far_off(s->place.nx_q46) | far_off(s->place.ny_q46));
    s->held &= (uint32_t)near;
    s->nx = q22_of_q46(s->place.nx_q46) & -near; /* masks: Bambu makes branches of two choices by one condition */
    s->ny = q22_of_q46(s->place.ny_q46) & -near;
}

static inline void step_shape(station *s, const drogue_ellipse_frame *frame, const band_reach *reach)
{
    const int64_t size_q38 = size_q38_of(&s->place, s->nx, s->ny);
    const int32_t f_b_px_q16 = form_px_q16(frame, size_q38);
    const int near = (!far_size(size_q38)) & in_reach(reach, f_b_px_q16);
    s->held &= (uint32_t)near;
    s->f_b_px_q16 = f_b_px_q16 & -near;
    s->nx = q14_of_q22(s->nx);
    s->ny = q14_of_q22(s->ny);
    s->g2 = gradient_square(s->gx, s->gy);
}

static inline void step_project(station *s, const drogue_ellipse_frame *frame)
{
    s->n2_q28 = square_sum(s->nx, s->ny);
    s->along = along_of(s->gx, s->gy, s->nx, s->ny);
    s->bin = bin_of(u_q14_of(frame, s->nx, s->ny), v_q14_of(frame, s->nx, s->ny));
}

static inline void step_judge(station *s, const drogue_band *band)
{
    s->held &=
        (uint32_t)within_band(band, s->f_b_px_q16, s->n2_q28) & (uint32_t)aligned(band, s->along, s->g2, s->n2_q28);
}

uint32_t drogue_near_count(const drogue_ellipse_frame *frame, drogue_q16 threshold, const drogue_edge *edges,
                           uint32_t count)
{
    const drogue_ellipse_frame f = *frame; /* apart: in registers */
    const drogue_q16 most_px_q16 = drogue_q16_mul(threshold, f.b_px_q16);
    station read = {0};
    station placed = {0};
    uint32_t near_count = 0;
    uint32_t i;
    for (i = 0; i < count + 2; i++) { /* bound: points of an arc and steps */
#ifndef __BAMBU__
#pragma HLS pipeline II = 2
#pragma HLS loop_tripcount max = DROGUE_HLS_EDGES
#endif
        near_count += placed.held & near_form(&f, size_q38_of(&placed.place, placed.nx, placed.ny), most_px_q16);
        placed = read;
        step_place(&placed, &f);
        read_edge(&read, edges, i, count);
    }
    return near_count;
}

void drogue_collect_arc(drogue_moments *moments, const drogue_edge *edges, uint32_t count)
{
    drogue_moments m = *moments; /* in registers */
    uint32_t i;
    for (i = 0; i < count; i++) { /* bound: points of an arc */
#ifndef __BAMBU__
#pragma HLS pipeline II = 1
#pragma HLS loop_tripcount max = DROGUE_HLS_EDGES
#endif
        drogue_moments_add_point(&m, edges[i].x_q5 - DROGUE_MIDDLE_Q5, edges[i].y_q5 - DROGUE_MIDDLE_Q5);
    }
    *moments = m;
}

void drogue_collect_edges(drogue_moments *moments, drogue_support *support, const drogue_ellipse_frame *frame,
                          const drogue_band *band, const drogue_edge *edges, uint32_t count, uint32_t stride,
                          uint32_t counted)
{
    const drogue_ellipse_frame f = *frame; /* apart, and so on: in registers */
    const drogue_band b = *band;
    const band_reach reach = reach_of(frame, band);
    const uint32_t bright_bins = support->bright_bins;
    drogue_moments m = *moments;
    support_sums sums = sums_of(support);
    station read = {0};
    station placed = {0};
    station shaped = {0};
    station projected = {0};
    station judged = {0};
    station added = {0};
    station fresh = {0};
    const uint32_t end = count + (STEPS - 1) * stride;
    uint32_t i;
    added.own = counted;                /* nothing to be done */
    for (i = 0; i < end; i += stride) { /* bound: edge points and steps, by stride, [1, 2^24] */
#ifndef __BAMBU__
#pragma HLS pipeline II = 2
#pragma HLS loop_tripcount max = DROGUE_HLS_EDGES
#endif
        read_edge(&fresh, edges, i, count); /* before what is written: compilers keep that order */
        if (added.own != counted) {
            recount_edge(&m, added.own, added.x_q5, added.y_q5);
        }
        added = judged;
        added.own =
            add_to_support(&support->bin[judged.bin], &sums, judged.held, (bright_bins >> judged.bin) & 1u,
                           offset_q16_of(&f, judged.f_b_px_q16), polarity_of(judged.along), judged.gx, judged.gy);
        if (!judged.there) {
            added.own = counted;
        }
        judged = projected;
        step_judge(&judged, &b);
        projected = shaped;
        step_project(&projected, &f);
        shaped = placed;
        step_shape(&shaped, &f, &reach);
        placed = read;
        step_place(&placed, &f);
        read = fresh;
    }
    *moments = m;
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
