/* SPDX-License-Identifier: Apache-2.0 */
/* Results of frames as the tracker takes them, without images. */
#ifndef DROGUE_TESTS_RESULTS_H
#define DROGUE_TESTS_RESULTS_H

#include "drogue/drogue.h"
#include "geometry.h"

static inline void set_pose(drogue_pose *p, const double position[3], double yaw, double pitch)
{
    double axis[3];
    int k;
    axis_of_angles(axis, yaw, pitch);
    for (k = 0; k < 3; k++) {
        p->position_m_q16[k] = q16_of(position[k]);
        p->axis_q16[k] = q16_of(axis[k]);
    }
    p->yaw_rad_q16 = q16_of(yaw);
    p->pitch_rad_q16 = q16_of(pitch);
}

static inline drogue_result seen(double x, double y, double z, double yaw, double pitch)
{
    drogue_result r;
    const double position[3] = {x, y, z};
    memset(&r, 0, sizeof r);
    r.status = DROGUE_OK;
    r.orientation_resolved = 1;
    set_pose(&r.pose, position, yaw, pitch);
    r.alternative = r.pose;
    return r;
}

static inline drogue_result missed(drogue_status status)
{
    drogue_result r;
    memset(&r, 0, sizeof r);
    r.status = status;
    return r;
}

/* Give a result the covariance of independent errors of x, y, z, yaw, pitch. */
static inline void set_covariance(drogue_result *r, const double std[5])
{
    int k;
    for (k = 0; k < 5; k++) {
        r->covariance_q48[k][k] = (int64_t)(std[k] * std[k] * 281474976710656.0);
    }
}

#endif
