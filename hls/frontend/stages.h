/* SPDX-License-Identifier: Apache-2.0 */
/* The stages of the front end. Each has its own memories; registers between them are the caller's. A tick runs them from
 * the last to the first, so that each works on what the one before it left in the tick before: they are independent
 * within a tick. */
#ifndef DROGUE_HLS_STAGES_H
#define DROGUE_HLS_STAGES_H

#include "../drogue_hls.h"

/* Ticks between a place's being counted off and the stage that it then is in; in a window, the place in its middle, but
 * where something enters it. */
enum {
    AT_REFLECT_ROWS = 1,    /* the indices about it come a tick before, which of five lines they are a tick after */
    AT_TAKE = 2,            /* the pixel is taken from the stream */
    AT_PICK_ROWS = 3,       /* which rows smoothing sums */
    AT_SUM_ROWS = 4,        /* its vertical sum */
    AT_REFLECT_COLUMNS = 5, /* the same */
    AT_PICK_COLUMNS = 7,
    AT_SUM_COLUMNS = 8, /* its horizontal sum: a smoothed pixel */
    AT_LEVELS = 9,      /* three of them, one above the other */
    AT_WINDOW = 10,     /* they enter their window */
    AT_GRADIENT = 12,
    AT_MAGNITUDE = 13,
    AT_MAGNITUDES = 14, /* three, one above the other */
    AT_TANGENT = 15,    /* they enter their window */
    AT_SECTOR = 16,
    AT_NEIGHBOURS = 17,
    AT_SUPPRESS = 18,
    AT_DIVIDE = 19, /* three ticks */
    AT_PLACE = 22,  /* the word of the edge list */
    AT_LABEL = 23,  /* the component's; the arc's a tick later */
    AT_LIST = 25,
    PLACES = 26
};

/* A row of ticks is IDLE_PX longer than the region is wide: labels are read three columns ahead, arcs and points follow two
 * ticks behind. It is LEAST_PERIOD at least: before so many ticks no word of a line buffer is met again. Labels of row 0
 * come LAG_ROWS rows of ticks after the start. */
enum { IDLE_PX = 5, LEAST_PERIOD = PLACES - 1, LAG_ROWS = 5 };
#define DROGUE_HLS_PERIOD (DROGUE_HLS_WIDTH + LEAST_PERIOD)

/* What holds for a frame, and for the row of the ring. */
typedef struct drogue_hls_frame {
    int32_t width_px;
    int32_t height_px;
    int32_t period; /* ticks a row */
    int32_t smooth;
    uint16_t low;
    uint16_t high;
    int32_t use_ring;
    drogue_ring_row ring;
} drogue_hls_frame;

/* Registers between the stages of pixels.c; all 0 at the start of a frame but for the place counted off. */
typedef struct drogue_hls_windows {
    uint16_t x[PLACES]; /* places of the last ticks, the newest first: row y of pixels comes in while row y - 2 is */
    uint16_t y[PLACES]; /* smoothed, y - 3 has its gradient taken, y - 4 is suppressed and labelled */
    uint32_t take;      /* is there a pixel at x[AT_TAKE]? */
    uint8_t pixel;
    int16_t row_about[5];    /* indices of the five rows about the one smoothed */
    int16_t near_row[5];     /* the same, border reflected */
    uint8_t row_tap[5];      /* which of rows y - 4 .. y are the five of smoothing */
    uint8_t rows[5];         /* those */
    uint16_t sum[5];         /* vertical sums of the newest five columns */
    uint8_t middle[6];       /* and their middle pixels */
    int16_t column_about[5]; /* and so the columns */
    int16_t near_column[5];
    uint8_t column_tap[5];
    uint16_t columns[5];
    uint8_t smoothed;
    uint8_t level_column[3];
    uint8_t levels[3][3]; /* window of smoothed pixels, [row][column] */
    uint32_t gradient[2]; /* of a pixel; and of the one whose magnitude this is */
    uint16_t magnitude;
    uint16_t column[3]; /* magnitudes of a column, top to bottom */
    uint16_t magnitudes[3][3];
    uint32_t middle_gradient[AT_PLACE + 1]; /* gradient of the middle row, by tick */
    uint32_t tangent;
    uint32_t sector[AT_PLACE + 1]; /* sector and direction class, by tick */
    uint64_t neighbours;
    uint32_t code[AT_LABEL + 1]; /* drogue_hls_suppress()'s, by tick */
    uint64_t vertex[AT_PLACE + 1];
    uint32_t offset;
    uint64_t point[AT_LIST + 1]; /* word of the edge list, by tick */
    int64_t ring_square;         /* (2x - centre2_x)^2 of the column that comes to AT_LABEL next */
    int32_t ring_dx;
    uint32_t in_ring; /* the column at AT_LABEL */
} drogue_hls_windows;

