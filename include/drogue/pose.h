/* SPDX-License-Identifier: Apache-2.0 */
/* Pose of a circle of known radius from its image ellipse: the cone through the ellipse, both circles on it
 * (paper (18)-(34) with the corrections of signs), and the choice between them by the inner centre. */
#ifndef DROGUE_POSE_H
#define DROGUE_POSE_H

#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Pose: centre of the end plane and unit axis into the drogue, camera frame (x right, y down, z forward). */
typedef struct drogue_pose {
    drogue_q16 position_m_q16[3]; /* x, y, z of the centre */
    drogue_q16 axis_q16[3];       /* unit vector into the drogue */
    drogue_q16 yaw_rad_q16;       /* atan2(axis.x, axis.z) */
    drogue_q16 pitch_rad_q16;     /* asin(axis.y) */
} drogue_pose;

/* Is the yaw within pi and the pitch within pi / 2? */
static inline int drogue_pose_angles_valid(const drogue_pose *p)
{
    return p->yaw_rad_q16 <= DROGUE_Q16_PI && p->yaw_rad_q16 >= -DROGUE_Q16_PI &&
           p->pitch_rad_q16 <= DROGUE_Q16_HALF_PI && p->pitch_rad_q16 >= -DROGUE_Q16_HALF_PI;
}

/* Unit vector of a yaw and a pitch, each in (-4, 4) rad. */
void drogue_pose_axis(drogue_q16 axis_q16[3], drogue_q16 yaw_rad_q16, drogue_q16 pitch_rad_q16);

/* Both poses that an ellipse allows.
 *
 *  out      the two poses, equal when the circle is seen head-on; their order carries no meaning
 *  ellipse  undistorted, px of the whole image
 *  camera   fx, fy, cx, cy; distortion is ignored
 *  radius   rim radius, > 0
 *  return   DROGUE_OK, DROGUE_E_DOMAIN (ellipse flat or empty, its angle beyond pi / 2, camera without focal length,
 *           position beyond Q16, or so near that its z rounds to 0)
 *  scaling  31-bit mantissas; the cone in a frame about its own axis, where its matrix is graded; no overflow
 *  error    position, axis and angles <= 4 LSB against double from the same ellipse, beyond 8 km 2^-27 of the distance,
 *           for a focal length of 300 px and more, a centre within 2 focal lengths of the principal point and axes
 *           1 to 20 at most
 *  source   paper (20)-(30)
 */
drogue_status drogue_pose_from_ellipse(drogue_pose out[2], const drogue_ellipse *ellipse, const drogue_camera *camera,
                                       drogue_q16 radius_m_q16);

/* Image of the point at the given depth behind the end plane on the axis, without distortion, px Q16.
 *
 *  return  DROGUE_OK; DROGUE_E_BEHIND_CAMERA
 *  error   <= 2 LSB where the image lies within 2^13 px, 4 beyond, for a principal point within 2^13 px; beyond Q16
 *          saturated
 */
drogue_status drogue_project_axis_point(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, const drogue_pose *pose,
                                        drogue_q16 depth_m_q16, const drogue_camera *camera);

/* Choice between two poses by the inner centre. */
typedef struct drogue_choice {
    uint32_t index;                /* 0 or 1: the pose whose projected inner centre is nearer */
    drogue_q16 distance_px_q16[2]; /* of the two projections from the measured centre, saturated */
    drogue_q16 ambiguity_q16;      /* nearer distance / farther distance, [0, 1]; 1 when both are 0 */
} drogue_choice;

/* Choose by projecting the inner centre for both poses (replaces (31), which looks at u alone).
 *
 *  x, y    measured inner centre, undistorted, px Q16
 *  return  DROGUE_OK; DROGUE_E_BEHIND_CAMERA
 */
drogue_status drogue_choose_pose(drogue_choice *out, const drogue_pose poses[2], drogue_q16 x_px_q16,
                                 drogue_q16 y_px_q16, drogue_q16 depth_m_q16, const drogue_camera *camera);

#ifdef __cplusplus
}
#endif
#endif
