/* SPDX-License-Identifier: Apache-2.0 */
/* From the two poses that an outline allows to the one that the result gives, with its covariance. */
#ifndef DROGUE_DECIDE_H
#define DROGUE_DECIDE_H

#include "drogue/config.h"
#include "drogue/joint.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a frame says about the pose. */
typedef struct drogue_evidence {
    drogue_ellipse ideal;          /* the outline without distortion, px of the whole image */
    drogue_pose poses[2];          /* from drogue_pose_from_ellipse() */
    uint32_t nearer;               /* index of the one whose projected inner centre is nearer; either without one */
    const drogue_support *support; /* of the outline's last fit */
    drogue_joint_inner inner;      /* std_px_q16 is 0 when there is none */
    drogue_q16 doubt_q16;          /* of the distance, by the inner part's size, as in drogue_inner_evidence */
    drogue_q16 too_far_q16;        /* [0, 1): share by which the outline's pose is, as there */
} drogue_evidence;

/* The pose that a result gives. */
typedef struct drogue_decision {
    drogue_pose pose;             /* unresolved: the nearer one */
    drogue_pose alternative;      /* the other one that the outline allows */
    int32_t orientation_resolved; /* 1: the inner part decided between the two */
    drogue_q16 doubt_q16;         /* that is in the covariance, by drogue_doubt_add() */
    int32_t covariance_halved;    /* so often are all entries halved, for a variance of 2^15 or more to fit; mostly 0 */
    int64_t covariance_q48[5][5]; /* of x, y, z (m), yaw, pitch (rad); Q48, symmetric */
    int64_t position_std_m_q32[3]; /* roots of its first three diagonal entries, not halved, Q32 */
    int64_t axis_std_rad_q32;      /* root mean square angle between measured and true axis, Q32 */
} drogue_decision;

/* Solve for outline and inner part together; for the outline alone where no inner part is to be believed, or where the
 * two contradict each other (chi2 above max_chi2) and neither pose is clearly the better one. That one is resolved
 * where the other pose's chi2 is larger by min_chi2_gap, where they contradict each other by that times chi2: both are
 * wrong by more than they say, and which pose it is stays clear. Where there is an inner part, the covariance is chi2
 * times as large where that, 0.5 on average of frames that are as supposed, is above 1, and max_chi2 times that of the
 * outline alone; and what the inner part's size puts in doubt is added, at least DROGUE_CONTRADICTED_Q16 where they
 * contradict each other, with what another edge outside does. Where the orientation is resolved and the inner part says
 * that the outline's pose is too far, both poses are brought nearer by that share, and at least so much is in doubt: by
 * all of it from a chi2 of 3 on, by none up to 1, and by the less the nearer the frame's smear is to 1.25 px^2, since
 * motion blur moves the disc's edge, too; up to 0.25 px^2 by all. Where the model has an inner part and none is to be
 * believed, the outline may be another edge than the rim, or partly: 1.1 % of its size is added to every parameter of
 * the outline.
 *
 *  out     undefined on failure
 *  return  DROGUE_OK, DROGUE_E_DOMAIN
 */
drogue_status drogue_decide(drogue_decision *out, const drogue_evidence *evidence, const drogue_setup *setup);

#define DROGUE_CONTRADICTED_Q16 DROGUE_Q16(1, 64) /* least doubt where outline and inner part do so */

#define DROGUE_DOUBT_PACKED 6 /* x, y, z: the first entries of a packed covariance that begins with them */

/* A doubt and that of an outline outside which another edge shows: the rim's, of which it is an inner one, all the more
 * likely in more parts. k of its eight parts put k^2 / 640 of the distance in doubt, beside what else does.
 *
 *  outside  [0, 8]
 *  return   root of the sum of squares, below 1, Q16, rounded
 */
drogue_q16 drogue_doubt_outside(drogue_q16 doubt_q16, uint32_t outside);

/* Add a doubt to a covariance. An inner part that is not of its size may be that of a larger outline: half the square
 * of that share of the position, since where it is one, the distance is off by about twice as much. The larger outline
 * lies in another plane and is the more likely the larger the share is: sideways half the square of twice that share's
 * square of the rim's radius.
 *
 *  covariance  m^2, in and out
 *  doubt_q16   share of the distance, [0, 1)
 */
void drogue_doubt_add(drogue_real covariance[DROGUE_DOUBT_PACKED], const drogue_q16 position_m_q16[3],
                      drogue_q16 doubt_q16, drogue_q16 rim_radius_m_q16);

#ifdef __cplusplus
}
#endif
#endif
