/* SPDX-License-Identifier: Apache-2.0 */
/* The pure operators of the pixel loops: no state, scalars alone, so that a compiler can make a pipelined block of each. */
#ifndef DROGUE_HLS_INNER_OPERATORS_H
#define DROGUE_HLS_INNER_OPERATORS_H

#include <stdint.h>

/* Is a pixel in the disc? 'left' is its drogue_hls_walk's along the row. */
uint32_t drogue_hls_in_disc(int64_t left);

/* Is a pixel dark? */
uint32_t drogue_hls_is_dark(uint8_t level, uint8_t threshold, uint32_t in_disc);

/* 3x3 windows of bits, a column in three adjacent bits: the same with a column more, the oldest one dropped. */
uint32_t drogue_hls_shift_window(uint32_t window, uint32_t column);
uint32_t drogue_hls_erode(uint32_t window);  /* all set? */
uint32_t drogue_hls_dilate(uint32_t window); /* any set? */

/* Darkness of a grey level in [0, range], 0 outside the disc. */
uint32_t drogue_hls_darkness(uint8_t level, int32_t full, int32_t range, uint32_t in_disc);

#endif
