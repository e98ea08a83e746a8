/* SPDX-License-Identifier: Apache-2.0 */
/* src/outline/near.c for hardware: the same steps, but a turn of the loop takes each of them once, on one point each, so that
 * it lasts as long as the longest step and not as long as all. The steps run from the last to the first: they are
 * independent within a turn. A point that a step refuses goes on, its mark 'held' taken away: with u = v = 0 when it is
 * far off, with F = 0 when F is, so that no step overflows; n^2 may then be up to 4.5. Both loops write the steps out: a
 * function of two callers Bambu does not take in, which makes 11 states and calls of a turn instead of 6. */
#include "../../src/outline/near.h"

#include <string.h>

#include "../../src/outline/band.h"
#include "../drogue_hls.h"

typedef char indices_fit_16_bits[DROGUE_HLS_EDGES <= 65536 ? 1 : -1];

/* What a step leaves to the next. */
typedef struct station {
    uint16_t at; /* index of the edge point */
    drogue_q16 x_px_q16;
    drogue_q16 y_px_q16;
    int16_t gx;
    int16_t gy;
    uint32_t held; /* 1: belongs, as far as the steps so far can tell */
    int32_t u_q24;
    int32_t v_q24;
    int32_t f_q24;
    int32_t f_b_px_q16;
    int32_t nx_q14;
    int32_t ny_q14;
    int32_t n2_q28;
    int32_t along;
    uint32_t g2;
    uint32_t bin;
    int32_t x; /* in the fit's unit */
    int32_t y;
} station;

enum { STEPS = 8 };

/* An edge point, or none. */
static inline void read_edge(station *s, const drogue_edge *edges, uint32_t i, uint32_t count)
{
    const uint32_t at = i < count ? i : 0;
    const drogue_edge *e = &edges[at];
    s->at = (uint16_t)at;
    s->x_px_q16 = drogue_edge_x_q16(e);
    s->y_px_q16 = drogue_edge_y_q16(e);
    s->gx = e->gx;
    s->gy = e->gy;
    s->held = i < count;
}

static inline void step_place(station *s, const drogue_ellipse_frame *frame)
{
    int64_t u_q46;
    int64_t v_q46;
    int near;
    offsets(&u_q46, &v_q46, frame, s->x_px_q16, s->y_px_q16);
    near = !(far_off(u_q46) | far_off(v_q46));
    s->held &= (uint32_t)near;
    s->u_q24 = q24_of_q46(u_q46) & -near; /* masks: Bambu makes branches of two choices by one condition */
    s->v_q24 = q24_of_q46(v_q46) & -near;
}

static inline void step_shape(station *s, const drogue_ellipse_frame *frame)
{
    const int32_t f_q24 = form_q24(s->u_q24, s->v_q24);
    const int near = !far_form(f_q24);
    s->held &= (uint32_t)near;
    s->f_q24 = f_q24 & -near;
    normal_of(&s->nx_q14, &s->ny_q14, frame, s->u_q24, s->v_q24);
    s->g2 = gradient_square(s->gx, s->gy);
}

static inline void step_project(station *s, const drogue_ellipse_frame *frame)
{
    s->f_b_px_q16 = form_px_q16(frame, s->f_q24);
    s->n2_q28 = square_sum(s->nx_q14, s->ny_q14);
    s->along = along_of(s->gx, s->gy, s->nx_q14, s->ny_q14);
    s->bin = bin_of(s->u_q24, s->v_q24);
}

static inline void step_judge(station *s, const drogue_band *band)
{
    s->held &= (uint32_t)in_reach(band, s->f_b_px_q16) & (uint32_t)within_band(band, s->f_b_px_q16, s->n2_q28) &
               (uint32_t)aligned(band, s->along, s->g2, s->n2_q28);
}

uint32_t drogue_near_count(const drogue_ellipse_frame *frame, drogue_q16 threshold, const drogue_edge *edges,
                           uint32_t count)
{
    const drogue_ellipse_frame f = *frame; /* apart: in registers */
    station read = {0};
    station placed = {0};
    uint32_t near_count = 0;
    uint32_t i;
    for (i = 0; i < count + 2; i++) { /* bound: points of an arc and steps */
#ifndef __BAMBU__
#pragma HLS pipeline II = 2
#pragma HLS loop_tripcount max = DROGUE_HLS_EDGES
#endif
        near_count += placed.held & (uint32_t)(off_ellipse(placed.u_q24, placed.v_q24) < threshold);
        placed = read;
        frame_point(&placed.u_q24, &placed.v_q24, &f, read.x_px_q16, read.y_px_q16);
        read_edge(&read, edges, i, count);
    }
    return near_count;
}

