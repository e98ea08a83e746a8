/* SPDX-License-Identifier: Apache-2.0 */
/* A workspace in guarded memory, and a whole image through the front end; C99 and C++17. */
#ifndef DROGUE_TESTS_WORKSPACE_H
#define DROGUE_TESTS_WORKSPACE_H

#include "common.h"

#include "drogue/frontend.h"

typedef struct test_workspace {
    guarded memory;
    drogue_workspace workspace;
} test_workspace;

static inline test_workspace test_workspace_of(uint32_t width_px, uint32_t edges, uint32_t labels, uint32_t arcs)
{
    test_workspace t;
    drogue_capacity capacity;
    capacity.width_px = width_px;
    capacity.edges = edges;
    capacity.labels = labels;
    capacity.arcs = arcs;
    t.memory = guarded_alloc(drogue_workspace_bytes(&capacity));
    if (drogue_workspace_init(&t.workspace, t.memory.data, t.memory.bytes, &capacity) != DROGUE_OK) {
        abort();
    }
    return t;
}

/* Enough for any image of the size: with arcs of a single point, too. */
static inline test_workspace test_workspace_ample(int32_t width_px, int32_t height_px)
{
    drogue_capacity any;
    drogue_capacity_for_any(&any, width_px, height_px, 1);
    return test_workspace_of(any.width_px, any.edges, any.labels, any.arcs);
}

static inline void test_workspace_free(test_workspace *t) { guarded_free(&t->memory); }

static inline drogue_status frontend_run(drogue_edge_list *list, drogue_workspace *workspace,
                                         const drogue_frontend_config *config, const uint8_t *pixels, int32_t width_px,
                                         int32_t height_px)
{
    drogue_frontend frontend;
    drogue_status status = drogue_frontend_begin(&frontend, workspace, config, width_px, height_px);
    int32_t y;
    if (status != DROGUE_OK) {
        list->edge_count = 0;
        list->arc_count = 0;
        return status;
    }
    for (y = 0; y < height_px; y++) {
        drogue_frontend_row(&frontend, pixels + (size_t)y * (size_t)width_px);
    }
    return drogue_frontend_end(list, &frontend);
}

#endif
