/* SPDX-License-Identifier: Apache-2.0 */
/* How sure a result is: its log odds beside the documented sum, and each limit from both sides; and acquisition for a model
 * without an inner part. */
#include "suite.h"

#include <math.h>

#include "drogue/search.h"
#include "own_workspace.h"

static const drogue_model model = {22938, 7864, 16384}; /* 0.35, 0.12, 0.25 m */
static const drogue_model no_inner = {22938, 0, 0};

/* A circle of 100 px at 4 m: the inner part is expected with 100 * 0.12 / 0.35 * 4 / 4.25 = 32.3 px. */
static drogue_result measured(void)
{
    drogue_result r;
    memset(&r, 0, sizeof r);
    r.status = DROGUE_OK;
    r.ellipse.a_px_q16 = r.ellipse.b_px_q16 = 100 * DROGUE_Q16_ONE;
    r.pose.position_m_q16[2] = 4 * DROGUE_Q16_ONE;
    r.cover_q16 = DROGUE_Q16(9, 10);
    r.quality.reliability_q16 = DROGUE_Q16(95, 100);
    r.has_inner = 1;
    r.inner.rays = 56;
    r.inner.spread_px_q16 = DROGUE_Q16(1, 10);
    r.orientation_resolved = 1;
    return r;
}

/* The documented sum. */
static double log_odds(const drogue_result *r, const drogue_model *m)
{
    const double z = real_of_q16(r->pose.position_m_q16[2]);
    double px = sqrt(real_of_q16(r->ellipse.a_px_q16) * real_of_q16(r->ellipse.b_px_q16)) *
                real_of_q16(m->inner_radius_m_q16) / real_of_q16(m->rim_radius_m_q16) * z /
                (z + real_of_q16(m->inner_depth_m_q16));
    double power;
    px = px < 1 ? 1 : px > 32768 ? 32768 : px;
    power = floor(log2(px));
    MUST(fabs(power + px / exp2(power) - 1 - log2(px)) < 0.0861, "log2 of %g", px);
    return (5 * (power + px / exp2(power) - 1) + 9 * real_of_q16(r->cover_q16) - 2.0 * r->outside +
            10 * r->inner.rays / 64.0 - 14 * real_of_q16(r->inner.spread_px_q16) - 7 * real_of_q16(r->ambiguity_q16) +
            3 * (r->orientation_resolved && r->doubt_q16 < DROGUE_Q16(1, 64))) /
               4 -
           5;
}

START_TEST(log_odds_as_documented)
{
    uint64_t rng = 11;
    int i;
    for (i = 0; i < 20000; i++) {
        drogue_result r = measured();
        drogue_model m = model;
        r.ellipse.a_px_q16 = rng_range(&rng, 0, 3) == 0 ? rng_range(&rng, 1, INT32_MAX) : rng_range(&rng, 1, 1 << 24);
        r.ellipse.b_px_q16 = rng_range(&rng, 1, r.ellipse.a_px_q16);
        r.pose.position_m_q16[2] = rng_range(&rng, 1, 1 << rng_range(&rng, 1, 30));
        r.cover_q16 = rng_range(&rng, 0, DROGUE_Q16_ONE);
        r.inner.spread_px_q16 = rng_range(&rng, 0, DROGUE_Q16_ONE);
        r.inner.rays = (uint8_t)rng_range(&rng, 0, 64);
        r.ambiguity_q16 = rng_range(&rng, 0, DROGUE_Q16_ONE);
        r.outside = (uint32_t)rng_range(&rng, 0, 8);
        r.orientation_resolved = rng_range(&rng, 0, 1);
        r.doubt_q16 = rng_range(&rng, 1022, 1025);
        m.inner_depth_m_q16 = rng_range(&rng, 0, 1 << 20);
        MUST(fabs(real_of_q16(drogue_result_log_odds_q16(&r, &m)) - log_odds(&r, &m)) <
                 2.0 / 65536 +
                     5 / 4.0 / sqrt(real_of_q16(r.ellipse.a_px_q16) * real_of_q16(r.ellipse.b_px_q16)) / 16384,
             "%d: %.7f for %.7f", i, real_of_q16(drogue_result_log_odds_q16(&r, &m)), log_odds(&r, &m));
    }
}
END_TEST

