/* SPDX-License-Identifier: Apache-2.0 */
/* Sobel gradient against the masks written out, borders, extremes and arguments. */
#include "suite.h"

#include "drogue/gradient.h"
#include "images.h"

static int32_t clamp(int32_t i, int32_t n) { return i < 0 ? 0 : i >= n ? n - 1 : i; }

static void model_pixel(int32_t *gx, int32_t *gy, const uint8_t *p, int32_t stride, int32_t width, int32_t height,
                        int32_t x, int32_t y)
{
    static const int32_t weight[3] = {1, 2, 1};
    int32_t i, j;
    *gx = 0;
    *gy = 0;
    for (j = -1; j <= 1; j++) {
        for (i = -1; i <= 1; i++) {
            int32_t v = p[clamp(y + j, height) * stride + clamp(x + i, width)];
            *gx += i * weight[j + 1] * v;
            *gy += j * weight[i + 1] * v;
        }
    }
}

static void check_size(int32_t width, int32_t height, int kind, uint64_t *rng)
{
    int32_t stride = width + rng_range(rng, 0, 3), x, y;
    size_t pixels = (size_t)width * (size_t)height;
    guarded in = guarded_alloc((size_t)stride * (size_t)height);
    guarded gx = guarded_alloc(pixels * sizeof(int16_t));
    guarded gy = guarded_alloc(pixels * sizeof(int16_t));
    guarded magnitude = guarded_alloc(pixels * sizeof(uint16_t));
    drogue_image image = {NULL, width, height, stride};
    image_fill(in.data, stride, height, kind, rng);
    image.data = in.data;
    MUST(drogue_gradient_image(gx.data, gy.data, magnitude.data, &image) == DROGUE_OK, "%d x %d refused", width,
         height);
    for (y = 0; y < height; y++) {
        for (x = 0; x < width; x++) {
            int32_t ex, ey, at = y * width + x;
            model_pixel(&ex, &ey, image.data, stride, width, height, x, y);
            MUST(((int16_t *)gx.data)[at] == ex && ((int16_t *)gy.data)[at] == ey &&
                     ((uint16_t *)magnitude.data)[at] == abs(ex) + abs(ey),
                 "%d x %d differs at (%d, %d)", width, height, x, y);
        }
    }
    MUST(guarded_intact(&in) && guarded_intact(&gx) && guarded_intact(&gy) && guarded_intact(&magnitude),
         "%d x %d wrote outside", width, height);
    guarded_free(&in);
    guarded_free(&gx);
    guarded_free(&gy);
    guarded_free(&magnitude);
}

START_TEST(every_small_size)
{
    uint64_t rng = 1;
    int32_t width, height;
    for (height = 1; height <= 6; height++) {
        for (width = 1; width <= 6; width++) {
            check_size(width, height, IMAGE_NOISE, &rng);
        }
    }
}
END_TEST

START_TEST(random_images)
{
    uint64_t rng = 2;
    int i;
    for (i = 0; i < 50; i++) {
        check_size(rng_range(&rng, 1, 70), rng_range(&rng, 1, 70), i % IMAGE_KINDS, &rng);
    }
    check_size(DROGUE_MAX_SIDE, 2, IMAGE_NOISE, &rng);
    check_size(1, DROGUE_MAX_SIDE, IMAGE_NOISE, &rng);
}
END_TEST

START_TEST(extremes_of_the_window)
{
    ck_assert_int_eq(drogue_sobel_gx(0, 0, 0, 255, 255, 255), 1020);
    ck_assert_int_eq(drogue_sobel_gx(255, 255, 255, 0, 0, 0), -1020);
    ck_assert_int_eq(drogue_sobel_gy(0, 0, 0, 255, 255, 255), 1020);
    ck_assert_int_eq(drogue_sobel_gy(255, 255, 255, 0, 0, 0), -1020);
    ck_assert_uint_eq(drogue_magnitude_l1(-1020, -1020), 2040);
    ck_assert_uint_eq(drogue_magnitude_l1(1020, -1020), 2040);
    ck_assert_uint_eq(drogue_magnitude_l1(0, 0), 0);
}
END_TEST

START_TEST(arguments_out_of_range)
{
    static uint8_t data[4];
    static int16_t gx[4], gy[4];
    static uint16_t magnitude[4];
    static const drogue_image bad[] = {{data, 0, 1, 1},
                                       {data, 1, 0, 1},
                                       {data, 2, 2, 1},
                                       {NULL, 2, 2, 2},
                                       {data, DROGUE_MAX_SIDE + 1, 1, DROGUE_MAX_SIDE + 1},
                                       {data, 1, DROGUE_MAX_SIDE + 1, 1}};
    size_t i;
    for (i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        ck_assert_int_eq(drogue_gradient_image(gx, gy, magnitude, &bad[i]), DROGUE_E_ARGUMENT);
    }
}
END_TEST

SUITE_MAIN("gradient", every_small_size, random_images, extremes_of_the_window, arguments_out_of_range)
