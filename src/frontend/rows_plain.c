/* SPDX-License-Identifier: Apache-2.0 */
/* Row kernels as plain loops over rows of bytes and 16-bit numbers, which compilers turn into vector instructions. The
 * loops run over whole eights of pixels; what they leave beyond the width means nothing. */
#include "rows.h"

#if DROGUE_ROWS_PLAIN

#include <string.h>

static int32_t padded(const drogue_frontend *f) { return 2 * drogue_row_half(f); }

drogue_stretch drogue_rows_stretch(const drogue_frontend *f, const drogue_columns *columns)
{
    drogue_stretch s;
    (void)f;
    s.begin = columns->begin[0] < columns->end[0] ? columns->begin[0] : columns->begin[1];
    s.end = columns->begin[1] < columns->end[1] ? columns->end[1] : columns->end[0];
    if (s.begin >= s.end) {
        s.begin = UINT16_MAX;
        s.end = 0;
    }
    return s;
}

static int32_t eights_down(int32_t x) { return x / 8 * 8; }
static int32_t eights_up(int32_t x) { return (x + 7) / 8 * 8; }

static uint8_t *smooth_row(const drogue_frontend *f, int32_t y)
{
    return f->workspace->smooth_rows + (y % 3) * (padded(f) + 8) + 4;
}

static uint16_t *magnitude_row(const drogue_frontend *f, int32_t y)
{
    const int32_t row = y >= 0 && y < f->height_px ? y % 3 : 3; /* the fourth stays 0 */
    return f->workspace->magnitude_rows + row * (padded(f) + 4) + 2;
}

/* Derivatives of row y, first horizontal, then vertical; two rows are kept, after the list of points. */
static int16_t *derivative_row(const drogue_frontend *f, int32_t y)
{
    return (int16_t *)(void *)(f->workspace->slope_rows + padded(f)) + (y & 1) * 2 * padded(f);
}

drogue_slope *drogue_rows_points(const drogue_frontend *f) { return f->workspace->slope_rows; }

void drogue_rows_begin(const drogue_frontend *f)
{
    const size_t width = (size_t)padded(f);
    memset(f->workspace->raw_rows, 0, 5 * (width + 4));
    memset(f->workspace->smooth_rows, 0, 3 * (width + 8));
    memset(f->workspace->magnitude_rows, 0, 4 * (width + 4) * sizeof(uint16_t));
}

static void replicate(uint8_t *row, int32_t width_px)
{
    row[-1] = row[0];
    row[width_px] = row[width_px - 1];
}

void drogue_rows_take_smoothed(const drogue_frontend *f, int32_t y, const uint8_t *pixels)
{
    uint8_t *row = smooth_row(f, y);
    memcpy(row, pixels, (size_t)f->width_px);
    replicate(row, f->width_px);
}

static void sum_columns(uint16_t *restrict out, const uint8_t *r0, const uint8_t *r1, const uint8_t *r2,
                        const uint8_t *r3, const uint8_t *r4, int32_t count)
{
    int32_t x;
    for (x = 0; x < count; x++) {
        out[x] = (uint16_t)drogue_binomial5(r0[x], r1[x], r2[x], r3[x], r4[x]);
    }
}

static void sum_rows(uint8_t *restrict out, const uint16_t *restrict c, int32_t count)
{
    int32_t x;
    for (x = 0; x < count; x++) {
        const uint16_t sum = (uint16_t)(drogue_binomial5(c[x], c[x + 1], c[x + 2], c[x + 3], c[x + 4]) + 128u);
        out[x] = (uint8_t)(sum >> 8);
    }
}

void drogue_rows_smooth(const drogue_frontend *f, int32_t y, drogue_stretch stretch)
{
    uint16_t *column = (uint16_t *)(void *)drogue_rows_points(f); /* the list is free until the next maxima */
    uint8_t *out = smooth_row(f, y);
    const int32_t begin = eights_down(stretch.begin);
    const int32_t count = eights_up(stretch.end) - begin;
    const uint8_t *rows[5];
    int32_t k;
    for (k = 0; k < 5; k++) {
        rows[k] = drogue_raw_row(f, drogue_reflect_101(y + k - 2, f->height_px)) + begin;
    }
    sum_columns(column, rows[0], rows[1], rows[2], rows[3], rows[4], count + 4);
    sum_rows(out + begin, column, count);
    replicate(out, f->width_px);
}

