/* SPDX-License-Identifier: Apache-2.0 */
/* The memory of a measurement: line buffers, tables and lists in one block of the caller's. */
#ifndef DROGUE_WORKSPACE_H
#define DROGUE_WORKSPACE_H

#include <stddef.h>

#include "drogue/label.h"
#include "drogue/types.h"

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

/* Capacity that no image of a size fills, where RAM is plenty: an edge point and a label a pixel, and arcs of no fewer
 * points than min_arc_px of the configuration that is used.
 *
 *  width_px, height_px  of the image or of its largest region, [1, DROGUE_MAX_SIDE]
 */
static inline void drogue_capacity_for_any(drogue_capacity *out, int32_t width_px, int32_t height_px,
                                           uint32_t min_arc_px)
{
    out->width_px = (uint32_t)width_px;
    out->edges = (uint32_t)width_px * (uint32_t)height_px;
    out->labels = out->edges + 2u;
    out->arcs = out->edges / (min_arc_px > 0 ? min_arc_px : 1u) + 1u;
}

#define DROGUE_HALF(width_px) (((size_t)(width_px) + 7u) / 8u * 4u) /* half of a row, rounded up to four pixels */

/* Bytes of the row buffers. What the outline needs after them lies in the same place: constraints.h, outline.h and
 * inner.h check that it fits. */
#define DROGUE_ROWS_BYTES(width_px)                      \
    ((size_t)(width_px) * (sizeof(drogue_merge) + 16u) + \
     DROGUE_HALF(width_px) * (5u * 2u + 3u * 4u + 4u * 4u + 32u + 4u) + 5u * 4u + 7u * 8u)
#define DROGUE_SCRATCH_BYTES ((size_t)4608) /* that the outline, the candidates and the rays need at most */
#define DROGUE_BEST_BYTES ((size_t)520) /* the best of what is tried, wherever the memory begins: look.h checks it */

/* Bytes of memory for a workspace: usable in a static array's size. */
#define DROGUE_WORKSPACE_BYTES(width_px, edges, labels, arcs)                                                         \
    ((size_t)(edges) * sizeof(drogue_edge) + (size_t)(arcs) * sizeof(drogue_arc) + (size_t)(labels)*16u + 256u * 4u + \
     DROGUE_BEST_BYTES +                                                                                              \
     (DROGUE_ROWS_BYTES(width_px) > DROGUE_SCRATCH_BYTES ? DROGUE_ROWS_BYTES(width_px) : DROGUE_SCRATCH_BYTES))

/* The same for a region of the given longest side with the capacity that suits it. */
#define DROGUE_WORKSPACE_BYTES_FOR(side_px) \
    DROGUE_WORKSPACE_BYTES(side_px, DROGUE_EDGES_FOR(side_px), DROGUE_LABELS_FOR(side_px), DROGUE_ARCS_FOR(side_px))

struct drogue_point;        /* constraints.h */
struct drogue_outline_room; /* outline.h */
struct drogue_ray;          /* rays.h */
struct drogue_best_try;     /* src/look.h */

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
    struct drogue_best_try *best;        /* of what drogue_measure() tries; aligned for int64_t */
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

/* Bytes that drogue_workspace_init() needs; equals DROGUE_WORKSPACE_BYTES. Of a capacity within its ranges: the sum of
 * others may not fit a size_t. */
size_t drogue_workspace_bytes(const drogue_capacity *capacity);

/* Lay a workspace out in the caller's memory, which must live as long as the workspace.
 *
 *  workspace  out; zero where it is refused, which drogue_measure() answers with DROGUE_E_WORKSPACE
 *  memory     at least drogue_workspace_bytes(capacity) bytes, aligned for uint32_t
 *  return     DROGUE_OK, DROGUE_E_WORKSPACE (too few bytes), DROGUE_E_ARGUMENT (memory NULL or misaligned, capacity)
 */
drogue_status drogue_workspace_init(drogue_workspace *workspace, void *memory, size_t bytes,
                                    const drogue_capacity *capacity);

#ifdef __cplusplus
}
#endif
#endif
