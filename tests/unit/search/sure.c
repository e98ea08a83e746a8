/* SPDX-License-Identifier: Apache-2.0 */
/* When a result is enough to begin with: each limit from both sides; and acquisition for a model without an inner part. */
#include "suite.h"

#include "drogue/search.h"
#include "own_workspace.h"

static const drogue_model model = {22938, 7864, 16384}; /* 0.35, 0.12, 0.25 m */
static const drogue_model no_inner = {22938, 0, 0};

/* A circle of 100 px at 4 m: the inner part is expected with 100 * 0.12 / 0.35 * 4 / 4.25 = 32.3 px, 3269 px of area. */
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
    r.inner.area_px = 3269;
    r.inner.threshold = 60;
    r.inner.contrast = 40;
    r.inner.spread_px_q16 = DROGUE_Q16(1, 10);
    r.orientation_resolved = 1;
    return r;
}

START_TEST(limits_of_sure)
{
    drogue_result r = measured();
    ck_assert(drogue_result_sure(&r, &model));
    r.cover_q16 = DROGUE_Q16(61, 100);
    ck_assert(drogue_result_sure(&r, &model));
    r.inner.area_px = 2880; /* 30.3 px: off by 2.0, a twenty-fifth and 0.3 are 1.6 */
    ck_assert(!drogue_result_sure(&r, &model));
    r.inner.area_px = 2980; /* 30.8 px: off by 1.5 */
    ck_assert(drogue_result_sure(&r, &model));
    r.cover_q16 = DROGUE_Q16(59, 100);
    ck_assert(!drogue_result_sure(&r, &model));
    r.cover_q16 = DROGUE_Q16(74, 100);
    r.orientation_resolved = 0;
    ck_assert(!drogue_result_sure(&r, &model));
    r.cover_q16 = DROGUE_Q16(76, 100);
    ck_assert(drogue_result_sure(&r, &model));
    r.orientation_resolved = 1; /* though the outline contradicts it: that does not count */
    r.doubt_q16 = DROGUE_Q16(1, 64);
    r.cover_q16 = DROGUE_Q16(74, 100);
    ck_assert(!drogue_result_sure(&r, &model));
    r.doubt_q16--;
    ck_assert(drogue_result_sure(&r, &model));
    r.doubt_q16 = 0;
    r.orientation_resolved = 0;
    r.cover_q16 = DROGUE_Q16(76, 100);
    r.inner.area_px = 4100; /* 36.1 px: off by 3.9, a tenth and 0.6 are 3.8 */
    ck_assert(!drogue_result_sure(&r, &model));
    r.inner.area_px = 2600; /* 28.8 px: off by 3.5 */
    ck_assert(drogue_result_sure(&r, &model));
    r.orientation_resolved = 1;
    ck_assert(drogue_result_sure(&r, &model));
    r.doubt_q16 = DROGUE_Q16(1, 8);
    ck_assert(drogue_result_sure(&r, &model));
    r.doubt_q16++; /* it may be something else */
    ck_assert(!drogue_result_sure(&r, &model));
    r.doubt_q16 = 0;
    r.has_inner = 0;
    ck_assert(!drogue_result_sure(&r, &model));
}
END_TEST

/* So exactly of its size and so sharp, and it decides: then half of the outline will do. */
START_TEST(a_witness)
{
    drogue_result r = measured();
    r.cover_q16 = DROGUE_Q16(1, 2) - 1;
    ck_assert(!drogue_result_sure(&r, &model));
    r.cover_q16++;
    ck_assert(drogue_result_sure(&r, &model));
    r.inner.area_px = 3409; /* 32.94 px: off by 0.68, a 64th and 0.2 are 0.7 */
    ck_assert(drogue_result_sure(&r, &model));
    r.inner.area_px = 3417; /* 32.98 px: off by 0.72 */
    ck_assert(!drogue_result_sure(&r, &model));
    r.inner.area_px = 3269;
    r.inner.spread_px_q16 = DROGUE_Q16(1, 2); /* it need not be quite sharp */
    ck_assert(drogue_result_sure(&r, &model));
    r.inner.spread_px_q16++;
    ck_assert(!drogue_result_sure(&r, &model));
    r.inner.spread_px_q16 = DROGUE_Q16(1, 10);
    r.orientation_resolved = 0;
    ck_assert(!drogue_result_sure(&r, &model));
    r.orientation_resolved = 1;
    r.doubt_q16 = DROGUE_Q16(1, 64);
    ck_assert(!drogue_result_sure(&r, &model));
    r.doubt_q16 = 0;
    r.ellipse.a_px_q16 = r.ellipse.b_px_q16 = DROGUE_Q16(154, 10); /* where 4.97 px are expected */
    r.inner.area_px = 78;
    ck_assert(!drogue_result_sure(&r, &model));
    r.ellipse.a_px_q16 = r.ellipse.b_px_q16 = DROGUE_Q16(156, 10); /* 5.03 px */
    ck_assert(drogue_result_sure(&r, &model));
}
END_TEST

