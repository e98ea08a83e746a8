/* SPDX-License-Identifier: Apache-2.0 */
/* The inner disc where it is expected: against exact sums, crossed by ribs, beside larger dark regions, cut by the image. */
#include "suite.h"

#include "drogue/inner.h"
#include "images.h"
#include "inner_model.h"
#include "workspace.h"

enum { WIDTH = 160, HEIGHT = 120 };

static uint8_t pixels[WIDTH * HEIGHT];
static const drogue_image image = {pixels, WIDTH, HEIGHT, WIDTH};
static const drogue_mask everywhere = {WIDTH - 1, HEIGHT - 1, 4 * WIDTH};

static drogue_ellipse disc_at(double x, double y, double a)
{
    drogue_ellipse e;
    memset(&e, 0, sizeof e);
    e.xc_px_q16 = q16_of(x);
    e.yc_px_q16 = q16_of(y);
    e.a_px_q16 = e.b_px_q16 = q16_of(a);
    return e;
}

static drogue_status find(drogue_inner_part *out, uint32_t *which, const drogue_mask *disc, uint32_t min_area,
                          const drogue_ellipse *expected, uint32_t count)
{
    test_workspace t = test_workspace_of(WIDTH, 1, WIDTH * HEIGHT / 4 + 2, 1);
    drogue_inner_expected sought;
    drogue_status status;
    memset(out, 0x5A, sizeof *out);
    *which = 99;
    memset(&sought, 0, sizeof sought);
    memcpy(sought.disc, expected, count * sizeof *expected);
    sought.count = count;
    sought.min_area_px = min_area;
    status = drogue_inner_find(out, which, &t.workspace, &image, disc, &sought);
    MUST(guarded_intact(&t.memory), "wrote outside the workspace");
    test_workspace_free(&t);
    return status;
}

/* A shape is drawn by 4 x 4 samples a pixel. */
typedef struct blob {
    double x, y, a, b; /* ellipse along the axes */
    double grey;
} blob;

typedef struct bar {
    double x, y, dx, dy, half; /* a line through (x, y) along (dx, dy), and half its width */
    double grey;
} bar;

static double shade(double x, double y, double back, const blob *blobs, int blob_count, const bar *bars, int bar_count)
{
    double grey = back;
    int k;
    for (k = 0; k < blob_count; k++) {
        double u = (x - blobs[k].x) / blobs[k].a, v = (y - blobs[k].y) / blobs[k].b;
        grey = u * u + v * v <= 1 ? blobs[k].grey : grey;
    }
    for (k = 0; k < bar_count; k++) {
        double off = ((x - bars[k].x) * bars[k].dy - (y - bars[k].y) * bars[k].dx) / hypot(bars[k].dx, bars[k].dy);
        grey = fabs(off) <= bars[k].half ? bars[k].grey : grey;
    }
    return grey;
}

/* Draw; returns area and centroid of what is left dark of the first blob. */
static double draw(double *x_mean, double *y_mean, double back, const blob *blobs, int blob_count, const bar *bars,
                   int bar_count)
{
    double area = 0;
    int32_t x, y, k;
    *x_mean = *y_mean = 0;
    for (y = 0; y < HEIGHT; y++) {
        for (x = 0; x < WIDTH; x++) {
            double sum = 0;
            for (k = 0; k < 16; k++) {
                double sx = x + (k % 4 + 0.5) / 4 - 0.5, sy = y + (k / 4 + 0.5) / 4 - 0.5;
                double grey = shade(sx, sy, back, blobs, blob_count, bars, bar_count);
                double u = (sx - blobs[0].x) / blobs[0].a, v = (sy - blobs[0].y) / blobs[0].b;
                sum += grey;
                if (grey == blobs[0].grey && u * u + v * v <= 1) {
                    area += 1.0 / 16;
                    *x_mean += sx / 16;
                    *y_mean += sy / 16;
                }
            }
            pixels[y * WIDTH + x] = image_grey(sum / 16);
        }
    }
    *x_mean /= area;
    *y_mean /= area;
    return area;
}

