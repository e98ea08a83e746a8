/* SPDX-License-Identifier: Apache-2.0 */
/* Support of an ellipse by all edge points. */
#include "drogue/support.h"

#include <string.h>

/* Points that bin k of a quadrant needs: 0.35 of its length (b + (a - b) sin^2) pi / 16 px, within 8 % for axis ratios
 * from 0.4. */
static uint32_t needed_points(const drogue_ellipse *e, uint32_t k)
{
    /* sin^2 at the middles of the bins of a quadrant, Q16 */
    static const uint16_t sin2_q16[8] = {630, 5522, 14563, 26375, 39160, 50973, 60014, 64906};
    const int64_t mean_q16 = e->b_px_q16 + drogue_shr_round_s64(((int64_t)e->a_px_q16 - e->b_px_q16) * sin2_q16[k], 16);
    const int64_t length_q16 = drogue_shr_round_s64(mean_q16 * DROGUE_Q16_PI, 20);
    return (uint32_t)((drogue_shr_round_s64(length_q16 * DROGUE_Q16(35, 100), 16) + 0xFFFF) >> 16);
}

/* How many bins a word has, a bit each. */
static uint32_t bits_of(uint32_t bins)
{
    uint32_t v = bins - ((bins >> 1) & 0x55555555u);
    v = (v & 0x33333333u) + ((v >> 2) & 0x33333333u);
    v = (v + (v >> 4)) & 0x0F0F0F0Fu;
    return (v * 0x01010101u) >> 24;
}

static uint32_t turned(uint32_t v, int n) { return v << n | v >> (32 - n); }

/* Changes of polarity between one covered bin and the next, round the outline. */
static uint32_t changes(uint32_t bright, uint32_t covered)
{
    uint32_t known = covered;
    uint32_t own = bright & covered;
    int n;
    for (n = 1; n < 32; n *= 2) { /* bins that are not covered take the polarity of the covered one before them */
        own |= turned(own, n) & ~known;
        known |= turned(known, n);
    }
    return bits_of(own ^ turned(own, 1));
}

/* Bins that hold enough points of each polarity. */
static void enough_points(uint32_t enough[2], const drogue_support *support, const drogue_ellipse *ellipse,
                          uint32_t stride)
{
    uint32_t needed[DROGUE_SUPPORT_BINS / 4];
    uint32_t dark = 0;
    uint32_t bright = 0;
    uint32_t k;
    for (k = 0; k < DROGUE_SUPPORT_BINS / 4; k++) {
        needed[k] = needed_points(ellipse, k);
    }
    for (k = DROGUE_SUPPORT_BINS; k-- > 0;) {
        const uint32_t *count = support->bin[k].count;
        const uint32_t least = needed[(k & 8u ? ~k : k) & 7u];     /* a quadrant's bins, to and fro */
        dark = dark << 1 | (uint32_t)(count[0] * stride >= least); /* no more than edge points, 2^24 */
        bright = bright << 1 | (uint32_t)(count[1] * stride >= least);
    }
    enough[0] = dark;
    enough[1] = bright;
}

/* The bins that hold enough points of their own polarity. */
static uint32_t covered_bins(const uint32_t enough[2], uint32_t bright_bins)
{
    return (enough[0] & ~bright_bins) | (enough[1] & bright_bins);
}

/* Covered bins when the bins have these polarities, less the changes of polarity. */
static uint32_t covered_by(const uint32_t enough[2], uint32_t bright_bins)
{
    const uint32_t covered = covered_bins(enough, bright_bins);
    const uint32_t count = bits_of(covered);
    const uint32_t lost = changes(bright_bins, covered);
    return count > lost ? count - lost : 0;
}

/* The bins that more points of a bright polarity than of a dark one lie in. */
static uint32_t majority_of(const drogue_support *support)
{
    uint32_t bright = 0;
    uint32_t k;
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        bright |= (uint32_t)(support->bin[k].count[1] > support->bin[k].count[0]) << k;
    }
    return bright;
}

void drogue_support_judge_as(drogue_support *support, const drogue_ellipse *ellipse, uint32_t bright_bins,
                             uint32_t stride)
{
    uint32_t enough[2];
    enough_points(enough, support, ellipse, stride);
    support->bright_bins = bright_bins;
    support->covered = covered_by(enough, bright_bins);
}

void drogue_support_judge(drogue_support *support, const drogue_ellipse *ellipse, drogue_polarity polarity,
                          uint32_t stride)
{
    uint32_t bins[3] = {0, UINT32_MAX, 0}; /* all dark, all bright, each by its majority: the first of equals */
    uint32_t enough[2];
    uint32_t k;
    if (polarity != DROGUE_POLARITY_BOTH) {
        drogue_support_judge_as(support, ellipse, bins[polarity], stride);
        return;
    }
    bins[2] = majority_of(support);
    enough_points(enough, support, ellipse, stride);
    support->bright_bins = bins[0];
    support->covered = covered_by(enough, bins[0]);
    for (k = 1; k < 3; k++) {
        const uint32_t covered = covered_by(enough, bins[k]);
        if (covered > support->covered) {
            support->bright_bins = bins[k];
            support->covered = covered;
        }
    }
}

