/* SPDX-License-Identifier: Apache-2.0 */
/* Tracking over frames: the filter's prediction places the next region, a gate keeps outliers out, missed frames are
 * coasted through, and what was lost is searched anew.
 *
 * drogue_track_frame() does a frame in one call. The parts are there too: drogue_track_begin() says where to look,
 * drogue_measure() or drogue_acquire() looks, drogue_track_end() says what to believe.
 *
 * Each parameter is followed by filters side by side that differ in their process noise; the estimate is that of the
 * one that has predicted best (bank.h).
 *
 * The gate is the squared Mahalanobis distance between the five measured and predicted parameters, with the covariance
 * of both, in the model one step more agile than the chosen one and no less than predictions were wrong of late: where
 * a camera shakes no model predicts. There the estimate is nearer the measurement than the filters', whose rates stay
 * smooth. A measurement beyond the gate is not believed and the frame counts as missed; but it opens a second filter
 * beside the first, and when so many frames in a row are refused that agree with each other, or the track would be
 * lost, the second filter takes over: a drogue that truly jumped is followed again. Where the model has an inner part,
 * only a measurement that shows it opens a second filter, one that shows none must agree in range to a twentieth, and a
 * track that does not show it again within five measurements is lost.
 *
 * Of the two poses that an outline allows, one whose orientation is not resolved goes by the smaller distance. A
 * resolved one that the gate refuses gives way to its twin when that passes; after the same number of frames in
 * a row with the same verdict the measurement is believed and the angles start anew. While one twin passes the gate and
 * the other three times that gate the orientation is not known, and what is known expires when nothing decides for
 * long. */
#ifndef DROGUE_TRACK_H
#define DROGUE_TRACK_H

#include "drogue/bank.h"
#include "drogue/measure.h"
#include "drogue/search.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What the estimate rests on. */
typedef enum drogue_track_state {
    DROGUE_LOST = 0,     /* no estimate: the first region, or the whole frame, is searched */
    DROGUE_TRACKING = 1, /* this frame was measured and believed */
    DROGUE_COASTING = 2  /* this frame was missed or refused: the estimate is the prediction */
} drogue_track_state;

/* Name of a state: "lost", "tracking", "coasting"; never NULL. */
const char *drogue_track_state_name(drogue_track_state state);

/* Thresholds of tracking; drogue_track_config_default() fills in the defaults given here. */
typedef struct drogue_track_config {
    uint32_t max_missed;        /* 10 frames: after more in a row, missed or refused, the track is lost */
    uint32_t agree_frames;      /* 4: so many refused measurements that agree are believed, frames without one between
                                        them not counted; at least 1 */
    uint32_t reconsider_frames; /* 50 frames: after so many in a row whose inner part, known to the model, does not
                                   decide, drogue_track_frame() searches the whole frame for one that does; 0: never */
    drogue_q16 min_reliability_q16;  /* 0, [0, 1]: a measurement of less reliability counts as missed */
    drogue_q16 gate_q16;             /* 20.515: chi-square of 5 degrees of freedom at 0.1 % */
    drogue_q16 position_gate_q16;    /* 16.266: the same of 3, where the angles are not compared */
    drogue_q16 region_scale_q16;     /* 2.5: side of the next region in predicted major semi-axes */
    drogue_q16 region_sigmas_q16;    /* 3: standard deviations that region and search allow for */
    int32_t min_region_px;           /* 32 px */
    int32_t max_region_px;           /* DROGUE_MAX_SIDE; see drogue_track_frame() for what the workspace holds */
    drogue_q16 lateral_std_q16;      /* 0.0005: standard deviation of x and y, share of the distance, where a result has
                                       no covariance */
    drogue_q16 depth_std_q16;        /* 0.002: the same of z, share of the distance; the gate allows for it always */
    drogue_q16 angle_std_rad_q16;    /* 0.02 rad: the same of pitch and yaw */
    drogue_q16 position_floor_m_q16; /* 0.0001 m: added in quadrature to the measured standard deviations */
    drogue_q16 angle_floor_rad_q16;  /* 0.0005 rad */
    drogue_q16 process_std_q16[DROGUE_PARAMETERS]; /* change of acceleration per frame: x, y 0.2 m/s^2, z 0.02 m/s^2,
                                                      angles 0.15 rad/s^2; for a swing to 1.1 m at 0.2 Hz and an
                                                      approach at constant speed, 25 to 50 frames a second */
    drogue_q16
        process_step_q16; /* 6: a model's process noise over that of the one before, for gusts of 3 g; at least 1 */
    /* 0.75, [0, 1]: share of a measurement's variance that is the same from frame to frame (shading, lens): the
     * estimate's standard deviations keep it */
    drogue_q16 lasting_share_q16;
    uint32_t known_frames; /* 25: so many measurements in a row that do not decide, and the orientation is not known
                                     any more; 0: it stays known */
    drogue_q16 start_rate_std_q16;  /* 2 m/s and rad/s: of the unknown rate at the start */
    drogue_q16 start_accel_std_q16; /* 15 m/s^2 and rad/s^2 */
} drogue_track_config;

/* Fill in the defaults given above. */
void drogue_track_config_default(drogue_track_config *config);

