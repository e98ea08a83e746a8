/* SPDX-License-Identifier: Apache-2.0 */
/* The outline of the end plane from edge points and arcs (paper III-A-2, with support over all edges). */
#include "drogue/outline.h"

#include <string.h>

#include "refit.h"

#define TRIES 3                            /* candidates refined before the best of them is taken */
#define GOOD_COVER_Q16 DROGUE_Q16(3, 4)    /* no further try */
#define ENOUGH_COVER_Q16 DROGUE_Q16(9, 10) /* no further candidate */

/* Arc of quadrant k in a candidate: choice number arcs >> 4 k, less one; NULL when it has none there. */
static const drogue_arc *arc_of(const drogue_refit_context *c, uint32_t arcs, int k)
{
    const uint32_t choice = (arcs >> (4 * k)) & 15u;
    return choice != 0 ? &c->workspace->arcs[c->choices.arc[k][choice - 1]] : NULL;
}

/* Sum the points of arcs. */
static void sum_arcs(drogue_refit_context *c, uint32_t arcs)
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
static uint32_t polarity_of_arcs(const drogue_refit_context *c, uint32_t arcs)
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

/* Fit and score the union of arcs; 0 when it is no candidate. */
static int try_arcs(drogue_candidate *out, uint32_t arcs, drogue_refit_context *c)
{
    drogue_ellipse_frame frame;
    drogue_quality quality;
    drogue_q16 threshold;
    drogue_q16 fit_error;
    uint32_t near_count = 0;
    int k;
    out->arcs = arcs;
    sum_arcs(c, arcs);
    if (drogue_collection_fit(&out->ellipse, &c->room->sum) != DROGUE_OK || !drogue_refit_plausible(c, &out->ellipse) ||
        drogue_ellipse_frame_of(&frame, &out->ellipse) != DROGUE_OK) {
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
    (void)drogue_refit_look(c, &out->ellipse, polarity_of_arcs(c, arcs));
    out->cover_q16 = drogue_support_cover(&c->room->support);
    out->polarity = c->room->support.bright_bins;
    drogue_quality_of_cover(&quality, &out->ellipse, out->fit_ratio_q16, out->cover_q16, &c->config->quality);
    out->reliability_q16 = quality.reliability_q16;
    return 1;
}

/* Can an arc be fitted? More points than moments hold are noise. */
static int usable(const drogue_refit_context *c, int k, int choice)
{
    const uint32_t index = c->choices.arc[k][choice];
    return index != DROGUE_NO_ARC && c->workspace->arcs[index].count <= DROGUE_MAX_FIT_POINTS / 4;
}

/* The first arcs of all quadrants together; unless they cover enough, all pairs of arcs from two quadrants too. Returns
 * how many candidates there are. */
static uint32_t all_candidates(drogue_refit_context *c)
{
    drogue_candidate *candidates = c->room->candidates;
    uint32_t arcs = 0;
    uint32_t all;
    uint32_t count;
    int k;
    int l;
    int i;
    for (k = 0; k < 4; k++) {
        arcs |= (uint32_t)usable(c, k, 0) << (4 * k);
    }
    all = arcs;
    count = (uint32_t)try_arcs(&candidates[0], all, c);
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
                    if (arcs != all) { /* of two quadrants it was the first */
                        count += (uint32_t)try_arcs(&candidates[count], arcs, c);
                    }
                }
            }
        }
    }
    return count;
}

/* Describe and refine a candidate. */
static void refine(drogue_outline *out, const drogue_candidate *candidate, drogue_refit_context *c)
{
    int k;
    if (c->arcs != candidate->arcs) {
        sum_arcs(c, candidate->arcs);
        c->looked_as = ~candidate->polarity;
    }
    if (c->looked_as != candidate->polarity) {
        (void)drogue_refit_look(c, &candidate->ellipse, candidate->polarity);
    }
    memset(out, 0, sizeof *out);
    for (k = 0; k < 4; k++) {
        const drogue_arc *arc = arc_of(c, candidate->arcs, k);
        out->arcs[k] = arc != NULL ? (uint32_t)(arc - c->workspace->arcs) : DROGUE_NO_ARC;
    }
    drogue_quality_of_cover(&out->quality, &candidate->ellipse, candidate->fit_ratio_q16, candidate->cover_q16,
                            &c->config->quality);
    out->ellipse = candidate->ellipse;
    drogue_refit(out, c);
}

/* The most reliable candidate, refined; when that covers little, the next that differ from it, and the one of them that
 * covers most. */
static drogue_status best_outline(drogue_outline *out, uint32_t count, drogue_refit_context *c)
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
            if (i != (uint32_t)best && !drogue_same_ellipse(&candidates[i], &chosen, &c->config->cluster)) {
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
    drogue_refit_context c;
    drogue_status status;
    drogue_outline_clear(out);
    if (list->edge_count == 0) {
        return DROGUE_E_NO_EDGES;
    }
    drogue_refit_begin(&c, workspace, list, mask, config);
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
