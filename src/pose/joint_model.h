/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the joint pose: its numbers, its measurement model, and the weights of what was measured.
 *
 * Numbers are Q42 unless they say otherwise, lengths in radii of the rim. Products are rounded once and saturated at
 * 2^60, that is 2^18: what is right stays well below, as drogue_joint_outline_rows() and the solver verify. */
#ifndef DROGUE_JOINT_MODEL_H
#define DROGUE_JOINT_MODEL_H

#include "drogue/joint.h"

#define DROGUE_JOINT_FRAC 42
#define DROGUE_JOINT_ONE (INT64_C(1) << DROGUE_JOINT_FRAC)
#define DROGUE_JOINT_FIT 5  /* rows of the outline; parameters of the pose */
#define DROGUE_JOINT_ROWS 7 /* with those of the inner part */

/* Pose as the solver moves it. */
typedef struct drogue_joint_state {
    int64_t position[3];
    int64_t angle[2]; /* yaw, pitch */
    int64_t axis[3];
    int64_t turn[2][3]; /* derivatives of the axis by yaw and pitch */
} drogue_joint_state;

/* The fitted ellipse's frame as rays: ray(u, v) = first u + second v + third. */
typedef struct drogue_joint_frame {
    int64_t ray[3][3];
} drogue_joint_frame;

/* Slopes of the rows by x, y, z, yaw, pitch, and last the residuals: the outline's in semi-axes, the inner part's two as
 * rays. */
typedef struct drogue_joint_rows {
    int64_t column[DROGUE_JOINT_FIT + 1][DROGUE_JOINT_ROWS];
} drogue_joint_rows;

/* Inverse covariance of the rows, in units of 2^exponent. */
typedef struct drogue_joint_weights {
    int64_t outline[DROGUE_JOINT_FIT][DROGUE_JOINT_FIT];
    int64_t inner[2];
    int32_t exponent;
} drogue_joint_weights;

/* a . b of n terms, exact; |a|, |b| <= 2^62, n <= 7. */
static inline drogue_s128 drogue_joint_products(const int64_t *a, const int64_t *b, int n)
{
    drogue_s128 sum = {0, 0};
    int k;
    for (k = 0; k < n; k++) {
        sum = drogue_s128_add(sum, drogue_s128_mul(a[k], b[k]));
    }
    return sum;
}

/* num / den, Q42, saturated at 2^60; 0 when den is. */
int64_t drogue_joint_ratio(int64_t num, int64_t den);

/* Axis and its derivatives from the angles. */
void drogue_joint_turn(drogue_joint_state *state);

/* State of a pose, and the rays of an ellipse.
 *
 *  return  DROGUE_OK; DROGUE_E_DOMAIN when the pose is 2^16 radii away, or a ray 64 focal lengths off the axis
 */
drogue_status drogue_joint_begin(drogue_joint_state *state, drogue_joint_frame *frame, const drogue_pose *pose,
                                 const drogue_ellipse *ellipse, const drogue_camera *camera, const drogue_model *model);

/* Rows of the outline; those of the inner part become 0.
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
                                      const drogue_joint_inner *inner, const drogue_camera *camera,
                                      const drogue_model *model);

/* Weights from the outline's covariance and the inner part's standard deviation.
 *
 *  root         working space, as is 'information'
 *  return       DROGUE_OK; DROGUE_E_DEGENERATE when the covariance is not positive definite
 */
drogue_status drogue_joint_weigh(drogue_joint_weights *out, drogue_wide root[DROGUE_PACKED_MAX],
                                 drogue_wide information[DROGUE_PACKED_MAX], const drogue_joint_outline *outline,
                                 const drogue_joint_inner *inner, const drogue_camera *camera);

#endif
