/* SPDX-License-Identifier: Apache-2.0 */
/* Line by line from the camera's DMA into the front end: there is never a picture in memory, only two lines, one being
 * filled while the other is worked on. The inner part is looked for in a picture, so here both poses remain
 * (docs/porting.md). */
#include <stdio.h>
#include <string.h>

#include "drogue/drogue.h"
#include "frames.h" /* in place of a camera: the frame 'demo', compiled in */

static uint32_t memory[DROGUE_WORKSPACE_BYTES_FOR(FRAMES_SIDE_PX) / 4 + 1];
static drogue_workspace workspace;
static drogue_frontend frontend;
/* What the DMA fills in turn. On a board with a data cache: in memory that is not cached, or aligned to its lines and
 * invalidated after each wait. */
static uint8_t line[2][FRAMES_SIDE_PX];

/* On a board: point the camera interface's DMA at the line, within the region's columns, and return at once. */
static void dma_start(uint8_t *to, const drogue_image *camera, int32_t y)
{
    memcpy(to, drogue_image_row(camera, y), (size_t)camera->width_px);
}

/* On a board: sleep until the DMA's interrupt. */
static void dma_wait(void) {}

/* Points an arc needs, as drogue_measure() has it. */
static uint32_t least_arc(const drogue_config *config, const drogue_mask *mask)
{
    const uint32_t share = (uint32_t)drogue_shr_round_s64((int64_t)config->min_arc_share_q16 * mask->longest_px, 16);
    return share > config->min_arc_px ? share : config->min_arc_px;
}

/* Rows in, edge points and arcs out. */
static drogue_status stream(drogue_edge_list *list, const drogue_config *config, const drogue_mask *mask,
                            const drogue_image *camera)
{
    const drogue_frontend_config front = {
        .canny_low = config->canny_low,
        .canny_high = config->canny_high,
        .smooth = config->smooth,
        .use_ring = 1,
        .ring = *mask,
        .min_arc_px = least_arc(config, mask),
    };
    drogue_status status = drogue_frontend_begin(&frontend, &workspace, &front, camera->width_px, camera->height_px);
    int32_t y;
    if (status != DROGUE_OK) {
        return status;
    }
    dma_start(line[0], camera, 0);
    for (y = 0; y < camera->height_px; y++) {
        dma_wait();
        if (y + 1 < camera->height_px) {
            dma_start(line[(y + 1) & 1], camera, y + 1);
        }
        drogue_frontend_row(&frontend, line[y & 1]);
    }
    return drogue_frontend_end(list, &frontend);
}

static long milli(drogue_q16 value) { return (long)drogue_shr_round_s64((int64_t)value * 1000, 16); }

static void print_pose(const drogue_pose *pose)
{
    printf("position %ld %ld %ld mm, axis %ld %ld %ld / 1000\n", milli(pose->position_m_q16[0]),
           milli(pose->position_m_q16[1]), milli(pose->position_m_q16[2]), milli(pose->axis_q16[0]),
           milli(pose->axis_q16[1]), milli(pose->axis_q16[2]));
}

int main(void)
{
    static drogue_config config;
    static drogue_outline outline;
    static drogue_pose poses[2];
    const drogue_capacity capacity = DROGUE_CAPACITY_FOR(FRAMES_SIDE_PX);
    const frame *demo = frame_demo;
    const drogue_setup setup = {&demo->camera, &demo->model, &config};
    /* Where the lines lie in the image that the camera's principal point counts in: frames.h has moved that to them. */
    const drogue_region region = {0, 0, demo->image.width_px, demo->image.height_px};
    const drogue_mask mask = drogue_mask_of_size(region.width_px, region.height_px);
    drogue_edge_list list;
    drogue_ellipse ideal; /* px of that image, without the lens */
    drogue_status status = drogue_workspace_init(&workspace, memory, sizeof memory, &capacity);
    drogue_config_default(&config);
    if (status == DROGUE_OK) {
        status = stream(&list, &config, &mask, &demo->image);
    }
    if (status == DROGUE_OK) {
        status = drogue_outline_find(&outline, &workspace, &list, &mask, &config);
    }
    if (status == DROGUE_OK) {
        status = drogue_outline_undistorted(&ideal, &outline, &workspace, &list, &setup, region.x_px, region.y_px);
    }
    if (status == DROGUE_OK) {
        status = drogue_pose_from_ellipse(poses, &ideal, &demo->camera, demo->model.rim_radius_m_q16);
    }
    printf("status %s\n", drogue_status_name(status));
    if (status != DROGUE_OK) {
        return 1;
    }
    print_pose(&poses[0]);
    print_pose(&poses[1]);
    return 0;
}
