/* SPDX-License-Identifier: Apache-2.0 */
/* 3x3 Sobel gradient, border replicated; equal to cv::Sobel(CV_16S, BORDER_REPLICATE) in every pixel. */
#ifndef DROGUE_GRADIENT_H
#define DROGUE_GRADIENT_H

#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Horizontal derivative of a 3x3 window given by its left and right columns, top to bottom. */
static inline int16_t drogue_sobel_gx(int32_t l0, int32_t l1, int32_t l2, int32_t r0, int32_t r1, int32_t r2)
{
    return (int16_t)((r0 - l0) + 2 * (r1 - l1) + (r2 - l2));
}

/* Vertical derivative (y downward) given by the top and bottom rows, left to right. */
static inline int16_t drogue_sobel_gy(int32_t t0, int32_t t1, int32_t t2, int32_t b0, int32_t b1, int32_t b2)
{
    return (int16_t)((b0 - t0) + 2 * (b1 - t1) + (b2 - t2));
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

/* Gradient of a whole image; gx, gy, magnitude hold width_px * height_px each, rows adjacent.
 *
 *  return  DROGUE_OK, DROGUE_E_ARGUMENT
 */
drogue_status drogue_gradient_image(int16_t *gx, int16_t *gy, uint16_t *magnitude, const drogue_image *image);

#ifdef __cplusplus
}
#endif
#endif
