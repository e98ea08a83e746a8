/* SPDX-License-Identifier: Apache-2.0 */
/* Test bench of drogue_hls_filter(): every vector of the stage 'kalman', step by step beside the library's filter; a
 * restart of two parameters and refused commands after each. */
#include <string.h>

#include "../bench/bench.h"
#include "filter.h"
#include "sim.h"

static int32_t value[DROGUE_PARAMETERS];
static int32_t std_q16[DROGUE_PARAMETERS];
static int32_t noise[4 * DROGUE_PARAMETERS];
static int32_t memory[DROGUE_HLS_FILTER_WORDS];
static int32_t states[3 * DROGUE_PARAMETERS];
static int64_t value_std[DROGUE_PARAMETERS];

static int32_t command(uint32_t what, uint32_t which, uint32_t dt_us)
{
    SIM_ARRAY(3, value);
    SIM_ARRAY(4, std_q16);
    SIM_ARRAY(5, noise);
    SIM_ARRAY(6, memory);
    SIM_ARRAY(7, states);
    SIM_ARRAY(8, value_std);
    return drogue_hls_filter(what, which, dt_us, value, std_q16, noise, memory, states, value_std);
}

static void compare_real(bench *b, size_t at, const drogue_real *expected)
{
    (void)bench_word(b, "mantissa", memory[at], expected->mantissa);
    (void)bench_word(b, "exponent", memory[at + 1], expected->exponent);
}

/* All that the block gives, against the library's filter. */
static void compare(bench *b, const drogue_kalman *filter)
{
    int32_t expected[DROGUE_PARAMETERS];
    int64_t expected_std[DROGUE_PARAMETERS];
    size_t p;
    size_t k;
    for (k = 0; k < 3; k++) {
        drogue_kalman_state(expected, filter, (int)k);
        for (p = 0; p < DROGUE_PARAMETERS; p++) {
            (void)bench_word(b, "state", states[DROGUE_PARAMETERS * k + p], expected[p]);
        }
    }
    drogue_kalman_std(expected_std, filter);
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        (void)bench_word(b, "std of a value", value_std[p], expected_std[p]);
    }
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        const drogue_kalman3 *f = &filter->parameter[p];
        compare_real(b, 2 * (10 * p + 9), &f->rest);
        for (k = 0; k < 9; k++) {
            compare_real(b, 2 * (10 * p + k), k < 3 ? &f->state[k] : k < 6 ? &f->variance[k - 3] : &f->slope[k - 6]);
        }
    }
}

/* Two parameters anew, then what must be refused. */
static void run_commands(bench *b, drogue_kalman *filter)
{
    int32_t before[DROGUE_HLS_FILTER_WORDS];
    size_t k;
    (void)bench_word(b, "restart", command(DROGUE_HLS_FILTER_RESTART, 24, 0), DROGUE_OK);
    drogue_kalman_restart(filter, DROGUE_PITCH, value[DROGUE_PITCH], noise + 5 + 3 * DROGUE_PITCH);
    drogue_kalman_restart(filter, DROGUE_YAW, value[DROGUE_YAW], noise + 5 + 3 * DROGUE_YAW);
    compare(b, filter);
    memcpy(before, memory, sizeof before);
    (void)bench_word(b, "unknown command", command(4, 31, 1), DROGUE_E_ARGUMENT);
    (void)bench_word(b, "no time", command(DROGUE_HLS_FILTER_COAST, 0, 0), DROGUE_E_ARGUMENT);
    std_q16[1] = 0;
    (void)bench_word(b, "no std", command(DROGUE_HLS_FILTER_STEP, 0, 1), DROGUE_E_ARGUMENT);
    (void)bench_check(b, "memory is left alone", memcmp(memory, before, sizeof before) == 0);
    for (k = 0; k < 3 * DROGUE_PARAMETERS; k++) {
        (void)bench_word(b, "state of a refused command", states[k], 0);
    }
}

static void run(bench *b, const conf_case *c)
{
    const conf_array *in = bench_input(c, "params");
    const conf_array *measured = bench_input(c, "frames");
    const conf_array *expected = bench_expected(c, "states");
    const uint32_t dt_us = (uint32_t)conf_word(in, 0);
    const size_t frames = measured->count / 10;
    drogue_q16 start[DROGUE_PARAMETERS][3];
    drogue_kalman filter;
    size_t i;
    size_t k;
    memset(memory, 0x55, sizeof memory);
    for (k = 0; k < 20; k++) {
        noise[k] = (int32_t)conf_word(in, 1 + k);
    }
    for (k = 0; k < 15; k++) {
        start[k / 3][k % 3] = noise[5 + k];
    }
    for (k = 0; k < DROGUE_PARAMETERS; k++) {
        value[k] = (int32_t)conf_word(in, 21 + k);
        std_q16[k] = 0;
    }
    drogue_kalman_init(&filter, value, (const drogue_q16(*)[3])start);
    (void)bench_word(b, "start", command(DROGUE_HLS_FILTER_START, 0, 0), DROGUE_OK);
    compare(b, &filter);
    (void)bench_word(b, "words", (int64_t)expected->count, (int64_t)(15 * frames));
    for (i = 0; i < frames; i++) {
        for (k = 0; k < DROGUE_PARAMETERS; k++) {
            value[k] = (int32_t)conf_word(measured, 10 * i + k);
            std_q16[k] = (int32_t)conf_word(measured, 10 * i + 5 + k);
        }
        (void)bench_word(
            b, "step", command(std_q16[0] > 0 ? DROGUE_HLS_FILTER_STEP : DROGUE_HLS_FILTER_COAST, 0, dt_us), DROGUE_OK);
        drogue_kalman_predict(&filter, dt_us, noise);
        if (std_q16[0] > 0) {
            drogue_kalman_correct(&filter, value, std_q16);
        }
        compare(b, &filter);
        for (k = 0; k < 15; k++) {
            (void)bench_word(b, "vector's state", states[k], conf_word(expected, 15 * i + k));
        }
    }
    run_commands(b, &filter);
}

int main(void)
{
    const conf_case *c;
    bench b;
    bench_begin(&b, "filter");
    while ((c = bench_next(&b, "kalman")) != NULL) {
        run(&b, c);
    }
    return bench_end(&b);
}
