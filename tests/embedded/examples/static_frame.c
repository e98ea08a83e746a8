/* SPDX-License-Identifier: Apache-2.0 */
/* One frame in static memory: everything is sized at compile time, nothing is allocated. */
#include <stdio.h>

#include "drogue/drogue.h"
#include "frames.h" /* in place of a camera: the frame 'demo', compiled in */

#define SIDE_PX FRAMES_SIDE_PX /* longest side of a region */

static uint32_t memory[DROGUE_WORKSPACE_BYTES_FOR(SIDE_PX) / 4 + 1];
static drogue_workspace workspace;
static drogue_config config;
static drogue_result result;

static long milli(drogue_q16 value) { return (long)drogue_shr_round_s64((int64_t)value * 1000, 16); }

static void print_pose(const drogue_pose *pose)
{
    printf("position %ld %ld %ld mm, axis %ld %ld %ld / 1000\n", milli(pose->position_m_q16[0]),
           milli(pose->position_m_q16[1]), milli(pose->position_m_q16[2]), milli(pose->axis_q16[0]),
           milli(pose->axis_q16[1]), milli(pose->axis_q16[2]));
}

int main(void)
{
    const drogue_capacity capacity = DROGUE_CAPACITY_FOR(SIDE_PX);
    const frame *demo = frame_demo;
    /* Where to look: the drogue about the middle, the longest side 2 to 3 of its semi-axes. */
    const drogue_region region = {0, 0, demo->image.width_px, demo->image.height_px};
    const drogue_setup setup = {&demo->camera, &demo->model, &config};
    drogue_status status = drogue_workspace_init(&workspace, memory, sizeof memory, &capacity);
    if (status == DROGUE_OK) {
        drogue_config_default(&config);
        status = drogue_measure(&result, &workspace, &setup, &demo->image, &region);
    }
    printf("status %s\n", drogue_status_name(status));
    if (status != DROGUE_OK) {
        return 1;
    }
    print_pose(&result.pose);
    printf("%s\n", result.orientation_resolved ? "the inner part decided between two poses" : "or its mirror pose");
    return 0;
}
