/* SPDX-License-Identifier: Apache-2.0 */
/* Smoothing, gradient, suppression and subpixel place over a stream. A line buffer's word is read and written once in a tick, at
 * the same column, and not again before the next row. */
#include "operators.h"
#include "stages.h"

void drogue_hls_pixels_begin(drogue_hls_windows *w)
{
    static const drogue_hls_windows empty;
    int k;
    *w = empty;
    w->x[0] = AT_LABEL - 3; /* a row of labels begins three columns early */
    for (k = 0; k < PLACES; k++) {
        w->y[k] = (uint16_t)drogue_hls_narrow(0xFFFF, ROW_BITS + 1); /* row -1 */
    }
}

/* The five indices about i; then with the border reflected as drogue_reflect_101() does, in three ticks: at 0, at the last,
 * whose double is 'turn', and at 0 once more, which only a region of two can need. */
static void about(int16_t indices[5], int32_t i)
{
    int32_t k;
    for (k = 0; k < 5; k++) {
        indices[k] = (int16_t)(i + k - 2);
    }
}

static void fold(int16_t folded[5], const int16_t indices[5])
{
    int32_t k;
    for (k = 0; k < 5; k++) {
        folded[k] = (int16_t)(indices[k] < 0 ? -indices[k] : indices[k]);
    }
}

static void reflect(int16_t near[5], const int16_t folded[5], int32_t n, int32_t turn)
{
    int32_t k;
    for (k = 0; k < 5; k++) {
        near[k] = (int16_t)(n == 1 ? 0 : folded[k] >= n ? turn - folded[k] : folded[k]);
    }
}

/* Which of the five values about i they are. */
static void tap(uint8_t taps[5], const int16_t near[5], int32_t i)
{
    int32_t k;
    for (k = 0; k < 5; k++) {
        taps[k] = (uint8_t)(((near[k] < 0 ? -near[k] : near[k]) - i + 2) & 7);
    }
}

/* Read before one is chosen: of a choice among places Bambu makes a table of pointers, which it does not take. */
static uint16_t pick(uint32_t tap, const uint16_t c[5])
{
    const uint16_t c0 = c[0];
    const uint16_t c1 = c[1];
    const uint16_t c2 = c[2];
    const uint16_t c3 = c[3];
    const uint16_t c4 = c[4];
    return tap == 0 ? c0 : tap == 1 ? c1 : tap == 2 ? c2 : tap == 3 ? c3 : c4;
}

/* The pixel that has come and the four above it. */
static void take_rows(drogue_hls_windows *w, uint32_t older, drogue_hls_writes *write)
{
    int k;
    write->raw_rows = drogue_hls_write_of(w->x[AT_ROWS], older >> 8 | (uint32_t)w->pixel << 24, 1);
    for (k = 0; k < 4; k++) {
        w->raw[k] = (uint8_t)(older >> (8 * k) & 0xFFu);
    }
    w->raw[4] = w->pixel;
}

/* Those and the border: what the vertical sum adds up. */
static void pick_rows(drogue_hls_windows *w)
{
    const uint16_t of[5] = {w->raw[0], w->raw[1], w->raw[2], w->raw[3], w->raw[4]};
    int k;
    for (k = 0; k < 5; k++) {
        w->rows[k] = (uint8_t)(k == 2 ? of[2] : pick(w->row_tap[k], of));
    }
}

/* Rows of one weight: the sum takes them as one. */
static void pair_rows(drogue_hls_windows *w)
{
    w->outer_rows = (uint16_t)(w->rows[0] + w->rows[4]);
    w->inner_rows = (uint16_t)(w->rows[1] + w->rows[3]);
    w->middle_row = w->rows[2];
}

static void sum_rows(drogue_hls_windows *w)
{
    int k;
    for (k = 0; k < 4; k++) {
        w->sum[k] = w->sum[k + 1];
    }
    for (k = 0; k < 5; k++) {
        w->middle[k] = w->middle[k + 1];
    }
    w->sum[4] = drogue_hls_smooth_column(w->outer_rows, w->inner_rows, w->middle_row, 0, 0);
    w->middle[5] = w->middle_row;
}

static void pick_columns(drogue_hls_windows *w)
{
    int k;
    for (k = 0; k < 5; k++) {
        w->columns[k] = k == 2 ? w->sum[2] : pick(w->column_tap[k], w->sum);
    }
}

/* And columns. */
static void pair_columns(drogue_hls_windows *w)
{
    w->outer = (uint16_t)(w->columns[0] + w->columns[4]);
    w->inner = (uint16_t)(w->columns[1] + w->columns[3]);
    w->centre = w->columns[2];
}

static void sum_columns(drogue_hls_windows *w)
{
    w->smoothed = drogue_hls_smooth_row(w->outer, w->inner, w->centre, 0, 0);
}

