/* SPDX-License-Identifier: Apache-2.0 */
/* Clustering of candidate ellipses: paper (16). */
#include "drogue/cluster.h"

static int within(drogue_q16 i, drogue_q16 j, drogue_q16 threshold)
{
    int64_t d = (int64_t)j - i;
    return (d < 0 ? -d : d) < threshold;
}

/* Rounder than the ratio below which the angle means something? */
static int is_round(const drogue_ellipse *e, drogue_q16 ratio_q16)
{
    return (int64_t)e->b_px_q16 * DROGUE_Q16_ONE > (int64_t)e->a_px_q16 * ratio_q16;
}

int drogue_same_ellipse(const drogue_candidate *i, const drogue_candidate *j, const drogue_cluster_config *config)
{
    const drogue_ellipse *p = &i->ellipse;
    const drogue_ellipse *q = &j->ellipse;
    int64_t dx = (int64_t)q->xc_px_q16 - p->xc_px_q16;
    int64_t dy = (int64_t)q->yc_px_q16 - p->yc_px_q16;
    int64_t turn = (int64_t)q->angle_rad_q16 - p->angle_rad_q16;
    if (i->polarity != j->polarity || !within(p->a_px_q16, q->a_px_q16, config->a_px_q16) ||
        !within(p->b_px_q16, q->b_px_q16, config->b_px_q16) ||
        !within(p->xc_px_q16, q->xc_px_q16, config->centre_px_q16) ||
        !within(p->yc_px_q16, q->yc_px_q16, config->centre_px_q16) ||
        dx * dx + dy * dy >= (int64_t)config->centre_px_q16 * config->centre_px_q16) {
        return 0;
    }
    if (is_round(p, config->round_q16) && is_round(q, config->round_q16)) {
        return 1;
    }
    turn = turn < 0 ? -turn : turn;
    if (turn > DROGUE_Q16_HALF_PI) {
        turn = DROGUE_Q16_PI - turn;
    }
    return turn < config->angle_rad_q16;
}

int32_t drogue_cluster_best(uint32_t *members, const drogue_candidate *candidates, uint32_t count,
                            const drogue_cluster_config *config)
{
    int32_t best = -1;
    uint32_t i;
    uint32_t j;
    *members = 0;
    for (i = 0; i < count; i++) {
        uint32_t like = 0;
        if (best >= 0 && candidates[i].reliability_q16 < candidates[best].reliability_q16) {
            continue;
        }
        for (j = 0; j < count; j++) {
            like += j == i || drogue_same_ellipse(&candidates[i], &candidates[j], config) ? 1u : 0u;
        }
        if (best < 0 || candidates[i].reliability_q16 > candidates[best].reliability_q16 || like > *members) {
            best = (int32_t)i;
            *members = like;
        }
    }
    return best;
}
