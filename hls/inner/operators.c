/* SPDX-License-Identifier: Apache-2.0 */
/* The pure operators of the pixel loops; the formulas are the core's. */
#include "operators.h"

#include "../../src/inner/pass.h"
#include "../drogue_hls.h"

enum { COLUMN_BITS = 3, WINDOW = 0x1FF };

uint32_t drogue_hls_in_disc(int64_t left) { return left >= 0; }

uint32_t drogue_hls_is_dark(uint8_t level, uint8_t threshold, uint32_t in_disc)
{
    return (in_disc != 0) & (level <= threshold);
}

uint32_t drogue_hls_shift_window(uint32_t window, uint32_t column)
{
    return ((window << COLUMN_BITS) | column) & WINDOW;
}

uint32_t drogue_hls_erode(uint32_t window) { return window == WINDOW; }

uint32_t drogue_hls_dilate(uint32_t window) { return window != 0; }

uint32_t drogue_hls_darkness(uint8_t level, int32_t full, int32_t range, uint32_t in_disc)
{
    drogue_inner_ramp ramp;
    ramp.full = full;
    ramp.range = range;
    return (uint32_t)drogue_inner_darkness(level, &ramp) & drogue_hls_when(in_disc != 0);
}
