/* SPDX-License-Identifier: Apache-2.0 */
/* The outline of the end plane from edge points and arcs (paper III-A-2, with support over all edges). */
#include "drogue/outline.h"

#include <string.h>

#include "collection.h"
#include "drogue/ellipse.h"
#include "near.h"

#define LOOKS 512                          /* a candidate is scored by so many edge points, evenly taken */
#define TRIES 3                            /* candidates refined before the best of them is taken */
#define GOOD_COVER_Q16 DROGUE_Q16(3, 4)    /* no further try */
#define ENOUGH_COVER_Q16 DROGUE_Q16(9, 10) /* no further candidate */
#define SETTLED_Q16 DROGUE_Q16(1, 64)      /* px: an ellipse that a refit moves by less has settled */

static int plausible(const drogue_ellipse *e, const drogue_mask *mask, const drogue_config *config)
{
    int64_t a = e->a_px_q16;
    return drogue_round_enough(e, config) && a >= (int64_t)config->min_size_q16 * mask->longest_px &&
           a <= (int64_t)config->max_size_q16 * mask->longest_px;
}

/* Band about an ellipse: the configured one, or a share of the semi-axis where that is wider. */
static drogue_band band_about(const drogue_ellipse *e, drogue_q16 share_q16, const drogue_config *config)
{
    const drogue_q16 wide = drogue_q16_mul(e->a_px_q16, share_q16);
    const drogue_q16 most = DROGUE_Q16(8, 1);
    return drogue_band_of(config->refit_band_px_q16 > wide ? config->refit_band_px_q16
                          : wide > most                    ? most
                                                           : wide,
                          config->refit_cos_q16);
}

/* Everything that a candidate is made of and scored with. */
typedef struct context {
    const drogue_workspace *workspace;
    const drogue_edge_list *list;
    const drogue_mask *mask;
    const drogue_config *config;
    drogue_arc_choices choices;
    drogue_collection sum;     /* of the points of these arcs, about the middle of the largest region */
    uint32_t arcs;             /* as a candidate has them; 0: none */
    const drogue_arc *part[4]; /* the same in the order of their points */
    int parts;
} context;

/* Arc of quadrant k in a candidate: choice number arcs >> 4 k, less one; NULL when it has none there. */
static const drogue_arc *arc_of(const context *c, uint32_t arcs, int k)
{
    const uint32_t choice = (arcs >> (4 * k)) & 15u;
    return choice != 0 ? &c->workspace->arcs[c->choices.arc[k][choice - 1]] : NULL;
}

/* Sum the points of arcs. */
static void sum_arcs(context *c, uint32_t arcs)
{
    int k;
    int i;
    drogue_collection_of_region(&c->sum);
    c->arcs = arcs;
    c->parts = 0;
    for (k = 0; k < 4; k++) {
        const drogue_arc *arc = arc_of(c, arcs, k);
        if (arc != NULL) {
            for (i = c->parts++; i > 0 && c->part[i - 1]->first > arc->first; i--) {
                c->part[i] = c->part[i - 1];
            }
            c->part[i] = arc;
            drogue_collect_arc(&c->sum.moments, c->workspace->edges + arc->first, arc->count);
        }
    }
}

/* Fit and score the union of arcs; 0 when it is no candidate. */
static int try_arcs(drogue_candidate *out, uint32_t arcs, context *c)
{
    const uint32_t stride = c->list->edge_count / LOOKS + 1;
    drogue_ellipse_frame frame;
    drogue_quality quality;
    drogue_support support;
    drogue_band band;
    drogue_q16 threshold;
    drogue_q16 fit_error;
    uint32_t near_count = 0;
    int k;
    out->arcs = arcs;
    sum_arcs(c, arcs);
    if (drogue_collection_fit(&out->ellipse, &c->sum) != DROGUE_OK || !plausible(&out->ellipse, c->mask, c->config) ||
        drogue_ellipse_frame_of(&frame, &out->ellipse) != DROGUE_OK) {
        return 0;
    }
    band = band_about(&out->ellipse, c->config->search_band_q16, c->config);
    fit_error = drogue_q16_mul(out->ellipse.a_px_q16, c->config->search_band_q16);
    fit_error = fit_error > c->config->quality.fit_error_px_q16 ? fit_error : c->config->quality.fit_error_px_q16;
    threshold = drogue_quality_threshold(&out->ellipse, fit_error);
    for (k = 0; k < c->parts; k++) {
        near_count +=
            drogue_near_count(&frame, threshold, c->workspace->edges + c->part[k]->first, c->part[k]->count);
    }
    drogue_support_count(&support, &frame, &band, c->workspace->edges, c->list->edge_count, stride);
    drogue_support_judge(&support, &out->ellipse, c->config->polarity, stride);
    drogue_quality_of_cover(&quality, &out->ellipse, near_count, (uint32_t)c->sum.moments.n, drogue_support_cover(&support),
                            &c->config->quality);
    out->reliability_q16 = quality.reliability_q16;
    out->fit_ratio_q16 = quality.fit_ratio_q16;
    out->cover_q16 = quality.length_ratio_q16;
    out->polarity = support.bright_bins;
    return quality.fit_ratio_q16 >= c->config->min_fit_ratio_q16;
}

