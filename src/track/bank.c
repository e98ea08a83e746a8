/* SPDX-License-Identifier: Apache-2.0 */
/* Models side by side. */
#include "drogue/bank.h"

#include <string.h>

#define MOST_WEIGHED 16 /* a prediction counts 1/16 and more */

void drogue_bank_start(drogue_bank *bank, const drogue_kalman *filter)
{
    int m;
    int p;
    memset(bank, 0, sizeof *bank);
    for (m = 0; m < DROGUE_BANK_MODELS; m++) {
        bank->model[m] = *filter;
    }
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        bank->chosen[p] = DROGUE_BANK_MODELS - 1;
    }
}

void drogue_bank_predict(drogue_bank *bank, uint32_t dt_us, const drogue_q16 std_q16[DROGUE_PARAMETERS],
                         drogue_q16 step_q16)
{
    drogue_q16 std[DROGUE_PARAMETERS];
    int m;
    int p;
    memcpy(std, std_q16, sizeof std);
    for (m = 0; m < DROGUE_BANK_MODELS; m++) {
        drogue_kalman_predict(&bank->model[m], dt_us, std);
        for (p = 0; p < DROGUE_PARAMETERS; p++) {
            std[p] = drogue_q16_mul(std[p], step_q16);
        }
    }
}

/* The model of least error, if it is less than that of the one chosen by an eighth. */
static int32_t choose(const drogue_bank *bank, int p)
{
    int32_t best = bank->chosen[p];
    drogue_real limit = bank->error2[best][p];
    drogue_real eighth = limit;
    int32_t m;
    drogue_real_shift(&eighth, -3);
    drogue_real_difference(&limit, &limit, &eighth);
    for (m = 0; m < DROGUE_BANK_MODELS; m++) {
        if (m != bank->chosen[p] && drogue_real_order(&bank->error2[m][p], &limit) < 0) {
            limit = bank->error2[m][p];
            best = m;
        }
    }
    return best;
}

void drogue_bank_weigh(drogue_bank *bank, const drogue_q16 value_q16[DROGUE_PARAMETERS])
{
    const int32_t before = bank->weighed;
    drogue_real share;
    int m;
    int p;
    bank->weighed = before < MOST_WEIGHED ? before + 1 : before;
    drogue_real_ratio(&share, 1, before); /* 0 of the first: its prediction knew no rate */
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        for (m = 0; m < DROGUE_BANK_MODELS; m++) {
            drogue_real *mean = &bank->error2[m][p];
            drogue_real error;
            drogue_kalman_innovation(&error, &bank->model[m], p, value_q16[p]);
            drogue_real_product(&error, &error, &error);
            drogue_real_difference(&error, &error, mean);
            drogue_real_product(&error, &error, &share);
            drogue_real_sum(mean, mean, &error);
        }
        bank->chosen[p] = choose(bank, p);
    }
}

void drogue_bank_allow(drogue_real *variance, const drogue_bank *bank, int p, uint32_t frames)
{
    drogue_real error2;
    drogue_real factor;
    drogue_real_set(&factor, frames, 0);
    drogue_real_product(&error2, &bank->error2[bank->chosen[p]][p], &factor);
    drogue_real_product(&error2, &error2, &factor);
    drogue_real_ratio(&factor, bank->weighed + 2, bank->weighed);
    drogue_real_product(&error2, &error2, &factor);
    if (drogue_real_order(variance, &error2) < 0) {
        *variance = error2;
    }
}

void drogue_bank_mix(drogue_kalman *out, const drogue_bank *bank, int32_t wider)
{
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        const int32_t m = bank->chosen[p] + wider;
        out->parameter[p] = bank->model[m < DROGUE_BANK_MODELS ? m : DROGUE_BANK_MODELS - 1].parameter[p];
    }
}