/* A row's columns: smoothed across the horizontal derivative, and the step of the vertical one. */
static void sobel_columns(int16_t *restrict sum, int16_t *restrict step, const uint8_t *t, const uint8_t *c,
                          const uint8_t *b, int32_t count)
{
    int32_t x;
    for (x = 0; x < count; x++) {
        sum[x] = (int16_t)drogue_sobel_121(t[x], c[x], b[x]);
        step[x] = (int16_t)(b[x] - t[x]);
    }
}

static inline int16_t magnitude_of(int16_t v) { return (int16_t)(v < 0 ? -v : v); }

static void sobel_rows(int16_t *restrict gx, int16_t *restrict gy, uint16_t *restrict magnitude,
                       const int16_t *restrict sum, const int16_t *restrict step, int32_t count)
{
    int32_t x;
    for (x = 0; x < count; x++) {
        const int16_t dx = (int16_t)(sum[x + 2] - sum[x]);
        const int16_t dy = (int16_t)(step[x] + 2 * step[x + 1] + step[x + 2]);
        gx[x] = dx;
        gy[x] = dy;
        magnitude[x] = (uint16_t)(magnitude_of(dx) + magnitude_of(dy));
    }
}

void drogue_rows_gradient(drogue_frontend *f, int32_t y, drogue_stretch stretch)
{
    const int32_t width = padded(f);
    const int32_t below = y + 1 < f->height_px ? y + 1 : y;
    const int32_t begin = eights_down(stretch.begin);
    const int32_t count = eights_up(stretch.end) - begin;
    int16_t *sum = (int16_t *)(void *)drogue_rows_points(f);
    int16_t *step = sum + width + 2;
    int16_t *gx = derivative_row(f, y);
    uint16_t *magnitude = magnitude_row(f, y);
    sobel_columns(sum, step, smooth_row(f, y > 0 ? y - 1 : 0) + begin - 1, smooth_row(f, y) + begin - 1,
                  smooth_row(f, below) + begin - 1, count + 2);
    sobel_rows(gx + begin, gx + width + begin, magnitude + begin, sum, step, count);
    magnitude[-1] = 0;
    magnitude[f->width_px] = 0;
}

/* -1 where a condition holds, 0 elsewhere: as vector compares give it. */
static inline int16_t mask_of(int condition) { return (int16_t)(condition ? -1 : 0); }

static inline int16_t choose(int16_t mask, int16_t then, int16_t otherwise)
{
    return (int16_t)((then & mask) | (otherwise & ~mask));
}

/* Mark the maxima that exceed 'low' by their sector, doubled, plus 1. All is 16 bits wide, and every neighbour is read
 * whether it counts or not. */
static void mark_maxima(uint8_t *restrict mark, const int16_t *restrict gx, const int16_t *restrict gy,
                        const int16_t *restrict above, const int16_t *restrict middle, const int16_t *restrict below,
                        int16_t low, int32_t count)
{
    int32_t x;
    for (x = 0; x < count; x++) {
        const int16_t ax = magnitude_of(gx[x]);
        const int16_t ay = magnitude_of(gy[x]);
        const int16_t tangent = (int16_t)drogue_canny_tangent((uint16_t)ax);
        const int16_t flat = mask_of(ay <= tangent);
        const int16_t steep = mask_of(ay > (int16_t)(tangent + 2 * ax));
        const int16_t anti = mask_of((int16_t)(gx[x] ^ gy[x]) < 0);
        const int16_t m = middle[x];
        const int16_t upright_before = choose(steep, above[x], choose(anti, above[x + 1], above[x - 1]));
        const int16_t upright_after = choose(steep, below[x], choose(anti, below[x - 1], below[x + 1]));
        const int16_t before = choose(flat, middle[x - 1], upright_before);
        const int16_t after = choose(flat, middle[x + 1], upright_after);
        const int16_t least = (int16_t)(after + (flat | steep));          /* m >= after: m > after - 1 */
        const int16_t slanted = (int16_t)(DROGUE_SECTOR_DIAGONAL - anti); /* a mask is -1 */
        const int16_t sector = choose(flat, DROGUE_SECTOR_HORIZONTAL, choose(steep, DROGUE_SECTOR_VERTICAL, slanted));
        mark[x] = (uint8_t)(mask_of(m > before) & mask_of(m > least) & mask_of(m > low) & (2 * sector + 1));
    }
}