START_TEST(whole_discs_to_a_fraction_of_a_pixel)
{
    uint64_t rng = 1;
    double squares = 0, off;
    int i;
    for (i = 0; i < 150; i++) {
        const double a = rng_real(&rng, 3, 30);
        const blob b = {rng_real(&rng, 40, 120), rng_real(&rng, 40, 80), a, a * rng_real(&rng, 0.8, 1),
                        rng_real(&rng, 0, 40)};
        const drogue_ellipse expected =
            disc_at(b.x + rng_real(&rng, -0.5, 0.5) * a, b.y + rng_real(&rng, -0.5, 0.5) * a, a);
        drogue_inner_part part;
        double x, y, area = draw(&x, &y, rng_real(&rng, 90, 220), &b, 1, NULL, 0);
        uint32_t which;
        MUST(find(&part, &which, &everywhere, 9, &expected, 1) == DROGUE_OK, "case %d not found", i);
        MUST(which == 0 && fabs(part.area_px / area - 1) < 0.02 + 4 / area, "case %d: area %u of %g", i,
             (unsigned)part.area_px, area);
        /* pixels at the edge count by steps of grey: the smaller the disc the less they even out */
        off = hypot(real_of_q16(part.x_px_q16) - x, real_of_q16(part.y_px_q16) - y);
        MUST(off < (a < 10 ? 0.2 : 0.08), "case %d, radius %g: %g px off", i, a, off);
        squares += off * off;
    }
    MUST(sqrt(squares / 150) < 0.05, "%g px off", sqrt(squares / 150));
}
END_TEST

START_TEST(ribs_cross_the_disc)
{
    uint64_t rng = 2;
    int i, k, split = 0;
    for (i = 0; i < 100; i++) {
        const blob b = {rng_real(&rng, 60, 100), rng_real(&rng, 50, 70), 22, 21, 15};
        const drogue_ellipse expected = disc_at(b.x + 2, b.y - 2, 22);
        const int ribs = 1 + i % 4;
        test_workspace t = test_workspace_of(WIDTH, 1, 4096, 1);
        drogue_inner_part part, largest;
        bar bars[4];
        double x, y, area;
        uint32_t which;
        for (k = 0; k < ribs; k++) {
            const double angle = rng_real(&rng, 0, 3);
            const bar one = {b.x + rng_real(&rng, -8, 8),
                             b.y + rng_real(&rng, -8, 8),
                             cos(angle),
                             sin(angle),
                             rng_real(&rng, 0.7, 1.5),
                             150};
            bars[k] = one;
        }
        area = draw(&x, &y, 130, &b, 1, bars, ribs);
        MUST(find(&part, &which, &everywhere, 9, &expected, 1) == DROGUE_OK, "case %d not found", i);
        /* pixels shared with a rib are dark or not by the threshold */
        MUST(fabs(part.area_px / area - 1) < 0.08, "case %d: area %u of %g", i, (unsigned)part.area_px, area);
        MUST(hypot(real_of_q16(part.x_px_q16) - x, real_of_q16(part.y_px_q16) - y) < 0.25, "case %d: %g %g px off", i,
             real_of_q16(part.x_px_q16) - x, real_of_q16(part.y_px_q16) - y);
        MUST(drogue_inner_part_find(&largest, &t.workspace, &image, &everywhere, 9) == DROGUE_OK, "case %d", i);
        split += largest.area_px < 0.8 * part.area_px;
        test_workspace_free(&t);
    }
    ck_assert_int_gt(split, 30); /* where the largest component is but a part of it */
}
END_TEST

START_TEST(larger_dark_region_beside_it)
{
    static const blob blobs[] = {{60, 60, 14, 13, 20}, {115, 60, 30, 35, 5}};
    const drogue_ellipse expected = disc_at(62, 59, 14);
    test_workspace t = test_workspace_of(WIDTH, 1, 4096, 1);
    drogue_inner_part part, largest;
    uint32_t which;
    double x, y, area = draw(&x, &y, 140, blobs, 2, NULL, 0);
    ck_assert_int_eq(drogue_inner_part_find(&largest, &t.workspace, &image, &everywhere, 9), DROGUE_OK);
    ck_assert(real_of_q16(largest.x_px_q16) > 100);
    ck_assert_int_eq(find(&part, &which, &everywhere, 9, &expected, 1), DROGUE_OK);
    ck_assert(hypot(real_of_q16(part.x_px_q16) - x, real_of_q16(part.y_px_q16) - y) < 0.05);
    ck_assert(fabs(part.area_px / area - 1) < 0.03);
    test_workspace_free(&t);
}
END_TEST

