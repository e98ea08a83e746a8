/* SPDX-License-Identifier: Apache-2.0 */
/* Test bench of drogue_hls_filter(): every vector of the stage 'kalman', step by step beside the library's filter; a
 * restart of two parameters and refused commands after each. */
#include "../backend/testbench.h"
#include "filter.h"

static int32_t value[DROGUE_PARAMETERS];
static int32_t std_q16[DROGUE_PARAMETERS];
static int32_t process[4 * DROGUE_PARAMETERS];
static int64_t memory[DROGUE_HLS_FILTER_WORDS];
static int32_t states[3 * DROGUE_PARAMETERS];
static int64_t value_std[DROGUE_PARAMETERS];

static int32_t command(uint32_t what, uint32_t which, uint32_t dt_us)
{
    BENCH_ARRAY(3, value);
    BENCH_ARRAY(4, std_q16);
    BENCH_ARRAY(5, process);
    BENCH_ARRAY(6, memory);
    BENCH_ARRAY(7, states);
    BENCH_ARRAY(8, value_std);
    return drogue_hls_filter(what, which, dt_us, value, std_q16, process, memory, states, value_std);
}

static void compare_wide(bench *b, size_t at, const drogue_wide *expected)
{
    bench_word(b, "mantissa", at, memory[at], expected->mantissa);
    bench_word(b, "exponent", at + 1, memory[at + 1], expected->exponent);
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
        bench_words32(b, "states", states + DROGUE_PARAMETERS * k, expected, DROGUE_PARAMETERS);
    }
    drogue_kalman_std(expected_std, filter);
    bench_words64(b, "value_std", value_std, expected_std, DROGUE_PARAMETERS);
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        for (k = 0; k < 9; k++) {
            compare_wide(b, 2 * (9 * p + k),
                         k < 3 ? &filter->parameter[p].state[k] : &filter->parameter[p].covariance[k - 3]);
        }
    }
}

/* Two parameters anew, then what must be refused. */
static void run_commands(bench *b, drogue_kalman *filter)
{
    int64_t before[DROGUE_HLS_FILTER_WORDS];
    size_t k;
    bench_word(b, "restart", 0, command(DROGUE_HLS_FILTER_RESTART, 24, 0), DROGUE_OK);
    drogue_kalman_restart(filter, DROGUE_PITCH, value[DROGUE_PITCH], process + 5 + 3 * DROGUE_PITCH);
    drogue_kalman_restart(filter, DROGUE_YAW, value[DROGUE_YAW], process + 5 + 3 * DROGUE_YAW);
    compare(b, filter);
    memcpy(before, memory, sizeof before);
    bench_word(b, "unknown command", 0, command(4, 31, 1), DROGUE_E_ARGUMENT);
    bench_word(b, "no time", 0, command(DROGUE_HLS_FILTER_COAST, 0, 0), DROGUE_E_ARGUMENT);
    std_q16[1] = 0;
    bench_word(b, "no std", 0, command(DROGUE_HLS_FILTER_STEP, 0, 1), DROGUE_E_ARGUMENT);
    bench_words64(b, "memory", memory, before, DROGUE_HLS_FILTER_WORDS);
    for (k = 0; k < 3 * DROGUE_PARAMETERS; k++) {
        bench_word(b, "refused states", k, states[k], 0);
    }
}

static void run(bench *b, const conf_case *c)
{
    const conf_array *in = c->inputs;
    const uint32_t dt_us = (uint32_t)conf_word(&in[0], 0);
    const size_t frames = in[1].count / 10;
    const conf_array *expected = &c->exact[0].array;
    drogue_q16 start[DROGUE_PARAMETERS][3];
    drogue_kalman filter;
    size_t i;
    size_t k;
    bench_begin(b, c->id);
    memset(memory, 0x55, sizeof memory);
    for (k = 0; k < 20; k++) {
        process[k] = (int32_t)conf_word(&in[0], 1 + k);
    }
    for (k = 0; k < 15; k++) {
        start[k / 3][k % 3] = process[5 + k];
    }
    for (k = 0; k < DROGUE_PARAMETERS; k++) {
        value[k] = (int32_t)conf_word(&in[0], 21 + k);
        std_q16[k] = 0;
    }
    drogue_kalman_init(&filter, value, (const drogue_q16(*)[3])start);
    bench_word(b, "start", 0, command(DROGUE_HLS_FILTER_START, 0, 0), DROGUE_OK);
    compare(b, &filter);
    bench_word(b, "words", 0, (int64_t)expected->count, (int64_t)(15 * frames));
    for (i = 0; i < frames; i++) {
        for (k = 0; k < DROGUE_PARAMETERS; k++) {
            value[k] = (int32_t)conf_word(&in[1], 10 * i + k);
            std_q16[k] = (int32_t)conf_word(&in[1], 10 * i + 5 + k);
        }
        bench_word(b, "step", i, command(std_q16[0] > 0 ? DROGUE_HLS_FILTER_STEP : DROGUE_HLS_FILTER_COAST, 0, dt_us),
                   DROGUE_OK);
        drogue_kalman_predict(&filter, dt_us, process);
        if (std_q16[0] > 0) {
            drogue_kalman_correct(&filter, value, std_q16);
        }
        compare(b, &filter);
        for (k = 0; k < 15; k++) {
            bench_word(b, "vector", 15 * i + k, states[k], conf_word(expected, 15 * i + k));
        }
    }
    run_commands(b, &filter);
    bench_end(b, "");
}

int main(void)
{
    bench b = {"filter", "", 0, 0, 0, 0};
    size_t l;
    size_t i;
    for (l = 0; l < conf_case_list_count; l++) {
        for (i = 0; i < conf_case_lists[l].count; i++) {
            if (bench_wants(&conf_case_lists[l].cases[i], "kalman")) {
                run(&b, &conf_case_lists[l].cases[i]);
            }
        }
    }
    return bench_report(&b);
}
