/* SPDX-License-Identifier: Apache-2.0 */
/* The rim's outer edge. Where the rim is a band of another grey, fits take its inner edge on one side and the outer one
 * on the other, or the inner one all about: an ellipse that the drogue has nowhere, and covered nevertheless. */
#include <string.h>

#include "refit.h"

#define OUTSIDE DROGUE_Q16(1, 1)   /* px: another edge is as far outside the outline, or farther, */
#define NARROW DROGUE_Q16(3, 1)    /* to this or a twentieth of the semi-axis, */
#define WIDE DROGUE_Q16(17, 1)     /* but no more */
#define OUTER_LOOKS 192            /* edge points that are looked at */
#define OUTER_BINS 6               /* fewest that show it */
#define ALONE_ROUNDS 16            /* in which it goes by its own bins, however far they are off; and as many more, */
#define NEAR_PX DROGUE_Q16(1, 1)   /* by what is as near, that edge or the outline's own */
#define ON_IT DROGUE_Q16(6, 10)    /* px: what agrees in the end */
#define GROWN DROGUE_Q16(3, 10)    /* px: least by which it is larger */
#define COVERED DROGUE_Q16(13, 16) /* and least cover in the end: less is a shadow or a sharpening halo */

/* Edges by bins of an outline: its own, which is at 0, and another one outside. */
typedef struct outer_edge {
    drogue_q16 *at_px_q16; /* of that */
    uint32_t outer;        /* the bins that show it */
    uint32_t own;          /* the bins that the outline covers */
    uint32_t agree;        /* bins of either that agree with an ellipse, */
    uint32_t on;           /* and of them those with the outer edge */
} outer_edge;

/* Mean place of what lies outside an outline in a bin, by the points about a ring. */
static drogue_q16 mean_at(const drogue_support *support, const drogue_ellipse *ring, uint32_t k, uint32_t bright)
{
    const drogue_support_bin *bin = &support->bin[k];
    const int64_t off_q16 = drogue_div_round_s64(bin->sum_q16, bin->count[bright]); /* in semi-axes */
    const int64_t mean = (int64_t)ring->a_px_q16 + ring->b_px_q16;
    int32_t basis_q30[5];
    drogue_support_basis(basis_q30, k);
    return (drogue_q16)drogue_shr_round_s64(
        off_q16 * (mean + drogue_shr_round_s64(((int64_t)ring->a_px_q16 - ring->b_px_q16) * basis_q30[3], 30)), 17);
}

/* What lies outside the outline, in bins where it covers an ellipse of that size; 0 when it does in too few. */
static int look_outside(outer_edge *edge, const drogue_outline *outline, drogue_refit_context *c)
{
    const drogue_q16 reach = drogue_clamp_s32(outline->ellipse.a_px_q16 / 20, NARROW, WIDE);
    const drogue_q16 middle = (reach + OUTSIDE) / 2;
    const drogue_support *support = &c->room->support;
    drogue_ellipse ring = outline->ellipse;
    uint32_t bright;
    uint32_t k;
    ring.a_px_q16 = drogue_q16_add(ring.a_px_q16, middle);
    ring.b_px_q16 = drogue_q16_add(ring.b_px_q16, middle);
    c->band_px_q16 = middle - OUTSIDE;
    c->looks = OUTER_LOOKS;
    if (drogue_refit_look(c, &ring, 0) != DROGUE_OK) {
        return 0;
    }
    bright = drogue_support_majority(support);
    edge->outer = drogue_support_covered_bins(support, &ring, bright, drogue_refit_stride(c));
    if (drogue_support_count(edge->outer) < OUTER_BINS) {
        return 0;
    }
    edge->own = drogue_support_covered_bins(&outline->support, &outline->ellipse, outline->support.bright_bins, 1);
    if (bright != 0) {
        (void)drogue_refit_look(c, &ring, bright); /* for the offsets of these points */
    }
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        edge->at_px_q16[k] = edge->outer >> k & 1u ? middle + mean_at(support, &ring, k, bright >> k & 1u) : 0;
    }
    return 1;
}

