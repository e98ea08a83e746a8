/* SPDX-License-Identifier: Apache-2.0 */
/* The pure operators of the pixel loop: windows in, result out, no state. Each is the core's formula behind plain
 * scalars, so that a compiler can make a pipelined block of it alone. */
#ifndef DROGUE_HLS_OPERATORS_H
#define DROGUE_HLS_OPERATORS_H

#include <stdint.h>

/* Vertical sum of smoothing. */
uint16_t drogue_hls_smooth_column(uint16_t p0, uint16_t p1, uint16_t p2, uint16_t p3, uint16_t p4);

/* Horizontal sum of smoothing, normalised. */
uint8_t drogue_hls_smooth_row(uint16_t c0, uint16_t c1, uint16_t c2, uint16_t c3, uint16_t c4);

/* Sobel gradient of a 3x3 window, its middle left out: the sums of its sides, left, right, top, bottom, from the lowest bits
 * up, 16 each; of these the gradient, gx in the lower half of the word, gy in the upper one. */
uint64_t drogue_hls_sides(uint8_t t0, uint8_t t1, uint8_t t2, uint8_t c0, uint8_t c2, uint8_t b0, uint8_t b1,
                          uint8_t b2);
uint32_t drogue_hls_gradient(uint64_t sides);

/* L1 magnitude of a gradient word. */
uint16_t drogue_hls_magnitude(uint32_t gradient);

/* A derivative in a half of a gradient word: 11 bits and a sign, which keeps what follows narrow. */
static inline int16_t drogue_hls_derivative(uint32_t half) { return (int16_t)((int32_t)(half << 20) >> 20); }

/* |gx| or |gy| of a half of a gradient word. */
uint16_t drogue_hls_absolute(uint32_t half);

/* |gx| tan(22.5 degrees) * 2^15. */
uint32_t drogue_hls_tangent(uint16_t absolute_x);

/* Bits 0-1 sector of a gradient word by its tangent, bits 2-4 its direction class + 1. */
uint32_t drogue_hls_sector(uint32_t gradient, uint16_t absolute_x, uint16_t absolute_y, uint32_t tangent);

/* Magnitudes of a 3x3 window before, at and after its middle, across the edge of the sector: bits 0-15, 16-31, 32-47. */
uint64_t drogue_hls_neighbours(uint16_t t0, uint16_t t1, uint16_t t2, uint16_t c0, uint16_t c1, uint16_t c2,
                               uint16_t b0, uint16_t b1, uint16_t b2, uint32_t sector);

/* Non-maximum suppression and thresholds: bit 0 candidate, bit 1 strong, bits 2-4 direction class + 1, all 0 when the
 * pixel is no candidate. */
uint32_t drogue_hls_suppress(uint64_t neighbours, uint32_t sector, uint16_t low, uint16_t high);

/* Subpixel offset across the edge: drogue_canny_vertex in a word. Begun, in two parts, a step, and the offset, Q5: that in
 * x in bits 0-7, that in y in bits 8-15. */
uint64_t drogue_hls_vertex(uint64_t neighbours);
uint64_t drogue_hls_vertex_rest(uint64_t vertex);
uint64_t drogue_hls_vertex_step(uint64_t vertex, int32_t bit);
uint32_t drogue_hls_offset(uint64_t vertex, uint32_t sector);

/* Ring mask: is the column whose (2x - centre2_x)^2 this is within it? The bounds are what drogue_mask_in_ring() leaves
 * to the columns of a row. */
uint32_t drogue_hls_in_ring(int64_t square, int64_t square_x9, int64_t least_x9, int64_t most);

#endif