START_TEST(the_better_of_two_expectations)
{
    static const blob at[] = {{50, 60, 12, 12, 20}, {100, 50, 12, 12, 20}};
    drogue_ellipse expected[2];
    drogue_inner_part part;
    uint32_t which;
    double x, y;
    int i, turn;
    for (i = 0; i < 2; i++) {
        for (turn = 0; turn < 2; turn++) {
            expected[turn] = disc_at(at[0].x + 3, at[0].y, 12);
            expected[1 - turn] = disc_at(at[1].x, at[1].y - 2, 12);
            (void)draw(&x, &y, 140, &at[i], 1, NULL, 0);
            ck_assert_int_eq(find(&part, &which, &everywhere, 9, expected, 2), DROGUE_OK);
            ck_assert_uint_eq(which, (unsigned)(i ^ turn));
            ck_assert(hypot(real_of_q16(part.x_px_q16) - x, real_of_q16(part.y_px_q16) - y) < 0.05);
        }
    }
    /* both there, one of half the area; then alike, and the nearer wins; of equals the first */
    {
        const blob two[] = {{50, 60, 12, 12, 20}, {100, 60, 8.5, 8.5, 20}, {100, 60, 12, 12, 20}};
        const blob alike[] = {{50, 60, 12, 12, 20}, {100, 60, 12, 12, 20}};
        expected[1] = disc_at(50, 60, 12);
        expected[0] = disc_at(100, 60, 12);
        (void)draw(&x, &y, 140, two, 2, NULL, 0);
        ck_assert_int_eq(find(&part, &which, &everywhere, 9, expected, 2), DROGUE_OK);
        ck_assert_uint_eq(which, 1);
        (void)draw(&x, &y, 140, alike, 2, NULL, 0);
        expected[0].yc_px_q16 += 65536;
        ck_assert_int_eq(find(&part, &which, &everywhere, 9, expected, 2), DROGUE_OK);
        ck_assert_uint_eq(which, 1);
        expected[0] = expected[1];
        ck_assert_int_eq(find(&part, &which, &everywhere, 9, expected, 2), DROGUE_OK);
        ck_assert_uint_eq(which, 0);
    }
}
END_TEST

START_TEST(nothing_where_it_is_expected)
{
    static const blob b = {60, 60, 14, 13, 20};
    const drogue_ellipse beside = disc_at(60 + 14.5, 60, 14), there = disc_at(60, 60, 14);
    const drogue_ellipse far[] = {{INT32_MIN, INT32_MIN, 65536, 65536, 0},
                                  {INT32_MAX, INT32_MIN, INT32_MAX, 65536, 0},
                                  {INT32_MIN, INT32_MAX, INT32_MAX, INT32_MAX, 0}};
    drogue_mask elsewhere = everywhere;
    drogue_inner_part part;
    uint32_t which;
    double x, y;
    size_t i;
    (void)draw(&x, &y, 140, &b, 1, NULL, 0);
    ck_assert_int_eq(find(&part, &which, &everywhere, 9, &beside, 1), DROGUE_E_NO_INNER_PART);
    ck_assert_uint_eq(part.area_px, 0);
    ck_assert_int_eq(part.x_px_q16, 0);
    ck_assert_int_eq(find(&part, &which, &everywhere, 9, &there, 0), DROGUE_E_NO_INNER_PART);
    ck_assert_int_eq(find(&part, &which, &everywhere, 9, &there, 1), DROGUE_OK);
    ck_assert_int_eq(find(&part, &which, &everywhere, 700, &there, 1), DROGUE_E_NO_INNER_PART);
    elsewhere.centre2_x = 2 * 140;
    elsewhere.longest_px = 3 * 15; /* where the disc is not looked for */
    ck_assert_int_eq(find(&part, &which, &elsewhere, 9, &there, 1), DROGUE_E_NO_INNER_PART);
    for (i = 0; i < sizeof far / sizeof far[0]; i++) { /* the ends of Q16 */
        MUST(find(&part, &which, &everywhere, 9, &far[i], 1) == DROGUE_E_NO_INNER_PART, "expected at end %d", (int)i);
    }
    {
        const drogue_ellipse centre = disc_at(WIDTH / 2, HEIGHT / 2, 10);
        memset(pixels, 90, sizeof pixels); /* all one level: nothing is dark, but of black all is */
        ck_assert_int_eq(find(&part, &which, &everywhere, 9, &centre, 1), DROGUE_E_NO_INNER_PART);
        memset(pixels, 0, sizeof pixels);
        ck_assert_int_eq(find(&part, &which, &everywhere, 9, &centre, 1), DROGUE_OK);
        ck_assert(fabs(real_of_q16(part.x_px_q16) - WIDTH / 2) <= 1 &&
                  fabs(real_of_q16(part.y_px_q16) - HEIGHT / 2) <= 1);
        ck_assert(drogue_inner_fill(&part, &centre) > q16_of(1.4)); /* which is no disc of that size */
    }
}
END_TEST

