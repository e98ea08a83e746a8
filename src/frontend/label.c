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
    uint32_t above = (p->code_above[x] & p->mask) == key ? p->above[x] : 0;
    uint32_t left;
    uint32_t above_left;
    uint32_t above_right;
    uint32_t merge_with;
    uint32_t label;
    if (above != 0) { /* whatever the others are */
        return above;
    }
    left = x > 0 && (p->code[x - 1] & p->mask) == key ? p->current[x - 1] : 0;
    above_left = x > 0 && (p->code_above[x - 1] & p->mask) == key ? p->above[x - 1] : 0;
    above_right = x + 1 < p->width_px && (p->code_above[x + 1] & p->mask) == key ? p->above[x + 1] : 0;
    label = drogue_label_choose(&merge_with, 0, left, above_left, above_right);
    if (merge_with != 0) {
        p->merges[p->merge_count].a = label;
        p->merges[p->merge_count].b = merge_with;
        p->merge_count++;
    }
    return label != 0 ? label : labels_new(p->labels);
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
        drogue_labels_resolve(labels->parent, merges, p.merge_count);
        for (i = 0; i < count; i++) {
            uint32_t *label = &current[points[i].x];
            *label = labels->parent[*label];
        }
    }
}

void drogue_labels_flatten(uint32_t *parent, uint32_t count)
{
    uint32_t i;
    for (i = 1; i < count; i++) {
        parent[i] = parent[parent[i]];
    }
}
