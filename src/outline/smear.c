/* SPDX-License-Identifier: Apache-2.0 */
/* Motion blur, from how wide the outline's edge is on which side: wide across the motion's direction, sharp along
 * it. */
#include "smear.h"

#include "drogue/fixed.h"

#define LEAST_Q16 DROGUE_Q16(1, 2) /* px^2: texture and light make so much of edges alike */

#define GROUPS DROGUE_EDGE_GROUPS
#define PAIRS (GROUPS / 2)
#define SLOPES DROGUE_SMEARED_SLOPES
#define MIDDLE DROGUE_SMEARED_MIDDLE
#define NEAR 6                     /* slopes: so near the ellipse lies its edge */
#define INWARDS 36                 /* slopes: so far from an edge's inner side the band's other one is looked for */
#define FARTHEST DROGUE_Q16(30, 1) /* slopes: what is farther is no band that motion fills */
#define MARGIN DROGUE_Q16(1, 1) /* slopes: a band is taken as narrower than the motion where that fits better by this */
#define LIKELY DROGUE_Q16(6, 1) /* slopes: where nothing fits better, nothing is known */

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

/* Weights 1, 2, 3, 2, 1. */
static void smooth(int32_t out[SLOPES], const int32_t slope[SLOPES])
{
    int32_t i;
    out[0] = out[1] = out[SLOPES - 2] = out[SLOPES - 1] = 0;
    for (i = 2; i < SLOPES - 2; i++) {
        out[i] = slope[i - 2] + 2 * slope[i - 1] + 3 * slope[i] + 2 * slope[i + 1] + slope[i + 2];
    }
}

static int32_t apart(int32_t a, int32_t b) { return a > b ? a - b : b - a; }

/* Where a curve times a sign has fallen to half of a peak's height on one side, slopes Q16; -1 where it does not. */
static int32_t half_way_q16(const int32_t curve[SLOPES], int32_t peak, int32_t sign, int32_t step)
{
    const int32_t half = sign * curve[peak]; /* of twice the curve */
    int32_t at = peak;
    int32_t next;
    for (next = peak + step; next >= 2 && next < SLOPES - 2; next += step) { /* bound: SLOPES */
        if (2 * sign * curve[next] < half) {
            const int64_t above_q16 = (int64_t)(2 * sign * curve[at] - half) * DROGUE_Q16_ONE;
            const int64_t fall = 2 * sign * (int64_t)(curve[at] - curve[next]);
            return at * DROGUE_Q16_ONE + step * (int32_t)drogue_div_round_s64(above_q16, fall);
        }
        at = next;
    }
    return -1;
}

/* On both sides; 0 where there are not both. */
static int half_height(int32_t *inner_q16, int32_t *outer_q16, const int32_t curve[SLOPES], int32_t peak, int32_t sign)
{
    *inner_q16 = half_way_q16(curve, peak, sign, -1);
    *outer_q16 = half_way_q16(curve, peak, sign, 1);
    return *inner_q16 >= 0 && *outer_q16 >= 0;
}

void drogue_find_lobe(drogue_lobe *lobe, const int32_t slope[DROGUE_SMEARED_SLOPES])
{
    int32_t curve[SLOPES];
    int32_t peak = MIDDLE - NEAR;
    int32_t farthest;
    int32_t inner_q16;
    int32_t outer_q16;
    int32_t i;
    lobe->at_q16 = 0;
    lobe->width_q16 = 0;
    lobe->farther_q16 = 0;
    smooth(curve, slope);
    for (i = MIDDLE - NEAR + 1; i <= MIDDLE + NEAR; i++) {
        peak = curve[i] > curve[peak] ? i : peak;
    }
    if (curve[peak] <= 0 || curve[peak] < curve[peak - 1] || curve[peak] < curve[peak + 1] ||
        !half_height(&inner_q16, &outer_q16, curve, peak, 1)) {
        return; /* none, another's that is farther off, or none that ends */
    }
    lobe->at_q16 = (inner_q16 + outer_q16) / 2 - MIDDLE * DROGUE_Q16_ONE;
    lobe->width_q16 = outer_q16 - inner_q16;
    farthest = inner_q16 >> 16;
    for (i = farthest - 1; i > (inner_q16 >> 16) - INWARDS && i >= 2; i--) { /* bound: INWARDS */
        farthest = curve[i] < curve[farthest] ? i : farthest;
    }
    if (-3 * curve[farthest] > curve[peak] && half_height(&inner_q16, &outer_q16, curve, farthest, -1)) {
        const int32_t between = lobe->at_q16 - ((inner_q16 + outer_q16) / 2 - MIDDLE * DROGUE_Q16_ONE);
        lobe->farther_q16 = between < FARTHEST ? between : 0;
    }
}

/* The width of the band where opposite edges are sharpest; 0 where none sees both of its sides. */
static int32_t band_of(const drogue_lobe lobe[GROUPS])
{
    int32_t sharpest = INT32_MAX;
    int32_t band = 0;
    int32_t k;
    for (k = 0; k < PAIRS; k++) {
        const drogue_lobe *one = &lobe[k];
        const drogue_lobe *two = &lobe[k + PAIRS];
        if (one->farther_q16 > 0 && two->farther_q16 > 0 && one->width_q16 + two->width_q16 < sharpest) {
            sharpest = one->width_q16 + two->width_q16;
            band = (one->farther_q16 + two->farther_q16) / 2;
        }
    }
    return band;
}

/* Two opposite lobes by whether the band is narrower than the motion, at the first and at the second. */
static void explain(int32_t moved_q16[2], const drogue_lobe *const lobe[2], int32_t band_q16)
{
    int32_t motion_q16 = 0;
    int32_t best_q16 = LIKELY;
    int32_t best = 0;
    int32_t i;
    for (i = 0; i < 4; i++) {
        const int narrow[2] = {i & 1, i >> 1};
        const int32_t one = narrow[0] ? lobe[0]->farther_q16 : lobe[0]->width_q16;
        const int32_t two = narrow[1] ? lobe[1]->farther_q16 : lobe[1]->width_q16;
        const int32_t sum = lobe[0]->width_q16 + lobe[0]->farther_q16 + lobe[1]->width_q16 + lobe[1]->farther_q16;
        const int32_t off = apart(one, two) + apart((sum - one - two) / 2, band_q16) + (i > 0 ? MARGIN : 0);
        if (off < best_q16) {
            best_q16 = off;
            best = i;
            motion_q16 = (one + two) / 2;
        }
    }
    for (i = 0; i < 2; i++) {
        if ((best >> i & 1) != 0 && motion_q16 > lobe[i]->width_q16) {
            moved_q16[i] += (motion_q16 - lobe[i]->width_q16) / 2;
        }
    }
}

void drogue_find_smeared(int32_t moved_q16[DROGUE_EDGE_GROUPS], const drogue_lobe lobe[DROGUE_EDGE_GROUPS])
{
    const int32_t band_q16 = band_of(lobe);
    int32_t k;
    for (k = 0; k < PAIRS; k++) {
        const drogue_lobe *const both[2] = {&lobe[k], &lobe[k + PAIRS]};
        int32_t moved[2] = {-both[0]->at_q16, -both[1]->at_q16};
        if (both[0]->farther_q16 > 0 && both[1]->farther_q16 > 0) {
            explain(moved, both, band_q16);
        }
        moved_q16[k] = moved[0];
        moved_q16[k + PAIRS] = moved[1];
    }
}
