/* SPDX-License-Identifier: Apache-2.0 */
/* The rim's outer edge. Where the rim is a band of another grey, or its lip is lit, edge points may be those of its
 * inner edge, on one side or all about: an outline that is too small. */
#include <string.h>

#include "drogue/outline.h"
#include "harmonics.h"
#include "vertex.h"

#define BINS DROGUE_SUPPORT_BINS
#define IN_BIN 4                /* rays, of which two lie in its neighbours */
#define WITHIN 4                /* samples of a ray within the outline */
#define SAMPLES 17              /* of a ray */
#define SLOPES (SAMPLES - 2)    /* the first lies three steps within the outline */
#define OWN 5                   /* as far as this slope, a pixel outside, an edge is the outline's own */
#define APART 2                 /* slopes between two edges */
#define FAR (OWN + APART)       /* the outline's own edge tells nothing of noise from there on */
#define WAVES 5                 /* of an outline: size, shift, shape */
#define EDGES 2                 /* that are kept: the outline's own, 0, and the steepest outside */
#define NARROW DROGUE_Q16(1, 2) /* px: a step; then where that shows none, */
#define STEPS 200               /* this part of a large semi-axis */
#define LEAST_Q8 (5 * 256)      /* grey levels of a slope, */
#define SHARE 5                 /* no less than this part of what the outline's own edge has */
#define ROUNDS 16
#define WIDE_ROUNDS 6              /* of them: an edge belongs to the ellipse */
#define WIDE_PX DROGUE_Q16(2, 1)   /* where it is as near, */
#define NEAR_PX DROGUE_Q16(1, 1)   /* later as near as this, */
#define ON_IT_PX DROGUE_Q16(6, 10) /* and in the end */
#define AGREE 22                   /* least bins that agree then, */
#define OUTSIDE 8                  /* those of them with an outer edge, */
#define PARTS 8                    /* of b: an outer edge is no farther off than one of them */
#define GROWN DROGUE_Q16(3, 10)    /* and px by which the ellipse is larger */
#define OF_RAY 5                   /* samples of one ray about a bin's edge */

/* Edges in a bin of an outline. */
typedef struct outer_bin {
    drogue_q16 at_px_q16[EDGES];
    int32_t slope[EDGES]; /* Q8 times IN_BIN; 0: there is none */
} outer_bin;

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

static void keep(outer_bin *bin, int32_t edge, const int32_t slope[SLOPES], int32_t i, drogue_q16 step_px_q16)
{
    const drogue_q16 part = drogue_vertex(slope[i - 1], slope[i], slope[i + 1], DROGUE_Q16_ONE / 2);
    const int64_t at = (int64_t)(i + 1 - WITHIN) * DROGUE_Q16_ONE + part; /* steps */
    bin->at_px_q16[edge] = (drogue_q16)drogue_shr_round_s64(at * step_px_q16, 16);
    bin->slope[edge] = slope[i];
}

/* The peaks of a bin's slopes, of either sign. Returns the slopes' sum far outside but for
 * an edge, and counts them. */
static int32_t see_bin(outer_bin *bin, int32_t *count, const int32_t one[SAMPLES], const int32_t other[SAMPLES],
                       drogue_q16 step_px_q16)
{
    int32_t slope[SLOPES];
    int32_t sum = 0;
    int32_t outer = 0;   /* where the steepest is */
    int32_t first = OWN; /* outside */
    int32_t i;
    memset(bin, 0, sizeof *bin);
    for (i = 0; i < SLOPES; i++) {
        slope[i] = drogue_abs_s32(one[i + 2] + other[i + 2] - one[i] - other[i]);
    }
    for (i = 1; i < SLOPES - 1; i++) {
        if (slope[i] > slope[i - 1] && slope[i] >= slope[i + 1]) {
            if (i <= OWN && slope[i] > bin->slope[0]) {
                keep(bin, 0, slope, i, step_px_q16);
                first = i + APART > OWN ? i + APART : OWN;
            } else if (i >= first && slope[i] > bin->slope[1]) {
                keep(bin, 1, slope, i, step_px_q16);
                outer = i;
            }
        }
    }
    for (i = FAR; i < SLOPES; i++) {
        if (drogue_abs_s32(i - outer) > APART) {
            sum += slope[i];
            (*count)++;
        }
    }
    return sum;
}