/* ---- exact sums */

typedef struct exact_part {
    double x, y, area, spread;
    int threshold;
} exact_part;

static drogue_mask model_window(double x, double y, drogue_q16 a_px_q16, double factor)
{
    drogue_mask m;
    m.centre2_x = (int32_t)floor(2 * real_of_q16(q16_of(x)) + 0.5);
    m.centre2_y = (int32_t)floor(2 * real_of_q16(q16_of(y)) + 0.5);
    m.longest_px = (int32_t)floor(3 * real_of_q16(a_px_q16) * real_of_q16(q16_of(factor)) + 0.5) + 3;
    return m;
}

/* Centroid of darkness: 1 up to the level 'full', falling to 0 over 'range' levels. */
static void model_weigh(exact_part *p, const drogue_mask *window, int full, int range)
{
    double sum = 0, x_sum = 0, y_sum = 0;
    int32_t i;
    for (i = 0; i < WIDTH * HEIGHT; i++) {
        if (drogue_mask_in_disc(window, i % WIDTH, i / WIDTH)) {
            double dark = fmin(range, fmax(0, range - (pixels[i] - full)));
            sum += dark;
            x_sum += dark * (i % WIDTH);
            y_sum += dark * (i / WIDTH);
        }
    }
    if (sum > 0) {
        p->x = x_sum / sum;
        p->y = y_sum / sum;
        p->area = sum / range;
    }
}

static void model_histogram(uint32_t histogram[256], const drogue_mask *disc)
{
    int32_t i;
    memset(histogram, 0, 256 * sizeof *histogram);
    for (i = 0; i < WIDTH * HEIGHT; i++) {
        histogram[pixels[i]] += drogue_mask_in_disc(disc, i % WIDTH, i / WIDTH) ? 1u : 0u;
    }
}

static void model_refine(exact_part *p, drogue_q16 a_px_q16)
{
    drogue_mask window = model_window(p->x, p->y, a_px_q16, 1.6);
    exact_part lower, upper;
    uint32_t histogram[256];
    uint64_t count = 0, sum = 0;
    int level, half;
    model_histogram(histogram, &window);
    p->threshold = model_otsu(histogram);
    for (level = 0; level <= p->threshold; level++) {
        count += histogram[level];
        sum += (uint64_t)histogram[level] * (uint64_t)level;
    }
    half = (p->threshold - (count > 0 ? (int)(sum / count) : 0)) / 3;
    for (level = 0; level < 2; level++) {
        window = model_window(p->x, p->y, a_px_q16, 1.2);
        model_weigh(p, &window, p->threshold - half, 2 * half + 1);
    }
    lower = upper = *p;
    model_weigh(&lower, &window, p->threshold - 2 * half, 2 * half + 1);
    model_weigh(&upper, &window, p->threshold, 2 * half + 1);
    p->spread = hypot(lower.x - upper.x, lower.y - upper.y);
}

