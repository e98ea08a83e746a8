/* SPDX-License-Identifier: Apache-2.0 */
/* Digest of a result, member by member. */
#include "digest.h"

#if defined(__x86_64__)
/* A size that differs: members were added or removed. Bring the functions below up to date, then the size. */
#define COVERED(type, bytes) typedef char digest_covers_##type[sizeof(type) == (bytes) ? 1 : -1]
COVERED(drogue_result, 472);
COVERED(drogue_ellipse, 20);
COVERED(drogue_quality, 20);
COVERED(drogue_pose, 32);
COVERED(drogue_inner_part, 20);
#endif

static uint64_t add(uint64_t digest, int64_t value)
{
    uint64_t bits = (uint64_t)value;
    int i;
    for (i = 0; i < 8; i++) {
        digest = (digest ^ ((bits >> (8 * i)) & 0xFFu)) * UINT64_C(0x100000001b3);
    }
    return digest;
}

static uint64_t add_ellipse(uint64_t d, const drogue_ellipse *e)
{
    d = add(add(d, e->xc_px_q16), e->yc_px_q16);
    return add(add(add(d, e->a_px_q16), e->b_px_q16), e->angle_rad_q16);
}

static uint64_t add_quality(uint64_t d, const drogue_quality *q)
{
    d = add(add(d, q->fit_ratio_q16), q->length_ratio_q16);
    return add(add(add(d, q->axis_ratio_q16), q->score_q16), q->reliability_q16);
}

static uint64_t add_inner_part(uint64_t d, const drogue_inner_part *p)
{
    d = add(add(add(d, p->x_px_q16), p->y_px_q16), p->area_px);
    return add(add(add(d, p->spread_px_q16), p->threshold), p->rays);
}

static uint64_t add_pose(uint64_t d, const drogue_pose *p)
{
    int i;
    for (i = 0; i < 3; i++) {
        d = add(d, p->position_m_q16[i]);
    }
    for (i = 0; i < 3; i++) {
        d = add(d, p->axis_q16[i]);
    }
    return add(add(d, p->yaw_rad_q16), p->pitch_rad_q16);
}

uint64_t digest_result(uint64_t d, const drogue_result *r)
{
    int i, k;
    d = add(add(d, (int64_t)r->status), (int64_t)r->second_look);
    d = add(add(add(add(d, r->region.x_px), r->region.y_px), r->region.width_px), r->region.height_px);
    d = add(add(d, r->list.edge_count), r->list.arc_count);
    for (i = 0; i < 4; i++) {
        d = add(d, r->arcs[i]);
    }
    d = add_ellipse(d, &r->ellipse);
    d = add_ellipse(d, &r->ideal);
    d = add_quality(d, &r->quality);
    d = add(add(add(d, (int64_t)r->polarity), r->cluster_members), r->refit_points);
    d = add(add(add(d, r->cover_q16), r->outside), r->has_inner);
    d = add_inner_part(d, &r->inner);
    d = add_pose(d, &r->pose);
    d = add_pose(d, &r->alternative);
    d = add(add(add(d, r->orientation_resolved), r->ambiguity_q16), r->doubt_q16);
    for (i = 0; i < 5; i++) {
        for (k = 0; k < 5; k++) {
            d = add(d, r->covariance_q48[i][k]);
        }
    }
    for (i = 0; i < 3; i++) {
        d = add(d, r->position_std_m_q32[i]);
    }
    return add(add(add(d, r->axis_std_rad_q32), (int64_t)r->tried), r->covariance_halved);
}
