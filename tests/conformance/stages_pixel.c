/* SPDX-License-Identifier: Apache-2.0 */
/* Adapters of the stages that read an image: smooth to arcs. */
#include "stage_run.h"

#include <string.h>

int stage_smooth(stage_run *r)
{
    const drogue_image image = r->image;
    uint8_t *out = stage_output_image(r, "image", image.width_px, image.height_px);
    uint16_t *column = (uint16_t *)stage_take(r, (size_t)image.width_px * sizeof *column);
    if (out == NULL || column == NULL) {
        return CONF_E_MEMORY;
    }
    return drogue_smooth_image(out, column, &image) == DROGUE_OK ? 0 : CONF_E_MALFORMED;
}

int stage_gradient(stage_run *r)
{
    const drogue_image image = r->image;
    size_t count = r->in[0].count;
    int16_t *gx = (int16_t *)stage_output(r, "gx", 16, count);
    int16_t *gy = (int16_t *)stage_output(r, "gy", 16, count);
    uint16_t *magnitude = (uint16_t *)stage_take(r, count * sizeof *magnitude);
    if (gx == NULL || gy == NULL || magnitude == NULL) {
        return CONF_E_MEMORY;
    }
    return drogue_gradient_image(gx, gy, magnitude, &image) == DROGUE_OK ? 0 : CONF_E_MALFORMED;
}

static drogue_status run_frontend(drogue_edge_list *list, drogue_workspace *workspace,
                                  const drogue_frontend_config *config, const drogue_image *image)
{
    drogue_frontend frontend;
    drogue_status status = drogue_frontend_begin(&frontend, workspace, config, image->width_px, image->height_px);
    int32_t y;
    if (status != DROGUE_OK) {
        return status;
    }
    for (y = 0; y < image->height_px; y++) {
        drogue_frontend_row(&frontend, drogue_image_row(image, y));
    }
    return drogue_frontend_end(list, &frontend);
}

int stage_canny(stage_run *r)
{
    const drogue_image image = r->image;
    const int32_t *p = stage_input32(r, 1);
    uint8_t *map = stage_output_image(r, "map", image.width_px, image.height_px);
    drogue_workspace workspace;
    drogue_frontend_config config;
    drogue_edge_list list;
    drogue_status status;
    uint32_t i;
    if (map == NULL || !stage_workspace(r, &workspace, image.width_px)) {
        return CONF_E_MEMORY;
    }
    memset(&config, 0, sizeof config);
    config.canny_low = p[0];
    config.canny_high = p[1];
    config.smooth = p[2];
    config.min_arc_px = UINT32_MAX; /* the arc table stays empty and cannot fill */
    status = run_frontend(&list, &workspace, &config, &image);
    if (status != DROGUE_OK) { /* thresholds out of order, or a table is full */
        return status == DROGUE_E_ARGUMENT ? CONF_E_MALFORMED : CONF_E_MEMORY;
    }
    memset(map, 0, r->in[0].count);
    for (i = 0; i < list.edge_count; i++) {
        const drogue_edge *e = &workspace.edges[i];
        map[(size_t)drogue_edge_y_px(e) * (size_t)image.width_px + (size_t)drogue_edge_x_px(e)] = 255;
    }
    return 0;
}

int stage_mask_images(stage_run *r)
{
    const int32_t *p = stage_input32(r, 0);
    drogue_mask mask;
    uint8_t *ring;
    int32_t x;
    int32_t y;
    if (p[0] < 1 || p[0] > DROGUE_MAX_SIDE || p[1] < 1 || p[1] > DROGUE_MAX_SIDE || !stage_mask(&mask, p + 2)) {
        return CONF_E_MALFORMED;
    }
    ring = stage_output_image(r, "ring", p[0], p[1]);
    if (ring == NULL) {
        return CONF_E_MEMORY;
    }
    for (y = 0; y < p[1]; y++) {
        for (x = 0; x < p[0]; x++) {
            *ring++ = drogue_mask_in_ring(&mask, x, y) ? 255 : 0;
        }
    }
    return 0;
}

int stage_arcs(stage_run *r)
{
    const drogue_image image = r->image;
    const int32_t *p = stage_input32(r, 1);
    drogue_workspace workspace;
    drogue_frontend_config config;
    drogue_edge_list list;
    drogue_status status;
    int32_t *arcs;
    int32_t *edges;
    uint32_t i;
    config.canny_low = p[0];
    config.canny_high = p[1];
    config.smooth = p[2];
    config.use_ring = p[3];
    config.min_arc_px = (uint32_t)p[7];
    if (!stage_mask(&config.ring, p + 4) || p[7] < 0) {
        return CONF_E_MALFORMED;
    }
    if (!stage_workspace(r, &workspace, image.width_px)) {
        return CONF_E_MEMORY;
    }
    status = run_frontend(&list, &workspace, &config, &image);
    if (status != DROGUE_OK) {
        list.edge_count = list.arc_count = 0;
    }
    arcs = stage_output32(r, "arcs", 3 + 4 * (size_t)list.edge_count);
    edges = stage_output32(r, "edges", 4 * (size_t)list.edge_count);
    if (arcs == NULL || edges == NULL) {
        return CONF_E_MEMORY;
    }
    *arcs++ = (int32_t)status;
    *arcs++ = (int32_t)list.edge_count;
    *arcs++ = (int32_t)list.arc_count;
    for (i = 0; i < list.edge_count; i++) {
        const drogue_edge *e = &workspace.edges[i];
        *arcs++ = drogue_edge_x_px(e);
        *arcs++ = drogue_edge_y_px(e);
        *arcs++ = (int32_t)drogue_direction_class(e->gx, e->gy);
        *arcs++ = e->arc == DROGUE_NO_ARC ? -1 : (int32_t)e->arc;
        *edges++ = e->x_q5;
        *edges++ = e->y_q5;
        *edges++ = e->gx;
        *edges++ = e->gy;
    }
    return 0;
}
