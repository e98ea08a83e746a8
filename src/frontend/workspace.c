/* SPDX-License-Identifier: Apache-2.0 */
/* Layout of line buffers, tables and lists in the caller's memory. */
#include "drogue/frontend.h"

static int capacity_valid(const drogue_capacity *c)
{
    const uint32_t most = (uint32_t)1 << 24;
    return c->width_px >= 1 && c->width_px <= DROGUE_MAX_SIDE && c->edges >= 1 && c->edges <= most && c->labels >= 2 &&
           c->labels <= most && c->arcs >= 1 && c->arcs <= most;
}

size_t drogue_workspace_bytes(const drogue_capacity *capacity)
{
    return DROGUE_WORKSPACE_BYTES(capacity->width_px, capacity->edges, capacity->labels, capacity->arcs);
}

/* No region fits in afterwards: who does not look at the status is told by the next call. */
static drogue_status refuse(drogue_workspace *workspace, drogue_status why)
{
    const drogue_workspace none = {0};
    *workspace = none;
    return why;
}

drogue_status drogue_workspace_init(drogue_workspace *workspace, void *memory, size_t bytes,
                                    const drogue_capacity *capacity)
{
    uint8_t *at = memory;
    size_t width;
    size_t half;
    size_t labels;
    if (!capacity_valid(capacity) || memory == NULL || ((uintptr_t)memory & (sizeof(uint32_t) - 1)) != 0) {
        return refuse(workspace, DROGUE_E_ARGUMENT);
    }
    if (bytes < drogue_workspace_bytes(capacity)) {
        return refuse(workspace, DROGUE_E_WORKSPACE);
    }
    width = capacity->width_px;
    half = DROGUE_HALF(width);
    labels = capacity->labels;
    workspace->capacity = *capacity;
    /* Widest elements first: every array is aligned for its type. */
    workspace->edges = (drogue_edge *)(void *)at;
    at += capacity->edges * sizeof(drogue_edge);
    workspace->arcs = (drogue_arc *)(void *)at;
    at += capacity->arcs * sizeof(drogue_arc);
    workspace->component_parent = (uint32_t *)(void *)at;
    at += labels * sizeof(uint32_t);
    workspace->component_strong = (uint32_t *)(void *)at;
    at += labels * sizeof(uint32_t);
    workspace->arc_parent = (uint32_t *)(void *)at;
    at += labels * sizeof(uint32_t);
    workspace->arc_component = (uint32_t *)(void *)at;
    at += labels * sizeof(uint32_t);
    workspace->histogram = (uint32_t *)(void *)at;
    at += 256 * sizeof(uint32_t);
    workspace->best = (struct drogue_best_try *)(void *)(at + ((uintptr_t)at & 4u));
    at += DROGUE_BEST_BYTES;
    workspace->hull = (struct drogue_point *)(void *)at; /* the rows have served when it comes */
    workspace->outline = (struct drogue_outline_room *)(void *)(at + ((uintptr_t)at & 4u));
    workspace->rays = (struct drogue_ray *)(void *)at;
    workspace->merges = (drogue_merge *)(void *)at;
    at += width * sizeof(drogue_merge);
    workspace->component_rows = (uint32_t *)(void *)at;
    at += 2 * width * sizeof(uint32_t);
    workspace->arc_rows = (uint32_t *)(void *)at;
    at += 2 * width * sizeof(uint32_t);
    workspace->raw_rows = at;
    at += 5 * (2 * half + 4);
    workspace->smooth_rows = at;
    at += 3 * 4 * (half + 2);
    workspace->magnitude_rows = (uint16_t *)(void *)at;
    at += 4 * 4 * (half + 2);
    workspace->slope_rows = (drogue_slope *)(void *)at;
    at += 4 * half * sizeof(drogue_slope);
    workspace->code_rows = at;
    return DROGUE_OK;
}

drogue_status drogue_frontend_check(const drogue_workspace *workspace, const drogue_frontend_config *config,
                                    int32_t width_px, int32_t height_px)
{
    if (config->canny_low < 0 || config->canny_high < config->canny_low ||
        (config->use_ring && !drogue_mask_valid(&config->ring))) {
        return DROGUE_E_ARGUMENT;
    }
    if (width_px < 1 || width_px > DROGUE_MAX_SIDE || height_px < 1 || height_px > DROGUE_MAX_SIDE) {
        return DROGUE_E_REGION;
    }
    if ((uint32_t)width_px > workspace->capacity.width_px) {
        return DROGUE_E_WORKSPACE;
    }
    return DROGUE_OK;
}

void drogue_clip(int32_t *at, int32_t *length, int32_t limit)
{
    const int64_t end = (int64_t)*at + *length;
    const int32_t most = limit > 0 ? limit : 0;
    const int32_t from = *at < 0 ? 0 : *at > most ? most : *at;
    const int32_t to = end < from ? from : end > most ? most : (int32_t)end;
    *at = from;
    *length = to - from;
}

int drogue_workspace_spans(const drogue_workspace *workspace, const drogue_region *region, const drogue_image *image)
{
    int32_t x_px = region->x_px;
    int32_t width_px = region->width_px;
    drogue_clip(&x_px, &width_px, image->width_px);
    return (uint32_t)width_px <= workspace->capacity.width_px;
}

void drogue_workspace_narrow(drogue_region *region, const drogue_workspace *workspace, const drogue_image *image)
{
    const int32_t most = (int32_t)workspace->capacity.width_px;
    if (region->width_px > most && !drogue_workspace_spans(workspace, region, image)) {
        const int32_t half = (region->width_px - most) / 2;
        region->x_px = drogue_sat_s32((int64_t)region->x_px + half);
        region->y_px = drogue_sat_s32((int64_t)region->y_px + half);
        region->width_px = most;
        region->height_px = most;
    }
}
