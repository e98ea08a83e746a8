/* SPDX-License-Identifier: Apache-2.0 */
/* A frame of the golden vectors: what the firmware measure.c is told by the camera's way before the image, and what it then does,
 * which the bench does as well. */
#ifndef DROGUE_SYSTEM_ORDER_H
#define DROGUE_SYSTEM_ORDER_H

#include "drogue/measure.h"

enum { WIDEST = 256 };

typedef struct order {
    drogue_camera camera;
    drogue_model model;
    drogue_region region;
    int32_t width_px; /* of the image */
    int32_t height_px;
} order;

static inline void order_measure(drogue_result *result, const order *o, const uint8_t *pixels)
{
    static const drogue_capacity capacity = DROGUE_CAPACITY_FOR(WIDEST);
    static uint32_t memory[DROGUE_WORKSPACE_BYTES_FOR(WIDEST) / 4 + 1];
    const drogue_image image = {pixels, o->width_px, o->height_px, o->width_px};
    drogue_workspace workspace;
    drogue_config config;
    const drogue_setup setup = {&o->camera, &o->model, &config};
    drogue_config_default(&config);
    if (drogue_workspace_init(&workspace, memory, sizeof memory, &capacity) == DROGUE_OK) {
        (void)drogue_measure(result, &workspace, &setup, &image, &o->region);
    }
}

#endif
