/* SPDX-License-Identifier: Apache-2.0 */
/* The outline of the end plane from edge points and arcs (paper III-A-2, with support over all edges). */
#include "drogue/outline.h"

#include <string.h>

#include "drogue/ellipse.h"
#include "drogue/undistort.h"

#define EDGE_FRAC 5                        /* edge points are Q5 */
#define LOOKS 512                          /* a candidate is scored by so many edge points, evenly taken */
#define TRIES 3                            /* candidates refined before the best of them is taken */
#define GOOD_COVER_Q16 DROGUE_Q16(3, 4)    /* no further try */
#define ENOUGH_COVER_Q16 DROGUE_Q16(9, 10) /* no further candidate */
#define SETTLED_Q16 DROGUE_Q16(1, 64)     /* px: an ellipse that a refit moves by less has settled */

/* The candidates' arcs, and what each of them sums to. */
typedef struct arc_set {
    const drogue_arc *arc[4][DROGUE_ARC_CHOICES]; /* NULL: none */
    drogue_moments moments[4][DROGUE_ARC_CHOICES];
} arc_set;

/* Moments of an arc about the region's centre, unit 1/32 px. */
static void arc_moments(drogue_moments *out, const drogue_edge *edges, const drogue_arc *arc)
{
    const int32_t origin_q5 = (DROGUE_MAX_SIDE / 2) << EDGE_FRAC; /* makes the coordinates 16-bit for every region */
    uint32_t i;
    drogue_moments_clear(out);
    for (i = arc->first; i < arc->first + arc->count; i++) {
        drogue_moments_add_point(out, edges[i].x_q5 - origin_q5, edges[i].y_q5 - origin_q5);
    }
}

static void gather(arc_set *set, const drogue_arc_choices *choices, const drogue_workspace *workspace)
{
    int k;
    int i;
    for (k = 0; k < 4; k++) {
        for (i = 0; i < DROGUE_ARC_CHOICES; i++) {
            const uint32_t index = choices->arc[k][i];
            set->arc[k][i] = NULL;
            if (index != DROGUE_NO_ARC && workspace->arcs[index].count <= DROGUE_MAX_FIT_POINTS / 4) {
                set->arc[k][i] = &workspace->arcs[index];
                arc_moments(&set->moments[k][i], workspace->edges, set->arc[k][i]);
            }
        }
    }
}

/* Points of an arc within the threshold of (10). */
static uint32_t count_near(const drogue_ellipse_frame *frame, drogue_q16 threshold, const drogue_edge *edges,
                           const drogue_arc *arc)
{
    uint32_t near_count = 0;
    uint32_t i;
    for (i = arc->first; i < arc->first + arc->count; i++) {
        near_count +=
            drogue_ellipse_deviation(frame, drogue_edge_x_q16(&edges[i]), drogue_edge_y_q16(&edges[i])) < threshold;
    }
    return near_count;
}

static int round_enough(const drogue_ellipse *e, const drogue_config *config)
{
    return (int64_t)e->b_px_q16 * DROGUE_Q16_ONE >= (int64_t)e->a_px_q16 * config->min_axis_ratio_q16;
}

static int plausible(const drogue_ellipse *e, const drogue_mask *mask, const drogue_config *config)
{
    int64_t a = e->a_px_q16;
    return round_enough(e, config) && a >= (int64_t)config->min_size_q16 * mask->longest_px &&
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
} context;

