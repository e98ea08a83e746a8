/* SPDX-License-Identifier: Apache-2.0 */
/* How far an ellipse was moved and bent. */
#include "harmonics.h"

#include "collection.h"

#include "drogue/fixed.h"

#define GROUPS DROGUE_EDGE_GROUPS
#define BINS (DROGUE_SUPPORT_BINS / GROUPS) /* of a support beside a group */
#define HALF_TURN (DROGUE_SUPPORT_BINS / 2) /* bins */
#define LEAST_Q24 (8 << 16)                 /* px: what the pixels' grid makes of any edge */
#define MOST_Q24 (1 << 21)                  /* semi-axes, of a harmonic */

/* Offsets along the normal as radial ones, in semi-axes times b: times the length of the normal in semi-axes, which is
 * the same in all quadrants. */
static void spread(int32_t off_px_q24[DROGUE_SUPPORT_BINS], const int32_t moved_q20[GROUPS], const drogue_ellipse *e)
{
    const int64_t ratio_q24 = drogue_div_round_s64(e->b_px_q16 * (INT64_C(1) << 24), e->a_px_q16);
    uint32_t k;
    for (k = 0; k < DROGUE_SUPPORT_BINS / 4; k++) {
        const uint32_t bins[4] = {k, HALF_TURN - 1 - k, HALF_TURN + k, 2 * HALF_TURN - 1 - k};
        int32_t basis_q30[5];
        int64_t length_q24;
        int32_t u_q24;
        int32_t v_q24;
        int i;
        drogue_support_basis(basis_q30, k);
        u_q24 = (int32_t)drogue_shr_round_s64(basis_q30[1] * ratio_q24, 30);
        v_q24 = (int32_t)drogue_shr_round_s64(basis_q30[2], 6);
        length_q24 = drogue_isqrt_u64(drogue_square_sum(u_q24, v_q24));
        for (i = 0; i < 4; i++) { /* half a pixel each */
            off_px_q24[bins[i]] = (int32_t)drogue_shr_round_s64(moved_q20[bins[i] / BINS] * length_q24, 21);
        }
    }
}

/* Least squares of drogue_support_basis() over the bins. */
static void fit_waves(int32_t c_px_q24[5], const int32_t off_px_q24[DROGUE_SUPPORT_BINS])
{
    int64_t sum_q54[5] = {0, 0, 0, 0, 0};
    uint32_t k;
    int i;
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        int32_t basis_q30[5];
        drogue_support_basis(basis_q30, k);
        for (i = 0; i < 5; i++) {
            sum_q54[i] += drogue_product(off_px_q24[k], basis_q30[i]);
        }
    }
    for (i = 0; i < 5; i++) {
        c_px_q24[i] = (int32_t)drogue_shr_round_s64(sum_q54[i], i > 0 ? 34 : 35);
    }
}

/* Squares of the groups' offsets that the harmonics leave, px^2 Q48; each the sum of its bins'. */
static uint64_t squares_left(const int32_t off_px_q24[DROGUE_SUPPORT_BINS], const int32_t c_px_q24[5])
{
    uint64_t squares_q48 = 0;
    int64_t left_q54 = 0;
    uint32_t k;
    int i;
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        int32_t basis_q30[5];
        drogue_support_basis(basis_q30, k);
        left_q54 += drogue_product(off_px_q24[k], basis_q30[0]);
        for (i = 0; i < 5; i++) {
            left_q54 -= drogue_product(c_px_q24[i], basis_q30[i]);
        }
        if (k % BINS == BINS - 1) {
            squares_q48 += drogue_square_sum((int32_t)drogue_shr_round_s64(left_q54, 30), 0);
            left_q54 = 0;
        }
    }
    return squares_q48;
}

/* Variance of a wave, px^2 Q48, a quarter of what it is of a group's mean: by half of what the three degrees of freedom
 * show that the harmonics leave, some of which lies beside the outline, by noise, and by the grid; as of a round
 * outline. */
static uint64_t variance_of(const int32_t off_px_q24[DROGUE_SUPPORT_BINS], const int32_t c_px_q24[5],
                            const int32_t noise_px_q24[GROUPS])
{
    uint64_t noise_q48 = 0;
    int32_t i;
    for (i = 0; i < GROUPS; i++) {
        noise_q48 += drogue_square_sum(noise_px_q24[i], 0);
    }
    return squares_left(off_px_q24, c_px_q24) / (24 * BINS * BINS) + noise_q48 / (4 * GROUPS) +
           drogue_square_sum(LEAST_Q24, 0);
}

