/* SPDX-License-Identifier: Apache-2.0 */
/* Tracking: the gate, the choice between twin poses, and who is believed after a jump. */
#include <string.h>

#include "drogue/track.h"

/* One of a result's two poses as the filter takes it. */
typedef struct measurement {
    drogue_q16 value_q16[DROGUE_PARAMETERS];
    drogue_q16 std_q16[DROGUE_PARAMETERS];
    drogue_real noise[DROGUE_PACKED_MAX]; /* covariance in the filter's order */
} measurement;

static drogue_q16 at_least_one(drogue_q16 v) { return v < 1 ? 1 : v; }

/* Noise from the configured standard deviations. */
static void configured_noise(measurement *m, const drogue_track_config *c)
{
    const drogue_q16 z = m->value_q16[DROGUE_Z];
    int p;
    m->std_q16[DROGUE_X] = m->std_q16[DROGUE_Y] = at_least_one(drogue_q16_mul(c->lateral_std_q16, z));
    m->std_q16[DROGUE_Z] = at_least_one(drogue_q16_mul(c->depth_std_q16, z));
    m->std_q16[DROGUE_PITCH] = m->std_q16[DROGUE_YAW] = at_least_one(c->angle_std_rad_q16);
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        drogue_real *variance = &m->noise[DROGUE_PACKED(p, p)];
        drogue_real_set_q16(variance, m->std_q16[p]);
        drogue_real_product(variance, variance, variance);
    }
}

/* Noise from the result's covariance, whose order ends with yaw, pitch. The pose's twin has the same variances and the
 * same correlations of position; those of its angles are its own, not known, and count as none. */
static void measured_noise(measurement *m, const drogue_result *result, int twin, const drogue_track_config *c)
{
    static const int from[DROGUE_PARAMETERS] = {0, 1, 2, 4, 3};
    int p;
    int q;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        const int64_t own_q48 = result->covariance_q48[from[p]][from[p]];
        drogue_real *variance = &m->noise[DROGUE_PACKED(p, p)];
        drogue_real own;
        drogue_real_set_q16(variance, at_least_one(p == DROGUE_PITCH || p == DROGUE_YAW ? c->angle_floor_rad_q16
                                                                                        : c->position_floor_m_q16));
        drogue_real_product(variance, variance, variance);
        drogue_real_set(&own, own_q48 > 0 ? own_q48 : 0, -48);
        drogue_real_sum(variance, &own, variance);
        drogue_real_root(&own, variance);
        m->std_q16[p] = at_least_one(drogue_real_to_q16(own));
        for (q = 0; q < p && !(twin && p > DROGUE_Z); q++) {
            drogue_real_set(&m->noise[DROGUE_PACKED(p, q)], result->covariance_q48[from[p]][from[q]], -48);
        }
    }
}

static void read_pose(measurement *m, const drogue_result *result, int twin, const drogue_track_config *c)
{
    const drogue_pose *pose = twin ? &result->alternative : &result->pose;
    memset(m, 0, sizeof *m);
    m->value_q16[DROGUE_X] = pose->position_m_q16[0];
    m->value_q16[DROGUE_Y] = pose->position_m_q16[1];
    m->value_q16[DROGUE_Z] = pose->position_m_q16[2];
    m->value_q16[DROGUE_PITCH] = pose->pitch_rad_q16;
    m->value_q16[DROGUE_YAW] = pose->yaw_rad_q16;
    if (result->covariance_q48[0][0] > 0) {
        measured_noise(m, result, twin, c);
    } else {
        configured_noise(m, c);
    }
}

/* An outline that its region cut and no second look made whole may be another than it seems: what it lacks of its
 * circumference, by third parts, is off beside its own noise, in semi-axes sideways, in distances along the axis and in rad. */
static void doubt_if_cut(measurement *m, const drogue_result *result, drogue_q16 rim_radius_m_q16)
{
    const drogue_q16 lacking_q16 = (DROGUE_Q16_ONE - result->cover_q16) / 3;
    int p;
    if (result->second_look <= DROGUE_SECOND_BETTER) {
        return;
    }
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        drogue_real *variance = &m->noise[DROGUE_PACKED(p, p)];
        drogue_real more;
        drogue_real_set_q16(&more, lacking_q16);
        if (p <= DROGUE_Z) {
            drogue_real of;
            drogue_real_set_q16(&of, p == DROGUE_Z ? m->value_q16[p] : rim_radius_m_q16);
            drogue_real_product(&more, &more, &of);
        }
        drogue_real_product(&more, &more, &more);
        drogue_real_sum(variance, variance, &more);
        drogue_real_root(&more, variance);
        m->std_q16[p] = at_least_one(drogue_real_to_q16(more));
    }
}