/* Fit and score the union of the arcs chosen[k] - 1 of each quadrant k (0: none); 0 when it is no candidate. */
static int try_arcs(drogue_candidate *out, const arc_set *set, const uint8_t chosen[4], const context *c)
{
    const uint32_t stride = c->list->edge_count / LOOKS + 1;
    drogue_moments sum;
    drogue_ellipse_frame frame;
    drogue_quality quality;
    drogue_support support;
    drogue_band band;
    drogue_q16 threshold;
    drogue_q16 fit_error;
    uint32_t near_count = 0;
    int k;
    drogue_moments_clear(&sum);
    out->arcs = 0;
    for (k = 0; k < 4; k++) {
        if (chosen[k] != 0) {
            drogue_moments_add(&sum, &set->moments[k][chosen[k] - 1]);
            out->arcs |= (uint32_t)chosen[k] << (4 * k);
        }
    }
    if (drogue_ellipse_fit(&out->ellipse, &sum, EDGE_FRAC) != DROGUE_OK) {
        return 0;
    }
    out->ellipse.xc_px_q16 = drogue_q16_add(out->ellipse.xc_px_q16, drogue_q16_from_int(DROGUE_MAX_SIDE / 2));
    out->ellipse.yc_px_q16 = drogue_q16_add(out->ellipse.yc_px_q16, drogue_q16_from_int(DROGUE_MAX_SIDE / 2));
    if (!plausible(&out->ellipse, c->mask, c->config) || drogue_ellipse_frame_of(&frame, &out->ellipse) != DROGUE_OK) {
        return 0;
    }
    band = band_about(&out->ellipse, c->config->search_band_q16, c->config);
    fit_error = drogue_q16_mul(out->ellipse.a_px_q16, c->config->search_band_q16);
    fit_error = fit_error > c->config->quality.fit_error_px_q16 ? fit_error : c->config->quality.fit_error_px_q16;
    threshold = drogue_quality_threshold(&out->ellipse, fit_error);
    for (k = 0; k < 4; k++) {
        if (chosen[k] != 0) {
            near_count += count_near(&frame, threshold, c->workspace->edges, set->arc[k][chosen[k] - 1]);
        }
    }
    drogue_support_count(&support, &frame, &band, c->workspace->edges, c->list->edge_count, stride);
    drogue_support_judge(&support, &out->ellipse, c->config->polarity, stride);
    drogue_quality_of_cover(&quality, &out->ellipse, near_count, (uint32_t)sum.n, drogue_support_cover(&support),
                            &c->config->quality);
    out->reliability_q16 = quality.reliability_q16;
    out->fit_ratio_q16 = quality.fit_ratio_q16;
    out->cover_q16 = quality.length_ratio_q16;
    out->polarity = support.bright_bins;
    return quality.fit_ratio_q16 >= c->config->min_fit_ratio_q16;
}

/* The first arcs of all quadrants together; unless they cover enough, all pairs of arcs from two quadrants too. Returns
 * how many candidates there are. */
static uint32_t all_candidates(drogue_candidate candidates[DROGUE_MAX_CANDIDATES], const arc_set *set, const context *c)
{
    uint8_t chosen[4];
    uint32_t count;
    int k;
    int l;
    int i;
    for (k = 0; k < 4; k++) {
        chosen[k] = set->arc[k][0] != NULL;
    }
    count = (uint32_t)try_arcs(&candidates[0], set, chosen, c);
    if (count == 1 && candidates[0].cover_q16 >= ENOUGH_COVER_Q16) {
        return 1;
    }
    for (k = 0; k < 4; k++) {
        for (l = k + 1; l < 4; l++) {
            for (i = 0; i < DROGUE_ARC_CHOICES * DROGUE_ARC_CHOICES; i++) {
                memset(chosen, 0, sizeof chosen);
                chosen[k] = (uint8_t)(1 + i / DROGUE_ARC_CHOICES);
                chosen[l] = (uint8_t)(1 + i % DROGUE_ARC_CHOICES);
                if (set->arc[k][chosen[k] - 1] != NULL && set->arc[l][chosen[l] - 1] != NULL) {
                    count += (uint32_t)try_arcs(&candidates[count], set, chosen, c);
                }
            }
        }
    }
    return count;
}

/* Edge points that belong to an ellipse, the lens distortion removed where a camera is given. */
typedef struct collection {
    drogue_moments moments;
    drogue_q16 x_px_q16; /* origin of the moments */
    drogue_q16 y_px_q16;
    int frac_bits;
} collection;

static void collect_point(collection *c, drogue_q16 x_px_q16, drogue_q16 y_px_q16)
{
    int64_t x = drogue_shr_round_s64((int64_t)x_px_q16 - c->x_px_q16, 16 - c->frac_bits);
    int64_t y = drogue_shr_round_s64((int64_t)y_px_q16 - c->y_px_q16, 16 - c->frac_bits);
    DROGUE_NOTE("outline: point in the fit's unit", x, 16);
    if (c->moments.n < DROGUE_MAX_FIT_POINTS && x >= INT16_MIN && x <= INT16_MAX && y >= INT16_MIN && y <= INT16_MAX) {
        drogue_moments_add_point(&c->moments, (int32_t)x, (int32_t)y);
    }
}

/* Begin a collection of points that reach this far from a centre: the finest unit in which they fit 16 bits. The origin
 * is a whole pixel: edge points, multiples of 1/32 px, are then exact, where any other would shift them all alike. */
