/* SPDX-License-Identifier: Apache-2.0 */
/* Two 16-bit lanes in a word: how the row loops do the same sum for two pixels at once on a 32-bit core. Four pixels
 * x .. x + 3 are the lanes (x, x + 2) and (x + 1, x + 3). Sums of lanes are plain sums of words as long as no lane leaves
 * [0, 65535]; the byte order of the machine does not matter. */
#ifndef DROGUE_LANES_H
#define DROGUE_LANES_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_LANES(v) ((uint32_t)(v)*0x00010001u) /* v in both lanes, [0, 65535] */

/* The word that holds four bytes, the first of memory lowest, from the word as the machine reads it, and back. */
static inline uint32_t drogue_first_lowest(uint32_t v)
{
    const uint32_t one = 1;
    if (*(const uint8_t *)&one == 1) {
        return v;
    }
    return (v << 24) | ((v << 8) & 0x00FF0000u) | ((v >> 8) & 0x0000FF00u) | (v >> 24);
}

/* Lanes (x, x + 2) of four bytes x .. x + 3. */
static inline uint32_t drogue_lanes_even(uint32_t bytes) { return bytes & 0x00FF00FFu; }

/* The upper lane of one word before the lower lane of the next. */
static inline uint32_t drogue_lanes_between(uint32_t before, uint32_t after) { return (before >> 16) | (after << 16); }

#ifdef __cplusplus
}
#endif
#endif
