/* SPDX-License-Identifier: Apache-2.0 */
/* The stages of the front end. Each has its own memories; registers between them are the caller's. A tick runs them from
 * the last to the first, so that each works on what the one before it left in the tick before: they are independent
 * within a tick. */
#ifndef DROGUE_HLS_STAGES_H
#define DROGUE_HLS_STAGES_H

#include "../drogue_hls.h"

/* What holds for a row of ticks. Row y of pixels comes in; row y - 2 is smoothed, y - 3 has its gradient taken, y - 4 is
 * suppressed and labelled. */
typedef struct drogue_hls_row {
    int32_t width_px;
    int32_t height_px;
    int32_t y;
    int32_t smooth;
    uint16_t low;
    uint16_t high;
    int32_t use_ring;
    drogue_ring_row ring; /* of row y - 4 */
    uint8_t tap[5];       /* which of rows y - 4 .. y are the five of smoothing, border reflected */
} drogue_hls_row;

/* Registers between the stages of pixels.c; all 0 at the start of a row. */
typedef struct drogue_hls_windows {
    uint16_t sum[5];          /* vertical sums of columns x - 4 .. x */
    uint8_t middle[5];        /* and their middle pixels */
    uint8_t level;            /* smoothed pixel */
    uint8_t levels[3][3];     /* window of smoothed pixels, [row][column] */
    uint32_t gradient;        /* of one pixel */
    uint16_t column[3];       /* magnitudes of a column, top to bottom */
    uint32_t column_gradient; /* gradient of its middle */
    uint16_t magnitude[3][3];
    uint32_t middle_gradient; /* of the window's right column */
    uint64_t suppressed;      /* drogue_hls_suppress()'s word, class bits 0 outside the ring */
    uint32_t gradients[2];    /* of that pixel, and of the one of 'code' */
    uint32_t code;            /* drogue_hls_locate()'s */
} drogue_hls_windows;

/* Stages of pixels.c; 'x' is the column of the pixel that each takes in, which the caller delays: a stage does nothing
 * for a column outside its range. */
void drogue_hls_smooth_vertically(drogue_hls_windows *w, const drogue_hls_row *row, int32_t x, uint8_t pixel);
void drogue_hls_smooth_horizontally(drogue_hls_windows *w, const drogue_hls_row *row, int32_t x);
void drogue_hls_gradient_stage(drogue_hls_windows *w, const drogue_hls_row *row, int32_t x);
void drogue_hls_column_stage(drogue_hls_windows *w, const drogue_hls_row *row, int32_t x);
void drogue_hls_suppress_stage(drogue_hls_windows *w, const drogue_hls_row *row, int32_t x);

void drogue_hls_locate_stage(drogue_hls_windows *w);

/* A pixel of the row above and its labels. */
typedef struct drogue_hls_labelled {
    uint32_t component;
    uint32_t arc;
    uint32_t key; /* direction class + 1; 0: in no arc */
} drogue_hls_labelled;

/* Registers of labels.c; the windows are empty at the start of a row. */
typedef struct drogue_hls_labels {
    uint32_t component_count; /* labels given + 1 */
    uint32_t arc_count;
    uint32_t components_full;
    uint32_t arcs_full;
    drogue_hls_labelled next;     /* as stored: its labels are not roots yet */
    drogue_hls_labelled above[3]; /* left, middle, right: roots */
    drogue_hls_labelled left;
} drogue_hls_labels;

void drogue_hls_labels_begin(drogue_hls_labels *l);
void drogue_hls_labels_row(drogue_hls_labels *l);

/* Label the pixel of a code in column x, which runs from -3; returns its arc's label, 0 when it has none. */
uint32_t drogue_hls_label_stage(drogue_hls_labels *l, const drogue_hls_row *row, int32_t x, uint32_t code);

/* The row is complete: resolve its merges. */
void drogue_hls_labels_settle(void);

/* The frame is complete: every label's parent is its root; does a root's component hold a strong point? */
void drogue_hls_labels_flatten(const drogue_hls_labels *l);
uint32_t drogue_hls_arc_root(uint32_t arc);
uint32_t drogue_hls_arc_key(uint32_t arc);
uint32_t drogue_hls_arc_alive(uint32_t root);

#endif
