/* SPDX-License-Identifier: Apache-2.0 */
/* Adapters of what decides and what follows: decide, track. */
#include "stage_run.h"

#include <string.h>

#include "drogue/decide.h"
#include "drogue/track.h"

/* A pose as stage_put_pose() writes it. */
static drogue_pose whole_pose(const int32_t words[8])
{
    drogue_pose p;
    memcpy(p.position_m_q16, words, sizeof p.position_m_q16);
    memcpy(p.axis_q16, words + 3, sizeof p.axis_q16);
    p.yaw_rad_q16 = words[6];
    p.pitch_rad_q16 = words[7];
    return p;
}

/* Covariance by rows of the lower triangle, and standard deviations. */
static void put_covariance(int64_t *covariance, int64_t *std, const drogue_decision *d)
{
    int i;
    int j;
    for (i = 0; i < 5; i++) {
        for (j = 0; j <= i; j++) {
            *covariance++ = d->covariance_q48[i][j];
        }
    }
    memcpy(std, d->position_std_m_q32, sizeof d->position_std_m_q32);
    std[3] = d->axis_std_rad_q32;
}

int stage_decide(stage_run *r)
{
    const drogue_camera camera = conf_camera(stage_input32(r, 1));
    const int32_t *p = stage_input32(r, 3);
    const drogue_model model = conf_model(p);
    int32_t *out = stage_output32(r, "decision", 19);
    int64_t *covariance = (int64_t *)stage_output(r, "covariance", 64, 15);
    int64_t *std = (int64_t *)stage_output(r, "std", 64, 4);
    drogue_config config;
    drogue_support support;
    drogue_evidence evidence;
    drogue_decision decision;
    if (out == NULL || covariance == NULL || std == NULL) {
        return CONF_E_MEMORY;
    }
    memset(covariance, 0, 15 * sizeof *covariance);
    memset(std, 0, 4 * sizeof *std);
    memset(&decision, 0, sizeof decision);
    drogue_config_default(&config);
    evidence.ideal = stage_ellipse(stage_input32(r, 0));
    evidence.poses[0] = whole_pose(p + 3);
    evidence.poses[1] = whole_pose(p + 11);
    evidence.nearer = p[19] != 0 ? 1 : 0;
    evidence.inner.x_px_q16 = p[20];
    evidence.inner.y_px_q16 = p[21];
    evidence.inner.std_px_q16 = p[22];
    evidence.doubt_q16 = p[28];
    evidence.too_far_q16 = p[29];
    evidence.support = &support;
    config.outline_shading_q16 = p[23];
    config.optics_blur_std_px2_q16 = p[24];
    config.max_chi2_q16 = p[25];
    config.min_chi2_gap_q16 = p[26];
    if (!drogue_config_valid(&config) ||
        !stage_support_of_words(&support, stage_input32(r, 2), p[27], stage_input32(r, 0)[4]) || p[22] < 0 ||
        p[28] < 0 || p[29] < 0 || p[30] < 0 || p[30] > 8 || camera.fx_px_q16 <= 0 || camera.fy_px_q16 <= 0 ||
        p[0] <= 0 || p[1] < 0 || !stage_angle_valid(&evidence.ideal) || evidence.ideal.b_px_q16 < DROGUE_Q16_ONE ||
        evidence.ideal.a_px_q16 < evidence.ideal.b_px_q16) {
        return CONF_E_MALFORMED;
    }
    support.outside = (uint32_t)p[30];
    out[0] = (int32_t)drogue_decide(&decision, &evidence, &(drogue_setup){&camera, &model, &config});
    if (out[0] == (int32_t)DROGUE_OK) {
        int32_t *at = stage_put_pose(stage_put_pose(out + 1, &decision.pose), &decision.alternative);
        at[0] = decision.orientation_resolved;
        at[1] = decision.doubt_q16;
        put_covariance(covariance, std, &decision);
    }
    return 0;
}

