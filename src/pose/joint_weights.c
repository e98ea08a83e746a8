/* SPDX-License-Identifier: Apache-2.0 */
/* How much outline and inner part are to be believed: covariance of the outline from its bins, weights for the
 * solver. */
#include <string.h>

#include "joint_model.h"

#define HARMONICS 4

/* Normal equations of the fit, points times products of the basis functions 1, cos t, sin t, cos 2t, sin 2t: sums of
 * cos mt and sin mt, t from the axis that is turned by so many bins; 'scatter' is the squared residual of the bins'
 * means. Returns the number of bins that hold points. */
static int32_t sum_bins(drogue_real information[DROGUE_PACKED_MAX], drogue_real *scatter, const drogue_support *support,
                        uint32_t turned)
{
    int64_t c_q30[HARMONICS + 1] = {0};
    int64_t s_q30[HARMONICS + 1] = {0};
    int32_t bins = 0;
    uint32_t k;
    int i;
    drogue_real_set(scatter, 0, 0);
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        const uint32_t n = support->bin[k].count[(support->bright_bins >> k) & 1u];
        const int32_t sum_q16 = support->bin[k].sum_q16;
        uint32_t m;
        drogue_real square;
        drogue_real points;
        if (n == 0) {
            continue;
        }
        bins++;
        DROGUE_NOTE("joint: squared sum of a bin's offsets, Q32", (int64_t)sum_q16 * sum_q16, 61); /* band.h: 2^30 */
        drogue_real_set(&square, drogue_product(sum_q16, sum_q16), -32);
        drogue_real_set(&points, n, 0);
        drogue_real_quotient(&square, &square, &points);
        drogue_real_sum(scatter, scatter, &square);
        c_q30[0] += drogue_shl_s64(n, 30);
        for (m = 1; m <= HARMONICS; m++) { /* the middle of bin k is 2 k + 1 64ths of a turn */
            const uint32_t turn = m * (2 * (k + DROGUE_SUPPORT_BINS - turned) + 1);
            c_q30[m] += drogue_product((int32_t)n, drogue_support_cosine(turn));
            s_q30[m] += drogue_product((int32_t)n, drogue_support_cosine(turn - 16));
        }
    }
    {
        /* twice the sums of the products, packed */
        const int64_t sum_q30[DROGUE_PACKED_MAX] = {2 * c_q30[0],
                                                    2 * c_q30[1],
                                                    c_q30[0] + c_q30[2],
                                                    2 * s_q30[1],
                                                    s_q30[2],
                                                    c_q30[0] - c_q30[2],
                                                    2 * c_q30[2],
                                                    c_q30[1] + c_q30[3],
                                                    s_q30[3] - s_q30[1],
                                                    c_q30[0] + c_q30[4],
                                                    2 * s_q30[2],
                                                    s_q30[1] + s_q30[3],
                                                    c_q30[1] - c_q30[3],
                                                    s_q30[4],
                                                    c_q30[0] - c_q30[4]};
        for (i = 0; i < DROGUE_PACKED_MAX; i++) {
            /* 2^22 points at most, basis functions at most 1 */
            DROGUE_NOTE("joint: information, Q31", sum_q30[i], 54);
            drogue_real_set(&information[i], sum_q30[i], -31);
        }
    }
    return bins;
}

/* Variance of a standard deviation num / den. */
static void square_ratio(drogue_real *out, const drogue_real *num, const drogue_real *den)
{
    drogue_real_quotient(out, num, den);
    drogue_real_product(out, out, out);
}

/* Motion blur with a smear of v px^2 leaves a doubt of 0.153 px / px^2 of v in the outline's place on each of the two
 * sides that it blurs, whose edge has no steepest place: their mean and half their difference by the root of half of
 * that each. As for an outline that is nearly round. */
#define MOST_SMEAR_Q16 DROGUE_Q16(48, 1) /* px^2: more than drogue_outline_pull() finds */

static void add_smear(drogue_real covariance[DROGUE_PACKED_MAX], const drogue_ellipse *e, const drogue_support *support)
{
    static const uint8_t added[9][3] = {
        /* where, product of which */
        {DROGUE_PACKED(0, 0), 0, 0}, {DROGUE_PACKED(1, 1), 0, 3}, {DROGUE_PACKED(2, 1), 0, 5},
        {DROGUE_PACKED(2, 2), 0, 4}, {DROGUE_PACKED(3, 0), 0, 1}, {DROGUE_PACKED(3, 3), 1, 1},
        {DROGUE_PACKED(4, 0), 0, 2}, {DROGUE_PACKED(4, 3), 1, 2}, {DROGUE_PACKED(4, 4), 2, 2}};
    int32_t wave[2] = {drogue_clamp_s32(support->smear_px2_q16[0], -MOST_SMEAR_Q16, MOST_SMEAR_Q16),
                       drogue_clamp_s32(support->smear_px2_q16[1], -MOST_SMEAR_Q16, MOST_SMEAR_Q16)};
    int32_t factor[6]; /* v, c, s, 2 (v + c), 2 (v - c), 2 s */
    uint64_t square;
    drogue_real share;
    drogue_real t;
    int i;
    drogue_turn_wave(wave, drogue_q16_sub(0, e->angle_rad_q16));
    square = drogue_square_sum(wave[0], wave[1]);
    if (square == 0) {
        return; /* as most frames are */
    }
    factor[0] = (int32_t)drogue_isqrt_u64(square);
    factor[0] += (uint64_t)((int64_t)factor[0] * factor[0]) < square; /* rounded up: what is added stays positive */
    factor[1] = wave[0];
    factor[2] = wave[1];
    factor[3] = 2 * (factor[0] + wave[0]);
    factor[4] = 2 * (factor[0] - wave[0]);
    factor[5] = 2 * wave[1];
    drogue_real_set(&share, 3, -10); /* 0.153^2 / 8 */
    drogue_real_set_q16(&t, e->a_px_q16);
    drogue_real_quotient(&share, &share, &t);
    drogue_real_set_q16(&t, e->b_px_q16);
    drogue_real_quotient(&share, &share, &t);
    for (i = 0; i < 9; i++) {
        drogue_real *own = &covariance[added[i][0]];
        drogue_real_set(&t, drogue_product(factor[added[i][1]], factor[added[i][2]]), -32);
        drogue_real_product(&t, &t, &share);
        drogue_real_sum(own, own, &t);
    }
}

