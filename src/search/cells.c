/* SPDX-License-Identifier: Apache-2.0 */
/* Loops over rows of cells, for compilers that vectorise and for lanes of a word. */
#include "cells.h"

#include "drogue/lanes.h"

#define MIDDLE DROGUE_SEARCH_RING

const int16_t drogue_search_ray_x_q8[DROGUE_SEARCH_RAYS] = {256,  237,  181,  98,  0, -98, -181, -237,
                                                            -256, -237, -181, -98, 0, 98,  181,  237};
const int16_t drogue_search_ray_y_q8[DROGUE_SEARCH_RAYS] = {0, 98,  181,  237,  256,  237,  181,  98,
                                                            0, -98, -181, -237, -256, -237, -181, -98};

static const uint8_t ring_q[DROGUE_SEARCH_SCALES] = {1, 1, 2, 2};
static const uint8_t inner_at[DROGUE_SEARCH_SCALES] = {1, 1, 2, 2}; /* samples of the disc beside its centre */

void drogue_search_halve(uint8_t *restrict out, int32_t width, const uint8_t *above, const uint8_t *below)
{
    int32_t x;
    for (x = 0; x < width; x++) {
        out[x] = (uint8_t)((above[2 * x] + above[2 * x + 1] + below[2 * x] + below[2 * x + 1] + 2) >> 2);
    }
}

#if DROGUE_ROWS_PLAIN

/* The two lowest of those seen, with one more. */
#define SEE(cell)                                       \
    do {                                                \
        const uint8_t v = (cell);                       \
        const uint8_t higher = v > lowest ? v : lowest; \
        lowest = v < lowest ? v : lowest;               \
        second = higher < second ? higher : second;     \
    } while (0)

uint8_t drogue_search_contrasts(uint8_t *restrict out, const uint8_t *const rows[2 * DROGUE_SEARCH_RING + 1], int32_t x,
                                int32_t count, int scale, int32_t least)
{
    const int32_t p = drogue_ring_p[scale];
    const int32_t q = ring_q[scale];
    const int32_t i = inner_at[scale];
    const uint8_t *middle = rows[MIDDLE] + x;
    const uint8_t *above = rows[MIDDLE - i] + x;
    const uint8_t *below = rows[MIDDLE + i] + x;
    const uint8_t *p_above = rows[MIDDLE - p] + x;
    const uint8_t *p_below = rows[MIDDLE + p] + x;
    const uint8_t *q_above = rows[MIDDLE - q] + x;
    const uint8_t *q_below = rows[MIDDLE + q] + x;
    const uint8_t room = (uint8_t)least;
    const uint8_t dimmest = (uint8_t)(255 - least);
    uint8_t any = 0;
    int32_t n;
    for (n = 0; n < count; n++) {
        const uint8_t centre = middle[n];
        const uint16_t sum = (uint16_t)(2 * centre + middle[n - i] + middle[n + i] + above[n] + below[n] + 3);
        const uint8_t mean = (uint8_t)(sum / 6);
        const uint8_t dim = centre < dimmest ? (uint8_t)(centre + room) : 255;
        uint8_t lowest = 255;
        uint8_t second = 255;
        uint8_t second_of_four;
        uint8_t contrast;
        SEE(q_above[n - p]);
        SEE(q_below[n + p]);
        SEE(p_above[n + q]);
        SEE(p_below[n - q]);
        second_of_four = second;
        SEE(p_above[n - q]);
        SEE(q_above[n + p]);
        SEE(q_below[n - p]);
        SEE(p_below[n + q]);
        contrast = second > mean ? (uint8_t)(second - mean) : 0;
        out[n] = ((second_of_four > dim) & (contrast > room)) ? contrast : 0;
        any |= out[n];
    }
    return any;
}

#else

/* Contrast of a dark disc at x: the second darkest of the eight cells about it less its mean; at most 'least' when
 * two of the first four are no brighter than the centre by more than that. */
static int32_t disc_contrast(const uint8_t *const rows[2 * DROGUE_SEARCH_RING + 1], int32_t x, int scale, int32_t least)
{
    const int32_t p = drogue_ring_p[scale];
    const int32_t q = ring_q[scale];
    const int32_t i = inner_at[scale];
    const uint8_t *middle = rows[MIDDLE] + x;
    const int32_t dim = *middle + least;
    int32_t lowest = 255;
    int32_t second = 255;
    int32_t v[8];
    int n;
    v[0] = rows[MIDDLE - q][x - p];
    v[1] = rows[MIDDLE + q][x + p];
    if (v[0] <= dim && v[1] <= dim) {
        return 0;
    }
    v[2] = rows[MIDDLE - p][x + q];
    v[3] = rows[MIDDLE + p][x - q];
    if ((v[0] <= dim) + (v[1] <= dim) + (v[2] <= dim) + (v[3] <= dim) > 1) {
        return 0;
    }
    v[4] = rows[MIDDLE - p][x - q];
    v[5] = rows[MIDDLE - q][x + p];
    v[6] = rows[MIDDLE + q][x - p];
    v[7] = rows[MIDDLE + p][x + q];
    for (n = 0; n < 8; n++) {
        if (v[n] < lowest) {
            second = lowest;
            lowest = v[n];
        } else if (v[n] < second) {
            second = v[n];
        }
    }
    return second - ((2 * *middle + middle[-i] + middle[i] + rows[MIDDLE - i][x] + rows[MIDDLE + i][x] + 3) / 6);
}

uint8_t drogue_search_contrasts(uint8_t *out, const uint8_t *const rows[2 * DROGUE_SEARCH_RING + 1], int32_t x,
                                int32_t count, int scale, int32_t least)
{
    uint8_t any = 0;
    for (; count > 0; count--) {
        const int32_t contrast = disc_contrast(rows, x++, scale, least);
        *out = contrast > least ? (uint8_t)contrast : 0;
        any |= *out++;
    }
    return any;
}

#endif
