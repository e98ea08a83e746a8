/* SPDX-License-Identifier: Apache-2.0 */
/* Noise of an image: white, coloured, among edges, and none. */
#include "suite.h"

#include <math.h>
#include <string.h>

#include "drogue/noise.h"

#define SIDE 200

static uint8_t pixels[SIDE][SIDE];
static const drogue_image image = {&pixels[0][0], SIDE, SIDE, SIDE};
static double grey[SIDE][SIDE];
static uint32_t histogram[256];

static void fill(uint64_t *rng, double sigma)
{
    int x, y;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            grey[y][x] = 120 + sigma * rng_normal(rng);
        }
    }
}

static int32_t threshold(void)
{
    int x, y;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            pixels[y][x] = (uint8_t)fmax(0, fmin(255, floor(grey[y][x] + 0.5)));
        }
    }
    return drogue_noise_threshold(histogram, &image);
}

/* Means over three pixels each way, as a lens or a codec leaves noise. */
static void blur(void)
{
    static double was[SIDE][SIDE];
    int x, y, i, j;
    memcpy(was, grey, sizeof was);
    for (y = 1; y + 1 < SIDE; y++) {
        for (x = 1; x + 1 < SIDE; x++) {
            double sum = 0;
            for (j = -1; j <= 1; j++) {
                for (i = -1; i <= 1; i++) {
                    sum += was[y + j][x + i];
                }
            }
            grey[y][x] = sum / 9;
        }
    }
}

/* Bars that cover so many of ten pixels across, 16 px wide. */
static void draw_bars(int of_ten)
{
    int x, y;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            if (x < SIDE * of_ten / 10 && x / 16 % 2 != 0) {
                grey[y][x] -= 80;
            }
        }
    }
}

START_TEST(white_noise)
{
    uint64_t rng = 3;
    double sigma;
    for (sigma = 0.7; sigma < 16; sigma *= 1.5) {
        int32_t t;
        fill(&rng, sigma);
        t = threshold();
        MUST(fabs(t / 10.0 - hypot(sigma, 0.29)) < 0.08 * sigma + 0.05, "sigma %g: threshold %d", sigma, t);
    }
}
END_TEST

START_TEST(among_edges)
{
    uint64_t rng = 5;
    int of_ten;
    for (of_ten = 0; of_ten <= 7; of_ten++) {
        int32_t t;
        fill(&rng, 2);
        draw_bars(of_ten);
        t = threshold();
        MUST(t > 17 && t < 33, "%d tenths with edges: threshold %d", of_ten, t);
    }
}
END_TEST

/* What a mean of three pixels leaves of noise is a third of it, and passes the smoothing before the gradient: its
 * differences from pixel to pixel would show a seventh. */
START_TEST(coloured_noise)
{
    uint64_t rng = 7;
    int32_t t;
    fill(&rng, 6);
    blur();
    t = threshold();
    MUST(t > 25 && t < 45, "threshold %d", t);
}
END_TEST

START_TEST(none_and_too_small)
{
    uint64_t rng = 9;
    drogue_image small = image;
    fill(&rng, 0);
    ck_assert_int_eq(threshold(), 0);
    draw_bars(5);
    ck_assert_int_eq(threshold(), 0);
    fill(&rng, 5);
    (void)threshold();
    for (small.width_px = 1; small.width_px <= 9 + 8; small.width_px++) { /* a block is 9 places of 9 px */
        for (small.height_px = 1; small.height_px <= 4; small.height_px++) {
            const int32_t t = drogue_noise_threshold(histogram, &small);
            MUST((t > 0) == (small.width_px >= 9 + 8 && small.height_px >= 3), "%d x %d: threshold %d", small.width_px,
                 small.height_px, t);
        }
    }
}
END_TEST

/* The histogram's last bin holds what is larger. */
START_TEST(as_much_as_there_is)
{
    uint64_t rng = 11;
    int x, y;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            grey[y][x] = rng_real(&rng, 0, 1) < 0.5 ? 0 : 255;
        }
    }
    {
        const int32_t t = threshold();
        MUST(t > 600 && t < 700, "threshold %d", t);
    }
}
END_TEST

SUITE_MAIN("noise", white_noise, among_edges, coloured_noise, none_and_too_small, as_much_as_there_is)
