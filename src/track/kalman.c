/* SPDX-License-Identifier: Apache-2.0 */
/* Five Kalman filters of three states (Kalman 1960; paper (35)-(40)). */
#include "drogue/kalman.h"

#include <string.h>

static const drogue_wide two_pi = {INT64_C(3622009729038561421), -59};

/* Covariance entry (i, j) in the packed upper triangle p00 p01 p02 p11 p12 p22. */
static int packed(int i, int j)
{
    static const int at[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    return at[i][j];
}

void drogue_kalman_restart(drogue_kalman *filter, int parameter, drogue_q16 value_q16, const drogue_q16 std_q16[3])
{
    drogue_kalman3 *f = &filter->parameter[parameter];
    int k;
    memset(f->covariance, 0, sizeof f->covariance);
    for (k = 0; k < 3; k++) {
        drogue_wide *variance = &f->covariance[packed(k, k)];
        drogue_wide_set_q16(&f->state[k], k == 0 ? value_q16 : 0);
        drogue_wide_set_q16(variance, std_q16[k]);
        drogue_wide_product(variance, variance, variance);
    }
}

void drogue_kalman_init(drogue_kalman *filter, const drogue_q16 value_q16[DROGUE_PARAMETERS],
                        const drogue_q16 std_q16[DROGUE_PARAMETERS][3])
{
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        drogue_kalman_restart(filter, p, value_q16[p], std_q16[p]);
    }
}

/* (v0, v1, v2) -> (v0 + dt v1 + dt^2 / 2 v2, v1 + dt v2, v2); the three are 'apart' from each other. */
static void advance(drogue_wide *v, int apart, const drogue_wide *dt, const drogue_wide *half_dt2)
{
    drogue_wide change;
    drogue_wide_products(&change, dt, &v[apart], half_dt2, &v[2 * apart]);
    drogue_wide_sum(&v[0], &v[0], &change);
    drogue_wide_product(&change, dt, &v[2 * apart]);
    drogue_wide_sum(&v[apart], &v[apart], &change);
}

/* A variance that rounding made negative is 0, and then nothing goes with it. */
static void keep_positive(drogue_kalman3 *f)
{
    int i;
    int j;
    for (i = 0; i < 3; i++) {
        if (f->covariance[packed(i, i)].mantissa < 0) {
            for (j = 0; j < 3; j++) {
                drogue_wide_set(&f->covariance[packed(i, j)], 0, 0);
            }
        }
    }
}

void drogue_kalman_predict(drogue_kalman *filter, uint32_t dt_us, const drogue_q16 std_q16[DROGUE_PARAMETERS])
{
    drogue_wide dt;
    drogue_wide half_dt2;
    int p;
    drogue_wide_set(&half_dt2, 1000000, 0);
    drogue_wide_set(&dt, dt_us, 0);
    drogue_wide_quotient(&dt, &dt, &half_dt2);
    drogue_wide_product(&half_dt2, &dt, &dt);
    drogue_wide_shift(&half_dt2, -1);
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        drogue_kalman3 *f = &filter->parameter[p];
        drogue_wide g[3]; /* process noise is g g' */
        drogue_wide c[3][3];
        int i;
        int j;
        advance(f->state, 1, &dt, &half_dt2);
        for (i = 0; i < 3; i++) {
            for (j = 0; j < 3; j++) {
                c[i][j] = f->covariance[packed(i, j)];
            }
        }
        for (i = 0; i < 3; i++) {
            advance(&c[0][i], 3, &dt, &half_dt2);
        }
        for (i = 0; i < 3; i++) {
            advance(c[i], 1, &dt, &half_dt2);
        }
        drogue_wide_set_q16(&g[2], std_q16[p]);
        drogue_wide_product(&g[0], &half_dt2, &g[2]);
        drogue_wide_product(&g[1], &dt, &g[2]);
        for (i = 0; i < 3; i++) {
            for (j = i; j < 3; j++) {
                drogue_wide *to = &f->covariance[packed(i, j)];
                drogue_wide_product(to, &g[i], &g[j]);
                drogue_wide_sum(to, &c[i][j], to);
            }
        }
        keep_positive(f);
    }
}

