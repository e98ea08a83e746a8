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
    drogue_outline_room *room;
    uint32_t arcs;             /* whose points are summed, as a candidate has them; 0: none */
    const drogue_arc *part[4]; /* the same in the order of their points */
    int parts;
    uint32_t looked_as; /* the bins' polarities in the last look */
} context;

static uint32_t stride_of(const context *c) { return c->list->edge_count / LOOKS + 1; }

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
    drogue_collection_of_region(&c->room->sum);
    c->arcs = arcs;
    c->parts = 0;
    for (k = 0; k < 4; k++) {
        const drogue_arc *arc = arc_of(c, arcs, k);
        if (arc != NULL) {
            for (i = c->parts++; i > 0 && c->part[i - 1]->first > arc->first; i--) {
                c->part[i] = c->part[i - 1];
            }
            c->part[i] = arc;
            drogue_collect_arc(&c->room->sum.moments, c->workspace->edges + arc->first, arc->count);
        }
    }
}

/* Which polarity the bins of these arcs' ellipse are likely to have: that of the arcs, by quadrant and direction. */
static uint32_t polarity_of_arcs(const context *c, uint32_t arcs)
{
    int32_t bright = 0;
    int k;
    for (k = 0; k < 4; k++) {
        const drogue_arc *arc = arc_of(c, arcs, k);
        if (arc != NULL) {
            bright += (uint32_t)k == arc->direction ? -(int32_t)arc->count : (int32_t)arc->count;
        }
    }
    return bright > 0 ? UINT32_MAX : 0;
}

/* Collect the edge points that belong to an ellipse, every one or every so many of them: counts by bin, residuals, and
 * moments, where all count from those of the arcs. Bins have the given polarities until they are judged by the
 * counts. */
static drogue_status collect(context *c, const drogue_ellipse *ellipse, const drogue_band *band, uint32_t bright_bins,
                             uint32_t stride)
{
    const drogue_edge *edges = c->workspace->edges;
    drogue_ellipse_frame frame;
    uint32_t at = 0;
    int k;
    drogue_status status = drogue_ellipse_frame_of(&frame, ellipse);
    if (status != DROGUE_OK) {
        return status;
    }
    memset(&c->room->support, 0, sizeof c->room->support);
    c->room->support.bright_bins = bright_bins;
    c->room->support.axis_rad_q16 = ellipse->angle_rad_q16;
    c->room->own = c->room->sum;
    if (stride > 1) {
        drogue_moments_clear(&c->room->own.moments);
    }
    for (k = 0; k < c->parts && stride == 1; k++) { /* bound: 4 */
        const drogue_arc *arc = c->part[k];
        drogue_collect_edges(&c->room->own.moments, &c->room->support, &frame, band, edges + at, arc->first - at, 1, 0);
        drogue_collect_edges(&c->room->own.moments, &c->room->support, &frame, band, edges + arc->first, arc->count, 1,
                             1);
        at = arc->first + arc->count;
    }
    drogue_collect_edges(&c->room->own.moments, &c->room->support, &frame, band, edges + at, c->list->edge_count - at,
                         stride, 0);
    drogue_support_judge(&c->room->support, ellipse, c->config->polarity, stride);
    return DROGUE_OK;
}

/* Look at every so many edge points about an ellipse: as its first round does. */
static drogue_status look(context *c, const drogue_ellipse *ellipse, uint32_t bright_bins)
{
    const drogue_band band = band_about(ellipse, c->config->search_band_q16, c->config);
    c->looked_as = bright_bins;
    return collect(c, ellipse, &band, bright_bins, stride_of(c));
}

/* Fit and score the union of arcs; 0 when it is no candidate. */
static int try_arcs(drogue_candidate *out, uint32_t arcs, context *c)
{
    drogue_ellipse_frame frame;
    drogue_quality quality;
    drogue_q16 threshold;
    drogue_q16 fit_error;
    uint32_t near_count = 0;
    int k;
    out->arcs = arcs;
    sum_arcs(c, arcs);
    if (drogue_collection_fit(&out->ellipse, &c->room->sum) != DROGUE_OK ||
        !plausible(&out->ellipse, c->mask, c->config) || drogue_ellipse_frame_of(&frame, &out->ellipse) != DROGUE_OK) {
        return 0;
    }
    fit_error = drogue_q16_mul(out->ellipse.a_px_q16, c->config->search_band_q16);
    fit_error = fit_error > c->config->quality.fit_error_px_q16 ? fit_error : c->config->quality.fit_error_px_q16;
    threshold = drogue_quality_threshold(&out->ellipse, fit_error);
    for (k = 0; k < c->parts; k++) { /* bound: 4 */
        near_count += drogue_near_count(&frame, threshold, c->workspace->edges + c->part[k]->first, c->part[k]->count);
    }
    out->fit_ratio_q16 = drogue_quality_fit_ratio(near_count, (uint32_t)c->room->sum.moments.n);
    if (out->fit_ratio_q16 < c->config->min_fit_ratio_q16) {
        return 0;
    }
    (void)look(c, &out->ellipse, polarity_of_arcs(c, arcs));
    out->cover_q16 = drogue_support_cover(&c->room->support);
    out->polarity = c->room->support.bright_bins;
    drogue_quality_of_cover(&quality, &out->ellipse, out->fit_ratio_q16, out->cover_q16, &c->config->quality);
    out->reliability_q16 = quality.reliability_q16;
    return 1;
}

