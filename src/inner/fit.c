/* SPDX-License-Identifier: Apache-2.0 */
/* Least squares over rays. */
#include "fit.h"

#include <string.h>

#define LEAST_BINS 5 /* that determine place and size, and show how they scatter */

drogue_q16 drogue_ray_along(const drogue_ray *r, const drogue_q16 v_px_q16[3])
{
    const int64_t shift = drogue_product(r->nx_q14, v_px_q16[0]) + drogue_product(r->ny_q14, v_px_q16[1]);
    return drogue_clamp_2_30(v_px_q16[2] + drogue_shr_round_s64(shift, 14));
}

/* How much an edge is the one that is expected; nothing, not above 0. */
static inline int64_t merit_of(const drogue_ray_edge *e, drogue_q16 expected_px_q16, drogue_q16 within_px_q16)
{
    const int32_t off = e->at_px_q16 - expected_px_q16; /* < 2^26 + 2^30 */
    const int32_t room = within_px_q16 - drogue_abs_s32(off);
    return room > 0 ? drogue_product(room, e->slope_q8) : 0;
}

int32_t drogue_ray_chosen(const drogue_ray *r, drogue_q16 expected_px_q16, drogue_q16 within_px_q16)
{
    int32_t best = -1;
    int64_t most = 0;
    uint32_t i;
    for (i = 0; i < r->count; i++) { /* bound: DROGUE_RAY_EDGES */
        const int64_t merit = merit_of(&r->edges[i], expected_px_q16, within_px_q16);
        if (merit > most) {
            most = merit;
            best = (int32_t)i;
        }
    }
    return best;
}

void drogue_rays_keep(drogue_ray rays[RAYS], const drogue_q16 v_px_q16[3], drogue_q16 above_px_q16,
                      drogue_q16 below_px_q16)
{
    int32_t k;
    for (k = 0; k < RAYS; k++) {
        drogue_ray *r = &rays[k];
        const drogue_q16 from = v_px_q16 != NULL && r->count > 0 ? drogue_ray_along(r, v_px_q16) : 0;
        uint32_t kept = 0;
        uint32_t i;
        for (i = 0; i < r->count; i++) { /* bound: DROGUE_RAY_EDGES */
            const drogue_q16 off = r->edges[i].at_px_q16 - from;
            if (off > above_px_q16 && off < below_px_q16) {
                r->edges[kept++] = r->edges[i];
            }
        }
        r->count = kept;
    }
}

void drogue_ray_sums_add(drogue_ray_sums *s, const drogue_ray *r, int32_t weight, int32_t off_q16)
{
    const int32_t x = r->nx_q14 * weight; /* < 2^30 */
    const int32_t y = r->ny_q14 * weight;
    s->normal[0] += drogue_product(x, r->nx_q14);
    s->normal[1] += drogue_product(y, r->nx_q14);
    s->normal[2] += drogue_product(y, r->ny_q14);
    s->normal[3] += x;
    s->normal[4] += y;
    s->normal[5] += weight;
    s->right[0] += drogue_product(x, off_q16);
    s->right[1] += drogue_product(y, off_q16);
    s->right[2] += drogue_product(weight, off_q16);
    s->squares_q16 += drogue_shr_round_s64(drogue_product(off_q16, off_q16), 16);
    s->rays++;
}

/* A slope above 0 over DROGUE_RAY_WEIGHT 256: by a product, exact below 2^21, and more than 254 beyond that. */
static inline int32_t grey_of(int32_t slope_q8)
{
    const int32_t part_q32 = (int32_t)((INT64_C(1) << 32) / (DROGUE_RAY_WEIGHT * 256)) + 1;
    return (int32_t)(drogue_product(slope_q8, part_q32) >> 32);
}

