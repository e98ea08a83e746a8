/* SPDX-License-Identifier: Apache-2.0 */
/* The unit for grey levels along a ray beside the soft core. */
#ifndef DROGUE_SYSTEM_RAY_UNIT_H
#define DROGUE_SYSTEM_RAY_UNIT_H

#include <stdint.h>

/* A sample of an image whose first byte lies there. */
typedef struct ray_place_asked {
    int32_t width_px;
    int32_t height_px;
    int32_t first;
    int32_t stride;
    int32_t x_px_q16;
    int32_t y_px_q16;
} ray_place_asked;

typedef struct ray_place_said {
    int32_t at[4]; /* bytes of the pixels about it: upper row, lower row */
    int32_t x_px_q16;
    int32_t y_px_q16;
} ray_place_said;

typedef struct ray_grey_asked {
    uint8_t pixels[4]; /* upper row, lower row */
    int32_t x_px_q16;
    int32_t y_px_q16;
} ray_grey_asked;

typedef struct ray_grey_said {
    int32_t grey_q8;
} ray_grey_said;

void ray_unit_place(const ray_place_asked *restrict asked, ray_place_said *restrict out);
void ray_unit_grey(const ray_grey_asked *restrict asked, ray_grey_said *restrict out);

#endif
