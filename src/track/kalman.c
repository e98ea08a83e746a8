/* SPDX-License-Identifier: Apache-2.0 */
/* Five Kalman filters of three states (Kalman 1960; paper (35)-(40)) with factored covariances (Bierman 1977). */
#include "drogue/kalman.h"

#include <string.h>

/* Change a value; what its mantissa does not take stays in its rest (Kahan 1965). */
static void move(drogue_kalman3 *f, const drogue_real *by)
{
    drogue_real change;
    drogue_real t;
    drogue_real_sum(&change, by, &f->rest);
    drogue_real_copy(&t, &f->state[0]);
    drogue_real_sum(&f->state[0], &t, &change);
    drogue_real_difference(&t, &f->state[0], &t);
    drogue_real_difference(&f->rest, &change, &t);
}

static const drogue_real two_pi = {1686629713, -28};

void drogue_kalman_restart(drogue_kalman *filter, int parameter, drogue_q16 value_q16, const drogue_q16 std_q16[3])
{
    drogue_kalman3 *f = &filter->parameter[parameter];
    int k;
    memset(f, 0, sizeof *f);
    drogue_real_set_q16(&f->state[0], value_q16);
    for (k = 0; k < 3; k++) {
        drogue_real_set_q16(&f->variance[k], std_q16[k]);
        drogue_real_product(&f->variance[k], &f->variance[k], &f->variance[k]);
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

/* A step of constant acceleration. */
typedef struct interval {
    drogue_real dt;
    drogue_real half_dt2;
} interval;

/* (v0, v1, v2) -> (v0 + dt v1 + dt^2 / 2 v2, v1 + dt v2, v2) */
static void advance(drogue_real v[3], const interval *t)
{
    drogue_real change;
    drogue_real_products(&change, &t->dt, &v[1], &t->half_dt2, &v[2]);
    drogue_real_sum(&v[0], &v[0], &change);
    drogue_real_product(&change, &t->dt, &v[2]);
    drogue_real_sum(&v[1], &v[1], &change);
}

/* Covariance after a step: that of the states plus s^2 for the acceleration, then advanced; the noise's direction
 * (dt^2 / 2, dt, 1) is where a change of acceleration at the step's beginning leads. The advanced factor's rows are
 * made orthogonal in the metric D (modified Gram and Schmidt, Thornton 1976): sums of squares, which nothing makes
 * negative. */
static void spread(drogue_kalman3 *f, const interval *t, drogue_q16 std_q16)
{
    drogue_real rows[3][3];
    drogue_real d[3];
    drogue_real v[3];
    int i;
    int j;
    int k;
    drogue_real_set_q16(&v[0], std_q16);
    drogue_real_product(&v[0], &v[0], &v[0]);
    drogue_real_sum(&f->variance[2], &f->variance[2], &v[0]);
    for (k = 0; k < 3; k++) { /* column k of L, advanced */
        drogue_real_copy(&d[k], &f->variance[k]);
        for (i = 0; i < 3; i++) {
            drogue_real_set(&v[i], i == k, 0);
            if (i > k) {
                drogue_real_copy(&v[i], &f->slope[i + k - 1]);
            }
        }
        advance(v, t);
        for (i = 0; i < 3; i++) {
            drogue_real_copy(&rows[i][k], &v[i]);
        }
    }
    for (j = 0; j < 3; j++) { /* the rows below lose what they share with row j */
        for (k = 0; k < 3; k++) {
            drogue_real_product(&v[k], &rows[j][k], &d[k]);
        }
        for (i = j; i < 3; i++) {
            drogue_real sum;
            drogue_real last;
            drogue_real_products(&sum, &rows[i][0], &v[0], &rows[i][1], &v[1]);
            drogue_real_product(&last, &rows[i][2], &v[2]);
            drogue_real_sum(&sum, &sum, &last);
            if (i == j) {
                drogue_real_copy(&f->variance[j], &sum);
                continue;
            }
            drogue_real_quotient(&sum, &sum, &f->variance[j]); /* 0 where the row has no variance */
            for (k = 0; k < 3; k++) {
                drogue_real_subtract_product(&rows[i][k], &sum, &rows[j][k]);
            }
            drogue_real_copy(&f->slope[i + j - 1], &sum);
        }
    }
}

static int is_angle(int p) { return p == DROGUE_PITCH || p == DROGUE_YAW; }

/* Less the whole turns of an angle. */
static void wrap(drogue_real *angle)
{
    drogue_real turns;
    drogue_real_quotient(&turns, angle, &two_pi);
    drogue_real_set(&turns, drogue_real_to_s64(turns, 0), 0);
    drogue_real_subtract_product(angle, &turns, &two_pi);
}

void drogue_kalman_predict(drogue_kalman *filter, uint32_t dt_us, const drogue_q16 std_q16[DROGUE_PARAMETERS])
{
    interval t;
    int p;
    drogue_real_ratio(&t.dt, dt_us, 1000000);
    drogue_real_product(&t.half_dt2, &t.dt, &t.dt);
    drogue_real_shift(&t.half_dt2, -1);
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        drogue_kalman3 *f = &filter->parameter[p];
        drogue_real change;
        drogue_real_products(&change, &t.dt, &f->state[1], &t.half_dt2, &f->state[2]);
        move(f, &change);
        if (is_angle(p)) { /* over a long step it turns often */
            wrap(&f->state[0]);
        }
        drogue_real_product(&change, &t.dt, &f->state[2]);
        drogue_real_sum(&f->state[1], &f->state[1], &change);
        spread(f, &t, std_q16[p]);
    }
}

void drogue_kalman_innovation(drogue_real *out, const drogue_kalman *filter, int p, drogue_q16 value_q16)
{
    drogue_real_set_q16(out, value_q16);
    drogue_real_difference(out, out, &filter->parameter[p].state[0]);
    drogue_real_difference(out, out, &filter->parameter[p].rest);
    if (is_angle(p)) {
        wrap(out);
    }
}

void drogue_kalman_correct(drogue_kalman *filter, const drogue_q16 value_q16[DROGUE_PARAMETERS],
                           const drogue_q16 std_q16[DROGUE_PARAMETERS])
{
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        drogue_kalman3 *f = &filter->parameter[p];
        drogue_real noise;
        drogue_real variance; /* of the innovation */
        drogue_real change;   /* of the value, then of what depends on it */
        drogue_real t;
        drogue_real_set_q16(&noise, std_q16[p]);
        drogue_real_product(&noise, &noise, &noise);
        drogue_real_sum(&variance, &f->variance[0], &noise);
        drogue_kalman_innovation(&change, filter, p, value_q16[p]);
        drogue_real_quotient(&t, &f->variance[0], &variance);
        drogue_real_product(&change, &change, &t);
        move(f, &change);
        drogue_real_product(&t, &f->slope[0], &change);
        drogue_real_sum(&f->state[1], &f->state[1], &t);
        drogue_real_product(&t, &f->slope[1], &change);
        drogue_real_sum(&f->state[2], &f->state[2], &t);
        /* Only the value is measured: its variance alone changes, to the product over the sum of both. */
        drogue_real_quotient(&noise, &noise, &variance);
        drogue_real_product(&f->variance[0], &f->variance[0], &noise);
    }
}