/* Components of the opened disc whose centroids the expected one holds, together; 0 when none. -1: too near to tell. */
static int model_components(exact_part *p, const drogue_mask *disc, const drogue_ellipse *expected, uint32_t min_area)
{
    static uint8_t dark[WIDTH * HEIGHT], eroded[WIDTH * HEIGHT];
    static int32_t stack[WIDTH * HEIGHT];
    uint32_t histogram[256];
    double x = 0, y = 0, area = 0;
    int32_t start, k;
    uint8_t threshold;
    model_histogram(histogram, disc);
    threshold = model_otsu(histogram);
    for (k = 0; k < WIDTH * HEIGHT; k++) {
        dark[k] = drogue_mask_in_disc(disc, k % WIDTH, k / WIDTH) && pixels[k] <= threshold;
    }
    filter3(eroded, dark, WIDTH, HEIGHT, 1);
    filter3(dark, eroded, WIDTH, HEIGHT, 0);
    for (start = 0; start < WIDTH * HEIGHT; start++) {
        int32_t top = 0;
        double sx = 0, sy = 0, own = 0, far;
        if (!dark[start]) {
            continue;
        }
        stack[top++] = start;
        dark[start] = 0;
        while (top > 0) {
            int32_t at = stack[--top];
            own++;
            sx += at % WIDTH;
            sy += at / WIDTH;
            for (k = 0; k < 9; k++) {
                int32_t u = at % WIDTH + k % 3 - 1, v = at / WIDTH + k / 3 - 1;
                if (dark_at(dark, WIDTH, HEIGHT, u, v, 0)) {
                    dark[v * WIDTH + u] = 0;
                    stack[top++] = v * WIDTH + u;
                }
            }
        }
        far = hypot(sx / own - real_of_q16(expected->xc_px_q16), sy / own - real_of_q16(expected->yc_px_q16)) -
              real_of_q16(expected->a_px_q16);
        if (own >= min_area && fabs(far) < 1e-4) {
            return -1;
        }
        if (own >= min_area && far < 0) {
            area += own;
            x += sx;
            y += sy;
        }
    }
    p->area = area;
    p->x = x / area;
    p->y = y / area;
    return area > 0;
}

START_TEST(exact_sums_over_random_images)
{
    uint64_t rng = 3;
    int i, found = 0, outside = 0;
    for (i = 0; i < 600; i++) {
        drogue_mask disc = everywhere;
        drogue_ellipse expected =
            disc_at(rng_real(&rng, -5, WIDTH + 5), rng_real(&rng, -5, HEIGHT + 5), exp(rng_real(&rng, 0, 4)));
        const uint32_t min_area = (uint32_t)rng_range(&rng, 0, 30);
        drogue_inner_part part;
        drogue_status status;
        exact_part model;
        uint32_t which;
        int there;
        if (i % 3 == 0) {
            image_fill(pixels, WIDTH, HEIGHT, i / 3 % IMAGE_KINDS, &rng);
        } else {
            blob b[3];
            double x, y;
            int k;
            for (k = 0; k < 3; k++) {
                b[k].x = rng_real(&rng, -5, WIDTH + 5);
                b[k].y = rng_real(&rng, -5, HEIGHT + 5);
                b[k].a = rng_real(&rng, 2, 35);
                b[k].b = b[k].a * rng_real(&rng, 0.6, 1);
                b[k].grey = rng_real(&rng, 0, 120);
            }
            (void)draw(&x, &y, rng_real(&rng, 100, 200), b, 3, NULL, 0);
            for (k = 0; k < WIDTH * HEIGHT; k++) {
                pixels[k] = image_grey(pixels[k] + 4 * rng_normal(&rng));
            }
            expected = disc_at(b[2].x + rng_real(&rng, -3, 3), b[2].y, b[2].a);
        }
        if (i % 4 == 0) {
            disc.centre2_x += rng_range(&rng, -WIDTH, WIDTH);
            disc.longest_px = rng_range(&rng, 10, 3 * WIDTH);
        }
        there = model_components(&model, &disc, &expected, min_area);
        if (there < 0) {
            continue;
        }
        status = find(&part, &which, &disc, min_area, &expected, 1);
        MUST(status == (there ? DROGUE_OK : DROGUE_E_NO_INNER_PART), "case %d: %s", i, drogue_status_name(status));
        if (there) {
            double reach = 1.2 * real_of_q16(expected.a_px_q16);
            outside += model.x < reach || model.y < reach || model.x > WIDTH - reach || model.y > HEIGHT - reach;
            model_refine(&model, expected.a_px_q16);
            MUST(part.threshold == model.threshold, "case %d: threshold %u, not %d", i, (unsigned)part.threshold,
                 model.threshold);
            MUST(fabs(part.x_px_q16 - 65536 * model.x) <= 1 && fabs(part.y_px_q16 - 65536 * model.y) <= 1,
                 "case %d: centroid off by %g %g LSB", i, part.x_px_q16 - 65536 * model.x,
                 part.y_px_q16 - 65536 * model.y);
            MUST(fabs(part.area_px - model.area) <= 0.5, "case %d: area %u, not %g", i, (unsigned)part.area_px,
                 model.area);
            MUST(fabs(part.spread_px_q16 - 65536 * model.spread) <= 2.5, "case %d: spread %d, not %g LSB", i,
                 (int)part.spread_px_q16, 65536 * model.spread);
            found++;
        }
    }
    ck_assert_int_gt(found, 250);
    ck_assert_int_gt(outside, 60);
}
END_TEST

