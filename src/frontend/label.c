/* SPDX-License-Identifier: Apache-2.0 */
/* Connected components in one raster pass. */
#include "label_pass.h"

void drogue_labels_reset(drogue_labels *labels, uint32_t *parent, uint32_t capacity)
{
    labels->parent = parent;
    labels->capacity = capacity;
    labels->count = 1;
    labels->full = 0;
    parent[0] = 0;
}

void drogue_label_points(uint32_t *current, drogue_labels *labels, drogue_merge *merges, const uint32_t *above,
                         const uint8_t *code, const uint8_t *code_above, uint8_t mask, int32_t width_px,
                         const drogue_slope *points, uint32_t count)
{
    drogue_label_pass p = drogue_label_pass_of(labels, current, above, merges, 1, width_px, mask);
    uint32_t i;
    for (i = 0; i < count; i++) {
        const int32_t x = points[i].x;
        if ((code[x] & mask) != 0) {
            (void)drogue_label_pixel(&p, labels, code, code_above, x);
        } else {
            current[x] = 0;
        }
    }
    if (p.merge > merges) {
        drogue_labels_resolve(labels->parent, merges, (uint32_t)(p.merge - merges));
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