/* Less what is likely noise of it: c c^2 / (c^2 + variance), as Wiener's filter. */
static int32_t shrunk(int32_t c_px_q24, uint64_t variance_q48)
{
    const uint64_t both_q48 = drogue_square_sum(c_px_q24, 0) + variance_q48;
    int64_t noise_q30;
    int shift;
    if (variance_q48 == 0) {
        return c_px_q24;
    }
    shift = 33 - drogue_clz_u64(both_q48); /* to 31 bits; the grid's variance alone has more */
    noise_q30 = drogue_div_round_s64((int64_t)((variance_q48 >> shift) << 30), (int64_t)(both_q48 >> shift));
    return c_px_q24 - (int32_t)drogue_shr_round_s64(c_px_q24 * noise_q30, 30);
}

void drogue_find_harmonics(int32_t pull_q24[5], const int32_t moved_q20[GROUPS], const int32_t noise_px_q24[GROUPS],
                           const drogue_ellipse *e)
{
    int32_t off_px_q24[DROGUE_SUPPORT_BINS];
    int32_t c_px_q24[5];
    uint64_t variance_q48;
    int32_t i;
    spread(off_px_q24, moved_q20, e);
    fit_waves(c_px_q24, off_px_q24);
    variance_q48 = noise_px_q24 == NULL ? 0 : variance_of(off_px_q24, c_px_q24, noise_px_q24);
    for (i = 0; i < 5; i++) {
        const uint64_t own_q48 = i > 0 ? variance_q48 : variance_q48 / 2; /* of a mean half that of a wave */
        const int64_t c_px_q40 = shrunk(c_px_q24[i], own_q48) * (int64_t)DROGUE_Q16_ONE;
        const int64_t c_q24 = drogue_div_round_s64(c_px_q40, e->b_px_q16);
        pull_q24[i] = drogue_clamp_s32(drogue_sat_s32(c_q24), -MOST_Q24, MOST_Q24);
    }
}

void drogue_outline_put_back(drogue_ellipse *e, const int32_t pull_q24[5])
{
    const int64_t a =
        (int64_t)e->a_px_q16 - drogue_shr_round_s64((int64_t)e->a_px_q16 * (pull_q24[0] + pull_q24[3]), 24);
    const int64_t b =
        (int64_t)e->b_px_q16 - drogue_shr_round_s64((int64_t)e->b_px_q16 * (pull_q24[0] - pull_q24[3]), 24);
    const int64_t harmonic = (int64_t)e->a_px_q16 * e->b_px_q16 / ((int64_t)e->a_px_q16 + e->b_px_q16);
    const int64_t cross = -drogue_shr_round_s64(2 * harmonic * pull_q24[4], 24);
    const int64_t half = (a - b) / 2;
    const int64_t u = -drogue_shr_round_s64((int64_t)e->a_px_q16 * pull_q24[1], 24);
    const int64_t v = -drogue_shr_round_s64((int64_t)e->b_px_q16 * pull_q24[2], 24);
    const int32_t apart = (int32_t)drogue_isqrt_u64((uint64_t)(half * half + cross * cross));
    int64_t angle;
    if (pull_q24[0] == 0 && pull_q24[1] == 0 && pull_q24[2] == 0 && pull_q24[3] == 0 && pull_q24[4] == 0) {
        return;
    }
    drogue_ellipse_shift(e, drogue_sat_s32(u), drogue_sat_s32(v));
    e->a_px_q16 = (drogue_q16)((a + b) / 2 + apart);
    e->b_px_q16 = (drogue_q16)((a + b) / 2 - apart);
    angle = e->angle_rad_q16 + drogue_shr_round_s64(drogue_atan2_q29(cross, half), 14);
    angle = angle > DROGUE_Q16_HALF_PI     ? angle - DROGUE_Q16_PI
            : angle <= -DROGUE_Q16_HALF_PI ? angle + DROGUE_Q16_PI
                                           : angle;
    e->angle_rad_q16 = (drogue_q16)angle;
}