void drogue_ray_sums_add_edges(drogue_ray_sums *s, drogue_ray_bins *bins, const drogue_ray rays[RAYS],
                               const drogue_q16 v_px_q16[3], drogue_q16 within_px_q16)
{
    int32_t k;
    for (k = 0; k < RAYS; k++) {
        const drogue_ray *r = &rays[k];
        const drogue_q16 expected = r->count > 0 ? drogue_ray_along(r, v_px_q16) : 0;
        const int32_t which = drogue_ray_chosen(r, expected, within_px_q16);
        if (which >= 0) {
            const drogue_ray_edge *e = &r->edges[which];
            const int32_t off_q16 = e->at_px_q16 - expected;
            int32_t weight = 1;
            s->slopes_q8 += e->slope_q8;
            s->levels_q8 += e->level_q8;
            if (bins != NULL) {
                const int32_t bin = k / (RAYS / BINS);
                const int32_t grey = drogue_clamp_s32(grey_of(e->slope_q8), 0, 254) + 1;
                weight = grey * grey;
                bins->off_q16[bin] += drogue_product(weight, off_q16);
                bins->weight[bin] += weight;
            }
            drogue_ray_sums_add(s, r, weight, off_q16);
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
        drogue_real_set(&normal[i], s->normal[i], i < 3 ? -28 : i < 5 ? -14 : 0);
    }
    for (i = 0; i < 3; i++) {
        drogue_real_set(&down[i], s->right[i], i < 2 ? -30 : -16);
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

/* Squared residuals of the bins over their weights; the number of bins that hold rays. */
static int32_t scatter_of(drogue_real *scatter, const drogue_ray_bins *b)
{
    int32_t bins = 0;
    int32_t k;
    drogue_real_set(scatter, 0, 0);
    for (k = 0; k < BINS; k++) {
        if (b->weight[k] > 0) {
            drogue_real square;
            drogue_real weight;
            drogue_real_set(&square, b->off_q16[k], -16);
            drogue_real_product(&square, &square, &square);
            drogue_real_set(&weight, b->weight[k], 0);
            drogue_real_quotient(&square, &square, &weight);
            drogue_real_sum(scatter, scatter, &square);
            bins++;
        }
    }
    return bins;
}

int drogue_ray_sums_place(drogue_q16 v_px_q16[3], drogue_q16 *std_px_q16, const drogue_ray_sums *s,
                          const drogue_ray_bins *bins)
{
    drogue_real normal[6];
    drogue_real scatter;
    drogue_real t;
    const int32_t filled = scatter_of(&scatter, bins);
    int k;
    if (!drogue_ray_sums_solve(v_px_q16, normal, s, 1) || filled < LEAST_BINS) {
        return 0;
    }
    drogue_cholesky_invert(normal, normal, 3);
    k = drogue_real_order(&normal[DROGUE_PACKED(0, 0)], &normal[DROGUE_PACKED(1, 1)]) > 0 ? 0 : 1;
    drogue_real_product(&scatter, &scatter, &normal[DROGUE_PACKED(k, k)]);
    drogue_real_set(&t, filled - 3, 0);
    drogue_real_quotient(&t, &scatter, &t);
    drogue_real_root(&t, &t);
    *std_px_q16 = drogue_real_to_q16(t);
    return 1;
}

int drogue_ray_sums_settle(drogue_ray_sums *s, drogue_q16 v_px_q16[3], const drogue_ray rays[RAYS],
                           drogue_q16 gate_px_q16, drogue_q16 last_px_q16, int size)
{
    drogue_real normal[6];
    drogue_q16 within = gate_px_q16;
    int round;
    for (round = 0; round < 10; round++) {
        const drogue_q16 x = v_px_q16[0];
        const drogue_q16 y = v_px_q16[1];
        const drogue_q16 grown = v_px_q16[2];
        const drogue_q16 before = within;
        memset(s, 0, sizeof *s);
        drogue_ray_sums_add_edges(s, NULL, rays, v_px_q16, within);
        if (!drogue_ray_sums_solve(v_px_q16, normal, s, size && round > 1)) {
            return 0;
        }
        within = larger((within >> 2) * 3, last_px_q16); /* none is below 0 */
        if (round > 1 && within == before && v_px_q16[0] == x && v_px_q16[1] == y && v_px_q16[2] == grown) {
            break; /* and so it stays */
        }
    }
    return 1;
}

drogue_q16 drogue_ray_sums_rms(const drogue_ray_sums *s)
{
    return (drogue_q16)drogue_isqrt_u64((uint64_t)drogue_div_round_s64(s->squares_q16 * DROGUE_Q16_ONE, s->rays));
}
