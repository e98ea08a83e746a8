/* SPDX-License-Identifier: Apache-2.0 */
/* Edges along rays across an ellipse, straight from the pixels: where the grey changes fastest along the normal. */
#ifndef DROGUE_RAYS_H
#define DROGUE_RAYS_H

#include "drogue/config.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_RAYS 64     /* evenly over the eccentric angle, two in each bin of a support */
#define DROGUE_RAY_EDGES 4 /* of a ray, the steepest */

/* An edge on a ray. */
typedef struct drogue_ray_edge {
    drogue_q16 at_px_q16; /* from the ellipse outwards */
    int32_t slope_q8;     /* DROGUE_RAY_WEIGHT times the step of grey across it; less of a blurred one */
    int32_t level_q8;     /* grey on it */
} drogue_ray_edge;

#define DROGUE_RAY_WEIGHT 12 /* a slope over the step of grey that it stands for */

/* A ray and the edges on it. */
typedef struct drogue_ray {
    drogue_q16 x_px_q16;                     /* on the ellipse */
    drogue_q16 y_px_q16;                     /* downward */
    int32_t nx_q14;                          /* outward normal */
    int32_t ny_q14;                          /* downward */
    drogue_q16 step_px_q16;                  /* between samples */
    drogue_ray_edge edges[DROGUE_RAY_EDGES]; /* in no order */
    uint32_t count;                          /* of edges */
} drogue_ray;

/* Place rays, half a pixel between their samples, without edges.
 *
 *  ellipse   region coordinates; b >= 1 px, a below 2^14 px
 *  phase     [0, 8): eighths of the angle between two rays by which they are turned; 4 puts two evenly into each bin
 *  from, to  [0, 32]: these alone, from one on to before another, and those across
 */
void drogue_rays_aim(drogue_ray rays[DROGUE_RAYS], const drogue_ellipse *ellipse, int32_t phase, int32_t from,
                     int32_t to);

/* What a way along a ray is along an axis, px Q16, by that component of the ray's normal. */
static inline int32_t drogue_ray_part(int32_t n_q14, drogue_q16 along_px_q16)
{
    return (int32_t)drogue_shr_round_s64(drogue_product(n_q14, along_px_q16), 14);
}

/* Grey along a ray.
 *
 *  grey   out, Q8: 'count' samples from 'from' outwards; beyond the image the grey of its border stands
 *  image  region's pixels
 *  from   px Q16 from the ellipse outwards, below 2^10 px
 */
void drogue_ray_read(int32_t *grey_q8, const drogue_ray *ray, const drogue_image *image, drogue_q16 from_px_q16,
                     int32_t count);

/* Light along a ray: the same of an image in sRGB, its levels decoded before they are interpolated, Q8 up to 255. */
void drogue_ray_read_light(int32_t *light_q8, const drogue_ray *ray, const drogue_image *image, drogue_q16 from_px_q16,
                           int32_t count);

/* Grey, or the light that a transfer function makes of it, along a ray. */
static inline void drogue_ray_read_as(int32_t *value_q8, const drogue_ray *ray, const drogue_image *image,
                                      drogue_transfer transfer, drogue_q16 from_px_q16, int32_t count)
{
    if (transfer == DROGUE_TRANSFER_SRGB) {
        drogue_ray_read_light(value_q8, ray, image, from_px_q16, count);
    } else {
        drogue_ray_read(value_q8, ray, image, from_px_q16, count);
    }
}

/* Add that, 'sign' times, to as many sums; the samples themselves stay in 'value'. */
void drogue_ray_add(int32_t *sum_q8, int32_t *value_q8, const drogue_ray *ray, const drogue_image *image,
                    drogue_transfer transfer, drogue_q16 from_px_q16, int32_t count, int32_t sign);

/* What is looked for along rays: where the grey rises outwards; where it rises or falls, whose slope is taken as
 * positive; and both from samples half as far apart, so that two edges 2 px apart are two. */
typedef enum drogue_ray_look {
    DROGUE_RAY_RISES,
    DROGUE_RAY_STEPS,
    DROGUE_RAY_FINE_RISES,
    DROGUE_RAY_LINES
} drogue_ray_look;

/* Place rays and find the edges on them.
 *
 *  reach   how far from the ellipse edges are looked for, [2, 512] px and limited to that; samples are half a pixel
 *          apart, of the last two looks a quarter, or 32 to the reach where that is more
 *  every   1 or 2: of the rays each, or every second one and no edges on the others
 *  least   least step of grey, grey levels, [0, 2^16]
 *  image, ellipse, phase  as above
 */
void drogue_rays_cast(drogue_ray rays[DROGUE_RAYS], const drogue_image *image, const drogue_ellipse *ellipse,
                      drogue_q16 reach_px_q16, int32_t phase, int32_t every, int32_t least, drogue_ray_look look);

#ifdef __cplusplus
}
#endif
#endif
