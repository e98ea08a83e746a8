/* SPDX-License-Identifier: Apache-2.0 */
/* Canny's non-maximum suppression on the L1 Sobel magnitude, and the subpixel offset across the edge; with both
 * thresholds equal to cv::Canny(aperture 3, L1) in every pixel once hysteresis has run over the whole image
 * (frontend.h). */
#ifndef DROGUE_CANNY_H
#define DROGUE_CANNY_H

#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_CANNY_TG22 13573 /* tan(22.5 degrees) * 2^15 */

/* Sector of the gradient: the neighbours that a maximum is compared with. */
typedef enum drogue_sector {
    DROGUE_SECTOR_HORIZONTAL = 0,  /* left, right */
    DROGUE_SECTOR_VERTICAL = 1,    /* above, below */
    DROGUE_SECTOR_DIAGONAL = 2,    /* above left, below right */
    DROGUE_SECTOR_ANTIDIAGONAL = 3 /* above right, below left */
} drogue_sector;

/* Sector of ax |gx| and ay |gy|, where what is slanted counts as diagonal; tg22 ax tan(22.5 degrees) * 2^15. */
static inline drogue_sector drogue_canny_sector_of(uint32_t ax, uint32_t ay, uint32_t tg22)
{
    const int flat = ay << 15 < tg22;
    const int steep = ay << 15 > tg22 + (ax << 16);
    return flat ? DROGUE_SECTOR_HORIZONTAL : steep ? DROGUE_SECTOR_VERTICAL : DROGUE_SECTOR_DIAGONAL;
}

/* Sector of a gradient: the signs tell the diagonals apart; (0, 0), which is no edge, counts as diagonal. This and
 * drogue_canny_neighbours() are the reference form, for tests and proofs: row loops and hardware write the same rule
 * for what they have at hand. */
static inline drogue_sector drogue_canny_sector(int16_t gx, int16_t gy)
{
    const uint32_t ax = (uint32_t)(gx < 0 ? -gx : gx);
    const uint32_t ay = (uint32_t)(gy < 0 ? -gy : gy);
    const drogue_sector sector = drogue_canny_sector_of(ax, ay, ax * (uint32_t)DROGUE_CANNY_TG22);
    return sector == DROGUE_SECTOR_DIAGONAL && (gx ^ gy) < 0 ? DROGUE_SECTOR_ANTIDIAGONAL : sector;
}

/* |gx| tan(22.5 degrees), rounded down; |gx| in [0, 1023]. In rows of 16-bit numbers the sector is horizontal where
 * |gy| is at most that, vertical where it exceeds it by more than 2 |gx|: the same as above but for (0, 0), which is no
 * edge. */
static inline uint16_t drogue_canny_tangent(uint16_t ax)
{
    return (uint16_t)((ax * (2u * (uint32_t)DROGUE_CANNY_TG22)) >> 16);
}

/* Step from a pixel to the neighbour 'after' it across the edge: x and y component in {-1, 0, 1}. */
static inline int32_t drogue_canny_step_x(drogue_sector sector)
{
    return sector == DROGUE_SECTOR_VERTICAL ? 0 : sector == DROGUE_SECTOR_ANTIDIAGONAL ? -1 : 1;
}
/* Downward. */
static inline int32_t drogue_canny_step_y(drogue_sector sector) { return sector == DROGUE_SECTOR_HORIZONTAL ? 0 : 1; }

/* Magnitudes on both sides of the edge at column x; 0 beyond the left and right border. */
static inline void drogue_canny_neighbours(int32_t *before, int32_t *after, drogue_sector sector,
                                           const uint16_t *const magnitude[3], int32_t x, int32_t width_px)
{
    int32_t dx = drogue_canny_step_x(sector);
    int32_t dy = drogue_canny_step_y(sector);
    *before = x - dx >= 0 && x - dx < width_px ? magnitude[1 - dy][x - dx] : 0;
    *after = x + dx >= 0 && x + dx < width_px ? magnitude[1 + dy][x + dx] : 0;
}

