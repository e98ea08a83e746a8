/* SPDX-License-Identifier: Apache-2.0 */
/* The front end's row kernels: smoothing, gradient, suppression, in two forms of the same bits. rows_lanes.c keeps two
 * pixels in a word, for cores without vector registers; rows_plain.c has loops over 8- and 16-bit rows that compilers
 * vectorise. Each lays out the line buffers of a workspace as it likes. */
#ifndef DROGUE_ROWS_H
#define DROGUE_ROWS_H

#include "drogue/frontend.h"
#include "drogue/lanes.h"

enum {
    DROGUE_ROW_PARTS = DROGUE_ROWS_PLAIN ? 1 : 2, /* in which a row's maxima come */
    DROGUE_CODE_CANDIDATE = 1,
    DROGUE_CODE_STRONG = 2,
    DROGUE_CODE_CLASS_SHIFT = 2,
    DROGUE_CODE_CLASS_MASK = 0x1C
};

/* Half of a row, rounded up to four pixels: 2 * half - 7 <= width_px <= 2 * half. */
static inline int32_t drogue_row_half(const drogue_frontend *f) { return (f->width_px + 7) / 8 * 4; }

/* Codes of row y; two rows are kept. */
static inline uint8_t *drogue_code_row(const drogue_frontend *f, int32_t y)
{
    return f->workspace->code_rows + (y & 1) * 2 * drogue_row_half(f);
}

/* Where the kernels leave the maxima of a part, ascending: gradient, offset where they are in the ring. */
drogue_slope *drogue_rows_points(const drogue_frontend *f);

/* Zero what is read before it is written. */
void drogue_rows_begin(const drogue_frontend *f);

/* Pixel 0 of row y as it came in; five rows are kept. */
static inline uint8_t *drogue_raw_row(const drogue_frontend *f, int32_t y)
{
    return f->workspace->raw_rows + (y % 5) * (2 * drogue_row_half(f) + 4) + 2;
}

/* Row y of pixels comes in as a smoothed one. */
void drogue_rows_take_smoothed(const drogue_frontend *f, int32_t y, const uint8_t *pixels);

/* Smooth row y; the five about it have been taken. */
void drogue_rows_smooth(const drogue_frontend *f, int32_t y);

/* Gradient and magnitude of row y; the three smoothed rows about it are there. */
void drogue_rows_gradient(drogue_frontend *f, int32_t y);

/* List the maxima across the edge among the pixels of a part of row y that exceed the low threshold, and note their codes;
 * part 0 clears the row's. The gradient of rows y - 1 to y + 1 is there. Returns their number. */
uint32_t drogue_rows_maxima(drogue_frontend *f, int32_t y, int32_t part);

/* Code of a maximum; outside the ring it is in no arc and needs no offset. */
static inline uint32_t drogue_rows_code(const drogue_frontend *f, int32_t m)
{
    return m > f->config.canny_high ? DROGUE_CODE_CANDIDATE | DROGUE_CODE_STRONG : DROGUE_CODE_CANDIDATE;
}

static inline int drogue_rows_in_ring(const drogue_frontend *f, const drogue_ring_row *ring, int32_t x)
{
    return !f->config.use_ring || drogue_ring_row_holds(ring, x);
}

/* Class of a maximum in the ring, as part of its code; its offset is put down. */
static inline uint32_t drogue_rows_place(drogue_slope *at, drogue_sector sector, int32_t before, int32_t m,
                                         int32_t after)
{
    const int32_t offset_q5 = drogue_canny_offset_q5(before, m, after);
    at->dx_q5 = (int8_t)(drogue_canny_step_x(sector) * offset_q5);
    at->dy_q5 = (int8_t)(drogue_canny_step_y(sector) * offset_q5);
    return (drogue_direction_class(at->gx, at->gy) + 1u) << DROGUE_CODE_CLASS_SHIFT;
}

#endif
