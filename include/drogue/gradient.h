/* SPDX-License-Identifier: Apache-2.0 */
/* 3x3 Sobel gradient, border replicated; equal to cv::Sobel(CV_16S, BORDER_REPLICATE) in every pixel. */
#ifndef DROGUE_GRADIENT_H
#define DROGUE_GRADIENT_H

#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The kernel's smoothing across the derivative, a + 2 b + c modulo 2^32: negative numbers may pass through. */
static inline uint32_t drogue_sobel_121(uint32_t a, uint32_t b, uint32_t c) { return a + c + (b << 1); }

/* Horizontal derivative of a 3x3 window given by its left and right columns, top to bottom. */
static inline int16_t drogue_sobel_gx(int32_t l0, int32_t l1, int32_t l2, int32_t r0, int32_t r1, int32_t r2)
{
    return (int16_t)(drogue_sobel_121((uint32_t)r0, (uint32_t)r1, (uint32_t)r2) -
                     drogue_sobel_121((uint32_t)l0, (uint32_t)l1, (uint32_t)l2));
}

/* Vertical derivative (y downward) given by the top and bottom rows, left to right. */
static inline int16_t drogue_sobel_gy(int32_t t0, int32_t t1, int32_t t2, int32_t b0, int32_t b1, int32_t b2)
{
    return (int16_t)drogue_sobel_121((uint32_t)(b0 - t0), (uint32_t)(b1 - t1), (uint32_t)(b2 - t2));
}

/* L1 magnitude, [0, 2040]. */
static inline uint16_t drogue_magnitude_l1(int16_t gx, int16_t gy)
{
    return (uint16_t)((gx < 0 ? -gx : gx) + (gy < 0 ? -gy : gy));
}

/* Gradient of one row.
 *
 *  gx, gy     out, width_px each, grey levels * 8 in [-1020, 1020]
 *  magnitude  out, width_px, L1
 *  rows       the rows y-1, y, y+1, border already replicated
 *  width_px   [1, DROGUE_MAX_SIDE]
 */
void drogue_gradient_row(int16_t *gx, int16_t *gy, uint16_t *magnitude, const uint8_t *const rows[3], int32_t width_px);

/* The same for rows that bring their border with them; of the gradients only those that matter to the edge detector.
 *
 *  slopes     out, room for width_px: the pixels whose magnitude exceeds 'low', ascending
 *  magnitude  out, width_px, L1
 *  rows       the rows y-1, y, y+1, each readable from pixel -1 to width_px
 *  return     number of slopes
 */
uint32_t drogue_gradient_padded_row(drogue_slope *slopes, uint16_t *magnitude, const uint8_t *const rows[3],
                                    int32_t width_px, int32_t low);

/* Gradient of a whole image; gx, gy, magnitude hold width_px * height_px each, rows adjacent.
 *
 *  return  DROGUE_OK, DROGUE_E_ARGUMENT
 */
drogue_status drogue_gradient_image(int16_t *gx, int16_t *gy, uint16_t *magnitude, const drogue_image *image);

#ifdef __cplusplus
}
#endif
#endif
