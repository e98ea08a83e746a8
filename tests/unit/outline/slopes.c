/* SPDX-License-Identifier: Apache-2.0 */
/* How wide an edge is, from slopes of known form. */
#include "suite.h"

#include "../../../src/outline/slopes.h"

enum { MIDDLE = DROGUE_SLOPE_MIDDLE };

static const double front2 = 4 / 3.0; /* px^2: the front end's blur */

/* Slopes of an edge of variance 'blur2' convolved with a box, 'at' half pixels outwards; and with the front end's blur. */
static void edge(int32_t slope[DROGUE_SLOPES], int32_t seen[DROGUE_SLOPES], double blur2, double box, double at,
                 double rise)
{
    int i;
    for (i = 0; i < DROGUE_SLOPES; i++) {
        const double x = (i - MIDDLE - at) / 2, s = sqrt(2 * blur2), f = sqrt(2 * (blur2 + front2));
        const double own = (erf((x + box / 2) / s) - erf((x - box / 2) / s)) / (2 * box);
        const double blurred = (erf((x + box / 2) / f) - erf((x - box / 2) / f)) / (2 * box);
        slope[i] = (int32_t)lround(rise * own);
        seen[i] = (int32_t)lround(rise * DROGUE_SLOPE_GAIN * blurred);
    }
}

START_TEST(variance_of_known_edges)
{
    int32_t slope[DROGUE_SLOPES], seen[DROGUE_SLOPES];
    double at, box;
    for (at = -3; at <= 3; at++) {
        edge(slope, seen, 0.5, 0.01, at, 100000); /* a Gaussian's width: root of 2 pi times its deviation */
        const double gaussian = ldexp(drogue_edge_variance(slope, seen), -16);
        MUST(fabs(gaussian - 2 * TEST_PI * (0.5 + front2) / 8) < 0.02, "at %g: %g", at, gaussian);
    }
    for (box = 5; box <= 9; box++) { /* a box's width is its own, so far as it is seen */
        edge(slope, seen, 0.3, box, 0, 100000);
        const double measured = ldexp(drogue_edge_variance(slope, seen), -16);
        MUST(fabs(measured - box * box / 8) < 0.05 * measured + 0.35, "box of %g: %g", box, measured);
    }
}
END_TEST

START_TEST(only_what_rises_counts)
{
    int32_t slope[DROGUE_SLOPES], seen[DROGUE_SLOPES];
    int32_t alone, beside;
    int i;
    edge(slope, seen, 0.5, 0.01, 0, 100000);
    alone = drogue_edge_variance(slope, seen);
    for (i = 0; i < 4; i++) { /* what falls beyond the edge, on either side, or rises again beyond that by less */
        slope[i] = -30000;
        slope[DROGUE_SLOPES - 1 - i] = -30000;
    }
    slope[0] = 20000;
    beside = drogue_edge_variance(slope, seen);
    ck_assert_int_eq(alone, beside);
    for (i = 0; i < 4; i++) { /* what rises on belongs to it: inside and outside */
        edge(slope, seen, 0.5, 0.01, 0, 100000);
        slope[i % 2 == 0 ? i : DROGUE_SLOPES - 1 - i] += 20000;
        MUST(drogue_edge_variance(slope, seen) > alone + alone / 8, "end %d", i);
    }
}
END_TEST

START_TEST(no_edge_and_the_widest)
{
    int32_t slope[DROGUE_SLOPES], seen[DROGUE_SLOPES];
    int i;
    memset(slope, 0, sizeof slope);
    memset(seen, 0, sizeof seen);
    ck_assert_int_eq(drogue_edge_variance(slope, seen), 0);
    edge(slope, seen, 0.5, 0.01, 0, 1000);
    for (i = 0; i < DROGUE_SLOPES; i++) {
        slope[i] = -slope[i];
    }
    slope[0] = slope[DROGUE_SLOPES - 1] = 0;
    ck_assert_int_eq(drogue_edge_variance(slope, seen), 0); /* it falls where it was seen to rise */
    for (i = 0; i < DROGUE_SLOPES; i++) {
        slope[i] = 1 << 20;
        seen[i] = 1;
    }
    ck_assert_int_eq(drogue_edge_variance(slope, seen), 32 * 65536);
    for (i = 0; i < DROGUE_SLOPES; i++) {
        seen[i] = i == DROGUE_SLOPE_LAST ? 2 : -5;
        slope[i] = i == DROGUE_SLOPE_LAST ? 100 : 0;
    }
    ck_assert_int_gt(drogue_edge_variance(slope, seen), 0); /* the last place, and nothing beside it */
}
END_TEST

/* Another edge beside the outline's own: where, how steep for the own one. */
START_TEST(edges_outside)
{
    static const struct {
        double at;      /* half pixels outwards */
        int own, other; /* grey levels a pixel */
        int seen;
    } cases[] = {{5, 30, 20, 1},  {5, 30, -20, 1}, /* of either sign, */
                 {5, -30, 20, 1},                  /* whatever the outline's is, */
                 {9, 30, 20, 1},                   /* as far as 4.5 px, */
                 {-6, 30, 20, 0},                  /* but not inside, */
                 {0, 30, 0, 0},                    /* nor where there is none; */
                 {7, 30, 6, 1},   {7, 30, 4, 0},   /* steep for the outline's */
                 {7, 10, 4, 1},   {7, 10, 2, 0}};  /* and for noise */
    size_t i;
    for (i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        int32_t slope[DROGUE_SLOPES];
        int k;
        for (k = 0; k < DROGUE_SLOPES; k++) {
            const double own = (k - MIDDLE) / 2.0, other = own - cases[i].at / 2;
            slope[k] =
                (int32_t)lround(8 * 256 * (cases[i].own * exp(-own * own) + cases[i].other * exp(-other * other)));
        }
        MUST(drogue_edge_outside(slope) == cases[i].seen, "case %d", (int)i);
    }
}
END_TEST

SUITE_MAIN("slopes", variance_of_known_edges, only_what_rises_counts, no_edge_and_the_widest, edges_outside)