/* Can an arc be fitted? More points than moments hold are noise. */
static int usable(const context *c, int k, int choice)
{
    const uint32_t index = c->choices.arc[k][choice];
    return index != DROGUE_NO_ARC && c->workspace->arcs[index].count <= DROGUE_MAX_FIT_POINTS / 4;
}

/* The first arcs of all quadrants together; unless they cover enough, all pairs of arcs from two quadrants too. Returns
 * how many candidates there are. */
static uint32_t all_candidates(drogue_candidate candidates[DROGUE_MAX_CANDIDATES], context *c)
{
    uint32_t arcs = 0;
    uint32_t count;
    int k;
    int l;
    int i;
    for (k = 0; k < 4; k++) {
        arcs |= (uint32_t)usable(c, k, 0) << (4 * k);
    }
    count = (uint32_t)try_arcs(&candidates[0], arcs, c);
    if (count == 1 && candidates[0].cover_q16 >= ENOUGH_COVER_Q16) {
        return 1;
    }
    for (k = 0; k < 4; k++) {
        for (l = k + 1; l < 4; l++) {
            for (i = 0; i < DROGUE_ARC_CHOICES * DROGUE_ARC_CHOICES; i++) {
                const int first = i / DROGUE_ARC_CHOICES;
                const int second = i % DROGUE_ARC_CHOICES;
                if (usable(c, k, first) && usable(c, l, second)) {
                    arcs = (uint32_t)(first + 1) << (4 * k) | (uint32_t)(second + 1) << (4 * l);
                    count += (uint32_t)try_arcs(&candidates[count], arcs, c);
                }
            }
        }
    }
    return count;
}

/* Collect the edge points that belong to an outline: counts by bin, residuals and moments, from those of the arcs. Bins have
 * the polarity that the collection before gave them. */
static drogue_status collect_outline(drogue_collection *c, drogue_support *support, const drogue_ellipse *ellipse,
                                     const drogue_band *band, const context *x)
{
    const drogue_edge *edges = x->workspace->edges;
    const uint32_t bright_bins = support->bright_bins;
    drogue_ellipse_frame frame;
    uint32_t at = 0;
    int k;
    drogue_status status = drogue_ellipse_frame_of(&frame, ellipse);
    if (status != DROGUE_OK) {
        return status;
    }
    memset(support, 0, sizeof *support);
    support->bright_bins = bright_bins;
    *c = x->sum;
    for (k = 0; k < x->parts; k++) {
        const drogue_arc *arc = x->part[k];
        drogue_collect_edges(&c->moments, support, &frame, band, edges + at, arc->first - at, 0);
        drogue_collect_edges(&c->moments, support, &frame, band, edges + arc->first, arc->count, 1);
        at = arc->first + arc->count;
    }
    drogue_collect_edges(&c->moments, support, &frame, band, edges + at, x->list->edge_count - at, 0);
    return DROGUE_OK;
}

static int settled(const drogue_ellipse *p, const drogue_ellipse *q)
{
    const int64_t d[4] = {(int64_t)p->xc_px_q16 - q->xc_px_q16, (int64_t)p->yc_px_q16 - q->yc_px_q16,
                          (int64_t)p->a_px_q16 - q->a_px_q16, (int64_t)p->b_px_q16 - q->b_px_q16};
    int k;
    for (k = 0; k < 4; k++) {
        if (d[k] > SETTLED_Q16 || d[k] < -SETTLED_Q16) {
            return 0;
        }
    }
    return 1;
}

