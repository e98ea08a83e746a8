/* SPDX-License-Identifier: Apache-2.0 */
/* The inner disc by its own edge. */
#include "drogue/inner.h"

#include <string.h>

#include "drogue/cholesky.h"

#define RAYS DROGUE_RAYS
#define BINS (RAYS / 4)
#define FEWEST 8 /* rays that determine place and size with something to spare */

static int32_t clamped(int32_t v, int32_t most) { return v < 0 ? 0 : v > most ? most : v; }

/* Where an offset puts the edge on a ray. */
static drogue_q16 along(const drogue_ray *r, const drogue_q16 v_px_q16[3])
{
    const int64_t shift = (int64_t)r->nx_q14 * v_px_q16[0] + (int64_t)r->ny_q14 * v_px_q16[1];
    return drogue_q16_add(v_px_q16[2], drogue_sat_s32(drogue_shr_round_s64(shift, 14)));
}

/* Index of the edge that an offset is about: the steeper and the nearer the better; -1 when none is within the
 * tolerance. */
static int32_t chosen(const drogue_ray *r, drogue_q16 expected_px_q16, drogue_q16 within_px_q16)
{
    int32_t best = -1;
    int64_t most = 0;
    uint32_t i;
    for (i = 0; i < r->count; i++) {
        const int64_t off = (int64_t)r->edges[i].at_px_q16 - expected_px_q16;
        const int64_t room = within_px_q16 - (off < 0 ? -off : off);
        if (room > 0 && room * r->edges[i].slope_q8 > most) {
            most = room * r->edges[i].slope_q8;
            best = (int32_t)i;
        }
    }
    return best;
}

/* Sums of least squares over rays, each weighted by its squared slope, as noise asks for. */
typedef struct sums {
    int64_t normal[6]; /* Q28 */
    int64_t right[3];  /* Q30 */
    int64_t weight;
    int64_t squares_q16; /* of the residuals, not weighted */
    int64_t slopes_q8;
    int64_t levels_q8;
    uint32_t rays;
    int64_t bin_q16[BINS]; /* weighted residuals of four neighbours, of all phases together: they see one edge */
    int64_t bin_weight[BINS];
} sums;

/* Add the rays that agree with an offset. */
static void add_rays(sums *s, const drogue_ray rays[RAYS], const drogue_q16 v_px_q16[3], drogue_q16 within_px_q16,
                     int by_slope)
{
    int32_t k;
    int i;
    int j;
    for (k = 0; k < RAYS; k++) {
        const drogue_q16 expected = along(&rays[k], v_px_q16);
        const int32_t which = chosen(&rays[k], expected, within_px_q16);
        if (which >= 0) {
            const drogue_ray_edge *e = &rays[k].edges[which];
            const int64_t row[3] = {rays[k].nx_q14, rays[k].ny_q14, 1 << 14};
            const int64_t off = (int64_t)e->at_px_q16 - expected;
            const int64_t grey = clamped(e->slope_q8 / (DROGUE_RAY_WEIGHT * 256), 254) + 1;
            const int64_t weight = by_slope ? grey * grey : 1;
            for (i = 0; i < 3; i++) {
                s->right[i] += row[i] * weight * off;
                for (j = 0; j <= i; j++) {
                    s->normal[DROGUE_PACKED(i, j)] += row[i] * row[j] * weight;
                }
            }
            s->squares_q16 += drogue_shr_round_s64(off * off, 16);
            s->slopes_q8 += e->slope_q8;
            s->levels_q8 += e->level_q8;
            s->rays++;
            s->bin_q16[k / 4] += weight * off;
            s->bin_weight[k / 4] += weight;
        }
    }
}

/* Squared residuals of the bins over their weights; the number of bins that hold rays. */
static int32_t scatter_of(drogue_real *scatter, const sums *s)
{
    int32_t bins = 0;
    int32_t k;
    drogue_real_set(scatter, 0, 0);
    for (k = 0; k < BINS; k++) {
        if (s->bin_weight[k] > 0) {
            drogue_real square;
            drogue_real weight;
            drogue_real_set(&square, s->bin_q16[k], -16);
            drogue_real_product(&square, &square, &square);
            drogue_real_set(&weight, s->bin_weight[k], 0);
            drogue_real_quotient(&square, &square, &weight);
            drogue_real_sum(scatter, scatter, &square);
            bins++;
        }
    }
    return bins;
}

/* Solve for the offset: 'size' 0 leaves the size as it is. 'normal' becomes the root of the normal equations. 0 when there
 * are too few rays. */
static int solve(drogue_q16 v_px_q16[3], drogue_real normal[6], const sums *s, int size)
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

static drogue_q16 larger(drogue_q16 a, drogue_q16 b) { return a > b ? a : b; }

/* From all edges within the gate to those about one place: place alone, then with its size. */
static int settle(sums *s, drogue_q16 v_px_q16[3], const drogue_ray rays[RAYS], drogue_q16 gate_px_q16,
                  drogue_q16 last_px_q16)
{
    drogue_real normal[6];
    drogue_q16 within = gate_px_q16;
    int round;
    memset(v_px_q16, 0, 3 * sizeof v_px_q16[0]);
    for (round = 0; round < 10; round++) {
        memset(s, 0, sizeof *s);
        add_rays(s, rays, v_px_q16, within, 0);
        if (!solve(v_px_q16, normal, s, round > 1)) {
            return 0;
        }
        within = larger(within / 4 * 3, last_px_q16);
    }
    return 1;
}

