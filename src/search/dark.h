/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the search: a dark disc by itself, without a rim about it. What is darker than all about it by most of its
 * grey is rare, even where texture has more contrast than the drogue; and a model that knows the inner part's radius
 * knows the rim's from it. */
#ifndef DROGUE_DARK_H
#define DROGUE_DARK_H

#include "drogue/rim.h"

/* The circle about a disc's middle where grey is above its middle cell's by half of its contrast: the median of 16
 * rays, when at least 12 of them end within a quarter of it and a cell. Its score is the share of the contrast in the
 * brighter grey, Q8, times the square of the number of those rays.
 *
 *  out    centre (0, 0)
 *  least  what its score must exceed
 *  return 1, or 0 where there is none
 */
int drogue_dark_find(drogue_rim *out, const drogue_search_level *level, const drogue_search_disc *disc, uint32_t least);

#endif
