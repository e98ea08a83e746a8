/* SPDX-License-Identifier: Apache-2.0 */
/* Edges of opposite sense beside the outline, and what they do to it.
 *
 * The two edges of a narrow band, as a far drogue's canopy between what is behind it and its wall, blur into each other:
 * where the grey changes fastest lies farther apart than the edges do. With s the standard deviation of all blur and q half
 * the distance of two equal edges, the steepest places lie at h with q = h tanh(h q / s^2). */
#include "collection.h"

#include <string.h>

#include "band.h"

#define NEAREST 14              /* sixteenths of s: half the least distance that is taken for another edge */
#define FARTHEST 32             /* sixteenths: beyond 2 s it moves next to nothing */
#define OWN_BLUR2_Q8_SMOOTH 363 /* px^2: smoothing 1, Sobel 1/3, the pixel 1/12 */
#define OWN_BLUR2_Q8 107

#define LOOKS 256 /* edge points looked at, to about twice as many */

/* (h - q) / s over h / s from 1 in steps of a sixteenth, Q8; below, the band is too narrow to say more */
static const uint8_t moved_q8[17] = {205, 120, 79, 55, 38, 27, 19, 13, 9, 7, 4, 3, 2, 1, 1, 1, 0};

/* A bin's edges: its own, and the opposite ones within and beyond. */
enum { INSIDE, OUTSIDE, OWN, SIDES = DROGUE_PULL_SIDES };

typedef drogue_pull_side side;

/* By how much equal edges at a distance move each other, px Q16. */
static int32_t moved_px_q16(int32_t half_px_q16, int32_t blur_px_q16)
{
    const int32_t at_q12 = (int32_t)drogue_div_round_s64((int64_t)half_px_q16 * (16 << 12), blur_px_q16) - (16 << 12);
    const int32_t i = at_q12 >> 12;
    int32_t share_q20 = (int32_t)moved_q8[0] << 12;
    if (i >= 16) {
        return 0;
    }
    if (i >= 0) {
        share_q20 = ((int32_t)moved_q8[i] << 12) + (moved_q8[i + 1] - moved_q8[i]) * (at_q12 & 4095);
    }
    return (int32_t)drogue_shr_round_s64((int64_t)share_q20 * blur_px_q16, 20);
}

/* Add an opposite edge to its side; with r its distance from the centre in semi-axes it is (1 - r) r b / |n| off. */
static void add_opposite(side sides[SIDES], const drogue_ellipse_frame *frame, const band_point *p, uint32_t gradient,
                         int32_t least_px_q16)
{
    const int32_t f_q24 = f_q24_of(frame, p->f_b_px_q16);
    const int32_t length_q14 = (int32_t)drogue_isqrt_u64((uint64_t)(uint32_t)p->n2_q28) + 1;
    const int32_t r_q24 = (int32_t)drogue_isqrt_u64((uint64_t)((1 << 24) + f_q24) << 24);
    const int32_t off_q24 = r_q24 < 1 << 24 ? (1 << 24) - r_q24 : r_q24 - (1 << 24);
    const int64_t scaled_q24 = drogue_shr_round_s64((int64_t)off_q24 * r_q24, 24);
    const int32_t off_px = (int32_t)drogue_div_round_s64(scaled_q24 * frame->b_px_q16, (int64_t)length_q14 << 10);
    side *s = &sides[f_q24 > 0 ? OUTSIDE : INSIDE];
    if (off_px >= least_px_q16) {
        s->off_px_q16 += off_px;
        s->off_q24 += off_q24;
        s->gradient += gradient;
        s->points++;
    }
}

static void add(side sides[SIDES], const drogue_ellipse_frame *frame, const band_point *p, const drogue_edge *e,
                int own, int32_t least_px_q16)
{
    const uint32_t gradient = (uint32_t)(e->gx < 0 ? -e->gx : e->gx) + (uint32_t)(e->gy < 0 ? -e->gy : e->gy);
    if (!own) {
        add_opposite(sides, frame, p, gradient, least_px_q16);
    } else if ((p->f_b_px_q16 < 0 ? -p->f_b_px_q16 : p->f_b_px_q16) < 2 * least_px_q16) {
        sides[OWN].gradient += gradient;
        sides[OWN].points++;
    }
}

/* By how much the opposite edges on one side push a bin's own, in semi-axes Q24: along part of the bin, in part. */
static int32_t push_q24(const side *s, const side *own, int32_t blur_px_q16)
{
    const uint32_t points = s->points < own->points ? s->points : own->points;
    int64_t ratio_q16;
    int64_t moved;
    if (points == 0) {
        return 0;
    }
    ratio_q16 = drogue_div_round_s64((int64_t)(s->gradient << 16) / s->points * own->points, (int64_t)own->gradient);
    ratio_q16 = ratio_q16 > 98304 ? 98304 : ratio_q16;
    moved = moved_px_q16((int32_t)(s->off_px_q16 / s->points / 2), blur_px_q16);
    moved = drogue_shr_round_s64(moved * ratio_q16, 16) * points / own->points;
    return (int32_t)drogue_div_round_s64(moved * s->off_q24, s->off_px_q16);
}

