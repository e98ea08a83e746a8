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

#include <stddef.h>

#include "drogue/canny.h"
#include "drogue/gradient.h"
#include "drogue/label.h"
#include "drogue/mask.h"
#include "drogue/smooth.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Sizes of a workspace. */
typedef struct drogue_capacity {
    uint32_t width_px; /* widest region, [1, DROGUE_MAX_SIDE] */
    uint32_t edges;    /* candidate edge points in the ring mask, weak ones included; [1, 2^24] */
    uint32_t labels;   /* provisional labels of candidate components and of arcs, each; [2, 2^24] */
    uint32_t arcs;     /* arcs of the least length and more; [1, 2^24] */
} drogue_capacity;

/* Capacity that suits a region of the given longest side. What noise needs grows with the area: at 8 grey levels and
 * 443 px 10.6 edge points and 5.6 labels a pixel of side, where the frames in vectors/ need 6.3 and 2.1. No more than
 * 82 arcs of an eighth of the side, and one more for every 64 px of it, fit into the edge points. */
#define DROGUE_EDGES_FOR(side_px) (10u * (size_t)(side_px) + (size_t)(side_px) * (size_t)(side_px) / 512u)
#define DROGUE_LABELS_FOR(side_px) (3u * (size_t)(side_px) + (size_t)(side_px) * (size_t)(side_px) / 140u + 2u)
#define DROGUE_ARCS_FOR(side_px) ((size_t)(side_px) > 896u ? 82u + (size_t)(side_px) / 64u : 96u)

#define DROGUE_HALF(width_px) (((size_t)(width_px) + 7u) / 8u * 4u) /* half of a row, rounded up to four pixels */

/* Bytes of the row buffers. What the outline needs after them lies in the same place: constraints.h, outline.h and
 * inner.h check that it fits. */
#define DROGUE_ROWS_BYTES(width_px)                      \
    ((size_t)(width_px) * (sizeof(drogue_merge) + 16u) + \
     DROGUE_HALF(width_px) * (5u * 2u + 3u * 4u + 4u * 4u + 32u + 4u) + 5u * 4u + 7u * 8u)
#define DROGUE_SCRATCH_BYTES ((size_t)6656) /* that the outline, the candidates and the rays need at most */
#define DROGUE_KEPT_BYTES ((size_t)472)     /* a result, wherever the memory begins: drogue.h checks that it fits */

/* Bytes of memory for a workspace: usable in a static array's size. */
#define DROGUE_WORKSPACE_BYTES(width_px, edges, labels, arcs)                                                         \
    ((size_t)(edges) * sizeof(drogue_edge) + (size_t)(arcs) * sizeof(drogue_arc) + (size_t)(labels)*16u + 256u * 4u + \
     DROGUE_KEPT_BYTES +                                                                                              \
     (DROGUE_ROWS_BYTES(width_px) > DROGUE_SCRATCH_BYTES ? DROGUE_ROWS_BYTES(width_px) : DROGUE_SCRATCH_BYTES))

/* The same for a region of the given longest side with the capacity that suits it. */
#define DROGUE_WORKSPACE_BYTES_FOR(side_px) \
    DROGUE_WORKSPACE_BYTES(side_px, DROGUE_EDGES_FOR(side_px), DROGUE_LABELS_FOR(side_px), DROGUE_ARCS_FOR(side_px))

struct drogue_point;        /* constraints.h */
struct drogue_outline_room; /* outline.h */
struct drogue_ray;          /* rays.h */
struct drogue_result;       /* drogue.h */

/* Line buffers, tables and lists in the caller's memory; set by drogue_workspace_init(). After a frame
 * 'edges' and 'arcs' hold its edge points and arcs; everything else is scratch. */
typedef struct drogue_workspace {
    drogue_capacity capacity;            /* what it was laid out for */
    drogue_edge *edges;                  /* edges */
    drogue_arc *arcs;                    /* arcs */
    uint32_t *component_parent;          /* labels */
    uint32_t *component_strong;          /* labels */
    uint32_t *arc_parent;                /* labels */
    uint32_t *arc_component;             /* labels */
    uint32_t *histogram;                 /* 256 */
    struct drogue_result *kept;          /* of the best of what drogue_measure() tries; aligned for int64_t */
    struct drogue_point *hull;           /* DROGUE_HULL_MAX, in the place of the rows below */
    struct drogue_outline_room *outline; /* in the place of the hull when that has served; aligned for int64_t */
    struct drogue_ray *rays;             /* DROGUE_RAYS, there when the outline has served */
    drogue_merge *merges;                /* width */
    uint32_t *component_rows;            /* 2 x width */
    uint32_t *arc_rows;                  /* 2 x width */
    uint8_t *raw_rows;                   /* 5 x (2 half + 4): what these rows hold is for src/frontend to say */
    uint8_t *smooth_rows;                /* 3 x 4 (half + 2); aligned for uint32_t, like the others */
    uint16_t *magnitude_rows;            /* 4 x 2 (half + 2) */
    drogue_slope *slope_rows;            /* 4 half */
    uint8_t *code_rows;                  /* 4 half: bit 0 candidate, bit 1 strong, bits 2-4 direction class + 1 */
} drogue_workspace;

/* Is a workspace wide enough for what of a region lies within an image? */
int drogue_workspace_spans(const drogue_workspace *workspace, const drogue_region *region, const drogue_image *image);

/* Make a square region of which more lies within an image than a workspace is wide enough for as wide as that,
 * about the same middle. */
void drogue_workspace_narrow(drogue_region *region, const drogue_workspace *workspace, const drogue_image *image);

/* Bytes that drogue_workspace_init() needs; equals DROGUE_WORKSPACE_BYTES. */
size_t drogue_workspace_bytes(const drogue_capacity *capacity);

/* Lay a workspace out in the caller's memory, which must live as long as the workspace.
 *
 *  workspace  out
 *  memory     at least drogue_workspace_bytes(capacity) bytes, aligned for uint32_t
 *  return     DROGUE_OK, DROGUE_E_WORKSPACE (too few bytes), DROGUE_E_ARGUMENT (capacity out of range, misaligned)
 */
drogue_status drogue_workspace_init(drogue_workspace *workspace, void *memory, size_t bytes,
                                    const drogue_capacity *capacity);

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

/* Upper threshold that noise alone hardly passes: ten standard deviations. Noise is measured by second differences of
 * means of 3 x 3 px along every third row, summed over blocks of 9; the lowest tenth of the blocks counts, so that
 * edges do not. It is taken for white: a codec's or a sharpened image's counts as what smoothing leaves of it.
 *
 *  histogram  work area, 256 counts
 *  return     L1 Sobel magnitude, grey levels * 8, below 700; 0 for less noise than 0.3 levels, and of an image
 *             under 17 x 3 px
 */
int32_t drogue_noise_threshold(uint32_t *histogram, const drogue_image *image);

#ifdef __cplusplus
}
#endif
#endif