/* The same where the rows bring a 0 on both sides. */
static inline void drogue_canny_padded_neighbours(int32_t *before, int32_t *after, drogue_sector sector,
                                                  const uint16_t *const magnitude[3], int32_t x)
{
    int32_t dx = drogue_canny_step_x(sector);
    int32_t dy = drogue_canny_step_y(sector);
    *before = magnitude[1 - dy][x - dx];
    *after = magnitude[1 + dy][x + dx];
}

/* Is m a maximum across the edge?  before: left or the neighbour in the row above (above itself for the
 * vertical sector); after: the opposite one. Magnitudes outside the image are 0. */
static inline int drogue_canny_is_maximum(drogue_sector sector, int32_t before, int32_t m, int32_t after)
{
    if (sector == DROGUE_SECTOR_HORIZONTAL || sector == DROGUE_SECTOR_VERTICAL) {
        return m > before && m >= after;
    }
    return m > before && m > after;
}

/* The division that gives drogue_canny_offset_q5(), a bit at a time. */
typedef struct drogue_canny_vertex {
    int32_t curvature; /* 2 m - before - after */
    int32_t slope;     /* after - before */
    int32_t rest;      /* what is not divided yet */
    int32_t quotient;  /* its bits found so far */
} drogue_canny_vertex;

/* Begin the division. */
static inline drogue_canny_vertex drogue_canny_vertex_begin(int32_t before, int32_t m, int32_t after)
{
    drogue_canny_vertex v;
    v.curvature = 2 * m - before - after;
    v.slope = after - before;
    v.rest = 32 * v.slope + 33 * v.curvature; /* floor(rest / (2 curvature)) - 16 rounds 16 slope / curvature */
    v.quotient = 0;
    return v;
}

/* Find a bit of the quotient; called for bits 4 down to 0. */
static inline void drogue_canny_vertex_step(drogue_canny_vertex *v, int32_t bit)
{
    const int32_t part = v->curvature * (2 << bit);
    const int32_t fits = v->rest >= part;
    v->rest -= fits ? part : 0;
    v->quotient += fits ? 1 << bit : 0;
}

/* The offset, px Q5 in [-15, 15], once all bits are found. */
static inline int32_t drogue_canny_vertex_offset(const drogue_canny_vertex *v)
{
    const int32_t offset = v->quotient - 16; /* where |slope| < curvature: quotient in [0, 32) */
    const int32_t within = offset < -15 || v->slope <= -v->curvature ? -15 : v->slope >= v->curvature ? 15 : offset;
    return v->curvature <= 0 ? 0 : within;
}

/* Vertex of the parabola through (-1, before), (0, m), (1, after), where m is the maximum.
 *
 *  return  offset Q5 in [-15, 15], rounded to nearest, towards 'after' positive; 0 when all three are equal
 */
static inline int32_t drogue_canny_offset_q5(int32_t before, int32_t m, int32_t after)
{
    drogue_canny_vertex v = drogue_canny_vertex_begin(before, m, after);
    DROGUE_NOTE("canny: offset numerator", v.rest, 18);
    if (v.curvature > 0 && v.rest > 0) { /* one division; the steps are for hardware without one */
        const uint32_t quotient = (uint32_t)v.rest / (2u * (uint32_t)v.curvature);
        v.quotient = quotient < 31u ? (int32_t)quotient : 31;
    }
    return drogue_canny_vertex_offset(&v);
}

/* Direction class by the signs of the gradient, gy counted upward as in (2): 0..3 for I..IV.
 * (0, 0) has no direction and cannot be an edge; it gives 3. */
static inline uint32_t drogue_direction_class(int16_t gx, int16_t gy_down)
{
    const int gy = -gy_down;
    const uint32_t first = (gx >= 0) & (gy > 0); /* no two of them hold */
    const uint32_t second = (gx < 0) & (gy >= 0);
    const uint32_t third = (gx <= 0) & (gy < 0);
    return 3u - 3u * first - 2u * second - third;
}

#ifdef __cplusplus
}
#endif
#endif
