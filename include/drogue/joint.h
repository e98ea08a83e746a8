/* SPDX-License-Identifier: Apache-2.0 */
/* One pose from outline and inner part together, weighted by their covariances, and the covariance of the pose.
 *
 * The cone through the outline feels the tilt by its cosine alone; the inner part, behind the end plane, feels it
 * linearly. Gauss-Newton steps from a pose that the cone allows find the pose that both agree with best. */
#ifndef DROGUE_JOINT_H
#define DROGUE_JOINT_H

#include "drogue/cholesky.h"
#include "drogue/pose.h"
#include "drogue/support.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The outline as a measurement. A neighbouring ellipse lies off it by
 * r(t) = m0 + m1 cos t + m2 sin t + m3 cos 2t + m4 sin 2t in units of the semi-axes, t the eccentric angle. */
typedef struct drogue_joint_outline {
    drogue_ellipse ellipse;            /* undistorted, px of the whole image */
    int32_t weight[DROGUE_PACKED_MAX]; /* inverse covariance of m0 .. m4, packed, in units of 2^weight_exponent */
    int32_t weight_exponent;           /* of the weights */
} drogue_joint_outline;

/* The inner part as a measurement. */
typedef struct drogue_joint_inner {
    drogue_q16 x_px_q16;   /* centre of the inner disc, undistorted, px of the whole image */
    drogue_q16 y_px_q16;   /* downward */
    drogue_q16 std_px_q16; /* of either coordinate; 0: there is none */
} drogue_joint_inner;

/* Pose from outline and inner part. */
typedef struct drogue_joint {
    drogue_pose pose;                          /* that both agree with best */
    drogue_real covariance[DROGUE_PACKED_MAX]; /* of x, y, z (m), yaw, pitch (rad), packed */
    drogue_real chi2;                          /* squared residuals over their variances: 2 degrees of freedom */
} drogue_joint;

/* Covariance of an outline's parameters from the residuals of its bins, whose scatter about the ellipse measures noise
 * and shape together however far they are correlated along the edge.
 *
 *  covariance  of m0 .. m4 (drogue_joint_outline), packed; undefined on failure
 *  ellipse     the outline, undistorted
 *  support     of the last fit, its bins from any axis
 *  shading     what the residuals cannot show, as light that changes along the outline, moves an edge by this over its
 *              gradient (|gx| + |gy|, grey levels * 8): px times that unit, standard deviation in every parameter
 *  blur        standard deviation of half the variance of the optics' blur, px^2 Q16: moves the whole outline in or
 *              out. What the pixels' grid does, 0.3 px^2 over the semi-axis, is in every parameter
 *  return      DROGUE_OK; DROGUE_E_DEGENERATE when too few bins hold points
 *  source      the fit's normal equations; (50) of the paper in closed form
 */
drogue_status drogue_joint_outline_covariance(drogue_real covariance[DROGUE_PACKED_MAX], const drogue_ellipse *ellipse,
                                              const drogue_support *support, drogue_q16 shading_q16,
                                              drogue_q16 blur_px2_q16);

/* An outline weighed by its covariance: what every solution starts from.
 *
 *  return  DROGUE_OK; DROGUE_E_DEGENERATE when the covariance is not positive definite
 */
drogue_status drogue_joint_outline_weigh(drogue_joint_outline *outline, const drogue_ellipse *ellipse,
                                         const drogue_real covariance[DROGUE_PACKED_MAX]);

/* Solve for the pose.
 *
 *  out      pose, covariance, chi2; undefined on failure
 *  start    a pose from drogue_pose_from_ellipse()
 *  steps    most Gauss-Newton steps after the first, [0, 16], each about squares what is left of the error; a step of
 *           less than 2^-20 rad and of the distance is the last one. 0: none at all, the start itself. Covariance and
 *           chi2 are those of the point before the last step
 *  return   DROGUE_OK; DROGUE_E_BEHIND_CAMERA (the start too); DROGUE_E_DEGENERATE; DROGUE_E_DOMAIN: farther than 2^16
 *           rim radii, rays two focal lengths off the axis, an outline two semi-axes off, angles beyond their ranges
 *  scaling  Q30 and Q29 in 32 bits, lengths in a power of two of the rim radius that follows the distance; sums of
 *           products exact in 64 bits; normal equations with 31-bit mantissas
 *  error    pose <= 1 LSB against double
 */
drogue_status drogue_joint_solve(drogue_joint *out, const drogue_pose *start, const drogue_joint_outline *outline,
                                 const drogue_joint_inner *inner, const drogue_camera *camera,
                                 const drogue_model *model, int steps);

/* Image of the inner disc of a pose.
 *
 *  out     ellipse in ideal pixels, that of the perspective: its centre is not the image of the disc's centre, and off
 *          the optical axis it is longer than it would be there; zero on failure
 *  return  DROGUE_OK; DROGUE_E_BEHIND_CAMERA; DROGUE_E_DOMAIN when it is seen edge-on or from behind, or
 *          two focal lengths and more off the axis
 *  error   as of drogue_project_axis_point() where its centre is within Q16 of the principal point
 */
drogue_status drogue_inner_disc_image(drogue_ellipse *out, const drogue_pose *pose, const drogue_camera *camera,
                                      const drogue_model *model);

#ifdef __cplusplus
}
#endif
#endif
