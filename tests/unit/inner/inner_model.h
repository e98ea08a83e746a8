/* SPDX-License-Identifier: Apache-2.0 */
/* Otsu's threshold and the opening, one image operation after the other. */
#ifndef DROGUE_TESTS_INNER_MODEL_H
#define DROGUE_TESTS_INNER_MODEL_H

#include "common.h"
#include "quad.h"

/* Least level of the largest variance between the classes, in quadruple precision. */
static inline uint8_t model_otsu(const uint32_t *histogram)
{
    quad total = 0, sum = 0, below = 0, sum_below = 0, best = 0;
    int level, at = 0;
    for (level = 0; level < 256; level++) {
        total += histogram[level];
        sum += (quad)histogram[level] * level;
    }
    for (level = 0; level < 255; level++) {
        quad p, variance;
        below += histogram[level];
        sum_below += (quad)histogram[level] * level;
        if (below > 0 && below < total) {
            p = below * sum - total * sum_below;
            variance = p * p / (below * (total - below));
            if (variance >
                best * (1 + (quad)1e-28L)) { /* equals differ by rounding alone, unequals by 2^-88 and more */
                best = variance;
                at = level;
            }
        }
    }
    return (uint8_t)at;
}

static inline int dark_at(const uint8_t *p, int32_t width, int32_t height, int32_t x, int32_t y, int outside)
{
    return x < 0 || y < 0 || x >= width || y >= height ? outside : p[y * width + x];
}

/* Minimum or maximum over 3x3; pixels outside count as 'outside'. */
static inline void filter3(uint8_t *out, const uint8_t *in, int32_t width, int32_t height, int outside)
{
    int32_t i, k;
    for (i = 0; i < width * height; i++) {
        int all = 1, any = 0;
        for (k = 0; k < 9; k++) {
            int v = dark_at(in, width, height, i % width + k % 3 - 1, i / width + k / 3 - 1, outside);
            all &= v;
            any |= v;
        }
        out[i] = (uint8_t)(outside ? all : any);
    }
}

#endif