START_TEST(dark_and_sharp)
{
    drogue_result r = measured();
    r.inner.area_px = 3100; /* 31.4 px, off by 0.9: no witness */
    r.inner.spread_px_q16 = DROGUE_Q16(31, 100);
    ck_assert(drogue_result_sure(&r, &model)); /* it decides, has its size, and the cover is 0.9 */
    r.cover_q16 = DROGUE_Q16(89, 100);
    ck_assert(!drogue_result_sure(&r, &model));
    r.inner.spread_px_q16 = DROGUE_Q16(29, 100);
    ck_assert(drogue_result_sure(&r, &model));
    r.orientation_resolved = 0;
    ck_assert(drogue_result_sure(&r, &model));
    r.inner.area_px = 2880; /* 30.3 px, off by 2.0: only near its size */
    r.inner.spread_px_q16 = DROGUE_Q16(31, 100);
    r.cover_q16 = DROGUE_Q16_ONE;
    ck_assert(!drogue_result_sure(&r, &model));
    r.quality.reliability_q16 = DROGUE_Q16(989, 1000);
    ck_assert(!drogue_result_sure(&r, &model));
    r.quality.reliability_q16 = DROGUE_Q16(991, 1000); /* the outline is whole, */
    ck_assert(!drogue_result_sure(&r, &model));
    r.orientation_resolved = 1; /* and the disc decides, though outline and disc contradict each other */
    r.doubt_q16 = DROGUE_Q16(1, 64);
    ck_assert(drogue_result_sure(&r, &model));
    r.cover_q16 = DROGUE_Q16(31, 32) - 1;
    ck_assert(!drogue_result_sure(&r, &model));
    r.cover_q16 = DROGUE_Q16(31, 32);
    ck_assert(drogue_result_sure(&r, &model));
    r.quality.reliability_q16 = DROGUE_Q16(989, 1000); /* or hardly one */
    ck_assert(!drogue_result_sure(&r, &model));
    r.quality.reliability_q16 = DROGUE_Q16(991, 1000);
    r.inner.area_px = 4100; /* and the disc near to its size */
    ck_assert(!drogue_result_sure(&r, &model));
    r.ellipse.a_px_q16 = r.ellipse.b_px_q16 = DROGUE_Q16(154, 10); /* where 4.97 px, 77 px of area, are expected */
    r.inner.area_px = 77;
    ck_assert(!drogue_result_sure(&r, &model));
    r.ellipse.a_px_q16 = r.ellipse.b_px_q16 = DROGUE_Q16(156, 10); /* 5.03 px */
    ck_assert(drogue_result_sure(&r, &model));
    r = measured();
    r.inner.threshold = 130;
    r.inner.contrast = 33;
    ck_assert(drogue_result_sure(&r, &model));
    r.inner.contrast = 32;
    ck_assert(!drogue_result_sure(&r, &model));
}
END_TEST

/* A disc that is too large, as shade about it makes it: sharp, and it decides. */
START_TEST(in_shade)
{
    drogue_result r = measured();
    r.inner.area_px = 4500; /* 37.8 px for 32.3 */
    r.cover_q16 = DROGUE_Q16(3, 4);
    r.doubt_q16 = DROGUE_Q16(3, 10);
    ck_assert(drogue_result_sure(&r, &model));
    r.doubt_q16++;
    ck_assert(!drogue_result_sure(&r, &model));
    r.doubt_q16 = DROGUE_Q16(1, 10); /* too large, whatever doubt that gives */
    ck_assert(drogue_result_sure(&r, &model));
    r.cover_q16--;
    ck_assert(!drogue_result_sure(&r, &model));
    r.cover_q16 = DROGUE_Q16_ONE;
    r.inner.spread_px_q16 = DROGUE_Q16(3, 10) + 1;
    ck_assert(!drogue_result_sure(&r, &model));
    r.inner.spread_px_q16 = DROGUE_Q16(3, 10);
    r.orientation_resolved = 0;
    ck_assert(!drogue_result_sure(&r, &model));
    r.orientation_resolved = 1;
    r.inner.area_px = 2100; /* 25.9 px: no shade makes it smaller */
    ck_assert(!drogue_result_sure(&r, &model));
    r.inner.area_px = 70;
    r.ellipse.a_px_q16 = r.ellipse.b_px_q16 = DROGUE_Q16(108, 10); /* where 3.48 px are expected */
    ck_assert(!drogue_result_sure(&r, &model));
    r.ellipse.a_px_q16 = r.ellipse.b_px_q16 = DROGUE_Q16(109, 10); /* 3.52 px; it has 4.72 */
    ck_assert(drogue_result_sure(&r, &model));
}
END_TEST

