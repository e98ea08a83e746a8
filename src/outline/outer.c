/* SPDX-License-Identifier: Apache-2.0 */
/* The rim's outer edge. Where the rim is a band of another grey, or its lip is lit, edge points may be those of its
 * inner edge, on one side or all about: an outline that is too small. */
#include <string.h>

#include "drogue/outline.h"
#include "harmonics.h"
#include "vertex.h"

#define BINS DROGUE_SUPPORT_BINS
#define IN_BIN 4                   /* rays, of which two lie in its neighbours */
#define WITHIN 5                   /* samples of a ray within the outline */
#define SAMPLES 18                 /* of a ray */
#define SLOPES (SAMPLES - 2)       /* the first lies four steps within the outline */
#define OWN 6                      /* as far as this slope, a pixel outside at first, an edge is the outline's own */
#define APART 2                    /* slopes between two edges */
#define FAR (OWN + APART)          /* the outline's own edge tells nothing of noise from there on */
#define WAVES 5                    /* of an outline: size, shift, shape */
#define EDGES 4                    /* of a bin, the steepest */
#define NARROW DROGUE_Q16(1, 2)    /* px: a step; then where that shows none, */
#define STEPS 200                  /* this part of a large semi-axis, */
#define WIDEST DROGUE_Q16(9, 1)    /* at most */
#define LEAST_PX DROGUE_Q16(16, 1) /* of a smaller b edges lie too near to each other */
#define LEAST_Q8 (5 * 256)         /* grey levels of a slope, */
#define SHARE 5                    /* no less than this part of what the outline's own edge has */
#define STARTS 6                   /* ellipses that are larger by none to five pixels, from which one is sought */
#define ROUNDS 16
#define NEAR_ROUNDS 14
#define WIDE_ROUNDS 6              /* of them: an edge belongs to the ellipse */
#define OUTSIDE_PX DROGUE_Q16_ONE  /* px: from there on an edge lies outside */
#define WIDE_PX DROGUE_Q16(2, 1)   /* px: where it is as near, later within a pixel, */
#define ON_IT_PX DROGUE_Q16(6, 10) /* and in the end as near as this */
#define AGREE 22                   /* least bins that agree then */
#define A_BIN_PX DROGUE_Q16(1, 4)  /* px of size that one more of them is worth */
#define OFF_PX DROGUE_Q16(7, 10)   /* px: where it is farther than this from the outline, half of them, */
#define OFF 6                      /* of so many at least */
#define PARTS 8                    /* of b: an outer edge is no farther off than one of them */
#define GROWN_PX DROGUE_Q16(3, 10) /* and px by which the ellipse is larger */
#define OF_RAY 5                   /* samples of one ray about a bin's edge */

/* Edges in a bin of an outline, steepest first. */
typedef struct outer_bin {
    drogue_q16 at_px_q16[EDGES];
    uint16_t slope_q8[EDGES]; /* 0: there is none */
} outer_bin;

/* What is seen, and the waves that an ellipse is made of. */
typedef struct outer_sight {
    outer_bin bins[BINS];
    int16_t basis_q14[BINS][WAVES];
    int32_t least_q8; /* slope of an edge */
} outer_sight;

/* Grey along two rays, of a bin and the one before, their sum. */
static void read_pair(int32_t sum_q8[SAMPLES], drogue_ray rays[DROGUE_RAYS], int32_t bin, const drogue_image *view,
                      drogue_q16 step_px_q16)
{
    int32_t grey_q8[2][SAMPLES];
    int32_t i;
    for (i = 0; i < 2; i++) {
        drogue_ray *r = &rays[(2 * bin + i + DROGUE_RAYS - 1) % DROGUE_RAYS];
        r->step_px_q16 = step_px_q16;
        drogue_ray_read(grey_q8[i], r, view, -WITHIN * step_px_q16, SAMPLES);
    }
    for (i = 0; i < SAMPLES; i++) {
        sum_q8[i] = grey_q8[0][i] + grey_q8[1][i];
    }
}

