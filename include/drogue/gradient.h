/* SPDX-License-Identifier: Apache-2.0 */
/* 3x3 Sobel gradient, border replicated; equal to cv::Sobel(CV_16S, BORDER_REPLICATE) in every pixel. */
#ifndef DROGUE_GRADIENT_H
#define DROGUE_GRADIENT_H

#include "drogue/lanes.h"
#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_L1_MAX 1530      /* largest |gx| + |gy| of a 3x3 window: a corner's */
#define DROGUE_SOBEL_BIAS 1024u /* keeps derivatives in lanes positive: they lie in [-1020, 1020] */

/* The kernel's smoothing across the derivative: a + 2 b + c, of numbers or of 16-bit lanes (lanes.h). */
static inline uint32_t drogue_sobel_121(uint32_t a, uint32_t b, uint32_t c) { return a + c + (b << 1); }

/* Horizontal derivative of the smoothed columns left and right of a pixel, in lanes, plus the bias. */
static inline uint32_t drogue_sobel_dx(uint32_t left, uint32_t right)
{
    return right + DROGUE_LANES(DROGUE_SOBEL_BIAS) - left;
}

/* Difference of the rows below and above a pixel, in lanes, plus a quarter of the bias: three of them smoothed are the
 * vertical derivative (y downward) plus the bias. */
static inline uint32_t drogue_sobel_step(uint32_t above, uint32_t below)
{
    return below + DROGUE_LANES(DROGUE_SOBEL_BIAS / 4u) - above;
}

/* Lower lane without the bias. */
static inline int16_t drogue_sobel_unbias(uint32_t lanes)
{
    return (int16_t)((int32_t)(lanes & 0xFFFFu) - (int32_t)DROGUE_SOBEL_BIAS);
}

/* 1023 in the lanes that are not negative, 0 in the others. */
static inline uint32_t drogue_sobel_mask(uint32_t derivative)
{
    uint32_t signs = derivative & DROGUE_LANES(DROGUE_SOBEL_BIAS);
    return signs - (signs >> 10);
}

/* L1 magnitudes in lanes, of derivatives with their bias and their masks: |v| = bias + mask - ((bias + v) ^ mask). */
static inline uint32_t drogue_sobel_l1(uint32_t dx, uint32_t mask_x, uint32_t dy, uint32_t mask_y)
{
    return DROGUE_LANES(2u * DROGUE_SOBEL_BIAS) + mask_x + mask_y - (dx ^ mask_x) - (dy ^ mask_y);
}

/* Horizontal derivative of a 3x3 window given by its left and right columns, top to bottom. */
static inline int16_t drogue_sobel_gx(int32_t l0, int32_t l1, int32_t l2, int32_t r0, int32_t r1, int32_t r2)
{
    return drogue_sobel_unbias(drogue_sobel_dx(drogue_sobel_121((uint32_t)l0, (uint32_t)l1, (uint32_t)l2),
                                               drogue_sobel_121((uint32_t)r0, (uint32_t)r1, (uint32_t)r2)));
}

/* Vertical derivative (y downward) given by the top and bottom rows, left to right. */
static inline int16_t drogue_sobel_gy(int32_t t0, int32_t t1, int32_t t2, int32_t b0, int32_t b1, int32_t b2)
{
    return drogue_sobel_unbias(drogue_sobel_121(drogue_sobel_step((uint32_t)t0, (uint32_t)b0),
                                                drogue_sobel_step((uint32_t)t1, (uint32_t)b1),
                                                drogue_sobel_step((uint32_t)t2, (uint32_t)b2)));
}

/* L1 magnitude of any two derivatives, [0, 2040]; of a window's no more than DROGUE_L1_MAX. */
static inline uint16_t drogue_magnitude_l1(int16_t gx, int16_t gy)
{
    uint32_t dx = (uint32_t)(gx + (int32_t)DROGUE_SOBEL_BIAS);
    uint32_t dy = (uint32_t)(gy + (int32_t)DROGUE_SOBEL_BIAS);
    return (uint16_t)drogue_sobel_l1(dx, drogue_sobel_mask(dx), dy, drogue_sobel_mask(dy));
}

/* Gradient of a whole image; gx, gy, magnitude hold width_px * height_px each, rows adjacent.
 *
 *  image   sides in [1, DROGUE_MAX_SIDE]
 *  return  DROGUE_OK, DROGUE_E_ARGUMENT
 */
drogue_status drogue_gradient_image(int16_t *gx, int16_t *gy, uint16_t *magnitude, const drogue_image *image);

#ifdef __cplusplus
}
#endif
#endif
