/* SPDX-License-Identifier: Apache-2.0 */
/* The second look at an outline that its region cuts: where it cannot be had, and when it is no better. */
#include "suite.h"

#include "drogue/drogue.h"
#include "drogue/inner.h"
#include "geometry.h"
#include "own_workspace.h"

enum { SIDE = 128 };

static const drogue_model bare = {22938, 0, 0};

/* A second look that would reach beyond the coordinates' 32767 px is not had, and the first one stands. */
START_TEST(second_look_beyond_the_coordinates)
{
    enum { LONG = 32900, AT = INT16_MAX - SIDE };
    static uint8_t wide[LONG * SIDE];
    static const drogue_region all = {AT, 0, SIDE, SIDE};
    const drogue_image view = {wide, LONG, SIDE, LONG};
    const drogue_camera camera = pinhole(400, 400, 64, 64);
    test_workspace t = test_workspace_of(512, 4096, 4096, 512);
    drogue_config config;
    drogue_result r, first;
    int32_t xc, x, y, regions = 0, better = 0;
    drogue_config_default(&config);
    for (xc = 40; xc <= 90; xc += 2) {
        memset(wide, 200, sizeof wide);
        for (y = 0; y < SIDE; y++) {
            for (x = 0; x < SIDE; x++) {
                const double inside = 40.5 - hypot(x - xc, y - 60);
                wide[y * LONG + AT + x] = (uint8_t)(200 - 140 * fmin(fmax(inside, 0), 1));
            }
        }
        (void)drogue_measure(&r, &t.workspace, &(drogue_setup){&camera, &bare, &config}, &view, &all);
        regions += r.second_look == DROGUE_SECOND_REGION;
        better += r.second_look == DROGUE_SECOND_BETTER;
        if (r.second_look == DROGUE_SECOND_REGION) {
            config.recentre_cover_q16 = 0;
            (void)drogue_measure(&first, &t.workspace, &(drogue_setup){&camera, &bare, &config}, &view, &all);
            drogue_config_default(&config);
            MUST(first.status == r.status && memcmp(&first.ellipse, &r.ellipse, sizeof r.ellipse) == 0,
                 "at %d: %s, not %s", (int)xc, drogue_status_name(r.status), drogue_status_name(first.status));
        }
        MUST(r.second_look != DROGUE_SECOND_BETTER || r.region.x_px + r.region.width_px <= INT16_MAX, "at %d", (int)xc);
    }
    ck_assert_int_gt(regions, 2);
    ck_assert_int_gt(better, 2);
    test_workspace_free(&t);
}
END_TEST

/* A dark ellipse anywhere about the middle, behind up to four boards, with noise. */
static void draw_partly_hidden(uint8_t pixels[SIDE * SIDE], uint64_t rng)
{
    const double xc = rng_real(&rng, 40, 88), yc = rng_real(&rng, 40, 88), a = rng_real(&rng, 28, 50),
                 b = a * rng_real(&rng, 0.6, 1), turn = rng_real(&rng, -1.5, 1.5);
    const int boards = rng_range(&rng, 0, 4);
    int board[4][5] = {{0}}, x, y, k;
    double noise;
    for (k = 0; k < boards; k++) {
        board[k][0] = rng_range(&rng, 0, 110);
        board[k][1] = rng_range(&rng, 0, 110);
        board[k][2] = board[k][0] + rng_range(&rng, 4, 50);
        board[k][3] = board[k][1] + rng_range(&rng, 4, 50);
        board[k][4] = rng_range(&rng, 40, 220);
    }
    noise = rng_real(&rng, 0, 6);
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            const double u = cos(turn) * (x - xc) + sin(turn) * (y - yc),
                         v = cos(turn) * (y - yc) - sin(turn) * (x - xc);
            double grey = 200 - 140 * fmin(fmax((1 - hypot(u / a, v / b)) * b + 0.5, 0), 1);
            for (k = 0; k < boards; k++) {
                if (x >= board[k][0] && x < board[k][2] && y >= board[k][1] && y < board[k][3]) {
                    grey = board[k][4];
                }
            }
            pixels[y * SIDE + x] = (uint8_t)fmin(fmax(grey + noise * rng_normal(&rng), 0), 255);
        }
    }
}

