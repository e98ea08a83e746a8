/* SPDX-License-Identifier: Apache-2.0 */
/* Models side by side: which is chosen in calm flight and in gusts, and what they are mixed to. */
#include "suite.h"

#include "drogue/bank.h"
#include "geometry.h"

enum { DT_US = 20000 };

static const drogue_q16 process[DROGUE_PARAMETERS] = {13107, 13107, 1311, 9830, 9830};
static const drogue_q16 noise[DROGUE_PARAMETERS] = {66, 66, 66, 66, 66}; /* 1 mm */

static drogue_bank new_bank(const drogue_q16 value[DROGUE_PARAMETERS])
{
    drogue_q16 std[DROGUE_PARAMETERS][3];
    drogue_kalman filter;
    drogue_bank bank;
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        std[p][0] = 66;
        std[p][1] = std[p][2] = 2 * DROGUE_Q16_ONE;
    }
    drogue_kalman_init(&filter, value, (const drogue_q16(*)[3])std);
    drogue_bank_start(&bank, &filter);
    return bank;
}

static void step(drogue_bank *bank, const drogue_q16 value[DROGUE_PARAMETERS])
{
    int m;
    drogue_bank_predict(bank, DT_US, process, 6 * DROGUE_Q16_ONE);
    drogue_bank_weigh(bank, value);
    for (m = 0; m < DROGUE_BANK_MODELS; m++) {
        drogue_kalman_correct(&bank->model[m], value, noise);
    }
}

START_TEST(starts_agile)
{
    const drogue_q16 value[DROGUE_PARAMETERS] = {1, 2, 3, 4, 5};
    const drogue_bank bank = new_bank(value);
    drogue_kalman mixed;
    drogue_q16 out[DROGUE_PARAMETERS];
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        ck_assert_int_eq(bank.chosen[p], DROGUE_BANK_MODELS - 1);
    }
    drogue_bank_mix(&mixed, &bank, 1);
    drogue_kalman_state(out, &mixed, 0);
    ck_assert_mem_eq(out, value, sizeof out);
}
END_TEST

/* x shakes, y rests: each has its own model. */
START_TEST(each_parameter_has_the_model_that_predicts_it)
{
    drogue_q16 value[DROGUE_PARAMETERS] = {0, 0, 8 * DROGUE_Q16_ONE, 0, 0};
    drogue_bank bank = new_bank(value);
    uint64_t rng = 3;
    int k;
    for (k = 0; k < 200; k++) {
        value[DROGUE_X] = q16_of(0.5 * sin(2 * TEST_PI * 1.5 * k * 0.02) + 0.001 * rng_normal(&rng));
        value[DROGUE_Y] = q16_of(0.001 * rng_normal(&rng));
        step(&bank, value);
    }
    ck_assert_int_eq(bank.chosen[DROGUE_X], 2);
    ck_assert_int_eq(bank.chosen[DROGUE_Y], 0);
}
END_TEST

START_TEST(mix_takes_the_chosen_and_wider_ones)
{
    const drogue_q16 value[DROGUE_PARAMETERS] = {0};
    drogue_bank bank = new_bank(value);
    int wider, p;
    step(&bank, value);
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        bank.chosen[p] = p % DROGUE_BANK_MODELS;
    }
    for (wider = 0; wider <= 2; wider++) {
        drogue_kalman mixed;
        drogue_bank_mix(&mixed, &bank, wider);
        for (p = 0; p < DROGUE_PARAMETERS; p++) {
            const int m = p % DROGUE_BANK_MODELS + wider < 2 ? p % DROGUE_BANK_MODELS + wider : 2;
            ck_assert_mem_eq(&mixed.parameter[p], &bank.model[m].parameter[p], sizeof mixed.parameter[p]);
        }
    }
}
END_TEST

/* Less by an eighth, or the choice stays. */
START_TEST(choice_does_not_flicker)
{
    const drogue_q16 value[DROGUE_PARAMETERS] = {0};
    int least;
    for (least = 0; least <= 1; least++) {
        drogue_bank bank = new_bank(value);
        bank.weighed = 16;
        drogue_real_set(&bank.error2[0][0], least ? 139 : 141, 0); /* against 7/8 of 160 */
        drogue_real_set(&bank.error2[1][0], 200, 0);
        drogue_real_set(&bank.error2[2][0], 160, 0);
        drogue_bank_weigh(&bank, value);
        ck_assert_int_eq(bank.chosen[0], least ? 0 : 2);
    }
}
END_TEST

/* The first prediction, which knows no rate, does not count; the next ones count alike, later ones fade over 16. */
START_TEST(errors_are_a_mean_that_fades)
{
    const double off[4] = {0.5, 0.25, 0.75, 0.125};
    drogue_q16 value[DROGUE_PARAMETERS] = {0};
    drogue_bank bank = new_bank(value);
    double mean = 0;
    int k;
    for (k = 0; k < 40; k++) { /* the models stay where they began */
        const double e = off[k % 4], n = k < 15 ? k + 1 : 16;
        const double factor = (n + 2) / n; /* more while it is of few */
        drogue_real error2, thrice;
        drogue_real_set(&error2, 0, 0);
        drogue_real_set(&thrice, 0, 0);
        value[DROGUE_Y] = q16_of(e);
        drogue_bank_weigh(&bank, value);
        mean += k == 0 ? 0 : (e * e - mean) / (k < 16 ? k : 16);
        drogue_bank_allow(&error2, &bank, DROGUE_Y, 1);
        ck_assert_double_eq_tol((double)drogue_real_to_s64(error2, 32) / 4294967296.0, mean * factor, 1e-8);
        drogue_bank_allow(&thrice, &bank, DROGUE_Y, 3);
        ck_assert_double_eq_tol((double)drogue_real_to_s64(thrice, 32) / 4294967296.0, 9 * mean * factor, 1e-7);
    }
}
END_TEST

SUITE_MAIN("bank", starts_agile, each_parameter_has_the_model_that_predicts_it, mix_takes_the_chosen_and_wider_ones,
           choice_does_not_flicker, errors_are_a_mean_that_fades)
