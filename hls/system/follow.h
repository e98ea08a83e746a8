/* SPDX-License-Identifier: Apache-2.0 */
/* What firmware and bench do alike: a track over frames of one size. Camera and model are the renderer's, of an image of SIDE
 * pixels cut from the middle of a larger one. */
#ifndef DROGUE_SYSTEM_FOLLOW_H
#define DROGUE_SYSTEM_FOLLOW_H

#include "drogue/track.h"

#ifndef SIDE
#define SIDE 128
#endif

enum { WIDEST = 256, FRAME_US = 20000, FOCAL_PX = 1465 };

typedef struct follow {
    uint32_t memory[DROGUE_WORKSPACE_BYTES_FOR(WIDEST) / 4 + 1];
    uint8_t search_memory[DROGUE_SEARCH_BYTES(SIDE)];
    drogue_workspace workspace;
    drogue_search search;
    drogue_config config;
    drogue_track track;
    drogue_region region;
    drogue_result result;
    drogue_track_estimate estimate;
} follow;

static inline drogue_status follow_begin(follow *f)
{
    static const drogue_capacity capacity = DROGUE_CAPACITY_FOR(WIDEST);
    const drogue_camera camera = {
        FOCAL_PX * 65536, FOCAL_PX * 65536, (SIDE - 1) * 32768, (SIDE - 1) * 32768, 0, 0, 0, 0, 0};
    const drogue_model model = {DROGUE_Q16(35, 100), DROGUE_Q16(12, 100), DROGUE_Q16(25, 100)};
    drogue_track_config config;
    drogue_status status = drogue_workspace_init(&f->workspace, f->memory, sizeof f->memory, &capacity);
    if (status == DROGUE_OK) {
        status = drogue_search_init(&f->search, f->search_memory, sizeof f->search_memory, SIDE);
    }
    drogue_config_default(&f->config);
    drogue_track_config_default(&config);
    config.max_missed = 2;
    return status == DROGUE_OK ? drogue_track_init(&f->track, &config, &camera, &model, NULL) : status;
}

static inline void follow_frame(follow *f, const uint8_t *pixels)
{
    const drogue_image image = {pixels, SIDE, SIDE, SIDE};
    drogue_track_frame(&f->result, &f->region, &f->track, &f->workspace, &f->search, &f->config, &image, FRAME_US);
    drogue_track_get(&f->estimate, &f->track);
}

#endif