static drogue_q16 rms_of(const sums *s)
{
    return (drogue_q16)drogue_isqrt_u64((uint64_t)drogue_div_round_s64(s->squares_q16 * DROGUE_Q16_ONE, s->rays));
}

/* Measure about a first place: the band narrows to what agrees, then as many rays as the edge has pixels, at most 512,
 * say where it is. */
static drogue_status measure(drogue_inner_edge *out, drogue_ray rays[RAYS], const drogue_image *image,
                             const drogue_ellipse *e, int32_t least)
{
    drogue_real normal[6];
    drogue_real inverse[6];
    drogue_real scatter;
    drogue_real t;
    drogue_q16 within = DROGUE_Q16(3, 2);
    drogue_q16 v[3] = {0, 0, 0};
    sums s;
    int32_t phases = e->a_px_q16 / DROGUE_Q16(10, 1); /* 2 pi a over 64 */
    int32_t bins;
    int32_t k;
    int round;
    phases = phases < 1 ? 1 : phases > 8 ? 8 : phases;
    drogue_rays_cast(rays, image, e, 0, 4, 0, least);
    for (round = 0; round < 3; round++) {
        drogue_q16 rms;
        memset(&s, 0, sizeof s);
        add_rays(&s, rays, v, within, 0);
        if (!solve(v, normal, &s, 1)) {
            return DROGUE_E_NO_INNER_PART;
        }
        rms = rms_of(&s);
        within = larger(DROGUE_Q16(1, 4), 3 * rms < within ? 3 * rms : within);
    }
    memset(&s, 0, sizeof s);
    for (k = 0; k < phases; k++) {
        drogue_rays_cast(rays, image, e, 0, (8 * k + 4) / phases % 8, 0, least);
        add_rays(&s, rays, v, within, 1);
    }
    bins = scatter_of(&scatter, &s);
    if (!solve(v, normal, &s, 1) || bins < 5) {
        return DROGUE_E_NO_INNER_PART;
    }
    drogue_cholesky_invert(inverse, normal, 3);
    k = drogue_real_order(&inverse[DROGUE_PACKED(0, 0)], &inverse[DROGUE_PACKED(1, 1)]) > 0 ? 0 : 1;
    drogue_real_product(&scatter, &scatter, &inverse[DROGUE_PACKED(k, k)]);
    drogue_real_set(&t, bins - 3, 0);
    drogue_real_quotient(&t, &scatter, &t);
    drogue_real_root(&t, &t);
    out->std_px_q16 = drogue_real_to_q16(t);
    out->rms_px_q16 = rms_of(&s);
    out->x_px_q16 = drogue_q16_add(e->xc_px_q16, v[0]);
    out->y_px_q16 = drogue_q16_add(e->yc_px_q16, v[1]);
    out->grown_px_q16 = v[2];
    out->rays = (s.rays + (uint32_t)phases / 2) / (uint32_t)phases;
    out->contrast =
        (uint8_t)clamped((int32_t)drogue_div_round_s64(s.slopes_q8, (int64_t)s.rays * DROGUE_RAY_WEIGHT * 256), 255);
    out->level = (uint8_t)clamped((int32_t)drogue_div_round_s64(s.levels_q8, (int64_t)s.rays * 256), 255);
    return DROGUE_OK;
}

drogue_status drogue_inner_edge_find(drogue_inner_edge *out, drogue_ray rays[RAYS], const drogue_image *image,
                                     const drogue_inner_expected *expected, const drogue_ellipse *outline,
                                     const drogue_config *config)
{
    const drogue_q16 gate_px_q16 =
        drogue_q16_add(config->inner_gate_px_q16, drogue_q16_mul(config->inner_gate_q16, outline->a_px_q16));
    drogue_q16 best[3] = {0, 0, 0};
    int64_t steepest = 0;
    uint32_t which = 0;
    uint32_t i;
    drogue_ellipse at;
    drogue_status status;
    memset(out, 0, sizeof *out);
    for (i = 0; i < expected->count; i++) { /* bound: 2 */
        const drogue_ellipse *e = &expected->disc[i];
        const drogue_q16 reach = drogue_q16_add(gate_px_q16, drogue_q16_add(e->a_px_q16 / 16, DROGUE_Q16(2, 1)));
        drogue_q16 v[3];
        sums s;
        drogue_rays_cast(rays, image, e, reach, 4, 0, config->min_inner_contrast);
        if (settle(&s, v, rays, drogue_q16_add(gate_px_q16, DROGUE_Q16(1, 1)), larger(DROGUE_Q16(3, 2), reach / 16)) &&
            s.slopes_q8 > steepest) {
            steepest = s.slopes_q8;
            memcpy(best, v, sizeof best);
            which = i;
        }
    }
    if (steepest == 0) {
        return DROGUE_E_NO_INNER_PART;
    }
    at = expected->disc[which];
    at.xc_px_q16 = drogue_q16_add(at.xc_px_q16, best[0]);
    at.yc_px_q16 = drogue_q16_add(at.yc_px_q16, best[1]);
    at.a_px_q16 = drogue_q16_add(at.a_px_q16, best[2]);
    at.b_px_q16 = drogue_q16_add(at.b_px_q16, best[2]);
    if (at.b_px_q16 < DROGUE_Q16_ONE) {
        return DROGUE_E_NO_INNER_PART;
    }
    status = measure(out, rays, image, &at, config->min_inner_contrast);
    if (status != DROGUE_OK) {
        memset(out, 0, sizeof *out);
        return status;
    }
    out->which = which;
    out->grown_px_q16 = drogue_q16_add(out->grown_px_q16, best[2]);
    return DROGUE_OK;
}
