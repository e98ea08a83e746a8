/* SPDX-License-Identifier: Apache-2.0 */
/* The rim about a dark disc in one level of the search: rays from the disc, each to a step, and the circle through the
 * places where they meet it. A drogue has more than one such circle: its rim, its canopy's inner edge. */
#ifndef DROGUE_RIM_H
#define DROGUE_RIM_H

#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_SEARCH_REACH 18   /* cells that a ray goes at most */
#define DROGUE_SEARCH_ROWS 48    /* rows that a level keeps: two reaches and what a dark disc waits */
#define DROGUE_SEARCH_PENDING 32 /* dark discs of a level that may still grow with the next row */

/* A dark disc in a level. */
typedef struct drogue_search_disc {
    int32_t x;        /* cells */
    int32_t y;        /* cells, downward */
    int32_t ring_q4;  /* radius of the circle that is brighter, cells Q4; the rim's is about twice as large */
    int32_t contrast; /* grey levels */
} drogue_search_disc;

/* Dark discs that wait, in the order they were met; each field by itself, so that loops over them become vector
 * instructions. */
typedef struct drogue_search_pending {
    int32_t count;                           /* of discs */
    int32_t x[DROGUE_SEARCH_PENDING];        /* as of drogue_search_disc */
    int32_t y[DROGUE_SEARCH_PENDING];        /* likewise */
    int32_t ring_q4[DROGUE_SEARCH_PENDING];  /* likewise */
    int32_t contrast[DROGUE_SEARCH_PENDING]; /* likewise */
} drogue_search_pending;

/* Block means of a frame in a ring of rows. */
typedef struct drogue_search_level {
    uint8_t *rows;                 /* DROGUE_SEARCH_ROWS x width */
    int32_t width;                 /* cells */
    int32_t rows_in;               /* fed so far */
    drogue_search_pending pending; /* discs that may still grow with the next row */
} drogue_search_level;

/* Row y, one of the last DROGUE_SEARCH_ROWS. */
static inline const uint8_t *drogue_search_level_row(const drogue_search_level *level, int32_t y)
{
    return level->rows + (y % DROGUE_SEARCH_ROWS) * level->width;
}

#define DROGUE_RIMS 6 /* circles about a disc: of either sign by the largest, the outermost and the innermost steps */

/* Circle relative to the disc, cells Q4. */
typedef struct drogue_rim {
    int32_t x_q4;      /* centre */
    int32_t y_q4;      /* centre, downward */
    int32_t radius_q4; /* of the circle */
    uint32_t score;    /* the square of the number of rays that meet it, times the sum of its mean step and the disc's
                          contrast */
} drogue_rim;

/* The score that no circle about a disc exceeds. */
uint32_t drogue_rim_most(const drogue_search_disc *disc);

/* Find circles, be they steps to brighter or to darker: those that at least 9 of 16 rays meet and that suit the disc.
 *
 *  least   what a score must exceed
 *  return  how many there are
 */
int32_t drogue_rim_find(drogue_rim rims[DROGUE_RIMS], const drogue_search_level *level, const drogue_search_disc *disc,
                        uint32_t least);

#ifdef __cplusplus
}
#endif
#endif
