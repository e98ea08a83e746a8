/* SPDX-License-Identifier: Apache-2.0 */
/* The inner disc by its own edge. */
#include "drogue/inner.h"

#include <string.h>

#include "drogue/cholesky.h"

#define RAYS DROGUE_RAYS
#define BINS (RAYS / 4)
#define FEWEST 8 /* rays that determine place and size with something to spare */

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
    int64_t normal[6];   /* Q28 */
    int64_t right[3];    /* Q30 */
    int64_t squares_q16; /* of the residuals, not weighted */
    int64_t slopes_q8;
    int64_t levels_q8;
    uint32_t rays;
    int64_t bin_q16[BINS]; /* weighted residuals of four neighbours, of all phases together: they see one edge */
    int64_t bin_weight[BINS];
} sums;

/* Add what a ray says, 'off' from what is known. */
static void add_ray(sums *s, const drogue_ray *r, int64_t weight, int64_t off_q16)
{
    const int64_t row[3] = {r->nx_q14, r->ny_q14, 1 << 14};
    int i;
    int j;
    for (i = 0; i < 3; i++) {
        s->right[i] += row[i] * weight * off_q16;
        for (j = 0; j <= i; j++) {
            s->normal[DROGUE_PACKED(i, j)] += row[i] * row[j] * weight;
        }
    }
    s->squares_q16 += drogue_shr_round_s64(off_q16 * off_q16, 16);
    s->rays++;
}