/* Can an arc be fitted? More points than moments hold are noise. */
static int usable(const context *c, int k, int choice)
{
    const uint32_t index = c->choices.arc[k][choice];
    return index != DROGUE_NO_ARC && c->workspace->arcs[index].count <= DROGUE_MAX_FIT_POINTS / 4;
}

/* The first arcs of all quadrants together; unless they cover enough, all pairs of arcs from two quadrants too. Returns
 * how many candidates there are. */
static uint32_t all_candidates(context *c)
{
    drogue_candidate *candidates = c->room->candidates;
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

/* Refit on the points that belong to the outline until it settles, as often as configured; stops at the last good fit.
 * The first round takes the points that were looked at. Judges the outline by the share of its circumference that they
 * cover. */
static void refit(drogue_outline *outline, context *x)
{
    const drogue_config *config = x->config;
    drogue_band band = band_about(&outline->ellipse, config->search_band_q16, config);
    uint32_t stride = config->refit_rounds > 0 ? stride_of(x) : 1;
    uint32_t round;
    int done = 0;
    /* bound: refit_rounds + 1, at most 17 */
    for (round = 0; round <= config->refit_rounds && !done; round++) {
        drogue_ellipse ellipse;
        const drogue_q16 width = band.half_width_px_q16;
        const uint32_t bright_bins = round == 0 ? x->looked_as : outline->support.bright_bins;
        if ((round > 0 || config->refit_rounds == 0) &&
            collect(x, &outline->ellipse, &band, bright_bins, stride) != DROGUE_OK) {
            break;
        }
        outline->support = x->room->support;
        outline->band_px_q16 = width;
        if (round == config->refit_rounds) {
            if (outline->support.bright_bins != bright_bins) { /* the sums are those of the bins before */
                drogue_support_judge_as(&outline->support, &outline->ellipse, bright_bins, 1);
            }
        } else if (outline->support.bright_bins == bright_bins) {
            if (drogue_collection_fit(&ellipse, &x->room->own) == DROGUE_OK && plausible(&ellipse, x->mask, config)) {
                drogue_band_narrow(&band, &outline->support, &ellipse, config);
                done = band.half_width_px_q16 == width && stride == 1 &&
                       drogue_ellipse_settled(&ellipse, &outline->ellipse);
                outline->ellipse = ellipse;
                outline->refit_points = (uint32_t)x->room->own.moments.n;
            } else if (stride == 1) {
                break;
            }
        } /* else collect again with the polarities that the counts show */
        stride = 1;
    }
    drogue_support_turn(&outline->support, outline->ellipse.angle_rad_q16);
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
        c->looked_as = ~candidate->polarity;
    }
    if (c->looked_as != candidate->polarity) {
        (void)look(c, &candidate->ellipse, candidate->polarity);
    }
    memset(out, 0, sizeof *out);
    for (k = 0; k < 4; k++) {
        const drogue_arc *arc = arc_of(c, candidate->arcs, k);
        out->arcs[k] = arc != NULL ? (uint32_t)(arc - c->workspace->arcs) : DROGUE_NO_ARC;
    }
    drogue_quality_of_cover(&out->quality, &candidate->ellipse, candidate->fit_ratio_q16, candidate->cover_q16,
                            &c->config->quality);
    out->ellipse = candidate->ellipse;
    refit(out, c);
}

/* The most reliable candidate, refined; when that covers little, the next that differ from it, and the one of them that
 * covers most. */