void drogue_outline_pull(drogue_support *support, side sides[DROGUE_SUPPORT_BINS][SIDES], const drogue_ellipse *fitted,
                         const drogue_edge *edges, uint32_t count, const drogue_config *config)
{
    const uint64_t optics2_q32 = drogue_square_sum(config->optics_blur_px_q16, 0);
    const drogue_q16 blur = (drogue_q16)drogue_isqrt_u64(
        optics2_q32 + ((uint64_t)(config->smooth ? OWN_BLUR2_Q8_SMOOTH : OWN_BLUR2_Q8) << 24));
    const int64_t wide = (int64_t)blur * FARTHEST / 8;
    const drogue_band band =
        drogue_band_of(wide > DROGUE_Q16(8, 1) ? DROGUE_Q16(8, 1) : (drogue_q16)wide, config->refit_cos_q16);
    const int32_t least = (int32_t)((int64_t)blur * NEAREST / 8);
    const uint32_t stride = count / LOOKS | 1u; /* odd: rows have their edges in pairs */
    int64_t sum_q54[5] = {0, 0, 0, 0, 0};
    drogue_ellipse_frame frame;
    band_reach reach;
    uint32_t k;
    int i;
    memset(support->pull_q24, 0, sizeof support->pull_q24);
    if (support->points == 0 || drogue_ellipse_frame_of(&frame, fitted) != DROGUE_OK) {
        return;
    }
    memset(sides, 0, DROGUE_SUPPORT_BINS * sizeof sides[0]);
    reach = reach_of(&frame, &band);
    for (k = 0; k < count; k += stride) { /* bound: LOOKS */
        const drogue_edge *e = &edges[k];
        band_point p;
        if (band_holds(&p, &frame, &band, &reach, drogue_edge_x_q16(e), drogue_edge_y_q16(e), e->gx, e->gy)) {
            const uint32_t bin = bin_of(p.u_q14, p.v_q14);
            add(sides[bin], &frame, &p, e, (uint32_t)p.polarity == ((support->bright_bins >> bin) & 1u), least);
        }
    }
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        const int64_t push = (int64_t)push_q24(&sides[k][INSIDE], &sides[k][OWN], blur) -
                             push_q24(&sides[k][OUTSIDE], &sides[k][OWN], blur);
        int64_t basis_q30[5];
        drogue_support_basis(basis_q30, k);
        for (i = 0; i < 5; i++) {
            sum_q54[i] += push * basis_q30[i];
        }
    }
    for (i = 0; i < 5; i++) {
        support->pull_q24[i] = (int32_t)drogue_shr_round_s64(sum_q54[i], i > 0 ? 34 : 35);
    }
}

void drogue_outline_put_back(drogue_ellipse *e, const int32_t pull_q24[5])
{
    const int64_t a =
        (int64_t)e->a_px_q16 - drogue_shr_round_s64((int64_t)e->a_px_q16 * (pull_q24[0] + pull_q24[3]), 24);
    const int64_t b =
        (int64_t)e->b_px_q16 - drogue_shr_round_s64((int64_t)e->b_px_q16 * (pull_q24[0] - pull_q24[3]), 24);
    const int64_t harmonic = (int64_t)e->a_px_q16 * e->b_px_q16 / ((int64_t)e->a_px_q16 + e->b_px_q16);
    const int64_t cross = -drogue_shr_round_s64(2 * harmonic * pull_q24[4], 24);
    const int64_t half = (a - b) / 2;
    const int64_t u = -drogue_shr_round_s64((int64_t)e->a_px_q16 * pull_q24[1], 24);
    const int64_t v = -drogue_shr_round_s64((int64_t)e->b_px_q16 * pull_q24[2], 24);
    const int32_t apart = (int32_t)drogue_isqrt_u64((uint64_t)(half * half + cross * cross));
    int32_t s_q30;
    int32_t c_q30;
    int64_t angle;
    if (pull_q24[0] == 0 && pull_q24[1] == 0 && pull_q24[2] == 0 && pull_q24[3] == 0 && pull_q24[4] == 0) {
        return;
    }
    drogue_sincos_q30(&s_q30, &c_q30, (int32_t)drogue_shl_s64(e->angle_rad_q16, 13));
    e->xc_px_q16 = drogue_sat_s32(e->xc_px_q16 + drogue_shr_round_s64(u * c_q30 - v * s_q30, 30));
    e->yc_px_q16 = drogue_sat_s32(e->yc_px_q16 + drogue_shr_round_s64(u * s_q30 + v * c_q30, 30));
    e->a_px_q16 = (drogue_q16)((a + b) / 2 + apart);
    e->b_px_q16 = (drogue_q16)((a + b) / 2 - apart);
    angle = e->angle_rad_q16 + drogue_shr_round_s64(drogue_atan2_q29(cross, half), 14);
    angle = angle > DROGUE_Q16_PI / 2     ? angle - DROGUE_Q16_PI
            : angle <= -DROGUE_Q16_PI / 2 ? angle + DROGUE_Q16_PI
                                          : angle;
    e->angle_rad_q16 = (drogue_q16)angle;
}
