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

/* Every member, most of them where drogue_track_config_valid() allows it. */
static void change_track_config(drogue_track_config *c, fuzz_bytes *b)
{
    uint32_t *const counts[] = {&c->max_missed, &c->agree_frames, &c->reconsider_frames, &c->known_frames};
    drogue_q16 *const reals[] = {&c->min_reliability_q16, &c->gate_q16,           &c->position_gate_q16,
                                 &c->region_scale_q16,    &c->region_sigmas_q16,  &c->lateral_std_q16,
                                 &c->depth_std_q16,       &c->angle_std_rad_q16,  &c->position_floor_m_q16,
                                 &c->angle_floor_rad_q16, &c->process_std_q16[0], &c->process_std_q16[1],
                                 &c->process_std_q16[2],  &c->process_std_q16[3], &c->process_std_q16[4],
                                 &c->process_step_q16,    &c->lasting_share_q16,  &c->start_rate_std_q16,
                                 &c->start_accel_std_q16, &c->min_region_px,      &c->max_region_px};
    size_t k;
    for (k = 0; k < sizeof counts / sizeof counts[0]; k++) {
        const uint8_t how = fuzz_byte(b);
        *counts[k] = how % 4 == 3 ? fuzz_byte(b) : how % 16 == 14 ? (uint32_t)fuzz_any(b) : *counts[k];
    }
    for (k = 0; k < sizeof reals / sizeof reals[0]; k++) {
        const uint8_t how = fuzz_byte(b);
        if (how % 4 == 3) {
            *reals[k] = (fuzz_any(b) & INT32_MAX) >> how / 8;
        } else if (how % 64 == 62) {
            *reals[k] = fuzz_any(b);
        }
    }
}

/* A result as none was measured, within what is promised of one: elsewhere, of another status, with another covariance. */
static void made_up(drogue_result *r, fuzz_bytes *b)
{
    const uint8_t how = fuzz_byte(b);
    int i, j;
    memset(r, 0, sizeof *r);
    r->status = how % 4 ? DROGUE_OK : (drogue_status)(how % (int)DROGUE_STATUS_COUNT);
    r->second_look = (drogue_second_look)(fuzz_byte(b) % (int)DROGUE_SECOND_COUNT);
    r->has_inner = how >> 4 & 1;
    r->orientation_resolved = how >> 5 & 1;
    r->cover_q16 = fuzz_range(b, 0, 65536);
    r->doubt_q16 = fuzz_range(b, 0, 65535);
    r->quality.reliability_q16 = fuzz_range(b, 0, 65536);
    r->pose.position_m_q16[0] = fuzz_any(b);
    r->pose.position_m_q16[1] = fuzz_any(b);
    r->pose.position_m_q16[2] = fuzz_range(b, 1, INT32_MAX);
    r->pose.yaw_rad_q16 = fuzz_range(b, -205887, 205887);
    r->pose.pitch_rad_q16 = fuzz_range(b, -102943, 102943);
    r->pose.axis_q16[2] = 65536;
    r->alternative = r->pose;
    r->alternative.yaw_rad_q16 = fuzz_range(b, -205887, 205887);
    r->covariance_halved = how >> 6 & 1 ? 2 * fuzz_range(b, 0, 23) : 0;
    for (i = 0; i < 5; i++) { /* a diagonal and a little beside it */
        r->covariance_q48[i][i] = ((int64_t)(fuzz_any(b) & INT32_MAX) << 31) >> fuzz_range(b, 0, 61);
    }
    for (i = 0; i < 5; i++) {
        for (j = 0; j < i; j++) {
            const int64_t least =
                r->covariance_q48[i][i] < r->covariance_q48[j][j] ? r->covariance_q48[i][i] : r->covariance_q48[j][j];
            r->covariance_q48[i][j] = r->covariance_q48[j][i] = least / 256 * fuzz_range(b, -50, 50);
        }
    }
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
        change_track_config(&config, &b);
    }
    if (drogue_track_init(&track, &config, &s.camera, &s.model, fuzz_byte(&b) % 2 ? &s.region : NULL) == DROGUE_OK) {
        for (frames = fuzz_range(&b, 1, 6); frames > 0; frames--) {
            const uint32_t dt_us = fuzz_byte(&b) % 4 ? 20000u : (uint32_t)fuzz_range(&b, 1, INT32_MAX);
            drogue_track_state state;
            if (fuzz_byte(&b) % 8 == 7) {
                made_up(&result, &b);
                drogue_track_begin(&region, &track, dt_us);
                state = drogue_track_end(&track, &result);
            } else {
                state = drogue_track_frame(&result, &region, &track, &w.workspace, &search, &s.config, &s.image, dt_us);
                fuzz_check_result(&result, &region, &s.image);
            }
            FUZZ_MUST(state == track.state && (int)state >= 0 && state <= DROGUE_COASTING);
            check_estimate(&track);
            fuzz_scene_draw(&s, &b);
        }
    }
    free(w.memory);
    fuzz_scene_free(&s);
    return 0;
}