/* Band for the next round: three times the spread of the points about the ellipse, from a third of the configured width
 * to the last one: what stands out of the outline, as a hose or a fitting behind the rim, drops out. */
static void narrow(drogue_band *band, const drogue_support *support, const drogue_ellipse *e,
                   const drogue_config *config)
{
    const int64_t variance_q32 = support->points > 0 ? support->squares_q32 / (int64_t)support->points : 0;
    const int64_t spread_px_q16 =
        drogue_shr_round_s64(3 * (int64_t)drogue_isqrt_u64((uint64_t)variance_q32) * e->a_px_q16, 16);
    const drogue_q16 least = config->refit_band_px_q16 / 3 + 1;
    if (spread_px_q16 < band->half_width_px_q16) {
        *band = drogue_band_of(spread_px_q16 < least ? least : (drogue_q16)spread_px_q16, config->refit_cos_q16);
    }
}

/* Refit on the points that belong to the outline until it settles, as often as configured; stops at the last good fit.
 * Judges the outline by the share of its circumference that they cover. */
static void refit(drogue_outline *outline, const context *x)
{
    const drogue_config *config = x->config;
    drogue_band band = band_about(&outline->ellipse, config->search_band_q16, config);
    drogue_collection c;
    uint32_t round;
    int done = 0;
    /* bound: refit_rounds + 1, at most 17 */
    for (round = 0; round <= config->refit_rounds && !done; round++) {
        drogue_ellipse ellipse;
        const drogue_q16 width = band.half_width_px_q16;
        const uint32_t bright_bins = outline->support.bright_bins;
        if (collect_outline(&c, &outline->support, &outline->ellipse, &band, x) != DROGUE_OK) {
            return;
        }
        drogue_support_judge(&outline->support, &outline->ellipse, config->polarity, 1);
        outline->band_px_q16 = width;
        if (round == config->refit_rounds) {
            if (outline->support.bright_bins != bright_bins) { /* the sums are those of the bins before */
                drogue_support_judge_as(&outline->support, &outline->ellipse, bright_bins, 1);
            }
        } else if (outline->support.bright_bins == bright_bins) {
            if (drogue_collection_fit(&ellipse, &c) != DROGUE_OK || !plausible(&ellipse, x->mask, config)) {
                break;
            }
            narrow(&band, &outline->support, &ellipse, config);
            done = band.half_width_px_q16 == width && settled(&ellipse, &outline->ellipse);
            outline->ellipse = ellipse;
            outline->refit_points = (uint32_t)c.moments.n;
        } /* else collect again with the polarities that the counts show */
    }
    outline->cover_q16 = drogue_support_cover(&outline->support);
    outline->polarity = outline->support.bright_bins == 0            ? DROGUE_POLARITY_DARK
                        : outline->support.bright_bins == UINT32_MAX ? DROGUE_POLARITY_BRIGHT
                                                                     : DROGUE_POLARITY_BOTH;
}

/* Describe and refine a candidate. */
static void refine(drogue_outline *out, const drogue_candidate *candidate, context *c)
{
    int k;
    if (c->arcs != candidate->arcs) {
        sum_arcs(c, candidate->arcs);
    }
    memset(out, 0, sizeof *out);
    for (k = 0; k < 4; k++) {
        const drogue_arc *arc = arc_of(c, candidate->arcs, k);
        out->arcs[k] = arc != NULL ? (uint32_t)(arc - c->workspace->arcs) : DROGUE_NO_ARC;
    }
    drogue_quality_of_cover(&out->quality, &candidate->ellipse, (uint32_t)candidate->fit_ratio_q16, DROGUE_Q16_ONE,
                            candidate->cover_q16, &c->config->quality);
    out->ellipse = candidate->ellipse;
    out->support.bright_bins = candidate->polarity;
    refit(out, c);
}

/* The most reliable candidate, refined; when that covers little, the next that differ from it, and the one of them that
 * covers most. */
