/* SPDX-License-Identifier: Apache-2.0 */
/* Tracking: where to look next, and what the filter says. What to believe is in track_end.c. */
#include "drogue/track.h"

#include <string.h>

#include "drogue/undistort.h"
#include "measurement.h"

#define MOST_APART DROGUE_Q16(6, 10) /* semi-axes between two predictions that one region holds */

const char *drogue_track_state_name(drogue_track_state state)
{
    switch (state) {
    case DROGUE_TRACKING: return "tracking";
    case DROGUE_COASTING: return "coasting";
    case DROGUE_LOST: break;
    }
    return "lost";
}

static const drogue_track_config defaults = {
    .max_missed = 10,
    .agree_frames = 4,
    .reconsider_frames = 50,
    .min_reliability_q16 = 0,
    .gate_q16 = DROGUE_Q16(20515, 1000),
    .position_gate_q16 = DROGUE_Q16(16266, 1000),
    .region_scale_q16 = DROGUE_Q16(5, 2),
    .region_sigmas_q16 = DROGUE_Q16(3, 1),
    .min_region_px = 32,
    .max_region_px = DROGUE_MAX_SIDE,
    .lateral_std_q16 = DROGUE_Q16(5, 10000),
    .depth_std_q16 = DROGUE_Q16(2, 1000),
    .angle_std_rad_q16 = DROGUE_Q16(2, 100),
    .position_floor_m_q16 = DROGUE_Q16(1, 10000),
    .angle_floor_rad_q16 = DROGUE_Q16(5, 10000),
    .process_std_q16[DROGUE_X] = DROGUE_Q16(2, 10),
    .process_std_q16[DROGUE_Y] = DROGUE_Q16(2, 10),
    .process_std_q16[DROGUE_Z] = DROGUE_Q16(2, 100),
    .process_std_q16[DROGUE_PITCH] = DROGUE_Q16(15, 100),
    .process_std_q16[DROGUE_YAW] = DROGUE_Q16(15, 100),
    .start_rate_std_q16 = DROGUE_Q16(2, 1),
    .process_step_q16 = DROGUE_Q16(6, 1),
    .lasting_share_q16 = DROGUE_Q16(75, 100),
    .known_frames = 25,
    .start_accel_std_q16 = DROGUE_Q16(15, 1),
};

void drogue_track_config_default(drogue_track_config *config) { *config = defaults; }

int drogue_track_config_valid(const drogue_track_config *c)
{
    /* the sign of all */
    int32_t any = c->gate_q16 | c->position_gate_q16 | c->region_sigmas_q16 | c->lateral_std_q16 | c->depth_std_q16 |
                  c->angle_std_rad_q16 | c->position_floor_m_q16 | c->angle_floor_rad_q16 | c->start_rate_std_q16 |
                  c->start_accel_std_q16 | c->min_reliability_q16;
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        any |= c->process_std_q16[p];
    }
    return any >= 0 && c->min_reliability_q16 <= DROGUE_Q16_ONE && c->process_step_q16 >= DROGUE_Q16_ONE &&
           c->lasting_share_q16 >= 0 && c->lasting_share_q16 <= DROGUE_Q16_ONE && c->agree_frames > 0 &&
           c->region_scale_q16 > 0 && c->min_region_px > 0 && c->min_region_px <= c->max_region_px &&
           c->max_region_px <= DROGUE_MAX_SIDE;
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
    if (first_region != NULL && first_region->width_px > 0) {
        track->first_region = *first_region;
    }
    track->reach = track->first_region;
    track->state = DROGUE_LOST;
    return DROGUE_OK;
}

/* An angle within [-pi, pi), Q16: filtered angles may pass it. */
static drogue_q16 wrap_q16(drogue_q16 angle)
{
    const int64_t turn = 2 * (int64_t)DROGUE_Q16_PI;
    return (drogue_q16)(angle - turn * drogue_floor_div_s64((int64_t)angle + DROGUE_Q16_PI, turn));
}

/* Filtered angles as an axis's: where the pitch has passed a right angle, the yaw is the opposite one. */
static void angles_of(drogue_q16 *yaw_rad_q16, drogue_q16 *pitch_rad_q16, drogue_q16 yaw, drogue_q16 pitch)
{
    const drogue_q16 wrapped = wrap_q16(pitch);
    const int over = wrapped > DROGUE_Q16_HALF_PI || wrapped < -DROGUE_Q16_HALF_PI;
    *pitch_rad_q16 = !over ? wrapped : wrapped > 0 ? DROGUE_Q16_PI - wrapped : -DROGUE_Q16_PI - wrapped;
    *yaw_rad_q16 = wrap_q16(over ? drogue_q16_add(yaw, DROGUE_Q16_PI) : yaw);
}

