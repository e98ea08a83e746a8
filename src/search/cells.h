/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the search: loops over rows of cells. cells.c has two forms of the same bits, one for compilers that
 * vectorise. */
#ifndef DROGUE_CELLS_H
#define DROGUE_CELLS_H

#include "drogue/rim.h"

#define DROGUE_SEARCH_SCALES 4
#define DROGUE_SEARCH_RING 5 /* cells: the largest circle's reach */
#define DROGUE_SEARCH_RAYS 16

/* Directions of rays about a disc. */
extern const int16_t drogue_search_ray_x_q8[DROGUE_SEARCH_RAYS];
extern const int16_t drogue_search_ray_y_q8[DROGUE_SEARCH_RAYS];

/* The circle of eight cells (+-p, +-q), (+-q, +-p) lies between inner part and rim: about half the rim's radius. The
 * first serves the smallest drogues, in the first level alone. */
static const uint8_t drogue_ring_p[DROGUE_SEARCH_SCALES] = {2, 3, 4, DROGUE_SEARCH_RING};

/* out[x] = mean of two cells of each of two rows. */
void drogue_search_halve(uint8_t *out, int32_t width, const uint8_t *above, const uint8_t *below);

/* Contrasts of a dark disc at each place: the second darkest of the eight cells about it less the disc's mean; 0 unless
 * that is above 'least' and at most one of four of the eight is no brighter than the centre by more than that.
 *
 *  out    'count' grey levels
 *  rows   of cells, the middle one [DROGUE_SEARCH_RING]; a circle's reach about each place lies in them
 *  x      first place
 *  least  [0, 255]
 *  return 0 where all are 0
 */
uint8_t drogue_search_contrasts(uint8_t *out, const uint8_t *const rows[2 * DROGUE_SEARCH_RING + 1], int32_t x,
                                int32_t count, int scale, int32_t least);

#endif