void drogue_support_count(drogue_support *out, const drogue_ellipse_frame *frame, const drogue_band *band,
                          const drogue_edge *edges, uint32_t edge_count, uint32_t stride)
{
    const drogue_ellipse_frame f = *frame; /* apart: in registers */
    const drogue_band b = *band;
    station read = {0};
    station placed = {0};
    station shaped = {0};
    station projected = {0};
    station judged = {0};
    station fresh = {0};
    uint32_t i;
    memset(out, 0, sizeof *out);
    for (i = 0; i < edge_count + 5 * stride; i += stride) { /* bound: edge points and steps, by stride, [1, 2^24] */
#ifndef __BAMBU__
#pragma HLS pipeline II = 2
#pragma HLS loop_tripcount max = DROGUE_HLS_EDGES
#endif
        read_edge(&fresh, edges, i, edge_count); /* before what is written: compilers keep that order */
        out->bin[judged.bin].count[polarity_of(judged.along)] += judged.held;
        judged = projected;
        step_judge(&judged, &b);
        projected = shaped;
        step_project(&projected, &f);
        shaped = placed;
        step_shape(&shaped, &f);
        placed = read;
        step_place(&placed, &f);
        read = fresh;
    }
}

/* The lens undone for these edge points, which takes too long for a step. */
static void collect_undistorted(drogue_collection *c, const drogue_edge *edges, const uint16_t *own, uint32_t count,
                                const drogue_region_lens *lens)
{
    uint32_t i;
    for (i = 0; i < count; i++) { /* bound: edge points */
        drogue_q16 x = drogue_edge_x_q16(&edges[own[i]]);
        drogue_q16 y = drogue_edge_y_q16(&edges[own[i]]);
        if (undistort_edge(&x, &y, lens)) {
            collect_point(&c->moments, 1, in_unit(x, c->x_px_q16, c->frac_bits), in_unit(y, c->y_px_q16, c->frac_bits));
        }
    }
}

void drogue_collect_edges(drogue_collection *c, drogue_support *support, const drogue_ellipse_frame *frame,
                          const drogue_band *band, const drogue_edge *edges, uint32_t count,
                          const drogue_region_lens *lens)
{
    static uint16_t own[DROGUE_HLS_EDGES + 1]; /* which points were added to the support */
    const drogue_ellipse_frame f = *frame;     /* apart, and so on: in registers */
    const drogue_band b = *band;
    const drogue_q16 x_px_q16 = c->x_px_q16;
    const drogue_q16 y_px_q16 = c->y_px_q16;
    const int frac_bits = c->frac_bits;
    const uint32_t bright_bins = support->bright_bins;
    const uint32_t at_once = lens == NULL;
    drogue_moments m = c->moments;
    support_sums sums = sums_of(support);
    station read = {0};
    station placed = {0};
    station shaped = {0};
    station projected = {0};
    station judged = {0};
    station added = {0};
    station scaled = {0};
    station fresh = {0};
    uint32_t own_count = 0;
    uint32_t i;
    for (i = 0; i < count + STEPS - 1; i++) { /* bound: edge points and steps */
#ifndef __BAMBU__
#pragma HLS pipeline II = 2
#pragma HLS loop_tripcount max = DROGUE_HLS_EDGES
#endif
        read_edge(&fresh, edges, i, count); /* before what is written: compilers keep that order */
        collect_point(&m, scaled.held & at_once, scaled.x, scaled.y);
        scaled = added;
        scaled.x = in_unit(added.x_px_q16, x_px_q16, frac_bits);
        scaled.y = in_unit(added.y_px_q16, y_px_q16, frac_bits);
        added = judged;
        added.held = add_to_support(&support->bin[judged.bin], &sums, judged.held, (bright_bins >> judged.bin) & 1u,
                                    judged.f_q24, polarity_of(judged.along), judged.gx, judged.gy);
        own[own_count] = judged.at;
        own_count += added.held;
        judged = projected;
        step_judge(&judged, &b);
        projected = shaped;
        step_project(&projected, &f);
        shaped = placed;
        step_shape(&shaped, &f);
        placed = read;
        step_place(&placed, &f);
        read = fresh;
    }
    c->moments = m;
    put_sums(support, &sums);
    if (lens != NULL) {
        collect_undistorted(c, edges, own, own_count, lens);
    }
}
