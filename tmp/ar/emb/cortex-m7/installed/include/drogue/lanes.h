/* SPDX-License-Identifier: Apache-2.0 */
/* Two 16-bit lanes in a word: how the row loops do the same sum for two pixels at once on a 32-bit core. Sums of lanes
 * are plain sums of words as long as no lane leaves [0, 65535].
 *
 * Four pixels x .. x + 3 are two words, the lanes (x, x + 2) and the lanes (x + 1, x + 3), the left pixel lower; a row
 * of pixels is a row of such pairs. The byte order of the machine does not matter. */
#ifndef DROGUE_LANES_H
#define DROGUE_LANES_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_LANES(v) ((uint32_t)(v)*0x00010001u) /* v in both lanes, [0, 65535] */

/* The word as the machine reads it from four bytes, with the first byte lowest. */
static inline uint32_t drogue_first_lowest(uint32_t v)
{
    const uint32_t one = 1;
    if (*(const uint8_t *)&one == 1) {
        return v;
    }
    return (v << 24) | ((v << 8) & 0x00FF0000u) | ((v >> 8) & 0x0000FF00u) | (v >> 24);
}

/* Lanes (x, x + 2) and (x + 1, x + 3) of four bytes x .. x + 3. */
static inline uint32_t drogue_lanes_even(uint32_t bytes) { return bytes & 0x00FF00FFu; }
static inline uint32_t drogue_lanes_odd(uint32_t bytes) { return (bytes >> 8) & 0x00FF00FFu; }

/* Row of lanes from 4 * fours bytes. */
static inline void drogue_lanes_row(uint32_t *row, const uint32_t *bytes, int32_t fours)
{
    int32_t i;
    for (i = 0; i < fours; i++) {
        uint32_t word = drogue_first_lowest(bytes[i]);
        row[2 * i] = drogue_lanes_even(word);
        row[2 * i + 1] = drogue_lanes_odd(word);
    }
}

/* Store pixel x of a row of lanes; x >= -4, 'row' points at pixel 0. */
static inline void drogue_lanes_set(uint32_t *row, int32_t x, uint32_t value)
{
    uint32_t *word = row + (x >> 2) * 2 + (x & 1);
    *word = (x & 2) != 0 ? (*word & 0xFFFFu) | (value << 16) : (*word & 0xFFFF0000u) | value;
}

/* Load pixel x. */
static inline uint32_t drogue_lanes_get(const uint32_t *row, int32_t x)
{
    uint32_t word = row[(x >> 2) * 2 + (x & 1)];
    return (x & 2) != 0 ? word >> 16 : word & 0xFFFFu;
}

/* The upper lane of one word before the lower lane of the next. */
static inline uint32_t drogue_lanes_between(uint32_t before, uint32_t after) { return (before >> 16) | (after << 16); }

#ifdef __cplusplus
}
#endif
#endif
