/* SPDX-License-Identifier: Apache-2.0 */
/* Suppression, direction classes and subpixel offsets: exhaustively where the domain allows. */
#include "suite.h"

#include "drogue/canny.h"
#include "drogue/gradient.h"

static const int32_t step[4][2] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}}; /* x, y towards 'after', by sector */

static int model_sector(int32_t gx, int32_t gy)
{
    int32_t ax = abs(gx), ay = abs(gy);
    if ((int64_t)ay * 32768 < (int64_t)ax * 13573) {
        return DROGUE_SECTOR_HORIZONTAL;
    }
    if ((int64_t)ay * 32768 > (int64_t)ax * (13573 + 65536)) {
        return DROGUE_SECTOR_VERTICAL;
    }
    return (gx < 0) == (gy < 0) ? DROGUE_SECTOR_DIAGONAL : DROGUE_SECTOR_ANTIDIAGONAL;
}

/* Classes of (2), counted from the axes: on an axis the class that includes it. */
static uint32_t model_class(int32_t gx, int32_t gy_up)
{
    if (gx > 0) {
        return gy_up > 0 ? 0 : 3;
    }
    if (gx < 0) {
        return gy_up >= 0 ? 1 : 2;
    }
    return gy_up > 0 ? 0 : gy_up < 0 ? 2 : 3;
}

/* The sector as row loops find it; the two slanted ones by the signs. */
static int sector_in_16_bits(int32_t gx, int32_t gy)
{
    const int16_t ax = (int16_t)abs(gx), ay = (int16_t)abs(gy);
    const int16_t tangent = (int16_t)drogue_canny_tangent((uint16_t)ax);
    if (ay <= tangent) {
        return DROGUE_SECTOR_HORIZONTAL;
    }
    if (ay > (int16_t)(tangent + 2 * ax)) {
        return DROGUE_SECTOR_VERTICAL;
    }
    return (gx ^ gy) < 0 ? DROGUE_SECTOR_ANTIDIAGONAL : DROGUE_SECTOR_DIAGONAL;
}

START_TEST(sector_and_class_of_every_gradient)
{
    int32_t gx, gy;
    for (gy = -1020; gy <= 1020; gy++) {
        for (gx = -1020; gx <= 1020; gx++) {
            MUST((int)drogue_canny_sector((int16_t)gx, (int16_t)gy) == model_sector(gx, gy), "sector of %d %d", gx, gy);
            MUST((gx == 0 && gy == 0) || sector_in_16_bits(gx, gy) == model_sector(gx, gy), "16 bits, %d %d", gx, gy);
            MUST(drogue_direction_class((int16_t)gx, (int16_t)gy) == model_class(gx, -gy), "class of %d %d", gx, gy);
        }
    }
}
END_TEST

static int32_t model_offset(int32_t before, int32_t m, int32_t after)
{
    int32_t curvature = 2 * m - before - after, offset;
    if (curvature == 0) {
        return 0;
    }
    offset = (int32_t)floor(16.0 * (after - before) / curvature + 0.5);
    return offset > 15 ? 15 : offset < -15 ? -15 : offset;
}

/* The offset bit by bit, as hardware finds it. */
static int32_t offset_by_steps(int32_t before, int32_t m, int32_t after)
{
    drogue_canny_vertex v = drogue_canny_vertex_begin(before, m, after);
    int32_t bit;
    for (bit = 4; bit >= 0; bit--) {
        drogue_canny_vertex_step(&v, bit);
    }
    return drogue_canny_vertex_offset(&v);
}

