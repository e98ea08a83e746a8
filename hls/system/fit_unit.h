/* SPDX-License-Identifier: Apache-2.0 */
/* The unit for least squares over rays beside the soft core: of the edges on a ray the one that an offset is about, and sums over
 * those. */
#ifndef DROGUE_SYSTEM_FIT_UNIT_H
#define DROGUE_SYSTEM_FIT_UNIT_H

#include "../../src/inner/fit.h"

/* Of drogue_ray_sums those that are not of the edges themselves; each ray weighs 1, so that the last of 'normal' is their number. */
typedef struct fit_sums {
    int64_t normal[5];
    int64_t right[3];
    int64_t squares_q16;
    uint32_t rays;
    int32_t which; /* of the edges told is about the offset; -1: none. No sum */
} fit_sums;

enum { FIT_WORDS = sizeof(fit_sums) / 4 - 1 };

/* As they are told: an edge pushes out the one four before it. */
typedef struct fit_asked {
    fit_sums sums;
    drogue_q16 v_px_q16[3];
    drogue_q16 within_px_q16;
    int32_t nx_q14;
    int32_t ny_q14;
    int32_t edges[DROGUE_RAY_EDGES][2]; /* place, slope; the last one told is the last */
    uint32_t count;                     /* of edges told since the last ray */
} fit_asked;

void fit_unit_ray(const fit_asked *restrict asked, fit_sums *restrict out);

#endif