/* Does a magnitude exceed 'low'? */
static int any_exceeds(const int16_t *magnitude, int16_t low, int32_t count)
{
    int16_t most = 0;
    int32_t x;
    for (x = 0; x < count; x++) {
        most = most > magnitude[x] ? most : magnitude[x];
    }
    return most > low;
}

/* The same for a row, piece by piece: most pieces of most images hold nothing. */
static void mark_row(uint8_t *mark, const int16_t *gx, const int16_t *gy, const uint16_t *const magnitude[3],
                     int16_t low, int32_t begin, int32_t end)
{
    enum { PIECE = 32 };
    const int16_t *above = (const int16_t *)magnitude[0];
    const int16_t *middle = (const int16_t *)magnitude[1];
    const int16_t *below = (const int16_t *)magnitude[2];
    int32_t x;
    for (x = begin; x < end; x += PIECE) {
        const int32_t length = end - x < PIECE ? end - x : PIECE;
        if (any_exceeds(middle + x, low, length)) {
            mark_maxima(mark + x, gx + x, gy + x, above + x, middle + x, below + x, low, length);
        } else {
            memset(mark + x, 0, (size_t)length);
        }
    }
}

/* Where the marks are. Eight at a time are passed over or taken without a branch each: what is written for a pixel
 * without a mark is written over. */
static uint32_t list_marked(drogue_slope *points, const uint8_t *mark, int32_t count)
{
    uint32_t listed = 0;
    int32_t x;
    int32_t k;
    for (x = 0; x < count; x += 8) {
        uint64_t eight;
        memcpy(&eight, mark + x, sizeof eight);
        if (eight == 0) {
            continue;
        }
        for (k = x; k < x + 8; k++) {
            points[listed].x = (uint16_t)k;
            listed += mark[k] & 1u;
        }
    }
    return listed;
}

uint32_t drogue_rows_maxima(drogue_frontend *f, int32_t y, int32_t part)
{
    const drogue_columns *columns = &f->columns[y & 7];
    const int16_t *gx = derivative_row(f, y);
    const int16_t *gy = gx + padded(f);
    const int32_t low = f->config.canny_low < DROGUE_L1_MAX ? f->config.canny_low : DROGUE_L1_MAX;
    uint8_t *code = drogue_code_row(f, y);
    drogue_slope *points = drogue_rows_points(f);
    const uint16_t *magnitude[3];
    uint32_t count;
    uint32_t i;
    int32_t k;
    (void)part;
    for (k = 0; k < 3; k++) {
        magnitude[k] = magnitude_row(f, y + k - 1);
    }
    for (k = 0; k < 2; k++) {
        if (columns->begin[k] < columns->end[k]) {
            mark_row(code, gx, gy, magnitude, (int16_t)low, eights_down(columns->begin[k]), eights_up(columns->end[k]));
        }
    }
    memset(code, 0, columns->begin[0]);
    memset(code + columns->end[0], 0, (size_t)(columns->begin[1] - columns->end[0]));
    memset(code + columns->end[1], 0, (size_t)(padded(f) - columns->end[1]));
    count = list_marked(points, code, padded(f));
    for (i = 0; i < count; i++) {
        drogue_slope *p = &points[i];
        const drogue_sector sector = (drogue_sector)(code[p->x] >> 1);
        int32_t before;
        int32_t after;
        p->gx = gx[p->x];
        p->gy = gy[p->x];
        drogue_canny_padded_neighbours(&before, &after, sector, magnitude, p->x);
        code[p->x] = drogue_rows_place(p, f, sector, before, magnitude[1][p->x], after);
    }
    return count;
}

#endif
