/* SPDX-License-Identifier: Apache-2.0 */
/* Top: one step of the Kalman filter. */
#include "filter.h"

#include <string.h>

static inline void get_real(drogue_real *v, const int32_t words[2])
{
    v->mantissa = words[0];
    v->exponent = words[1];
}

static inline void put_real(int32_t words[2], const drogue_real *v)
{
    words[0] = v->mantissa;
    words[1] = v->exponent;
}

static inline void load(drogue_kalman *filter, const int32_t memory[DROGUE_HLS_FILTER_WORDS])
{
    int p;
    int k;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        const int32_t *words = memory + 2 * DROGUE_HLS_FILTER_REALS * p;
        for (k = 0; k < 3; k++) {
            get_real(&filter->parameter[p].state[k], words + 2 * k);
            get_real(&filter->parameter[p].variance[k], words + 6 + 2 * k);
            get_real(&filter->parameter[p].slope[k], words + 12 + 2 * k);
        }
        get_real(&filter->parameter[p].rest, words + 18);
    }
}

static inline void store(int32_t memory[DROGUE_HLS_FILTER_WORDS], const drogue_kalman *filter)
{
    int p;
    int k;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        int32_t *words = memory + 2 * DROGUE_HLS_FILTER_REALS * p;
        for (k = 0; k < 3; k++) {
            put_real(words + 2 * k, &filter->parameter[p].state[k]);
            put_real(words + 6 + 2 * k, &filter->parameter[p].variance[k]);
            put_real(words + 12 + 2 * k, &filter->parameter[p].slope[k]);
        }
        put_real(words + 18, &filter->parameter[p].rest);
    }
}

/* Are command and arguments in range? */
static int valid(uint32_t command, uint32_t dt_us, const drogue_q16 std[DROGUE_PARAMETERS],
                 const drogue_q16 noise[4 * DROGUE_PARAMETERS])
{
    int32_t least = 0;
    int32_t least_std = 1;
    int k;
    for (k = 0; k < 4 * DROGUE_PARAMETERS; k++) {
        least = noise[k] < least ? noise[k] : least;
    }
    for (k = 0; k < DROGUE_PARAMETERS; k++) {
        least_std = std[k] < least_std ? std[k] : least_std;
    }
    if (least < 0 || command > DROGUE_HLS_FILTER_COAST) {
        return 0;
    }
    return command <= DROGUE_HLS_FILTER_RESTART ||
           (dt_us >= 1 && dt_us <= INT32_MAX && (command == DROGUE_HLS_FILTER_COAST || least_std > 0));
}

static void start(drogue_kalman *filter, uint32_t which, const drogue_q16 value[DROGUE_PARAMETERS],
                  const drogue_q16 noise[4 * DROGUE_PARAMETERS])
{
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        if ((which >> p & 1u) != 0) {
            drogue_kalman_restart(filter, p, value[p], noise + DROGUE_PARAMETERS + 3 * p);
        }
    }
}

int32_t drogue_hls_filter(uint32_t command, uint32_t which, uint32_t dt_us, const int32_t value[DROGUE_PARAMETERS],
                          const int32_t std[DROGUE_PARAMETERS], const int32_t noise[4 * DROGUE_PARAMETERS],
                          int32_t memory[DROGUE_HLS_FILTER_WORDS], int32_t states[3 * DROGUE_PARAMETERS],
                          int64_t value_std[DROGUE_PARAMETERS])
{
#ifndef __BAMBU__ /* registers; the other arrays are memory ports, which is the default */
#pragma HLS interface mode = s_axilite port = command
#pragma HLS interface mode = s_axilite port = which
#pragma HLS interface mode = s_axilite port = dt_us
#pragma HLS interface mode = s_axilite port = value
#pragma HLS interface mode = s_axilite port = std
#pragma HLS interface mode = s_axilite port = noise
#pragma HLS interface mode = s_axilite port = states
#pragma HLS interface mode = s_axilite port = value_std
#pragma HLS interface mode = s_axilite port = return
#endif
    drogue_kalman filter;
    drogue_q16 v[DROGUE_PARAMETERS];
    drogue_q16 s[DROGUE_PARAMETERS];
    drogue_q16 n[4 * DROGUE_PARAMETERS];
    drogue_q16 state[DROGUE_PARAMETERS];
    int64_t deviation[DROGUE_PARAMETERS];
    int ok;
    int i;
    int k;
    for (k = 0; k < DROGUE_PARAMETERS; k++) {
        v[k] = value[k];
        s[k] = std[k];
    }
    for (k = 0; k < 4 * DROGUE_PARAMETERS; k++) {
        n[k] = noise[k];
    }
    memset(&filter, 0, sizeof filter);
    ok = valid(command, dt_us, s, n);
    if (ok) {
        if (command != DROGUE_HLS_FILTER_START) {
            load(&filter, memory);
        }
        if (command <= DROGUE_HLS_FILTER_RESTART) {
            start(&filter, command == DROGUE_HLS_FILTER_START ? 31u : which, v, n);
        } else {
            drogue_kalman_predict(&filter, dt_us, n);
        }
        if (command == DROGUE_HLS_FILTER_STEP) {
            drogue_kalman_correct(&filter, v, s);
        }
        store(memory, &filter);
    }
    for (i = 0; i < 3; i++) {
        drogue_kalman_state(state, &filter, i);
        for (k = 0; k < DROGUE_PARAMETERS; k++) {
            states[DROGUE_PARAMETERS * i + k] = state[k];
        }
    }
    drogue_kalman_std(deviation, &filter);
    for (k = 0; k < DROGUE_PARAMETERS; k++) {
        value_std[k] = deviation[k];
    }
    return ok ? DROGUE_OK : DROGUE_E_ARGUMENT;
}
