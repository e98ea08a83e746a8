/* SPDX-License-Identifier: Apache-2.0 */
/* Least squares over rays: place and size from edges that agree, and rays that do not determine them,
 * nor the grey of the disc. */
#include "suite.h"

#include "../../../src/inner/fit.h"
#include "../../../src/inner/shade.h"

/* Rays at these angles, with edges where a disc that lies (dx, dy) px off and is larger by 'grown' px shows them. */
static drogue_ray_sums sums_of(const double *angles, int count, double dx, double dy, double grown)
{
    drogue_ray_sums s;
    int k;
    memset(&s, 0, sizeof s);
    for (k = 0; k < count; k++) {
        drogue_ray r;
        int32_t off_q16;
        memset(&r, 0, sizeof r);
        r.nx_q14 = (int32_t)lround(16384 * cos(angles[k]));
        r.ny_q14 = (int32_t)lround(16384 * sin(angles[k]));
        off_q16 = q16_of(dx * cos(angles[k]) + dy * sin(angles[k]) + grown);
        drogue_ray_sums_add(&s, &r, 1, off_q16);
    }
    return s;
}

START_TEST(what_rays_determine)
{
    double round[FEWEST], along[FEWEST];
    drogue_ray_sums s;
    drogue_real normal[6];
    int k, size;
    for (k = 0; k < FEWEST; k++) {
        round[k] = 2 * TEST_PI * k / FEWEST;
        along[k] = 0.5 + (k % 2) * TEST_PI; /* all to the same two sides */
    }
    for (size = 0; size < 2; size++) {
        drogue_q16 v[3] = {65536, 0, 131072};
        s = sums_of(round, FEWEST, 0.5, -0.25, size ? 0.125 : 0);
        ck_assert_int_eq(drogue_ray_sums_solve(v, normal, &s, size), 1);
        ck_assert_int_le(abs(v[0] - 65536 - 32768), 4);
        ck_assert_int_le(abs(v[1] + 16384), 4);
        ck_assert_int_le(abs(v[2] - 131072 - 8192 * size), 4);
        s = sums_of(round, FEWEST - 1, 0.5, -0.25, 0); /* too few of them */
        ck_assert_int_eq(drogue_ray_sums_solve(v, normal, &s, size), 0);
        s = sums_of(along, FEWEST, 0.5, -0.25, 0); /* which say nothing of the place across them */
        ck_assert_int_eq(drogue_ray_sums_solve(v, normal, &s, size), 0);
    }
}
END_TEST

/* Rays about a dark band, to both its sides; parallel or nearly parallel ones say nothing of how the grey changes along
 * it. */
START_TEST(a_plane_of_grey_that_rays_do_not_determine)
{
    enum { SIDE = 96 };
    static uint8_t pixels[SIDE * SIDE];
    static const drogue_image image = {pixels, SIDE, SIDE, SIDE};
    const drogue_q16 v[3] = {0, 0, 0};
    uint64_t rng = 5;
    int i, k, spread;
    for (i = 0; i < SIDE * SIDE; i++) {
        pixels[i] = (uint8_t)((abs(2 * (i / SIDE) - SIDE + 1) < 41 ? 30 : 130) + rng_range(&rng, 0, 20));
    }
    for (spread = -2; spread < 2; spread++) {
        drogue_ray rays[DROGUE_RAYS];
        drogue_inner_shade shade;
        memset(rays, 0, sizeof rays);
        for (k = 0; k < DROGUE_RAYS; k++) {
            drogue_ray *r = &rays[k];
            const int32_t side = k % 2 == 0 ? 1 : -1;
            r->nx_q14 = spread > 0    ? rng_range(&rng, -8000, 8000)
                        : spread < -1 ? 0
                        : spread < 0  ? -(k / 2 % 2) /* a last bit off being parallel */
                                      : k / 2 % 2;
            r->ny_q14 = side * (int32_t)lround(sqrt(16384.0 * 16384 - (double)r->nx_q14 * r->nx_q14));
            r->x_px_q16 = DROGUE_Q16(16 + k, 1);
            r->y_px_q16 = DROGUE_Q16(95, 2) + side * DROGUE_Q16(20, 1);
            r->step_px_q16 = DROGUE_Q16(1, 2);
            r->edges[0].slope_q8 = 100 * 256 * DROGUE_RAY_WEIGHT;
            r->count = 1;
        }
        ck_assert_int_eq(drogue_inner_shade_find(&shade, rays, &image, DROGUE_TRANSFER_LINEAR, v, DROGUE_Q16(3, 2)),
                         spread > 0);
    }
}
END_TEST

SUITE_MAIN("fit", what_rays_determine, a_plane_of_grey_that_rays_do_not_determine)
