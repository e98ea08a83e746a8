/* SPDX-License-Identifier: Apache-2.0 */
/* Random test images of every kind that edge detection meets; C99 and C++17. */
#ifndef DROGUE_TESTS_IMAGES_H
#define DROGUE_TESTS_IMAGES_H

#include "common.h"

enum image_kind {
    IMAGE_NOISE,
    IMAGE_FAINT_NOISE,
    IMAGE_BLOBS,
    IMAGE_CHECKERS,
    IMAGE_CONSTANT,
    IMAGE_RAMP,
    IMAGE_RINGS,
    IMAGE_KINDS
};

static inline uint8_t image_grey(double v) { return (uint8_t)(v < 0 ? 0 : v > 255 ? 255 : v + 0.5); }

static inline void image_fill_blobs(uint8_t *out, int32_t width, int32_t height, uint64_t *rng)
{
    double cx[4], cy[4], r[4], level[4];
    int32_t x, y, k;
    for (k = 0; k < 4; k++) {
        cx[k] = rng_real(rng, 0, width);
        cy[k] = rng_real(rng, 0, height);
        r[k] = rng_real(rng, 1, 1 + (width + height) / 4.0);
        level[k] = rng_real(rng, -200, 200);
    }
    for (y = 0; y < height; y++) {
        for (x = 0; x < width; x++) {
            double v = 128;
            for (k = 0; k < 4; k++) {
                double dx = (x - cx[k]) / r[k], dy = (y - cy[k]) / r[k];
                v += level[k] * exp(-dx * dx - dy * dy);
            }
            out[y * width + x] = image_grey(v);
        }
    }
}

static inline void image_fill_rings(uint8_t *out, int32_t width, int32_t height, uint64_t *rng)
{
    double cx = width / 2.0 + rng_real(rng, -3, 3), cy = height / 2.0 + rng_real(rng, -3, 3);
    double a = rng_real(rng, 0.25, 0.5) * width, b = rng_real(rng, 0.25, 0.5) * height;
    double inside = rng_real(rng, 0, 255), outside = rng_real(rng, 0, 255), noise = rng_real(rng, 0, 20);
    int32_t x, y;
    for (y = 0; y < height; y++) {
        for (x = 0; x < width; x++) {
            double dx = (x - cx) / (a + 0.5), dy = (y - cy) / (b + 0.5), d = sqrt(dx * dx + dy * dy);
            double v = d < 0.5 ? inside / 2 : d < 1 ? inside : outside;
            out[y * width + x] = image_grey(v + noise * rng_real(rng, -1, 1));
        }
    }
}

/* Fill width * height grey levels. */
static inline void image_fill(uint8_t *out, int32_t width, int32_t height, int kind, uint64_t *rng)
{
    int32_t base = rng_range(rng, 0, 255), other = rng_range(rng, 0, 255);
    int32_t cell = rng_range(rng, 1, 9), shift = rng_range(rng, 0, 9), span = rng_range(rng, 1, 12);
    double gx = rng_real(rng, -20, 20), gy = rng_real(rng, -20, 20);
    int32_t x, y;
    if (kind == IMAGE_BLOBS) {
        image_fill_blobs(out, width, height, rng);
        return;
    }
    if (kind == IMAGE_RINGS) {
        image_fill_rings(out, width, height, rng);
        return;
    }
    for (y = 0; y < height; y++) {
        for (x = 0; x < width; x++) {
            double v = base;
            if (kind == IMAGE_NOISE) {
                v = rng_range(rng, 0, 255);
            } else if (kind == IMAGE_FAINT_NOISE) {
                v = base + rng_range(rng, -span, span);
            } else if (kind == IMAGE_CHECKERS) {
                v = (((x + shift) / cell + y / cell) & 1) ? base : other;
            } else if (kind == IMAGE_RAMP) {
                v = base + gx * (x - width / 2.0) + gy * (y - height / 2.0);
            }
            out[y * width + x] = image_grey(v);
        }
    }
}

#endif