START_TEST(offset_of_every_maximum)
{
    uint64_t rng = 1;
    int32_t before, m, after, i;
    for (m = 0; m <= 120; m++) {
        for (before = 0; before <= m; before++) {
            for (after = 0; after <= m; after++) {
                MUST(drogue_canny_offset_q5(before, m, after) == model_offset(before, m, after), "offset %d %d %d",
                     before, m, after);
            }
        }
    }
    for (i = 0; i < 1000000; i++) {
        m = rng_range(&rng, 1, 2040);
        before = i & 1 ? m - 1 : rng_range(&rng, 0, m);
        after = i & 2 ? m : rng_range(&rng, 0, m);
        MUST(drogue_canny_offset_q5(before, m, after) == model_offset(before, m, after), "offset %d %d %d", before, m,
             after);
        MUST(offset_by_steps(before, m, after) == model_offset(before, m, after), "steps %d %d %d", before, m, after);
    }
    ck_assert_int_eq(drogue_canny_offset_q5(2039, 2040, 2040), 15);
    ck_assert_int_eq(drogue_canny_offset_q5(2040, 2040, 2039), -15);
    ck_assert_int_eq(drogue_canny_offset_q5(7, 7, 7), 0);
}
END_TEST

START_TEST(maximum_takes_the_first_of_two_equals)
{
    int sector;
    for (sector = 0; sector < 4; sector++) {
        int straight = sector == DROGUE_SECTOR_HORIZONTAL || sector == DROGUE_SECTOR_VERTICAL;
        ck_assert_int_eq(!!drogue_canny_is_maximum((drogue_sector)sector, 4, 5, 4), 1);
        ck_assert_int_eq(!!drogue_canny_is_maximum((drogue_sector)sector, 4, 5, 5), straight);
        ck_assert_int_eq(!!drogue_canny_is_maximum((drogue_sector)sector, 5, 5, 4), 0);
        ck_assert_int_eq(!!drogue_canny_is_maximum((drogue_sector)sector, 4, 5, 6), 0);
        ck_assert_int_eq(drogue_canny_step_x((drogue_sector)sector), step[sector][0]);
        ck_assert_int_eq(drogue_canny_step_y((drogue_sector)sector), step[sector][1]);
    }
}
END_TEST

static int model_maximum(const uint16_t *const rows[3], int32_t gx, int32_t gy, int32_t x, int32_t width)
{
    int sector = model_sector(gx, gy);
    int32_t dx = step[sector][0], dy = step[sector][1], m = rows[1][x];
    int32_t before = x - dx >= 0 && x - dx < width ? rows[1 - dy][x - dx] : 0;
    int32_t after = x + dx >= 0 && x + dx < width ? rows[1 + dy][x + dx] : 0;
    return m > before && m >= after && (sector < 2 || m != after);
}

static void check_row(int32_t width, int32_t levels, uint64_t *rng)
{
    guarded m = guarded_alloc(3u * (size_t)width * sizeof(uint16_t));
    uint16_t *magnitude = m.data;
    const uint16_t *rows[3];
    int32_t x;
    rows[0] = magnitude;
    rows[1] = magnitude + width;
    rows[2] = magnitude + 2 * width;
    for (x = 0; x < 3 * width; x++) { /* few levels: many ties */
        magnitude[x] = (uint16_t)rng_range(rng, 0, levels);
    }
    for (x = 0; x < width; x++) {
        const int16_t gx = (int16_t)rng_range(rng, -1020, 1020), gy = (int16_t)rng_range(rng, -1020, 1020);
        const drogue_sector sector = drogue_canny_sector(gx, gy);
        int32_t before, after;
        drogue_canny_neighbours(&before, &after, sector, rows, x, width);
        MUST(!!drogue_canny_is_maximum(sector, before, rows[1][x], after) == model_maximum(rows, gx, gy, x, width),
             "width %d, x %d, gradient %d %d", width, x, gx, gy);
    }
    guarded_free(&m);
}

START_TEST(rows_of_every_small_width)
{
    uint64_t rng = 2;
    int32_t i;
    for (i = 0; i < 20000; i++) {
        check_row(1 + i % 17, i & 1 ? 3 : 2040, &rng);
    }
    check_row(DROGUE_MAX_SIDE, 5, &rng);
}
END_TEST

SUITE_MAIN("canny", sector_and_class_of_every_gradient, offset_of_every_maximum, maximum_takes_the_first_of_two_equals,
           rows_of_every_small_width)
