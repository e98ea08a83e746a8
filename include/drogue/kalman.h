/* SPDX-License-Identifier: Apache-2.0 */
/* Kalman filter over frames: 15 states, five pose parameters with velocity and acceleration (paper (35)-(40) with
 * the prediction from the posterior state). Noise is diagonal over the parameters, so the filter is five
 * independent filters of three states: the same numbers, a fraction of the work.
 *
 * A covariance is kept as its factors L D L' (Bierman 1977, Thornton 1976), L unit lower triangular, D diagonal and
 * never negative: whatever is rounded it stays symmetric and positive. */
#ifndef DROGUE_KALMAN_H
#define DROGUE_KALMAN_H

#include "drogue/cholesky.h"
#include "drogue/real.h"
#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Order of the parameters, as in (37). */
enum { DROGUE_X = 0, DROGUE_Y = 1, DROGUE_Z = 2, DROGUE_PITCH = 3, DROGUE_YAW = 4, DROGUE_PARAMETERS = 5 };

/* One parameter: value, rate, acceleration, and the factors of their covariance. variance[0] is that of the value. */
typedef struct drogue_kalman3 {
    drogue_real state[3];    /* value, rate, acceleration; m or rad, and s */
    drogue_real rest;        /* of the value, below its last place: rates are differences of values over short times */
    drogue_real variance[3]; /* D: of the value; of the rate given the value; of the acceleration given both */
    drogue_real slope[3];    /* L: of the rate over the value, of the acceleration over the value and over the rate */
} drogue_kalman3;

/* The filter: one of three states for each parameter. */
typedef struct drogue_kalman {
    drogue_kalman3 parameter[DROGUE_PARAMETERS]; /* in the order above */
} drogue_kalman;

/* Start from a measurement: rate and acceleration 0.
 *
 *  value      m and rad, Q16
 *  std        standard deviations of value, rate and acceleration at the start, Q16, per parameter
 */
void drogue_kalman_init(drogue_kalman *filter, const drogue_q16 value_q16[DROGUE_PARAMETERS],
                        const drogue_q16 std_q16[DROGUE_PARAMETERS][3]);

/* Start one parameter, [0, DROGUE_PARAMETERS), anew; the others stay as they are. */
void drogue_kalman_restart(drogue_kalman *filter, int parameter, drogue_q16 value_q16, const drogue_q16 std_q16[3]);

/* Predict (35), (36): constant acceleration over dt, whose change per step has the given standard deviation s:
 * process noise G s^2 G' with G = (dt^2 / 2, dt, 1).
 *
 *  dt_us    time step, microseconds, any; 0 adds noise only. Pitch and yaw come out less their whole turns
 *  std      of the change of acceleration per step, m/s^2 and rad/s^2, Q16, >= 0
 */
void drogue_kalman_predict(drogue_kalman *filter, uint32_t dt_us, const drogue_q16 std_q16[DROGUE_PARAMETERS]);

/* Correct (40) with one frame's measurement.
 *
 *  value    m and rad, Q16; angles are compared modulo 2 pi
 *  std      of the measurement, Q16, > 0; L in (40) is diagonal
 */
void drogue_kalman_correct(drogue_kalman *filter, const drogue_q16 value_q16[DROGUE_PARAMETERS],
                           const drogue_q16 std_q16[DROGUE_PARAMETERS]);

/* Measured less predicted value of parameter p, [0, DROGUE_PARAMETERS), m or rad; an angle's less its whole turns. */
void drogue_kalman_innovation(drogue_real *out, const drogue_kalman *filter, int p, drogue_q16 value_q16);

/* State k (0 value, 1 rate, 2 acceleration) of every parameter, Q16, saturated. */
void drogue_kalman_state(drogue_q16 out_q16[DROGUE_PARAMETERS], const drogue_kalman *filter, int k);

/* Standard deviations of the values (state 0), Q32, saturated. */
void drogue_kalman_std(int64_t out_q32[DROGUE_PARAMETERS], const drogue_kalman *filter);

/* Squared Mahalanobis distance of a measurement from the filter's values: d' (P + N)^-1 d.
 *
 *  value    m and rad, Q16; angles are compared modulo 2 pi
 *  noise    N, covariance of the measurement's n values, packed (cholesky.h), diagonal > 0. When P + N is not positive
 *           definite to 2^-26, which rounded or false covariances can bring about, its diagonal alone counts
 *  n        the first n parameters in the order above, [1, DROGUE_PARAMETERS]
 */
void drogue_kalman_distance2(drogue_real *out, const drogue_kalman *filter,
                             const drogue_q16 value_q16[DROGUE_PARAMETERS], const drogue_real noise[DROGUE_PACKED_MAX],
                             int n);

#ifdef __cplusplus
}
#endif
#endif
