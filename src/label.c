/* SPDX-License-Identifier: Apache-2.0 */
/* Connected components in one raster pass. */
#include "drogue/label.h"

void drogue_labels_reset(drogue_labels *labels, uint32_t *parent, uint32_t capacity)
{
    labels->parent = parent;
    labels->capacity = capacity;
    labels->count = 1;
    labels->full = 0;
    parent[0] = 0;
}

uint32_t drogue_labels_find(drogue_labels *labels, uint32_t label)
{
    uint32_t *parent = labels->parent;
    while (parent[label] != label) { /* parents are smaller: at most 'count' steps */
        parent[label] = parent[parent[label]];
        label = parent[label];
    }
    return label;
}

static void labels_join(drogue_labels *labels, const drogue_merge *merge)
{
    uint32_t a = drogue_labels_find(labels, merge->a);
    uint32_t b = drogue_labels_find(labels, merge->b);
    if (a < b) {
        labels->parent[b] = a;
    } else {
        labels->parent[a] = b;
    }
}

static uint32_t labels_new(drogue_labels *labels)
{
    uint32_t label = labels->count;
    if (label >= labels->capacity) {
        labels->full = 1;
        return 0;
    }
    labels->parent[label] = label;
    labels->count++;
    return label;
}

/* What labelling a row works on. */
typedef struct label_pass {
    uint32_t *current;
    drogue_labels *labels;
    drogue_merge *merges;
    const uint32_t *above;
    const uint8_t *code;
    const uint8_t *code_above;
    uint32_t merge_count;
    int32_t width_px;
    uint8_t mask;
} label_pass;

/* Label of column x, whose key is not 0. */
static uint32_t label_pixel(label_pass *p, int32_t x, uint8_t key)
{
    uint32_t label = 0;
    uint32_t right = 0;
    if ((p->code_above[x] & p->mask) == key) {
        label = p->above[x]; /* left, above left and above right all touch it: they are joined already or will be */
        if (label != 0) {
            return label;
        }
    }
    if (x > 0 && (p->code[x - 1] & p->mask) == key) {
        label = p->current[x - 1];
    }
    if (label == 0 && x > 0 && (p->code_above[x - 1] & p->mask) == key) {
        label = p->above[x - 1];
    }
    if (x + 1 < p->width_px && (p->code_above[x + 1] & p->mask) == key) {
        right = p->above[x + 1];
    }
    if (label == 0) {
        return right != 0 ? right : labels_new(p->labels);
    }
    if (right != 0 && right != label) {
        p->merges[p->merge_count].a = label;
        p->merges[p->merge_count].b = right;
        p->merge_count++;
    }
    return label;
}

static void join_merges(label_pass *p)
{
    uint32_t i;
    for (i = 0; i < p->merge_count; i++) {
        labels_join(p->labels, &p->merges[i]);
    }
}

void drogue_label_row(uint32_t *current, drogue_labels *labels, drogue_merge *merges, const uint32_t *above,
                      const uint8_t *code, const uint8_t *code_above, uint8_t mask, int32_t width_px)
{
    label_pass p = {current, labels, merges, above, code, code_above, 0, width_px, mask};
    int32_t x;
    for (x = 0; x < width_px; x++) {
        uint8_t key = code[x] & mask;
        current[x] = key != 0 ? label_pixel(&p, x, key) : 0;
    }
    if (p.merge_count > 0) {
        join_merges(&p);
        for (x = 0; x < width_px; x++) {
            if (current[x] != 0) {
                current[x] = drogue_labels_find(labels, current[x]);
            }
        }
    }
}

void drogue_label_points(uint32_t *current, drogue_labels *labels, drogue_merge *merges, const uint32_t *above,
                         const uint8_t *code, const uint8_t *code_above, uint8_t mask, int32_t width_px,
                         const drogue_slope *points, uint32_t count)
{
    label_pass p = {current, labels, merges, above, code, code_above, 0, width_px, mask};
    uint32_t i;
    for (i = 0; i < count; i++) {
        int32_t x = points[i].x;
        uint8_t key = code[x] & mask;
        current[x] = key != 0 ? label_pixel(&p, x, key) : 0;
    }
    if (p.merge_count > 0) {
        join_merges(&p);
        for (i = 0; i < count; i++) {
            uint32_t *label = &current[points[i].x];
            if (*label != 0) {
                *label = drogue_labels_find(labels, *label);
            }
        }
    }
}

void drogue_labels_flatten(drogue_labels *labels)
{
    uint32_t i;
    for (i = 1; i < labels->count; i++) {
        labels->parent[i] = labels->parent[labels->parent[i]];
    }
}
