/* SPDX-License-Identifier: Apache-2.0 */
/* What blur takes from a small outline is put back: discs drawn to a 256th of a pixel, smoothed and not, with the optics' blur
 * and without. */
#include "suite.h"

#include "drogue/drogue.h"
#include "geometry.h"
#include "own_workspace.h"

enum { SIDE = 48, FINE = 16, MARGIN = 8 };

static const drogue_model bare = {22938, 0, 0};
static uint8_t pixels[SIDE * SIDE];
static double sharp[SIDE + 2 * MARGIN][SIDE + 2 * MARGIN], half_blurred[SIDE + 2 * MARGIN][SIDE + 2 * MARGIN];

/* A dark disc, blurred by a normal distribution of this standard deviation. */
static void draw(double xc, double yc, double radius, double sigma)
{
    double kernel[2 * MARGIN + 1], sum = 0;
    int x, y, k;
    for (y = 0; y < SIDE + 2 * MARGIN; y++) {
        for (x = 0; x < SIDE + 2 * MARGIN; x++) {
            int within = 0;
            for (k = 0; k < FINE * FINE; k++) {
                within += hypot(x - MARGIN - 0.5 + (k % FINE + 0.5) / FINE - xc,
                                y - MARGIN - 0.5 + (k / FINE + 0.5) / FINE - yc) < radius;
            }
            sharp[y][x] = 200 - 140.0 * within / (FINE * FINE);
        }
    }
    for (k = -MARGIN; k <= MARGIN; k++) {
        kernel[k + MARGIN] = sigma > 0 ? exp(-k * k / (2 * sigma * sigma)) : k == 0;
        sum += kernel[k + MARGIN];
    }
    for (y = 0; y < SIDE + 2 * MARGIN; y++) {
        for (x = MARGIN; x < SIDE + MARGIN; x++) {
            half_blurred[y][x] = 0;
            for (k = -MARGIN; k <= MARGIN; k++) {
                half_blurred[y][x] += kernel[k + MARGIN] / sum * sharp[y][x + k];
            }
        }
    }
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            double grey = 0;
            for (k = -MARGIN; k <= MARGIN; k++) {
                grey += kernel[k + MARGIN] / sum * half_blurred[y + MARGIN + k][x + MARGIN];
            }
            pixels[y * SIDE + x] = (uint8_t)(grey + 0.5);
        }
    }
}

/* Not undone, smoothing, pixel and gradient draw an outline of this radius 0.043 px inward; without smoothing 0.017 px. */
START_TEST(radius_of_small_discs)
{
    static const drogue_image image = {pixels, SIDE, SIDE, SIDE};
    static const drogue_region all = {0, 0, SIDE, SIDE};
    const drogue_camera camera = pinhole(400, 400, 24, 24);
    test_workspace t = test_workspace_of(SIDE, 4096, 4096, 512);
    drogue_config config;
    int blur, smooth, i;
    drogue_config_default(&config);
    for (blur = 0; blur < 2; blur++) {
        double off[2] = {0, 0};
        uint64_t rng = 3;
        config.optics_blur_px_q16 = blur ? DROGUE_Q16(1, 1) : 0;
        for (i = 0; i < 40; i++) {
            const double radius = rng_real(&rng, 18.5, 19.5);
            draw(rng_real(&rng, 23, 24), rng_real(&rng, 23, 24), radius, blur);
            for (smooth = 0; smooth < 2; smooth++) {
                drogue_result r;
                config.smooth = smooth;
                MUST(drogue_measure(&r, &t.workspace, &(drogue_setup){&camera, &bare, &config}, &image, &all) ==
                         DROGUE_OK,
                     "disc %d: %s", i, drogue_status_name(r.status));
                off[smooth] += (real_of_q16(r.ellipse.a_px_q16) + real_of_q16(r.ellipse.b_px_q16)) / 2 - radius;
            }
        }
        for (smooth = 0; smooth < 2; smooth++) {
            MUST(fabs(off[smooth]) < 40 * 0.008, "blur %d px, smoothing %d: %g px off on average", blur, smooth,
                 off[smooth] / 40);
        }
    }
    test_workspace_free(&t);
}
END_TEST

SUITE_MAIN("blur", radius_of_small_discs)
