/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the outline stage: the edge points about an ellipse, and fits to them until they settle. */
#ifndef DROGUE_REFIT_H
#define DROGUE_REFIT_H

#include "collection.h"

/* Everything that an outline is made of and scored with. */
typedef struct drogue_refit_context {
    const drogue_workspace *workspace;
    const drogue_edge_list *list;
    const drogue_mask *mask;
    const drogue_config *config;
    drogue_arc_choices choices;
    drogue_outline_room *room;
    uint32_t arcs;             /* whose points are summed, as a candidate has them; 0: none */
    const drogue_arc *part[4]; /* the same in the order of their points */
    int parts;
    drogue_q16 least_cover_q16; /* of an ellipse on which an outline is looked for */
    uint32_t looked_as;         /* the bins' polarities in the last look */
    drogue_q16 band_px_q16;     /* half the band's width; 0: as configured, or a share of a large ellipse */
} drogue_refit_context;

/* Begin without arcs. */
void drogue_refit_begin(drogue_refit_context *c, const drogue_workspace *workspace, const drogue_edge_list *list,
                        const drogue_mask *mask, const drogue_config *config);

/* Can an ellipse be the end plane's, by its shape and by its size in the region? */
int drogue_refit_plausible(const drogue_refit_context *c, const drogue_ellipse *e);

/* Of the edge points every so many-th is looked at. */
uint32_t drogue_refit_stride(const drogue_refit_context *c);

/* Look at every so many of the edge points about an ellipse, for its score and the first round of its refit: into the
 * room's support and its own points.
 *
 *  bright_bins  polarities of the bins, until they are judged by the counts
 */
drogue_status drogue_refit_look(drogue_refit_context *c, const drogue_ellipse *ellipse, uint32_t bright_bins);

/* How much of an ellipse is covered; negative when it is no plausible one. */
drogue_q16 drogue_refit_cover(const drogue_ellipse *ring, drogue_refit_context *c);

/* Look for an outline on an ellipse: is enough of it covered? Negative when it is no plausible one. */
int drogue_refit_covers(const drogue_ellipse *ring, drogue_refit_context *c);

/* Refit on the points that belong to the outline until it settles, as often as configured; stops at the last good fit.
 * The first round takes the points that were looked at. Judges the outline by the share of its circumference that they
 * cover. */
void drogue_refit(drogue_outline *outline, drogue_refit_context *c);

#endif
