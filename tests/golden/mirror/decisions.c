/* SPDX-License-Identifier: Apache-2.0 */
/* The outline stage with its static functions in reach, so that its rounds can be followed. */
#include "decisions.h"

#define drogue_outline_clear decisions_outline_clear
#define drogue_outline_find decisions_outline_find
#define drogue_refit_begin decisions_refit_begin
#define drogue_refit_plausible decisions_refit_plausible
#define drogue_refit_look decisions_refit_look
#define drogue_refit_stride decisions_refit_stride
#define drogue_refit_cover decisions_refit_cover
#define drogue_refit_covers decisions_refit_covers
#define drogue_refit decisions_refit
drogue_status decisions_outline_find(drogue_outline *, const drogue_workspace *, const drogue_edge_list *,
                                     const drogue_mask *, const drogue_config *);
#include "../../../src/outline/outline.c"
#include "../../../src/outline/refit.c"

/* As drogue_refit(), written down on the way. */
static int follow(decisions_round rounds[DECISIONS_MAX], drogue_outline *o, drogue_refit_context *x)
{
    drogue_band band = band_about(&o->ellipse, x);
    uint32_t n;
    int done = 0;
    for (n = 0; n <= x->config->refit_rounds && !done;) {
        drogue_ellipse ellipse;
        const drogue_q16 width = band.half_width_px_q16;
        const uint32_t bright_bins = o->support.bright_bins;
        const uint32_t stride = n < x->config->refit_rounds ? stride_of(x, n) : 1;
        rounds[n].ellipse = o->ellipse;
        rounds[n].band = band;
        n++;
        if (collect(x, &o->ellipse, &band, bright_bins, stride) != DROGUE_OK) {
            break;
        }
        o->support = x->room->support;
        if (o->support.bright_bins == bright_bins) {
            if (drogue_collection_fit(&ellipse, &x->room->own) == DROGUE_OK && drogue_refit_plausible(x, &ellipse)) {
                drogue_band_narrow(&band, &o->support, &ellipse, x->config);
                done = band.half_width_px_q16 == width && stride == 1 && drogue_ellipse_settled(&ellipse, &o->ellipse);
                o->ellipse = ellipse;
            } else if (stride == 1) {
                break;
            }
        }
    }
    return (int)n;
}

int decisions_of_refit(decisions_round rounds[DECISIONS_MAX], const drogue_workspace *workspace,
                       const drogue_edge_list *list, const drogue_mask *mask, const drogue_config *config,
                       const uint32_t arcs[4])
{
    drogue_candidate candidate;
    drogue_outline outline;
    drogue_refit_context x;
    uint32_t chosen = 0;
    int k;
    drogue_refit_begin(&x, workspace, list, mask, config);
    for (k = 0; k < 4; k++) {
        x.choices.arc[k][0] = arcs[k];
        x.choices.arc[k][1] = DROGUE_NO_ARC;
        chosen |= (uint32_t)usable(&x, k, 0) << (4 * k);
    }
    (void)try_arcs(&candidate, chosen, &x); /* leaves the sum of the arcs */
    memset(&outline, 0, sizeof outline);
    outline.ellipse = candidate.ellipse;
    outline.support.bright_bins = candidate.polarity;
    return follow(rounds, &outline, &x);
}

int decisions_of_ring(decisions_round rounds[DECISIONS_MAX], const drogue_workspace *workspace,
                      const drogue_edge_list *list, const drogue_mask *mask, const drogue_config *config,
                      const drogue_ellipse *ring, drogue_q16 band_px_q16, uint32_t bright_bins)
{
    drogue_outline outline;
    drogue_refit_context x;
    drogue_refit_begin(&x, workspace, list, mask, config);
    x.band_px_q16 = band_px_q16;
    memset(&outline, 0, sizeof outline);
    outline.ellipse = *ring;
    outline.support.bright_bins = bright_bins;
    return follow(rounds, &outline, &x);
}
