/* SPDX-License-Identifier: Apache-2.0 */
/* Row kernels of the front end, either form (DROGUE_ROWS_PLAIN), rows of eight pixels: each pixel is what its definition
 * makes of its window, so the two forms give the same; nothing is read or written beyond the line buffers. */
#ifndef ROW_KERNELS_H
#define ROW_KERNELS_H

#include "proof.h"

#if DROGUE_ROWS_PLAIN
#include "frontend/rows_plain.c"
#else
#include "frontend/maxima_lanes.c"
#include "frontend/rows_lanes.c"
#endif

enum { WIDTH = 8, HALF = (WIDTH + 7) / 8 * 4, ROWS = 5 };

/* Of the elements that a form uses: the model checker is slow where bytes are read as words. */
#if DROGUE_ROWS_PLAIN
typedef uint8_t smooth_element;
typedef uint16_t magnitude_element;
typedef int16_t slope_element;
#else
typedef uint32_t smooth_element;
typedef uint32_t magnitude_element;
typedef uint32_t slope_element;
#endif
static uint8_t raw[5 * (2 * HALF + 4)] __attribute__((aligned(4)));
static smooth_element smoothed[3 * 4 * (HALF + 2) / sizeof(smooth_element)];
static magnitude_element magnitudes_of_rows[4 * 4 * (HALF + 2) / sizeof(magnitude_element)];
static slope_element slopes[4 * HALF * sizeof(drogue_slope) / sizeof(slope_element)];
static uint8_t codes[4 * HALF];
static drogue_workspace workspace;
static drogue_frontend frontend;
static uint8_t pixels[ROWS][WIDTH];
static const drogue_columns all_columns = {{0, WIDTH}, {WIDTH, WIDTH}};

static void begin(void)
{
    int32_t x;
    int32_t y;
    int32_t k;
    workspace.raw_rows = raw;
    workspace.smooth_rows = (uint8_t *)smoothed;
    workspace.magnitude_rows = (uint16_t *)magnitudes_of_rows;
    workspace.slope_rows = (drogue_slope *)slopes;
    workspace.code_rows = codes;
    frontend.workspace = &workspace;
    frontend.width_px = WIDTH;
    frontend.height_px = ROWS;
    frontend.config.canny_low = any_within(0, 4095);
    frontend.config.canny_high = any_within(frontend.config.canny_low, 4095);
    for (y = 0; y < ROWS; y++) {
        for (x = 0; x < WIDTH; x++) {
            pixels[y][x] = nondet_u8();
        }
    }
    for (k = 0; k < 8; k++) {
        frontend.columns[k] = all_columns;
    }
    drogue_rows_begin(&frontend);
}

/* What a form holds of a smoothed pixel and of a magnitude. */
static uint32_t smooth_pixel(int32_t x, int32_t y)
{
#if DROGUE_ROWS_PLAIN
    return smooth_row(&frontend, y)[x];
#else
    const uint32_t *row = smooth_row(&frontend, y);
    return x < HALF ? row[x] & 0xFFFFu : row[2 * HALF - 1 - x] >> 16;
#endif
}

static uint32_t magnitude_pixel(int32_t x, int32_t y)
{
#if DROGUE_ROWS_PLAIN
    return magnitude_row(&frontend, y)[x];
#else
    const uint32_t *row = magnitude_row(&frontend, y);
    return x < HALF ? row[x] & 0xFFFFu : row[2 * HALF - 1 - x] >> 16;
#endif
}

void smoothing(void)
{
    static const uint32_t weight[5] = {1, 4, 6, 4, 1};
    int32_t x;
    int32_t i;
    int32_t k;
    begin();
    for (k = 0; k < ROWS; k++) {
        for (x = -2; x < WIDTH + 2; x++) {
            drogue_raw_row(&frontend, k)[x + 2] = pixels[k][drogue_reflect_101(x, WIDTH)];
        }
    }
    drogue_rows_smooth(&frontend, 2, drogue_rows_stretch(&frontend, &all_columns));
    for (x = 0; x < WIDTH; x++) {
        uint32_t sum = 128;
        for (k = 0; k < 5; k++) {
            for (i = 0; i < 5; i++) {
                sum += weight[k] * weight[i] * pixels[k][drogue_reflect_101(x + i - 2, WIDTH)];
            }
        }
        PROVE(smooth_pixel(x, 2) == sum >> 8);
    }
}

