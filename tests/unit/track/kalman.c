/* SPDX-License-Identifier: Apache-2.0 */
/* The five small filters against one filter of 15 states in double precision. */
#include "suite.h"

#include "drogue/kalman.h"

enum { STATES = 15, PARAMETERS = DROGUE_PARAMETERS };

/* State: values, rates, accelerations, five each. */
typedef struct model {
    double x[STATES], p[STATES][STATES];
} model;

static void model_init(model *m, const drogue_q16 value[PARAMETERS], const drogue_q16 std[PARAMETERS][3])
{
    int i, k;
    memset(m, 0, sizeof *m);
    for (i = 0; i < PARAMETERS; i++) {
        m->x[i] = real_of_q16(value[i]);
        for (k = 0; k < 3; k++) {
            m->p[5 * k + i][5 * k + i] = real_of_q16(std[i][k]) * real_of_q16(std[i][k]);
        }
    }
}

static void model_predict(model *m, double dt, const drogue_q16 std[PARAMETERS])
{
    double f[STATES][STATES], fp[STATES][STATES], x[STATES], g[3];
    int i, j, k;
    memset(f, 0, sizeof f);
    for (i = 0; i < STATES; i++) {
        f[i][i] = 1;
        if (i < 10) {
            f[i][i + 5] = dt;
        }
        if (i < 5) {
            f[i][i + 10] = dt * dt / 2;
        }
    }
    for (i = 0; i < STATES; i++) {
        x[i] = 0;
        for (j = 0; j < STATES; j++) {
            x[i] += f[i][j] * m->x[j];
            fp[i][j] = 0;
            for (k = 0; k < STATES; k++) {
                fp[i][j] += f[i][k] * m->p[k][j];
            }
        }
    }
    memcpy(m->x, x, sizeof x);
    for (i = 0; i < STATES; i++) {
        for (j = 0; j < STATES; j++) {
            m->p[i][j] = 0;
            for (k = 0; k < STATES; k++) {
                m->p[i][j] += fp[i][k] * f[j][k];
            }
        }
    }
    g[0] = dt * dt / 2;
    g[1] = dt;
    g[2] = 1;
    for (i = 0; i < STATES; i++) {
        for (j = 0; j < STATES; j++) {
            if (i % 5 == j % 5) {
                m->p[i][j] += g[i / 5] * g[j / 5] * real_of_q16(std[i % 5]) * real_of_q16(std[i % 5]);
            }
        }
    }
}

/* One measured value after the other: with a diagonal measurement noise the same as all at once. */
static void model_correct(model *m, const drogue_q16 value[PARAMETERS], const drogue_q16 std[PARAMETERS])
{
    int i, j, k;
    for (k = 0; k < PARAMETERS; k++) {
        double variance = m->p[k][k] + real_of_q16(std[k]) * real_of_q16(std[k]);
        double innovation = real_of_q16(value[k]) - m->x[k], gain[STATES], row[STATES];
        if (k == DROGUE_PITCH || k == DROGUE_YAW) {
            innovation -= 2 * TEST_PI * round(innovation / (2 * TEST_PI));
        }
        for (i = 0; i < STATES; i++) {
            gain[i] = m->p[i][k] / variance;
            row[i] = m->p[k][i];
        }
        for (i = 0; i < STATES; i++) {
            m->x[i] += gain[i] * innovation;
            for (j = 0; j < STATES; j++) {
                m->p[i][j] -= gain[i] * row[j];
            }
        }
    }
}

static double worst_state(const model *m, const drogue_kalman *filter)
{
    double worst = 0;
    drogue_q16 state[PARAMETERS];
    int i, k;
    for (k = 0; k < 3; k++) {
        drogue_kalman_state(state, filter, k);
        for (i = 0; i < PARAMETERS; i++) {
            worst = fmax(worst, fabs(state[i] - 65536 * m->x[5 * k + i]));
        }
    }
    return worst;
}

