/* SPDX-License-Identifier: Apache-2.0 */
/* Rays from the middle of a dark disc to its edge. */
#include "dark.h"

#include "cells.h"

#define RAYS DROGUE_SEARCH_RAYS
#define LEAST_RAYS 12 /* that must end near the median */
#define NOISE 8       /* grey levels: below it contrast is no darkness */

/* Where grey reaches a level on a ray from the disc's middle, cells Q4; 0 where it does not within two radii of the
 * ring, or the level ends before. */
static int32_t rise(const drogue_search_level *level, const drogue_search_disc *disc, int ray, int32_t grey)
{
    const int32_t last = disc->ring_q4 >> 3;
    int32_t before = 0;
    int32_t t;
    for (t = 0; t <= last; t++) { /* bound: 11 */
        const int32_t x = disc->x + ((drogue_search_ray_x_q8[ray] * t + 128) >> 8);
        const int32_t y = disc->y + ((drogue_search_ray_y_q8[ray] * t + 128) >> 8);
        int32_t here;
        if (x < 0 || x >= level->width || y < 0 || y >= level->rows_in) {
            return 0;
        }
        here = drogue_search_level_row(level, y)[x];
        if (t > 0 && here >= grey) {
            return 16 * t - 16 * (here - grey) / (here - before);
        }
        before = here;
    }
    return 0;
}

int drogue_dark_find(drogue_rim *out, const drogue_search_level *level, const drogue_search_disc *disc, uint32_t least)
{
    const int32_t centre = drogue_search_level_row(level, disc->y)[disc->x];
    const uint32_t share_q8 = 256 * (uint32_t)disc->contrast / (uint32_t)(centre + disc->contrast + NOISE);
    int32_t sorted_q4[RAYS];
    int32_t n = 0;
    uint32_t near = 0;
    int32_t i;
    if (share_q8 * RAYS * RAYS <= least) {
        return 0;
    }
    for (i = 0; i < RAYS; i++) {
        const int32_t at = rise(level, disc, i, centre + 1 + disc->contrast / 2);
        int32_t k = n;
        if (at <= 0) {
            continue;
        }
        for (; k > 0 && sorted_q4[k - 1] > at; k--) {
            sorted_q4[k] = sorted_q4[k - 1];
        }
        sorted_q4[k] = at;
        n++;
    }
    if (n < LEAST_RAYS) {
        return 0;
    }
    out->x_q4 = 0;
    out->y_q4 = 0;
    out->radius_q4 = sorted_q4[n / 2];
    for (i = 0; i < n; i++) {
        const int32_t off = sorted_q4[i] - out->radius_q4;
        near += 4 * drogue_abs_s32(off) <= out->radius_q4 + 16;
    }
    out->score = near < LEAST_RAYS ? 0 : share_q8 * near * near;
    return out->score > least;
}
