/* SPDX-License-Identifier: Apache-2.0 */
/* Dark components of a stream of pixels. Tick x of row y takes pixel (x, y) in and sums (x - 6, y - 2); the stages
 * between run from the last to the first, each on what the one before it left in the tick before, so that they are
 * independent within a tick. Nothing is stored on a condition: what is not wanted goes where nobody looks. */
#include "components.h"

#include "../choose_label.h"
#include "operators.h"

enum { LAG_ROWS = 2, LAG = 6, LABEL_LAG = 5, AHEAD = 3, MERGES = DROGUE_HLS_WIDTH / 2 + 2 };

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
    uint32_t in_disc; /* of the pixel to come */
    uint32_t bit;     /* of column x - 1: dark */
    uint32_t dark;    /* 3x3 window of the thresholded image */
    uint32_t eroded;  /* and of the eroded one */
    uint32_t stored;  /* label read from the line buffer */
    uint32_t root;    /* root of the one read before that */
    uint32_t left;    /* labels of the neighbours: the left one as given, those above roots */
    uint32_t above_left;
    uint32_t above;
    uint32_t merge_count;
    uint32_t full;
} registers;

/* Sums of the label met last: tables are written when another one comes, every second tick at most. */
typedef struct held_sums {
    uint32_t label;
    uint32_t area;
    uint32_t x;
    uint32_t y;
} held_sums;

static void store_held(const held_sums *h, uint32_t label)
{
    area[label] += h->area;
    x_sum[label] += h->x;
    y_sum[label] += h->y;
}

static void add_pixel(held_sums *h, uint32_t label, uint32_t x, uint32_t y)
{
    const uint32_t one = label != 0;
    const int other = one && label != h->label;
    store_held(h, other ? h->label : 0);
    h->area = (other ? 0 : h->area) + one;
    h->x = (other ? 0 : h->x) + (one ? x : 0);
    h->y = (other ? 0 : h->y) + (one ? y : 0);
    h->label = other ? label : h->label;
}

/* Put the newest bit of a column under the two that the line buffer holds; beyond the image all are 'outside'. */
static uint32_t take_column(uint8_t *word, int inside, int first_row, uint32_t bit, uint32_t outside)
{
    const uint32_t column = ((first_row ? outside : *word) << 1 | bit) & 7u;
    *word = (uint8_t)(column & 3u);
    return inside ? column : outside;
}

static uint32_t new_label(registers *r, int wanted)
{
    const uint32_t label = label_count;
    const int given = wanted && label < DROGUE_HLS_LABELS;
    parent[label] = label;
    label_count = label + (given ? 1u : 0u);
    r->full |= wanted && !given;
    return given ? label : 0;
}

/* Label of the pixel whose neighbours the registers hold, 0 when it is not an opened one. */
static uint32_t label_pixel(registers *r, int opened)
{
    const uint64_t choice = drogue_hls_choose_label(r->above, r->left, r->above_left, r->root);
    const uint32_t label = (uint32_t)choice;
    const uint32_t merge_with = (uint32_t)(choice >> 32);
    const uint32_t fresh = new_label(r, opened && label == 0);
    merges[r->merge_count].a = label;
    merges[r->merge_count].b = merge_with;
    r->merge_count += opened && merge_with != 0;
    return !opened ? 0 : label != 0 ? label : fresh;
}

static void begin_row(registers *r)
{
    r->dark = 0x1FF; /* outside the image nothing erodes */
    r->eroded = 0;   /* and nothing dilates */
    r->bit = 0;
    r->stored = 0;
    r->root = 0;
    r->left = 0;
    r->above_left = 0;
    r->above = 0;
    r->merge_count = 0;
}

static void begin_frame(registers *r, held_sums *h)
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
    h->label = 0;
    h->area = 0;
    h->x = 0;
    h->y = 0;
}

/* The stages of a tick but the first, from the last on: sums of column x - 6, label of x - 5. Memories are read before
 * they are written. */
static void tick(registers *r, held_sums *h, int32_t x, int32_t y, int32_t width, int32_t height)
{
    const int32_t at = x - LABEL_LAG;
    const int opened = at >= 0 && at < width && y >= LAG_ROWS && drogue_hls_dilate(r->eroded) != 0;
    const uint32_t eroded = y >= 1 && y <= height ? drogue_hls_erode(r->dark) : 0;
    const uint32_t root = parent[r->stored];
    const uint32_t stored = label_row[x + AHEAD];
    add_pixel(h, r->left, (uint32_t)(at - 1), (uint32_t)(y - LAG_ROWS));
    r->left = label_pixel(r, opened);
    label_row[x] = r->left;
    r->above_left = r->above;
    r->above = r->root;
    r->root = root;
    r->stored = x >= LABEL_LAG - AHEAD && x < width + LABEL_LAG - AHEAD && y > LAG_ROWS ? stored : 0;
    r->eroded =
        drogue_hls_shift_window(r->eroded, take_column(&eroded_rows[x], x >= 3 && x < width + 3, y == 0, eroded, 0));
    r->dark = drogue_hls_shift_window(r->dark, take_column(&dark_rows[x], x >= 1 && x < width + 1, y == 0, r->bit, 7u));
}

void drogue_hls_take_components(const uint8_t *pixels, uint32_t at, int32_t width, int32_t height, int32_t centre2_x,
                                int32_t centre2_y, int32_t longest_px, uint8_t threshold, uint32_t *full)
{
    const drogue_mask disc = {centre2_x, centre2_y, longest_px};
    registers r;
    held_sums held;
    int32_t x;
    int32_t y;
    begin_frame(&r, &held);
    for (y = 0; y < height + LAG_ROWS; y++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_HEIGHT + LAG_ROWS
        const int64_t most_x9 = drogue_mask_disc_row(&disc, y);
        begin_row(&r);
        r.in_disc = drogue_hls_in_disc(0, centre2_x, most_x9);
        for (x = 0; x < width + LAG; x++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_WIDTH + LAG
#ifndef __BAMBU__
#pragma HLS pipeline II = 1
/* A line buffer's word is touched in one tick of a row; of labels, a word is read three ticks before it is written. */
#pragma HLS dependence variable = dark_rows type = inter false
#pragma HLS dependence variable = eroded_rows type = inter false
#pragma HLS dependence variable = label_row type = inter direction = RAW false
/* Read: labels of the row above. Written: one that has not been given. */
#pragma HLS dependence variable = parent type = inter false
/* A label's sums are stored when another label comes: not again within three ticks. */
#pragma HLS dependence variable = area type = inter direction = RAW distance = 3 true
#pragma HLS dependence variable = x_sum type = inter direction = RAW distance = 3 true
#pragma HLS dependence variable = y_sum type = inter direction = RAW distance = 3 true
#endif
            const uint32_t in_disc = r.in_disc;
            r.in_disc = drogue_hls_in_disc(x + 1, centre2_x, most_x9);
            tick(&r, &held, x, y, width, height);
            r.bit = 1;
            if (x < width && y < height) {
                r.bit = drogue_hls_is_dark(drogue_hls_take_pixel(pixels, at++), threshold, in_disc);
            }
        }
        drogue_labels_resolve(parent, merges, r.merge_count);
    }
    store_held(&held, held.label);
    *full = r.full;
}

drogue_status drogue_hls_choose_components(drogue_dark_part *part, uint32_t *which, uint32_t min_area,
                                           const drogue_ellipse expected[2], uint32_t count)
{
    drogue_dark_join(parent, area, x_sum, y_sum, label_count);
    return drogue_dark_choose(part, which, area, x_sum, y_sum, label_count, min_area, expected, count);
}