uint32_t drogue_support_parts(const drogue_support *support, const drogue_ellipse *ellipse)
{
    uint32_t enough[2];
    uint32_t covered;
    enough_points(enough, support, ellipse, 1);
    covered = covered_bins(enough, support->bright_bins);
    covered |= covered >> 1;
    covered |= covered >> 2; /* of each four bins the first */
    return bits_of(covered & 0x11111111u);
}

int32_t drogue_support_cosine(uint32_t j)
{
    static const int32_t quarter_q30[17] = {1073741824, 1068571464, 1053110176, 1027506862, 992008094, 946955747,
                                            892783698,  830013654,  759250125,  681174602,  596538995, 506158392,
                                            410903207,  311690799,  209476638,  105245103,  0};
    const uint32_t turned = j & 31u; /* half a turn changes the sign */
    const int32_t c = turned > 16 ? -quarter_q30[32 - turned] : quarter_q30[turned];
    return j & 32u ? -c : c;
}

void drogue_support_basis(int32_t basis_q30[5], uint32_t k)
{
    const int32_t c = drogue_support_cosine(2 * k + 1);
    const int32_t s = drogue_support_cosine(2 * k + 1 - 16);
    basis_q30[0] = 1 << 30;
    basis_q30[1] = c;
    basis_q30[2] = s;
    basis_q30[3] = (int32_t)drogue_shr_round_s64(drogue_product(c, c) - drogue_product(s, s), 30);
    basis_q30[4] = (int32_t)drogue_shr_round_s64(drogue_product(c, s), 29);
}

drogue_q16 drogue_support_smear(const drogue_support *support)
{
    const int32_t *smear = support->smear_px2_q16;
    return drogue_sat_s32((int64_t)drogue_isqrt_u64(drogue_square_sum(smear[0], smear[1])));
}

void drogue_turn_wave(int32_t wave[2], drogue_q16 by_rad_q16)
{
    int32_t s_q30;
    int32_t c_q30;
    int64_t twice_q30[2];
    int64_t turned[2];
    if (wave[0] == 0 && wave[1] == 0) {
        return; /* as the smear of most frames */
    }
    drogue_sincos_of_q16(&s_q30, &c_q30, by_rad_q16);
    drogue_rotate_q30(twice_q30, c_q30, s_q30, c_q30, s_q30);
    drogue_rotate_q30(turned, wave[0], wave[1], (int32_t)twice_q30[0], (int32_t)twice_q30[1]);
    wave[0] = drogue_sat_s32(turned[0]);
    wave[1] = drogue_sat_s32(turned[1]);
}

void drogue_turn_pull(int32_t out_q24[5], const int32_t pull_q24[5], drogue_q16 turn_rad_q16)
{
    int32_t s_q30;
    int32_t c_q30;
    int64_t wave_q24[2];
    drogue_sincos_of_q16(&s_q30, &c_q30, turn_rad_q16);
    memcpy(out_q24, pull_q24, 5 * sizeof *out_q24);
    drogue_rotate_q30(wave_q24, pull_q24[1], pull_q24[2], c_q30, -s_q30);
    out_q24[1] = (int32_t)wave_q24[0];
    out_q24[2] = (int32_t)wave_q24[1];
    drogue_turn_wave(out_q24 + 3, -turn_rad_q16);
}

uint32_t drogue_support_bins_to(const drogue_support *support, drogue_q16 axis_rad_q16)
{
    const int64_t a_radian_q16 = 333772; /* 32 over 2 pi */
    const int64_t turn_rad_q16 = (int64_t)axis_rad_q16 - support->axis_rad_q16;
    return (uint32_t)drogue_shr_round_s64(turn_rad_q16 * a_radian_q16, 32) % DROGUE_SUPPORT_BINS;
}

void drogue_support_turn(drogue_support *support, drogue_q16 axis_rad_q16)
{
    const uint32_t turn = drogue_support_bins_to(support, axis_rad_q16);
    drogue_support_bin bin[DROGUE_SUPPORT_BINS];
    uint32_t k;
    support->axis_rad_q16 = axis_rad_q16;
    if (turn == 0) {
        return;
    }
    memcpy(bin, support->bin, sizeof bin);
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        support->bin[k] = bin[(k + turn) % DROGUE_SUPPORT_BINS];
    }
    support->bright_bins = turned(support->bright_bins, DROGUE_SUPPORT_BINS - (int)turn);
}
