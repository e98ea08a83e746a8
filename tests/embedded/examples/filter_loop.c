/* SPDX-License-Identifier: Apache-2.0 */
/* Following the drogue at 25 frames a second: the filter places each frame's region and carries the estimate through
 * frames in which nothing is found. The drogue drifts to the right; frames 6 to 8 of the twelve show a cloud. */
#include <stdio.h>
#include <string.h>

#include "drogue/track.h"
#include "frames.h" /* in place of a camera: the frame 'demo', compiled in */

#define FRAMES 12
#define FRAME_US 40000u

static uint32_t memory[DROGUE_WORKSPACE_BYTES_FOR(FRAMES_SIDE_PX) / 4 + 1];
static uint8_t cloud[FRAMES_SIDE_PX * FRAMES_SIDE_PX];
static drogue_workspace workspace;
static drogue_track track;
static drogue_result result;

static long milli(drogue_q16 value) { return (long)drogue_shr_round_s64((int64_t)value * 1000, 16); }

/* The camera's next picture: a view that moves to the left by a pixel a frame. */
static drogue_image capture(int number)
{
    drogue_image image = frame_demo->image;
    image.width_px -= FRAMES;
    image.data = number >= 6 && number <= 8 ? cloud : image.data + FRAMES - number;
    return image;
}

int main(void)
{
    const drogue_capacity capacity = DROGUE_CAPACITY_FOR(FRAMES_SIDE_PX);
    const drogue_region first = {0, 0, frame_demo->image.width_px - FRAMES, frame_demo->image.height_px};
    drogue_track_config following;
    drogue_track_estimate estimate;
    drogue_config config;
    int number, coasted = 0;
    if (drogue_workspace_init(&workspace, memory, sizeof memory, &capacity) != DROGUE_OK) {
        return 1;
    }
    memset(cloud, 200, sizeof cloud);
    drogue_config_default(&config);
    drogue_track_config_default(&following);
    following.max_region_px = FRAMES_SIDE_PX; /* what the workspace holds */
    if (drogue_track_init(&track, &following, &frame_demo->camera, &frame_demo->model, &first) != DROGUE_OK) {
        return 1;
    }
    for (number = 1; number <= FRAMES; number++) {
        drogue_image image = capture(number);
        drogue_region region;
        drogue_track_begin(&region, &track, FRAME_US);
        (void)drogue_measure(&result, &workspace, &(drogue_setup){&frame_demo->camera, &frame_demo->model, &config},
                             &image, &region);
        coasted += drogue_track_end(&track, &result) == DROGUE_COASTING; /* it reads result.status */
        drogue_track_get(&estimate, &track);
        printf("frame %2d: %-10s %-8s position %ld %ld %ld mm\n", number, drogue_status_name(result.status),
               drogue_track_state_name(track.state), milli(estimate.position_m_q16[0]),
               milli(estimate.position_m_q16[1]), milli(estimate.position_m_q16[2]));
    }
    return track.state == DROGUE_TRACKING && coasted == 3 ? 0 : 1;
}
