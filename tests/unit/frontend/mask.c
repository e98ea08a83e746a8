/* SPDX-License-Identifier: Apache-2.0 */
/* The ring mask against distances, with the points that lie exactly on a border. */
#include "suite.h"

#include "drogue/mask.h"

static void check_point(const drogue_mask *mask, int32_t x, int32_t y)
{
    long double d = hypotl(x - mask->centre2_x / 2.0L, y - mask->centre2_y / 2.0L);
    long double third = mask->longest_px / 3.0L, half = mask->longest_px / 2.0L;
    long double nearest = fminl(fabsl(d - third), fabsl(d - half));
    if (nearest > 1e-9L) {
        MUST(!!drogue_mask_in_ring(mask, x, y) == (d > third && d < half), "ring of %d at %d %d", mask->longest_px, x,
             y);
    }
}

START_TEST(every_pixel_of_small_regions)
{
    int32_t width, height, x, y;
    for (height = 1; height <= 24; height++) {
        for (width = 1; width <= 24; width++) {
            drogue_mask mask = drogue_mask_of_size(width, height);
            ck_assert_int_eq(mask.longest_px, width > height ? width : height);
            for (y = -2; y < height + 2; y++) {
                for (x = -2; x < width + 2; x++) {
                    check_point(&mask, x, y);
                }
            }
        }
    }
}
END_TEST

START_TEST(large_regions)
{
    uint64_t rng = 1;
    int32_t i;
    for (i = 0; i < 1000000; i++) {
        drogue_mask mask;
        mask.longest_px = rng_range(&rng, 1, 1 << (1 + i % 20));
        mask.centre2_x = rng_range(&rng, -(1 << 21), 1 << 21);
        mask.centre2_y = rng_range(&rng, -(1 << 21), 1 << 21);
        check_point(&mask, mask.centre2_x / 2 + rng_range(&rng, -mask.longest_px, mask.longest_px),
                    mask.centre2_y / 2 + rng_range(&rng, -mask.longest_px, mask.longest_px));
    }
}
END_TEST

START_TEST(borders_belong_to_the_mask)
{
    const drogue_mask even = {0, 0, 30};  /* radii 10 and 15 about (0, 0) */
    const drogue_mask odd = {15, 15, 15}; /* radii 5 and 7.5 about (7.5, 7.5) */
    ck_assert(drogue_mask_in_ring(&even, 10, 0) && drogue_mask_in_ring(&even, -6, 8));
    ck_assert(drogue_mask_in_ring(&even, 15, 0) && drogue_mask_in_ring(&even, 9, -12));
    ck_assert(!drogue_mask_in_ring(&even, 9, 0));
    ck_assert(!drogue_mask_in_ring(&even, 16, 0) && !drogue_mask_in_ring(&even, 15, 1));
    ck_assert(!drogue_mask_in_ring(&odd, 15, 8) && drogue_mask_in_ring(&odd, 3, 13)); /* 4 * distance^2: 226, 202 */
    ck_assert(drogue_mask_in_ring(&odd, 12, 13));
}
END_TEST

START_TEST(whole_region_of_one_pixel)
{
    const drogue_mask mask = drogue_mask_of_size(1, 1);
    ck_assert(!drogue_mask_in_ring(&mask, 0, 0));
}
END_TEST

/* The columns of a row are those that are in the ring one by one; a stretch that is empty has no length. */
static void check_columns(drogue_ring_chords *chords, const drogue_mask *mask, int32_t y, int32_t width_px)
{
    drogue_columns c;
    int32_t x;
    drogue_mask_columns(&c, chords, mask, y, width_px);
    MUST(c.begin[0] <= c.end[0] && c.end[0] <= c.begin[1] && c.begin[1] <= c.end[1] && c.end[1] <= width_px,
         "ring of %d, row %d: %d %d %d %d", mask->longest_px, y, c.begin[0], c.end[0], c.begin[1], c.end[1]);
    for (x = 0; x < width_px; x++) {
        const int within = (x >= c.begin[0] && x < c.end[0]) || (x >= c.begin[1] && x < c.end[1]);
        MUST(within == !!drogue_mask_in_ring(mask, x, y), "ring of %d about %d %d at %d %d", mask->longest_px,
             mask->centre2_x, mask->centre2_y, x, y);
    }
}

START_TEST(columns_of_small_rings)
{
    drogue_mask mask;
    int32_t y;
    for (mask.longest_px = 1; mask.longest_px <= 40; mask.longest_px++) {
        for (mask.centre2_x = -50; mask.centre2_x <= 70; mask.centre2_x++) {
            for (mask.centre2_y = -45; mask.centre2_y <= 46; mask.centre2_y += 13) {
                drogue_ring_chords chords;
                drogue_ring_chords_of(&chords, &mask);
                for (y = 0; y < 25; y++) {
                    check_columns(&chords, &mask, y, 1 + (mask.longest_px + mask.centre2_x + y + 50) % 27);
                }
            }
        }
    }
}
END_TEST

START_TEST(columns_of_large_rings)
{
    static const int32_t ends[4] = {-(1 << 15), 0, 1, 1 << 15};
    uint64_t rng = 1;
    int32_t i;
    for (i = 0; i < 20000; i++) {
        drogue_mask mask;
        const int32_t width_px = rng_range(&rng, 1, DROGUE_MAX_SIDE);
        const int32_t y = rng_range(&rng, 0, DROGUE_MAX_SIDE - 1);
        drogue_ring_chords chords; /* from anywhere, then from near by, on either side */
        int32_t k;
        mask.longest_px = rng_range(&rng, 1, 1 << (1 + i % 20));
        mask.centre2_x = i % 5 == 0 ? ends[rng_range(&rng, 0, 3)] : rng_range(&rng, -(1 << 13), 1 << 13);
        mask.centre2_y = i % 7 == 0 ? ends[rng_range(&rng, 0, 3)] : rng_range(&rng, -(1 << 13), 1 << 13);
        drogue_ring_chords_of(&chords, &mask);
        chords.half_px[0] = rng_range(&rng, 0, 1 << (i % 21));
        chords.half_px[1] = rng_range(&rng, 0, 1 << (i % 21));
        check_columns(&chords, &mask, y, width_px);
        for (k = 0; k < 2; k++) {
            const int32_t near_by = chords.half_px[k] + rng_range(&rng, -10, 10);
            chords.half_px[k] = near_by < 0 ? 0 : near_by;
        }
        check_columns(&chords, &mask, y, width_px);
    }
}
END_TEST

SUITE_MAIN("mask", every_pixel_of_small_regions, large_regions, borders_belong_to_the_mask, whole_region_of_one_pixel,
           columns_of_small_rings, columns_of_large_rings)
