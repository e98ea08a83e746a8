/* SPDX-License-Identifier: Apache-2.0 */
/* A track over frames, in which the drogue goes where it likes, with time steps as they come. */
#include "fuzz.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "drogue/track.h"

static void check_estimate(const drogue_track *track)
{
    drogue_track_estimate e;
    double length = 0;
    int k;
    memset(&e, 0xA5, sizeof e);
    drogue_track_get(&e, track);
    for (k = 0; k < 3; k++) {
        FUZZ_MUST(e.position_std_m_q32[k] >= 0);
        length += e.axis_q16[k] / 65536.0 * (e.axis_q16[k] / 65536.0);
    }
    FUZZ_MUST(e.yaw_std_rad_q32 >= 0 && e.pitch_std_rad_q32 >= 0 && e.axis_std_rad_q32 >= 0);
    FUZZ_MUST(track->state == DROGUE_LOST ? length == 0 : fabs(sqrt(length) - 1) <= 1e-3);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_bytes b = {data, size};
    fuzz_scene s;
    fuzz_workspace w;
    drogue_capacity capacity;
    drogue_track_config config;
    drogue_track track;
    drogue_search search;
    drogue_region region;
    drogue_result result;
    static uint32_t memory[DROGUE_SEARCH_BYTES(160) / 4 + 1];
    int frames;
    fuzz_scene_make(&s, &b, 128);
    capacity = fuzz_capacity(&b, 128);
    w = fuzz_workspace_make(&capacity, fuzz_byte(&b));
    FUZZ_MUST(drogue_search_init(&search, memory, sizeof memory, 160) == DROGUE_OK);
    drogue_track_config_default(&config);
    if (fuzz_byte(&b) % 2) {
        config.max_missed = fuzz_byte(&b);
        config.agree_frames = fuzz_byte(&b);
        config.reconsider_frames = fuzz_byte(&b);
        config.gate_q16 = fuzz_any(&b);
        config.region_sigmas_q16 = fuzz_any(&b);
        config.start_rate_std_q16 = fuzz_any(&b);
        config.process_std_q16[0] = fuzz_any(&b);
        config.max_region_px = fuzz_any(&b);
    }
    if (drogue_track_init(&track, &config, &s.camera, &s.model, fuzz_byte(&b) % 2 ? &s.region : NULL) == DROGUE_OK) {
        for (frames = fuzz_range(&b, 1, 6); frames > 0; frames--) {
            const uint32_t dt_us = fuzz_byte(&b) % 4 ? 20000u : (uint32_t)fuzz_range(&b, 1, INT32_MAX);
            const drogue_track_state state =
                drogue_track_frame(&result, &region, &track, &w.workspace, &search, &s.config, &s.image, dt_us);
            FUZZ_MUST(state == track.state && (int)state >= 0 && state <= DROGUE_COASTING);
            fuzz_check_result(&result, &region, &s.image);
            check_estimate(&track);
            fuzz_scene_draw(&s, &b);
        }
    }
    free(w.memory);
    fuzz_scene_free(&s);
    return 0;
}
