/* SPDX-License-Identifier: Apache-2.0 */
/* 5x5 binomial smoothing of an 8-bit image: (sum of w_i w_j p + 128) >> 8 with w = 1 4 6 4 1, border
 * reflect-101; equal to cv::GaussianBlur(5x5, sigma 0) in every pixel. */
#ifndef DROGUE_SMOOTH_H
#define DROGUE_SMOOTH_H

#include "drogue/lanes.h"
#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One dimension of the kernel: p0 + 4 p1 + 6 p2 + 4 p3 + p4, of numbers or of 16-bit lanes (lanes.h). */
static inline uint32_t drogue_binomial5(uint32_t p0, uint32_t p1, uint32_t p2, uint32_t p3, uint32_t p4)
{
    return p0 + p4 + ((p1 + p3) << 2) + (p2 << 2) + (p2 << 1);
}

/* Normalise the 5x5 sum (weights 256) in each lane to a grey level. */
static inline uint32_t drogue_smooth_normalise_lanes(uint32_t sums)
{
    return ((sums + DROGUE_LANES(128u)) >> 8) & DROGUE_LANES(255u);
}

/* Normalise one 5x5 sum. */
static inline uint8_t drogue_smooth_normalise(uint32_t sum) { return (uint8_t)drogue_smooth_normalise_lanes(sum); }

/* Index of the mirror pixel for border reflect-101; -2 <= i < n + 2, n >= 1. */
static inline int32_t drogue_reflect_101(int32_t i, int32_t n)
{
    if (n == 1) {
        return 0;
    }
    if (i < 0) {
        i = -i;
    }
    if (i >= n) {
        i = 2 * n - 2 - i;
    }
    return i < 0 ? -i : i;
}

/* Smooth a whole image.
 *
 *  out     width_px * height_px grey levels, rows adjacent
 *  column  width_px words of work area
 *  image   sides in [1, DROGUE_MAX_SIDE]
 *  return  DROGUE_OK, DROGUE_E_ARGUMENT
 */
drogue_status drogue_smooth_image(uint8_t *out, uint16_t *column, const drogue_image *image);

#ifdef __cplusplus
}
#endif
#endif
