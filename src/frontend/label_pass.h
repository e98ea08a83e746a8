/* SPDX-License-Identifier: Apache-2.0 */
/* Label of a pixel from those about it, for every pass over a row of labels. */
#ifndef DROGUE_LABEL_PASS_H
#define DROGUE_LABEL_PASS_H

#include "drogue/label.h"

/* What labelling a row works on. */
typedef struct drogue_label_pass {
    const uint32_t *above; /* labels of the row above: their parents are roots */
    uint32_t *current;     /* of the row, as given */
    uint32_t *parent;
    drogue_merge *merge; /* where the next merge is noted */
    int32_t merge_step;
    int32_t last_px; /* last column */
    uint8_t mask;    /* the key's bits in a code */
} drogue_label_pass;

static inline drogue_label_pass drogue_label_pass_of(const drogue_labels *labels, uint32_t *current,
                                                     const uint32_t *above, drogue_merge *merge, int32_t merge_step,
                                                     int32_t width_px, uint8_t mask)
{
    drogue_label_pass p;
    p.above = above;
    p.current = current;
    p.parent = labels->parent;
    p.merge = merge;
    p.merge_step = merge_step;
    p.last_px = width_px - 1;
    p.mask = mask;
    return p;
}

static inline uint32_t drogue_label_above(const drogue_label_pass *p, const uint8_t *code_above, int32_t x, uint8_t key)
{
    return (code_above[x] & p->mask) == key ? p->parent[p->above[x]] : 0;
}

static inline uint32_t drogue_label_new(drogue_labels *labels)
{
    const uint32_t label = labels->count;
    if (label >= labels->capacity) {
        labels->full = 1;
        return 0;
    }
    labels->parent[label] = label;
    labels->count++;
    return label;
}

/* Label column x, whose key is not 0, and note the merge that it brings. Returns the label, 0 when the table is
 * full. */
static inline uint32_t drogue_label_pixel(drogue_label_pass *p, drogue_labels *labels, const uint8_t *code,
                                          const uint8_t *code_above, int32_t x)
{
    const uint8_t key = code[x] & p->mask;
    uint32_t label = drogue_label_above(p, code_above, x, key);
    if (label == 0) { /* or else it does not matter what the others are */
        const uint32_t left = x > 0 && (code[x - 1] & p->mask) == key ? p->current[x - 1] : 0;
        const uint32_t above_left = x > 0 ? drogue_label_above(p, code_above, x - 1, key) : 0;
        const uint32_t above_right = x < p->last_px ? drogue_label_above(p, code_above, x + 1, key) : 0;
        uint32_t merge_with;
        label = drogue_label_choose(&merge_with, 0, left, above_left, above_right);
        if (label == 0) {
            label = drogue_label_new(labels);
        } else if (merge_with != 0) {
            p->merge->a = label;
            p->merge->b = merge_with;
            p->merge += p->merge_step;
        }
    }
    p->current[x] = label;
    return label;
}

#endif