/* Keep an edge where it is one of the steepest. */
static void keep(outer_bin *bin, const int32_t slope[SLOPES], int32_t i, drogue_q16 step_px_q16)
{
    const drogue_q16 part = drogue_vertex(slope[i - 1], slope[i], slope[i + 1], DROGUE_Q16_ONE / 2);
    const int64_t at = (int64_t)(i + 1 - WITHIN) * DROGUE_Q16_ONE + part; /* steps */
    int32_t k = EDGES - 1;
    if (slope[i] <= bin->slope_q8[k]) {
        return;
    }
    for (; k > 0 && bin->slope_q8[k - 1] < slope[i]; k--) {
        bin->at_px_q16[k] = bin->at_px_q16[k - 1];
        bin->slope_q8[k] = bin->slope_q8[k - 1];
    }
    bin->at_px_q16[k] = (drogue_q16)drogue_shr_round_s64(at * step_px_q16, 16);
    bin->slope_q8[k] = (uint16_t)slope[i];
}

/* Does a peak stand out by an eighth from what lies between it and a higher one? Noise and grain make several of a wide
 * edge's one. */
static int stands_out(const int32_t slope[SLOPES], int32_t at)
{
    int32_t step;
    for (step = -1; step <= 1; step += 2) {
        int32_t least = slope[at];
        int32_t i = at + step;
        while (i >= 0 && i < SLOPES && slope[i] <= slope[at]) { /* bound: SLOPES */
            least = slope[i] < least ? slope[i] : least;
            i += step;
        }
        if (i >= 0 && i < SLOPES && 8 * least > 7 * slope[at]) {
            return 0;
        }
    }
    return 1;
}

/* The peaks of a bin's slopes, of either sign. Returns the slopes' sum far outside but for the steepest, and
 * counts them; adds the steepest within. */
static int32_t see_bin(outer_bin *bin, int32_t *own, int32_t *count, const int32_t one[SAMPLES],
                       const int32_t other[SAMPLES], drogue_q16 step_px_q16)
{
    int32_t slope[SLOPES];
    int32_t sum = 0;
    int32_t within = 0; /* the steepest there */
    int32_t outer = 0;  /* where the steepest is */
    int32_t i;
    memset(bin, 0, sizeof *bin);
    for (i = 0; i < SLOPES; i++) {
        slope[i] = drogue_abs_s32(one[i + 2] + other[i + 2] - one[i] - other[i]) / IN_BIN;
    }
    for (i = 1; i < SLOPES - 1; i++) {
        if (slope[i] > slope[i - 1] && slope[i] >= slope[i + 1] && stands_out(slope, i)) {
            keep(bin, slope, i, step_px_q16);
            if (i <= OWN) {
                within = slope[i] > within ? slope[i] : within;
            } else if (outer == 0 || slope[i] > slope[outer]) {
                outer = i;
            }
        }
    }
    *own += within;
    for (i = FAR; i < SLOPES; i++) {
        if (drogue_abs_s32(i - outer) > APART) {
            sum += slope[i];
            (*count)++;
        }
    }
    return sum;
}

/* See all bins. The least slope that is an edge: of noise and texture there is half as much again. */
static void see(outer_sight *s, drogue_ray rays[DROGUE_RAYS], const drogue_image *view, drogue_q16 step_px_q16)
{
    int32_t grey_q8[2][SAMPLES];
    int32_t own = 0;
    int32_t outside = 0;
    int32_t least = LEAST_Q8;
    int32_t share;
    int32_t count = 0; /* of them there are three in each bin and more */
    int32_t noise;
    uint32_t k;
    int i;
    read_pair(grey_q8[0], rays, 0, view, step_px_q16);
    for (k = 0; k < BINS; k++) {
        int32_t basis_q30[WAVES];
        drogue_support_basis(basis_q30, k);
        for (i = 0; i < WAVES; i++) {
            s->basis_q14[k][i] = (int16_t)drogue_shr_round_s64(basis_q30[i], 16);
        }
        read_pair(grey_q8[1 - k % 2], rays, ((int32_t)k + 1) % BINS, view, step_px_q16);
        outside += see_bin(&s->bins[k], &own, &count, grey_q8[0], grey_q8[1], step_px_q16);
    }
    share = own / (BINS * SHARE);
    noise = 3 * outside / (2 * count);
    least = least > share ? least : share;
    s->least_q8 = least > noise ? least : noise;
}

/* Of a bin the steepest edge outside; EDGES where there is none. */
static int32_t steepest(const outer_bin *bin, int32_t least_q8)
{
    int32_t i = 0;
    while (i < EDGES && (bin->slope_q8[i] < least_q8 || bin->at_px_q16[i] <= OUTSIDE_PX)) { /* bound: EDGES */
        i++;
    }
    return i;
}

