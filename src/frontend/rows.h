/* SPDX-License-Identifier: Apache-2.0 */
/* The front end's row kernels: smoothing, gradient, suppression, in two forms of the same bits. rows_lanes.c and
 * maxima_lanes.c keep two pixels in a word, for cores without vector registers; rows_plain.c has loops over 8- and
 * 16-bit rows that compilers vectorise. Each lays out the line buffers of a workspace as it likes. */
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
static inline int32_t drogue_row_half(const drogue_frontend *f)
{
    return (int32_t)(((uint32_t)f->width_px + 7u) / 8u * 4u);
}

/* Codes of row y; two rows are kept. */
static inline uint8_t *drogue_code_row(const drogue_frontend *f, int32_t y)
{
    return f->workspace->code_rows + (y & 1) * 2 * drogue_row_half(f);
}

/* Where the kernels leave the maxima of a part, ascending: gradient, offset. */
drogue_slope *drogue_rows_points(const drogue_frontend *f);

/* Zero what is read before it is written. */
void drogue_rows_begin(const drogue_frontend *f);

/* Places before the first pixel: with lanes it is as far from the row's middle as the last one. */
static inline int32_t drogue_row_left(const drogue_frontend *f)
{
    return DROGUE_ROWS_PLAIN ? 0 : (int32_t)((uint32_t)(2 * drogue_row_half(f) - f->width_px) / 2u);
}

/* Row y as it came in, from two places before the first; five rows are kept. */
static inline uint8_t *drogue_raw_row(const drogue_frontend *f, int32_t y)
{
    return f->workspace->raw_rows + (int32_t)((uint32_t)y % 5u) * (2 * drogue_row_half(f) + 4);
}

/* Row y of pixels comes in as a smoothed one. */
void drogue_rows_take_smoothed(const drogue_frontend *f, int32_t y, const uint8_t *pixels);

/* The stretch of a row that holds columns, counted in columns or, with lanes, in words. */
drogue_stretch drogue_rows_stretch(const drogue_frontend *f, const drogue_columns *columns);

/* That of a whole row ends here. */
static inline int32_t drogue_rows_end(const drogue_frontend *f)
{
    return DROGUE_ROWS_PLAIN ? f->width_px : drogue_row_half(f);
}

/* Smooth a stretch of row y that is not empty; the five rows about it have been taken. Beside it the row means
 * nothing. */
void drogue_rows_smooth(const drogue_frontend *f, int32_t y, drogue_stretch stretch);

/* The same for gradient and magnitude; the three smoothed rows about it are there. */
void drogue_rows_gradient(drogue_frontend *f, int32_t y, drogue_stretch stretch);

/* List the maxima across the edge among the pixels of a part of row y that exceed the low threshold, in its columns
 * alone, and note their codes; part 0 clears the row's. The gradient of rows y - 1 to y + 1 is there. Returns their
 * number. */
uint32_t drogue_rows_maxima(drogue_frontend *f, int32_t y, int32_t part);

/* Code of a maximum whose gradient is put down; its offset is, too. */
uint8_t drogue_rows_place(drogue_slope *at, const drogue_frontend *f, drogue_sector sector, int32_t before, int32_t m,
                          int32_t after);

#endif