/* See all bins. Returns the least slope that is an edge: of noise and texture there is half as much again. */
static int32_t see(outer_bin bins[BINS], drogue_ray rays[DROGUE_RAYS], const drogue_image *view, drogue_q16 step_px_q16)
{
    int32_t grey_q8[2][SAMPLES];
    int64_t own = 0;
    int64_t outside = 0;
    int32_t least = IN_BIN * LEAST_Q8;
    int32_t share;
    int32_t count = 0; /* of them there are three in each bin and more */
    int32_t noise;
    int32_t k;
    read_pair(grey_q8[0], rays, 0, view, step_px_q16);
    for (k = 0; k < BINS; k++) {
        read_pair(grey_q8[1 - k % 2], rays, (k + 1) % BINS, view, step_px_q16);
        outside += see_bin(&bins[k], &count, grey_q8[0], grey_q8[1], step_px_q16);
        own += bins[k].slope[0];
    }
    share = (int32_t)(own / (BINS * SHARE));
    noise = (int32_t)(3 * outside / (2 * count));
    least = least > share ? least : share;
    return least > noise ? least : noise;
}

/* Of a bin the edge that is nearest to a place; EDGES where none is within so much. */
static int32_t nearest(const outer_bin *bin, drogue_q16 at_px_q16, drogue_q16 within_px_q16, int32_t least)
{
    int32_t best = EDGES;
    int32_t i;
    for (i = 0; i < EDGES; i++) {
        const drogue_q16 off = drogue_abs_s32(bin->at_px_q16[i] - at_px_q16);
        if (bin->slope[i] >= least && off < within_px_q16) {
            within_px_q16 = off;
            best = i;
        }
    }
    return best;
}

/* Where an ellipse passes a bin that is larger by v[0], shifted by v[1] and v[2] along the axes and longer by v[3] and
 * v[4] along the major one and a diagonal. */
static drogue_q16 at_bin(const drogue_q16 v_px_q16[WAVES], const int32_t basis_q30[WAVES])
{
    int64_t sum_q46 = 0;
    int i;
    for (i = 0; i < WAVES; i++) {
        sum_q46 += drogue_product(v_px_q16[i], basis_q30[i]);
    }
    return (drogue_q16)drogue_shr_round_s64(sum_q46, 30);
}

/* The ellipse of least squares over the bins' edges: at first, within 0, over the outer ones where there are, later
 * over those that are nearest to it, and where none is near it passes as it did. Returns whether most bins have a near
 * one, and enough of them an outer one. */
static int fit(drogue_q16 v_px_q16[WAVES], const outer_bin bins[BINS], drogue_q16 within_px_q16, int32_t least)
{
    drogue_q16 at_px_q16[BINS];
    int32_t agree = 0;
    int32_t outside = 0;
    uint32_t k;
    for (k = 0; k < BINS; k++) {
        int32_t basis_q30[WAVES];
        int32_t edge;
        drogue_support_basis(basis_q30, k);
        at_px_q16[k] = at_bin(v_px_q16, basis_q30);
        edge = within_px_q16 == 0 ? bins[k].slope[1] >= least : nearest(&bins[k], at_px_q16[k], within_px_q16, least);
        if (edge < EDGES) {
            at_px_q16[k] = bins[k].at_px_q16[edge];
            agree++;
            outside += edge > 0;
        }
    }
    drogue_fit_waves(v_px_q16, at_px_q16);
    return agree >= AGREE && outside >= OUTSIDE;
}