static double real_of(drogue_real v) { return ldexp((double)v.mantissa, v.exponent); }

/* Covariance of one parameter from its factors, p00 p01 p02 p11 p12 p22. */
static void covariance_of(double p[6], const drogue_kalman3 *f)
{
    const double d0 = real_of(f->variance[0]), d1 = real_of(f->variance[1]), d2 = real_of(f->variance[2]);
    const double a = real_of(f->slope[0]), b = real_of(f->slope[1]), c = real_of(f->slope[2]);
    p[0] = d0;
    p[1] = a * d0;
    p[2] = b * d0;
    p[3] = a * a * d0 + d1;
    p[4] = a * b * d0 + c * d1;
    p[5] = b * b * d0 + c * c * d1 + d2;
}

static void must_be_positive(const drogue_kalman *filter)
{
    int i, k;
    for (i = 0; i < PARAMETERS; i++) {
        for (k = 0; k < 3; k++) {
            MUST(filter->parameter[i].variance[k].mantissa >= 0, "variance %d of parameter %d", k, i);
        }
    }
}

/* Largest difference of a covariance from the model's, over the standard deviations of both states. */
static double worst_covariance(const model *m, const drogue_kalman *filter)
{
    static const int row[6] = {0, 0, 0, 1, 1, 2}, column[6] = {0, 1, 2, 1, 2, 2};
    double worst = 0;
    int i, k;
    for (i = 0; i < PARAMETERS; i++) {
        double p[6];
        covariance_of(p, &filter->parameter[i]);
        for (k = 0; k < 6; k++) {
            const int r = 5 * row[k] + i, c = 5 * column[k] + i;
            worst = fmax(worst, fabs(p[k] - m->p[r][c]) / sqrt(m->p[r][r] * m->p[c][c]));
        }
    }
    return worst;
}

static const drogue_q16 start_std[PARAMETERS][3] = {
    {655, 131072, 131072}, {655, 131072, 131072}, {1311, 131072, 131072}, {1311, 65536, 65536}, {1311, 65536, 65536}};

/* A drogue that sways, measured with noise; time steps vary, frames are missed. */
START_TEST(same_states_as_fifteen_in_one)
{
    uint64_t rng = 1;
    int run, frame, i;
    for (run = 0; run < 10; run++) {
        drogue_kalman filter;
        model m;
        double t = 0, worst = 0, apart = 0;
        drogue_q16 value[PARAMETERS], std[PARAMETERS], process[PARAMETERS];
        for (i = 0; i < PARAMETERS; i++) {
            process[i] = rng_range(&rng, 0, 65536);
            std[i] = rng_range(&rng, 20, 3000);
            value[i] = rng_range(&rng, -65536, 65536);
        }
        drogue_kalman_init(&filter, value, start_std);
        model_init(&m, value, start_std);
        ck_assert(worst_state(&m, &filter) <= 1);
        for (frame = 0; frame < 1000; frame++) {
            uint32_t dt_us = (uint32_t)rng_range(&rng, 5000, 50000);
            t += dt_us * 1e-6;
            drogue_kalman_predict(&filter, dt_us, process);
            model_predict(&m, dt_us * 1e-6, process);
            if (rng_range(&rng, 0, 9) > 0) {
                for (i = 0; i < PARAMETERS; i++) {
                    value[i] = q16_of((i == 2 ? 10 - 0.1 * t : 0) + 0.3 * sin(t * (1 + 0.3 * i)) +
                                      real_of_q16(std[i]) * rng_normal(&rng));
                }
                drogue_kalman_correct(&filter, value, std);
                model_correct(&m, value, std);
            }
            worst = fmax(worst, worst_state(&m, &filter));
            apart = fmax(apart, worst_covariance(&m, &filter));
            must_be_positive(&filter);
        }
        MUST(worst <= 1.0, "run %d: off by %.3f LSB", run, worst);
        MUST(apart <= 1e-6, "run %d: covariance off by %.3g", run, apart);
    }
}
END_TEST