static int32_t at(int32_t x, int32_t y) { return pixels[y][x < 0 ? 0 : x >= WIDTH ? WIDTH - 1 : x]; }

static int32_t horizontal(int32_t x, int32_t y)
{
    return at(x + 1, y - 1) + 2 * at(x + 1, y) + at(x + 1, y + 1) - at(x - 1, y - 1) - 2 * at(x - 1, y) -
           at(x - 1, y + 1);
}

static int32_t vertical(int32_t x, int32_t y)
{
    return at(x - 1, y + 1) + 2 * at(x, y + 1) + at(x + 1, y + 1) - at(x - 1, y - 1) - 2 * at(x, y - 1) -
           at(x + 1, y - 1);
}

static uint32_t magnitude(int32_t x, int32_t y)
{
    const int32_t dx = horizontal(x, y);
    const int32_t dy = vertical(x, y);
    return x < 0 || x >= WIDTH ? 0 : (uint32_t)((dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy));
}

void gradient(void)
{
    int32_t x;
    int32_t k;
    begin();
    for (k = 1; k <= 3; k++) {
        drogue_rows_take_smoothed(&frontend, k, pixels[k]);
    }
    drogue_rows_gradient(&frontend, 2, drogue_rows_stretch(&frontend, &all_columns));
    for (x = 0; x < WIDTH; x++) {
        PROVE(magnitude_pixel(x, 2) == magnitude(x, 2));
    }
}

/* The front end's own, which the form calls: what it makes of a maximum is not looked at. */
uint8_t drogue_rows_place(drogue_slope *at, const drogue_frontend *f, drogue_sector sector, int32_t before, int32_t m,
                          int32_t after)
{
    (void)at, (void)f, (void)sector, (void)before, (void)m, (void)after;
    return DROGUE_CODE_CANDIDATE;
}

/* Is the pixel a maximum by drogue_canny_*(), and listed? */
void maxima(void)
{
    const int32_t x = any_within(0, WIDTH - 1);
    const drogue_slope *points;
    uint32_t count;
    uint32_t listed = 0;
    uint32_t i;
    int32_t k;
    int32_t part;
    begin();
    for (k = 0; k < ROWS; k++) {
        drogue_rows_take_smoothed(&frontend, k, pixels[k]);
        if (k >= 2) {
            drogue_rows_gradient(&frontend, k - 1, drogue_rows_stretch(&frontend, &all_columns));
        }
    }
    for (part = 0; part < DROGUE_ROW_PARTS; part++) {
        count = drogue_rows_maxima(&frontend, 2, part);
        points = drogue_rows_points(&frontend);
        PROVE(count <= WIDTH);
        for (i = 0; i < count; i++) {
            PROVE(points[i].x < WIDTH);
            if (points[i].x == x) {
                listed++;
                PROVE(points[i].gx == horizontal(x, 2) && points[i].gy == vertical(x, 2));
            }
        }
    }
    {
        const int16_t gx = (int16_t)horizontal(x, 2);
        const int16_t gy = (int16_t)vertical(x, 2);
        const int32_t m = (int32_t)magnitude(x, 2);
        const drogue_sector sector = drogue_canny_sector(gx, gy);
        const int32_t dx = drogue_canny_step_x(sector);
        const int32_t dy = drogue_canny_step_y(sector);
        const int expected =
            m > frontend.config.canny_low &&
            drogue_canny_is_maximum(sector, (int32_t)magnitude(x - dx, 2 - dy), m, (int32_t)magnitude(x + dx, 2 + dy));
        PROVE(listed == (expected ? 1u : 0u));
    }
}

#endif