/* A large disc of its size, beside its place: nearly as sharp, in an outline that is nearly whole. */
START_TEST(beside_its_place)
{
    drogue_result r = measured();
    r.doubt_q16 = DROGUE_Q16(1, 64);
    r.cover_q16 = DROGUE_Q16(7, 8);
    r.inner.spread_px_q16 = DROGUE_Q16(1, 2);
    ck_assert(drogue_result_sure(&r, &model));
    r.orientation_resolved = 0;
    ck_assert(drogue_result_sure(&r, &model));
    r.cover_q16--;
    ck_assert(!drogue_result_sure(&r, &model));
    r.cover_q16++;
    r.inner.spread_px_q16++;
    ck_assert(!drogue_result_sure(&r, &model));
    r.inner.spread_px_q16--;
    r.doubt_q16++;
    ck_assert(!drogue_result_sure(&r, &model));
    r.doubt_q16--;
    r.inner.area_px = 2980; /* 30.8 px: off by 1.5, a twenty-fifth and 0.3 are 1.6 */
    ck_assert(drogue_result_sure(&r, &model));
    r.inner.area_px = 2880; /* 30.3 px */
    ck_assert(!drogue_result_sure(&r, &model));
    r.inner.area_px = 254;                                         /* 8.99 px */
    r.ellipse.a_px_q16 = r.ellipse.b_px_q16 = DROGUE_Q16(278, 10); /* where 8.97 px are expected */
    ck_assert(!drogue_result_sure(&r, &model));
    r.ellipse.a_px_q16 = r.ellipse.b_px_q16 = DROGUE_Q16(280, 10); /* 9.04 px */
    ck_assert(drogue_result_sure(&r, &model));
}
END_TEST

START_TEST(behind_or_beside_the_camera_nothing_is_sure)
{
    drogue_result r = measured();
    drogue_model near = model;
    r.pose.position_m_q16[2] = 0;
    ck_assert(!drogue_result_sure(&r, &model));
    r.pose.position_m_q16[2] = DROGUE_Q16(2, 10);
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
    ck_assert_int_eq(drogue_acquire(&r, &search, &w.workspace, &setup, &image, NULL), DROGUE_OK);
    MUST(abs(r.ellipse.xc_px_q16 - 120 * 65536) < 32768 && abs(r.ellipse.a_px_q16 - 60 * 65536) < 65536, "x %d, a %d",
         (int)r.ellipse.xc_px_q16, (int)r.ellipse.a_px_q16);
    memset(pixels, 128, sizeof pixels); /* nothing sighted: the part itself is measured, and says why there is none */
    ck_assert_int_ne(drogue_acquire(&r, &search, &w.workspace, &setup, &image, NULL), DROGUE_OK);
    ck_assert_int_ne(r.status, DROGUE_OK);
    image.stride = SIDE - 1;
    ck_assert_int_eq(drogue_acquire(&r, &search, &w.workspace, &setup, &image, NULL), DROGUE_E_ARGUMENT);
    image.stride = SIDE;
    image.data = NULL;
    ck_assert_int_eq(drogue_acquire(&r, &search, &w.workspace, &setup, &image, NULL), DROGUE_E_ARGUMENT);
    test_workspace_free(&w);
}
END_TEST

SUITE_MAIN("sure", limits_of_sure, a_witness, dark_and_sharp, in_shade, beside_its_place,
           behind_or_beside_the_camera_nothing_is_sure, without_an_inner_part_cover_and_reliability_decide,
           acquire_without_an_inner_part)