START_TEST(angles_pass_half_a_turn)
{
    drogue_kalman filter;
    drogue_q16 value[PARAMETERS] = {0, 0, 65536, 0, 0}, state[PARAMETERS], process[PARAMETERS] = {0, 0, 0, 655, 655};
    const drogue_q16 std[PARAMETERS] = {655, 655, 655, 655, 655};
    double angle = 3.0;
    int frame, k;
    value[DROGUE_YAW] = q16_of(angle);
    value[DROGUE_PITCH] = q16_of(-angle);
    drogue_kalman_init(&filter, value, start_std);
    for (frame = 0; frame < 200; frame++) { /* 0.01 rad a frame, across pi and -pi */
        angle += 0.01;
        value[DROGUE_YAW] = q16_of(angle_difference(angle, 0, 2 * TEST_PI));
        value[DROGUE_PITCH] = q16_of(angle_difference(-angle, 0, 2 * TEST_PI));
        drogue_kalman_predict(&filter, 10000, process);
        drogue_kalman_correct(&filter, value, std);
        drogue_kalman_state(state, &filter, 0);
        for (k = DROGUE_PITCH; k <= DROGUE_YAW; k++) {
            double off = angle_difference(real_of_q16(state[k]), k == DROGUE_YAW ? angle : -angle, 2 * TEST_PI);
            MUST(fabs(off) < 0.02, "frame %d: parameter %d off by %g rad", frame, k, off);
        }
    }
    drogue_kalman_state(state, &filter, 1);
    ck_assert_int_lt(abs(state[DROGUE_YAW] - 65536), 3000); /* 1 rad/s */
    ck_assert_int_lt(abs(state[DROGUE_PITCH] + 65536), 3000);
}
END_TEST

START_TEST(ends_of_the_ranges)
{
    drogue_kalman filter;
    drogue_q16 value[PARAMETERS], std[PARAMETERS], process[PARAMETERS] = {0, 0, 0, 0, 0}, state[PARAMETERS];
    drogue_q16 wide_std[PARAMETERS][3];
    int i, k, round;
    for (round = 0; round < 2; round++) {
        for (i = 0; i < PARAMETERS; i++) {
            value[i] = round ? INT32_MAX : INT32_MIN;
            std[i] = round ? 1 : INT32_MAX;
            process[i] = round ? INT32_MAX : 0;
            for (k = 0; k < 3; k++) {
                wide_std[i][k] = round ? INT32_MAX : 0;
            }
        }
        drogue_kalman_init(&filter, value, (const drogue_q16(*)[3])wide_std);
        drogue_kalman_state(state, &filter, 0);
        ck_assert_int_eq(memcmp(state, value, sizeof state), 0);
        for (k = 0; k < 50; k++) {
            drogue_kalman_predict(&filter, k & 1 ? INT32_MAX : 1, process);
            drogue_kalman_correct(&filter, value, std);
            must_be_positive(&filter);
        }
        drogue_kalman_state(state, &filter, 0);
        for (i = 0; i < 3; i++) {
            MUST(abs(state[i] / 2 - value[i] / 2) <= 1, "round %d: parameter %d is %d", round, i, (int)state[i]);
        }
    }
}
END_TEST

/* A start and a step so far apart that a covariance corrected in Joseph's form, with mantissas of 62 bits, had a rate of
 * variance -3e-5. */