static void read_track_config(drogue_track_config *c, const int32_t *p)
{
    drogue_track_config_default(c); /* what the words do not hold */
    c->max_missed = (uint32_t)p[0];
    c->agree_frames = (uint32_t)p[1];
    c->reconsider_frames = (uint32_t)p[2];
    c->known_frames = (uint32_t)p[3];
    c->min_region_px = p[4];
    c->max_region_px = p[5];
    c->gate_q16 = p[6];
    c->position_gate_q16 = p[7];
    c->region_scale_q16 = p[8];
    c->region_sigmas_q16 = p[9];
    c->lateral_std_q16 = p[10];
    c->depth_std_q16 = p[11];
    c->angle_std_rad_q16 = p[12];
    c->position_floor_m_q16 = p[13];
    c->angle_floor_rad_q16 = p[14];
    memcpy(c->process_std_q16, p + 15, sizeof c->process_std_q16);
    c->process_step_q16 = p[20];
    c->lasting_share_q16 = p[21];
    c->start_rate_std_q16 = p[22];
    c->start_accel_std_q16 = p[23];
}

/* A pose of position, yaw and pitch. */
static drogue_pose pose_of(const int32_t words[5])
{
    drogue_pose p;
    memset(&p, 0, sizeof p);
    memcpy(p.position_m_q16, words, sizeof p.position_m_q16);
    p.yaw_rad_q16 = words[3];
    p.pitch_rad_q16 = words[4];
    return p;
}

static void read_result(drogue_result *result, const int32_t *f, const int64_t *covariance)
{
    int i;
    int j;
    memset(result, 0, sizeof *result);
    result->status = (drogue_status)f[1];
    result->second_look = (drogue_second_look)f[2];
    result->has_inner = f[3];
    result->orientation_resolved = f[4];
    result->cover_q16 = f[5];
    result->doubt_q16 = f[16];
    result->pose = pose_of(f + 6);
    result->alternative = pose_of(f + 11);
    for (i = 0; i < 5; i++) {
        for (j = 0; j <= i; j++) {
            result->covariance_q48[i][j] = result->covariance_q48[j][i] = *covariance++;
        }
    }
}

int stage_track(stage_run *r)
{
    const int32_t *s = stage_input32(r, 0);
    const int32_t *frame = stage_input32(r, 2);
    const int64_t *covariance = (const int64_t *)r->in[3].data;
    const size_t count = r->in[2].count / 17;
    const drogue_camera camera = conf_camera(s);
    const drogue_model model = conf_model(s + 9);
    const drogue_region first = conf_region(s + 12);
    int32_t *out = stage_output32(r, "states", 19 * count);
    int32_t *estimate = stage_output32(r, "estimates", 12 * count);
    int64_t *std = (int64_t *)stage_output(r, "std", 64, 6 * count);
    drogue_track_config config;
    drogue_track track;
    drogue_status status;
    size_t i;
    if (out == NULL || estimate == NULL || std == NULL) {
        return CONF_E_MEMORY;
    }
    if (r->in[3].count != 15 * count) {
        return CONF_E_MALFORMED;
    }
    read_track_config(&config, stage_input32(r, 1));
    memset(std, 0, 6 * count * sizeof *std);
    status = drogue_track_init(&track, &config, &camera, &model, first.width_px > 0 ? &first : NULL);
    for (i = 0; status != DROGUE_OK && i < count; i++) {
        out[19 * i] = (int32_t)status;
    }
    for (i = 0; status == DROGUE_OK && i < count; i++, frame += 17, covariance += 15) {
        drogue_region region;
        drogue_result result;
        drogue_track_estimate e;
        if (frame[0] < 1 || frame[1] < 0 || frame[1] >= (int32_t)DROGUE_STATUS_COUNT) {
            return CONF_E_MALFORMED;
        }
        read_result(&result, frame, covariance);
        drogue_track_begin(&region, &track, (uint32_t)frame[0]);
        *out++ = (int32_t)status;
        out = stage_put_region(out, &region);
        *out++ = track.search;
        out = stage_put_region(out, &track.reach);
        *out++ = (int32_t)drogue_track_end(&track, &result);
        *out++ = (int32_t)track.missed;
        *out++ = track.gated;
        *out++ = track.orientation_known;
        *out++ = (int32_t)track.open_frames;
        *out++ = (int32_t)track.turned;
        *out++ = (int32_t)track.trial;
        *out++ = (int32_t)track.agreeing;
        *out++ = track.second_known;
        drogue_track_get(&e, &track);
        estimate = stage_put_estimate(estimate, &e);
        memcpy(std, e.position_std_m_q32, sizeof e.position_std_m_q32);
        std[3] = e.yaw_std_rad_q32;
        std[4] = e.pitch_std_rad_q32;
        std[5] = e.axis_std_rad_q32;
        std += 6;
    }
    return 0;
}
