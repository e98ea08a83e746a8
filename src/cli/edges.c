/* SPDX-License-Identifier: Apache-2.0 */
/* drogue edges: Canny's edge map of the front end, every edge point of the list. */
#include <string.h>

#include "cli.h"
#include "commands.h"
#include "frame.h"
#include "images.h"

#define NO_ARCS UINT32_MAX /* no arc is that long: the arc table stays empty, the points are listed all the same */

static int find_edges(drogue_edge_list *list, frame_workspace *w, const options *o, const picture *grey)
{
    drogue_frontend frontend;
    drogue_frontend_config config;
    drogue_status status;
    int32_t y;
    memset(&config, 0, sizeof config);
    config.canny_low = o->canny_low;
    config.canny_high = o->canny_high;
    config.smooth = o->smooth;
    config.min_arc_px = NO_ARCS;
    status = drogue_frontend_begin(&frontend, &w->workspace, &config, grey->width_px, grey->height_px);
    if (status == DROGUE_OK) {
        for (y = 0; y < grey->height_px; y++) {
            drogue_frontend_row(&frontend, grey->data + (size_t)y * (size_t)grey->width_px);
        }
        status = drogue_frontend_end(list, &frontend);
    }
    return status == DROGUE_OK ? EXIT_MEASURED : complain(o->files[0], "edges: %s", drogue_status_name(status));
}

static int write_edges(const options *o, frame_workspace *w, picture *grey)
{
    drogue_edge_list list;
    uint32_t i;
    if (grey->width_px > DROGUE_MAX_SIDE || grey->height_px > DROGUE_MAX_SIDE) {
        return complain(o->files[0], "the image is %dx%d pixels, more than %d a side", grey->width_px, grey->height_px,
                        DROGUE_MAX_SIDE);
    }
    if (frame_workspace_fit(w, o->files[0], grey->width_px, grey->height_px, NO_ARCS) ||
        find_edges(&list, w, o, grey)) {
        return EXIT_BAD;
    }
    memset(grey->data, 0, (size_t)grey->width_px * (size_t)grey->height_px);
    for (i = 0; i < list.edge_count; i++) {
        const drogue_edge *e = &w->workspace.edges[i];
        grey->data[(size_t)drogue_edge_y_px(e) * (size_t)grey->width_px + (size_t)drogue_edge_x_px(e)] = 255;
    }
    return picture_write(grey, o->files[1]);
}

int command_edges(const options *o)
{
    frame_workspace w = {0};
    picture grey;
    int code;
    if (picture_read_grey(&grey, o->files[0])) {
        return EXIT_BAD;
    }
    code = write_edges(o, &w, &grey);
    frame_workspace_free(&w);
    picture_free(&grey);
    return code;
}
