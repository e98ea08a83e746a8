/* SPDX-License-Identifier: Apache-2.0 */
/* Edge points about an ellipse, and fits to them. */
#include "refit.h"

#include <string.h>

void drogue_refit_begin(drogue_refit_context *c, const drogue_workspace *workspace, const drogue_edge_list *list,
                        const drogue_mask *mask, const drogue_config *config)
{
    memset(c, 0, sizeof *c);
    c->workspace = workspace;
    c->room = workspace->outline;
    c->list = list;
    c->mask = mask;
    c->config = config;
    c->least_cover_q16 = config->min_cover_q16;
    drogue_collection_of_region(&c->room->sum);
}

int drogue_refit_plausible(const drogue_refit_context *c, const drogue_ellipse *e)
{
    const int64_t a = e->a_px_q16;
    return drogue_round_enough(e, c->config) && a >= (int64_t)c->config->min_size_q16 * c->mask->longest_px &&
           a <= (int64_t)c->config->max_size_q16 * c->mask->longest_px;
}

/* Band about an ellipse: the one asked for; else the configured one, or a share of the semi-axis where that is
 * wider. */
static drogue_band band_about(const drogue_ellipse *e, const drogue_refit_context *c)
{
    const drogue_config *config = c->config;
    const drogue_q16 wide = drogue_q16_mul(e->a_px_q16, config->search_band_q16);
    const drogue_q16 most = DROGUE_Q16(8, 1);
    return drogue_band_of(c->band_px_q16 > 0                 ? c->band_px_q16
                          : config->refit_band_px_q16 > wide ? config->refit_band_px_q16
                          : wide > most                      ? most
                                                             : wide,
                          config->refit_cos_q16);
}

uint32_t drogue_refit_stride(const drogue_refit_context *c) { return c->list->edge_count / DROGUE_OUTLINE_LOOKS + 1; }

/* Collect the edge points that belong to an ellipse, every one or every so many of them: counts by bin, residuals, and
 * moments, where all count from those of the arcs. Bins have the given polarities until they are judged by the
 * counts. */
static drogue_status collect(drogue_refit_context *c, const drogue_ellipse *ellipse, const drogue_band *band,
                             uint32_t bright_bins, uint32_t stride)
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

drogue_status drogue_refit_look(drogue_refit_context *c, const drogue_ellipse *ellipse, uint32_t bright_bins)
{
    const drogue_band band = band_about(ellipse, c);
    c->looked_as = bright_bins;
    return collect(c, ellipse, &band, bright_bins, drogue_refit_stride(c));
}

drogue_q16 drogue_refit_cover(const drogue_ellipse *ring, drogue_refit_context *c)
{
    if (!drogue_refit_plausible(c, ring) || drogue_refit_look(c, ring, 0) != DROGUE_OK) {
        return -1;
    }
    return drogue_support_cover(&c->room->support);
}

int drogue_refit_covers(const drogue_ellipse *ring, drogue_refit_context *c)
{
    const drogue_q16 cover_q16 = drogue_refit_cover(ring, c);
    const uint32_t bright_bins = c->room->support.bright_bins;
    if (cover_q16 < c->least_cover_q16) {
        return cover_q16 < 0 ? -1 : 0;
    }
    return c->looked_as == bright_bins || drogue_refit_look(c, ring, bright_bins) == DROGUE_OK;
}

/* Give an outline the points about it: those looked at already, or every stride-th, collected anew. */
static drogue_status take_points(drogue_outline *outline, drogue_refit_context *c, const drogue_band *band,
                                 uint32_t stride, int looked_at)
{
    const drogue_status status =
        looked_at ? DROGUE_OK : collect(c, &outline->ellipse, band, outline->support.bright_bins, stride);
    if (status == DROGUE_OK) {
        outline->support = c->room->support;
        outline->band_px_q16 = band->half_width_px_q16;
    }
    return status;
}

/* Fit an outline to its points, all or those looked at, and narrow the band. 1: no more fits, it has settled or all
 * points give no good one. */
static int fit_once(drogue_outline *outline, drogue_refit_context *c, drogue_band *band, int all)
{
    drogue_ellipse ellipse;
    int settled;
    if (drogue_collection_fit(&ellipse, &c->room->own) != DROGUE_OK || !drogue_refit_plausible(c, &ellipse)) {
        return all;
    }
    drogue_band_narrow(band, &outline->support, &ellipse, c->config);
    settled = drogue_ellipse_settled(&ellipse, &outline->ellipse);
    outline->ellipse = ellipse;
    outline->refit_points = (uint32_t)c->room->own.moments.n;
    return settled && all && band->half_width_px_q16 == outline->band_px_q16;
}

#define MANY 8 /* times as many points as score an outline: of fewer another fit takes more than it saves */

/* Every how many-th point a round takes: those that scored it, of many also to bring the outline to its place; the last
 * two fits are to all. */
static uint32_t stride_of(const drogue_refit_context *c, uint32_t round)
{
    const uint32_t stride = drogue_refit_stride(c);
    return round == 0 || (round + 2 < c->config->refit_rounds && stride > MANY) ? stride : 1;
}

void drogue_refit(drogue_outline *outline, drogue_refit_context *c)
{
    drogue_band band = band_about(&outline->ellipse, c);
    uint32_t bright_bins = c->looked_as; /* as which the points are taken */
    uint32_t round;
    int done = 0;
    outline->support.bright_bins = bright_bins;
    for (round = 0; round < c->config->refit_rounds && !done; round++) { /* bound: 16 */
        const uint32_t stride = stride_of(c, round);
        done = take_points(outline, c, &band, stride, round == 0) != DROGUE_OK;
        if (!done && outline->support.bright_bins == bright_bins) { /* else again with those that the counts show */
            done = fit_once(outline, c, &band, stride == 1);
        }
        bright_bins = outline->support.bright_bins;
    }
    if (!done && take_points(outline, c, &band, 1, 0) == DROGUE_OK && outline->support.bright_bins != bright_bins) {
        drogue_support_judge_as(&outline->support, &outline->ellipse, bright_bins, 1); /* as the sums are */
    }
    drogue_support_turn(&outline->support, outline->ellipse.angle_rad_q16);
    outline->cover_q16 = drogue_support_cover(&outline->support);
    outline->polarity = outline->support.bright_bins == 0            ? DROGUE_POLARITY_DARK
                        : outline->support.bright_bins == UINT32_MAX ? DROGUE_POLARITY_BRIGHT
                                                                     : DROGUE_POLARITY_BOTH;
}