static drogue_status best_outline(drogue_outline *out, drogue_candidate candidates[DROGUE_MAX_CANDIDATES],
                                  uint32_t count, context *c)
{
    drogue_outline trial;
    int tries;
    for (tries = 0; tries < TRIES && out->cover_q16 < GOOD_COVER_Q16; tries++) {
        uint32_t members;
        uint32_t kept = 0;
        uint32_t i;
        const int32_t best = drogue_cluster_best(&members, candidates, count, &c->config->cluster);
        drogue_candidate chosen;
        if (best < 0) {
            break;
        }
        chosen = candidates[best];
        refine(tries == 0 ? out : &trial, &chosen, c);
        if (tries == 0) {
            out->cluster_members = members;
        } else if (trial.cover_q16 > out->cover_q16) {
            *out = trial;
            out->cluster_members = members;
        }
        for (i = 0; i < count; i++) {
            if (!drogue_same_ellipse(&candidates[i], &chosen, &c->config->cluster)) {
                candidates[kept++] = candidates[i];
            }
        }
        count = kept;
    }
    return out->ellipse.b_px_q16 > 0 && out->cover_q16 >= c->config->min_cover_q16 ? DROGUE_OK : DROGUE_E_NO_ELLIPSE;
}

drogue_status drogue_outline_find(drogue_outline *out, const drogue_workspace *workspace, const drogue_edge_list *list,
                                  const drogue_mask *mask, const drogue_config *config)
{
    drogue_candidate *candidates = workspace->candidates;
    context c;
    drogue_status status;
    int k;
    memset(out, 0, sizeof *out);
    for (k = 0; k < 4; k++) {
        out->arcs[k] = DROGUE_NO_ARC;
    }
    if (list->edge_count == 0) {
        return DROGUE_E_NO_EDGES;
    }
    c.workspace = workspace;
    c.list = list;
    c.mask = mask;
    c.config = config;
    status = drogue_select_arcs(&c.choices, workspace->hull, workspace->edges, workspace->arcs, list->arc_count, mask,
                                config->min_short_px_q16, config->polarity);
    if (status == DROGUE_OK) {
        status = best_outline(out, candidates, all_candidates(candidates, &c), &c);
        out->fitted = out->ellipse;
        if (out->ellipse.b_px_q16 > 0) {
            drogue_undo_blur(&out->ellipse, config);
        }
    }
    return status;
}

#define RINGS 14 /* about the outline, each larger than the one before by a fortieth: to 1.4 times its size */

/* Cover of a ring by every so many edge points; negative when it is no plausible ellipse. */
static drogue_q16 ring_cover(drogue_support *support, const drogue_ellipse *ring, const context *c)
{
    const uint32_t stride = c->list->edge_count / LOOKS + 1;
    const drogue_band band = band_about(ring, c->config->search_band_q16, c->config);
    drogue_ellipse_frame frame;
    if (!plausible(ring, c->mask, c->config) || drogue_ellipse_frame_of(&frame, ring) != DROGUE_OK) {
        return -1;
    }
    drogue_support_count(support, &frame, &band, c->workspace->edges, c->list->edge_count, stride);
    drogue_support_judge(support, ring, c->config->polarity, stride);
    return drogue_support_cover(support);
}

int drogue_outline_enlarge(drogue_outline *out, const drogue_workspace *workspace, const drogue_edge_list *list,
                           const drogue_mask *mask, const drogue_config *config)
{
    drogue_ellipse ring = out->fitted;
    drogue_outline best;
    context c;
    int k;
    memset(&c, 0, sizeof c);
    c.workspace = workspace;
    c.list = list;
    c.mask = mask;
    c.config = config;
    drogue_collection_of_region(&c.sum);
    best = *out;
    best.cover_q16 = 0;
    for (k = 0; k < RINGS; k++) {
        drogue_outline trial = *out;
        drogue_q16 cover_q16;
        ring.a_px_q16 = drogue_q16_add(ring.a_px_q16, ring.a_px_q16 / 40);
        ring.b_px_q16 = drogue_q16_add(ring.b_px_q16, ring.b_px_q16 / 40);
        cover_q16 = ring_cover(&trial.support, &ring, &c);
        if (cover_q16 < 0) {
            break;
        }
        if (cover_q16 < config->min_cover_q16) {
            continue;
        }
        trial.ellipse = ring;
        refit(&trial, &c);
        if (trial.cover_q16 >= best.cover_q16 && trial.cover_q16 >= config->min_cover_q16 &&
            (int64_t)trial.ellipse.b_px_q16 * 50 > (int64_t)out->fitted.b_px_q16 * 51) {
            best = trial;
        }
    }
    if (best.cover_q16 == 0) {
        return 0;
    }
    *out = best;
    out->fitted = out->ellipse;
    drogue_undo_blur(&out->ellipse, config);
    return 1;
}
