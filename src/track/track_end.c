/* SPDX-License-Identifier: Apache-2.0 */
/* Tracking: the gate, the choice between twin poses, and who is believed after a jump. */
#include <string.h>

#include "drogue/track.h"
#include "measurement.h"

#define NEAR_TWIN DROGUE_Q16(3, 1) /* times the gate: so near, a twin may be what the next frames show */
#define TRIAL_FRAMES 5             /* in which a track that began with an inner part must show it again */

/* Squared distance from a filter's prediction against a gate. */
static int passes(const drogue_kalman *filter, const drogue_measurement *m, int n, drogue_q16 gate_q16)
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
static void start(drogue_kalman *filter, const drogue_measurement *m, const drogue_track_config *c)
{
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        restart(filter, p, m->value_q16[p], m->std_q16[p], c);
    }
}

/* The bank and the estimate from one filter. */
static void begin_with(drogue_track *track, const drogue_kalman *filter)
{
    drogue_bank_start(&track->bank, filter);
    drogue_bank_mix(&track->filter, &track->bank, 0);
}

/* Forget the angles: the measurement at hand will say. */
static void forget_angles(drogue_track *track, const drogue_measurement *m)
{
    const drogue_q16 unknown_rad_q16 = DROGUE_Q16_ONE;
    int i;
    for (i = 0; i < DROGUE_BANK_MODELS; i++) {
        restart(&track->bank.model[i], DROGUE_PITCH, m->value_q16[DROGUE_PITCH], unknown_rad_q16, &track->config);
        restart(&track->bank.model[i], DROGUE_YAW, m->value_q16[DROGUE_YAW], unknown_rad_q16, &track->config);
    }
}

/* Correct a filter. Off the optical axis the errors of x and y are mostly that of z, times the tangent of the bearing:
 * the filter, whose parameters are independent, would take a wrong z for a wrong x. So what z's correction leaves of
 * its innovation, r, is taken out of x and y by their regression on z, k = N_xz / N_zz: x - k r, with variance
 * N_xx - k^2 N_zz of its own and k^2 P_zz of the corrected z. */
static void correct(drogue_kalman *filter, const drogue_measurement *m, const drogue_track_config *c)
{
    const drogue_real *zz = &m->noise[DROGUE_PACKED(DROGUE_Z, DROGUE_Z)];
    const drogue_kalman3 *z = &filter->parameter[DROGUE_Z];
    drogue_measurement own = *m;
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
    drogue_real_set_q16(&least, drogue_at_least_one(c->position_floor_m_q16));
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
        own.std_q16[p] = drogue_at_least_one(drogue_real_to_q16(t));
        drogue_real_product(&k, &k, &rest);
        drogue_real_set_q16(&t, m->value_q16[p]);
        drogue_real_difference(&t, &t, &k);
        own.value_q16[p] = drogue_real_to_q16(t);
    }
    drogue_kalman_correct(filter, own.value_q16, own.std_q16);
}

/* What the estimate's standard deviations keep of a measurement: its doubt, and as long as the orientation is open it
 * may be the twin. */
static void keep_noise(drogue_track *track, const drogue_measurement *m)
{
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        track->noise[p] = m->noise[DROGUE_PACKED(p, p)];
        if (p <= DROGUE_Z) {
            drogue_real_sum(&track->noise[p], &track->noise[p], &m->doubt[p]);
        }
        if (!track->orientation_known) {
            drogue_real_sum(&track->noise[p], &track->noise[p], &m->apart[p]);
        }
    }
}

/* A camera that shakes adds to the innovations, from one frame to the next, what the filters take for noise. Its
 * variance is what is in them beyond twice that of prediction and measurement: of so much of what the correction left
 * the estimate is nearer the measurement. */
static void share_shake(drogue_real share[DROGUE_PARAMETERS], const drogue_track *track, const drogue_measurement *m)
{
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        const int32_t model = track->bank.chosen[p];
        const drogue_real *noise = &m->noise[DROGUE_PACKED(p, p)];
        drogue_real expected;
        drogue_real shake;
        drogue_real_sum(&expected, &track->bank.model[model].parameter[p].variance[0], noise);
        drogue_real_shift(&expected, 1);
        drogue_real_difference(&shake, &track->bank.error2[model][p], &expected);
        drogue_real_sum(&expected, &shake, noise);
        drogue_real_quotient(&share[p], &shake, &expected);
        if (shake.mantissa < 0) {
            drogue_real_set(&share[p], 0, 0);
        }
    }
}

static drogue_track_state believe(drogue_track *track, const drogue_measurement *m)
{
    int i;
    drogue_bank_weigh(&track->bank, m->value_q16);
    share_shake(track->shake, track, m);
    for (i = 0; i < DROGUE_BANK_MODELS; i++) {
        correct(&track->bank.model[i], m, &track->config);
    }
    drogue_bank_mix(&track->filter, &track->bank, 0);
    for (i = 0; i < DROGUE_PARAMETERS; i++) {
        drogue_real left;
        drogue_kalman_innovation(&left, &track->filter, i, m->value_q16[i]);
        drogue_real_product(&track->shake[i], &track->shake[i], &left);
    }
    keep_noise(track, m);
    track->missed = 0;
    track->agreeing = 0;
    track->state = DROGUE_TRACKING;
    if (m->solid) {
        track->trial = 0;
    } else if (track->trial > 0 && --track->trial == 0) {
        track->state = DROGUE_LOST;
    }
    return track->state;
}