static void collection_begin(collection *c, const drogue_ellipse *e, int64_t reach_px_q16)
{
    drogue_moments_clear(&c->moments);
    c->x_px_q16 = drogue_q16_from_int((int32_t)drogue_shr_round_s64(e->xc_px_q16, 16));
    c->y_px_q16 = drogue_q16_from_int((int32_t)drogue_shr_round_s64(e->yc_px_q16, 16));
    c->frac_bits = 10;
    while (c->frac_bits > 0 && reach_px_q16 >> (16 - c->frac_bits) > INT16_MAX) {
        c->frac_bits--;
    }
}

static drogue_status collection_fit(drogue_ellipse *out, const collection *c)
{
    drogue_status status = drogue_ellipse_fit(out, &c->moments, c->frac_bits);
    out->xc_px_q16 = drogue_q16_add(out->xc_px_q16, c->x_px_q16);
    out->yc_px_q16 = drogue_q16_add(out->yc_px_q16, c->y_px_q16);
    return status;
}

/* Put back what blur takes: an edge of curvature c under blur of variance v shows v c / 2 further in. The front end's
 * own share of v / 2 is measured on discs of 20 to 160 px. Curvature is a / b^2 at the ends of the major axis, b / a^2
 * at those of the minor. */
static void undo_blur(drogue_ellipse *e, const drogue_config *config)
{
    const drogue_wide own = drogue_wide_from_q16(config->smooth ? DROGUE_Q16(82, 100) : DROGUE_Q16(32, 100));
    drogue_wide blur = drogue_wide_from_q16(config->optics_blur_px_q16);
    drogue_wide half = drogue_wide_add(own, drogue_wide_scale(drogue_wide_mul(blur, blur), -1));
    drogue_wide a = drogue_wide_from_q16(e->a_px_q16);
    drogue_wide b = drogue_wide_from_q16(e->b_px_q16);
    e->a_px_q16 =
        drogue_wide_to_q16(drogue_wide_add(a, drogue_wide_div(drogue_wide_mul(half, a), drogue_wide_mul(b, b))));
    e->b_px_q16 =
        drogue_wide_to_q16(drogue_wide_add(b, drogue_wide_div(drogue_wide_mul(half, b), drogue_wide_mul(a, a))));
}

/* Collect the edge points that belong to an outline: counts by bin, residuals and moments. Bins have the polarity that
 * the collection before gave them. */
static drogue_status collect_outline(collection *c, drogue_support *support, const drogue_ellipse *ellipse,
                                     const drogue_band *band, const context *x)
{
    const uint32_t bright_bins = support->bright_bins;
    drogue_ellipse_frame frame;
    drogue_status status = drogue_ellipse_frame_of(&frame, ellipse);
    uint32_t i;
    if (status != DROGUE_OK) {
        return status;
    }
    memset(support, 0, sizeof *support);
    support->bright_bins = bright_bins;
    collection_begin(c, ellipse, (int64_t)ellipse->a_px_q16 + 16 * DROGUE_Q16_ONE);
    for (i = 0; i < x->list->edge_count; i++) {
        const drogue_edge *e = &x->workspace->edges[i];
        drogue_band_point p;
        if (drogue_ellipse_band_holds(&p, &frame, band, drogue_edge_x_q16(e), drogue_edge_y_q16(e), e->gx, e->gy) &&
            drogue_support_add(support, &p, e)) {
            collect_point(c, drogue_edge_x_q16(e), drogue_edge_y_q16(e));
        }
    }
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
    collection c;
    uint32_t round;
    int done = 0;
    for (round = 0; round <= config->refit_rounds && !done; round++) {
        drogue_ellipse ellipse;
        const drogue_q16 width = band.half_width_px_q16;
        if (collect_outline(&c, &outline->support, &outline->ellipse, &band, x) != DROGUE_OK) {
            return;
        }
        drogue_support_judge(&outline->support, &outline->ellipse, config->polarity, 1);
        outline->band_px_q16 = width;
        if (round == config->refit_rounds || collection_fit(&ellipse, &c) != DROGUE_OK ||
            !plausible(&ellipse, x->mask, config)) {
            break;
        }
        narrow(&band, &outline->support, &ellipse, config);
        done = band.half_width_px_q16 == width && settled(&ellipse, &outline->ellipse);
        outline->ellipse = ellipse;
        outline->refit_points = (uint32_t)c.moments.n;
    }
    outline->cover_q16 = drogue_support_cover(&outline->support);
    outline->polarity = outline->support.bright_bins == 0            ? DROGUE_POLARITY_DARK
                        : outline->support.bright_bins == UINT32_MAX ? DROGUE_POLARITY_BRIGHT
                                                                     : DROGUE_POLARITY_BOTH;
}

