/* SPDX-License-Identifier: Apache-2.0 */
/* The outline of the end plane from edge points and arcs (paper III-A-2). */
#include "drogue/outline.h"

#include <string.h>

#include "drogue/ellipse.h"
#include "drogue/undistort.h"

#define MAX_CANDIDATES 30 /* 15 combinations of four arcs, two polarities */
#define EDGE_FRAC 5       /* edge points are Q5 */

static drogue_q16 edge_q16(uint16_t q5) { return (drogue_q16)((int32_t)q5 * (1 << (16 - EDGE_FRAC))); }

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

/* Points of an arc within the threshold of (10). */
static uint32_t count_near(const drogue_ellipse_frame *frame, drogue_q16 threshold, const drogue_edge *edges,
                           const drogue_arc *arc)
{
    uint32_t near_count = 0;
    uint32_t i;
    for (i = arc->first; i < arc->first + arc->count; i++) {
        near_count += drogue_ellipse_deviation(frame, edge_q16(edges[i].x_q5), edge_q16(edges[i].y_q5)) < threshold;
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

/* The farthest arcs of one polarity, with their moments. */
typedef struct quadrants {
    const drogue_arc *arc[4]; /* NULL: none */
    drogue_moments moments[4];
} quadrants;

/* Fit and score one combination; 0 when it is no candidate. */
static int try_combination(drogue_candidate *out, drogue_quality *quality, const quadrants *q, uint32_t combination,
                           const drogue_edge *edges, const drogue_mask *mask, const drogue_config *config)
{
    drogue_moments sum;
    drogue_ellipse_frame frame;
    drogue_q16 threshold;
    uint32_t near_count = 0;
    int k;
    drogue_moments_clear(&sum);
    for (k = 0; k < 4; k++) {
        if ((combination >> k) & 1u) {
            drogue_moments_add(&sum, &q->moments[k]);
        }
    }
    if (drogue_ellipse_fit(&out->ellipse, &sum, EDGE_FRAC) != DROGUE_OK) {
        return 0;
    }
    out->ellipse.xc_px_q16 = drogue_q16_add(out->ellipse.xc_px_q16, drogue_q16_from_int(DROGUE_MAX_SIDE / 2));
    out->ellipse.yc_px_q16 = drogue_q16_add(out->ellipse.yc_px_q16, drogue_q16_from_int(DROGUE_MAX_SIDE / 2));
    if (!plausible(&out->ellipse, mask, config) || drogue_ellipse_frame_of(&frame, &out->ellipse) != DROGUE_OK) {
        return 0;
    }
    threshold = drogue_quality_threshold(&out->ellipse, config->quality.fit_error_px_q16);
    for (k = 0; k < 4; k++) {
        if ((combination >> k) & 1u) {
            near_count += count_near(&frame, threshold, edges, q->arc[k]);
        }
    }
    drogue_quality_score(quality, &out->ellipse, near_count, (uint32_t)sum.n, &config->quality);
    out->reliability_q16 = quality->reliability_q16;
    out->arcs = combination;
    return quality->fit_ratio_q16 >= config->min_fit_ratio_q16;
}

/* Look up the farthest arcs of one polarity and sum their moments; returns the bit set of quadrants present. */
static uint32_t gather(quadrants *q, const drogue_farthest *farthest, int polarity, const drogue_workspace *workspace)
{
    uint32_t present = 0;
    int k;
    for (k = 0; k < 4; k++) {
        uint32_t index = farthest->arc[polarity][k];
        q->arc[k] = NULL;
        if (index != DROGUE_NO_ARC && workspace->arcs[index].count <= DROGUE_MAX_FIT_POINTS / 4) {
            q->arc[k] = &workspace->arcs[index];
            arc_moments(&q->moments[k], workspace->edges, q->arc[k]);
            present |= 1u << k;
        }
    }
    return present;
}

/* The most reliable combination of arcs, both polarities considered. */
static drogue_status best_combination(drogue_outline *out, const drogue_farthest *farthest,
                                      const drogue_workspace *workspace, const drogue_mask *mask,
                                      const drogue_config *config)
{
    drogue_candidate candidates[MAX_CANDIDATES];
    quadrants q;
    uint32_t count = 0;
    int32_t best;
    int polarity;
    int k;
    for (polarity = 0; polarity < 2; polarity++) {
        uint32_t combination;
        uint32_t present;
        if (config->polarity != DROGUE_POLARITY_BOTH && (int)config->polarity != polarity) {
            continue;
        }
        present = gather(&q, farthest, polarity, workspace);
        for (combination = 1; combination < 16; combination++) {
            if ((combination & ~present) == 0 &&
                try_combination(&candidates[count], &out->quality, &q, combination, workspace->edges, mask, config)) {
                candidates[count].polarity = (uint32_t)polarity;
                count++;
            }
        }
    }
    best = drogue_cluster_best(&out->cluster_members, candidates, count, &config->cluster);
    if (best < 0) {
        memset(&out->quality, 0, sizeof out->quality);
        return DROGUE_E_NO_ELLIPSE;
    }
    out->polarity = (drogue_polarity)candidates[best].polarity;
    (void)gather(&q, farthest, (int)out->polarity, workspace); /* once more, for the winner's quality */
    (void)try_combination(&candidates[0], &out->quality, &q, candidates[best].arcs, workspace->edges, mask, config);
    out->ellipse = candidates[0].ellipse;
    for (k = 0; k < 4; k++) {
        if ((candidates[0].arcs >> k) & 1u) {
            out->arcs[k] = farthest->arc[out->polarity][k];
        }
    }
    return DROGUE_OK;
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

static drogue_band band_of(const drogue_config *config, drogue_polarity polarity)
{
    drogue_band band;
    band.half_width_px_q16 = config->refit_band_px_q16;
    band.cos_q16 = config->refit_cos_q16;
    band.polarity = polarity;
    return band;
}

static int edge_in_band(const drogue_ellipse_frame *frame, const drogue_band *band, const drogue_edge *e)
{
    return drogue_ellipse_band_holds(frame, band, edge_q16(e->x_q5), edge_q16(e->y_q5), e->gx, e->gy);
}

/* Collect the edge points that belong to the outline. */
static drogue_status collect_outline(collection *c, const drogue_outline *outline, const drogue_workspace *workspace,
                                     const drogue_edge_list *list, const drogue_config *config)
{
    const drogue_band band = band_of(config, outline->polarity);
    drogue_ellipse_frame frame;
    drogue_status status = drogue_ellipse_frame_of(&frame, &outline->ellipse);
    uint32_t i;
    if (status != DROGUE_OK) {
        return status;
    }
    collection_begin(c, &outline->ellipse, (int64_t)outline->ellipse.a_px_q16 + 16 * DROGUE_Q16_ONE);
    for (i = 0; i < list->edge_count; i++) {
        const drogue_edge *e = &workspace->edges[i];
        if (edge_in_band(&frame, &band, e)) {
            collect_point(c, edge_q16(e->x_q5), edge_q16(e->y_q5));
        }
    }
    return DROGUE_OK;
}

/* Refit on the points that belong to the outline, as often as configured; stops at the last good fit. Judges the
 * outline by the share of its circumference that they cover. */
static drogue_status refit(drogue_outline *outline, const drogue_workspace *workspace, const drogue_edge_list *list,
                           const drogue_mask *mask, const drogue_config *config)
{
    uint32_t round;
    collection c;
    for (round = 0; round < config->refit_rounds; round++) {
        drogue_ellipse ellipse;
        if (collect_outline(&c, outline, workspace, list, config) != DROGUE_OK ||
            collection_fit(&ellipse, &c) != DROGUE_OK || !plausible(&ellipse, mask, config)) {
            break;
        }
        outline->ellipse = ellipse;
        outline->refit_points = (uint32_t)c.moments.n;
    }
    if (collect_outline(&c, outline, workspace, list, config) != DROGUE_OK) {
        return DROGUE_E_NO_ELLIPSE;
    }
    outline->cover_q16 = drogue_length_ratio((uint32_t)c.moments.n, &outline->ellipse);
    return outline->cover_q16 >= config->min_cover_q16 ? DROGUE_OK : DROGUE_E_NO_ELLIPSE;
}

drogue_status drogue_outline_find(drogue_outline *out, const drogue_workspace *workspace, const drogue_edge_list *list,
                                  const drogue_mask *mask, const drogue_config *config)
{
    drogue_farthest farthest;
    drogue_status status;
    int k;
    memset(out, 0, sizeof *out);
    for (k = 0; k < 4; k++) {
        out->arcs[k] = DROGUE_NO_ARC;
    }
    if (list->edge_count == 0) {
        return DROGUE_E_NO_EDGES;
    }
    status = drogue_select_farthest(&farthest, workspace->hull, workspace->edges, workspace->arcs, list->arc_count,
                                    mask, config->min_short_px_q16);
    if (status == DROGUE_OK) {
        status = best_combination(out, &farthest, workspace, mask, config);
    }
    if (status == DROGUE_OK) {
        status = refit(out, workspace, list, mask, config);
        undo_blur(&out->ellipse, config);
    }
    return status;
}

drogue_status drogue_outline_undistorted(drogue_ellipse *out, const drogue_outline *outline,
                                         const drogue_workspace *workspace, const drogue_edge_list *list,
                                         const drogue_config *config, const drogue_camera *camera, int32_t x_px,
                                         int32_t y_px)
{
    const drogue_band band = band_of(config, outline->polarity);
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
        drogue_q16 x = drogue_q16_add(edge_q16(e->x_q5), drogue_q16_from_int(x_px));
        drogue_q16 y = drogue_q16_add(edge_q16(e->y_q5), drogue_q16_from_int(y_px));
        if (edge_in_band(&frame, &band, e)) {
            members++;
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
