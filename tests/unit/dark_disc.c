/* SPDX-License-Identifier: Apache-2.0 */
/* The dark disc where it is expected: against exact sums, crossed by ribs, beside larger dark regions, cut by the image. */
#include "suite.h"

#include "dark_model.h"
#include "drogue/centroid.h"
#include "images.h"
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

static drogue_status find(drogue_dark_part *out, uint32_t *which, const drogue_mask *disc, uint32_t min_area,
                          const drogue_ellipse *expected, uint32_t count)
{
    test_workspace t = test_workspace_of(WIDTH, 1, WIDTH * HEIGHT / 4 + 2, 1);
    drogue_status status;
    memset(out, 0x5A, sizeof *out);
    *which = 99;
    status = drogue_dark_disc_find(out, which, &t.workspace, &image, disc, min_area, expected, count);
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
    double worst = 0;
    int i;
    for (i = 0; i < 150; i++) {
        const double a = rng_real(&rng, 3, 30);
        const blob b = {rng_real(&rng, 40, 120), rng_real(&rng, 40, 80), a, a * rng_real(&rng, 0.8, 1),
                        rng_real(&rng, 0, 40)};
        const drogue_ellipse expected =
            disc_at(b.x + rng_real(&rng, -0.5, 0.5) * a, b.y + rng_real(&rng, -0.5, 0.5) * a, a);
        drogue_dark_part part;
        double x, y, area = draw(&x, &y, rng_real(&rng, 90, 220), &b, 1, NULL, 0);
        uint32_t which;
        MUST(find(&part, &which, &everywhere, 9, &expected, 1) == DROGUE_OK, "case %d not found", i);
        MUST(which == 0 && fabs(part.area_px / area - 1) < 0.02 + 4 / area, "case %d: area %u of %g", i,
             (unsigned)part.area_px, area);
        worst = fmax(worst, hypot(real_of_q16(part.x_px_q16) - x, real_of_q16(part.y_px_q16) - y));