/* Where an ellipse that is larger by v[0] and shifted by v[1] and v[2] along the axes passes a bin. */
static drogue_q16 at_bin(const drogue_q16 v_px_q16[3], const int32_t basis_q30[5])
{
    return v_px_q16[0] + (drogue_q16)drogue_shr_round_s64(
                             drogue_product(v_px_q16[1], basis_q30[1]) + drogue_product(v_px_q16[2], basis_q30[2]), 30);
}

/* Once nearer to least squares over the bins: those where no edge agrees have it where the ellipse is. */
static void step(drogue_q16 v_px_q16[3], outer_edge *edge, uint32_t own, drogue_q16 within_px_q16)
{
    int64_t sum_q46[3] = {0, 0, 0};
    uint32_t k;
    edge->agree = 0;
    edge->on = 0;
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        const uint32_t outer = edge->outer >> k & 1u;
        int32_t basis_q30[5];
        drogue_q16 at;
        drogue_q16 off; /* of the nearer edge */
        int i;
        drogue_support_basis(basis_q30, k);
        at = at_bin(v_px_q16, basis_q30);
        off = outer ? edge->at_px_q16[k] - at : DROGUE_Q16_MAX;
        if ((own >> k & 1u) && (at < 0 ? -at : at) < (off < 0 ? -off : off)) {
            off = -at;
        }
        if ((off < 0 ? -off : off) < within_px_q16) {
            at += off;
            edge->agree++;
            edge->on += at != 0;
        }
        for (i = 0; i < 3; i++) {
            sum_q46[i] += drogue_product(at, basis_q30[i]);
        }
    }
    v_px_q16[0] = (drogue_q16)drogue_shr_round_s64(sum_q46[0], 35);
    v_px_q16[1] = (drogue_q16)drogue_shr_round_s64(sum_q46[1], 34);
    v_px_q16[2] = (drogue_q16)drogue_shr_round_s64(sum_q46[2], 34);
}

/* Is there an ellipse that is larger than the outline, on which most edges lie, some of them outside? */
static int larger_ellipse(drogue_q16 v_px_q16[3], outer_edge *edge)
{
    drogue_q16 last[3];
    int64_t sum = 0;
    int round;
    int k;
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        sum += edge->at_px_q16[k];
    }
    v_px_q16[0] = (drogue_q16)(sum / drogue_support_count(edge->outer));
    v_px_q16[1] = v_px_q16[2] = 0;
    for (round = 0; round < 2 * ALONE_ROUNDS; round++) {
        const int alone = round < ALONE_ROUNDS;
        step(v_px_q16, edge, alone ? 0 : edge->own, alone ? DROGUE_Q16_MAX : NEAR_PX);
    }
    memcpy(last, v_px_q16, sizeof last);
    step(last, edge, edge->own, ON_IT);
    return edge->on >= OUTER_BINS && 10 * edge->agree >= 6 * drogue_support_count(edge->outer | edge->own) &&
           v_px_q16[0] >= GROWN;
}

void drogue_outline_outer(drogue_outline *outline, drogue_refit_context *c)
{
    drogue_outline *trial = &c->room->trial;
    drogue_ellipse *ring = &trial->ellipse;
    outer_edge edge;
    drogue_q16 v_px_q16[3];
    drogue_refit_begin(c, c->workspace, c->list, c->mask, c->config);
    edge.at_px_q16 = c->room->outer_px_q16;
    if (!look_outside(&edge, outline, c) || !larger_ellipse(v_px_q16, &edge)) {
        return;
    }
    *trial = *outline;
    drogue_ellipse_shift(ring, v_px_q16[1], v_px_q16[2]);
    ring->a_px_q16 = drogue_q16_add(ring->a_px_q16, v_px_q16[0]);
    ring->b_px_q16 = drogue_q16_add(ring->b_px_q16, v_px_q16[0]);
    drogue_refit_begin(c, c->workspace, c->list, c->mask, c->config);
    c->band_px_q16 = c->config->refit_band_px_q16;
    if (drogue_refit_covers(ring, c) <= 0) {
        return;
    }
    drogue_refit(trial, c);
    if (trial->cover_q16 >= COVERED && trial->cover_q16 >= c->config->min_cover_q16 &&
        (int64_t)ring->a_px_q16 + ring->b_px_q16 >= (int64_t)outline->ellipse.a_px_q16 + outline->ellipse.b_px_q16 +
                                                        v_px_q16[0]) { /* else back to the inner one */
        *outline = *trial;
    }
}