/* Root of yaw's variance times cos^2 pitch plus pitch's variance. */
static int64_t axis_std(int64_t yaw_std_q32, int64_t pitch_std_q32, drogue_q16 pitch_rad_q16)
{
    drogue_real yaw;
    drogue_real pitch;
    int32_t s_q30;
    int32_t c_q30;
    drogue_sincos_of_q16(&s_q30, &c_q30, pitch_rad_q16);
    drogue_real_set(&yaw, yaw_std_q32, -32);
    drogue_real_set(&pitch, c_q30, -30);
    drogue_real_product(&yaw, &yaw, &pitch);
    drogue_real_set(&pitch, pitch_std_q32, -32);
    drogue_real_products(&yaw, &yaw, &yaw, &pitch, &pitch);
    drogue_real_root(&yaw, &yaw);
    return drogue_real_to_s64(yaw, 32);
}

/* Standard deviations of the estimate: what lasts of the last measurement's variance N does not go with filtering, so
 * that the filter's own P < N counts as P + share (N - P). A prediction so many frames ahead is no better than
 * predictions were of late. */
static void estimate_std(int64_t std_q32[DROGUE_PARAMETERS], const drogue_track *track, uint32_t ahead)
{
    drogue_real share;
    int p;
    drogue_real_set_q16(&share, track->config.lasting_share_q16);
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        drogue_real variance = track->filter.parameter[p].variance[0];
        drogue_real more;
        if (drogue_real_order(&variance, &track->noise[p]) < 0) {
            drogue_real_difference(&more, &track->noise[p], &variance);
            drogue_real_product(&more, &share, &more);
            drogue_real_sum(&variance, &variance, &more);
        }
        drogue_bank_allow(&variance, &track->bank, p, ahead);
        drogue_real_root(&variance, &variance);
        std_q32[p] = drogue_real_to_s64(variance, 32);
    }
}

/* The estimate, so many frames after the last measurement that was believed. */
static void estimate(drogue_track_estimate *out, const drogue_track *track, uint32_t ahead)
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
    for (k = 0; k < DROGUE_PARAMETERS && ahead == 0; k++) {
        value[k] = drogue_q16_add(value[k], drogue_real_to_q16(track->shake[k]));
    }
    estimate_std(std, track, ahead);
    for (k = 0; k < 3; k++) {
        out->position_m_q16[k] = value[k];
        out->velocity_mps_q16[k] = rate[k];
        out->position_std_m_q32[k] = std[k];
    }
    angles_of(&out->yaw_rad_q16, &out->pitch_rad_q16, value[DROGUE_YAW], value[DROGUE_PITCH]);
    drogue_pose_axis(out->axis_q16, out->yaw_rad_q16, out->pitch_rad_q16);
    out->orientation_resolved = track->orientation_known && track->turned == 0;
    out->yaw_std_rad_q32 = std[DROGUE_YAW];
    out->pitch_std_rad_q32 = std[DROGUE_PITCH];
    out->axis_std_rad_q32 = axis_std(std[DROGUE_YAW], std[DROGUE_PITCH], out->pitch_rad_q16);
}

void drogue_track_get(drogue_track_estimate *out, const drogue_track *track) { estimate(out, track, track->missed); }

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

/* Where a point is seen; 0 when it is not. */
static int seen_at(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, const drogue_q16 position_m_q16[3],
                   const drogue_camera *camera)
{
    drogue_pose pose;
    memset(&pose, 0, sizeof pose);
    memcpy(pose.position_m_q16, position_m_q16, sizeof pose.position_m_q16);
    return drogue_project_axis_point(x_px_q16, y_px_q16, &pose, 0, camera) == DROGUE_OK &&
           (!drogue_camera_distorts(camera) || drogue_distort_point(x_px_q16, y_px_q16, camera) == DROGUE_OK);
}

/* While refused measurements are followed as well: the middle of both predictions, and half their distance more spread,
 * when they are near each other. */
static void hold_second(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, drogue_real *spread, const drogue_track *track,
                        const drogue_real *semi_axis_px)
{
    drogue_q16 value[DROGUE_PARAMETERS];
    drogue_q16 x;
    drogue_q16 y;
    drogue_q16 dx;
    drogue_q16 dy;
    drogue_real half;
    drogue_real most;
    if (track->agreeing == 0) {
        return;
    }
    drogue_kalman_state(value, &track->second, 0);
    if (!seen_at(&x, &y, value, &track->camera)) {
        return;
    }
    dx = drogue_q16_sub(x, *x_px_q16) / 2;
    dy = drogue_q16_sub(y, *y_px_q16) / 2;
    drogue_real_set(&half, (int64_t)drogue_isqrt_u64(drogue_square_sum(dx, dy)), -16);
    drogue_real_quotient(&half, &half, semi_axis_px);
    drogue_real_set_q16(&most, MOST_APART / 2);
    if (drogue_real_order(&half, &most) > 0) {
        return;
    }
    *x_px_q16 = drogue_q16_add(*x_px_q16, dx);
    *y_px_q16 = drogue_q16_add(*y_px_q16, dy);
    drogue_real_sum(spread, spread, &half);
}

