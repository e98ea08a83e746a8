/* SPDX-License-Identifier: Apache-2.0 */
/* Five Kalman filters of three states (Kalman 1960; paper (35)-(40)). */
#include "drogue/kalman.h"

static const drogue_wide two_pi = {INT64_C(3622009729038561421), -59};

/* Covariance entry (i, j) in the packed upper triangle p00 p01 p02 p11 p12 p22. */
static int packed(int i, int j)
{
    static const int at[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    return at[i][j];
}

void drogue_kalman_restart(drogue_kalman *filter, int parameter, drogue_q16 value_q16, const drogue_q16 std_q16[3])
{
    const drogue_wide zero = {0, 0};
    drogue_kalman3 *f = &filter->parameter[parameter];
    int k;
    for (k = 0; k < 6; k++) {
        f->covariance[k] = zero;
    }
    for (k = 0; k < 3; k++) {
        drogue_wide s = drogue_wide_from_q16(std_q16[k]);
        f->state[k] = k == 0 ? drogue_wide_from_q16(value_q16) : zero;
        f->covariance[packed(k, k)] = drogue_wide_mul(s, s);
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

/* (v0, v1, v2) -> (v0 + dt v1 + dt^2 / 2 v2, v1 + dt v2, v2) */
static void advance(drogue_wide *v0, drogue_wide *v1, drogue_wide *v2, drogue_wide dt, drogue_wide half_dt2)
{
    *v0 = drogue_wide_add(*v0, drogue_wide_add(drogue_wide_mul(dt, *v1), drogue_wide_mul(half_dt2, *v2)));
    *v1 = drogue_wide_add(*v1, drogue_wide_mul(dt, *v2));
}

void drogue_kalman_predict(drogue_kalman *filter, uint32_t dt_us, const drogue_q16 std_q16[DROGUE_PARAMETERS])
{
    drogue_wide dt = drogue_wide_div(drogue_wide_from_s64(dt_us, 0), drogue_wide_from_s64(1000000, 0));
    drogue_wide half_dt2 = drogue_wide_scale(drogue_wide_mul(dt, dt), -1);
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        drogue_kalman3 *f = &filter->parameter[p];
        drogue_wide s = drogue_wide_from_q16(std_q16[p]);
        drogue_wide g[3]; /* process noise is g g' */
        drogue_wide c[3][3];
        int i;
        int j;
        advance(&f->state[0], &f->state[1], &f->state[2], dt, half_dt2);
        for (i = 0; i < 3; i++) {
            for (j = 0; j < 3; j++) {
                c[i][j] = f->covariance[packed(i, j)];
            }
        }
        for (j = 0; j < 3; j++) {
            advance(&c[0][j], &c[1][j], &c[2][j], dt, half_dt2);
        }
        for (i = 0; i < 3; i++) {
            advance(&c[i][0], &c[i][1], &c[i][2], dt, half_dt2);
        }
        g[0] = drogue_wide_mul(half_dt2, s);
        g[1] = drogue_wide_mul(dt, s);
        g[2] = s;
        for (i = 0; i < 3; i++) {
            for (j = i; j < 3; j++) {
                f->covariance[packed(i, j)] = drogue_wide_add(c[i][j], drogue_wide_mul(g[i], g[j]));
            }
        }
    }
}

/* Difference of two angles, less its whole turns. */
static drogue_wide wrap(drogue_wide angle)
{
    int64_t turns = drogue_wide_to_s64(drogue_wide_div(angle, two_pi), 0);
    return drogue_wide_sub(angle, drogue_wide_mul(drogue_wide_from_s64(turns, 0), two_pi));
}

/* Measured less predicted value. */
static drogue_wide innovation_of(const drogue_kalman *filter, int p, drogue_q16 value_q16)
{
    drogue_wide d = drogue_wide_sub(drogue_wide_from_q16(value_q16), filter->parameter[p].state[0]);
    return p == DROGUE_PITCH || p == DROGUE_YAW ? wrap(d) : d;
}

void drogue_kalman_correct(drogue_kalman *filter, const drogue_q16 value_q16[DROGUE_PARAMETERS],
                           const drogue_q16 std_q16[DROGUE_PARAMETERS])
{
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        drogue_kalman3 *f = &filter->parameter[p];
        drogue_wide s = drogue_wide_from_q16(std_q16[p]);
        drogue_wide innovation_variance = drogue_wide_add(f->covariance[0], drogue_wide_mul(s, s));
        drogue_wide innovation = innovation_of(filter, p, value_q16[p]);
        drogue_wide first[3]; /* first row of the covariance: P H' */
        drogue_wide gain[3];
        drogue_wide shrink;
        int i;
        int j;
        for (i = 0; i < 3; i++) {
            first[i] = f->covariance[packed(0, i)];
            gain[i] = drogue_wide_div(first[i], innovation_variance);
            f->state[i] = drogue_wide_add(f->state[i], drogue_wide_mul(gain[i], innovation));
        }
        /* (1 - K H) P (1 - K H)' + K L K', term by term; in the first row it comes to P L / (P + L), free of cancellation */
        shrink = drogue_wide_div(drogue_wide_mul(s, s), innovation_variance);
        for (j = 0; j < 3; j++) {
            f->covariance[packed(0, j)] = drogue_wide_mul(first[j], shrink);
        }
        for (i = 1; i < 3; i++) {
            for (j = i; j < 3; j++) {
                drogue_wide cross =
                    drogue_wide_add(drogue_wide_mul(gain[i], first[j]), drogue_wide_mul(gain[j], first[i]));
                drogue_wide own = drogue_wide_mul(drogue_wide_mul(gain[i], gain[j]), innovation_variance);
                drogue_wide *c = &f->covariance[packed(i, j)];
                *c = drogue_wide_add(drogue_wide_sub(*c, cross), own);
            }
        }
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
        *own = drogue_wide_add(*own, filter->parameter[p].covariance[0]);
        innovation[p] = innovation_of(filter, p, value_q16[p]);
        sum = drogue_wide_add(sum, drogue_wide_div(drogue_wide_mul(innovation[p], innovation[p]), *own));
    }
    if (drogue_cholesky_factor(covariance, n) != DROGUE_OK) {
        return sum;
    }
    return drogue_cholesky_square(innovation, covariance, n);
}