/* Less the whole turns of an angle. */
static void wrap(drogue_wide *angle)
{
    drogue_wide turns;
    drogue_wide_quotient(&turns, angle, &two_pi);
    drogue_wide_set(&turns, drogue_wide_to_s64(turns, 0), 0);
    drogue_wide_product(&turns, &turns, &two_pi);
    drogue_wide_difference(angle, angle, &turns);
}

/* Measured less predicted value. */
static void innovation_of(drogue_wide *out, const drogue_kalman *filter, int p, drogue_q16 value_q16)
{
    drogue_wide_set_q16(out, value_q16);
    drogue_wide_difference(out, out, &filter->parameter[p].state[0]);
    if (p == DROGUE_PITCH || p == DROGUE_YAW) {
        wrap(out);
    }
}

void drogue_kalman_correct(drogue_kalman *filter, const drogue_q16 value_q16[DROGUE_PARAMETERS],
                           const drogue_q16 std_q16[DROGUE_PARAMETERS])
{
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        drogue_kalman3 *f = &filter->parameter[p];
        drogue_wide noise;
        drogue_wide variance; /* of the innovation */
        drogue_wide t;        /* first the innovation */
        drogue_wide change;
        drogue_wide first[3]; /* first row of the covariance: P H' */
        drogue_wide gain[3];
        int i;
        int j;
        drogue_wide_set_q16(&noise, std_q16[p]);
        drogue_wide_product(&noise, &noise, &noise);
        drogue_wide_sum(&variance, &f->covariance[0], &noise);
        innovation_of(&t, filter, p, value_q16[p]);
        for (i = 0; i < 3; i++) {
            first[i] = f->covariance[packed(0, i)];
            drogue_wide_quotient(&gain[i], &first[i], &variance);
            drogue_wide_product(&change, &gain[i], &t);
            drogue_wide_sum(&f->state[i], &f->state[i], &change);
        }
        /* (1 - K H) P (1 - K H)' + K L K', term by term; in the first row it comes to P L / (P + L), free of cancellation */
        drogue_wide_quotient(&noise, &noise, &variance);
        for (i = 0; i < 3; i++) {
            drogue_wide_product(&f->covariance[packed(0, i)], &first[i], &noise);
        }
        for (i = 1; i < 3; i++) {
            for (j = i; j < 3; j++) {
                drogue_wide *c = &f->covariance[packed(i, j)];
                drogue_wide_products(&t, &gain[i], &first[j], &gain[j], &first[i]);
                drogue_wide_difference(c, c, &t);
                drogue_wide_product(&t, &gain[i], &gain[j]);
                drogue_wide_product(&t, &t, &variance);
                drogue_wide_sum(c, c, &t);
            }
        }
        keep_positive(f);
    }
}

void drogue_kalman_state(drogue_q16 out_q16[DROGUE_PARAMETERS], const drogue_kalman *filter, int k)
{
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        out_q16[p] = drogue_wide_to_q16(filter->parameter[p].state[k]);
    }
}

void drogue_kalman_std(int64_t out_q32[DROGUE_PARAMETERS], const drogue_kalman *filter)
{
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        out_q32[p] = drogue_wide_to_s64(drogue_wide_sqrt(filter->parameter[p].covariance[0]), 32);
    }
}

drogue_wide drogue_kalman_distance2(const drogue_kalman *filter, const drogue_q16 value_q16[DROGUE_PARAMETERS],
                                    const drogue_wide noise[DROGUE_PACKED_MAX], int n)
{
    drogue_wide innovation[DROGUE_PARAMETERS];
    drogue_wide covariance[DROGUE_PACKED_MAX];
    drogue_wide sum = {0, 0};
    int p;
    for (p = 0; p < n * (n + 1) / 2; p++) {
        covariance[p] = noise[p];
    }
    for (p = 0; p < n; p++) {
        drogue_wide *own = &covariance[DROGUE_PACKED(p, p)];
        drogue_wide square;
        drogue_wide_sum(own, own, &filter->parameter[p].covariance[0]);
        innovation_of(&innovation[p], filter, p, value_q16[p]);
        drogue_wide_product(&square, &innovation[p], &innovation[p]);
        drogue_wide_quotient(&square, &square, own);
        drogue_wide_sum(&sum, &sum, &square);
    }
    if (drogue_cholesky_factor(covariance, n) != DROGUE_OK) {
        return sum;
    }
    return drogue_cholesky_square(innovation, covariance, n);
}