/* The smoothed pixel, or the pixel itself, and the two above it, border replicated. */
static void stack_levels(drogue_hls_windows *w, const drogue_hls_frame *frame, uint32_t older, drogue_hls_writes *write)
{
    const uint8_t level = frame->smooth ? w->smoothed : w->middle[0];
    const uint8_t middle = (uint8_t)(older >> 8);
    const int32_t y = w->y[AT_LEVELS - 1] - 3; /* row of the next one's gradient */
    write->smooth_rows = drogue_hls_write_of(w->x[AT_LEVELS], (older >> 8 & 0xFFu) | (uint32_t)level << 8, 1);
    w->level_column[0] = w->is_top ? middle : (uint8_t)(older & 0xFFu);
    w->level_column[1] = middle;
    w->level_column[2] = w->is_bottom ? middle : level;
    w->is_top = y == 0;
    w->is_bottom = y == frame->height_px - 1;
}

static void shift_levels(drogue_hls_windows *w)
{
    const int inside = w->inside[AT_WINDOW];
    int k;
    for (k = 0; k < 3; k++) {
        w->levels[k][0] = w->levels[k][1];
        w->levels[k][1] = w->is_first ? w->level_column[k] : w->levels[k][2]; /* the first its own left one */
        w->levels[k][2] = inside ? w->level_column[k] : w->levels[k][2];      /* the last column its own right one */
    }
    w->is_first = w->x[AT_WINDOW - 1] == 0;
}

static uint64_t sides_of(uint8_t window[3][3])
{
    return drogue_hls_sides(window[0][0], window[0][1], window[0][2], window[1][0], window[1][2], window[2][0],
                            window[2][1], window[2][2]);
}

/* The magnitude and the two above it. */
static void stack_magnitudes(drogue_hls_windows *w, const drogue_hls_frame *frame, const drogue_hls_words *read,
                             drogue_hls_writes *write)
{
    const uint32_t older = (uint32_t)read->magnitude_rows;
    const int32_t y = w->y[AT_MAGNITUDES - 1] - 4; /* row suppressed, of the next one */
    write->gradient_row = drogue_hls_write_of(w->x[AT_MAGNITUDES], w->gradient[1], 1);
    write->magnitude_rows = drogue_hls_write_of(w->x[AT_MAGNITUDES], older >> 16 | (uint32_t)w->magnitude << 16, 1);
    w->stacked[0] = (uint16_t)(older & 0x7FFu);
    w->stacked[1] = (uint16_t)(older >> 16 & 0x7FFu);
    w->stacked[2] = w->magnitude;
    w->middle_gradient[AT_ABSOLUTE] = (uint32_t)read->gradient_row & 0x0FFF0FFFu;
    w->has_above[1] = w->has_above[0];
    w->has_below[1] = w->has_below[0];
    w->has_above[0] = y >= 1;
    w->has_below[0] = y + 1 < frame->height_px;
}

/* 0 outside. */
static void mask_magnitudes(drogue_hls_windows *w)
{
    const int inside = w->inside[AT_COLUMN];
    w->column[0] = (uint16_t)(w->stacked[0] & drogue_hls_when(inside & w->has_above[1]));
    w->column[1] = (uint16_t)(w->stacked[1] & drogue_hls_when(inside));
    w->column[2] = (uint16_t)(w->stacked[2] & drogue_hls_when(inside & w->has_below[1]));
}

static void shift_magnitudes(drogue_hls_windows *w)
{
    int k;
    for (k = 0; k < 3; k++) {
        w->magnitudes[k][0] = w->magnitudes[k][1];
        w->magnitudes[k][1] = w->magnitudes[k][2];
        w->magnitudes[k][2] = w->column[k];
    }
}

static uint64_t neighbours_of(uint16_t m[3][3], uint32_t sector)
{
    return drogue_hls_neighbours(m[0][0], m[0][1], m[0][2], m[1][0], m[1][1], m[1][2], m[2][0], m[2][1], m[2][2],
                                 sector);
}

/* From suppression to the word of the edge list. */
static void locate(drogue_hls_windows *w, const drogue_hls_frame *frame)
{
    const int32_t y = w->y[AT_SUPPRESS - 1] - 4; /* of the next one */
    drogue_edge e;
    int k;
    e.x_q5 = (uint16_t)(32 * w->x[AT_PLACE] + (int8_t)(uint8_t)(w->offset & 0xFFu));
    e.y_q5 = (uint16_t)(32 * (w->y[AT_PLACE] - 4) + (int8_t)(uint8_t)(w->offset >> 8));
    e.gx = drogue_hls_derivative(w->middle_gradient[AT_PLACE] & 0xFFFu);
    e.gy = drogue_hls_derivative(w->middle_gradient[AT_PLACE] >> 16);
    for (k = AT_LIST; k > AT_LABEL; k--) {
        w->point[k] = w->point[k - 1];
    }
    w->point[AT_LABEL] = drogue_hls_pack_edge(&e);
    w->offset = drogue_hls_offset(w->vertex[AT_OFFSET], w->sector[AT_OFFSET]);
    for (k = 4; k >= 0; k--) {
        w->vertex[AT_DIVIDE + k + 1] = drogue_hls_vertex_step(w->vertex[AT_DIVIDE + k], 4 - k);
    }
    w->vertex[AT_REST + 1] = drogue_hls_vertex_rest(w->vertex[AT_REST]);
    w->vertex[AT_VERTEX + 1] = drogue_hls_vertex(w->neighbours);
    w->code[AT_LABEL] = w->code[AT_LABEL - 1] & drogue_hls_when((int)w->in_ring); /* no candidate outside the ring */
    for (k = AT_LABEL - 1; k > AT_SUPPRESS + 1; k--) {
        w->code[k] = w->code[k - 1];
    }
    w->code[AT_SUPPRESS + 1] = drogue_hls_suppress(w->neighbours, w->sector[AT_SUPPRESS], frame->low, frame->high) &
                               drogue_hls_when((int)w->is_in);
    w->is_in = (uint32_t)(w->inside[AT_SUPPRESS - 1] & (y >= 0) & (y < frame->height_px));
}

