/* SPDX-License-Identifier: Apache-2.0 */
/* One frame: an image, its camera, the drogue, where to look; the pose, and how long it took. */
#include <stdio.h>

#include "board.h"
#include "drogue/drogue.h"

#define SIDE_PX 256 /* of the image, and longest side of a region */

static uint8_t pixels[SIDE_PX * SIDE_PX];
static uint32_t memory[DROGUE_WORKSPACE_BYTES_FOR(SIDE_PX) / 4 + 1];
static drogue_workspace workspace;
static drogue_config config;
static drogue_result result;

/* 800 px of focal length; a rim of 0.35 m and an inner part of 0.175 m, 0.02 m behind it. */
static const drogue_camera camera = {
    DROGUE_Q16(800, 1), DROGUE_Q16(800, 1), DROGUE_Q16(255, 2), DROGUE_Q16(255, 2), 0, 0, 0, 0, 0};
static const drogue_model model = {DROGUE_Q16(35, 100), DROGUE_Q16(175, 1000), DROGUE_Q16(2, 100)};

/* In place of a camera: a drogue at 3.5 m, seen head-on: a grey ring with a dark disc in it before a bright sky, every
 * pixel the mean of 4 x 4 samples. */
static void take_picture(void)
{
    const int32_t x0 = 8 * 130 + 2, y0 = 8 * 126 + 4; /* centre, eighths of a pixel */
    const int32_t rim2 = 640 * 640, inner = 640 / 2 * 350 / 352;
    int32_t x, y, i;
    for (y = 0; y < SIDE_PX; y++) {
        for (x = 0; x < SIDE_PX; x++) {
            int32_t sum = 0;
            for (i = 0; i < 16; i++) {
                const int32_t dx = 8 * x + 2 * (i & 3) - 3 - x0, dy = 8 * y + 2 * (i >> 2) - 3 - y0;
                const int32_t r2 = dx * dx + dy * dy;
                sum += r2 > rim2 ? 200 : r2 > inner * inner ? 110 : 20;
            }
            pixels[y * SIDE_PX + x] = (uint8_t)(sum / 16);
        }
    }
}

static long milli(drogue_q16 value) { return (long)drogue_shr_round_s64((int64_t)value * 1000, 16); }

int main(void)
{
    const drogue_capacity capacity = DROGUE_CAPACITY_FOR(SIDE_PX);
    const drogue_image image = {pixels, SIDE_PX, SIDE_PX, SIDE_PX};
    const drogue_region region = {30, 27, 200, 200}; /* the drogue about its middle, 2 to 3 semi-axes wide */
    const drogue_setup setup = {&camera, &model, &config};
    drogue_status status = drogue_workspace_init(&workspace, memory, sizeof memory, &capacity);
    uint64_t clocks;
    take_picture();
    drogue_config_default(&config);
    clocks = board_ticks();
    if (status == DROGUE_OK) {
        status = drogue_measure(&result, &workspace, &setup, &image, &region);
    }
    clocks = (board_ticks() - clocks) * BOARD_CLOCKS_A_TICK;
    printf("status %s\n", drogue_status_name(status));
    if (status != DROGUE_OK) {
        return 1;
    }
    printf("position %ld %ld %ld mm, axis %ld %ld %ld / 1000\n", milli(result.pose.position_m_q16[0]),
           milli(result.pose.position_m_q16[1]), milli(result.pose.position_m_q16[2]), milli(result.pose.axis_q16[0]),
           milli(result.pose.axis_q16[1]), milli(result.pose.axis_q16[2]));
    printf("%lu thousand clocks, %lu microseconds at %lu MHz\n", (unsigned long)(clocks / 1000),
           (unsigned long)(clocks * 1000000 / BOARD_CLOCK_HZ), (unsigned long)(BOARD_CLOCK_HZ / 1000000));
    return 0;
}
