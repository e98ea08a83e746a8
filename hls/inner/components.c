/* SPDX-License-Identifier: Apache-2.0 */
/* Dark components of a stream of pixels. Tick x of row y takes pixel (x, y) in and sums (x - 8, y - 2); the stages
 * between run from the last to the first, each on what the one before it left in the tick before, so that they are
 * independent within a tick. Nothing is stored on a condition: what is not wanted goes where nobody looks. */
#include "components.h"

#include "../choose_label.h"
#include "disc_walk.h"
#include "operators.h"

/* Ticks by which a stage lags behind the pixel that comes in. */
enum { LAG_ROWS = 2, DARK_LAG = 2, ERODED_LAG = 4, OPENED_LAG = 6, LAG = 8, AHEAD = 4 };
enum { MERGES = DROGUE_HLS_WIDTH / 2 + 2 };

/* Line buffers, by the tick that writes a word. Of bits: row y - 1 in bit 0, row y - 2 in bit 1, as they come in; a word
 * is read and written once in a tick and not again before the next row. */
static uint8_t dark_rows[DROGUE_HLS_WIDTH + LAG];
static uint8_t eroded_rows[DROGUE_HLS_WIDTH + LAG];
static uint32_t label_row[DROGUE_HLS_WIDTH + LAG + AHEAD]; /* as given: roots are their parents */

/* Tables by label; sums of label 0 mean nothing, the last parent is that of the label refused. */
static uint32_t parent[DROGUE_HLS_LABELS + 1];
static uint32_t area[DROGUE_HLS_LABELS];
static uint32_t x_sum[DROGUE_HLS_LABELS];
static uint32_t y_sum[DROGUE_HLS_LABELS];
static uint32_t label_count;
static drogue_merge merges[MERGES]; /* the one after those of a row is scratch */

/* Registers of the pixel loop. */
typedef struct registers {
    uint8_t pixel; /* taken last, and whether it is in the disc */
    uint32_t in_disc;
    uint32_t bit;    /* the one before: dark */
    uint32_t dark;   /* 3x3 window of the thresholded image */
    uint32_t eroded; /* and of the eroded one */
    uint32_t opened; /* is the pixel to be labelled an opened one? */
    uint32_t stored; /* label read from the line buffer */
    uint32_t root;   /* root of the one read before that */
    uint32_t left;   /* labels of the neighbours: the left one as given, those above roots */
    uint32_t above_left;
    uint32_t above;
    drogue_merge merge; /* found last; does it count? */
    uint32_t merges_one;
    uint32_t merge_count;
    uint32_t full;
} registers;

/* Area and coordinate sums of a label. */
typedef struct label_sums {
    uint32_t label;
    uint32_t area;
    uint32_t x;
    uint32_t y;
} label_sums;

/* Of the label met last; of the one before it, on its way to the tables; what is to be written there. */
typedef struct adder {
    label_sums held;
    label_sums leaving;
    label_sums out;
} adder;

static void add_pixel(adder *s, uint32_t label, uint32_t x, uint32_t y)
{
    const uint32_t in_table = area[s->leaving.label];
    const uint32_t x_in_table = x_sum[s->leaving.label];
    const uint32_t y_in_table = y_sum[s->leaving.label];
    const uint32_t one = drogue_hls_when(label != 0);
    const uint32_t other = one & drogue_hls_when(label != s->held.label);
    area[s->out.label] = s->out.area;
    x_sum[s->out.label] = s->out.x;
    y_sum[s->out.label] = s->out.y;
    s->out.label = s->leaving.label;
    s->out.area = s->leaving.area + in_table;
    s->out.x = s->leaving.x + x_in_table;
    s->out.y = s->leaving.y + y_in_table;
    s->leaving = s->held;
    s->leaving.label &= other;
    s->held.area = (s->held.area & ~other) + (one & 1u);
    s->held.x = (s->held.x & ~other) + (one & x);
    s->held.y = (s->held.y & ~other) + (one & y);
    s->held.label = (other & label) | (~other & s->held.label);
}

/* Put the newest bit of a column under the two that the line buffer holds; beyond the image all are 'outside'. */
static uint32_t take_column(uint8_t *word, int inside, int first_row, uint32_t bit, uint32_t outside)
{
    const uint32_t above = drogue_hls_when(first_row);
    const uint32_t within = drogue_hls_when(inside);
    const uint32_t column = (((outside & above) | (*word & ~above)) << 1 | bit) & 7u;
    *word = (uint8_t)(column & 3u);
    return (column & within) | (outside & ~within);
}

static uint32_t new_label(registers *r, uint32_t wanted)
{
    const uint32_t label = label_count;
    const uint32_t room = label < DROGUE_HLS_LABELS;
    parent[label] = label;
    label_count = label + (wanted & room);
    r->full |= wanted & (room ^ 1u);
    return label & drogue_hls_when((int)(wanted & room));
}

/* Label of the pixel whose neighbours the registers hold, 0 when it is not an opened one. */
static uint32_t label_pixel(registers *r)
{
    const uint64_t choice = drogue_hls_choose_label(r->above, r->left, r->above_left, r->root);
    const uint32_t label = (uint32_t)choice;
    const uint32_t fresh = new_label(r, r->opened & (label == 0));
    merges[r->merge_count].a = r->merge.a;
    merges[r->merge_count].b = r->merge.b;
    r->merge_count += r->merges_one;
    r->merge.a = label;
    r->merge.b = (uint32_t)(choice >> 32);
    r->merges_one = r->opened & (r->merge.b != 0);
    return (label & drogue_hls_when((int)r->opened)) | fresh; /* which is 0 when there is a label */
}

