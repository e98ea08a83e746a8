/* SPDX-License-Identifier: Apache-2.0 */
/* The disc is dark all over, what surrounds it need not be of one grey: light, ribs and a ring about it move the
 * steepest place of a blurred edge, and hardly the one where the grey begins to rise. So the edge is looked for where
 * the grey is a quarter of the usual step above the disc's own. Where grey levels are encoded it is the light's, which
 * blur mixes: a quarter of the step between encoded levels lies farther within. */
#include "shade.h"

#include <string.h>

#define PROFILE 13               /* samples along a ray, half a pixel apart */
#define FROM DROGUE_Q16(-35, 10) /* px from the edge outwards: the first of them */
#define DARK 4                   /* of them within the disc */
#define FIRST 3                  /* least place of the last one below the level */
#define LAST 9                   /* its largest place; the last of all is beyond the edge */
#define STILL DROGUE_Q16(2, 1)   /* grey levels by which the disc may differ from itself */
#define GREYS DROGUE_Q16(256, 1) /* no grey changes by more */
#define SIGNIFICANT 50           /* variances of a change of grey across the disc; */
#define STEP 3                   /* and so many times as many of the step at its edge: less is found in noise */

/* Where a profile about an edge, within 2^30, begins: at a multiple of the distance of its samples, so that it does not
 * tremble with the edge's last bits. */
static drogue_q16 begin_of(drogue_q16 at_px_q16) { return (at_px_q16 + FROM) & ~(DROGUE_Q16_ONE / 2 - 1); }

/* Grey between two samples, Q16; 'part' Q15. */
static int32_t between_q16(int32_t a_q8, int32_t b_q8, int32_t part_q15)
{
    return a_q8 * 256 + (int32_t)drogue_shr_round_s64((int64_t)(b_q8 - a_q8) * part_q15, 7);
}

/* By Hoare's FIND: what lies before the middle is no larger, what lies behind it no smaller. */
static int32_t median_of(int32_t *v, int32_t count)
{
    const int32_t middle = count / 2;
    int32_t first = 0;
    int32_t last = count - 1;
    while (first < last) { /* bound: RAYS, a value less each time */
        const int32_t by = v[middle];
        int32_t i = first;
        int32_t j = last;
        while (i <= j) {        /* bound: RAYS */
            while (v[i] < by) { /* bound: RAYS, there is one no smaller */
                i++;
            }
            while (v[j] > by) { /* bound: RAYS */
                j--;
            }
            if (i <= j) {
                const int32_t moved = v[i];
                v[i++] = v[j];
                v[j--] = moved;
            }
        }
        first = j < middle ? i : first;
        last = i > middle ? j : last;
    }
    return v[middle];
}

/* Grey of the disc along its edge as a plane, of the rays that fit it; a change across it must stand out of the
 * noise, of whose square that of their mean is told. */
static int fit_dark(drogue_q16 plane_q16[3], int64_t *noise2_q16, const drogue_ray rays[RAYS],
                    const int32_t dark_q16[RAYS])
{
    drogue_real normal[6];
    drogue_q16 within = GREYS;
    int64_t change2;
    drogue_ray_sums s;
    int round;
    int i;
    memset(plane_q16, 0, 3 * sizeof plane_q16[0]);
    for (round = 0; round < 4; round++) {
        int32_t k;
        memset(&s, 0, sizeof s);
        for (k = 0; k < RAYS; k++) {
            const int32_t off_q16 = dark_q16[k] < 0 ? 0 : dark_q16[k] - drogue_ray_along(&rays[k], plane_q16);
            if (dark_q16[k] >= 0 && off_q16 <= within && off_q16 >= -within) {
                drogue_ray_sums_add(&s, &rays[k], 1, off_q16);
            }
        }
        if (!drogue_ray_sums_solve(plane_q16, normal, &s, 1)) {
            return 0;
        }
        within = larger(STILL, 2 * drogue_ray_sums_rms(&s));
    }
    for (i = 0; i < 3; i++) {
        if (plane_q16[i] > GREYS || plane_q16[i] < -GREYS) { /* rays too much alike to say */
            return 0;
        }
    }
    change2 = (int64_t)drogue_square_sum(plane_q16[0], plane_q16[1]) >> 16;
    *noise2_q16 = drogue_div_round_s64(s.squares_q16 * SIGNIFICANT, (int64_t)s.rays * s.rays);
    for (i = 0; i < 2 && change2 + *noise2_q16 > 0; i++) {
        const drogue_q16 kept = (drogue_q16)drogue_div_round_s64(plane_q16[i] * change2, change2 + *noise2_q16);
        plane_q16[i] = kept;
    }
    return 1;
}