/* Add the edges that agree with an offset. */
static void add_rays(sums *s, const drogue_ray rays[RAYS], const drogue_q16 v_px_q16[3], drogue_q16 within_px_q16,
                     int by_slope)
{
    int32_t k;
    for (k = 0; k < RAYS; k++) {
        const drogue_q16 expected = along(&rays[k], v_px_q16);
        const int32_t which = chosen(&rays[k], expected, within_px_q16);
        if (which >= 0) {
            const drogue_ray_edge *e = &rays[k].edges[which];
            const int64_t off = (int64_t)e->at_px_q16 - expected;
            const int64_t grey = drogue_clamp_s32(e->slope_q8 / (DROGUE_RAY_WEIGHT * 256), 0, 254) + 1;
            const int64_t weight = by_slope ? grey * grey : 1;
            add_ray(s, &rays[k], weight, off);
            s->slopes_q8 += e->slope_q8;
            s->levels_q8 += e->level_q8;
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

/* The band narrows to what agrees. */
static int narrow(sums *s, drogue_q16 v_px_q16[3], drogue_q16 *within_px_q16, const drogue_ray rays[RAYS])
{
    drogue_real normal[6];
    int round;
    for (round = 0; round < 3; round++) {
        drogue_q16 rms;
        memset(s, 0, sizeof *s);
        add_rays(s, rays, v_px_q16, *within_px_q16, 0);
        if (!solve(v_px_q16, normal, s, 1)) {
            return 0;
        }
        rms = rms_of(s);
        *within_px_q16 = larger(DROGUE_Q16(1, 4), 3 * rms < *within_px_q16 ? 3 * rms : *within_px_q16);
    }
    return 1;
}

/* The disc is dark all over, what surrounds it need not be of one grey: light, ribs and a ring about it move the steepest
 * place of a blurred edge, and hardly the one where the grey begins to rise. So the edge is looked for where the grey is
 * a quarter of the usual step above the disc's own. */
#define PROFILE 13                 /* samples along a ray, half a pixel apart, */
#define FROM DROGUE_Q16(-35, 10)   /* px from the edge outwards */
#define DARK 4                     /* of them within the disc */
#define FIRST 3                    /* may be the last one below the level, */
#define LAST 9                     /* up to this one; the last of all is beyond the edge */
#define INWARD DROGUE_Q16(45, 100) /* px: a quarter of a blurred step is this far within its middle */
#define STILL DROGUE_Q16(2, 1)     /* grey levels by which the disc may differ from itself */
#define SIGNIFICANT 50             /* variances of a change of grey across the disc */

/* Where a profile about an edge begins: at a multiple of the distance of its samples, so that it does not tremble with the
 * edge's last bits. */
static drogue_q16 begin_of(drogue_q16 at_px_q16) { return drogue_q16_add(at_px_q16, FROM) & ~(DROGUE_Q16_ONE / 2 - 1); }

/* Grey between two samples, Q16; 'part' Q15. */
static int32_t between_q16(int32_t a_q8, int32_t b_q8, int32_t part_q15)
{
    return a_q8 * 256 + (int32_t)drogue_shr_round_s64((int64_t)(b_q8 - a_q8) * part_q15, 7);
}

typedef struct shade {
    drogue_q16 dark_q16[3]; /* grey of the disc at its edge: change along x and y, mean */
    int32_t rise_q16;       /* to the level looked for */
} shade;

static int32_t median_of(int32_t *v, uint32_t count)
{
    uint32_t i;
    for (i = 1; i < count; i++) {
        const int32_t moved = v[i];
        uint32_t at = i;
        for (; at > 0 && v[at - 1] > moved; at--) {
            v[at] = v[at - 1];
        }
        v[at] = moved;
    }
    return v[count / 2];
}

/* Grey of the disc along its edge as a plane, of the rays that fit it; a change across it must stand out of the noise. */
static int fit_dark(drogue_q16 plane_q16[3], const drogue_ray rays[RAYS], const int32_t dark_q16[RAYS])
{
    drogue_real normal[6];
    drogue_q16 within = DROGUE_Q16(256, 1);
    int64_t change2;
    int64_t noise2;
    sums s;
    int round;
    int i;
    memset(plane_q16, 0, 3 * sizeof plane_q16[0]);
    for (round = 0; round < 4; round++) {
        int32_t k;
        memset(&s, 0, sizeof s);
        for (k = 0; k < RAYS; k++) {
            const int64_t off = (int64_t)dark_q16[k] - along(&rays[k], plane_q16);
            if (dark_q16[k] >= 0 && off <= within && off >= -within) {
                add_ray(&s, &rays[k], 1, off);
            }
        }
        if (!solve(plane_q16, normal, &s, 1)) {
            return 0;
        }
        within = larger(STILL, 2 * rms_of(&s));
    }
    change2 = (int64_t)drogue_square_sum(plane_q16[0], plane_q16[1]) >> 16;
    noise2 = drogue_div_round_s64(s.squares_q16 * SIGNIFICANT, (int64_t)s.rays * s.rays);
    for (i = 0; i < 2 && change2 + noise2 > 0; i++) {
        const drogue_q16 kept = (drogue_q16)drogue_div_round_s64(plane_q16[i] * change2, change2 + noise2);
        plane_q16[i] = kept;
    }
    return 1;
}

/* Greys about the edge on the rays that agree. */
static int find_shade(shade *out, const drogue_ray rays[RAYS], const drogue_image *image, const drogue_q16 v_px_q16[3],
                      drogue_q16 within_px_q16)
{
    int32_t dark_q16[RAYS];
    int32_t beyond_q16[RAYS];
    int32_t sorted[RAYS];
    uint32_t count = 0;
    int32_t k;
    for (k = 0; k < RAYS; k++) {
        const drogue_q16 at = along(&rays[k], v_px_q16);
        dark_q16[k] = -1;
        if (chosen(&rays[k], at, within_px_q16) >= 0) {
            const int32_t part_q15 = drogue_q16_sub(drogue_q16_add(at, FROM), begin_of(at));
            int32_t grey_q8[PROFILE];
            int32_t i;
            drogue_ray_read(grey_q8, &rays[k], image, begin_of(at), PROFILE);
            dark_q16[k] = between_q16(grey_q8[0], grey_q8[DARK], part_q15) / DARK;
            for (i = 1; i < DARK; i++) {
                dark_q16[k] += grey_q8[i] * (256 / DARK);
            }
            beyond_q16[k] = between_q16(grey_q8[PROFILE - 2], grey_q8[PROFILE - 1], part_q15);
        }
    }
    if (!fit_dark(out->dark_q16, rays, dark_q16)) {
        return 0;
    }
    for (k = 0; k < RAYS; k++) {
        if (dark_q16[k] >= 0) {
            sorted[count++] = beyond_q16[k] - along(&rays[k], out->dark_q16);
        }
    }
    out->rise_q16 = median_of(sorted, count) / 4;
    return out->rise_q16 > 0;
}

/* Where the grey passes the level, as the rays' edges. */
static void cross(drogue_ray rays[RAYS], const drogue_image *image, const shade *grey, const drogue_q16 v_px_q16[3])
{
    int32_t k;
    for (k = 0; k < RAYS; k++) {
        drogue_ray *r = &rays[k];
        const drogue_q16 from = begin_of(along(r, v_px_q16));
        const int32_t level_q16 = along(r, grey->dark_q16) + grey->rise_q16;
        int32_t grey_q8[PROFILE];
        int32_t i;
        drogue_ray_read(grey_q8, r, image, from, PROFILE);
        r->count = 0;
        for (i = FIRST; i <= LAST; i++) {
            const int32_t below_q16 = level_q16 - grey_q8[i] * 256;
            if (below_q16 > 0 && grey_q8[i + 1] * 256 >= level_q16 && r->count < DROGUE_RAY_EDGES) {
                drogue_ray_edge *e = &r->edges[r->count++];
                const int32_t step_q8 = grey_q8[i + 1] - grey_q8[i];
                const int32_t part_q16 = (int32_t)drogue_div_round_s64((int64_t)below_q16 * 128, step_q8);
                e->at_px_q16 = drogue_q16_add(drogue_q16_add(from, 32768 * i), part_q16);
                e->slope_q8 = DROGUE_RAY_WEIGHT * 2 * step_q8;
                e->level_q8 = grey_q8[i];
            }
        }
    }
}

/* Measure about a first place: which rays see the edge, and how large it is, by its steepest place; where it is, by as many
 * rays as it has pixels, at most 512. */
static drogue_status measure(drogue_inner_edge *out, drogue_ray rays[RAYS], const drogue_image *image,
                             const drogue_ellipse *e, int32_t least)
{
    drogue_real normal[6];
    drogue_real inverse[6];
    drogue_real scatter;
    drogue_real t;
    drogue_q16 within = DROGUE_Q16(3, 2);
    drogue_q16 v[3] = {0, 0, 0};
    drogue_q16 size;
    shade grey;
    sums s;
    int32_t phases = e->a_px_q16 / DROGUE_Q16(10, 1); /* 2 pi a over 64 */
    int32_t bins;
    int32_t k;
    phases = drogue_clamp_s32(phases, 1, 8);
    drogue_rays_cast(rays, image, e, 0, 4, least);
    if (!narrow(&s, v, &within, rays) || !find_shade(&grey, rays, image, v, within)) {
        return DROGUE_E_NO_INNER_PART;
    }
    out->contrast = (uint8_t)drogue_clamp_s32(
        (int32_t)drogue_div_round_s64(s.slopes_q8, (int64_t)s.rays * DROGUE_RAY_WEIGHT * 256), 0, 255);
    out->level = (uint8_t)drogue_clamp_s32((int32_t)drogue_div_round_s64(s.levels_q8, (int64_t)s.rays * 256), 0, 255);
    cross(rays, image, &grey, v);
    within = DROGUE_Q16(3, 2);
    size = v[2];
    if (!narrow(&s, v, &within, rays)) {
        return DROGUE_E_NO_INNER_PART;
    }
    memset(&s, 0, sizeof s);
    for (k = 0; k < phases; k++) {
        const drogue_q16 about[3] = {v[0], v[1], size};
        drogue_rays_aim(rays, e, (8 * k + 4) / phases % 8);
        cross(rays, image, &grey, about);
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
    out->rays = (s.rays + (uint32_t)phases / 2) / (uint32_t)phases;
    out->grown_px_q16 = drogue_q16_add(v[2], INWARD);
    out->x_px_q16 = drogue_q16_add(e->xc_px_q16, v[0]);
    out->y_px_q16 = drogue_q16_add(e->yc_px_q16, v[1]);
    return DROGUE_OK;
}

static uint64_t away2_q32(const drogue_inner_edge *edge, const drogue_ellipse *e)
{
    return drogue_square_sum(drogue_q16_sub(edge->x_px_q16, e->xc_px_q16),
                             drogue_q16_sub(edge->y_px_q16, e->yc_px_q16));
}

/* An edge may be reached from both expected discs: the nearer one is what it is compared with. */
static void name_nearer(drogue_inner_edge *edge, const drogue_inner_expected *expected)
{
    const drogue_ellipse *was = &expected->disc[edge->which];
    uint32_t i;
    for (i = 0; i < expected->count; i++) { /* bound: 2 */
        const drogue_ellipse *e = &expected->disc[i];
        if (away2_q32(edge, e) < away2_q32(edge, &expected->disc[edge->which])) {
            edge->which = i;
        }
    }
    edge->grown_px_q16 =
        drogue_q16_add(edge->grown_px_q16, drogue_q16_sub(was->a_px_q16, expected->disc[edge->which].a_px_q16));
}

/* Rounded to 1/256 px, in which rays read the image: a first place's last bits need not move them. */
static drogue_q16 whole(drogue_q16 v_px_q16) { return drogue_q16_add(v_px_q16, 128) & ~255; }

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
        drogue_rays_cast(rays, image, e, reach, 4, config->min_inner_contrast);
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
    best[0] = whole(drogue_q16_add(expected->disc[which].xc_px_q16, best[0]));
    best[1] = whole(drogue_q16_add(expected->disc[which].yc_px_q16, best[1]));
    best[2] = whole(best[2]);
    at = expected->disc[which];
    at.xc_px_q16 = best[0];
    at.yc_px_q16 = best[1];
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
    out->grown_px_q16 = drogue_q16_add(out->grown_px_q16, best[2]);
    out->which = which;
    name_nearer(out, expected);
    return DROGUE_OK;
}
