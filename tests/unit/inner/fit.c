/* SPDX-License-Identifier: Apache-2.0 */
/* Least squares over rays: place and size from edges that agree, and rays that do not determine them. */
#include "suite.h"

#include "../../../src/inner/fit.h"

/* Rays at these angles, with edges where a disc that lies (dx, dy) px off and is larger by 'grown' px shows them. */
static drogue_ray_sums sums_of(const double *angles, int count, double dx, double dy, double grown)
{
    drogue_ray_sums s;
    int k;
    memset(&s, 0, sizeof s);
    for (k = 0; k < count; k++) {
        drogue_ray r;
        memset(&r, 0, sizeof r);
        r.nx_q14 = (int32_t)lround(16384 * cos(angles[k]));
        r.ny_q14 = (int32_t)lround(16384 * sin(angles[k]));
        drogue_ray_sums_add(&s, &r, 1, q16_of(dx * cos(angles[k]) + dy * sin(angles[k]) + grown));
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

SUITE_MAIN("fit", what_rays_determine)
