/* SPDX-License-Identifier: Apache-2.0 */
/* Tracking: where to look next, and what the filter says. What to believe is in track_end.c. */
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
    config->max_missed = 10;
    config->agree_frames = 4;
    config->reconsider_frames = 50;
    config->gate_q16 = DROGUE_Q16(20515, 1000);
    config->position_gate_q16 = DROGUE_Q16(16266, 1000);
    config->region_scale_q16 = DROGUE_Q16(5, 2);
    config->region_sigmas_q16 = DROGUE_Q16(3, 1);
    config->min_region_px = 32;
    config->max_region_px = DROGUE_MAX_SIDE;
    config->lateral_std_q16 = DROGUE_Q16(5, 10000);
    config->depth_std_q16 = DROGUE_Q16(2, 1000);
    config->angle_std_rad_q16 = DROGUE_Q16(2, 100);
    config->position_floor_m_q16 = DROGUE_Q16(1, 10000);
    config->angle_floor_rad_q16 = DROGUE_Q16(5, 10000);
    config->process_std_q16[DROGUE_X] = DROGUE_Q16(2, 10);
    config->process_std_q16[DROGUE_Y] = DROGUE_Q16(2, 10);
    config->process_std_q16[DROGUE_Z] = DROGUE_Q16(2, 100);
    config->process_std_q16[DROGUE_PITCH] = DROGUE_Q16(15, 100);
    config->process_std_q16[DROGUE_YAW] = DROGUE_Q16(15, 100);
    config->start_rate_std_q16 = DROGUE_Q16(2, 1);
    config->start_accel_std_q16 = DROGUE_Q16(2, 1);
}

int drogue_track_config_valid(const drogue_track_config *c)
{
    /* the sign of all */
    int32_t any = c->gate_q16 | c->position_gate_q16 | c->region_sigmas_q16 | c->lateral_std_q16 | c->depth_std_q16 |
                  c->angle_std_rad_q16 | c->position_floor_m_q16 | c->angle_floor_rad_q16 | c->start_rate_std_q16 |
                  c->start_accel_std_q16;
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        any |= c->process_std_q16[p];
    }
    return any >= 0 && c->agree_frames > 0 && c->region_scale_q16 > 0 && c->min_region_px > 0 &&
           c->min_region_px <= c->max_region_px && c->max_region_px <= DROGUE_MAX_SIDE;
}

