/* SPDX-License-Identifier: Apache-2.0 */
/* The outline stage with its static functions in reach, so that its rounds can be followed. */
#include "decisions.h"

#define drogue_outline_find decisions_outline_find
#define drogue_outline_undistorted decisions_outline_undistorted
drogue_status decisions_outline_find(drogue_outline *, const drogue_workspace *, const drogue_edge_list *,
                                     const drogue_mask *, const drogue_config *);
drogue_status decisions_outline_undistorted(drogue_ellipse *, const drogue_outline *, const drogue_workspace *,
                                            const drogue_edge_list *, const drogue_config *, const drogue_camera *,
                                            int32_t, int32_t);
#include "../../../src/outline.c"

/* As refit() in outline.c, written down on the way. */
static int follow(decisions_round rounds[DECISIONS_MAX], drogue_outline *o, const context *x)
{
    drogue_band band = band_about(&o->ellipse, x->config->search_band_q16, x->config);
    collection c;
    int n = 0;
    int done = 0;
    while (n <= (int)x->config->refit_rounds && n < DECISIONS_MAX && !done) {
        drogue_ellipse ellipse;
        const drogue_q16 width = band.half_width_px_q16;
        rounds[n].ellipse = o->ellipse;
        rounds[n].band = band;
        rounds[n].bright_bins = o->support.bright_bins;
        n++;
        if (collect_outline(&c, &o->support, &o->ellipse, &band, x) != DROGUE_OK) {
            break;
        }
        drogue_support_judge(&o->support, &o->ellipse, x->config->polarity, 1);
        if (n > (int)x->config->refit_rounds || collection_fit(&ellipse, &c) != DROGUE_OK ||
            !plausible(&ellipse, x->mask, x->config)) {
            break;
        }
        narrow(&band, &o->support, &ellipse, x->config);
        done = band.half_width_px_q16 == width && settled(&ellipse, &o->ellipse);
        o->ellipse = ellipse;
    }
    return n;
}

int decisions_of_refit(decisions_round rounds[DECISIONS_MAX], const drogue_workspace *workspace,
                       const drogue_edge_list *list, const drogue_mask *mask, const drogue_config *config,
                       const uint32_t arcs[4])
{
    const context x = {workspace, list, mask, config};
    drogue_arc_choices choices;
    drogue_candidate candidate;
    drogue_outline outline;
    arc_set set;
    uint8_t chosen[4];
    int k;
    for (k = 0; k < 4; k++) {
        choices.arc[k][0] = arcs[k];
        choices.arc[k][1] = DROGUE_NO_ARC;
        chosen[k] = arcs[k] != DROGUE_NO_ARC;
    }
    gather(&set, &choices, workspace);
    (void)try_arcs(&candidate, &set, chosen, &x);
    memset(&outline, 0, sizeof outline);
    outline.ellipse = candidate.ellipse;
    outline.support.bright_bins = candidate.polarity;
    return follow(rounds, &outline, &x);
}
