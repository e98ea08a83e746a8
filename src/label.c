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

void drogue_label_row(uint32_t *current, drogue_labels *labels, drogue_merge *merges, const uint32_t *above,
                      const uint8_t *code, const uint8_t *code_above, uint8_t mask, int32_t width_px)
{
    int32_t merge_count = 0;
    int32_t x;
    for (x = 0; x < width_px; x++) {
        uint8_t key = code[x] & mask;
        uint32_t label = 0;
        if (key == 0) {
            current[x] = 0;
            continue;
        }
        if ((code_above[x] & mask) == key) {
            label = above[x]; /* left, above left and above right all touch it: they are joined already or will be */
        }
        if (label == 0) {
            uint32_t right = 0;
            if (x > 0 && (code[x - 1] & mask) == key) {
                label = current[x - 1];
            }
            if (label == 0 && x > 0 && (code_above[x - 1] & mask) == key) {
                label = above[x - 1];
            }
            if (x + 1 < width_px && (code_above[x + 1] & mask) == key) {
                right = above[x + 1];
            }
            if (label == 0) {
                label = right != 0 ? right : labels_new(labels);
            } else if (right != 0 && right != label) {
                merges[merge_count].a = label;
                merges[merge_count].b = right;
                merge_count++;
            }
        }
        current[x] = label;
    }
    if (merge_count > 0) {
        int32_t i;
        for (i = 0; i < merge_count; i++) {
            labels_join(labels, &merges[i]);
        }
        for (x = 0; x < width_px; x++) {
            if (current[x] != 0) {
                current[x] = drogue_labels_find(labels, current[x]);
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