/* Words that the line buffers hold at the places of this tick. */
typedef struct drogue_hls_lines {
    uint32_t raw;        /* four rows above the pixel, the oldest lowest */
    uint32_t smooth;     /* two */
    uint32_t gradient;   /* one */
    uint32_t magnitudes; /* two */
} drogue_hls_lines;

/* Stages of pixels.c; the lines are read first. */
void drogue_hls_pixels_begin(drogue_hls_windows *w);
drogue_hls_lines drogue_hls_lines_read(const drogue_hls_windows *w);
void drogue_hls_pixels_tick(drogue_hls_windows *w, const drogue_hls_frame *frame, const drogue_hls_lines *lines);

/* Registers of labels.c. A pixel of the row above and its labels: as stored, then its roots. */
enum { DROGUE_HLS_KEYS = 4 }; /* direction classes */
typedef struct drogue_hls_labels {
    uint32_t component_count; /* labels given + 1 */
    uint32_t arc_count;
    uint32_t components_full;
    uint32_t arcs_full;
    uint32_t component_merges; /* merges of the row in each table */
    uint32_t arc_merges[DROGUE_HLS_KEYS];
    uint32_t component_next;
    uint32_t component_above[3]; /* left, middle, right */
    uint32_t component_left;
    uint32_t component; /* of the pixel whose arc comes next, and its code */
    uint32_t code;
    uint32_t arc_next;
    uint32_t arc_above[3];
    uint32_t arc_left;
    uint32_t table_next; /* the table of the key */
    uint32_t key_next;   /* direction class + 1; 0: in no arc */
    uint32_t key_above[3];
    uint32_t key_left;
    uint32_t arc; /* of the pixel that may be listed */
} drogue_hls_labels;

/* Words that the rows and tables of labels hold for this tick. */
typedef struct drogue_hls_known {
    uint32_t component; /* three columns ahead, as stored */
    uint32_t arc;
    uint32_t key;
    uint32_t component_root; /* of those met in the tick before */
    uint32_t arc_root;
} drogue_hls_known;

void drogue_hls_labels_begin(drogue_hls_labels *l);
void drogue_hls_labels_row(drogue_hls_labels *l);
drogue_hls_known drogue_hls_known_read(const drogue_hls_labels *l, const drogue_hls_windows *w);

/* Label the arc of the pixel at AT_LABEL + 1, then the component of the pixel at AT_LABEL. */
void drogue_hls_labels_tick(drogue_hls_labels *l, const drogue_hls_windows *w, const drogue_hls_known *known,
                            uint32_t code);

/* The row is complete: resolve its merges. */
void drogue_hls_labels_settle(const drogue_hls_labels *l);

/* The frame is complete: find the root of every label, and which components hold a strong point. */
void drogue_hls_labels_flatten(const drogue_hls_labels *l);

/* Root of an arc, 0 when its component holds no strong point; direction class + 1 of an arc. */
uint32_t drogue_hls_arc_root(uint32_t arc);
uint32_t drogue_hls_arc_key(uint32_t arc);

#endif
