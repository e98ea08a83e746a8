/* SPDX-License-Identifier: Apache-2.0 */
/* Two 16-bit lanes in a word: how the row loops do the same sum for two pixels at once on a 32-bit core. Sums of lanes
 * are plain sums of words as long as no lane leaves [0, 65535].
 */
#ifndef DROGUE_LANES_H
#define DROGUE_LANES_H

#include <stdint.h>

/* Are there instructions for lanes (Armv7E-M)?  Called by the names that gcc and clang have for ACLE's intrinsics,
 * since the header of those is not on every machine. */
#if defined(__ARM_FEATURE_SIMD32) && defined(__GNUC__)
#define DROGUE_LANES_INSTRUCTIONS 1
#else
#define DROGUE_LANES_INSTRUCTIONS 0
#endif

/* Row loops, of the same bits either way: 1: plain ones that compilers turn into vector instructions; 0: what suits
 * cores without vector registers. */
#ifndef DROGUE_ROWS_PLAIN
#if defined(__SSE2__) || defined(_M_X64) || defined(__ARM_NEON) || defined(__ARM_FEATURE_MVE) || \
    defined(__ALTIVEC__) || defined(__riscv_vector)
#define DROGUE_ROWS_PLAIN 1
#else
#define DROGUE_ROWS_PLAIN 0
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_LANES(v) ((uint32_t)(v)*0x00010001u) /* v in both lanes, [0, 65535] */

/* The word as the machine reads it from four bytes, with the first byte lowest. */
static inline uint32_t drogue_first_lowest(uint32_t v)
{
    const uint32_t one = 1;
    if (*(const uint8_t *)&one == 1) { /* GCOVR_EXCL_BR_LINE: the machine's order; ./run matrix runs both */
        return v;
    }
    return (v << 24) | ((v << 8) & 0x00FF0000u) | ((v >> 8) & 0x0000FF00u) | (v >> 24); /* GCOVR_EXCL_LINE */
}

/* Lanes (x, x + 2) and (x + 1, x + 3) of four bytes x .. x + 3. */
static inline uint32_t drogue_lanes_even(uint32_t bytes) { return bytes & 0x00FF00FFu; }
static inline uint32_t drogue_lanes_odd(uint32_t bytes) { return (bytes >> 8) & 0x00FF00FFu; }

/* The lower lanes of two words: that of a, and that of b as the upper one. */
static inline uint32_t drogue_lanes_lower(uint32_t a, uint32_t b) { return (a & 0xFFFFu) | (b << 16); }

/* Sum of lanes and the even lanes of four bytes; an instruction of its own where there are instructions for lanes. */
static inline uint32_t drogue_lanes_add_even(uint32_t sum, uint32_t bytes)
{
#if DROGUE_LANES_INSTRUCTIONS
    return (uint32_t)__builtin_arm_uxtab16(sum, bytes);
#else
    return sum + drogue_lanes_even(bytes);
#endif
}

#ifdef __cplusplus
}
#endif
#endif
