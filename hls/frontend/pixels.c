/* SPDX-License-Identifier: Apache-2.0 */
/* Smoothing, gradient and suppression over a stream, each with its line buffers. A line buffer's word is read and written
 * once in a tick, at the same column, and not again before the next row. */
#include "operators.h"
#include "stages.h"

/* A line and a word for what lies outside: reads and writes need no condition. */
enum { OUTSIDE = DROGUE_HLS_WIDTH, WORDS = DROGUE_HLS_WIDTH + 1 };

static uint32_t raw_rows[WORDS];      /* rows y - 4 .. y - 1, the oldest lowest */
static uint16_t smooth_rows[WORDS];   /* the two above the newest */
static uint32_t gradient_row[WORDS];  /* the one above the newest */
static uint16_t magnitude_row[WORDS]; /* and the one above that */

static int is_inside(const drogue_hls_row *row, int32_t x) { return (x >= 0) & (x < row->width_px); }

static uint8_t pick(uint32_t tap, uint32_t older, uint8_t newest)
{
    return (uint8_t)(tap == 4 ? newest : older >> (8u * tap) & 0xFFu);
}

void drogue_hls_smooth_vertically(drogue_hls_windows *w, const drogue_hls_row *row, int32_t x, uint8_t pixel)
{
    const int32_t word = is_inside(row, x) ? x : OUTSIDE;
    const uint32_t older = raw_rows[word];
    int k;
    raw_rows[word] = older >> 8 | (uint32_t)pixel << 24;
    for (k = 0; k < 4; k++) {
        w->sum[k] = w->sum[k + 1];
        w->middle[k] = w->middle[k + 1];
    }
    w->middle[4] = pick(2, older, pixel);
    w->sum[4] = drogue_hls_smooth_column(pick(row->tap[0], older, pixel), pick(row->tap[1], older, pixel), w->middle[4],
                                         pick(row->tap[3], older, pixel), pick(row->tap[4], older, pixel));
}

static uint16_t pick_sum(int32_t tap, const uint16_t c[5])
{
    return tap == 0 ? c[0] : tap == 1 ? c[1] : tap == 2 ? c[2] : tap == 3 ? c[3] : c[4];
}

void drogue_hls_smooth_horizontally(drogue_hls_windows *w, const drogue_hls_row *row, int32_t x)
{
    const int32_t to = x - 2; /* column smoothed; sum[2] is its own */
    const int32_t n = row->width_px;
    const uint8_t smooth = drogue_hls_smooth_row(pick_sum(drogue_reflect_101(to - 2, n) - to + 2, w->sum),
                                                 pick_sum(drogue_reflect_101(to - 1, n) - to + 2, w->sum), w->sum[2],
                                                 pick_sum(drogue_reflect_101(to + 1, n) - to + 2, w->sum),
                                                 pick_sum(drogue_reflect_101(to + 2, n) - to + 2, w->sum));
    w->level = row->smooth ? smooth : w->middle[2];
}

void drogue_hls_gradient_stage(drogue_hls_windows *w, const drogue_hls_row *row, int32_t x)
{
    const int32_t at = row->y - 3; /* row of the gradient */
    const int inside = is_inside(row, x);
    const int32_t word = inside ? x : OUTSIDE;
    const uint32_t older = smooth_rows[word];
    uint8_t column[3];
    int k;
    smooth_rows[word] = (uint16_t)(older >> 8 | (uint32_t)w->level << 8);
    column[1] = (uint8_t)(older >> 8);
    column[0] = (uint8_t)(at == 0 ? older >> 8 : older & 0xFFu);
    column[2] = at == row->height_px - 1 ? column[1] : w->level;
    for (k = 0; k < 3; k++) {
        w->levels[k][0] = w->levels[k][1];
        w->levels[k][1] = x == 0 ? column[k] : w->levels[k][2]; /* the first its own left one */
        w->levels[k][2] = inside ? column[k] : w->levels[k][2]; /* the last column is its own right neighbour */
    }
    w->gradient = drogue_hls_gradient(w->levels[0][0], w->levels[0][1], w->levels[0][2], w->levels[1][0],
                                      w->levels[1][2], w->levels[2][0], w->levels[2][1], w->levels[2][2]);
}

void drogue_hls_column_stage(drogue_hls_windows *w, const drogue_hls_row *row, int32_t x)
{
    const int32_t at = row->y - 4; /* row suppressed */
    const int inside = is_inside(row, x);
    const int32_t word = inside ? x : OUTSIDE;
    const uint32_t middle = gradient_row[word];
    const uint16_t above = magnitude_row[word];
    const uint16_t magnitude = drogue_hls_magnitude(middle);
    const uint16_t below = drogue_hls_magnitude(w->gradient);
    gradient_row[word] = w->gradient;
    magnitude_row[word] = magnitude;
    w->column[0] = (uint16_t)(above & drogue_hls_when(inside & (at >= 1)));
    w->column[1] = (uint16_t)(magnitude & drogue_hls_when(inside));
    w->column[2] = (uint16_t)(below & drogue_hls_when(inside & (at + 1 < row->height_px)));
    w->column_gradient = middle;
}

void drogue_hls_suppress_stage(drogue_hls_windows *w, const drogue_hls_row *row, int32_t x)
{
    const uint32_t begun = drogue_hls_when(x > 0);
    const int inside = (x >= 1) & (x <= row->width_px) & (row->y >= 4);
    uint32_t in_ring;
    uint32_t kept;
    int k;
    for (k = 0; k < 3; k++) {
        w->magnitude[k][0] = (uint16_t)(w->magnitude[k][1] & begun);
        w->magnitude[k][1] = (uint16_t)(w->magnitude[k][2] & begun);
        w->magnitude[k][2] = w->column[k];
    }
    w->gradients[0] = w->middle_gradient;
    w->middle_gradient = w->column_gradient;
    in_ring = drogue_hls_in_ring(x - 1, row->ring.centre2_x, row->ring.least_x9, row->ring.most);
    kept = (0x1Fu & ~(drogue_hls_when((row->use_ring != 0) & (in_ring == 0)) & 0x1Cu)) & drogue_hls_when(inside);
    w->suppressed = drogue_hls_suppress(w->magnitude[0][0], w->magnitude[0][1], w->magnitude[0][2], w->magnitude[1][0],
                                        w->magnitude[1][1], w->magnitude[1][2], w->magnitude[2][0], w->magnitude[2][1],
                                        w->magnitude[2][2], w->gradients[0], row->low, row->high) &
                    ~(uint64_t)(0x1Fu & ~kept);
}

void drogue_hls_locate_stage(drogue_hls_windows *w)
{
    w->code = drogue_hls_locate(w->suppressed);
    w->gradients[1] = w->gradients[0];
}