/* What is measured against: a step more agile than the estimate, no narrower than predictions were wrong of late, and
 * with room in depth for what light and lens do to the outline from one frame to the next. */
static void gate_of(drogue_kalman *gate, const drogue_track *track)
{
    drogue_real *depth = &gate->parameter[DROGUE_Z].variance[0];
    drogue_real room;
    int p;
    drogue_bank_mix(gate, &track->bank, 1);
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        drogue_bank_allow(&gate->parameter[p].variance[0], &track->bank, p, track->missed + 1);
    }
    drogue_real_set_q16(&room, track->config.depth_std_q16);
    drogue_real_product(&room, &room, &gate->parameter[DROGUE_Z].state[0]);
    drogue_real_product(&room, &room, &room);
    drogue_real_sum(depth, depth, &room);
}

/* Without an inner part where there should be one, the range must be about what is predicted. */
static int range_fits(const drogue_kalman *filter, const drogue_measurement *m)
{
    drogue_real off;
    drogue_real most;
    if (m->solid) {
        return 1;
    }
    drogue_kalman_innovation(&off, filter, DROGUE_Z, m->value_q16[DROGUE_Z]);
    drogue_real_product(&off, &off, &off);
    drogue_real_set_q16(&most, m->value_q16[DROGUE_Z] / 20);
    drogue_real_product(&most, &most, &most);
    return drogue_real_order(&off, &most) <= 0;
}

/* A new filter begins. */
static void take_over(drogue_track *track, int orientation_known)
{
    memset(track->shake, 0, sizeof track->shake);
    track->trial = 0;
    track->orientation_known = orientation_known;
    track->open_frames = 0;
    track->turned = 0;
    track->agreeing = 0;
    track->missed = 0;
    track->state = DROGUE_TRACKING;
}

/* Refused, or nothing to be followed. */
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

/* A refused measurement: the second filter follows it, and takes over when it has followed long enough. One without the
 * inner part that the model has opens none. */
static drogue_track_state refuse(drogue_track *track, const drogue_measurement *m, int resolved)
{
    const drogue_track_config *c = &track->config;
    track->gated = 1;
    if (!m->solid) {
        return end_missed(track);
    }
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
        begin_with(track, &track->second);
        track->gated = 0;
        take_over(track, track->second_known);
        keep_noise(track, m);
    }
    return track->state;
}

/* The orientation is open: the pose nearer to the prediction. */
static drogue_track_state end_unresolved(drogue_track *track, const drogue_measurement *pose,
                                         const drogue_measurement *twin)
{
    const drogue_track_config *c = &track->config;
    drogue_kalman gate;
    drogue_real d;
    drogue_real e;
    const drogue_measurement *nearer;
    gate_of(&gate, track);
    drogue_kalman_distance2(&d, &gate, pose->value_q16, pose->noise, DROGUE_PARAMETERS);
    drogue_kalman_distance2(&e, &gate, twin->value_q16, twin->noise, DROGUE_PARAMETERS);
    nearer = drogue_real_order(&e, &d) < 0 ? twin : pose;
    if (!passes(&gate, nearer, DROGUE_PARAMETERS, c->gate_q16) || !range_fits(&gate, nearer)) {
        return refuse(track, nearer, 0);
    }
    track->open_frames++;
    if (passes(&gate, nearer == pose ? twin : pose, DROGUE_PARAMETERS, drogue_q16_mul(c->gate_q16, NEAR_TWIN)) ||
        (c->known_frames > 0 && track->open_frames >= c->known_frames)) {
        track->orientation_known = 0;
    }
    return believe(track, nearer);
}

static drogue_track_state end_resolved(drogue_track *track, const drogue_measurement *pose,
                                       const drogue_measurement *twin)
{
    const drogue_track_config *c = &track->config;
    drogue_kalman gate;
    int fits;
    gate_of(&gate, track);
    track->open_frames = 0;
    if (passes(&gate, pose, DROGUE_PARAMETERS, c->gate_q16)) {
        track->orientation_known = 1;
        track->turned = 0;
        return believe(track, pose);
    }
    fits = track->orientation_known ? passes(&gate, twin, DROGUE_PARAMETERS, c->gate_q16)
                                    : passes(&gate, pose, 3, c->position_gate_q16);
    if (!fits) {
        return refuse(track, pose, 1);
    }
    track->turned++;
    if (track->orientation_known && track->turned < c->agree_frames) {
        return believe(track, twin);
    }
    forget_angles(track, pose);
    track->orientation_known = 1;
    track->turned = 0;
    return believe(track, pose);
}

drogue_track_state drogue_track_end(drogue_track *track, const drogue_result *result)
{
    const int inner_known = track->model.inner_radius_m_q16 > 0;
    drogue_measurement pose;
    drogue_measurement twin;
    if (!drogue_measurement_counts(result, &track->config)) {
        return end_missed(track);
    }
    drogue_measurement_read(&pose, result, 0, &track->model, &track->config);
    drogue_measurement_read(&twin, result, 1, &track->model, &track->config);
    if (track->state == DROGUE_LOST) {
        start(&track->filter, &pose, &track->config);
        begin_with(track, &track->filter);
        take_over(track, result->orientation_resolved);
        track->trial = pose.solid && inner_known ? TRIAL_FRAMES : 0;
        keep_noise(track, &pose);
        return track->state;
    }
    return result->orientation_resolved ? end_resolved(track, &pose, &twin) : end_unresolved(track, &pose, &twin);
}
