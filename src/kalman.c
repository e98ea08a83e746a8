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

void drogue_kalman_init(drogue_kalman *filter, const drogue_q16 value_q16[DROGUE_PARAMETERS],
                        const drogue_q16 std_q16[DROGUE_PARAMETERS][3])
{
    const drogue_wide zero = {0, 0};
    int p;
    int k;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        drogue_kalman3 *f = &filter->parameter[p];
        for (k = 0; k < 6; k++) {
            f->covariance[k] = zero;
        }
        for (k = 0; k < 3; k++) {
            drogue_wide s = drogue_wide_from_q16(std_q16[p][k]);
            f->state[k] = k == 0 ? drogue_wide_from_q16(value_q16[p]) : zero;
            f->covariance[packed(k, k)] = drogue_wide_mul(s, s);
        }
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

void drogue_kalman_correct(drogue_kalman *filter, const drogue_q16 value_q16[DROGUE_PARAMETERS],
                           const drogue_q16 std_q16[DROGUE_PARAMETERS])
{
    int p;
    for (p = 0; p < DROGUE_PARAMETERS; p++) {
        drogue_kalman3 *f = &filter->parameter[p];
        drogue_wide s = drogue_wide_from_q16(std_q16[p]);
        drogue_wide innovation_variance = drogue_wide_add(f->covariance[0], drogue_wide_mul(s, s));
        drogue_wide innovation = drogue_wide_sub(drogue_wide_from_q16(value_q16[p]), f->state[0]);
        drogue_wide first[3]; /* first row of the covariance: P H' */
        drogue_wide gain[3];
        drogue_wide shrink;
        int i;
        int j;
        if (p == DROGUE_PITCH || p == DROGUE_YAW) {
            innovation = wrap(innovation);
        }
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
