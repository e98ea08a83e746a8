/* SPDX-License-Identifier: Apache-2.0 */
/* Connected components in one raster pass: a union-find over row labels, used for Canny's hysteresis and for
 * arcs within a direction class.
 *
 * The pixel loop does bounded work a pixel: it looks only at labels of the row above, which are roots, and
 * notes at most one merge. Merges are resolved at the end of the row, in two steps each: no chain is ever followed. */
#ifndef DROGUE_LABEL_H
#define DROGUE_LABEL_H

#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Union-find over labels 1 .. count - 1; label 0 means none. The root of a component is its smallest label,
 * that is the one whose first pixel comes first in raster order. */
typedef struct drogue_labels {
    uint32_t *parent;  /* capacity words; parent[i] <= i */
    uint32_t capacity; /* labels 1 .. capacity - 1 can be given */
    uint32_t count;    /* labels given so far + 1 */
    uint32_t full;     /* 1 after a label was refused: that pixel's label is 0 */
} drogue_labels;

/* Two labels of one component, found in a row. */
typedef struct drogue_merge {
    uint32_t a; /* one label */
    uint32_t b; /* the other one */
} drogue_merge;

/* Start with no label given; capacity >= 1. */
void drogue_labels_reset(drogue_labels *labels, uint32_t *parent, uint32_t capacity);

/* Label of a pixel by those of its neighbours: of the same key, 0 for none.
 *
 *  merge_with  out: label of the same component as the one returned, or 0
 *  return      the label; 0 when the pixel needs a new one
 */
static inline uint32_t drogue_label_choose(uint32_t *merge_with, uint32_t above, uint32_t left, uint32_t above_left,
                                           uint32_t above_right)
{
    const uint32_t label = left != 0 ? left : above_left;
    /* Left, above left and above right all touch the one above: they are joined already or will be. */
    *merge_with = ((above == 0) & (label != 0) & (above_right != label)) ? above_right : 0;
    return above != 0 ? above : label != 0 ? label : above_right;
}

/* What the last two steps of drogue_labels_resolve() wrote. */
typedef struct drogue_recent_parents {
    uint32_t label[2];  /* the last first */
    uint32_t parent[2]; /* what was written there */
} drogue_recent_parents;

/* Parent of a label, through what was just written. */
static inline uint32_t drogue_parent_of(const uint32_t *parent, const drogue_recent_parents *recent, uint32_t label)
{
    const uint32_t last = 0u - (uint32_t)(label == recent->label[0]); /* masks: no branch about the look */
    const uint32_t before = 0u - (uint32_t)(label == recent->label[1]);
    return (recent->parent[0] & last) | (((recent->parent[1] & before) | (parent[label] & ~before)) & ~last);
}

/* Write a parent and remember it. */
static inline void drogue_set_parent(uint32_t *parent, drogue_recent_parents *recent, uint32_t label, uint32_t to)
{
    recent->label[1] = recent->label[0];
    recent->parent[1] = recent->parent[0];
    recent->label[0] = label;
    recent->parent[0] = to;
    parent[label] = to;
}

/* Resolve the merges of a row: after it every label that occurs in them points straight at its root.
 *
 *  parent  in/out; labels of the row above are roots, and so are new ones
 *  merges  in the order of the row; overwritten
 *
 * One look at the table a label is enough, because components do not cross: those merged so far to the left of a pixel
 * are never met again through a label two steps from its root (Bailey and Johnston 2007). What the last two steps wrote
 * is taken from registers, so that a table of one cycle's latency serves a step a cycle in hardware.
 */
static inline void drogue_labels_resolve(uint32_t *parent, drogue_merge *merges, uint32_t count)
{
    drogue_recent_parents recent = {{0, 0}, {0, 0}};
    uint32_t i;
    for (i = 0; i < count; i++) {
        uint32_t a = drogue_parent_of(parent, &recent, merges[i].a);
        uint32_t b = drogue_parent_of(parent, &recent, merges[i].b);
        merges[i].a = a < b ? a : b;
        merges[i].b = a < b ? b : a;
        drogue_set_parent(parent, &recent, merges[i].b, merges[i].a);
    }
    for (i = count; i > 0; i--) { /* a root that lost its place later has its own root by now */
        drogue_set_parent(parent, &recent, merges[i - 1].b, drogue_parent_of(parent, &recent, merges[i - 1].a));
    }
}

/* Point every label straight at its root: after it parent[i] is the root of i. What a caller has summed
 * by label over the rows it then joins in one ascending pass, into parent[i] from i. */
void drogue_labels_flatten(uint32_t *parent, uint32_t count);

#ifdef __cplusplus
}
#endif
#endif