static void test_ring(drogue_hls_windows *w, const drogue_hls_frame *frame)
{
    w->in_ring = (frame->use_ring == 0) |
                 drogue_hls_in_ring(w->ring_tested, w->ring_tested_x9, frame->ring_least_x9, frame->ring_most);
    w->ring_tested = w->ring_square;
    w->ring_tested_x9 = drogue_hls_narrow_s64(9 * w->ring_square, RING_BITS);
    w->ring_square = drogue_hls_narrow_s64(w->ring_square + w->ring_step, RING_BITS); /* (v + 2)^2 */
    w->ring_step += 8;
}

/* Count off the next place; the others move on. */
static void advance(drogue_hls_windows *w, const drogue_hls_frame *frame)
{
    const uint32_t wraps = w->wraps;
    int k;
    w->take = (uint32_t)w->inside[AT_TAKE - 1] & (uint32_t)(w->y[AT_TAKE - 1] < frame->height_px);
    for (k = PLACES - 1; k > 0; k--) {
        w->x[k] = w->x[k - 1];
        w->y[k] = w->y[k - 1];
    }
    for (k = AT_SUPPRESS; k > 1; k--) {
        w->inside[k] = w->inside[k - 1];
    }
    w->inside[1] = w->x[1] < frame->width_px;
    w->wraps = (wraps ^ 1u) & (uint32_t)(w->x[1] + 1 == frame->last_x);
    w->x[0] = (uint16_t)(drogue_hls_narrow(w->x[1] + 1u, COLUMN_BITS) & drogue_hls_when(wraps == 0));
    w->y[0] = (uint16_t)drogue_hls_narrow(w->y[1] + wraps, ROW_BITS + 1);
}

void drogue_hls_pixels_tick(drogue_hls_windows *w, const drogue_hls_frame *frame, const drogue_hls_words *read,
                            drogue_hls_writes *write)
{
    int k;
    locate(w, frame);
    test_ring(w, frame);
    w->neighbours = neighbours_of(w->magnitudes, w->sector[AT_NEIGHBOURS]);
    shift_magnitudes(w);
    mask_magnitudes(w);
    for (k = AT_OFFSET; k > AT_SECTOR + 1; k--) {
        w->sector[k] = w->sector[k - 1];
    }
    w->sector[AT_SECTOR + 1] =
        drogue_hls_sector(w->middle_gradient[AT_SECTOR], w->absolute_x[1], w->absolute_y[1], w->tangent);
    w->tangent = drogue_hls_tangent(w->absolute_x[0]);
    w->absolute_x[1] = w->absolute_x[0];
    w->absolute_y[1] = w->absolute_y[0];
    w->absolute_x[0] = drogue_hls_absolute(w->middle_gradient[AT_ABSOLUTE] & 0xFFFFu);
    w->absolute_y[0] = drogue_hls_absolute(w->middle_gradient[AT_ABSOLUTE] >> 16);
    for (k = AT_PLACE; k > AT_ABSOLUTE; k--) {
        w->middle_gradient[k] = w->middle_gradient[k - 1];
    }
    stack_magnitudes(w, frame, read, write);
    w->magnitude = drogue_hls_magnitude(w->gradient[0]);
    w->gradient[1] = w->gradient[0];
    w->gradient[0] = drogue_hls_gradient(w->sides);
    w->sides = sides_of(w->levels);
    shift_levels(w);
    stack_levels(w, frame, (uint32_t)read->smooth_rows, write);
    sum_columns(w);
    pair_columns(w);
    pick_columns(w);
    tap(w->column_tap, w->near_column, w->x[AT_ABOUT_COLUMNS + 3]);
    reflect(w->near_column, w->column_folded, frame->width_px, frame->turn_x);
    fold(w->column_folded, w->column_about);
    about(w->column_about, w->x[AT_ABOUT_COLUMNS]);
    sum_rows(w);
    pair_rows(w);
    pick_rows(w);
    take_rows(w, (uint32_t)read->raw_rows, write);
    tap(w->row_tap, w->near_row, w->y[AT_ABOUT_ROWS + 3] - 2);
    reflect(w->near_row, w->row_folded, frame->height_px, frame->turn_y);
    fold(w->row_folded, w->row_about);
    about(w->row_about, w->y[AT_ABOUT_ROWS] - 2);
    advance(w, frame);
}
