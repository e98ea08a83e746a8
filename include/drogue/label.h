/* SPDX-License-Identifier: Apache-2.0 */
/* Connected components in one raster pass: a union-find over row labels, used for Canny's hysteresis, for
 * arcs within a direction class and for the dark parts.
 *
 * The pixel loop does bounded work a pixel: it looks only at labels of the row above, which are roots, and
 * notes at most one merge. Merges are resolved at the end of the row. */
#ifndef DROGUE_LABEL_H
#define DROGUE_LABEL_H

#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Union-find over labels 1..count; label 0 means none. The root of a component is its smallest label,
 * that is the one whose first pixel comes first in raster order. */
typedef struct drogue_labels {
    uint32_t *parent;  /* capacity words; parent[i] <= i */
    uint32_t capacity; /* labels 1 .. capacity - 1 can be given */
    uint32_t count;    /* labels given so far + 1 */
    uint32_t full;     /* 1 after a label was refused: that pixel's label is 0 */
} drogue_labels;

/* Two labels of one component, found in a row. */
typedef struct drogue_merge {
    uint32_t a;
    uint32_t b;
} drogue_merge;

/* Start with no label given; capacity >= 1. */
void drogue_labels_reset(drogue_labels *labels, uint32_t *parent, uint32_t capacity);

/* Root of a label. */
uint32_t drogue_labels_find(drogue_labels *labels, uint32_t label);

/* Label one row: 8-connected pixels of equal key share a component. A pixel's key is code & mask; key 0 is background.
 *
 *  current   out, width_px labels, each a root when the call returns; 0 for background
 *  labels    in/out
 *  merges    work area, width_px entries: at most one merge a pixel
 *  above     labels of the row above as this function left them; zeros for the first row
 *  code      width_px codes; code_above those of the row above, zeros for the first row
 */
void drogue_label_row(uint32_t *current, drogue_labels *labels, drogue_merge *merges, const uint32_t *above,
                      const uint8_t *code, const uint8_t *code_above, uint8_t mask, int32_t width_px);

/* The same for a row of few pixels: 'points' names the 'count' columns, ascending, where 'code' is not 0.
 * Only theirs are read and written of the rows of labels. */
void drogue_label_points(uint32_t *current, drogue_labels *labels, drogue_merge *merges, const uint32_t *above,
                         const uint8_t *code, const uint8_t *code_above, uint8_t mask, int32_t width_px,
                         const drogue_slope *points, uint32_t count);

/* Point every label straight at its root: after it parent[i] is the root of i. What a caller has summed
 * by label over the rows it then joins in one ascending pass, into parent[i] from i. */
void drogue_labels_flatten(drogue_labels *labels);

#ifdef __cplusplus
}
#endif
#endif
