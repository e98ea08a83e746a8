/* SPDX-License-Identifier: Apache-2.0 */
/* The few types that several stages share: image, region, camera, drogue model, edge point, arc. */
#ifndef DROGUE_TYPES_H
#define DROGUE_TYPES_H

#include <stddef.h>
#include <stdint.h>

#include "drogue/fixed.h"
#include "drogue/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_MAX_SIDE 2048 /* px, largest width and height of a region */

/* 8-bit grey image of the caller's, row y at data + y * stride.
 * The centre of the top-left pixel is (0, 0), x right, y down. */
typedef struct drogue_image {
    const uint8_t *data; /* the top row's first pixel */
    int32_t width_px;    /* columns */
    int32_t height_px;   /* rows */
    int32_t stride;      /* bytes from row to row, >= width_px */
} drogue_image;

/* Can a stage work on this image: sides in [1, DROGUE_MAX_SIDE], a stride that holds a row, data there? */
static inline int drogue_image_valid(const drogue_image *image)
{
    return image->data != NULL && image->width_px >= 1 && image->width_px <= DROGUE_MAX_SIDE && image->height_px >= 1 &&
           image->height_px <= DROGUE_MAX_SIDE && image->stride >= image->width_px;
}

/* First pixel of row y, [0, height_px). */
static inline const uint8_t *drogue_image_row(const drogue_image *image, int32_t y)
{
    return image->data + (size_t)y * (size_t)image->stride;
}

/* Rectangle of whole pixels [x, x + width) x [y, y + height); may reach past the image. */
typedef struct drogue_region {
    int32_t x_px;      /* left column, any */
    int32_t y_px;      /* top row, any */
    int32_t width_px;  /* columns, any; without one it is empty */
    int32_t height_px; /* rows, any */
} drogue_region;

/* Clip one side [*at, *at + *length) of a region to [0, limit), for any three numbers: 0 <= *at and 0 <= *length after,
 * and *at + *length <= limit where limit >= 0. *length is 0 when nothing is left. */
void drogue_clip(int32_t *at, int32_t *length, int32_t limit);

/* Pinhole camera with Brown-Conrady distortion, in OpenCV's order and sense. */
typedef struct drogue_camera {
    drogue_q16 fx_px_q16; /* > 0 */
    drogue_q16 fy_px_q16; /* > 0 */
    drogue_q16 cx_px_q16; /* principal point */
    drogue_q16 cy_px_q16; /* principal point, downward */
    drogue_q16 k1_q16;    /* radial, of r^2; undistort.h has the range */
    drogue_q16 k2_q16;    /* of r^4 */
    drogue_q16 p1_q16;    /* tangential */
    drogue_q16 p2_q16;    /* tangential */
    drogue_q16 k3_q16;    /* of r^6 */
} drogue_camera;

/* The drogue: its end plane is a circle, its inner black part a disc behind it on the axis. */
typedef struct drogue_model {
    drogue_q16 rim_radius_m_q16;   /* > 0; of a rim under a millimetre variances may round to 0 */
    drogue_q16 inner_radius_m_q16; /* at most the rim's; 0: inner part unknown */
    drogue_q16 inner_depth_m_q16;  /* from the end plane along the axis, into the drogue, >= 0 */
} drogue_model;

/* Are the drogue's lengths within their ranges? */
static inline int drogue_model_valid(const drogue_model *m)
{
    return m->rim_radius_m_q16 > 0 && m->inner_radius_m_q16 >= 0 && m->inner_radius_m_q16 <= m->rim_radius_m_q16 &&
           m->inner_depth_m_q16 >= 0;
}

/* Ellipse: centre, semi-axes a >= b, angle of the major axis from +x towards +y in (-pi/2, pi/2]. */
typedef struct drogue_ellipse {
    drogue_q16 xc_px_q16;     /* centre */
    drogue_q16 yc_px_q16;     /* centre, downward */
    drogue_q16 a_px_q16;      /* semi-major axis */
    drogue_q16 b_px_q16;      /* semi-minor axis */
    drogue_q16 angle_rad_q16; /* of the major axis */
} drogue_ellipse;

/* Is the angle within [-pi/2, pi/2]? */
static inline int drogue_ellipse_angle_valid(const drogue_ellipse *e)
{
    return e->angle_rad_q16 >= -DROGUE_Q16_HALF_PI && e->angle_rad_q16 <= DROGUE_Q16_HALF_PI;
}

/* Pixel of a row, its Sobel gradient, and the subpixel offset across the edge once that is known. */
typedef struct drogue_slope {
    uint16_t x;   /* column */
    int16_t gx;   /* grey levels * 8, [-1020, 1020] */
    int16_t gy;   /* y downward */
    int8_t dx_q5; /* px, [-15, 15] */
    int8_t dy_q5; /* px, downward */
} drogue_slope;

/* One edge point. The pixel is (x_q5 + 16) >> 5 in region coordinates; the low bits are the subpixel
 * offset across the edge, at most 15/32 px each way. */
typedef struct drogue_edge {
    uint32_t arc;  /* while streaming: provisional label; after: index into the arc table, or DROGUE_NO_ARC */
    uint16_t x_q5; /* px, region coordinates */
    uint16_t y_q5; /* px, downward */
    int16_t gx;    /* Sobel gradient, grey levels * 8, [-1020, 1020] */
    int16_t gy;    /* y downward */
} drogue_edge;

#define DROGUE_NO_ARC UINT32_C(0xFFFFFFFF) /* in place of an index */

/* Place of an edge point, region coordinates: px Q16, and its pixel. */
static inline drogue_q16 drogue_edge_x_q16(const drogue_edge *e) { return (drogue_q16)((int32_t)e->x_q5 * 2048); }
static inline drogue_q16 drogue_edge_y_q16(const drogue_edge *e) { return (drogue_q16)((int32_t)e->y_q5 * 2048); }
static inline int32_t drogue_edge_x_px(const drogue_edge *e) { return ((int32_t)e->x_q5 + 16) >> 5; }
static inline int32_t drogue_edge_y_px(const drogue_edge *e) { return ((int32_t)e->y_q5 + 16) >> 5; }

/* Edge points [first, first + count) of the edge list, 8-connected, one direction class (0..3 = I..IV). */
typedef struct drogue_arc {
    uint32_t first;     /* index of its first point */
    uint32_t count;     /* of its points */
    uint32_t direction; /* class, by drogue_direction_class() */
} drogue_arc;

/* Polarity of an arc or of the whole outline. */
typedef enum drogue_polarity {
    DROGUE_POLARITY_DARK = 0,   /* darker inside: the gradient points outward */
    DROGUE_POLARITY_BRIGHT = 1, /* brighter inside: the gradient points inward */
    DROGUE_POLARITY_BOTH = 2    /* configured: either is tried; found: neither holds for all of it */
} drogue_polarity;

#ifdef __cplusplus
}
#endif
#endif
