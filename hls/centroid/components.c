/* SPDX-License-Identifier: Apache-2.0 */
/* Dark components of a stream of pixels. A tick takes pixel (x, y) in, erodes (x - 1, y - 1), dilates and labels
 * (x - 2, y - 2); two ticks more a row and two rows more let the last pixels through. */
#include "components.h"

#include "operators.h"

enum { LAG = 2, MERGES = DROGUE_HLS_WIDTH / 2 + 1 };

/* Line buffers. Of bits: row y - 1 in bit 0, row y - 2 in bit 1, as they come in; a word is read and written once in a
 * tick and not again before the next row. */
static uint8_t dark_rows[DROGUE_HLS_WIDTH];
static uint8_t eroded_rows[DROGUE_HLS_WIDTH];
static uint32_t label_row[DROGUE_HLS_WIDTH]; /* as given: roots are their parents */

/* Tables by label. */
static uint32_t parent[DROGUE_HLS_LABELS];
static uint32_t area[DROGUE_HLS_LABELS];
static uint32_t x_sum[DROGUE_HLS_LABELS];
static uint32_t y_sum[DROGUE_HLS_LABELS];
static uint32_t label_count;
static drogue_merge merges[MERGES];

/* Registers of the pixel loop. */
typedef struct registers {
    uint32_t dark;   /* 3x3 window of the thresholded image */
    uint32_t eroded; /* and of the eroded one */
    uint32_t left;   /* labels of the neighbours: the left one as given, those above roots */
    uint32_t above_left;
    uint32_t above;
    uint32_t above_right;
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

static void store_held(const held_sums *h)
{
    area[h->label] += h->area;
    x_sum[h->label] += h->x;
    y_sum[h->label] += h->y;
}

static void add_pixel(held_sums *h, uint32_t label, int32_t x, int32_t y)
{
    if (label != h->label) {
        store_held(h);
        h->label = label;
        h->area = 0;
        h->x = 0;
        h->y = 0;
    }
    h->area++;
    h->x += (uint32_t)x;
    h->y += (uint32_t)y;
}

/* Put the newest bit of column x under the two that the line buffer holds; beyond the image all are 'outside'. */
static uint32_t take_column(uint8_t *rows, int32_t x, int32_t width_px, int first_row, uint32_t bit, uint32_t outside)
{
    uint32_t column;
    if (x < 0 || x >= width_px) {
        return outside;
    }
    column = ((first_row ? outside : rows[x]) << 1 | bit) & 7u;
    rows[x] = (uint8_t)(column & 3u);
    return column;
}

static uint32_t new_label(registers *r)
{
    const uint32_t label = label_count;
    if (label >= DROGUE_HLS_LABELS) {
        r->full = 1;
        return 0;
    }
    parent[label] = label;
    label_count++;
    return label;
}

/* Label of an opened pixel. */
static uint32_t label_pixel(registers *r)
{
    const uint64_t choice = drogue_hls_choose_dark_label(r->above, r->left, r->above_left, r->above_right);
    const uint32_t label = (uint32_t)choice;
    const uint32_t merge_with = (uint32_t)(choice >> 32);
    if (merge_with != 0) {
        merges[r->merge_count].a = label;
        merges[r->merge_count].b = merge_with;
        r->merge_count++;
    }
    return label != 0 ? label : new_label(r);
}

/* Opened pixel (x, y) or what lies beyond: labels shift on by one column. */
static void label_column(registers *r, held_sums *h, int32_t x, int32_t y, int32_t width_px, uint32_t opened)
{
    const int32_t right = x + 1;
    uint32_t label = 0;
    r->above_left = r->above;
    r->above = r->above_right;
    r->above_right = y > 0 && right >= 0 && right < width_px ? parent[label_row[right]] : 0;
    if (x >= 0 && x < width_px && y >= 0) {
        if (opened != 0) {
            label = label_pixel(r);
        }
        if (label != 0) {
            add_pixel(h, label, x, y);
        }
        label_row[x] = label;
    }
    r->left = label;
}

static void begin_row(registers *r)
{
    r->dark = 0x1FF; /* outside the image nothing erodes */
    r->eroded = 0;   /* and nothing dilates */
    r->left = 0;
    r->above_left = 0;
    r->above = 0;
    r->above_right = 0;
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

void drogue_hls_take_components(const uint8_t *pixels, uint32_t at, int32_t width, int32_t height, int32_t centre2_x,
                                int32_t centre2_y, int32_t longest_px, uint8_t threshold, uint32_t *full)
{
    const drogue_mask disc = {centre2_x, centre2_y, longest_px};
    registers r;
    held_sums held;
    int32_t x;
    int32_t y;
    begin_frame(&r, &held);
    for (y = 0; y < height + LAG; y++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_HEIGHT + LAG
        const int64_t most_x9 = drogue_mask_disc_row(&disc, y);
        begin_row(&r);
        for (x = 0; x < width + LAG; x++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_WIDTH + LAG
#ifndef __BAMBU__
#pragma HLS pipeline II = 1
/* A line buffer's word is touched in one tick of a row; of labels, column x + 1 is read before it is written. */
#pragma HLS dependence variable = dark_rows type = inter false
#pragma HLS dependence variable = eroded_rows type = inter false
#pragma HLS dependence variable = label_row type = inter direction = RAW false
/* Read: labels of the row above. Written: new ones. */
#pragma HLS dependence variable = parent type = inter false
/* A label's sums are stored when another label comes: not again within three ticks. */
#pragma HLS dependence variable = area type = inter direction = RAW distance = 3 true
#pragma HLS dependence variable = x_sum type = inter direction = RAW distance = 3 true
#pragma HLS dependence variable = y_sum type = inter direction = RAW distance = 3 true
#endif
            uint32_t bit = 1;
            if (x < width && y < height) {
                bit = drogue_hls_is_dark(pixels[at++], threshold, drogue_hls_in_disc(x, centre2_x, most_x9));
            }
            r.dark = drogue_hls_shift_window(r.dark, take_column(dark_rows, x, width, y == 0, bit, 7u));
            bit = y >= 1 && y <= height ? drogue_hls_erode(r.dark) : 0;
            r.eroded = drogue_hls_shift_window(r.eroded, take_column(eroded_rows, x - 1, width, y == 0, bit, 0));
            label_column(&r, &held, x - LAG, y - LAG, width, drogue_hls_dilate(r.eroded));
        }
        drogue_labels_resolve(parent, merges, r.merge_count);
    }
    store_held(&held);
    *full = r.full;
}

drogue_status drogue_hls_choose_components(drogue_dark_part *part, uint32_t *which, uint32_t min_area,
                                           const drogue_ellipse expected[2], uint32_t count)
{
    drogue_dark_join(parent, area, x_sum, y_sum, label_count);
    return drogue_dark_choose(part, which, area, x_sum, y_sum, label_count, min_area, expected, count);
}