START_TEST(log_odds_at_their_ends)
{
    drogue_result r = measured();
    const drogue_model wide = {1, INT32_MAX, 0};
    r.ellipse.a_px_q16 = r.ellipse.b_px_q16 = INT32_MAX;
    r.pose.position_m_q16[2] = INT32_MAX;
    r.cover_q16 = DROGUE_Q16_ONE;
    r.inner.spread_px_q16 = 0;
    r.inner.rays = 64;
    MUST(fabs(real_of_q16(drogue_result_log_odds_q16(&r, &wide)) - (5 * 15 + 9 + 10 + 3) / 4.0 + 5) < 1e-3, "%g",
         real_of_q16(drogue_result_log_odds_q16(&r, &wide))); /* 2^15 px, no image has more */
    r.inner.spread_px_q16 = INT32_MAX;
    ck_assert_int_eq(drogue_result_log_odds_q16(&r, &wide), -64 * DROGUE_Q16_ONE);
    r = measured();
    r.has_inner = 0;
    ck_assert_int_eq(drogue_result_log_odds_q16(&r, &model), DROGUE_Q16(9, 10) - 3 * DROGUE_Q16_ONE);
}
END_TEST

/* Each term of the sum takes a result over the limit. */
START_TEST(limits_of_sure)
{
    drogue_result r = measured(); /* 6.261 + 2.025 + 2.188 - 0.35 + 0.75 - 5 = 5.874 */
    ck_assert(drogue_result_sure(&r, &model));
    r.inner.spread_px_q16 = DROGUE_Q16(1599, 1000); /* 5.246 less */
    ck_assert(drogue_result_sure(&r, &model));
    r.inner.spread_px_q16 = DROGUE_Q16(1601, 1000);
    ck_assert(!drogue_result_sure(&r, &model));
    r.cover_q16 = DROGUE_Q16(91, 100);
    ck_assert(drogue_result_sure(&r, &model));
    r.inner.rays = 55;
    ck_assert(!drogue_result_sure(&r, &model));
    r.inner.rays = 57;
    ck_assert(drogue_result_sure(&r, &model));
    r.ambiguity_q16 = DROGUE_Q16(4, 100);
    ck_assert(!drogue_result_sure(&r, &model));
    r.ambiguity_q16 = DROGUE_Q16(3, 100);
    ck_assert(drogue_result_sure(&r, &model));
    r.doubt_q16 = DROGUE_Q16(1, 64) - 1;
    ck_assert(drogue_result_sure(&r, &model));
    r.doubt_q16++;
    ck_assert(!drogue_result_sure(&r, &model));
    r = measured();
    r.outside = 8;
    r.orientation_resolved = 0;
    ck_assert(drogue_result_sure(&r, &model));                     /* 1.124 */
    r.ellipse.a_px_q16 = r.ellipse.b_px_q16 = 50 * DROGUE_Q16_ONE; /* 1.25 less */
    ck_assert(!drogue_result_sure(&r, &model));
    r.outside = 7;
    ck_assert(!drogue_result_sure(&r, &model));
    r.outside = 6;
    ck_assert(drogue_result_sure(&r, &model));
    r.has_inner = 0;
    ck_assert(!drogue_result_sure(&r, &model));
}
END_TEST

