/* SPDX-License-Identifier: Apache-2.0 */
/* Outlines about an ellipse that is known: a larger one than was found, or one about a disc. */
#include "refit.h"

#define ALL_ABOUT 7 /* parts, of eight, in which an outline shows that is covered less than others have to be */
#define RINGS 14    /* about the outline, each larger than the one before by a fortieth: to 1.4 times its size */

drogue_q16 drogue_outline_covered(const drogue_ellipse *ring, const drogue_workspace *workspace,
                                  const drogue_edge_list *list, const drogue_mask *mask, const drogue_config *config)
{
    drogue_refit_context c;
    drogue_q16 cover_q16;
    drogue_refit_begin(&c, workspace, list, mask, config);
    cover_q16 = drogue_refit_cover(ring, &c);
    return cover_q16 > 0 ? cover_q16 : 0;
}

/* As fitted and with what blur took put back. */
static void finish_ring(drogue_outline *out, const drogue_config *config)
{
    out->fitted = out->ellipse;
    drogue_undo_blur(&out->ellipse, config);
}

/* Is enough of an outline covered; or less, but all about? */
static int shows_enough(const drogue_outline *outline, drogue_q16 least_cover_q16, const drogue_config *config)
{
    return outline->cover_q16 >= least_cover_q16 &&
           (outline->cover_q16 >= config->min_cover_q16 ||
            drogue_support_parts(&outline->support, &outline->ellipse) >= ALL_ABOUT);
}

int drogue_outline_settle(drogue_outline *out, const drogue_ellipse *ring, drogue_q16 band_px_q16,
                          drogue_q16 least_cover_q16, const drogue_workspace *workspace, const drogue_edge_list *list,
                          const drogue_mask *mask, const drogue_config *config)
{
    drogue_refit_context c;
    drogue_refit_begin(&c, workspace, list, mask, config);
    c.band_px_q16 = band_px_q16;
    c.least_cover_q16 = least_cover_q16;
    drogue_outline_clear(out);
    if (drogue_refit_covers(ring, &c) <= 0) {
        return 0;
    }
    out->ellipse = *ring;
    drogue_refit(out, &c);
    if (!shows_enough(out, least_cover_q16, config)) {
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
    drogue_refit_context c;
    int k;
    drogue_refit_begin(&c, workspace, list, mask, config);
    trial = &c.room->trial;
    best = &c.room->best;
    *best = *out;
    best->cover_q16 = 0;
    for (k = 0; k < RINGS; k++) {
        int covered;
        ring.a_px_q16 = drogue_q16_add(ring.a_px_q16, ring.a_px_q16 / 40);
        ring.b_px_q16 = drogue_q16_add(ring.b_px_q16, ring.b_px_q16 / 40);
        covered = drogue_refit_covers(&ring, &c);
        if (covered < 0) {
            break;
        }
        if (!covered) {
            continue;
        }
        *trial = *out;
        trial->ellipse = ring;
        drogue_refit(trial, &c);
        if (trial->cover_q16 >= best->cover_q16 && trial->cover_q16 >= config->min_cover_q16 &&
            (int64_t)trial->ellipse.b_px_q16 * 50 > (int64_t)out->fitted.b_px_q16 * 51) { /* else the one found */
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
