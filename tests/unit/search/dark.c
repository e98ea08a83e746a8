/* SPDX-License-Identifier: Apache-2.0 */
/* A dark disc by itself: its radius, its score, and on how many rays it must be seen. */
#include "suite.h"

#include "dark.h"

enum { SIDE = 40, MIDDLE = 20, DARK = 10, BRIGHT = 190 };

static uint8_t cells[DROGUE_SEARCH_ROWS][SIDE];
static drogue_search_level level = {.rows = cells[0], .width = SIDE, .rows_in = SIDE};
static drogue_search_disc disc = {MIDDLE, MIDDLE, 86, BRIGHT - DARK};

/* Cells by how much of them lies within an ellipse about the disc's middle; bright only where a ray's number is below
 * 'seen'. */
static void draw(double a, double b, int seen)
{
    int x, y, i;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            const double angle = atan2(y - MIDDLE, x - disc.x) * 8 / acos(-1.0);
            int inside = 0;
            for (i = 0; i < 256; i++) {
                inside +=
                    pow((x - disc.x + (i % 16 - 7.5) / 16) / a, 2) + pow((y - MIDDLE + (i / 16 - 7.5) / 16) / b, 2) < 1;
            }
            cells[y][x] = (uint8_t)(BRIGHT + (DARK - BRIGHT) * inside / 256);
            if (fmod(angle + 16.5, 16) >= seen) {
                cells[y][x] = DARK;
            }
        }
    }
}

START_TEST(radius_and_score)
{
    double radius;
    for (radius = 1.5; radius < 9; radius += 0.25) {
        const uint32_t share_q8 = 256 * 180 / (190 + 8);
        drogue_rim found = {1, 1, 0, 0};
        draw(radius, radius, 16);
        MUST(drogue_dark_find(&found, &level, &disc, 0) == 1, "%f: none", radius);
        MUST(found.x_q4 == 0 && found.y_q4 == 0 && fabs(found.radius_q4 / 16.0 - radius) < 0.6, "%f: %f", radius,
             found.radius_q4 / 16.0);
        MUST(found.score == share_q8 * 256 || (radius < 3 && found.score >= share_q8 * 144), "%f: score %u", radius,
             (unsigned)found.score);
    }
}
END_TEST

START_TEST(more_than_the_least)
{
    drogue_rim found;
    draw(5, 5, 14);
    ck_assert_int_eq(drogue_dark_find(&found, &level, &disc, 0), 1);
    ck_assert_uint_eq(found.score, 256 * 180 / (190 + 8) * 14 * 14);
    ck_assert_int_eq(drogue_dark_find(&found, &level, &disc, found.score - 1), 1);
    ck_assert_int_eq(drogue_dark_find(&found, &level, &disc, found.score), 0);
    ck_assert_int_eq(drogue_dark_find(&found, &level, &disc, 256 * 180 / (190 + 8) * 16 * 16), 0);
}
END_TEST

/* Twelve rays must end, together; beyond the level and beyond two radii of the ring nothing is seen. */
START_TEST(seen_on_twelve_rays)
{
    drogue_rim found;
    draw(5, 5, 12);
    ck_assert_int_eq(drogue_dark_find(&found, &level, &disc, 0), 1);
    draw(5, 5, 11);
    ck_assert_int_eq(drogue_dark_find(&found, &level, &disc, 0), 0);
    draw(6, 4.6, 16);
    ck_assert_int_eq(drogue_dark_find(&found, &level, &disc, 0), 1);
    draw(9, 3.5, 16);
    ck_assert_int_eq(drogue_dark_find(&found, &level, &disc, 0), 0);
    draw(10.4, 10.4, 16);
    ck_assert_int_eq(drogue_dark_find(&found, &level, &disc, 0), 0);
    draw(5, 5, 16);
    level.rows_in = MIDDLE + 3; /* five rays leave it */
    ck_assert_int_eq(drogue_dark_find(&found, &level, &disc, 0), 0);
    level.rows_in = SIDE;
    for (disc.x = 3; disc.x <= SIDE - 4; disc.x += SIDE - 7) {
        draw(5, 5, 16);
        ck_assert_int_eq(drogue_dark_find(&found, &level, &disc, 0), 0);
    }
    for (disc.x = 6; disc.x <= SIDE - 7; disc.x++) {
        draw(5, 5, 16);
        ck_assert_int_eq(drogue_dark_find(&found, &level, &disc, 0), 1);
    }
    disc.x = MIDDLE;
}
END_TEST

SUITE_MAIN("dark", radius_and_score, more_than_the_least, seen_on_twelve_rays)
