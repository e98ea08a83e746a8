/* SPDX-License-Identifier: Apache-2.0 */
/* The stages of the front end as pure functions of registers and of words read from memories: drogue_hls_step() is one clock.
 * A tick runs the stages of pixels.c and labels.c from the last to the first, so that each works on what the one before it
 * left in the tick before: they are independent within a tick. Registers and memories are the caller's, in C those of
 * frontend.c, in hardware those of the shell that shell.c writes. */
#ifndef DROGUE_HLS_STAGES_H
#define DROGUE_HLS_STAGES_H

#include "../drogue_hls.h"
#include "frontend.h"

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

/* The memories: X(name, words, bits). Each has a port to write; _PAIR are read at two places in a clock, the others at one. A
 * word read is the one that lies there when the clock begins, what the clock before wrote included; of those of _LATER_ no word is
 * asked for in the two clocks after it was written. Entry 0 of the tables of
 * labels takes what is not to be kept; a root it never is, so that of component_parent, arc_parent and arc_root 0 is all that
 * is ever written there, and what they power up with. */
#define DROGUE_HLS_LATER_MEMORIES(X)                \
    X(raw_rows, DROGUE_HLS_PERIOD, 32)              \
    X(smooth_rows, DROGUE_HLS_PERIOD, 16)           \
    X(gradient_row, DROGUE_HLS_PERIOD, 32)          \
    X(magnitude_rows, DROGUE_HLS_PERIOD, 32)        \
    X(component_row, DROGUE_HLS_PERIOD, LABEL_BITS) \
    X(arc_row, DROGUE_HLS_PERIOD, LABEL_BITS + 3)   \
    X(point_arc, DROGUE_HLS_EDGES + 1, LABEL_BITS)  \
    X(points, DROGUE_HLS_EDGES + 1, 64)
#define DROGUE_HLS_SINGLE_MEMORIES(X)               \
    X(component_merges, DROGUE_HLS_WIDTH, 32)       \
    X(arc_merges, DROGUE_HLS_WIDTH, 32)             \
    X(component_strong, DROGUE_HLS_LABELS, 1)       \
    X(arc_component, DROGUE_HLS_LABELS, LABEL_BITS) \
    X(arc_key, DROGUE_HLS_LABELS, 3)                \
    X(arc_root, DROGUE_HLS_LABELS, LABEL_BITS)      \
    X(arc_place, DROGUE_HLS_LABELS, POINT_BITS)
#define DROGUE_HLS_MEMORIES(X)   \
    DROGUE_HLS_LATER_MEMORIES(X) \
    DROGUE_HLS_SINGLE_MEMORIES(X)
#define DROGUE_HLS_PAIR_MEMORIES(X)                    \
    X(component_parent, DROGUE_HLS_LABELS, LABEL_BITS) \
    X(arc_parent, DROGUE_HLS_LABELS, LABEL_BITS)       \
    X(arc_points, DROGUE_HLS_LABELS, POINT_BITS)

/* Bits of n. */
#define BITS_4(n) ((n) > 7 ? 4 : (n) > 3 ? 3 : (n) > 1 ? 2 : 1)
#define BITS_8(n) ((n) > 15 ? 4 + BITS_4((n) >> 4) : BITS_4(n))
#define BITS_16(n) ((n) > 255 ? 8 + BITS_8((n) >> 8) : BITS_8(n))
#define BITS(n) ((n) > 65535 ? 16 + BITS_16((n) >> 16) : BITS_16(n))
enum {
    LABEL_BITS = BITS(DROGUE_HLS_LABELS),
    POINT_BITS = BITS(DROGUE_HLS_EDGES) + 1,
    COLUMN_BITS = BITS(DROGUE_HLS_PERIOD),
    ROW_BITS = BITS(DROGUE_HLS_HEIGHT + LAG_ROWS),
    ARC_BITS = BITS(DROGUE_HLS_ARCS),
    ENTRY_BITS = LABEL_BITS > POINT_BITS ? LABEL_BITS : POINT_BITS,
    RING_BITS = 44 /* squares of the ring, nine times, with their sign */
};

/* A count that never needs more bits: what is above them takes neither registers nor carries. */
static inline uint32_t drogue_hls_narrow(uint32_t count, int32_t bits) { return count & UINT32_MAX >> (32 - bits); }

static inline int64_t drogue_hls_narrow_s64(int64_t v, int32_t bits)
{
    return (int64_t)((uint64_t)v << (64 - bits)) >> (64 - bits);
}

/* A word written where enable is 1. */
typedef struct drogue_hls_write {
    uint64_t word;
    uint32_t address;
    uint32_t enable;
} drogue_hls_write;