/* Of a bin the edge that is nearest to a place; EDGES where none is within so much. */
static int32_t nearest(const outer_bin *bin, drogue_q16 at_px_q16, drogue_q16 within_px_q16, int32_t least_q8)
{
    int32_t best = EDGES;
    int32_t i;
    for (i = 0; i < EDGES && bin->slope_q8[i] >= least_q8; i++) {
        const int32_t off = drogue_abs_s32(bin->at_px_q16[i] - at_px_q16);
        if (off < within_px_q16) {
            within_px_q16 = off;
            best = i;
        }
    }
    return best;
}

/* Where an ellipse passes a bin that is larger by v[0], shifted by v[1] and v[2] along the axes and longer by v[3] and
 * v[4] along the major one and a diagonal. */
static int32_t at_bin(const drogue_q16 v_px_q16[WAVES], const int16_t basis_q14[WAVES])
{
    int64_t sum_q30 = 0;
    int i;
    for (i = 0; i < WAVES; i++) {
        sum_q30 += drogue_product(v_px_q16[i], basis_q14[i]);
    }
    return (int32_t)drogue_shr_round_s64(sum_q30, 14);
}

/* The ellipse of least squares over the bins' edges that are nearest to it; within 0: over the steepest ones outside.
 * Where there is none it passes as it did. */
static void fit(drogue_q16 v_px_q16[WAVES], const outer_sight *s, drogue_q16 within_px_q16)
{
    int64_t sum_q30[WAVES] = {0, 0, 0, 0, 0};
    int32_t k;
    int i;
    for (k = 0; k < BINS; k++) {
        const outer_bin *bin = &s->bins[k];
        drogue_q16 at_px_q16 = at_bin(v_px_q16, s->basis_q14[k]);
        const int32_t edge =
            within_px_q16 == 0 ? steepest(bin, s->least_q8) : nearest(bin, at_px_q16, within_px_q16, s->least_q8);
        if (edge < EDGES) {
            at_px_q16 = bin->at_px_q16[edge];
        }
        for (i = 0; i < WAVES; i++) {
            sum_q30[i] += drogue_product(at_px_q16, s->basis_q14[k][i]);
        }
    }
    for (i = 0; i < WAVES; i++) {
        v_px_q16[i] = (int32_t)drogue_shr_round_s64(sum_q30[i], i > 0 ? 18 : 19);
    }
}

/* Bins whose edges an ellipse passes; 0 where those that it passes off the outline are too few. */
static int32_t agreeing(const drogue_q16 v_px_q16[WAVES], const outer_sight *s)
{
    int32_t agree = 0;
    int32_t off = 0;
    int32_t off_agree = 0;
    int32_t k;
    for (k = 0; k < BINS; k++) {
        const drogue_q16 at_px_q16 = at_bin(v_px_q16, s->basis_q14[k]);
        if (nearest(&s->bins[k], at_px_q16, ON_IT_PX, s->least_q8) < EDGES) {
            agree++;
            off_agree += drogue_abs_s32(at_px_q16) > OFF_PX;
        }
        off += drogue_abs_s32(at_px_q16) > OFF_PX;
    }
    return off >= OFF && 2 * off_agree >= off ? agree : 0;
}

/* Is it larger, and no wave farther off than it may be? */
static int is_larger(const drogue_q16 v_px_q16[WAVES], drogue_q16 most_px_q16)
{
    int i;
    for (i = 0; i < WAVES; i++) {
        if (drogue_abs_s32(v_px_q16[i]) > most_px_q16) {
            return 0;
        }
    }
    return v_px_q16[0] >= GROWN_PX;
}

/* From ellipses that are larger, and one over the steepest edges outside, the one on which most bins agree: one more
 * of them for a quarter of a pixel of size. 0: there is none. */
static int seek(drogue_q16 best_px_q16[WAVES], const outer_sight *s, drogue_q16 most_px_q16)
{
    int32_t best = 0;
    int32_t start;
    int i;
    for (start = -1; start < STARTS; start++) {
        drogue_q16 v_px_q16[WAVES] = {0, 0, 0, 0, 0};
        int32_t agree;
        if (start < 0) {
            fit(v_px_q16, s, 0);
        } else {
            v_px_q16[0] = start * DROGUE_Q16_ONE;
        }
        for (i = 0; i < ROUNDS; i++) {
            fit(v_px_q16, s, i < WIDE_ROUNDS ? WIDE_PX : i < NEAR_ROUNDS ? DROGUE_Q16_ONE : ON_IT_PX);
        }
        agree = is_larger(v_px_q16, most_px_q16) ? agreeing(v_px_q16, s) : 0;
        if (agree >= AGREE && agree * A_BIN_PX + v_px_q16[0] > best) {
            best = agree * A_BIN_PX + v_px_q16[0];
            memcpy(best_px_q16, v_px_q16, sizeof v_px_q16);
        }
    }
    return best > 0;
}

