/* SPDX-License-Identifier: Apache-2.0 */
/* Slopes across an edge: where it is seen, where it is when sharpened, how wide it is. */
#include "slopes.h"

#include "vertex.h"

#define MIDDLE DROGUE_SLOPE_MIDDLE
#define SLOPES DROGUE_SLOPES
#define NEAR DROGUE_SLOPE_NEAR
#define ONE_Q20 (1 << 20)
#define FAR (12 * (ONE_Q20 / 5)) /* slopes: so far from there, 1.2 px, lies the sharpened one */
#define OUTSIDE (MIDDLE + 5)     /* slopes from there on are of what is behind the drogue */
#define OUTSIDES 4               /* of them, whose differences show noise */
#define NOISY_Q24 (1 << 26)      /* px: more noise is not told apart */
#define NOISE_Q24 (25 << 20)     /* px, 25/16: 0.9 times the root of 3 */
#define WIDEST_Q12 (16 << 12)    /* px */
#define TAPS 7
#define OWN 3                       /* slopes about the ellipse that may be of its own edge */
#define BESIDE 2                    /* slopes from there on another edge may lie outside, */
#define LEAST_OUTSIDE (3 * 8 * 256) /* more than so steep, */
#define SHARE_OUTSIDE 6             /* and than this part of its own */

/* As the front end blurs: variance 1.33 px^2, 1 of its smoothing and 1/3 of Sobel's operator. */
static int32_t blurred(const int32_t slope[SLOPES], int32_t i)
{
    static const int32_t tap_q7[TAPS] = {117, 88, 55, 28, 12, 4, 1};
    int32_t sum = slope[i] * 128;
    int32_t k;
    for (k = 0; k < TAPS; k++) {
        sum += tap_q7[k] * (slope[i - 1 - k] + slope[i + 1 + k]);
    }
    return sum;
}

static void see(int32_t seen[SLOPES], const int32_t slope[SLOPES])
{
    int32_t i;
    seen[0] = 0; /* what a peak is to be higher than */
    for (i = DROGUE_SLOPE_FIRST; i <= DROGUE_SLOPE_LAST; i++) {
        seen[i] = blurred(slope, i);
    }
}

/* Less a quarter of the second difference, times 4: what blur of half a pixel took. */
static int32_t sharpened(const int32_t slope[SLOPES], int32_t i) { return 6 * slope[i] - slope[i - 2] - slope[i + 2]; }

/* The highest peak of a curve within [from, to]; 0 when there is none. */
static int32_t find_peak(const int32_t curve[SLOPES], int32_t from, int32_t to)
{
    int32_t best = 0;
    int32_t i;
    for (i = from; i <= to; i++) {
        if (curve[i] > curve[best] && curve[i] > curve[i - 1] && curve[i] >= curve[i + 1]) {
            best = i;
        }
    }
    return best;
}

/* The vertex of the parabola through a peak and the values so many slopes from it, Q20; there is one. */
static int32_t vertex_q20(const int32_t curve[SLOPES], int32_t at, int32_t apart)
{
    return at * ONE_Q20 + drogue_vertex(curve[at - apart], curve[at], curve[at + apart], apart * (ONE_Q20 / 2));
}

/* Where the front end sees a peak that is at 'at_q20': by gradients a pixel to either side, or along diagonals 1.4 of
 * them, which where a peak is skew is a quarter farther. */
static int32_t as_seen_q20(const int32_t seen[SLOPES], int32_t best, int32_t at_q20)
{
    int32_t wide_q20;
    if (seen[best] <= seen[best - 2] || seen[best] < seen[best + 2]) {
        return at_q20;
    }
    wide_q20 = vertex_q20(seen, best, 2);
    return wide_q20 + (wide_q20 - at_q20) / 4;
}

/* Standard deviation by noise of a sharpened peak's place, px Q24, from its bend and how slopes differ outside. White
 * noise gives 0.9 px of the root of their squares over the bend. Three times that variance is taken: most outlines are
 * moved by less than noise would. */
static int32_t noise_q24(const int32_t slope[SLOPES], int32_t bend)
{
    uint64_t squares = 0;
    int64_t noise;
    int half;
    int32_t i;
    for (i = OUTSIDE; i < OUTSIDE + OUTSIDES; i++) {
        squares += drogue_square_sum(slope[i + 2] - slope[i], 0);
    }
    half = drogue_clz_u64(squares | 1u) / 2; /* the root to 32 bits, below 2^21 before */
    noise = drogue_isqrt_u64(squares << (2 * half)) * (int64_t)NOISE_Q24;
    noise = drogue_div_round_s64(noise, (int64_t)bend << half);
    return noise < NOISY_Q24 ? (int32_t)noise : NOISY_Q24;
}

int drogue_edge_outside(const int32_t slope[SLOPES])
{
    int32_t own = 0;
    int32_t i;
    for (i = MIDDLE - OWN; i <= MIDDLE + OWN; i++) {
        own = drogue_abs_s32(slope[i]) > own ? drogue_abs_s32(slope[i]) : own;
    }
    for (i = MIDDLE + BESIDE; i < SLOPES - 1; i++) {
        const int32_t size = drogue_abs_s32(slope[i]);
        if (size > LEAST_OUTSIDE && SHARE_OUTSIDE * size > own && size > drogue_abs_s32(slope[i - 1]) &&
            size >= drogue_abs_s32(slope[i + 1])) {
            return 1;
        }
    }
    return 0;
}

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

void drogue_see_edge(drogue_seen_edge *edge, const int32_t slope[SLOPES])
{
    int32_t seen[SLOPES];
    int32_t best;
    see(seen, slope);
    best = find_peak(seen, MIDDLE - NEAR, MIDDLE + NEAR);
    edge->at_q20 = 0;
    edge->seen_q20 = 0;
    if (best > 0) {
        edge->at_q20 = vertex_q20(seen, best, 1);
        edge->seen_q20 = as_seen_q20(seen, best, edge->at_q20);
    }
    edge->variance_px2_q16 = drogue_edge_variance(slope, seen);
}

int32_t drogue_edge_moved(int32_t *noise_px_q24, const int32_t slope[SLOPES], const drogue_seen_edge *edge)
{
    const int32_t at_q20 = edge->at_q20;
    int32_t curve[SLOPES];
    int32_t is;
    int32_t from;
    int32_t to;
    int32_t i;
    *noise_px_q24 = 0;
    if (at_q20 == 0) {
        return 0;
    }
    curve[0] = 0; /* what a peak is to be higher than */
    from = (at_q20 - FAR) >> 20;
    to = (at_q20 + FAR + ONE_Q20 - 1) >> 20;
    for (i = from - 1; i <= to + 1; i++) {
        curve[i] = sharpened(slope, i);
    }
    is = find_peak(curve, from, to);
    if (is == 0) {
        return 0;
    }
    *noise_px_q24 = noise_q24(slope, 2 * curve[is] - curve[is - 1] - curve[is + 1]);
    return edge->seen_q20 - vertex_q20(curve, is, 1);
}
