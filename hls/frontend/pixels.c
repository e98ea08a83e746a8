/* SPDX-License-Identifier: Apache-2.0 */
/* Smoothing, gradient and suppression over a stream, each with its line buffers. A line buffer's word is read and written
 * once in a tick, at the same column, and not again before the next row. */
#include "operators.h"
#include "stages.h"

static uint8_t raw_rows[4][DROGUE_HLS_WIDTH];    /* rows y - 4 .. y - 1 */
static uint8_t smooth_rows[2][DROGUE_HLS_WIDTH]; /* the two above the newest */
static uint32_t gradient_row[DROGUE_HLS_WIDTH];  /* the one above the newest */
static uint16_t magnitude_row[DROGUE_HLS_WIDTH]; /* and the one above that */

static uint8_t pick(uint32_t tap, const uint8_t r[5])
{
    return tap == 0 ? r[0] : tap == 1 ? r[1] : tap == 2 ? r[2] : tap == 3 ? r[3] : r[4];
}

void drogue_hls_smooth_vertically(drogue_hls_windows *w, const drogue_hls_row *row, int32_t x, uint8_t pixel)
{
#pragma HLS array_partition variable = raw_rows complete dim = 1
    const int inside = x >= 0 && x < row->width_px;
    uint8_t r[5];
    int k;
    for (k = 0; k < 4; k++) { /* rows above the first are not read */
#pragma HLS unroll
        r[k] = inside && row->y + k >= 4 ? raw_rows[k][x] : 0;
    }
    r[4] = pixel;
    for (k = 0; k < 4; k++) {
#pragma HLS unroll
        w->sum[k] = w->sum[k + 1];
        w->middle[k] = w->middle[k + 1];
        if (inside) {
            raw_rows[k][x] = r[k + 1];
        }
    }
    w->middle[4] = r[2];
    w->sum[4] = drogue_hls_smooth_column(pick(row->tap[0], r), pick(row->tap[1], r), r[2], pick(row->tap[3], r),
                                         pick(row->tap[4], r));
}

static uint16_t pick_sum(int32_t tap, const uint16_t c[5])
{
    return tap == 0 ? c[0] : tap == 1 ? c[1] : tap == 2 ? c[2] : tap == 3 ? c[3] : c[4];
}

void drogue_hls_smooth_horizontally(drogue_hls_windows *w, const drogue_hls_row *row, int32_t x)
{
    const int32_t to = x - 2; /* column smoothed; sum[2] is its own */
    const int32_t n = row->width_px;
    if (to >= 0 && to < n) {
        w->level = row->smooth
                       ? drogue_hls_smooth_row(pick_sum(drogue_reflect_101(to - 2, n) - to + 2, w->sum),
                                               pick_sum(drogue_reflect_101(to - 1, n) - to + 2, w->sum), w->sum[2],
                                               pick_sum(drogue_reflect_101(to + 1, n) - to + 2, w->sum),
                                               pick_sum(drogue_reflect_101(to + 2, n) - to + 2, w->sum))
                       : w->middle[2];
    }
}

void drogue_hls_gradient_stage(drogue_hls_windows *w, const drogue_hls_row *row, int32_t x)
{
#pragma HLS array_partition variable = smooth_rows complete dim = 1
    const int32_t at = row->y - 3; /* row of the gradient */
    const int inside = x >= 0 && x < row->width_px;
    uint8_t column[3];
    int k;
    column[1] = inside && at >= 0 ? smooth_rows[1][x] : 0;
    column[0] = at == 0 ? column[1] : inside && at > 0 ? smooth_rows[0][x] : 0;
    column[2] = at == row->height_px - 1 ? column[1] : w->level;
    if (inside) {
        smooth_rows[0][x] = column[1];
        smooth_rows[1][x] = w->level;
    }
    for (k = 0; k < 3; k++) {
#pragma HLS unroll
        w->levels[k][0] = w->levels[k][1];
        w->levels[k][1] = x == 0 ? column[k] : w->levels[k][2]; /* the first its own left one */
        w->levels[k][2] = inside ? column[k] : w->levels[k][2]; /* the last column is its own right neighbour */
    }
    w->gradient = drogue_hls_gradient(w->levels[0][0], w->levels[0][1], w->levels[0][2], w->levels[1][0],
                                      w->levels[1][2], w->levels[2][0], w->levels[2][1], w->levels[2][2]);
}

void drogue_hls_suppress_stage(drogue_hls_windows *w, const drogue_hls_row *row, int32_t x)
{
    const int32_t at = row->y - 4; /* row suppressed */
    const int inside = x >= 0 && x < row->width_px;
    const uint32_t below = w->gradient;
    const uint32_t middle = inside && at >= 0 ? gradient_row[x] : 0;
    const uint16_t above = inside && at >= 1 ? magnitude_row[x] : 0;
    const uint16_t middle_magnitude = drogue_hls_magnitude(middle);
    uint32_t code;
    int k;
    if (inside) {
        gradient_row[x] = below;
        magnitude_row[x] = middle_magnitude;
    }
    for (k = 0; k < 3; k++) {
#pragma HLS unroll
        w->magnitude[k][0] = x <= 0 ? 0 : w->magnitude[k][1];
        w->magnitude[k][1] = x <= 0 ? 0 : w->magnitude[k][2];
    }
    w->magnitude[0][2] = above;
    w->magnitude[1][2] = inside ? middle_magnitude : 0;
    w->magnitude[2][2] = inside && at + 1 < row->height_px ? drogue_hls_magnitude(below) : 0;
    w->code_gradient = w->middle_gradient;
    w->middle_gradient = middle;
    code = drogue_hls_suppress(w->magnitude[0][0], w->magnitude[0][1], w->magnitude[0][2], w->magnitude[1][0],
                               w->magnitude[1][1], w->magnitude[1][2], w->magnitude[2][0], w->magnitude[2][1],
                               w->magnitude[2][2], w->code_gradient, row->low, row->high);
    if (row->use_ring && !drogue_hls_in_ring(x - 1, row->ring.centre2_x, row->ring.least_x9, row->ring.most)) {
        code &= ~UINT32_C(0x1C);
    }
    w->code = x >= 1 && x <= row->width_px && at >= 0 ? code : 0;
}
