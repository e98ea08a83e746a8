/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the joint pose: its numbers, its measurement model, and the weights of what was measured. Lengths are in radii
 * of the rim unless they say otherwise. */
#ifndef DROGUE_JOINT_MODEL_H
#define DROGUE_JOINT_MODEL_H

#include "drogue/joint.h"

#define DROGUE_JOINT_FIT 5 /* rows of the outline; parameters of the pose */

/* Pose as the solver moves it. */
typedef struct drogue_joint_state {
    int32_t position_q30[3];  /* in units of 2^scale radii: below 1, the largest at least a quarter */
    int scale;                /* -8 .. 16 */
    int32_t angle_rad_q29[2]; /* yaw, pitch */
    int32_t axis_q30[3];
    int32_t turn_q30[2][3]; /* derivatives of the axis by yaw and pitch */
} drogue_joint_state;

/* What is measured: the fitted ellipse's frame as rays, ray(u, v) = first u + second v + third, and the inner part. */
typedef struct drogue_joint_frame {
    int32_t ray_q29[3][3];
    drogue_real inner[2]; /* ray */
    drogue_real depth;
    drogue_real radius;
} drogue_joint_frame;

/* Slopes of the rows by one of x, y, z, yaw, pitch, or the residuals. */
typedef struct drogue_joint_column {
    int32_t outline[DROGUE_JOINT_FIT]; /* 2^exponent semi-axes */
    int32_t exponent;
    drogue_real inner[2]; /* rays */
} drogue_joint_column;

/* Of all parameters, and last the residuals. */
typedef struct drogue_joint_rows {
    drogue_joint_column column[DROGUE_JOINT_FIT + 1];
} drogue_joint_rows;

/* Bring n <= 6 numbers to one scale: the largest lands in [2^29, 2^30).
 *
 *  return  e such that in[i] = out[i] * 2^e, to half a unit
 */
int drogue_joint_squeeze(int32_t *out, const int64_t *in, int n);

/* Axis and its derivatives from the angles. */
void drogue_joint_turn(drogue_joint_state *state);

/* Bring the position to its range. */
void drogue_joint_rescale(drogue_joint_state *state);

/* State of a pose.
 *
 *  return  DROGUE_OK; DROGUE_E_DOMAIN when the pose is 2^16 radii away, or an angle beyond its range
 */
drogue_status drogue_joint_place(drogue_joint_state *state, const drogue_pose *pose, const drogue_model *model);

/* Depth and radius of the inner disc. */
void drogue_joint_size_disc(drogue_joint_frame *frame, const drogue_model *model);

/* State of a pose, and what was measured; 'inner' counts where its std_px_q16 is above 0.
 *
 *  return  DROGUE_OK; DROGUE_E_DOMAIN when the pose is 2^16 radii away, or a ray two focal lengths off the axis
 */
drogue_status drogue_joint_begin(drogue_joint_state *state, drogue_joint_frame *frame, const drogue_pose *pose,
                                 const drogue_ellipse *ellipse, const drogue_joint_inner *inner,
                                 const drogue_camera *camera, const drogue_model *model);

/* Rows of the outline.
 *
 *  return  DROGUE_OK; DROGUE_E_DOMAIN when the pose has nothing to do with the measurement: numbers would be too large
 */
drogue_status drogue_joint_outline_rows(drogue_joint_rows *out, const drogue_joint_state *state,
                                        const drogue_joint_frame *frame);

/* Rows of the inner part.
 *
 *  return  DROGUE_OK; DROGUE_E_BEHIND_CAMERA; DROGUE_E_DOMAIN
 */
drogue_status drogue_joint_inner_rows(drogue_joint_rows *out, const drogue_joint_state *state,
                                      const drogue_joint_frame *frame);

/* As drogue_joint_solve(), which asks for the covariance; without it that is left as it is. */
drogue_status drogue_joint_settle(drogue_joint *out, const drogue_pose *start, const drogue_joint_outline *outline,
                                  const drogue_joint_inner *inner, const drogue_camera *camera,
                                  const drogue_model *model, int steps, int with_covariance);

/* Inverse variances of the inner part's rows; 0 where there is none. */
void drogue_joint_weigh_inner(drogue_real out[2], const drogue_joint_inner *inner, const drogue_camera *camera);

#endif
