/* SPDX-License-Identifier: Apache-2.0 */
/* Kalman filters side by side that differ in their process noise, and for each parameter the one that predicts it best:
 * calm flight is smoothed, gusts are followed. */
#ifndef DROGUE_BANK_H
#define DROGUE_BANK_H

#include "drogue/kalman.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_BANK_MODELS 3 /* from the calmest to the most agile */

/* All parameters' filters, the same from model to model but for their process noise. */
typedef struct drogue_bank {
    drogue_kalman model[DROGUE_BANK_MODELS]; /* from calm to agile */
    /* mean squared error of prediction, over all measurements believed, then fading over 16 */
    drogue_real error2[DROGUE_BANK_MODELS][DROGUE_PARAMETERS];
    int32_t weighed;                   /* measurements believed, at most 16; the first one's prediction knew no rate */
    int32_t chosen[DROGUE_PARAMETERS]; /* model of each parameter */
} drogue_bank;

/* Start all models from one filter; the most agile one is chosen until their predictions tell them apart. */
void drogue_bank_start(drogue_bank *bank, const drogue_kalman *filter);

/* Predict all models, each with 'step' times the standard deviation of the one before, as drogue_kalman_predict().
 *
 *  std   of the calmest, Q16, >= 0; products saturate
 *  step  Q16, >= 1
 */
void drogue_bank_predict(drogue_bank *bank, uint32_t dt_us, const drogue_q16 std_q16[DROGUE_PARAMETERS],
                         drogue_q16 step_q16);

/* Compare the predictions with a measurement that is believed, before the models are corrected with it, and choose for
 * each parameter the model of least mean squared error; another one than before only when its error is less by an
 * eighth.
 *
 *  value  m and rad, Q16; angles are compared modulo 2 pi
 */
void drogue_bank_weigh(drogue_bank *bank, const drogue_q16 value_q16[DROGUE_PARAMETERS]);

/* Raise a variance, m^2 or rad^2, to the squared error to be expected of a parameter's prediction 'frames' ahead: the
 * chosen model's mean over one frame, more while it is of few measurements, times the square of the frames, since what
 * is unknown is mostly a rate. It allows for what no model has: a camera that shakes.
 *
 *  p  parameter, [0, DROGUE_PARAMETERS)
 */
void drogue_bank_allow(drogue_real *variance, const drogue_bank *bank, int p, uint32_t frames);

/* Each parameter from its chosen model, or from one 'wider' by so many steps, at most the most agile one. */
void drogue_bank_mix(drogue_kalman *out, const drogue_bank *bank, int32_t wider);

#ifdef __cplusplus
}
#endif
#endif
