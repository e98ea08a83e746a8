/* SPDX-License-Identifier: Apache-2.0 */
/* Otsu's threshold as exact fractions, and the inner part against one image operation after the other. */
#include "suite.h"

#include "drogue/inner.h"
#include "images.h"
#include "inner_model.h"
#include "workspace.h"

START_TEST(otsu_of_random_histograms)
{
    uint64_t rng = 1;
    int i, k;
    for (i = 0; i < 20000; i++) {
        uint32_t histogram[256];
        int32_t levels = rng_range(&rng, 1, 256), most = i & 1 ? 16383 : rng_range(&rng, 1, 8);
        memset(histogram, 0, sizeof histogram);
        for (k = 0; k < levels; k++) {
            histogram[levels < 256 ? rng_range(&rng, 0, 255) : k] = (uint32_t)rng_range(&rng, 0, most);
        }
        MUST(drogue_otsu(histogram) == model_otsu(histogram), "histogram %d", i);
    }
}
END_TEST

START_TEST(otsu_of_two_levels_and_fewer)
{
    uint32_t histogram[256];
    int p, q;
    memset(histogram, 0, sizeof histogram);
    ck_assert_uint_eq(drogue_otsu(histogram), 0);
    for (p = 0; p < 256; p++) {
        histogram[p] = 1u << 22;
        ck_assert_uint_eq(drogue_otsu(histogram), 0);
        for (q = 0; q < p; q += 5) { /* every level from q to p - 1 is as good: the least wins */
            histogram[p] = (1u << 22) - 1u;
            histogram[q] = 1;
            ck_assert_int_eq(drogue_otsu(histogram), q);
            histogram[p] = histogram[q] = 1u << 21;
            ck_assert_int_eq(drogue_otsu(histogram), q);
            histogram[q] = 0;
        }
        histogram[p] = 0;
    }
}
END_TEST

/* Largest 8-connected component; of equals the first. Returns its area. */
static uint32_t model_largest(double *x, double *y, const uint8_t *dark, int32_t width, int32_t height)
{
    uint8_t *left = malloc((size_t)(width * height));
    int32_t *stack = malloc((size_t)(width * height) * sizeof *stack), start, k;
    uint32_t best = 0;
    memcpy(left, dark, (size_t)(width * height));
    for (start = 0; start < width * height; start++) {
        int32_t top = 0;
        int64_t sx = 0, sy = 0;
        uint32_t area = 0;
        if (left[start]) {
            stack[top++] = start;
            left[start] = 0;
        }
        while (top > 0) {
            int32_t at = stack[--top];
            area++;
            sx += at % width;
            sy += at / width;
            for (k = 0; k < 9; k++) {
                int32_t u = at % width + k % 3 - 1, v = at / width + k / 3 - 1;
                if (dark_at(left, width, height, u, v, 0)) {
                    left[v * width + u] = 0;
                    stack[top++] = v * width + u;
                }
            }
        }
        if (area > best) {
            best = area;
            *x = (double)sx / area;
            *y = (double)sy / area;
        }
    }
    free(left);
    free(stack);
    return best;
}