drogue_status drogue_track_init(drogue_track *track, const drogue_track_config *config, const drogue_camera *camera,
                                const drogue_model *model, const drogue_region *first_region)
{
    memset(track, 0, sizeof *track);
    if (!drogue_track_config_valid(config)) {
        return DROGUE_E_ARGUMENT;
    }
    track->config = *config;
    track->camera = *camera;
    track->model = *model;
    if (first_region != NULL) {
        track->first_region = *first_region;
    }
    track->reach = track->first_region;
    track->state = DROGUE_LOST;
    return DROGUE_OK;
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

/* Root of yaw's variance times cos^2 pitch plus pitch's variance. */
static int64_t axis_std(int64_t yaw_std_q32, int64_t pitch_std_q32, drogue_q16 pitch_rad_q16)
{
    drogue_real yaw;
    drogue_real pitch;
    int32_t s_q30;
    int32_t c_q30;
    drogue_sincos_q30(&s_q30, &c_q30, (int32_t)drogue_shl_s64(pitch_rad_q16, 13));
    drogue_real_set(&yaw, yaw_std_q32, -32);
    drogue_real_set(&pitch, c_q30, -30);
    drogue_real_product(&yaw, &yaw, &pitch);
    drogue_real_set(&pitch, pitch_std_q32, -32);
    drogue_real_products(&yaw, &yaw, &yaw, &pitch, &pitch);
    drogue_real_root(&yaw, &yaw);
    return drogue_real_to_s64(yaw, 32);
}

void drogue_track_get(drogue_track_estimate *out, const drogue_track *track)
{
    drogue_q16 value[DROGUE_PARAMETERS];
    drogue_q16 rate[DROGUE_PARAMETERS];
    int64_t std[DROGUE_PARAMETERS];
    int k;
    memset(out, 0, sizeof *out);
    if (track->state == DROGUE_LOST) {
        return;
    }
    drogue_kalman_state(value, &track->filter, 0);
    drogue_kalman_state(rate, &track->filter, 1);
    drogue_kalman_std(std, &track->filter);
    for (k = 0; k < 3; k++) {
        out->position_m_q16[k] = value[k];
        out->velocity_mps_q16[k] = rate[k];
        out->position_std_m_q32[k] = std[k];
    }
    out->yaw_rad_q16 = wrap_q16(value[DROGUE_YAW]);
    out->pitch_rad_q16 = wrap_q16(value[DROGUE_PITCH]);
    axis_of(out->axis_q16, out->yaw_rad_q16, out->pitch_rad_q16);
    out->orientation_resolved = track->orientation_known;
    out->yaw_std_rad_q32 = std[DROGUE_YAW];
    out->pitch_std_rad_q32 = std[DROGUE_PITCH];
    out->axis_std_rad_q32 = axis_std(std[DROGUE_YAW], std[DROGUE_PITCH], out->pitch_rad_q16);
}

/* Square about a point; a side beyond the limits is brought within. */
static void square_about(drogue_region *region, drogue_q16 x_px_q16, drogue_q16 y_px_q16, int64_t side_px,
                         const drogue_track_config *config)
{
    if (side_px < config->min_region_px) {
        side_px = config->min_region_px;
    }
    if (side_px > config->max_region_px) {
        side_px = config->max_region_px;
    }
    region->width_px = (int32_t)side_px;
    region->height_px = (int32_t)side_px;
    region->x_px = (int32_t)(drogue_shr_round_s64(x_px_q16, 16) - side_px / 2);
    region->y_px = (int32_t)(drogue_shr_round_s64(y_px_q16, 16) - side_px / 2);
}

/* How far the outline may lie from where it is predicted, in semi-axes: region_sigmas standard deviations of the
 * lateral position over the rim's radius, and of the depth over itself. */
static void predicted_spread(drogue_real *out, const drogue_track_estimate *e, const drogue_track *track)
{
    const int64_t *std = e->position_std_m_q32;
    drogue_real away;
    drogue_real t;
    drogue_real_set(out, std[0] > std[1] ? std[0] : std[1], -32);
    drogue_real_set_q16(&t, track->model.rim_radius_m_q16);
    drogue_real_quotient(out, out, &t);
    drogue_real_set(&away, std[2], -32);
    drogue_real_set_q16(&t, e->position_m_q16[2]);
    drogue_real_quotient(&away, &away, &t);
    drogue_real_sum(out, out, &away);
    drogue_real_set_q16(&t, track->config.region_sigmas_q16);
    drogue_real_product(out, &t, out);
}

/* Regions about the predicted outline; 0 when the prediction cannot be seen.
 * What drogue_measure() bears at a side of 2.5 semi-axes: an outline 0.4 semi-axes away from the middle, and at that a
 * side a tenth larger. */
static int predicted_region(drogue_region *region, drogue_track *track)
{
    drogue_track_estimate estimate;
    drogue_pose pose;
    drogue_real semi_axis_px;
    drogue_real spread;
    drogue_real scale;
    drogue_real grown;
    drogue_real most;
    drogue_q16 x;
    drogue_q16 y;
    memset(&pose, 0, sizeof pose);
    drogue_track_get(&estimate, track);
    memcpy(pose.position_m_q16, estimate.position_m_q16, sizeof pose.position_m_q16);
    if (drogue_project_axis_point(&x, &y, &pose, 0, &track->camera) != DROGUE_OK ||
        (drogue_camera_distorts(&track->camera) && drogue_distort_point(&x, &y, &track->camera) != DROGUE_OK)) {
        return 0;
    }
    drogue_real_set_q16(&semi_axis_px, track->model.rim_radius_m_q16);
    drogue_real_set_q16(&scale, pose.position_m_q16[2]);
    drogue_real_quotient(&semi_axis_px, &semi_axis_px, &scale);
    drogue_real_set_q16(&scale, track->camera.fx_px_q16);
    drogue_real_product(&semi_axis_px, &scale, &semi_axis_px);
    predicted_spread(&spread, &estimate, track);
    drogue_real_set_q16(&most, DROGUE_Q16(4, 10));
    track->search = drogue_real_order(&spread, &most) > 0;
    drogue_real_set_q16(&scale, track->config.region_scale_q16);
    grown = spread;
    drogue_real_shift(&grown, 1);
    drogue_real_sum(&grown, &scale, &grown);
    drogue_real_product(&grown, &grown, &semi_axis_px);
    square_about(&track->reach, x, y, drogue_real_to_s64(grown, 0), &track->config);
    grown = track->search ? most : spread;
    drogue_real_shift(&grown, -2);
    drogue_real_set(&most, 1, 0);
    drogue_real_sum(&grown, &most, &grown);
    drogue_real_product(&grown, &scale, &grown);
    drogue_real_product(&grown, &grown, &semi_axis_px);
    square_about(region, x, y, drogue_real_to_s64(grown, 0), &track->config);
    return 1;
}

void drogue_track_begin(drogue_region *region, drogue_track *track, uint32_t dt_us)
{
    track->gated = 0;
    if (track->agreeing > 0) {
        drogue_kalman_predict(&track->second, dt_us, track->config.process_std_q16);
    }
    if (track->state != DROGUE_LOST) {
        drogue_kalman_predict(&track->filter, dt_us, track->config.process_std_q16);
        if (predicted_region(region, track)) {
            return;
        }
        track->state = DROGUE_LOST;
        track->agreeing = 0;
    }
    *region = track->first_region;
    track->reach = track->first_region;
    track->search = track->first_region.width_px <= 0;
}

/* May a search's find start a track? Its inner part decided, or was at least seen within a good outline. */
static int looks_whole(const drogue_result *result)
{
    return result->orientation_resolved || (result->has_inner && result->cover_q16 >= DROGUE_Q16(3, 4));
}

/* Look where the drogue is expected, then where it may be. 1 when a search found it. */
static int look(drogue_result *result, const drogue_region *region, const drogue_track *track,
                drogue_workspace *workspace, drogue_search *search, const drogue_setup *setup,
                const drogue_image *image)
{
    const int lost = track->state == DROGUE_LOST;
    drogue_result found;
    memset(result, 0, sizeof *result);
    result->status = DROGUE_E_REGION;
    if (region->width_px > 0) {
        (void)drogue_measure(result, workspace, setup, image, region);
    }
    if (result->status == DROGUE_OK || (!lost && !track->search)) {
        return 0;
    }
    (void)drogue_acquire(&found, search, workspace, setup, image, lost ? NULL : &track->reach);
    if (found.status == DROGUE_OK || region->width_px <= 0) {
        *result = found;
        return 1;
    }
    return 0;
}

/* Is it time to look whether the drogue is elsewhere? */
static int in_doubt(drogue_track *track)
{
    if (track->state == DROGUE_LOST || track->model.inner_radius_m_q16 <= 0 || track->config.reconsider_frames == 0 ||
        track->open_frames < track->config.reconsider_frames) {
        return 0;
    }
    track->open_frames = 0;
    return 1;
}

drogue_track_state drogue_track_frame(drogue_result *result, drogue_region *region, drogue_track *track,
                                      drogue_workspace *workspace, drogue_search *search, const drogue_config *config,
                                      const drogue_image *image, uint32_t dt_us)
{
    drogue_setup setup;
    setup.camera = &track->camera;
    setup.model = &track->model;
    setup.config = config;
    drogue_track_begin(region, track, dt_us);
    if (in_doubt(track) && drogue_acquire(result, search, workspace, &setup, image, NULL) == DROGUE_OK &&
        result->orientation_resolved) {
        track->state = DROGUE_LOST; /* begin anew from this */
        return drogue_track_end(track, result);
    }
    if (look(result, region, track, workspace, search, &setup, image) && track->state == DROGUE_LOST &&
        track->model.inner_radius_m_q16 > 0 && !looks_whole(result)) {
        return track->state;
    }
    return drogue_track_end(track, result);
}