drogue_status drogue_joint_outline_covariance(drogue_real covariance[DROGUE_PACKED_MAX], const drogue_ellipse *ellipse,
                                              const drogue_support *support, drogue_q16 shading_q16,
                                              drogue_q16 blur_px2_q16)
{
    /* 0.3 px^2 over the semi-axis: what the pixels' grid makes of all edges */
    const drogue_real grid_px2 = {1288490189, -32};
    drogue_real scatter;
    drogue_real variance;
    drogue_real a;
    drogue_real t;
    int i;
    const int32_t bins =
        sum_bins(covariance, &scatter, support, drogue_support_bins_to(support, ellipse->angle_rad_q16));
    if (bins <= DROGUE_JOINT_FIT || support->gradient == 0 ||
        drogue_cholesky_factor(covariance, DROGUE_JOINT_FIT) != DROGUE_OK) {
        return DROGUE_E_DEGENERATE;
    }
    drogue_real_set(&t, bins - DROGUE_JOINT_FIT, 0);
    drogue_real_quotient(&scatter, &scatter, &t);
    drogue_cholesky_invert(covariance, covariance, DROGUE_JOINT_FIT);
    for (i = 0; i < DROGUE_PACKED_MAX; i++) {
        drogue_real_product(&covariance[i], &covariance[i], &scatter);
    }
    /* shading times points over the semi-axis times the sum of gradients */
    drogue_real_set_q16(&a, ellipse->a_px_q16);
    drogue_real_set_q16(&variance, shading_q16);
    drogue_real_set(&t, support->points, 0);
    drogue_real_product(&variance, &variance, &t);
    drogue_real_set(&t, (int64_t)support->gradient, 0);
    drogue_real_product(&t, &a, &t);
    square_ratio(&variance, &variance, &t);
    for (i = 0; i < DROGUE_JOINT_FIT; i++) {
        drogue_real *own = &covariance[DROGUE_PACKED(i, i)];
        drogue_real_sum(own, own, &variance);
    }
    /* blur and grid over the product of the semi-axes */
    drogue_real_set_q16(&t, ellipse->b_px_q16);
    drogue_real_product(&a, &a, &t);
    drogue_real_set_q16(&variance, blur_px2_q16);
    square_ratio(&variance, &variance, &a);
    drogue_real_sum(&covariance[0], &covariance[0], &variance);
    square_ratio(&a, &grid_px2, &a);
    for (i = 0; i < DROGUE_JOINT_FIT; i++) { /* of what lies beside it half remains */
        drogue_real *own = &covariance[DROGUE_PACKED(i, i)];
        drogue_real_set(&variance, support->pull_q24[i], -25);
        drogue_real_product(&variance, &variance, &variance);
        drogue_real_sum(&variance, &variance, &a);
        drogue_real_sum(own, own, &variance);
    }
    add_smear(covariance, ellipse, support);
    return DROGUE_OK;
}

drogue_status drogue_joint_outline_weigh(drogue_joint_outline *outline, const drogue_ellipse *ellipse,
                                         const drogue_real covariance[DROGUE_PACKED_MAX])
{
    drogue_real information[DROGUE_PACKED_MAX];
    int32_t top = INT32_MIN;
    int i;
    memcpy(information, covariance, sizeof information);
    if (drogue_cholesky_factor(information, DROGUE_JOINT_FIT) != DROGUE_OK) {
        return DROGUE_E_DEGENERATE;
    }
    drogue_cholesky_invert(information, information, DROGUE_JOINT_FIT);
    for (i = 0; i < DROGUE_PACKED_MAX; i++) { /* one scale: what is 2^30 below the largest is 0 */
        const drogue_real *w = &information[i];
        top = w->mantissa != 0 && w->exponent > top ? w->exponent : top;
    }
    outline->ellipse = *ellipse;
    outline->weight_exponent = top + 1; /* the largest, below 2^31, comes to lie below 2^30 */
    for (i = 0; i < DROGUE_PACKED_MAX; i++) {
        outline->weight[i] = drogue_real_to_s32(information[i], -outline->weight_exponent);
    }
    return DROGUE_OK;
}

void drogue_joint_weigh_inner(drogue_real out[2], const drogue_joint_inner *inner, const drogue_camera *camera)
{
    drogue_real std;
    memset(out, 0, 2 * sizeof *out);
    if (inner->std_px_q16 > 0) { /* its rows are rays */
        drogue_real_set_q16(&std, inner->std_px_q16);
        drogue_real_set_q16(&out[0], camera->fx_px_q16);
        drogue_real_set_q16(&out[1], camera->fy_px_q16);
        square_ratio(&out[0], &out[0], &std);
        square_ratio(&out[1], &out[1], &std);
    }
}