/* Squared distance from a filter's prediction against a gate. */
static int passes(const drogue_kalman *filter, const measurement *m, int n, drogue_q16 gate_q16)
{
    drogue_real distance2;
    drogue_real gate;
    drogue_kalman_distance2(&distance2, filter, m->value_q16, m->noise, n);
    drogue_real_set_q16(&gate, gate_q16);
    return drogue_real_order(&distance2, &gate) <= 0;
}

static void restart(drogue_kalman *filter, int p, drogue_q16 value_q16, drogue_q16 std_q16,
                    const drogue_track_config *c)
{
    drogue_q16 std[3];
    std[0] = std_q16;
    std[1] = c->start_rate_std_q16;
    std[2] = c->start_accel_std_q16;
    drogue_kalman_restart(filter, p, value_q16, std);
}

/* A filter that knows this measurement alone. */
static void start(drogue_kalman *filter, const measurement *m, const drogue_track_config *c)
{
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        restart(filter, p, m->value_q16[p], m->std_q16[p], c);
    }
}

/* Forget the angles: the measurement at hand will say. */
static void forget_angles(drogue_kalman *filter, const measurement *m, const drogue_track_config *c)
{
    const drogue_q16 unknown_rad_q16 = DROGUE_Q16_ONE;
    restart(filter, DROGUE_PITCH, m->value_q16[DROGUE_PITCH], unknown_rad_q16, c);
    restart(filter, DROGUE_YAW, m->value_q16[DROGUE_YAW], unknown_rad_q16, c);
}

/* Correct a filter. Off the optical axis the errors of x and y are mostly that of z, times the tangent of the bearing:
 * the filter, whose parameters are independent, would take a wrong z for a wrong x. So what z's correction leaves of
 * its innovation, r, is taken out of x and y by their regression on z, k = N_xz / N_zz: x - k r, with variance
 * N_xx - k^2 N_zz of its own and k^2 P_zz of the corrected z. */
static void correct(drogue_kalman *filter, const measurement *m, const drogue_track_config *c)
{
    const drogue_real *zz = &m->noise[DROGUE_PACKED(DROGUE_Z, DROGUE_Z)];
    const drogue_kalman3 *z = &filter->parameter[DROGUE_Z];
    measurement own = *m;
    drogue_real variance; /* of the corrected z */
    drogue_real rest;
    drogue_real least;
    drogue_real k;
    drogue_real k2;
    drogue_real t;
    int p;
    drogue_real_sum(&t, &z->variance[0], zz);
    drogue_real_quotient(&t, zz, &t);
    drogue_real_set_q16(&rest, m->value_q16[DROGUE_Z]);
    drogue_real_difference(&rest, &rest, &z->state[0]);
    drogue_real_product(&rest, &rest, &t);
    drogue_real_product(&variance, &z->variance[0], &t);
    drogue_real_set_q16(&least, at_least_one(c->position_floor_m_q16));
    drogue_real_product(&least, &least, &least);
    for (p = DROGUE_X; p <= DROGUE_Y; p++) {
        drogue_real_quotient(&k, &m->noise[DROGUE_PACKED(DROGUE_Z, p)], zz);
        drogue_real_product(&k2, &k, &k);
        drogue_real_copy(&t, &m->noise[DROGUE_PACKED(p, p)]);
        drogue_real_subtract_product(&t, &k2, zz);
        if (drogue_real_order(&t, &least) < 0) {
            t = least;
        }
        drogue_real_product(&k2, &k2, &variance);
        drogue_real_sum(&t, &t, &k2);
        drogue_real_root(&t, &t);
        own.std_q16[p] = at_least_one(drogue_real_to_q16(t));
        drogue_real_product(&k, &k, &rest);
        drogue_real_set_q16(&t, m->value_q16[p]);
        drogue_real_difference(&t, &t, &k);
        own.value_q16[p] = drogue_real_to_q16(t);
    }
    drogue_kalman_correct(filter, own.value_q16, own.std_q16);
}

