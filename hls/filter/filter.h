/* SPDX-License-Identifier: Apache-2.0 */
/* Top of the Kalman filter: a command a frame, the state in a memory of the caller's, so that one block serves several
 * filters. Parameters in the order x y z pitch yaw; m and rad, Q16. */
#ifndef DROGUE_HLS_FILTER_H
#define DROGUE_HLS_FILTER_H

#include "drogue/kalman.h"

enum drogue_hls_filter_command {
    DROGUE_HLS_FILTER_START = 0,   /* begin with 'value', rates and accelerations 0; MEMORY is not read */
    DROGUE_HLS_FILTER_RESTART = 1, /* the same for the parameters in 'which' alone; the others stay as they are */
    DROGUE_HLS_FILTER_STEP = 2,    /* predict over dt_us, correct with 'value' and its standard deviations */
    DROGUE_HLS_FILTER_COAST = 3    /* predict over dt_us */
};

/* Words of the filter's memory: mantissa and exponent of state 0 1 2, variance 0 1 2, slope 0 1 2 and rest of each
 * parameter (drogue_kalman3). */
#define DROGUE_HLS_FILTER_REALS 10
#define DROGUE_HLS_FILTER_WORDS (DROGUE_PARAMETERS * DROGUE_HLS_FILTER_REALS * 2)

/* A step of the filter.
 *
 *  command    drogue_hls_filter_command; which: bit p for parameter p, RESTART only
 *  dt_us      microseconds, [1, 2^31); STEP and COAST
 *  value      measured; START, RESTART, STEP
 *  std        of the measurement, > 0; STEP
 *  noise      standard deviation of the change of acceleration per step, five; then at a start those of value, rate and
 *             acceleration of each parameter
 *  memory     in and out
 *  states     out: five values, five rates, five accelerations, Q16
 *  value_std  out: standard deviations of the values, Q32
 *  return     DROGUE_OK; DROGUE_E_ARGUMENT: 'memory' is left alone, states and value_std are 0
 */
int32_t drogue_hls_filter(uint32_t command, uint32_t which, uint32_t dt_us, const int32_t value[DROGUE_PARAMETERS],
                          const int32_t std[DROGUE_PARAMETERS], const int32_t noise[4 * DROGUE_PARAMETERS],
                          int32_t memory[DROGUE_HLS_FILTER_WORDS], int32_t states[3 * DROGUE_PARAMETERS],
                          int64_t value_std[DROGUE_PARAMETERS]);

#endif
