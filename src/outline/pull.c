/* SPDX-License-Identifier: Apache-2.0 */
/* Edges of opposite sense beside the outline, and what they do to it.
 *
 * The two edges of a narrow band, as a far drogue's canopy between what is behind it and its wall, blur into each other:
 * where the grey changes fastest lies farther apart than the edges do. With s the standard deviation of all blur and q half
 * the distance of two equal edges, the steepest places lie at h with q = h tanh(h q / s^2). */
#include "collection.h"

#include <string.h>

#include "band.h"

#define NEAREST 14            /* sixteenths of s: half the least distance that is taken for another edge */
#define FARTHEST 32           /* sixteenths: beyond 2 s it moves next to nothing */
#define OWN_BLUR2_Q8_SMOOTH 363 /* px^2: smoothing 1, Sobel 1/3, the pixel 1/12 */
#define OWN_BLUR2_Q8 107

/* (h - q) / s over h / s from 1 in steps of a sixteenth, Q8; below, the band is too narrow to say more */
static const uint8_t moved_q8[17] = {205, 120, 79, 55, 38, 27, 19, 13, 9, 7, 4, 3, 2, 1, 1, 1, 0};

/* Opposite edges of a bin on one side. */
typedef struct side {
    int64_t off_px_q16; /* sums of distances */
    int64_t form_q24;   /* the same as F */
    uint64_t gradient;
    uint32_t count;
} side;

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

/* Half-width of a point's normal, Q14, times 2^n: |n|. */
static int32_t length_q14(const drogue_ellipse_frame *frame, const drogue_band_point *p)
{
    int32_t nx;
    int32_t ny;
    normal_of(&nx, &ny, frame, p->u_q24, p->v_q24);
    return (int32_t)drogue_isqrt_u64((uint64_t)(uint32_t)square_sum(nx, ny)) + 1;
}

static void collect(side sides[DROGUE_SUPPORT_BINS][2], const drogue_support *support,
                    const drogue_ellipse_frame *frame, const drogue_band *band, int32_t least_px_q16,
                    const drogue_edge *edges, uint32_t count)
{
    uint32_t i;
    for (i = 0; i < count; i++) { /* bound: edge points */
        drogue_band_point p;
        if (band_holds(&p, frame, band, drogue_edge_x_q16(&edges[i]), drogue_edge_y_q16(&edges[i]), edges[i].gx,
                       edges[i].gy)) {
            const uint32_t k = bin_of(p.u_q24, p.v_q24);
            const int32_t form = p.f_q24 < 0 ? -p.f_q24 : p.f_q24;
            const int32_t off = (int32_t)drogue_div_round_s64((int64_t)form * frame->b_px_q16,
                                                              (int64_t)length_q14(frame, &p) << 11);
            if ((uint32_t)p.polarity != ((support->bright_bins >> k) & 1u) && off >= least_px_q16) {
                side *s = &sides[k][p.f_q24 > 0];
                s->off_px_q16 += off;
                s->form_q24 += form;
                s->gradient += (uint32_t)(edges[i].gx < 0 ? -edges[i].gx : edges[i].gx) +
                               (uint32_t)(edges[i].gy < 0 ? -edges[i].gy : edges[i].gy);
                s->count++;
            }
        }
    }
}

/* By how much the opposite edges on one side push a bin's own, as half of F Q24. */
static int32_t push_q24(const side *s, uint32_t own, uint64_t own_gradient, int32_t blur_px_q16)
{
    const uint32_t count = s->count < own ? s->count : own; /* along part of the bin: in part */
    int64_t ratio_q16;
    int64_t moved;
    if (s->count == 0) {
        return 0;
    }
    ratio_q16 = drogue_div_round_s64((int64_t)(s->gradient << 16) / s->count * own, (int64_t)own_gradient);
    ratio_q16 = ratio_q16 > 98304 ? 98304 : ratio_q16;
    moved = moved_px_q16((int32_t)(s->off_px_q16 / s->count / 2), blur_px_q16);
    moved = drogue_shr_round_s64(moved * ratio_q16, 16);
    moved = moved * count / own;
    return (int32_t)drogue_div_round_s64(moved * (s->form_q24 / 2), s->off_px_q16);
}

void drogue_outline_pull(drogue_support *support, const drogue_ellipse *fitted, const drogue_edge *edges,
                         uint32_t count, const drogue_config *config)
{
    const uint64_t optics2_q32 = drogue_square_sum(config->optics_blur_px_q16, 0);
    const drogue_q16 blur = (drogue_q16)drogue_isqrt_u64(
        optics2_q32 + ((uint64_t)(config->smooth ? OWN_BLUR2_Q8_SMOOTH : OWN_BLUR2_Q8) << 24));
    const int64_t wide = (int64_t)blur * FARTHEST / 8;
    const drogue_band band =
        drogue_band_of(wide > DROGUE_Q16(8, 1) ? DROGUE_Q16(8, 1) : (drogue_q16)wide, config->refit_cos_q16);
    side sides[DROGUE_SUPPORT_BINS][2];
    int64_t sum_q54[5] = {0, 0, 0, 0, 0};
    drogue_ellipse_frame frame;
    uint32_t k;
    int i;
    memset(support->pull_q24, 0, sizeof support->pull_q24);
    if (support->points == 0 || drogue_ellipse_frame_of(&frame, fitted) != DROGUE_OK) {
        return;
    }
    memset(sides, 0, sizeof sides);
    collect(sides, support, &frame, &band, (int32_t)((int64_t)blur * NEAREST / 8), edges, count);
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        const uint32_t own = support->bin[k].count[(support->bright_bins >> k) & 1u];
        if (own > 0) {
            const uint64_t gradient = support->gradient * own / support->points;
            const int64_t push = (int64_t)push_q24(&sides[k][0], own, gradient, blur) -
                                 push_q24(&sides[k][1], own, gradient, blur);
            int64_t basis_q30[5];
            drogue_support_basis(basis_q30, k);
            for (i = 0; i < 5; i++) {
                sum_q54[i] += push * basis_q30[i];
            }
        }
    }
    for (i = 0; i < 5; i++) {
        support->pull_q24[i] = (int32_t)drogue_shr_round_s64(sum_q54[i], i > 0 ? 34 : 35);
    }
}

void drogue_outline_put_back(drogue_ellipse *e, const int32_t pull_q24[5])
{
    const int64_t a = (int64_t)e->a_px_q16 - drogue_shr_round_s64((int64_t)e->a_px_q16 * (pull_q24[0] + pull_q24[3]), 24);
    const int64_t b = (int64_t)e->b_px_q16 - drogue_shr_round_s64((int64_t)e->b_px_q16 * (pull_q24[0] - pull_q24[3]), 24);
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
    angle = angle > DROGUE_Q16_PI / 2 ? angle - DROGUE_Q16_PI : angle <= -DROGUE_Q16_PI / 2 ? angle + DROGUE_Q16_PI : angle;
    e->angle_rad_q16 = (drogue_q16)angle;
}
