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

void drogue_labels_flatten(uint32_t *parent, uint32_t count)
{
    uint32_t i;
    for (i = 1; i < count; i++) {
        parent[i] = parent[parent[i]];
    }
}
