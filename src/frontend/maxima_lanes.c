/* SPDX-License-Identifier: Apache-2.0 */
/* Row kernels on lanes: maxima across the edge, from what the gradient recorded. */
#include "rows_lanes.h"

#if !DROGUE_ROWS_PLAIN

#include <string.h>

/* A lane of a word; 'lane' is 0 or 16. */
static inline int32_t lane_of(uint32_t word, uint32_t lane) { return (int32_t)((word >> lane) & 0xFFFFu); }

/* The magnitudes of a row and those about it; 0 above the first row and below the last. */
typedef struct magnitudes {
    const uint32_t *row;
    ptrdiff_t above; /* from a word to the one above it */
    ptrdiff_t below;
    int32_t low;   /* threshold */
    int32_t first; /* column 0 is in the lower lane of this word */
    int32_t last;  /* and this column in the upper one of word 0 */
} magnitudes;

static magnitudes magnitudes_about(const drogue_frontend *f, int32_t y)
{
    const int32_t words = drogue_row_half(f) + 2;
    const int32_t row = (int32_t)((uint32_t)y % 3u);
    const int32_t above = y > 0 ? (row > 0 ? row - 1 : 2) : 3;
    const int32_t below = y + 1 < f->height_px ? (row < 2 ? row + 1 : 0) : 3;
    magnitudes m;
    m.row = magnitude_row(f, y);
    m.above = (above - row) * words;
    m.below = (below - row) * words;
    m.low = f->config.canny_low;
    m.first = drogue_row_left(f);
    m.last = 2 * drogue_row_half(f) - 1 - m.first;
    return m;
}

/* Put down what a record has in a lane, if that is a maximum that exceeds the threshold. Returns where the next one
 * goes. */
static inline drogue_slope *take_maximum(drogue_slope *next, uint8_t *code, const drogue_frontend *f,
                                         const magnitudes *rows, const lanes_record *record, uint32_t lane)
{
    const ptrdiff_t right = lane == 0 ? 1 : -1;
    const int32_t word = record->word;
    const uint32_t *at = rows->row + word;
    const int32_t m = lane_of(*at, lane);
    const int32_t gx = lane == 0 ? signed_lane(record->dx, lane) : -signed_lane(record->dx, lane);
    const int32_t gy = signed_lane(record->dy, lane);
    const uint32_t ax = (uint32_t)(gx < 0 ? -gx : gx);
    const uint32_t *a = at + rows->above;
    const uint32_t *b = at + rows->below;
    drogue_sector sector;
    int32_t before;
    int32_t after;
    if (m <= rows->low) {
        return next;
    }
    sector = drogue_canny_sector_of(ax, (uint32_t)m - ax, ax * (uint32_t)DROGUE_CANNY_TG22); /* |gx| + |gy| = m */
    if (sector == DROGUE_SECTOR_HORIZONTAL) {
        a = at - right;
        b = at + right;
    } else if (sector == DROGUE_SECTOR_DIAGONAL) {
        const ptrdiff_t aside = (gx ^ gy) < 0 ? right : -right;
        sector = (gx ^ gy) < 0 ? DROGUE_SECTOR_ANTIDIAGONAL : DROGUE_SECTOR_DIAGONAL;
        a += aside;
        b -= aside;
    }
    before = lane_of(*a, lane);
    after = lane_of(*b, lane);
    if (drogue_canny_is_maximum(sector, before, m, after)) {
        next->x = (uint16_t)(lane == 0 ? word - rows->first : rows->last - word);
        next->gx = (int16_t)gx;
        next->gy = (int16_t)gy;
        code[next->x] = drogue_rows_place(next, f, sector, before, m, after);
        next++;
    }
    return next;
}

uint32_t drogue_rows_maxima(drogue_frontend *f, int32_t y, int32_t part)
{
    const drogue_columns *columns = &f->columns[y & 7];
    const int32_t half = drogue_row_half(f);
    const lanes_record *const first = record_row(f, y);
    const lanes_record *const end = first + f->slope_count[y & 1];
    drogue_slope *const points = drogue_rows_points(f);
    drogue_slope *next = points;
    uint8_t *code = drogue_code_row(f, y);
    const magnitudes rows = magnitudes_about(f, y);
    int32_t k;
    if (part == 0) {
        memset(code, 0, (size_t)f->width_px);
    }
    for (k = 0; k < 2; k++) {
        /* The columns' words in this lane, and their records, which ascend. */
        const int32_t from = part == 0 ? rows.first + columns->begin[k] : rows.last + 1 - columns->end[k];
        const int32_t to = part == 0 ? rows.first + columns->end[k] : rows.last + 1 - columns->begin[k];
        const lanes_record *r = first;
        const lanes_record *last = end;
        if (from >= to || from >= half) {
            continue;
        }
        while (r < last && r->word < from) {
            r++;
        }
        while (r < last && last[-1].word >= to) {
            last--;
        }
        if (part == 0) {
            for (; r < last; r++) {
                next = take_maximum(next, code, f, &rows, r, 0);
            }
        } else {
            while (r < last) { /* the columns of the upper lane descend */
                last--;
                next = take_maximum(next, code, f, &rows, last, 16);
            }
        }
    }
    return (uint32_t)(next - points);
}

#endif
