/* SPDX-License-Identifier: Apache-2.0 */
/* The pure operators of the pixel loop. */
#include "operators.h"

#include "../drogue_hls.h"
#include "drogue/canny.h"
#include "drogue/gradient.h"
#include "drogue/mask.h"
#include "drogue/smooth.h"

uint16_t drogue_hls_smooth_column(uint16_t p0, uint16_t p1, uint16_t p2, uint16_t p3, uint16_t p4)
{
    return (uint16_t)drogue_binomial5(p0, p1, p2, p3, p4);
}

uint8_t drogue_hls_smooth_row(uint16_t c0, uint16_t c1, uint16_t c2, uint16_t c3, uint16_t c4)
{
    return drogue_smooth_normalise(drogue_binomial5(c0, c1, c2, c3, c4));
}

uint64_t drogue_hls_sides(uint8_t t0, uint8_t t1, uint8_t t2, uint8_t c0, uint8_t c2, uint8_t b0, uint8_t b1,
                          uint8_t b2)
{
    return drogue_sobel_121(t0, c0, b0) | (uint64_t)drogue_sobel_121(t2, c2, b2) << 16 |
           (uint64_t)drogue_sobel_121(t0, t1, t2) << 32 | (uint64_t)drogue_sobel_121(b0, b1, b2) << 48;
}

uint32_t drogue_hls_gradient(uint64_t sides)
{
    const int32_t left = (int32_t)(sides & 0x3FFu);
    const int32_t right = (int32_t)(sides >> 16 & 0x3FFu);
    const int32_t above = (int32_t)(sides >> 32 & 0x3FFu);
    const int32_t below = (int32_t)(sides >> 48 & 0x3FFu);
    return (uint16_t)(right - left) | (uint32_t)(uint16_t)(below - above) << 16;
}

uint16_t drogue_hls_magnitude(uint32_t gradient)
{
    return drogue_magnitude_l1((int16_t)(uint16_t)(gradient & 0xFFFFu), (int16_t)(uint16_t)(gradient >> 16));
}

uint16_t drogue_hls_absolute(uint32_t half)
{
    const int16_t v = drogue_hls_derivative(half);
    return (uint16_t)((v < 0 ? -v : v) & 0x7FF);
}

uint32_t drogue_hls_tangent(uint16_t absolute_x) { return absolute_x * (uint32_t)DROGUE_CANNY_TG22; }

uint32_t drogue_hls_sector(uint32_t gradient, uint16_t absolute_x, uint16_t absolute_y, uint32_t tangent)
{
    const int16_t gx = drogue_hls_derivative(gradient & 0xFFFu);
    const int16_t gy = drogue_hls_derivative(gradient >> 16);
    const drogue_sector sector = drogue_canny_sector_of(absolute_x, absolute_y, tangent & 0x1FFFFFFu);
    const int anti = sector == DROGUE_SECTOR_DIAGONAL && (gx ^ gy) < 0;
    /* Three bits of the class are all there are: no multiplier for them. */
    return (uint32_t)(anti ? DROGUE_SECTOR_ANTIDIAGONAL : sector) | ((drogue_direction_class(gx, gy) + 1u) & 7u) << 2;
}

uint64_t drogue_hls_neighbours(uint16_t t0, uint16_t t1, uint16_t t2, uint16_t c0, uint16_t c1, uint16_t c2,
                               uint16_t b0, uint16_t b1, uint16_t b2, uint32_t sector)
{
    const uint32_t is = sector & 3u;
    const uint32_t horizontal = drogue_hls_when(is == DROGUE_SECTOR_HORIZONTAL);
    const uint32_t vertical = drogue_hls_when(is == DROGUE_SECTOR_VERTICAL);
    const uint32_t diagonal = drogue_hls_when(is == DROGUE_SECTOR_DIAGONAL);
    const uint32_t antidiagonal = drogue_hls_when(is == DROGUE_SECTOR_ANTIDIAGONAL);
    const uint32_t before = (c0 & horizontal) | (t1 & vertical) | (t0 & diagonal) | (t2 & antidiagonal);
    const uint32_t after = (c2 & horizontal) | (b1 & vertical) | (b2 & diagonal) | (b0 & antidiagonal);
    return before | (uint64_t)c1 << 16 | (uint64_t)after << 32;
}