static void check_image(const uint8_t *pixels, int32_t width, int32_t height, const drogue_mask *disc,
                        uint32_t min_area, int seed)
{
    test_workspace t = test_workspace_of((uint32_t)width, 1, (uint32_t)(width * height) + 2u, 1);
    uint8_t *dark = malloc((size_t)(width * height)), *eroded = malloc((size_t)(width * height));
    uint32_t histogram[256], area;
    uint8_t threshold;
    drogue_image image = {pixels, width, height, width};
    drogue_inner_part got;
    drogue_status status;
    double x = 0, y = 0;
    int32_t i;
    memset(histogram, 0, sizeof histogram);
    for (i = 0; i < width * height; i++) {
        histogram[pixels[i]] += drogue_mask_in_disc(disc, i % width, i / width) ? 1u : 0u;
    }
    threshold = model_otsu(histogram);
    for (i = 0; i < width * height; i++) {
        dark[i] = drogue_mask_in_disc(disc, i % width, i / width) && pixels[i] <= threshold;
    }
    filter3(eroded, dark, width, height, 1);
    filter3(dark, eroded, width, height, 0);
    area = model_largest(&x, &y, dark, width, height);
    status = drogue_inner_part_find(&got, &t.workspace, &image, disc, min_area);
    MUST(status == (area > 0 && area >= min_area ? DROGUE_OK : DROGUE_E_NO_INNER_PART), "seed %d: status %s", seed,
         drogue_status_name(status));
    MUST(got.threshold == threshold, "seed %d: threshold %u", seed, (unsigned)got.threshold);
    if (status == DROGUE_OK) {
        MUST(got.area_px == area, "seed %d: area %u instead of %u", seed, (unsigned)got.area_px, (unsigned)area);
        MUST(fabs(got.x_px_q16 - 65536 * x) <= 1 && fabs(got.y_px_q16 - 65536 * y) <= 1, "seed %d: centroid", seed);
    }
    MUST(guarded_intact(&t.memory), "seed %d wrote outside", seed);
    free(dark);
    free(eroded);
    test_workspace_free(&t);
}

START_TEST(random_images)
{
    int seed;
    for (seed = 1; seed <= 700; seed++) {
        uint64_t rng = (uint64_t)seed;
        int32_t width = rng_range(&rng, 1, seed < 200 ? 7 : 70), height = rng_range(&rng, 1, seed < 200 ? 7 : 70);
        uint8_t *pixels = malloc((size_t)(width * height));
        drogue_mask disc = drogue_mask_of_size(width, height);
        image_fill(pixels, width, height, seed % IMAGE_KINDS, &rng);
        if (seed % 3 == 0) { /* the whole image, or a disc that reaches past it */
            disc.longest_px = rng_range(&rng, 1, 4 * disc.longest_px);
            disc.centre2_x += rng_range(&rng, -width, width);
            disc.centre2_y += rng_range(&rng, -height, height);
        }
        check_image(pixels, width, height, &disc, (uint32_t)rng_range(&rng, 0, 12), seed);
        free(pixels);
    }
}
END_TEST

START_TEST(first_of_equal_components_wins)
{
    static uint8_t pixels[60 * 60];
    drogue_mask disc = drogue_mask_of_size(60, 60);
    int32_t x, y;
    memset(pixels, 200, sizeof pixels);
    disc.longest_px = 300;
    for (y = 0; y < 5; y++) {
        for (x = 0; x < 5; x++) {
            pixels[(10 + y) * 60 + 40 + x] = pixels[(12 + y) * 60 + 10 + x] = pixels[(40 + y) * 60 + x] = 20;
        }
    }
    check_image(pixels, 60, 60, &disc, 25, 0);
    check_image(pixels, 60, 60, &disc, 26, 0);
}
END_TEST

START_TEST(label_table_overfilled_by_one)
{
    enum { SIDE = 64, CELLS = 8 };
    static uint8_t pixels[SIDE * SIDE];
    const drogue_mask disc = {SIDE - 1, SIDE - 1, 3 * SIDE};
    drogue_image image = {pixels, SIDE, SIDE, SIDE};
    drogue_inner_part part;
    uint32_t less;
    int32_t x, y;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) { /* squares of 4 x 4 that stand apart */
            pixels[y * SIDE + x] = x % CELLS < 4 && y % CELLS < 4 ? 10 : 240;
        }
    }
    for (less = 0; less <= 1; less++) {
        test_workspace t = test_workspace_of(SIDE, 1, (SIDE / CELLS) * (SIDE / CELLS) + 1u - less, 1);
        ck_assert_int_eq(drogue_inner_part_find(&part, &t.workspace, &image, &disc, 1),
                         less ? DROGUE_E_LABELS_FULL : DROGUE_OK);
        ck_assert(guarded_intact(&t.memory));
        test_workspace_free(&t);
    }
}
END_TEST