START_TEST(behind_or_beside_the_camera_nothing_is_sure)
{
    drogue_result r = measured();
    drogue_model near = model;
    r.pose.position_m_q16[2] = 0;
    ck_assert(!drogue_result_sure(&r, &model));
    r.pose.position_m_q16[2] = DROGUE_Q16(2, 10);
    near.inner_depth_m_q16 = -DROGUE_Q16(2, 10); /* the inner part in the camera */
    ck_assert(!drogue_result_sure(&r, &near));
    near.inner_depth_m_q16 = -DROGUE_Q16(25, 100); /* the inner part before the end plane, and behind the camera */
    ck_assert(!drogue_result_sure(&r, &near));
}
END_TEST

START_TEST(without_an_inner_part_cover_and_reliability_decide)
{
    drogue_result r = measured();
    r.has_inner = 0;
    ck_assert(drogue_result_sure(&r, &no_inner));
    r.quality.reliability_q16 = DROGUE_Q16(89, 100);
    ck_assert(!drogue_result_sure(&r, &no_inner));
    r.quality.reliability_q16 = DROGUE_Q16(95, 100);
    r.cover_q16 = DROGUE_Q16(74, 100);
    ck_assert(!drogue_result_sure(&r, &no_inner));
}
END_TEST

enum { SIDE = 256 };

/* A dark disc on a bright ground with a darker one in it, which the search sights. */
static void draw(uint8_t *pixels, int radius)
{
    int x, y;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            const int d = (x - 120) * (x - 120) + (y - 130) * (y - 130);
            pixels[y * SIDE + x] = (uint8_t)(9 * d <= radius * radius ? 20 : d <= radius * radius ? 90 : 200);
        }
    }
}

START_TEST(acquire_without_an_inner_part)
{
    static uint8_t pixels[SIDE * SIDE];
    static uint8_t memory[DROGUE_SEARCH_BYTES(SIDE)];
    test_workspace w = test_workspace_of(SIDE, (uint32_t)DROGUE_EDGES_FOR(SIDE), (uint32_t)DROGUE_LABELS_FOR(SIDE),
                                         (uint32_t)DROGUE_ARCS_FOR(SIDE));
    drogue_search search;
    drogue_config config;
    drogue_result r;
    const drogue_camera camera = {500 << 16, 500 << 16, 128 << 16, 128 << 16, 0, 0, 0, 0, 0};
    const drogue_setup setup = {&camera, &no_inner, &config};
    drogue_image image = {pixels, SIDE, SIDE, SIDE};
    drogue_config_default(&config);
    ck_assert_int_eq(drogue_search_init(&search, memory, sizeof memory, SIDE), DROGUE_OK);
    draw(pixels, 60);
    ck_assert_int_eq(drogue_acquire(&r, &w.workspace, &search, &setup, &image, NULL), DROGUE_OK);
    MUST(abs(r.ellipse.xc_px_q16 - 120 * 65536) < 32768 && abs(r.ellipse.a_px_q16 - 60 * 65536) < 65536, "x %d, a %d",
         (int)r.ellipse.xc_px_q16, (int)r.ellipse.a_px_q16);
    memset(pixels, 128, sizeof pixels); /* nothing sighted: the part itself is measured, and says why there is none */
    ck_assert_int_ne(drogue_acquire(&r, &w.workspace, &search, &setup, &image, NULL), DROGUE_OK);
    ck_assert_int_ne(r.status, DROGUE_OK);
    image.stride = SIDE - 1;
    ck_assert_int_eq(drogue_acquire(&r, &w.workspace, &search, &setup, &image, NULL), DROGUE_E_ARGUMENT);
    image.stride = SIDE;
    image.data = NULL;
    ck_assert_int_eq(drogue_acquire(&r, &w.workspace, &search, &setup, &image, NULL), DROGUE_E_ARGUMENT);
    test_workspace_free(&w);
}
END_TEST

SUITE_MAIN("sure", log_odds_as_documented, log_odds_at_their_ends, limits_of_sure,
           behind_or_beside_the_camera_nothing_is_sure, without_an_inner_part_cover_and_reliability_decide,
           acquire_without_an_inner_part)