/* Words that the memories hold at the places asked for in the clock before; _2: of the second place. */
typedef struct drogue_hls_words {
#define X(name, words, bits) uint64_t name;
    DROGUE_HLS_MEMORIES(X)
#undef X
#define X(name, words, bits) uint64_t name, name##_2;
    DROGUE_HLS_PAIR_MEMORIES(X)
#undef X
} drogue_hls_words;

/* Where to read in the next clock. */
typedef struct drogue_hls_places {
#define X(name, words, bits) uint32_t name;
    DROGUE_HLS_MEMORIES(X)
#undef X
#define X(name, words, bits) uint32_t name, name##_2;
    DROGUE_HLS_PAIR_MEMORIES(X)
#undef X
} drogue_hls_places;

typedef struct drogue_hls_writes {
#define X(name, words, bits) drogue_hls_write name;
    DROGUE_HLS_MEMORIES(X)
    DROGUE_HLS_PAIR_MEMORIES(X)
#undef X
    drogue_hls_write edges; /* the lists */
    drogue_hls_write arcs;
} drogue_hls_writes;

static inline drogue_hls_write drogue_hls_write_of(uint32_t address, uint64_t word, uint32_t enable)
{
    drogue_hls_write w;
    w.word = word;
    w.address = address;
    w.enable = enable;
    return w;
}

/* What comes from outside; all but the pixel stays as it is from start to end of a frame. */
typedef struct drogue_hls_asked {
    int32_t width_px;
    int32_t height_px;
    int32_t canny_low;
    int32_t canny_high;
    int32_t smooth;
    uint32_t min_arc_px;
    int32_t use_ring;
    int32_t centre2_x;
    int32_t centre2_y;
    int32_t longest_px;
    uint32_t start; /* 1 when idle: begin a frame */
    uint32_t pixel;
} drogue_hls_asked;

/* What holds for a frame, and for the row of the ring. */
typedef struct drogue_hls_frame {
    int32_t width_px;
    int32_t height_px;
    int32_t period; /* ticks a row */
    int32_t smooth;
    uint16_t low;
    uint16_t high;
    int32_t use_ring;
    int64_t ring_least_x9; /* as in drogue_ring_row */
    int64_t ring_most;
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
    int64_t ring_square;         /* (2x - centre2_x)^2 of the column that comes to AT_LABEL after the next */
    int64_t ring_tested;         /* that of the next, and nine times that */
    int64_t ring_tested_x9;
    int32_t ring_dx;
    uint32_t in_ring; /* the column at AT_LABEL */
} drogue_hls_windows;

/* Stages of pixels.c. */
void drogue_hls_pixels_begin(drogue_hls_windows *w);
void drogue_hls_pixels_tick(drogue_hls_windows *w, const drogue_hls_frame *frame, const drogue_hls_words *read,
                            drogue_hls_writes *write);

/* Registers of labels.c. A pixel of the row above and its labels: as stored, then its roots. */
typedef struct drogue_hls_labels {
    uint32_t component_count; /* labels given + 1 */
    uint32_t arc_count;
    uint32_t components_full;
    uint32_t arcs_full;
    uint32_t component_merges; /* merges of the row in each table */
    uint32_t arc_merges;
    uint32_t component_next;
    uint32_t component_above[3]; /* left, middle, right */
    uint32_t component_left;
    uint32_t component_met[4]; /* labels about the candidate of the tick before, above and left first */
    uint32_t component;        /* of the pixel whose arc comes next, and its direction class + 1; 0: in no arc */
    uint32_t key;
    uint32_t arc_next;
    uint32_t arc_above[3];
    uint32_t arc_left;
    uint32_t arc_met[4];
    uint32_t key_next;
    uint32_t key_above[3];
    uint32_t key_left;
    uint32_t arc;       /* of the pixel that may be listed */
    uint32_t arc_fresh; /* 1: the first of that label */
} drogue_hls_labels;

void drogue_hls_labels_begin(drogue_hls_labels *l);

/* 1 unless the row has no merge, with what the tick at work adds. */
uint32_t drogue_hls_row_merges(uint32_t merges, const uint32_t met[4]);

/* Label the arc of the pixel at AT_LABEL + 1, then the component of the pixel at AT_LABEL. */
void drogue_hls_labels_tick(drogue_hls_labels *l, const drogue_hls_windows *w, const drogue_hls_words *read,
                            drogue_hls_writes *write, uint32_t code);

/* The merges of a row in one table: a merge a clock forward, to join, then one backward, so that every label of the row points
 * at its root: drogue_labels_resolve(). */