/* Regions about the predicted outline; 0 when the prediction cannot be seen.
 * What drogue_measure() bears at a side of 2.5 semi-axes: an outline 0.4 semi-axes away from the middle, and at that a
 * side a tenth larger. */
static int predicted_region(drogue_region *region, drogue_track *track)
{
    drogue_track_estimate predicted;
    drogue_real semi_axis_px;
    drogue_real spread;
    drogue_real scale;
    drogue_real grown;
    drogue_real most;
    drogue_q16 x;
    drogue_q16 y;
    estimate(&predicted, track, track->missed + 1);
    if (!seen_at(&x, &y, predicted.position_m_q16, &track->camera)) {
        return 0;
    }
    drogue_real_set_q16(&semi_axis_px, track->model.rim_radius_m_q16);
    drogue_real_set_q16(&scale, predicted.position_m_q16[2]);
    drogue_real_quotient(&semi_axis_px, &semi_axis_px, &scale);
    drogue_real_set_q16(&scale, track->camera.fx_px_q16 > track->camera.fy_px_q16 ? track->camera.fx_px_q16
                                                                                  : track->camera.fy_px_q16);
    drogue_real_product(&semi_axis_px, &scale, &semi_axis_px);
    predicted_spread(&spread, &predicted, track);
    hold_second(&x, &y, &spread, track, &semi_axis_px);
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
        drogue_q16 agile[DROGUE_PARAMETERS];
        int p;
        for (p = 0; p < DROGUE_PARAMETERS; p++) {
            agile[p] = drogue_q16_mul(drogue_q16_mul(track->config.process_std_q16[p], track->config.process_step_q16),
                                      track->config.process_step_q16);
        }
        drogue_kalman_predict(&track->second, dt_us, agile);
    }
    if (track->state != DROGUE_LOST) {
        drogue_bank_predict(&track->bank, dt_us, track->config.process_std_q16, track->config.process_step_q16);
        drogue_bank_mix(&track->filter, &track->bank, 0);
        if (predicted_region(region, track)) {
            return;
        }
        track->state = DROGUE_LOST;
    }
    *region = track->first_region;
    track->reach = track->first_region;
    track->search = track->first_region.width_px <= 0;
}

/* Is an outline that was measured while it may be elsewhere to be believed? Cut ones are drawn to what cuts them. */
static int whole(const drogue_result *result, const drogue_model *model)
{
    return result->cover_q16 >= DROGUE_Q16(9, 10) || drogue_result_sure(result, model);
}

/* Look where the drogue is expected, then where it may be. */
static void look(drogue_result *result, const drogue_region *region, const drogue_track *track,
                 drogue_workspace *workspace, drogue_search *search, const drogue_setup *setup,
                 const drogue_image *image)
{
    const int lost = track->state == DROGUE_LOST;
    if (region->width_px <= 0) { /* lost, and the first region is the whole frame */
        (void)drogue_acquire(result, workspace, search, setup, image, NULL);
        return;
    }
    (void)drogue_measure(result, workspace, setup, image, region);
    if (result->status == DROGUE_OK && !lost && track->search && !whole(result, &track->model)) {
        result->status = DROGUE_E_UNSURE;
    }
    if (drogue_measurement_counts(result, &track->config) || (!lost && !track->search)) {
        return;
    }
    (void)drogue_acquire(&search->found, workspace, search, setup, image, lost ? NULL : &track->reach);
    if (drogue_measurement_counts(&search->found, &track->config)) {
        *result = search->found;
        return;
    }
    memset(&result->list, 0, sizeof result->list); /* the workspace holds the search's */
}

/* Is it time to look whether the drogue is elsewhere? */
static int in_doubt(drogue_track *track)
{
    if (track->state == DROGUE_LOST || track->model.inner_radius_m_q16 <= 0 || track->config.reconsider_frames == 0 ||
        track->open_frames == 0 || track->missed > 0) {
        return 0;
    }
    return track->open_frames % track->config.reconsider_frames == 0;
}

/* Would a workspace's width, which a predicted region is made as wide as, still hold the rim: two semi-axes? In a
 * narrower ring only what lies within the rim is left. */
static int holds_rim(const drogue_workspace *workspace, const drogue_region *region, const drogue_track_config *config)
{
    return (int64_t)workspace->capacity.width_px * config->region_scale_q16 >=
           (int64_t)region->width_px * (2 * DROGUE_Q16_ONE);
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
    if (track->state != DROGUE_LOST && holds_rim(workspace, region, &track->config)) {
        drogue_workspace_narrow(region, workspace, image);
    }
    if (in_doubt(track) && drogue_acquire(result, workspace, search, &setup, image, NULL) == DROGUE_OK &&
        drogue_measurement_counts(result, &track->config) && result->orientation_resolved) {
        track->state = DROGUE_LOST; /* begin anew from this */
        return drogue_track_end(track, result);
    }
    look(result, region, track, workspace, search, &setup, image);
    return drogue_track_end(track, result);
}