/* Has a ray by itself half the slope at its bin's outer edge that the four have on average? */
static int on_ray(const drogue_ray *ray, const drogue_image *view, const outer_bin *bin, drogue_q16 step_px_q16)
{
    int32_t grey_q8[OF_RAY];
    int32_t most = 0;
    int32_t i;
    drogue_ray_read(grey_q8, ray, view, bin->at_px_q16[1] - 2 * step_px_q16, OF_RAY);
    for (i = 0; i < OF_RAY - 2; i++) {
        const int32_t slope = drogue_abs_s32(grey_q8[i + 2] - grey_q8[i]);
        most = slope > most ? slope : most;
    }
    return 2 * IN_BIN * most >= bin->slope[1];
}

/* Have most rays by themselves the outer edge that their bin has? Where the rim has lobes the rays of a bin have their
 * edge in two places, and their sum both. */
static int on_rays(const drogue_ray rays[DROGUE_RAYS], const drogue_image *view, const outer_bin bins[BINS],
                   const drogue_q16 v_px_q16[WAVES], drogue_q16 step_px_q16, int32_t least)
{
    int32_t seen = 0;
    int32_t count = 0;
    int32_t k;
    for (k = 0; k < BINS; k++) {
        const outer_bin *bin = &bins[k];
        int32_t basis_q30[WAVES];
        drogue_support_basis(basis_q30, (uint32_t)k);
        if (nearest(bin, at_bin(v_px_q16, basis_q30), ON_IT_PX, least) == 1) {
            seen += on_ray(&rays[2 * k], view, bin, step_px_q16) + on_ray(&rays[2 * k + 1], view, bin, step_px_q16);
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
static int look(drogue_ellipse *outer, drogue_ray rays[DROGUE_RAYS], const drogue_image *view, drogue_q16 step_px_q16)
{
    outer_bin bins[BINS];
    drogue_q16 v_px_q16[WAVES] = {0, 0, 0, 0, 0};
    drogue_q16 last_px_q16[WAVES];
    int32_t pull_q24[WAVES];
    int32_t along_q24; /* by how much it is longer, and wider */
    int32_t across_q24;
    const int32_t least = see(bins, rays, view, step_px_q16);
    int i;
    if (!fit(v_px_q16, bins, 0, least)) {
        return 0;
    }
    for (i = 0; i < ROUNDS; i++) {
        (void)fit(v_px_q16, bins, i < WIDE_ROUNDS ? WIDE_PX : NEAR_PX, least);
    }
    memcpy(last_px_q16, v_px_q16, sizeof last_px_q16);
    if (v_px_q16[0] < GROWN || !fit(last_px_q16, bins, ON_IT_PX, least) ||
        !on_rays(rays, view, bins, v_px_q16, step_px_q16, least)) {
        return 0;
    }
    for (i = 0; i < WAVES; i++) {
        if (drogue_abs_s32(v_px_q16[i]) > outer->b_px_q16 / PARTS) {
            return 0;
        }
    }
    along_q24 = part_q24(v_px_q16[0] + v_px_q16[3], outer->a_px_q16);
    across_q24 = part_q24(v_px_q16[0] - v_px_q16[3], outer->b_px_q16);
    pull_q24[0] = -(along_q24 + across_q24) / 2;
    pull_q24[1] = -part_q24(v_px_q16[1], outer->a_px_q16);
    pull_q24[2] = -part_q24(v_px_q16[2], outer->b_px_q16);
    pull_q24[3] = -(along_q24 - across_q24) / 2;
    pull_q24[4] = -part_q24(2 * v_px_q16[4], (int64_t)outer->a_px_q16 + outer->b_px_q16);
    drogue_outline_put_back(outer, pull_q24);
    return 1;
}

int drogue_outline_outer(drogue_ellipse *outer, drogue_ray rays[DROGUE_RAYS], const drogue_image *view)
{
    const drogue_q16 wide = outer->a_px_q16 / STEPS;
    drogue_rays_aim(rays, outer, 4, 0, DROGUE_RAYS / 2);
    return look(outer, rays, view, NARROW) || (wide > NARROW && look(outer, rays, view, wide));
}
