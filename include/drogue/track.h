/* SPDX-License-Identifier: Apache-2.0 */
/* Tracking over frames: the filter's prediction places the next region; missed frames are coasted through. */
#ifndef DROGUE_TRACK_H
#define DROGUE_TRACK_H

#include "drogue/drogue.h"
#include "drogue/kalman.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum drogue_track_state {
    DROGUE_LOST = 0,     /* no estimate: the first region is searched */
    DROGUE_TRACKING = 1, /* this frame was measured */
    DROGUE_COASTING = 2  /* this frame was missed: the estimate is the prediction */
} drogue_track_state;

/* Name of a state: "lost", "tracking", "coasting"; never NULL. */
const char *drogue_track_state_name(drogue_track_state state);

typedef struct drogue_track_config {
    uint32_t max_missed;                           /* 10 frames: after more in a row the track is lost */
    drogue_q16 region_scale_q16;                   /* 2.5: side of the next region in predicted major semi-axes */
    int32_t min_region_px;                         /* 32 px */
    int32_t max_region_px;                         /* DROGUE_MAX_SIDE; what the workspace holds */
    drogue_q16 lateral_std_q16;                    /* 0.0005: standard deviation of x and y, share of the distance */
    drogue_q16 depth_std_q16;                      /* 0.002: standard deviation of z, share of the distance */
    drogue_q16 angle_std_rad_q16;                  /* 0.02 rad: of pitch and yaw */
    drogue_q16 process_std_q16[DROGUE_PARAMETERS]; /* 0.2 m/s^2, 0.2 rad/s^2: change of acceleration per step */
    drogue_q16 start_rate_std_q16;                 /* 2 m/s and rad/s: of the unknown rate at the start */
    drogue_q16 start_accel_std_q16;                /* 2 m/s^2 and rad/s^2 */
} drogue_track_config;

void drogue_track_config_default(drogue_track_config *config);

typedef struct drogue_track {
    drogue_track_config config;
    drogue_camera camera;
    drogue_model model;
    drogue_region first_region;
    drogue_track_state state;
    uint32_t missed; /* frames in a row */
    drogue_kalman filter;
} drogue_track;

/* The filter's estimate, Q16. */
typedef struct drogue_track_estimate {
    drogue_q16 position_m_q16[3];
    drogue_q16 velocity_mps_q16[3];
    drogue_q16 axis_q16[3];
    drogue_q16 yaw_rad_q16;
    drogue_q16 pitch_rad_q16;
} drogue_track_estimate;

/* Start lost, with the region to search until something is found. */
void drogue_track_init(drogue_track *track, const drogue_track_config *config, const drogue_camera *camera,
                       const drogue_model *model, const drogue_region *first_region);

/* Begin a frame dt_us after the one before: predict and place the region.
 *
 *  region  out, may reach past the image
 */
void drogue_track_begin(drogue_region *region, drogue_track *track, uint32_t dt_us);

/* End the frame with its measurement: correct, coast or give up. When the inner part did not decide, the pose
 * nearer to the predicted axis is taken. Returns the new state. */
drogue_track_state drogue_track_end(drogue_track *track, const drogue_result *result);

/* The estimate; all zero while lost. */
void drogue_track_get(drogue_track_estimate *out, const drogue_track *track);

#ifdef __cplusplus
}
#endif
#endif