static drogue_status best_outline(drogue_outline *out, uint32_t count, context *c)
{
    drogue_candidate *candidates = c->room->candidates;
    drogue_outline *trial = &c->room->trial;
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
        refine(tries == 0 ? out : trial, &chosen, c);
        if (tries == 0) {
            out->cluster_members = members;
        } else if (trial->cover_q16 > out->cover_q16) {
            *out = *trial;
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

void drogue_outline_clear(drogue_outline *outline)
{
    int k;
    memset(outline, 0, sizeof *outline);
    for (k = 0; k < 4; k++) {
        outline->arcs[k] = DROGUE_NO_ARC;
    }
}

drogue_status drogue_outline_find(drogue_outline *out, const drogue_workspace *workspace, const drogue_edge_list *list,
                                  const drogue_mask *mask, const drogue_config *config)
{
    context c;
    drogue_status status;
    drogue_outline_clear(out);
    if (list->edge_count == 0) {
        return DROGUE_E_NO_EDGES;
    }
    c.workspace = workspace;
    c.room = workspace->outline;
    c.list = list;
    c.mask = mask;
    c.config = config;
    status = drogue_select_arcs(&c.choices, workspace->hull, workspace->edges, workspace->arcs, list->arc_count, mask,
                                config->min_short_px_q16, config->polarity);
    if (status == DROGUE_OK) {
        status = best_outline(out, all_candidates(&c), &c);
        out->fitted = out->ellipse;
        if (out->ellipse.b_px_q16 > 0) {
            drogue_undo_blur(&out->ellipse, config);
        }
    }
    return status;
}

#define RINGS 14 /* about the outline, each larger than the one before by a fortieth: to 1.4 times its size */

/* Look for an outline on a ring: is enough of it covered? Negative when it is no plausible ellipse. */
static int ring_covered(const drogue_ellipse *ring, context *c)
{
    uint32_t bright_bins = 0;
    if (!plausible(ring, c->mask, c->config) || look(c, ring, bright_bins) != DROGUE_OK) {
        return -1;
    }
    if (drogue_support_cover(&c->room->support) < c->config->min_cover_q16) {
        return 0;
    }
    bright_bins = c->room->support.bright_bins;
    return c->looked_as == bright_bins || look(c, ring, bright_bins) == DROGUE_OK;
}

static void begin_rings(context *c, const drogue_workspace *workspace, const drogue_edge_list *list,
                        const drogue_mask *mask, const drogue_config *config)
{
    memset(c, 0, sizeof *c);
    c->workspace = workspace;
    c->room = workspace->outline;
    c->list = list;
    c->mask = mask;
    c->config = config;
    drogue_collection_of_region(&c->room->sum);
}

drogue_q16 drogue_outline_covered(const drogue_ellipse *ring, const drogue_workspace *workspace,
                                  const drogue_edge_list *list, const drogue_mask *mask, const drogue_config *config)
{
    context c;
    begin_rings(&c, workspace, list, mask, config);
    return plausible(ring, mask, config) && look(&c, ring, 0) == DROGUE_OK ? drogue_support_cover(&c.room->support) : 0;
}

/* As fitted and with what blur took put back. */
static void finish_ring(drogue_outline *out, const drogue_config *config)
{
    out->fitted = out->ellipse;
    drogue_undo_blur(&out->ellipse, config);
}

int drogue_outline_settle(drogue_outline *out, const drogue_ellipse *ring, const drogue_workspace *workspace,
                          const drogue_edge_list *list, const drogue_mask *mask, const drogue_config *config)
{
    context c;
    begin_rings(&c, workspace, list, mask, config);
    drogue_outline_clear(out);
    if (ring_covered(ring, &c) <= 0) {
        return 0;
    }
    out->ellipse = *ring;
    refit(out, &c);
    if (out->cover_q16 < config->min_cover_q16) {
        drogue_outline_clear(out);
        return 0;
    }
    drogue_quality_of_cover(&out->quality, &out->ellipse, DROGUE_Q16_ONE, out->cover_q16, &config->quality);
    out->cluster_members = 1;
    finish_ring(out, config);
    return 1;
}

int drogue_outline_enlarge(drogue_outline *out, const drogue_workspace *workspace, const drogue_edge_list *list,
                           const drogue_mask *mask, const drogue_config *config)
{
    drogue_ellipse ring = out->fitted;
    drogue_outline *best;
    drogue_outline *trial;
    context c;
    int k;
    begin_rings(&c, workspace, list, mask, config);
    trial = &c.room->trial;
    best = &c.room->best;
    *best = *out;
    best->cover_q16 = 0;
    for (k = 0; k < RINGS; k++) {
        int covered;
        ring.a_px_q16 = drogue_q16_add(ring.a_px_q16, ring.a_px_q16 / 40);
        ring.b_px_q16 = drogue_q16_add(ring.b_px_q16, ring.b_px_q16 / 40);
        covered = ring_covered(&ring, &c);
        if (covered < 0) {
            break;
        }
        if (!covered) {
            continue;
        }
        *trial = *out;
        trial->ellipse = ring;
        refit(trial, &c);
        if (trial->cover_q16 >= best->cover_q16 && trial->cover_q16 >= config->min_cover_q16 &&
            (int64_t)trial->ellipse.b_px_q16 * 50 > (int64_t)out->fitted.b_px_q16 * 51) {
            *best = *trial;
        }
    }
    if (best->cover_q16 == 0) {
        return 0;
    }
    *out = *best;
    finish_ring(out, config);
    return 1;
}