int drogue_inner_shade_find(drogue_inner_shade *out, const drogue_ray rays[RAYS], const drogue_image *image,
                            drogue_transfer transfer, const drogue_q16 v_px_q16[3], drogue_q16 within_px_q16)
{
    int32_t dark_q16[RAYS];
    int32_t beyond_q16[RAYS];
    int64_t noise2_q16;
    int32_t step_q16;
    int32_t count = 0;
    int32_t k;
    for (k = 0; k < RAYS; k++) {
        const drogue_q16 at = rays[k].count > 0 ? drogue_ray_along(&rays[k], v_px_q16) : 0;
        dark_q16[k] = -1;
        if (drogue_ray_chosen(&rays[k], at, within_px_q16) >= 0) {
            const int32_t part_q15 = at + FROM - begin_of(at);
            int32_t grey_q8[PROFILE];
            int32_t i;
            drogue_ray_read_as(grey_q8, &rays[k], image, transfer, begin_of(at), PROFILE);
            dark_q16[k] =
                (int32_t)((uint32_t)between_q16(grey_q8[0], grey_q8[DARK], part_q15) / DARK); /* no grey is below 0 */
            for (i = 1; i < DARK; i++) {
                dark_q16[k] += grey_q8[i] * (256 / DARK);
            }
            beyond_q16[k] = between_q16(grey_q8[PROFILE - 2], grey_q8[PROFILE - 1], part_q15);
        }
    }
    if (!fit_dark(out->dark_q16, &noise2_q16, rays, dark_q16)) {
        return 0;
    }
    for (k = 0; k < RAYS; k++) {
        if (dark_q16[k] >= 0) {
            beyond_q16[count++] = beyond_q16[k] - drogue_ray_along(&rays[k], out->dark_q16);
        }
    }
    step_q16 = median_of(beyond_q16, count);
    out->rise_q16 = step_q16 / 4;
    return out->rise_q16 > 0 && drogue_shr_round_s64((int64_t)step_q16 * step_q16, 16) > STEP * noise2_q16;
}

void drogue_inner_shade_cross(drogue_ray rays[RAYS], const drogue_image *image, drogue_transfer transfer,
                              const drogue_inner_shade *grey, const drogue_q16 v_px_q16[3], int32_t every)
{
    int32_t k;
    for (k = 0; k < RAYS; k += every) { /* bound: 64 */
        drogue_ray *r = &rays[k];
        const drogue_q16 from = begin_of(drogue_ray_along(r, v_px_q16));
        const int32_t level_q16 = drogue_ray_along(r, grey->dark_q16) + grey->rise_q16;
        int32_t grey_q8[PROFILE];
        int32_t i;
        drogue_ray_read_as(grey_q8, r, image, transfer, from, PROFILE);
        r->count = 0;
        for (i = FIRST; i <= LAST; i++) {
            const int32_t below_q16 = level_q16 - grey_q8[i] * 256;
            if (below_q16 > 0 && grey_q8[i + 1] * 256 >= level_q16 && r->count < DROGUE_RAY_EDGES) {
                drogue_ray_edge *e = &r->edges[r->count++];
                const int32_t step_q8 = grey_q8[i + 1] - grey_q8[i];
                const int32_t part_q16 = (int32_t)drogue_div_round_s64((int64_t)below_q16 * 128, step_q8);
                e->at_px_q16 = from + 32768 * i + part_q16; /* within 2^30 + 2^20: no part is above 2^15 */
                e->slope_q8 = DROGUE_RAY_WEIGHT * 2 * step_q8;
                e->level_q8 = grey_q8[i];
            }
        }
    }
}