/* 1 when agree_frames and region_scale_q16 are above 0, process_step is at least 1, lasting_share and min_reliability
 * at most 1, the regions' limits are 1 <= min <= max <= DROGUE_MAX_SIDE, and nothing else is negative. */
int drogue_track_config_valid(const drogue_track_config *config);

/* A track: what is kept from frame to frame. */
typedef struct drogue_track {
    drogue_track_config config; /* as given */
    drogue_camera camera;       /* as given */
    drogue_model model;         /* as given */
    drogue_region first_region; /* width 0: none, the whole frame */
    drogue_track_state state;   /* after the last frame */
    uint32_t missed;            /* frames in a row, missed or refused */
    int32_t gated;              /* 1: this frame's measurement was refused */
    int32_t search;             /* 1: the drogue may be anywhere in 'reach', more than drogue_measure() can cover */
    drogue_region reach; /* square that holds the predicted outline to region_sigmas; like first_region when lost */
    int32_t orientation_known; /* 1: a resolved measurement has chosen between the twin poses */
    uint32_t open_frames;      /* unresolved measurements believed in a row */
    uint32_t turned;           /* resolved measurements in a row that gave way to their twins */
    uint32_t trial;            /* measurements left in which what began the track must show its inner part again */
    uint32_t agreeing;         /* refused measurements in a row that agree; 'second' holds them */
    int32_t second_known;      /* orientation_known of 'second' */
    drogue_bank bank;          /* of filters, one more agile than the other */
    drogue_kalman filter;      /* of the bank's chosen models */
    drogue_kalman second;      /* follows what is refused, as the most agile model */
    drogue_real noise[DROGUE_PARAMETERS]; /* variances of the last measurement believed */
    drogue_real shake[DROGUE_PARAMETERS]; /* what of it the filters take for noise, but is the camera's shaking */
} drogue_track;

/* The filter's estimate, Q16, with standard deviations, Q32. */
typedef struct drogue_track_estimate {
    drogue_q16 position_m_q16[3];   /* x, y, z of the end plane's centre */
    drogue_q16 velocity_mps_q16[3]; /* their rates */
    drogue_q16 axis_q16[3];         /* unit vector into the drogue */
    drogue_q16 yaw_rad_q16;         /* atan2(axis.x, axis.z) */
    drogue_q16 pitch_rad_q16;       /* asin(axis.y) */
    int32_t orientation_resolved;   /* 1: known, and not contradicted by the last measurement that decided */
    int64_t position_std_m_q32[3];  /* of x, y, z */
    int64_t yaw_std_rad_q32;        /* of yaw */
    int64_t pitch_std_rad_q32;      /* of pitch */
    int64_t axis_std_rad_q32;       /* root mean square angle between estimated and true axis */
} drogue_track_estimate;

/* Start lost.
 *
 *  camera, model  examined frame by frame, by drogue_measure(), whose setup has to have the same
 *  first_region   to be searched until something is found; NULL or of no width: the whole frame
 *  return         DROGUE_OK; DROGUE_E_ARGUMENT when drogue_track_config_valid() refuses the configuration: the track is
 *                 all zero then, not to be used. drogue_track_frame() stays lost with it: it has no camera
 */
drogue_status drogue_track_init(drogue_track *track, const drogue_track_config *config, const drogue_camera *camera,
                                const drogue_model *model, const drogue_region *first_region);

/* Begin a frame dt_us after the one before: predict and place the region for drogue_measure().
 *
 *  dt_us   microseconds; 0, a frame once more or one whose time stamp went back, moves nothing and adds the
 *          acceleration's noise. max_missed counts frames: who wants a track to end with a gap in time begins a new one
 *  region  out, may reach past the image; all zero when the whole frame is to be searched. Its side grows by up to a
 *          tenth with the predicted uncertainty, as far as the ring mask bears it; beyond that track->search is set
 */
void drogue_track_begin(drogue_region *region, drogue_track *track, uint32_t dt_us);

/* End the frame with its measurement: correct, refuse, coast or give up. Returns the new state.
 * A result whose second_look kept a cut outline counts for less than its covariance says: by a third of the
 * circumference's share that is not covered, in semi-axes sideways, in distances along the axis and in rad. */
drogue_track_state drogue_track_end(drogue_track *track, const drogue_result *result);

/* The estimate; all zero while lost. */
void drogue_track_get(drogue_track_estimate *out, const drogue_track *track);

/* A frame in one call: begin; measure where the drogue is expected, and when that fails and 'search' is set search
 * where it may be; end. With 'search' set an outline covered to less than nine tenths counts only when
 * drogue_result_sure(). While lost the first region is measured, then the whole frame searched; what the search is sure
 * of starts a track. A track of something else, which shows no inner part, gives way after reconsider_frames when the
 * drogue is in sight.
 *
 *  result  out, the frame's measurement; its region is where it was taken
 *  region  out, the region asked for. One about a prediction is made as wide as the workspace where more of it lies in
 *          the image, while that still holds two predicted semi-axes: so near a drogue is followed
 *  dt_us   as drogue_track_begin() has it
 *  search  memory for a frame as wide as the image
 */
drogue_track_state drogue_track_frame(drogue_result *result, drogue_region *region, drogue_track *track,
                                      drogue_workspace *workspace, drogue_search *search, const drogue_config *config,
                                      const drogue_image *image, uint32_t dt_us);

#ifdef __cplusplus
}
#endif
#endif
