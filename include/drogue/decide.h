/* SPDX-License-Identifier: Apache-2.0 */
/* From the two poses that an outline allows to the one that the result gives, with its covariance. */
#ifndef DROGUE_DECIDE_H
#define DROGUE_DECIDE_H

#include "drogue/drogue.h"
#include "drogue/joint.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Solve for outline and inner part together; for the outline alone when they contradict each other or there is no inner
 * part to be believed.
 *
 *  out      in: ideal; out: pose, alternative, orientation_resolved, covariance and standard deviations
 *  poses    from drogue_pose_from_ellipse()
 *  nearer   index of the pose whose projected inner centre is nearer; either without an inner part
 *  support  of the outline's last fit
 *  inner    std_px_q16 is 0 when there is none
 *  return   DROGUE_OK, DROGUE_E_DOMAIN
 */
drogue_status drogue_decide(drogue_result *out, const drogue_pose poses[2], uint32_t nearer,
                            const drogue_support *support, const drogue_joint_inner *inner, const drogue_config *config,
                            const drogue_camera *camera, const drogue_model *model);

#ifdef __cplusplus
}
#endif
#endif
