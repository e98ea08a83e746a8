/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the inner stage: the disc's edge where the grey begins to rise. */
#ifndef DROGUE_SHADE_H
#define DROGUE_SHADE_H

#include "fit.h"

typedef struct drogue_inner_shade {
    drogue_q16 dark_q16[3]; /* grey of the disc at its edge: change along x and y, mean */
    int32_t rise_q16;       /* to the level looked for */
} drogue_inner_shade;

/* Greys about the edge on the rays that agree; 0 when there are too few, or no rise. */
int drogue_inner_shade_find(drogue_inner_shade *out, const drogue_ray rays[RAYS], const drogue_image *image,
                            drogue_transfer transfer, const drogue_q16 v_px_q16[3], drogue_q16 within_px_q16);

/* Where the grey passes the level, as the edges of every so many-th ray; of the others, which are not placed, none. */
void drogue_inner_shade_cross(drogue_ray rays[RAYS], const drogue_image *image, drogue_transfer transfer,
                              const drogue_inner_shade *grey, const drogue_q16 v_px_q16[3], int32_t every);

#endif