/* The second look may see less of an outline than the first did: then the first one stands. */
START_TEST(second_look_of_less_cover)
{
    static const uint64_t seeds[] = {47, 1172, 1820, 4236, 6339, 6976, 7113, 8497}; /* those of 8500 where it does */
    static const drogue_region all = {0, 0, SIDE, SIDE};
    static uint8_t pixels[SIDE * SIDE];
    const drogue_image image = {pixels, SIDE, SIDE, SIDE};
    const drogue_camera camera = pinhole(400, 400, 64, 64);
    test_workspace t = test_workspace_of(512, 8192, 8192, 512);
    drogue_config config, once;
    size_t i;
    int less = 0;
    drogue_config_default(&config);
    once = config;
    once.recentre_cover_q16 = 0;
    for (i = 0; i < sizeof seeds / sizeof seeds[0]; i++) {
        drogue_result first, r;
        draw_partly_hidden(pixels, seeds[i] * 7919 + 1);
        (void)drogue_measure(&first, &t.workspace, &(drogue_setup){&camera, &bare, &once}, &image, &all);
        (void)drogue_measure(&r, &t.workspace, &(drogue_setup){&camera, &bare, &config}, &image, &all);
        MUST(first.status == DROGUE_OK && r.status == DROGUE_OK, "scene %d: %s", (int)i, drogue_status_name(r.status));
        MUST(r.cover_q16 >= first.cover_q16, "scene %d: cover %g after %g", (int)i, real_of_q16(r.cover_q16),
             real_of_q16(first.cover_q16));
        less += r.second_look == DROGUE_SECOND_NO_MORE;
    }
    ck_assert_int_gt(less, 4);
    test_workspace_free(&t);
}
END_TEST

/* Thresholds lower than the configured ones find more than a table holds: another workspace would give another result. */
START_TEST(too_little_room_for_the_lower_thresholds)
{
    static uint8_t pixels[SIDE * SIDE];
    const drogue_image image = {pixels, SIDE, SIDE, SIDE};
    const drogue_region all = {0, 0, SIDE, SIDE};
    const drogue_camera camera = pinhole(400, 400, 64, 64);
    const uint32_t edges[2] = {64, 4096};
    drogue_config config;
    int32_t x, y;
    int k;
    drogue_config_default(&config);
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            pixels[y * SIDE + x] = (uint8_t)(120 - 8 * fmin(fmax(50.5 - hypot(x - 63.5, y - 63.5), 0), 1));
        }
    }
    for (k = 0; k < 2; k++) {
        test_workspace t = test_workspace_of(SIDE, edges[k], 4096, 512);
        drogue_result r;
        (void)drogue_measure(&r, &t.workspace, &(drogue_setup){&camera, &bare, &config}, &image, &all);
        MUST(r.status == (k == 0 ? DROGUE_E_NO_EDGES : DROGUE_OK), "%u edges: %s", (unsigned)edges[k],
             drogue_status_name(r.status));
        MUST(r.second_look == (k == 0 ? DROGUE_SECOND_FULL : DROGUE_SECOND_NONE), "%u edges: second look %d",
             (unsigned)edges[k], (int)r.second_look);
        test_workspace_free(&t);
    }
}
END_TEST

/* A disc that the region cuts, in noise that fills the labels, and no room for a wider region: higher thresholds find part of
 * it, which 'room' would call whole. */