static void begin_row(registers *r)
{
    r->dark = 0x1FF; /* outside the image nothing erodes */
    r->eroded = 0;   /* and nothing dilates */
    r->pixel = 0;
    r->in_disc = 0;
    r->bit = 0;
    r->opened = 0;
    r->stored = 0;
    r->root = 0;
    r->left = 0;
    r->above_left = 0;
    r->above = 0;
    r->merge.a = 0;
    r->merge.b = 0;
    r->merges_one = 0;
    r->merge_count = 0;
}

static void clear(label_sums *s)
{
    s->label = 0;
    s->area = 0;
    s->x = 0;
    s->y = 0;
}

static void begin_frame(registers *r, adder *s)
{
    uint32_t i;
    for (i = 0; i < DROGUE_HLS_LABELS; i++) { /* nothing is summed by a label that was not given */
        area[i] = 0;
        x_sum[i] = 0;
        y_sum[i] = 0;
    }
    parent[0] = 0;
    label_count = 1;
    r->full = 0;
    clear(&s->held);
    clear(&s->leaving);
    clear(&s->out);
}

static uint32_t within(int32_t x, int32_t lag, int32_t width) { return (x >= lag) & (x < width + lag); }

/* The stages of a tick but the first, from the last on. Memories are read before they are written. */
static void tick(registers *r, adder *s, int32_t x, int32_t y, int32_t width, int32_t height, uint8_t threshold)
{
    const uint32_t bit = drogue_hls_is_dark(r->pixel, threshold, r->in_disc) | (y >= height);
    const uint32_t eroded = drogue_hls_erode(r->dark) & (y >= 1) & (y <= height);
    const uint32_t opened = drogue_hls_dilate(r->eroded) & within(x, OPENED_LAG, width) & (y >= LAG_ROWS);
    const uint32_t root = parent[r->stored];
    const uint32_t stored = label_row[x + AHEAD];
    label_row[x] = r->left;
    add_pixel(s, r->left, (uint32_t)(x - LAG), (uint32_t)(y - LAG_ROWS));
    r->left = label_pixel(r);
    r->opened = opened;
    r->above_left = r->above;
    r->above = r->root;
    r->root = root;
    r->stored = stored & drogue_hls_when((int)(within(x, LAG - AHEAD, width) & (y > LAG_ROWS)));
    r->eroded = drogue_hls_shift_window(
        r->eroded, take_column(&eroded_rows[x], (int)within(x, ERODED_LAG, width), y == 0, eroded, 0));
    r->dark = drogue_hls_shift_window(r->dark,
                                      take_column(&dark_rows[x], (int)within(x, DARK_LAG, width), y == 0, r->bit, 7u));
    r->bit = bit;
}

void drogue_hls_take_components(const uint8_t *pixels, uint32_t at, int32_t width, int32_t height, int64_t disc_left,
                                int32_t centre2_x, int32_t centre2_y, uint8_t threshold, uint32_t *full)
{
    drogue_hls_walk rows = drogue_hls_walk_from(disc_left, centre2_y);
    registers r;
    adder sums;
    int32_t x;
    int32_t y;
    begin_frame(&r, &sums);
    for (y = 0; y < height + LAG_ROWS; y++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_HEIGHT + LAG_ROWS
        const int32_t taken = y < height ? width : 0;
        drogue_hls_walk columns = drogue_hls_walk_from(rows.left, centre2_x);
        begin_row(&r);
        for (x = 0; x < width + LAG; x++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_WIDTH + LAG
#ifndef __BAMBU__
#pragma HLS pipeline II = 1
/* A line buffer's word is touched in one tick of a row; of labels, a word is read four ticks before it is written. */
#pragma HLS dependence variable = dark_rows type = inter false
#pragma HLS dependence variable = eroded_rows type = inter false
#pragma HLS dependence variable = label_row type = inter direction = RAW false
/* Read: labels of the row above. Written: one that has not been given. */
#pragma HLS dependence variable = parent type = inter false
#endif
            tick(&r, &sums, x, y, width, height, threshold);
            r.in_disc = drogue_hls_in_disc(columns.left);
            drogue_hls_walk_on(&columns);
            if (x < taken) {
                r.pixel = drogue_hls_take_pixel(pixels, at++);
            }
        }
        drogue_hls_walk_on(&rows);
        drogue_labels_resolve(parent, merges, r.merge_count);
    }
    for (x = 0; x < 3; x++) { /* a label of no pixel drives the last one out */
        add_pixel(&sums, DROGUE_HLS_LABELS, 0, 0);
    }
    *full = r.full;
}

drogue_status drogue_hls_choose_components(drogue_inner_part *part, uint32_t *which,
                                           const drogue_inner_expected *expected)
{
    drogue_inner_join(parent, area, x_sum, y_sum, label_count);
    return drogue_inner_choose(part, which, area, x_sum, y_sum, label_count, expected);
}
