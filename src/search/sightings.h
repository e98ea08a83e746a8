/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the search: lists of the best few sightings. */
#ifndef DROGUE_SIGHTINGS_H
#define DROGUE_SIGHTINGS_H

#include "drogue/search.h"

/* Keep a sighting if it is among the best 'most', at most 32; of two of the same outline the better. */
void drogue_sightings_keep(drogue_sighting *best, int32_t *count, int32_t most, const drogue_sighting *c);

/* The score that a sighting must exceed to be among the best. */
uint32_t drogue_sightings_least(const drogue_sighting *best, int32_t count, int32_t most);

/* By falling score. */
void drogue_sightings_sort(drogue_sighting *best, int32_t count);

/* Its region: 2.6 radii a side about the middle, which holds an outline that is larger by a fifth, too. */
void drogue_sighting_frame(drogue_sighting *s);

#endif
