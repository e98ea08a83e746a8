/* SPDX-License-Identifier: Apache-2.0 */
/* What all edge points of a region say about an ellipse: how much of its circumference they cover, with which
 * polarity, and how far they lie off it. */
#ifndef DROGUE_SUPPORT_H
#define DROGUE_SUPPORT_H

#include "drogue/quality.h"
#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_SUPPORT_BINS 32 /* equal parts of the eccentric angle, from the major axis's end towards +v */

/* One bin's edge points. */
typedef struct drogue_support_bin {
    uint32_t count[2]; /* by polarity: near the ellipse, gradient along its normal */
    int32_t sum_q16;   /* of (u^2 + v^2 - 1) / 2 over those of the bin's own polarity: radial offsets in semi-axes */
} drogue_support_bin;

/* The edge points about an ellipse, by bins. */
typedef struct drogue_support {
    drogue_support_bin bin[DROGUE_SUPPORT_BINS]; /* round the outline */
    int64_t squares_q32;                         /* of the same offsets, over all bins */
    uint64_t gradient;                           /* sum of |gx| + |gy| over them, grey levels * 8 */
    uint32_t points;                             /* in these sums */
    uint32_t bright_bins; /* bit k: bin k is brighter inside; all 0 or all 1 for an outline of one polarity */
    int32_t pull_q24[5];  /* by how much what lies beside the outline moved it outwards, in semi-axes: 1, cos t, sin t,
                             cos 2t, sin 2t over the eccentric angle t. Half of it remains in doubt; of an outer
                             edge along rays, which is not moved, it is that alone */
    int32_t smear_px2_q16[2]; /* motion blur: variance along the motion less that across it, px^2, times cosine and sine
                                 of twice its angle from +x; less what edges differ by without: 0 where none stands
                                 out */
    uint32_t outside;        /* parts of the outline, of eight, that show another edge outside: drogue_outline_pull() */
    drogue_q16 axis_rad_q16; /* from which the bins count, the angle of the ellipse that they are about */
    uint32_t covered;        /* covered bins, less one for each change of polarity round the outline; at least 0 */
} drogue_support;

/* From the counts, decide the polarity of each bin and how many bins are covered.
 *
 * A bin is covered by 0.35 points and more per pixel of its length (8-connected edges have 0.7 to 1). An outline of
 * one polarity is preferred: a mixed one loses a bin for each change of polarity round it.
 *
 *  stride  every stride-th edge point has been counted, [1, 2^16]
 */
void drogue_support_judge(drogue_support *support, const drogue_ellipse *ellipse, drogue_polarity polarity,
                          uint32_t stride);

/* The same with the bins' polarities given. */
void drogue_support_judge_as(drogue_support *support, const drogue_ellipse *ellipse, uint32_t bright_bins,
                             uint32_t stride);

/* Parts of the outline, of eight, that have a covered bin.
 *
 *  ellipse  about which every edge point has been counted
 */
uint32_t drogue_support_parts(const drogue_support *support, const drogue_ellipse *ellipse);

/* Covered share of the circumference, Q16. */
static inline drogue_q16 drogue_support_cover(const drogue_support *support)
{
    return (drogue_q16)(support->covered * (DROGUE_Q16_ONE / DROGUE_SUPPORT_BINS));
}

/* cos of j / 64 turns, Q30; the middle of bin k is 2 k + 1 of them. */
int32_t drogue_support_cosine(uint32_t j);

/* 1, cos t, sin t, cos 2t, sin 2t in the middle of a bin. */
void drogue_support_basis(int32_t basis_q30[5], uint32_t k);

/* By how many bins an axis is turned against that from which a support counts them, [0, 31]. */
uint32_t drogue_support_bins_to(const drogue_support *support, drogue_q16 axis_rad_q16);

/* Count the bins from another axis, to a whole bin: a fit may have turned a round outline, or an axis past where angles
 * begin anew. */
void drogue_support_turn(drogue_support *support, drogue_q16 axis_rad_q16);

/* How much more an edge is blurred along a motion than across it: length of the smear, px^2; saturates. */
drogue_q16 drogue_support_smear(const drogue_support *support);

/* px^2 of smear: from there on an edge of the rim shows as two, and an inner disc's says nothing of the outline. */
#define DROGUE_SMEARED_Q16 DROGUE_Q16(5, 4)

/* A wave of twice the angle, by its cosine's and its sine's part, with all angles larger by so much, (-4, 4) rad;
 * saturates. */
void drogue_turn_wave(int32_t wave[2], drogue_q16 by_rad_q16);

/* A pull as of an ellipse whose major axis is turned by so much against that it was found on. */
void drogue_turn_pull(int32_t out_q24[5], const int32_t pull_q24[5], drogue_q16 turn_rad_q16);

#ifdef __cplusplus
}
#endif
#endif