/* Describe and refine a candidate. */
static void refine(drogue_outline *out, const drogue_candidate *candidate, const arc_set *set, const context *c)
{
    int k;
    memset(out, 0, sizeof *out);
    for (k = 0; k < 4; k++) {
        const uint32_t chosen = (candidate->arcs >> (4 * k)) & 15u;
        out->arcs[k] = chosen != 0 ? (uint32_t)(set->arc[k][chosen - 1] - c->workspace->arcs) : DROGUE_NO_ARC;
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
                                  uint32_t count, const arc_set *set, const context *c)
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
        refine(&trial, &chosen, set, c);
        trial.cluster_members = members;
        if (tries == 0 || trial.cover_q16 > out->cover_q16) {
            *out = trial;
        }
        for (i = 0; i < count; i++) {
            if (!drogue_same_ellipse(&candidates[i], &chosen, &c->config->cluster)) {
                candidates[kept++] = candidates[i];
            }
        }
        count = kept;
    }
    return out->cover_q16 >= c->config->min_cover_q16 ? DROGUE_OK : DROGUE_E_NO_ELLIPSE;
}

drogue_status drogue_outline_find(drogue_outline *out, const drogue_workspace *workspace, const drogue_edge_list *list,
                                  const drogue_mask *mask, const drogue_config *config)
{
    drogue_candidate candidates[DROGUE_MAX_CANDIDATES];
    drogue_arc_choices choices;
    arc_set set;
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
    status = drogue_select_arcs(&choices, workspace->hull, workspace->edges, workspace->arcs, list->arc_count, mask,
                                config->min_short_px_q16, config->polarity);
    if (status == DROGUE_OK) {
        gather(&set, &choices, workspace);
        status = best_outline(out, candidates, all_candidates(candidates, &set, &c), &set, &c);
        if (out->ellipse.b_px_q16 > 0) {
            undo_blur(&out->ellipse, config);
        }
    }
    return status;
}

drogue_status drogue_outline_undistorted(drogue_ellipse *out, const drogue_outline *outline,
                                         const drogue_workspace *workspace, const drogue_edge_list *list,
                                         const drogue_config *config, const drogue_camera *camera, int32_t x_px,
                                         int32_t y_px)
{
    const drogue_band band = drogue_band_of(outline->band_px_q16, config->refit_cos_q16);
    drogue_support support = outline->support;
    drogue_ellipse_frame frame;
    drogue_ellipse centre = outline->ellipse;
    collection c;
    drogue_status status;
    uint32_t members;
    uint32_t i;
    memset(out, 0, sizeof *out);
    centre.xc_px_q16 = drogue_q16_add(centre.xc_px_q16, drogue_q16_from_int(x_px));
    centre.yc_px_q16 = drogue_q16_add(centre.yc_px_q16, drogue_q16_from_int(y_px));
    if (drogue_ellipse_frame_of(&frame, &outline->ellipse) != DROGUE_OK ||
        drogue_undistort_point(&centre.xc_px_q16, &centre.yc_px_q16, camera) != DROGUE_OK) {
        return DROGUE_E_DEGENERATE;
    }
    collection_begin(&c, &centre, (int64_t)centre.a_px_q16 * 4); /* lenses may stretch */
    for (i = 0, members = 0; i < list->edge_count; i++) {
        const drogue_edge *e = &workspace->edges[i];
        drogue_q16 x = drogue_edge_x_q16(e);
        drogue_q16 y = drogue_edge_y_q16(e);
        drogue_band_point p;
        if (drogue_ellipse_band_holds(&p, &frame, &band, x, y, e->gx, e->gy) && drogue_support_add(&support, &p, e)) {
            members++;
            x = drogue_q16_add(x, drogue_q16_from_int(x_px));
            y = drogue_q16_add(y, drogue_q16_from_int(y_px));
            if (drogue_undistort_point(&x, &y, camera) == DROGUE_OK) {
                collect_point(&c, x, y);
            }
        }
    }
    status = collection_fit(out, &c);
    if (status == DROGUE_OK &&
        (c.moments.n * 4 < (int64_t)members * 3 || !round_enough(out, config) || out->b_px_q16 < DROGUE_Q16_ONE)) {
        status = DROGUE_E_DEGENERATE; /* most of the outline lies beyond what the lens model can undo */
    }
    if (status == DROGUE_OK) {
        undo_blur(out, config);
    }
    return status;
}
