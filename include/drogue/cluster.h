/* SPDX-License-Identifier: Apache-2.0 */
/* Clustering of candidate ellipses and choice of the winner: paper (16). */
#ifndef DROGUE_CLUSTER_H
#define DROGUE_CLUSTER_H

#include "drogue/config.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_MAX_CANDIDATES 25 /* 6 pairs of quadrants with two arcs each, and the first arcs of all quadrants */

/* An ellipse that may be the outline. */
typedef struct drogue_candidate {
    drogue_ellipse ellipse;     /* region coordinates */
    drogue_q16 reliability_q16; /* S_reliable (15), [0, 1] */
    drogue_q16 fit_ratio_q16;   /* what the reliability was computed from: quality.h */
    drogue_q16 cover_q16;       /* covered share of the circumference, [0, 1] */
    uint32_t polarity;          /* candidates of unlike polarity never share a cluster */
    uint32_t arcs;              /* which arcs were fitted */
} drogue_candidate;

/* Do two candidates describe one ellipse (16)? */
int drogue_same_ellipse(const drogue_candidate *i, const drogue_candidate *j, const drogue_cluster_config *config);

/* The most reliable candidate; between equals the one whose cluster has more members, then the first.
 *
 *  members  out, size of the winner's cluster (itself and those that (16) calls the same)
 *  return   index of the winner, or -1 when count is 0
 */
int32_t drogue_cluster_best(uint32_t *members, const drogue_candidate *candidates, uint32_t count,
                            const drogue_cluster_config *config);

#ifdef __cplusplus
}
#endif
#endif