/* Area over the expected one, whatever their size. */
START_TEST(fill)
{
    uint64_t rng = 4;
    double worst = 0;
    int i;
    for (i = 0; i < 100000; i++) {
        drogue_ellipse e = disc_at(0, 0, exp(rng_real(&rng, 0, log(1000.0))));
        drogue_inner_part part;
        double expected;
        memset(&part, 0, sizeof part);
        e.b_px_q16 = rng_range(&rng, 65536, e.a_px_q16);
        part.area_px =
            (uint32_t)(exp(rng_real(&rng, -5, 1)) * TEST_PI * real_of_q16(e.a_px_q16) * real_of_q16(e.b_px_q16));
        expected = part.area_px / (TEST_PI * real_of_q16(e.a_px_q16) * real_of_q16(e.b_px_q16));
        worst = fmax(worst, fabs(drogue_inner_fill(&part, &e) - 65536 * expected));
    }
    MUST(worst <= 1.5, "off by %g LSB", worst); /* pi as Q16 takes a part */
    {
        const drogue_ellipse least = disc_at(0, 0, 1.0 / 256), largest = {0, 0, INT32_MAX, INT32_MAX, 0};
        const drogue_inner_part all = {0, 0, 1u << 22, 0, 0, 0};
        ck_assert_int_eq(drogue_inner_fill(&all, &least), INT32_MAX);
        ck_assert_int_le(abs(drogue_inner_fill(&all, &largest) - 81), 1); /* 2^22 / (pi 2^30) */
    }
}
END_TEST

START_TEST(arguments)
{
    const drogue_ellipse expected = disc_at(10, 10, 5);
    drogue_mask bad = everywhere;
    drogue_image none = image;
    test_workspace t = test_workspace_of(WIDTH - 1, 1, 100, 1), few = test_workspace_of(WIDTH, 1, 2, 1);
    drogue_inner_part part;
    uint32_t which;
    int32_t i;
    memset(pixels, 200, sizeof pixels);
    for (i = 0; i < WIDTH * HEIGHT; i++) {
        pixels[i] = i % WIDTH % 8 < 4 && i / WIDTH % 8 < 4 ? 10 : 240;
    }
    bad.longest_px = 0;
    ck_assert_int_eq(find(&part, &which, &bad, 1, &expected, 1), DROGUE_E_ARGUMENT);
    ck_assert_uint_eq(which, 0);
    none.data = NULL;
    ck_assert_int_eq(drogue_inner_find(&part, &which, &few.workspace, &none, &everywhere,
                                       &(drogue_inner_expected){{expected, expected}, 1, 1}),
                     DROGUE_E_ARGUMENT);
    ck_assert_int_eq(drogue_inner_find(&part, &which, &t.workspace, &image, &everywhere,
                                       &(drogue_inner_expected){{expected, expected}, 1, 1}),
                     DROGUE_E_WORKSPACE);
    ck_assert_int_eq(drogue_inner_find(&part, &which, &few.workspace, &image, &everywhere,
                                       &(drogue_inner_expected){{expected, expected}, 1, 1}),
                     DROGUE_E_LABELS_FULL);
    ck_assert(guarded_intact(&few.memory));
    test_workspace_free(&t);
    test_workspace_free(&few);
}
END_TEST

SUITE_MAIN("dark_disc", whole_discs_to_a_fraction_of_a_pixel, ribs_cross_the_disc, larger_dark_region_beside_it,
           the_better_of_two_expectations, nothing_where_it_is_expected, exact_sums_over_random_images, fill, arguments)
