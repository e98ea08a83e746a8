/* SPDX-License-Identifier: Apache-2.0 */
/* The unit for grey levels along a ray and the peaks of their slope beside the soft core. */
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

/* Grey in two steps, so that the first is free for the next sample in the second. */
typedef struct ray_rows_asked {
    uint8_t pixels[4]; /* upper row, lower row */
    int32_t x_px_q16;
} ray_rows_asked;

typedef struct ray_rows_said {
    int32_t upper_q8;
    int32_t lower_q8;
} ray_rows_said;

typedef struct ray_grey_asked {
    ray_rows_said rows;
    int32_t y_px_q16;
} ray_grey_asked;

typedef struct ray_grey_said {
    int32_t grey_q8;
} ray_grey_said;

/* A grey level more: the last five, the sum four samples before, the last two slopes. */
typedef struct ray_slope_asked {
    int32_t grey_q8[5];
    int32_t sum_before;
    int32_t before_q8;
    int32_t at_q8;
    int32_t least_q8; /* of a peak */
} ray_slope_asked;

/* Bits of 'peak': is the last slope before this one a peak? */
enum { RAY_RISES, RAY_FALLS };

typedef struct ray_slope_said {
    int32_t sum;
    int32_t slope_q8;
    uint32_t peak;
} ray_slope_said;

/* What the soft core asks of a peak, from its place on to what lets the unit go on. */
enum {
    RAY_PEAK_AT, /* the number of its slope; RAY_PEAK_FALLS more where it falls; below 0: no more of them */
    RAY_PEAK_BEFORE,
    RAY_PEAK_SLOPE,
    RAY_PEAK_AFTER,
    RAY_PEAK_LEVEL
};

enum { RAY_PEAK_FALLS = 256 };

/* What RAY_BEGIN is for. */
enum { RAY_GREY, RAY_SEEK = 1, RAY_EITHER = 2 /* what falls as well */ };

void ray_unit_place(const ray_place_asked *restrict asked, ray_place_said *restrict out);
void ray_unit_rows(const ray_rows_asked *restrict asked, ray_rows_said *restrict out);
void ray_unit_grey(const ray_grey_asked *restrict asked, ray_grey_said *restrict out);
void ray_unit_slope(const ray_slope_asked *restrict asked, ray_slope_said *restrict out);

#endif
