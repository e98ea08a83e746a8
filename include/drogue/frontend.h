/* SPDX-License-Identifier: Apache-2.0 */
/* The one-pass front end: rows of pixels in, list of edge points and table of arcs out.
 *
 * smooth -> gradient -> non-maximum suppression -> labelling run in line buffers. Hysteresis and arc
 * labelling are two union-finds in the same pass; an arc remembers its candidate component and survives when
 * that turns out strong, which gives Canny's exact edge map without a frame store.
 *
 * With a ring Canny's candidates are those in the ring alone: they are compared with all their neighbours, but what
 * lies outside is in no component, so that hysteresis neither begins nor passes there. */
#ifndef DROGUE_FRONTEND_H
#define DROGUE_FRONTEND_H

#include "drogue/canny.h"
#include "drogue/gradient.h"
#include "drogue/label.h"
#include "drogue/mask.h"
#include "drogue/smooth.h"
#include "drogue/workspace.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What the front end is asked for. */
typedef struct drogue_frontend_config {
    int32_t canny_low;   /* L1 magnitude, 0 <= low <= high: a candidate's exceeds it */
    int32_t canny_high;  /* L1 magnitude: an edge has at least one pixel that exceeds it */
    int32_t smooth;      /* 0: no smoothing before the gradient */
    int32_t use_ring;    /* 0: candidates in the whole region, as cv::Canny */
    drogue_mask ring;    /* in region coordinates; used when use_ring is set */
    uint32_t min_arc_px; /* edge points an arc needs to enter the arc table, Th_length */
} drogue_frontend_config;

/* Part of a row, as src/frontend lays it out; empty where end <= begin. */
typedef struct drogue_stretch {
    uint16_t begin; /* px: its first */
    uint16_t end;   /* px: behind its last */
} drogue_stretch;

/* A frame in progress; the members are the front end's own. */
typedef struct drogue_frontend {
    drogue_workspace *workspace;   /* the caller's */
    drogue_frontend_config config; /* as given */
    drogue_columns columns[8];     /* of the last rows fed, row y at y % 8: where candidates are */
    drogue_stretch stretch[8];     /* what holds them */
    drogue_stretch about[8];       /* what holds those of a row and its neighbours */
    drogue_ring_chords chords;     /* of the ring, in the row fed last */
    int32_t width_px;              /* of the frame */
    int32_t height_px;             /* of the frame */
    int32_t rows_in;               /* fed so far */
    drogue_labels components;      /* of candidates: hysteresis */
    drogue_labels arc_labels;      /* of one direction class */
    uint32_t edge_count;           /* listed so far, weak ones too */
    uint32_t edges_full;           /* 1 after a point was refused */
    uint32_t slope_count[2];       /* noted in the even and in the odd row */
} drogue_frontend;

/* The lists a frame leaves in the workspace. */
typedef struct drogue_edge_list {
    uint32_t edge_count; /* surviving points: those of arcs 0, 1, ... first, each arc in raster order, then the rest */
    uint32_t arc_count;  /* arcs in raster order of their first point */
} drogue_edge_list;

/* Does the front end take frames of this size?
 *
 *  return  DROGUE_OK, DROGUE_E_ARGUMENT (thresholds, or a ring beyond its range), DROGUE_E_REGION (sides outside
 *          [1, DROGUE_MAX_SIDE]), DROGUE_E_WORKSPACE (wider than the workspace)
 */
drogue_status drogue_frontend_check(const drogue_workspace *workspace, const drogue_frontend_config *config,
                                    int32_t width_px, int32_t height_px);

/* Begin a frame.
 *
 *  frontend   out
 *  workspace  width_px <= capacity.width_px
 *  config     copied
 *  return     as drogue_frontend_check(); what is refused takes no rows, and its end is DROGUE_E_ARGUMENT
 */
drogue_status drogue_frontend_begin(drogue_frontend *frontend, drogue_workspace *workspace,
                                    const drogue_frontend_config *config, int32_t width_px, int32_t height_px);

/* Feed the next row, width_px grey levels; the row is copied. Exactly height_px rows make a frame;
 * what comes after them is not read. */
void drogue_frontend_row(drogue_frontend *frontend, const uint8_t *row);

/* End a frame: resolve hysteresis, drop what did not survive, sort the points by arc.
 *
 *  list    out; defined for every return value
 *  return  DROGUE_OK; DROGUE_E_ARGUMENT when rows are missing or too many (list empty); DROGUE_E_LABELS_FULL,
 *          DROGUE_E_EDGES_FULL or DROGUE_E_ARCS_FULL when a table filled: what did fit is in the list
 */
drogue_status drogue_frontend_end(drogue_edge_list *list, drogue_frontend *frontend);

#ifdef __cplusplus
}
#endif
#endif
