/* SPDX-License-Identifier: Apache-2.0 */
/* Binomial smoothing against the sum written out, borders and arguments. */
#include "suite.h"

#include "drogue/smooth.h"
#include "images.h"

/* Mirror without repeating the border, as often as it takes. */
static int32_t mirror(int32_t i, int32_t n)
{
    while (n > 1 && (i < 0 || i >= n)) {
        i = i < 0 ? -i : 2 * n - 2 - i;
    }
    return n == 1 ? 0 : i;
}

static uint8_t model_pixel(const uint8_t *p, int32_t stride, int32_t width, int32_t height, int32_t x, int32_t y)
{
    static const int32_t weight[5] = {1, 4, 6, 4, 1};
    int32_t sum = 128, i, j;
    for (j = -2; j <= 2; j++) {
        for (i = -2; i <= 2; i++) {
            sum += weight[i + 2] * weight[j + 2] * p[mirror(y + j, height) * stride + mirror(x + i, width)];
        }
    }
    return (uint8_t)(sum >> 8);
}

static void check_size(int32_t width, int32_t height, int kind, uint64_t *rng)
{
    int32_t stride = width + rng_range(rng, 0, 3), x, y;
    guarded in = guarded_alloc((size_t)stride * (size_t)height);
    guarded out = guarded_alloc((size_t)width * (size_t)height);
    guarded column = guarded_alloc((size_t)width * sizeof(uint16_t));
    drogue_image image = {NULL, width, height, stride};
    const uint8_t *result = out.data;
    image_fill(in.data, stride, height, kind, rng);
    image.data = in.data;
    MUST(drogue_smooth_image(out.data, column.data, &image) == DROGUE_OK, "%d x %d refused", width, height);
    for (y = 0; y < height; y++) {
        for (x = 0; x < width; x++) {
            MUST(result[y * width + x] == model_pixel(image.data, stride, width, height, x, y),
                 "%d x %d differs at (%d, %d)", width, height, x, y);
        }
    }
    MUST(guarded_intact(&in) && guarded_intact(&out) && guarded_intact(&column), "%d x %d wrote outside", width,
         height);
    guarded_free(&in);
    guarded_free(&out);
    guarded_free(&column);
}

START_TEST(every_small_size)
{
    uint64_t rng = 1;
    int32_t width, height;
    for (height = 1; height <= 9; height++) {
        for (width = 1; width <= 9; width++) {
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
    check_size(DROGUE_MAX_SIDE, 3, IMAGE_NOISE, &rng);
    check_size(2, DROGUE_MAX_SIDE, IMAGE_NOISE, &rng);
}
END_TEST

START_TEST(constant_levels_stay)
{
    uint32_t level;
    for (level = 0; level <= 255; level++) {
        uint32_t column = drogue_binomial5(level, level, level, level, level);
        ck_assert_uint_eq(drogue_smooth_normalise(drogue_binomial5(column, column, column, column, column)), level);
    }
}
END_TEST

START_TEST(reflection_over_its_range)
{
    int32_t i, n;
    for (n = 1; n <= 7; n++) {
        for (i = -2; i < n + 2; i++) {
            ck_assert_int_eq(drogue_reflect_101(i, n), mirror(i, n));
        }
    }
}
END_TEST

START_TEST(arguments_out_of_range)
{
    static uint8_t data[4], out[4];
    static uint16_t column[4];
    static const drogue_image bad[] = {{data, 0, 1, 1},
                                       {data, 1, 0, 1},
                                       {data, -1, 1, 1},
                                       {data, 1, -1, 1},
                                       {data, 2, 2, 1},
                                       {NULL, 2, 2, 2},
                                       {data, DROGUE_MAX_SIDE + 1, 1, DROGUE_MAX_SIDE + 1},
                                       {data, 1, DROGUE_MAX_SIDE + 1, 1}};
    size_t i;
    for (i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        ck_assert_int_eq(drogue_smooth_image(out, column, &bad[i]), DROGUE_E_ARGUMENT);
    }
    ck_assert_int_eq(out[0], 0);
}
END_TEST

SUITE_MAIN("smooth", every_small_size, random_images, constant_levels_stay, reflection_over_its_range,
           arguments_out_of_range)