/* Has a ray by itself half the slope at its bin's outer edge that the four have on average? */
static int on_ray(const drogue_ray *ray, const drogue_image *view, drogue_q16 at_px_q16, int32_t of_bin,
                  drogue_q16 step_px_q16)
{
    int32_t grey_q8[OF_RAY];
    int32_t most = 0;
    int32_t i;
    drogue_ray_read(grey_q8, ray, view, at_px_q16 - 2 * step_px_q16, OF_RAY);
    for (i = 0; i < OF_RAY - 2; i++) {
        const int32_t slope = drogue_abs_s32(grey_q8[i + 2] - grey_q8[i]);
        most = slope > most ? slope : most;
    }
    return 2 * most >= of_bin;
}

/* Have most rays by themselves the outer edge that their bin has? Where the rim has lobes the rays of a bin have their
 * edge in two places, and their sum both. */
static int on_rays(const drogue_ray rays[DROGUE_RAYS], const drogue_image *view, const outer_sight *s,
                   const drogue_q16 v_px_q16[WAVES], drogue_q16 step_px_q16)
{
    int32_t seen = 0;
    int32_t count = 0;
    int32_t k;
    for (k = 0; k < BINS; k++) {
        const outer_bin *bin = &s->bins[k];
        const drogue_q16 at_px_q16 = at_bin(v_px_q16, s->basis_q14[k]);
        const int32_t edge = nearest(bin, at_px_q16, ON_IT_PX, s->least_q8);
        if (at_px_q16 > OFF_PX && edge < EDGES) {
            seen += on_ray(&rays[2 * k], view, bin->at_px_q16[edge], bin->slope_q8[edge], step_px_q16) +
                    on_ray(&rays[2 * k + 1], view, bin->at_px_q16[edge], bin->slope_q8[edge], step_px_q16);
            count += 2;
        }
    }
    return 4 * seen >= 3 * count;
}

/* What an offset is of a length. */
static int32_t part_q24(drogue_q16 off_px_q16, int64_t of_px_q16)
{
    return (int32_t)drogue_div_round_s64(off_px_q16 * (INT64_C(1) << 24), of_px_q16);
}

/* Look in steps of a size. */
static int look(drogue_ellipse *outer, int32_t grown_q24[WAVES], drogue_ray rays[DROGUE_RAYS], const drogue_image *view,
                drogue_q16 step_px_q16)
{
    outer_sight s;
    drogue_q16 v_px_q16[WAVES];
    int32_t along_q24; /* by how much it is longer, and wider */
    int32_t across_q24;
    see(&s, rays, view, step_px_q16);
    if (!seek(v_px_q16, &s, outer->b_px_q16 / PARTS) || !on_rays(rays, view, &s, v_px_q16, step_px_q16)) {
        return 0;
    }
    along_q24 = part_q24(v_px_q16[0] + v_px_q16[3], outer->a_px_q16);
    across_q24 = part_q24(v_px_q16[0] - v_px_q16[3], outer->b_px_q16);
    grown_q24[0] = -(along_q24 + across_q24) / 2;
    grown_q24[1] = -part_q24(v_px_q16[1], outer->a_px_q16);
    grown_q24[2] = -part_q24(v_px_q16[2], outer->b_px_q16);
    grown_q24[3] = -(along_q24 - across_q24) / 2;
    grown_q24[4] = -part_q24(2 * v_px_q16[4], (int64_t)outer->a_px_q16 + outer->b_px_q16);
    drogue_outline_put_back(outer, grown_q24);
    return 1;
}

int drogue_outline_outer(drogue_ellipse *outer, int32_t grown_q24[WAVES], drogue_ray rays[DROGUE_RAYS],
                         const drogue_image *view)
{
    const drogue_q16 wide = drogue_clamp_s32(outer->a_px_q16 / STEPS, NARROW, WIDEST);
    if (outer->b_px_q16 < LEAST_PX) {
        return 0;
    }
    drogue_rays_aim(rays, outer, 4, 0, DROGUE_RAYS / 2);
    return look(outer, grown_q24, rays, view, NARROW) || (wide > NARROW && look(outer, grown_q24, rays, view, wide));
}