START_TEST(no_negative_variance)
{
    const drogue_q16 value[PARAMETERS] = {0, 0, 0, 0, 0}, std[PARAMETERS] = {12, 12, 12, 12, 12};
    drogue_q16 far_std[PARAMETERS][3];
    drogue_kalman filter;
    double p[6];
    int i, k;
    for (i = 0; i < PARAMETERS; i++) {
        far_std[i][0] = 14;
        far_std[i][1] = 5;
        far_std[i][2] = 931817865;
    }
    drogue_kalman_init(&filter, value, (const drogue_q16(*)[3])far_std);
    drogue_kalman_predict(&filter, 674651533, std);
    drogue_kalman_correct(&filter, value, std);
    must_be_positive(&filter);
    covariance_of(p, &filter.parameter[0]);
    { /* rate - 2 / dt value does not depend on the acceleration: 7.6e-5; before the correction it was 9.6e6, and to that
           mantissas of 31 bits are true */
        const double dt = 674.651533, before = 931817865.0 / 65536 * dt, rate = 5.0 / 65536;
        MUST(p[3] > 0 && fabs(sqrt(p[3]) - rate) < ldexp(before, -31), "standard deviation of the rate %g", sqrt(p[3]));
        MUST(p[5] > 0, "variance of the acceleration %g", p[5]);
    }
    for (k = 0; k < 1000; k++) {
        drogue_kalman_predict(&filter, 674651533, std);
        drogue_kalman_correct(&filter, value, std);
        must_be_positive(&filter);
    }
}
END_TEST

/* Any number that a header's range holds, the ends and powers of two as often as those between. */
static int32_t any_of(uint64_t *rng, int32_t least)
{
    switch (rng_range(rng, 0, 3)) {
    case 0: return rng_range(rng, 0, 1) ? INT32_MAX : least;
    case 1: return least + (1 << rng_range(rng, 0, 30)) - 1;
    default: return rng_range(rng, least, INT32_MAX);
    }
}

/* From any start that the header calls valid, over any steps and measurements that it does: no variance below 0, in no
 * factor; and nothing that a checked build stops at. */
START_TEST(any_valid_start)
{
    uint64_t rng = 9;
    int run, step, i, k;
    for (run = 0; run < 3000; run++) {
        drogue_kalman filter;
        drogue_q16 value[PARAMETERS], start[PARAMETERS][3], process[PARAMETERS], std[PARAMETERS], state[PARAMETERS];
        int64_t std_q32[PARAMETERS];
        for (i = 0; i < PARAMETERS; i++) {
            value[i] = (int32_t)(uint32_t)rng_u64(&rng);
            for (k = 0; k < 3; k++) {
                start[i][k] = any_of(&rng, 0);
            }
        }
        drogue_kalman_init(&filter, value, (const drogue_q16(*)[3])start);
        for (step = 0; step < 20; step++) {
            for (i = 0; i < PARAMETERS; i++) {
                value[i] = (int32_t)(uint32_t)rng_u64(&rng);
                process[i] = any_of(&rng, 0);
                std[i] = any_of(&rng, 1);
            }
            drogue_kalman_predict(&filter, (uint32_t)any_of(&rng, 1), process);
            must_be_positive(&filter);
            if (rng_range(&rng, 0, 3) != 0) {
                drogue_kalman_correct(&filter, value, std);
                must_be_positive(&filter);
            } else if (rng_range(&rng, 0, 3) == 0) {
                drogue_kalman_restart(&filter, rng_range(&rng, 0, PARAMETERS - 1), value[0], start[0]);
            }
            drogue_kalman_std(std_q32, &filter);
            for (k = 0; k < 3; k++) {
                drogue_kalman_state(state, &filter, k);
            }
            for (i = 0; i < PARAMETERS; i++) {
                MUST(std_q32[i] >= 0, "run %d, step %d: standard deviation %d", run, step, i);
            }
        }
    }
}
END_TEST