static drogue_track_state believe(drogue_track *track, const measurement *m)
{
    correct(&track->filter, m, &track->config);
    track->missed = 0;
    track->agreeing = 0;
    track->state = DROGUE_TRACKING;
    return track->state;
}

/* A new filter begins. */
static void take_over(drogue_track *track, int orientation_known)
{
    track->orientation_known = orientation_known;
    track->open_frames = 0;
    track->turned = 0;
    track->agreeing = 0;
    track->missed = 0;
    track->state = DROGUE_TRACKING;
}

/* A refused measurement: the second filter follows it, and takes over when it has followed long enough. */
static drogue_track_state refuse(drogue_track *track, const measurement *m, int resolved)
{
    const drogue_track_config *c = &track->config;
    track->gated = 1;
    track->missed++;
    if (track->agreeing > 0 && passes(&track->second, m, DROGUE_PARAMETERS, c->gate_q16)) {
        correct(&track->second, m, c);
        track->agreeing++;
        track->second_known |= resolved;
    } else {
        start(&track->second, m, c);
        track->agreeing = 1;
        track->second_known = resolved;
    }
    track->state = DROGUE_COASTING;
    if (track->agreeing >= c->agree_frames || track->missed > c->max_missed) {
        track->filter = track->second;
        track->gated = 0;
        take_over(track, track->second_known);
    }
    return track->state;
}

/* The orientation is open: the pose nearer to the prediction. */
static drogue_track_state end_unresolved(drogue_track *track, const measurement *pose, const measurement *twin)
{
    const measurement *nearer;
    drogue_real d;
    drogue_real e;
    drogue_kalman_distance2(&d, &track->filter, pose->value_q16, pose->noise, DROGUE_PARAMETERS);
    drogue_kalman_distance2(&e, &track->filter, twin->value_q16, twin->noise, DROGUE_PARAMETERS);
    nearer = drogue_real_order(&e, &d) < 0 ? twin : pose;
    if (!passes(&track->filter, nearer, DROGUE_PARAMETERS, track->config.gate_q16)) {
        return refuse(track, nearer, 0);
    }
    track->open_frames++;
    return believe(track, nearer);
}

static drogue_track_state end_resolved(drogue_track *track, const measurement *pose, const measurement *twin)
{
    const drogue_track_config *c = &track->config;
    int fits;
    track->open_frames = 0;
    if (passes(&track->filter, pose, DROGUE_PARAMETERS, c->gate_q16)) {
        track->orientation_known = 1;
        track->turned = 0;
        return believe(track, pose);
    }
    fits = track->orientation_known ? passes(&track->filter, twin, DROGUE_PARAMETERS, c->gate_q16)
                                    : passes(&track->filter, pose, 3, c->position_gate_q16);
    if (!fits) {
        return refuse(track, pose, 1);
    }
    track->turned++;
    if (track->orientation_known && track->turned < c->agree_frames) {
        return believe(track, twin);
    }
    forget_angles(&track->filter, pose, c);
    track->orientation_known = 1;
    track->turned = 0;
    return believe(track, pose);
}

static drogue_track_state end_missed(drogue_track *track)
{
    track->missed++;
    if (track->state != DROGUE_LOST) {
        track->state = track->missed > track->config.max_missed ? DROGUE_LOST : DROGUE_COASTING;
    }
    if (track->state == DROGUE_LOST) {
        track->agreeing = 0;
    }
    return track->state;
}

drogue_track_state drogue_track_end(drogue_track *track, const drogue_result *result)
{
    measurement pose;
    measurement twin;
    if (result->status != DROGUE_OK) {
        return end_missed(track);
    }
    read_pose(&pose, result, 0, &track->config);
    read_pose(&twin, result, 1, &track->config);
    doubt_if_cut(&pose, result, track->model.rim_radius_m_q16);
    doubt_if_cut(&twin, result, track->model.rim_radius_m_q16);
    if (track->state == DROGUE_LOST) {
        start(&track->filter, &pose, &track->config);
        take_over(track, result->orientation_resolved);
        return track->state;
    }
    return result->orientation_resolved ? end_resolved(track, &pose, &twin) : end_unresolved(track, &pose, &twin);
}