START_TEST(raised_thresholds_do_not_hide_a_cut)
{
    static uint8_t pixels[2 * SIDE * 2 * SIDE];
    const drogue_image image = {pixels, 2 * SIDE, 2 * SIDE, 2 * SIDE};
    const drogue_region region = {64, 64, 118, 118};
    const drogue_camera camera = pinhole(1000, 1000, 128, 128);
    int cut = 0, whole = 0;
    drogue_config config;
    int k;
    drogue_config_default(&config);
    config.min_cover_q16 = DROGUE_Q16(3, 10); /* what is cut may be less */
    for (k = 0; k < 38; k++) {
        const double off = k % 2 == 0 ? 0 : -9, radius = k % 2 == 0 ? 46 : 64.8;
        test_workspace t = test_workspace_of(118, 2000, 220, 96);
        uint64_t rng = (uint64_t)k;
        drogue_result r;
        int32_t x, y;
        for (y = 0; y < 2 * SIDE; y++) {
            for (x = 0; x < 2 * SIDE; x++) {
                const double within = radius + 0.5 - hypot(x - 122.6 - 5 * off / 3, y - 123.1 - off);
                const double grey = 60 + 120 * fmin(fmax(within, 0), 1) + 15.6 * rng_normal(&rng);
                pixels[y * 2 * SIDE + x] = (uint8_t)lround(fmin(fmax(grey, 0), 255));
            }
        }
        (void)drogue_measure(&r, &t.workspace, &(drogue_setup){&camera, &bare, &config}, &image, &region);
        if (r.status == DROGUE_OK && r.tried >= DROGUE_TRIED_NOISE) {
            whole += r.second_look == DROGUE_SECOND_ROOM;
            cut += r.second_look == DROGUE_SECOND_FULL || r.second_look == DROGUE_SECOND_TOO_WIDE;
            MUST((r.second_look == DROGUE_SECOND_ROOM) == (k % 2 == 0), "%d: %s, cover %g", k,
                 drogue_second_look_name(r.second_look), real_of_q16(r.cover_q16));
        }
        test_workspace_free(&t);
    }
    ck_assert_int_gt(whole, 10);
    ck_assert_int_gt(cut, 10);
}
END_TEST

/* A disc that is too large for the wall's edge about it and of its size for a rim that is hardly brighter than the ground,
 * but no room for the rim's points. */
START_TEST(too_little_room_for_points_along_rays)
{
    static uint8_t pixels[SIDE * SIDE];
    static const drogue_model model = {DROGUE_Q16(35, 100), DROGUE_Q16(14, 100), 0};
    const drogue_image image = {pixels, SIDE, SIDE, SIDE};
    const drogue_region region = {12, 12, 104, 104};
    const drogue_camera camera = pinhole(400, 400, 64, 64);
    const uint32_t edges[3] = {DROGUE_INNER_BEYOND_POINTS - 1, DROGUE_INNER_BEYOND_POINTS, 4096};
    drogue_result r[3];
    drogue_config config;
    uint64_t rng = 5;
    int32_t x, y;
    int k;
    drogue_config_default(&config);
    config.canny_least = config.canny_high; /* thresholds of the noise would fill a table */
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            const double d = hypot(x - 64.2, y - 63.9);
            pixels[y * SIDE + x] = (uint8_t)lround(180 + 3.5 * erfc((d - 45) / 1.1) - 30 * erfc((d - 41) / 1.1) -
                                                   30 * erfc((d - 18) / 1.1) + rng_real(&rng, -6, 6));
        }
    }
    for (k = 0; k < 3; k++) {
        test_workspace t = test_workspace_of(SIDE, edges[k], 4096, 512);
        (void)drogue_measure(&r[k], &t.workspace, &(drogue_setup){&camera, &model, &config}, &image, &region);
        ck_assert_int_eq(r[k].status, DROGUE_OK);
        MUST(r[k].second_look == (k == 0 ? DROGUE_SECOND_ROOM : DROGUE_SECOND_NONE), "%u edges: %d", (unsigned)edges[k],
             (int)r[k].second_look);
        MUST((r[k].tried == DROGUE_TRIED_RAYS) == (k > 0), "%u edges: %d stands", (unsigned)edges[k], (int)r[k].tried);
        MUST(fabs(real_of_q16(r[k].ellipse.a_px_q16) - (k == 0 ? 41 : 45)) < 0.6, "%u edges: a %g", (unsigned)edges[k],
             real_of_q16(r[k].ellipse.a_px_q16));
        test_workspace_free(&t);
    }
    ck_assert_int_eq(memcmp(&r[1], &r[2], sizeof r[1]), 0);
}
END_TEST

SUITE_MAIN("second_look", second_look_beyond_the_coordinates, second_look_of_less_cover,
           too_little_room_for_the_lower_thresholds, too_little_room_for_points_along_rays,
           raised_thresholds_do_not_hide_a_cut)
