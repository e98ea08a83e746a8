/* SPDX-License-Identifier: Apache-2.0 */
/* Tracking: where to look next, and what to believe when a frame is missed. */
#include "drogue/track.h"

#include <string.h>

#include "drogue/undistort.h"

const char *drogue_track_state_name(drogue_track_state state)
{
    switch (state) {
    case DROGUE_TRACKING: return "tracking";
    case DROGUE_COASTING: return "coasting";
    case DROGUE_LOST: break;
    }
    return "lost";
}

void drogue_track_config_default(drogue_track_config *config)
{
    int p;
    config->max_missed = 10;
    config->region_scale_q16 = DROGUE_Q16(5, 2);
    config->min_region_px = 32;
    config->max_region_px = DROGUE_MAX_SIDE;
    config->lateral_std_q16 = DROGUE_Q16(5, 10000);
    config->depth_std_q16 = DROGUE_Q16(2, 1000);
    config->angle_std_rad_q16 = DROGUE_Q16(2, 100);
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        config->process_std_q16[p] = DROGUE_Q16(2, 10);
    }
    config->start_rate_std_q16 = DROGUE_Q16(2, 1);
    config->start_accel_std_q16 = DROGUE_Q16(2, 1);
}

void drogue_track_init(drogue_track *track, const drogue_track_config *config, const drogue_camera *camera,
                       const drogue_model *model, const drogue_region *first_region)
{
    memset(track, 0, sizeof *track);
    track->config = *config;
    track->camera = *camera;
    track->model = *model;
    track->first_region = *first_region;
    track->state = DROGUE_LOST;
}

/* Unit vector of yaw and pitch, Q16. */
static void axis_of(drogue_q16 axis_q16[3], drogue_q16 yaw_rad_q16, drogue_q16 pitch_rad_q16)
{
    int32_t sin_yaw;
    int32_t cos_yaw;
    int32_t sin_pitch;
    int32_t cos_pitch;
    drogue_sincos_q30(&sin_yaw, &cos_yaw, (int32_t)drogue_shl_s64(yaw_rad_q16, 13));
    drogue_sincos_q30(&sin_pitch, &cos_pitch, (int32_t)drogue_shl_s64(pitch_rad_q16, 13));
    axis_q16[0] = (drogue_q16)drogue_shr_round_s64((int64_t)sin_yaw * cos_pitch, 44);
    axis_q16[1] = (drogue_q16)drogue_shr_round_s64(sin_pitch, 14);
    axis_q16[2] = (drogue_q16)drogue_shr_round_s64((int64_t)cos_yaw * cos_pitch, 44);
}

/* An angle within [-pi, pi), Q16: filtered angles may pass it. */
static drogue_q16 wrap_q16(drogue_q16 angle)
{
    const int64_t turn = 2 * (int64_t)DROGUE_Q16_PI;
    return (drogue_q16)(angle - turn * drogue_floor_div_s64((int64_t)angle + DROGUE_Q16_PI, turn));
}

void drogue_track_get(drogue_track_estimate *out, const drogue_track *track)
{
    drogue_q16 value[DROGUE_PARAMETERS];
    drogue_q16 rate[DROGUE_PARAMETERS];
    int k;
    memset(out, 0, sizeof *out);
    if (track->state == DROGUE_LOST) {
        return;
    }
    drogue_kalman_state(value, &track->filter, 0);
    drogue_kalman_state(rate, &track->filter, 1);
    for (k = 0; k < 3; k++) {
        out->position_m_q16[k] = value[k];
        out->velocity_mps_q16[k] = rate[k];
    }
    out->yaw_rad_q16 = wrap_q16(value[DROGUE_YAW]);
    out->pitch_rad_q16 = wrap_q16(value[DROGUE_PITCH]);
    axis_of(out->axis_q16, out->yaw_rad_q16, out->pitch_rad_q16);
}