/* Magnitudes of a neighbours word: 11 bits each. */
static int32_t magnitude(uint64_t neighbours, int32_t at) { return (int32_t)(neighbours >> (16 * at) & 0x7FFu); }

uint32_t drogue_hls_suppress(uint64_t neighbours, uint32_t sector, uint16_t low, uint16_t high)
{
    const int32_t m = magnitude(neighbours, 1);
    const uint32_t code = 1u | (uint32_t)(m > high) << 1 | (sector & 0x1Cu);
    const int is_maximum =
        drogue_canny_is_maximum((drogue_sector)(sector & 3u), magnitude(neighbours, 0), m, magnitude(neighbours, 2));
    return code & drogue_hls_when((m > low) & is_maximum);
}

/* Bits 0-19 rest, 20-24 quotient, 32-47 slope, 48-63 curvature. Once the division begins, bits 25-27 instead of the slope: how
 * the bounds of the offset stand. */
enum { BELOW = 1, ABOVE = 2, FLAT = 4 };

static uint64_t pack_vertex(const drogue_canny_vertex *v)
{
    return ((uint32_t)v->rest & 0xFFFFFu) | (uint32_t)v->quotient << 20 |
           (uint64_t)((uint32_t)v->slope & 0xFFFFu) << 32 | (uint64_t)((uint32_t)v->curvature & 0xFFFFu) << 48;
}

static drogue_canny_vertex unpack_vertex(uint64_t word)
{
    const uint32_t low = (uint32_t)(word & 0xFFFFFFFFu);
    drogue_canny_vertex v;
    v.rest = (int32_t)(low << 12) >> 12;
    v.quotient = (int32_t)(low >> 20 & 31u);
    v.slope = (int16_t)(uint16_t)(word >> 32 & 0xFFFFu);
    v.curvature = (int16_t)(uint16_t)(word >> 48);
    return v;
}

uint64_t drogue_hls_vertex(uint64_t neighbours)
{
    drogue_canny_vertex v =
        drogue_canny_vertex_begin(magnitude(neighbours, 0), magnitude(neighbours, 1), magnitude(neighbours, 2));
    v.rest = 0;
    return pack_vertex(&v);
}

uint64_t drogue_hls_vertex_rest(uint64_t vertex)
{
    drogue_canny_vertex v = unpack_vertex(vertex);
    const uint32_t bounds = (v.slope + v.curvature <= 0 ? (uint32_t)BELOW : 0u) |
                            (v.slope >= v.curvature ? (uint32_t)ABOVE : 0u) | (v.curvature <= 0 ? (uint32_t)FLAT : 0u);
    v.rest = 32 * (v.slope + v.curvature) + v.curvature;
    v.slope = 0;
    return pack_vertex(&v) | bounds << 25;
}

uint64_t drogue_hls_vertex_step(uint64_t vertex, int32_t bit)
{
    drogue_canny_vertex v = unpack_vertex(vertex);
    drogue_canny_vertex_step(&v, bit);
    return pack_vertex(&v) | (vertex & 7u << 25);
}

uint32_t drogue_hls_offset(uint64_t vertex, uint32_t sector)
{
    const uint32_t bounds = (uint32_t)(vertex >> 25 & 7u);
    const drogue_canny_vertex v = {1, bounds & BELOW ? -1 : bounds & ABOVE ? 1 : 0, 0, unpack_vertex(vertex).quotient};
    const int32_t offset_q5 = bounds & FLAT ? 0 : drogue_canny_vertex_offset(&v);
    const uint32_t is = sector & 3u;
    /* drogue_canny_step_x(), _y() times the offset, without a multiplier */
    const int32_t sideways = is == DROGUE_SECTOR_ANTIDIAGONAL ? -offset_q5 : offset_q5;
    const uint32_t dx = (uint8_t)(is == DROGUE_SECTOR_VERTICAL ? 0 : sideways);
    const uint32_t dy = (uint8_t)(is == DROGUE_SECTOR_HORIZONTAL ? 0 : offset_q5);
    return dx | dy << 8;
}

uint32_t drogue_hls_in_ring(int64_t square, int64_t square_x9, int64_t least_x9, int64_t most)
{
    return (uint32_t)(square_x9 >= least_x9) & (uint32_t)(square <= most);
}
