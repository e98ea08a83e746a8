/* SPDX-License-Identifier: Apache-2.0 */
/* Motion blur, from how wide the outline's edge is on which side: wide across the motion's direction, sharp along it. */
#include "slopes.h"

#include "drogue/fixed.h"

#define WIDEST_Q12 (16 << 12)      /* px */
#define LEAST_Q16 DROGUE_Q16(1, 2) /* px^2: texture and light make so much of edges alike */

/* The most that slopes add up to from one end on. */
static int32_t most_of(const int32_t slope[DROGUE_SLOPES], int32_t from, int32_t end, int32_t step)
{
    int32_t most = 0;
    int32_t sum = 0;
    int32_t i;
    /* bound: DROGUE_SLOPES */
    for (i = from; i != end; i += step) {
        sum += slope[i];
        most = sum > most ? sum : most;
    }
    return most;
}

int32_t drogue_edge_variance(const int32_t slope[DROGUE_SLOPES], const int32_t seen[DROGUE_SLOPES])
{
    int32_t at = DROGUE_SLOPE_FIRST;
    int32_t i;
    int64_t rise;
    int64_t width_q12;
    for (i = DROGUE_SLOPE_FIRST + 1; i <= DROGUE_SLOPE_LAST; i++) {
        at = seen[i] > seen[at] ? i : at;
    }
    rise = (int64_t)slope[at] + most_of(slope, at + 1, DROGUE_SLOPES, 1) + most_of(slope, at - 1, -1, -1);
    if (seen[at] <= 0 || rise <= 0) {
        return 0;
    }
    width_q12 =
        drogue_div_round_s64(rise * (DROGUE_SLOPE_GAIN / 2 * 4096), seen[at]); /* slopes are half a pixel apart */
    width_q12 = width_q12 < WIDEST_Q12 ? width_q12 : WIDEST_Q12;
    return (int32_t)drogue_shr_round_s64(width_q12 * width_q12, 11);
}

void drogue_find_smear(int32_t smear_px2_q16[2], const int32_t variance_px2_q16[DROGUE_EDGE_GROUPS])
{
    int32_t both[DROGUE_EDGE_GROUPS / 2]; /* opposite ones, at 1, 3, 5, 7 eighths of half a turn */
    int64_t wave[2];
    uint64_t square;
    int64_t length;
    int64_t beyond;
    int32_t other;
    int32_t k;
    smear_px2_q16[0] = 0;
    smear_px2_q16[1] = 0;
    for (k = 0; k < DROGUE_EDGE_GROUPS / 2; k++) {
        const int32_t one = variance_px2_q16[k];
        const int32_t two = variance_px2_q16[k + DROGUE_EDGE_GROUPS / 2];
        both[k] = one > 0 && two > 0 ? (one + two) / 2 : one + two;
        if (both[k] == 0) {
            return;
        }
    }
    wave[0] = both[0] - both[1] - both[2] + both[3];
    wave[1] = both[0] + both[1] - both[2] - both[3];
    other = (both[0] - both[1] + both[2] - both[3]) / 2;
    square = drogue_square_sum((int32_t)wave[0], (int32_t)wave[1]);
    length = (int64_t)drogue_isqrt_u64(square);
    beyond = (int64_t)drogue_isqrt_u64(square / 2) - (other < 0 ? -other : other) - LEAST_Q16;
    if (beyond > 0) {
        smear_px2_q16[0] = (int32_t)drogue_div_round_s64(wave[0] * beyond, length);
        smear_px2_q16[1] = (int32_t)drogue_div_round_s64(wave[1] * beyond, length);
    }
}