void drogue_kalman_state(drogue_q16 out_q16[DROGUE_PARAMETERS], const drogue_kalman *filter, int k)
{
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        out_q16[p] = drogue_real_to_q16(filter->parameter[p].state[k]);
    }
}

void drogue_kalman_std(int64_t out_q32[DROGUE_PARAMETERS], const drogue_kalman *filter)
{
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        drogue_real std;
        drogue_real_root(&std, &filter->parameter[p].variance[0]);
        out_q32[p] = drogue_real_to_s64(std, 32);
    }
}

void drogue_kalman_distance2(drogue_real *out, const drogue_kalman *filter,
                             const drogue_q16 value_q16[DROGUE_PARAMETERS], const drogue_real noise[DROGUE_PACKED_MAX],
                             int n)
{
    drogue_real innovation[DROGUE_PARAMETERS];
    drogue_real covariance[DROGUE_PACKED_MAX];
    int p;
    drogue_real_set(out, 0, 0);
    for (p = 0; p < n * (n + 1) / 2; p++) {
        drogue_real_copy(&covariance[p], &noise[p]);
    }
    for (p = 0; p < n; p++) {
        drogue_real *own = &covariance[DROGUE_PACKED(p, p)];
        drogue_real square;
        drogue_real_sum(own, own, &filter->parameter[p].variance[0]);
        drogue_kalman_innovation(&innovation[p], filter, p, value_q16[p]);
        drogue_real_product(&square, &innovation[p], &innovation[p]);
        drogue_real_quotient(&square, &square, own);
        drogue_real_sum(out, out, &square);
    }
    if (drogue_cholesky_factor(covariance, n) == DROGUE_OK) {
        drogue_cholesky_square(out, innovation, covariance, n);
    }
}
