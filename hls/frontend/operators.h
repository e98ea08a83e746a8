/* SPDX-License-Identifier: Apache-2.0 */
/* The pure operators of the pixel loop: windows in, result out, no state. Each is the core's formula behind plain
 * scalars, so that a compiler can make a pipelined block of it alone. */
#ifndef DROGUE_HLS_OPERATORS_H
#define DROGUE_HLS_OPERATORS_H

#include <stdint.h>

/* Vertical sum of smoothing. */
uint16_t drogue_hls_smooth_column(uint8_t p0, uint8_t p1, uint8_t p2, uint8_t p3, uint8_t p4);

/* Horizontal sum of smoothing, normalised. */
uint8_t drogue_hls_smooth_row(uint16_t c0, uint16_t c1, uint16_t c2, uint16_t c3, uint16_t c4);

/* Sobel gradient of a 3x3 window, its middle left out: gx in the lower half of the word, gy in the upper one. */
uint32_t drogue_hls_gradient(uint8_t t0, uint8_t t1, uint8_t t2, uint8_t c0, uint8_t c2, uint8_t b0, uint8_t b1,
                             uint8_t b2);

/* L1 magnitude of a gradient word. */
uint16_t drogue_hls_magnitude(uint32_t gradient);

/* Non-maximum suppression and thresholds: bit 0 candidate, bit 1 strong, bits 2-4 direction class + 1, all 0 when the
 * pixel is no candidate; bits 6-7 sector of the gradient; bits 16-31, 32-47, 48-63 the magnitudes before, at and after it,
 * across the edge. */
uint64_t drogue_hls_suppress(uint16_t t0, uint16_t t1, uint16_t t2, uint16_t c0, uint16_t c1, uint16_t c2, uint16_t b0,
                             uint16_t b1, uint16_t b2, uint32_t gradient, uint16_t low, uint16_t high);

/* Code of a candidate by what drogue_hls_suppress() says of it: bits 0-4 as there, bits 8-15 and 16-23 the subpixel offset
 * in x and y, Q5. */
uint32_t drogue_hls_locate(uint64_t suppressed);

/* Ring mask: is column x of a row within it? The bounds are those of drogue_mask_ring_row(). */
uint32_t drogue_hls_in_ring(int32_t x, int32_t centre2_x, int64_t least_x9, int64_t most);

#endif