typedef struct drogue_hls_settling {
    uint32_t at;      /* the merge whose labels are there */
    uint32_t back;    /* 1: on the way back */
    uint32_t pending; /* 1: parents of a merge are there */
    uint32_t merge;   /* and its place */
    uint32_t label;   /* on the way back: whose parent is written */
    uint32_t done;
} drogue_hls_settling;

/* What a clock of settling does to a table: where to look for parents, where to write one, and the merge. */
typedef struct drogue_hls_settled {
    uint32_t place;
    uint32_t place_2;
    drogue_hls_write parent;
    drogue_hls_write merge;
} drogue_hls_settled;

void drogue_hls_settle_begin(drogue_hls_settling *s, uint32_t any);
drogue_hls_settled drogue_hls_settle(drogue_hls_settling *s, uint32_t merges, uint32_t merge, uint32_t parent,
                                     uint32_t parent_2);

/* The merge that the next clock looks at. */
uint32_t drogue_hls_settle_place(const drogue_hls_settling *s);

/* The lists at the end of a frame: lists.c. Labels and points go through one a clock: asked for, then four stages. */
typedef struct drogue_hls_lists {
    uint32_t points; /* listed so far */
    uint32_t points_full;
    uint32_t at[4];   /* the entry asked for; the one whose words are there; those of the two clocks before */
    uint32_t here[5]; /* 1: there is one; [0] not used */
    uint32_t strong;  /* what a stage hands to the next */
    uint32_t root;
    uint32_t count[2];
    uint32_t is_root;
    uint32_t key;
    uint32_t next;
    uint32_t kept;
    uint64_t point[3];
    uint32_t arcs; /* entries of the arc table */
    uint32_t arcs_full;
    uint32_t first; /* points in arcs so far */
    uint32_t last;  /* where the next point without arc goes */
    uint32_t left;  /* points in strong components */
} drogue_hls_lists;

/* All registers of the block. */
enum {
    PHASE_IDLE,
    PHASE_SQUARES, /* a bit a clock */
    PHASE_NINE,    /* times one of them */
    PHASE_BEGIN,
    PHASE_ROWS,       /* a tick a clock */
    PHASE_SETTLE,     /* the merges of a row, where there are any */
    PHASE_COMPONENTS, /* the roots of components, which of them are strong */
    PHASE_ARCS,       /* the roots of arcs, 0 in a weak component, and their points */
    PHASE_PLACE,      /* the arc table */
    PHASE_SORT,       /* the edge list */
    PHASE_BITS = 4
};
typedef struct drogue_hls_registers {
    uint32_t phase;
    uint32_t status;
    uint32_t row;    /* of ticks */
    uint32_t column; /* tick of the row */
    uint32_t ends;   /* 1: its last */
    drogue_hls_frame frame;
    int32_t ring_dx;     /* 2x - centre2_x of the first column that a row of ticks tests */
    int32_t ring_dy;     /* 2y - centre2_y of the row of labels that begins next */
    uint32_t bit;        /* of the three squares at work */
    uint64_t square[3];  /* of ring_dx, ring_dy, the ring's longest side */
    int64_t ring_dy2_x9; /* nine times the second */
    drogue_hls_windows windows;
    drogue_hls_labels labels;
    drogue_hls_settling components;
    drogue_hls_settling arcs;
    drogue_hls_lists lists;
} drogue_hls_registers;

/* 1 when the clock takes a pixel: it must wait for one. */
static inline uint32_t drogue_hls_takes(const drogue_hls_registers *r)
{
    return (uint32_t)(r->phase == PHASE_ROWS) & r->windows.take;
}

/* One clock.
 *
 *  asked   start and registers of the frame, and the pixel when drogue_hls_takes()
 *  read    words at the places of the clock before; in the first clock it does not matter which
 *  r       in/out; all 0 at power up
 *  places, write  out
 */
void drogue_hls_step(drogue_hls_registers *r, const drogue_hls_asked *asked, const drogue_hls_words *read,
                     drogue_hls_places *places, drogue_hls_writes *write);

/* Append a point when it has an arc, and count it there. */
void drogue_hls_append(drogue_hls_lists *list, uint64_t point, const drogue_hls_labels *labels,
                       const drogue_hls_words *read, drogue_hls_writes *write);

/* A clock of a phase from PHASE_COMPONENTS on; 1 when the phase is complete. */
uint32_t drogue_hls_lists_step(drogue_hls_lists *list, const drogue_hls_labels *labels, uint32_t phase,
                               uint32_t min_arc_px, const drogue_hls_words *read, drogue_hls_places *places,
                               drogue_hls_writes *write);

#endif