START_TEST(states_saturate)
{
    drogue_kalman filter;
    const drogue_q16 value[PARAMETERS] = {65536, -65536, 0, 0, 0}, process[PARAMETERS] = {0, 0, 0, 0, 0};
    const drogue_q16 std[PARAMETERS] = {655, 655, 655, 655, 655};
    drogue_q16 moved[PARAMETERS], state[PARAMETERS];
    int k;
    drogue_kalman_init(&filter, value, start_std);
    memcpy(moved, value, sizeof moved);
    for (k = 1; k <= 20; k++) { /* 10 m/s to either side */
        moved[0] += 6554;
        moved[1] -= 6554;
        drogue_kalman_predict(&filter, 10000, process);
        drogue_kalman_correct(&filter, moved, std);
    }
    drogue_kalman_predict(&filter, INT32_MAX, process);
    drogue_kalman_predict(&filter, INT32_MAX, process);
    drogue_kalman_state(state, &filter, 0);
    ck_assert(state[0] == INT32_MAX || state[0] == INT32_MIN);
    ck_assert(state[1] == INT32_MAX || state[1] == INT32_MIN);
    ck_assert_int_eq(state[0] == INT32_MAX, state[1] == INT32_MIN);
}
END_TEST

START_TEST(standard_deviations_in_q32)
{
    const drogue_q16 value[PARAMETERS] = {0, 0, 0, 0, 0};
    drogue_q16 std[PARAMETERS][3];
    drogue_kalman filter;
    int64_t out_q32[PARAMETERS];
    int i;
    for (i = 0; i < PARAMETERS; i++) {
        std[i][0] = 655 << i;
        std[i][1] = std[i][2] = 65536;
    }
    drogue_kalman_init(&filter, value, (const drogue_q16(*)[3])std);
    drogue_kalman_std(out_q32, &filter);
    for (i = 0; i < PARAMETERS; i++) {
        MUST(llabs(out_q32[i] - ((int64_t)std[i][0] << 16)) <= 1, "parameter %d: %lld", i, (long long)out_q32[i]);
    }
}
END_TEST

/* Where the covariance is none, as rounding or a caller may make it, the diagonal alone counts. */
START_TEST(distance_by_a_false_covariance)
{
    const drogue_q16 value[PARAMETERS] = {0, 0, 0, 0, 0}, at[PARAMETERS] = {131072, 65536, 0, 0, 0};
    drogue_q16 std[PARAMETERS][3];
    drogue_real noise[DROGUE_PACKED_MAX], d;
    drogue_kalman filter;
    int i;
    for (i = 0; i < PARAMETERS; i++) {
        std[i][0] = std[i][1] = std[i][2] = 65536;
    }
    drogue_kalman_init(&filter, value, (const drogue_q16(*)[3])std);
    for (i = 0; i < DROGUE_PACKED_MAX; i++) {
        drogue_real_set(&noise[i], 0, 0);
    }
    for (i = 0; i < PARAMETERS; i++) {
        drogue_real_set(&noise[DROGUE_PACKED(i, i)], 1, 0);
    }
    drogue_real_set(&noise[DROGUE_PACKED(1, 0)], 1, 0); /* of 2: 0.5 */
    drogue_kalman_distance2(&d, &filter, at, noise, PARAMETERS);
    MUST(fabs(ldexp(d.mantissa, d.exponent) - 2) < 1e-6, "%g",
         ldexp(d.mantissa, d.exponent));                /* (2 4 - 2 2 + 2 1) / 3 */
    drogue_real_set(&noise[DROGUE_PACKED(1, 0)], 3, 0); /* of 2: none */
    drogue_kalman_distance2(&d, &filter, at, noise, PARAMETERS);
    MUST(fabs(ldexp(d.mantissa, d.exponent) - 2.5) < 1e-6, "%g", ldexp(d.mantissa, d.exponent)); /* 4 / 2 + 1 / 2 */
}
END_TEST

SUITE_MAIN("kalman", same_states_as_fifteen_in_one, angles_pass_half_a_turn, ends_of_the_ranges, no_negative_variance,
           any_valid_start, states_saturate, standard_deviations_in_q32, distance_by_a_false_covariance)