/* Square region about the predicted outline; 0 when the prediction cannot be seen. */
static int predicted_region(drogue_region *region, const drogue_track *track)
{
    drogue_track_estimate estimate;
    drogue_pose pose;
    drogue_q16 x;
    drogue_q16 y;
    int64_t side_px;
    memset(&pose, 0, sizeof pose);
    drogue_track_get(&estimate, track);
    memcpy(pose.position_m_q16, estimate.position_m_q16, sizeof pose.position_m_q16);
    if (drogue_project_axis_point(&x, &y, &pose, 0, &track->camera) != DROGUE_OK ||
        (drogue_camera_distorts(&track->camera) && drogue_distort_point(&x, &y, &track->camera) != DROGUE_OK)) {
        return 0;
    }
    side_px = drogue_wide_to_s64(drogue_wide_mul(drogue_wide_mul(drogue_wide_from_q16(track->config.region_scale_q16),
                                                                 drogue_wide_from_q16(track->camera.fx_px_q16)),
                                                 drogue_wide_div(drogue_wide_from_q16(track->model.rim_radius_m_q16),
                                                                 drogue_wide_from_q16(pose.position_m_q16[2]))),
                                 0);
    if (side_px < track->config.min_region_px) {
        side_px = track->config.min_region_px;
    }
    if (side_px > track->config.max_region_px) {
        side_px = track->config.max_region_px;
    }
    region->width_px = (int32_t)side_px;
    region->height_px = (int32_t)side_px;
    region->x_px = (int32_t)(drogue_shr_round_s64(x, 16) - side_px / 2);
    region->y_px = (int32_t)(drogue_shr_round_s64(y, 16) - side_px / 2);
    return 1;
}

void drogue_track_begin(drogue_region *region, drogue_track *track, uint32_t dt_us)
{
    *region = track->first_region;
    if (track->state != DROGUE_LOST) {
        drogue_kalman_predict(&track->filter, dt_us, track->config.process_std_q16);
        if (!predicted_region(region, track)) {
            track->state = DROGUE_LOST;
        }
    }
}

/* The pose to believe: the measured choice, or without one the pose nearer to the predicted axis. */
static const drogue_pose *believed_pose(const drogue_track *track, const drogue_result *result)
{
    drogue_track_estimate estimate;
    int64_t first = 0;
    int64_t second = 0;
    int k;
    if (result->orientation_resolved || track->state == DROGUE_LOST) {
        return &result->pose;
    }
    drogue_track_get(&estimate, track);
    for (k = 0; k < 3; k++) {
        first += (int64_t)estimate.axis_q16[k] * result->pose.axis_q16[k];
        second += (int64_t)estimate.axis_q16[k] * result->alternative.axis_q16[k];
    }
    return second > first ? &result->alternative : &result->pose;
}

static drogue_q16 at_least_one(drogue_q16 v) { return v < 1 ? 1 : v; }

drogue_track_state drogue_track_end(drogue_track *track, const drogue_result *result)
{
    const drogue_track_config *c = &track->config;
    const drogue_pose *pose;
    drogue_q16 value[DROGUE_PARAMETERS];
    drogue_q16 std[DROGUE_PARAMETERS];
    int p;
    if (result->status != DROGUE_OK) {
        track->missed++;
        if (track->state != DROGUE_LOST) {
            track->state = track->missed > c->max_missed ? DROGUE_LOST : DROGUE_COASTING;
        }
        return track->state;
    }
    pose = believed_pose(track, result);
    value[DROGUE_X] = pose->position_m_q16[0];
    value[DROGUE_Y] = pose->position_m_q16[1];
    value[DROGUE_Z] = pose->position_m_q16[2];
    value[DROGUE_PITCH] = pose->pitch_rad_q16;
    value[DROGUE_YAW] = pose->yaw_rad_q16;
    std[DROGUE_X] = std[DROGUE_Y] = at_least_one(drogue_q16_mul(c->lateral_std_q16, value[DROGUE_Z]));
    std[DROGUE_Z] = at_least_one(drogue_q16_mul(c->depth_std_q16, value[DROGUE_Z]));
    std[DROGUE_PITCH] = std[DROGUE_YAW] = at_least_one(c->angle_std_rad_q16);
    if (track->state == DROGUE_LOST) {
        drogue_q16 start[DROGUE_PARAMETERS][3];
        for (p = 0; p < DROGUE_PARAMETERS; p++) {
            start[p][0] = std[p];
            start[p][1] = c->start_rate_std_q16;
            start[p][2] = c->start_accel_std_q16;
        }
        drogue_kalman_init(&track->filter, value, (const drogue_q16(*)[3])start);
    } else {
        drogue_kalman_correct(&track->filter, value, std);
    }
    track->missed = 0;
    track->state = DROGUE_TRACKING;
    return track->state;
}
