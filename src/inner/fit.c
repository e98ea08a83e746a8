/* SPDX-License-Identifier: Apache-2.0 */
/* Least squares over rays. */
#include "fit.h"

drogue_q16 drogue_ray_along(const drogue_ray *r, const drogue_q16 v_px_q16[3])
{
    const int64_t shift = (int64_t)r->nx_q14 * v_px_q16[0] + (int64_t)r->ny_q14 * v_px_q16[1];
    return drogue_q16_add(v_px_q16[2], drogue_sat_s32(drogue_shr_round_s64(shift, 14)));
}

int32_t drogue_ray_chosen(const drogue_ray *r, drogue_q16 expected_px_q16, drogue_q16 within_px_q16)
{
    int32_t best = -1;
    int64_t most = 0;
    uint32_t i;
    for (i = 0; i < r->count; i++) {
        const int64_t off = (int64_t)r->edges[i].at_px_q16 - expected_px_q16;
        const int64_t room = within_px_q16 - (off < 0 ? -off : off);
        const int64_t merit = room > 0 ? (int64_t)(int32_t)room * r->edges[i].slope_q8 : 0;
        if (merit > most) {
            most = merit;
            best = (int32_t)i;
        }
    }
    return best;
}

void drogue_ray_sums_add(drogue_ray_sums *s, const drogue_ray *r, int32_t weight, int64_t off_q16)
{
    const int32_t row[3] = {r->nx_q14, r->ny_q14, 1 << 14};
    int i;
    int j;
    for (i = 0; i < 3; i++) {
        const int32_t weighted = row[i] * weight; /* < 2^30 + 2^16 */
        s->right[i] += weighted * off_q16;
        for (j = 0; j <= i; j++) {
            s->normal[DROGUE_PACKED(i, j)] += (int64_t)weighted * row[j];
        }
    }
    s->squares_q16 += drogue_shr_round_s64(off_q16 * off_q16, 16);
    s->rays++;
}

void drogue_ray_sums_add_edges(drogue_ray_sums *s, drogue_ray_bins *bins, const drogue_ray rays[RAYS],
                               const drogue_q16 v_px_q16[3], drogue_q16 within_px_q16)
{
    int32_t k;
    for (k = 0; k < RAYS; k++) {
        const drogue_q16 expected = drogue_ray_along(&rays[k], v_px_q16);
        const int32_t which = drogue_ray_chosen(&rays[k], expected, within_px_q16);
        if (which >= 0) {
            const drogue_ray_edge *e = &rays[k].edges[which];
            const int64_t off = (int64_t)e->at_px_q16 - expected;
            const int32_t grey = drogue_clamp_s32(e->slope_q8 / (DROGUE_RAY_WEIGHT * 256), 0, 254) + 1;
            const int32_t weight = bins != NULL ? grey * grey : 1;
            drogue_ray_sums_add(s, &rays[k], weight, off);
            s->slopes_q8 += e->slope_q8;
            s->levels_q8 += e->level_q8;
            if (bins != NULL) {
                bins->off_q16[k / 4] += weight * off;
                bins->weight[k / 4] += weight;
            }
        }
    }
}

int drogue_ray_sums_solve(drogue_q16 v_px_q16[3], drogue_real normal[6], const drogue_ray_sums *s, int size)
{
    drogue_real down[3];
    int i;
    if (s->rays < FEWEST) {
        return 0;
    }
    for (i = 0; i < 6; i++) {
        drogue_real_set(&normal[i], s->normal[i], -28);
    }
    for (i = 0; i < 3; i++) {
        drogue_real_set(&down[i], s->right[i], -30);
    }
    if (drogue_cholesky_factor(normal, size ? 3 : 2) != DROGUE_OK) {
        return 0;
    }
    drogue_cholesky_solve(down, normal, size ? 3 : 2);
    for (i = 0; i < (size ? 3 : 2); i++) {
        v_px_q16[i] = drogue_q16_add(v_px_q16[i], drogue_real_to_q16(down[i]));
    }
    return 1;
}

drogue_q16 drogue_ray_sums_rms(const drogue_ray_sums *s)
{
    return (drogue_q16)drogue_isqrt_u64((uint64_t)drogue_div_round_s64(s->squares_q16 * DROGUE_Q16_ONE, s->rays));
}