START_TEST(arguments_and_edges_left_alone)
{
    static const uint8_t pixels[100] = {0};
    test_workspace t = test_workspace_of(10, 4, 102, 4);
    drogue_image image = {pixels, 10, 10, 10}, bad = image;
    drogue_mask disc = drogue_mask_of_size(10, 10);
    drogue_inner_part part;
    drogue_edge edges[4];
    drogue_arc arcs[4];
    memset(t.workspace.edges, 0x5A, sizeof edges);
    memset(t.workspace.arcs, 0x5A, sizeof arcs);
    memset(edges, 0x5A, sizeof edges);
    memset(arcs, 0x5A, sizeof arcs);
    ck_assert_int_eq(drogue_inner_part_find(&part, &t.workspace, &image, &disc, 1),
                     DROGUE_OK); /* all one level: all dark */
    ck_assert_int_eq(memcmp(t.workspace.edges, edges, sizeof edges), 0);
    ck_assert_int_eq(memcmp(t.workspace.arcs, arcs, sizeof arcs), 0);
    bad.data = NULL;
    ck_assert_int_eq(drogue_inner_part_find(&part, &t.workspace, &bad, &disc, 1), DROGUE_E_ARGUMENT);
    bad = image;
    bad.stride = 9;
    ck_assert_int_eq(drogue_inner_part_find(&part, &t.workspace, &bad, &disc, 1), DROGUE_E_ARGUMENT);
    bad = image;
    bad.width_px = 0;
    ck_assert_int_eq(drogue_inner_part_find(&part, &t.workspace, &bad, &disc, 1), DROGUE_E_ARGUMENT);
    bad.width_px = bad.stride = 11;
    bad.height_px = 9;
    ck_assert_int_eq(drogue_inner_part_find(&part, &t.workspace, &bad, &disc, 1), DROGUE_E_WORKSPACE);
    disc.longest_px = 0;
    ck_assert_int_eq(drogue_inner_part_find(&part, &t.workspace, &image, &disc, 1), DROGUE_E_ARGUMENT);
    disc.longest_px = 10;
    disc.centre2_x = 1000; /* the disc misses the image */
    ck_assert_int_eq(drogue_inner_part_find(&part, &t.workspace, &image, &disc, 1), DROGUE_E_NO_INNER_PART);
    test_workspace_free(&t);
}
END_TEST

START_TEST(largest_image)
{
    uint8_t *pixels = malloc((size_t)DROGUE_MAX_SIDE * DROGUE_MAX_SIDE);
    test_workspace t = test_workspace_of(DROGUE_MAX_SIDE, 1, 4096, 1);
    drogue_image image = {pixels, DROGUE_MAX_SIDE, DROGUE_MAX_SIDE, DROGUE_MAX_SIDE};
    const drogue_mask disc = {DROGUE_MAX_SIDE - 1, DROGUE_MAX_SIDE - 1, 3 * DROGUE_MAX_SIDE};
    drogue_inner_part part;
    memset(pixels, 77, (size_t)DROGUE_MAX_SIDE * DROGUE_MAX_SIDE);
    pixels[0] = 78;
    ck_assert_int_eq(drogue_inner_part_find(&part, &t.workspace, &image, &disc, 1), DROGUE_OK);
    ck_assert_uint_eq(part.threshold, 77);
    ck_assert_uint_ge(part.area_px, (uint32_t)DROGUE_MAX_SIDE * DROGUE_MAX_SIDE - 4u);
    ck_assert_int_le(abs(part.x_px_q16 - (DROGUE_MAX_SIDE - 1) * 32768), 65);
    ck_assert_int_le(abs(part.y_px_q16 - (DROGUE_MAX_SIDE - 1) * 32768), 65);
    ck_assert(guarded_intact(&t.memory));
    test_workspace_free(&t);
    free(pixels);
}
END_TEST

SUITE_MAIN("centroid", otsu_of_random_histograms, otsu_of_two_levels_and_fewer, random_images,
           first_of_equal_components_wins, label_table_overfilled_by_one, arguments_and_edges_left_alone, largest_image)
