/* SPDX-License-Identifier: Apache-2.0 */
/* The stages of the front end as pure functions of registers and of words read from memories: drogue_hls_step() is one clock.
 * A tick runs the stages of pixels.c and labels.c from the last to the first, so that each works on what the one before it
 * left in the tick before: they are independent within a tick. Registers and memories are the caller's, in C those of
 * frontend_top.c, in hardware those of the shell that shell.c writes. */
#ifndef DROGUE_HLS_STAGES_H
#define DROGUE_HLS_STAGES_H

#include "../drogue_hls.h"
#include "frontend.h"

/* Ticks between a place's being counted off and the stage that it then is in; in a window, the place in its middle, but
 * where something enters it. */
enum {
    AT_ABOUT_ROWS = 1,    /* indices of the rows about it; the border reflected in two ticks; which of five lines */
    AT_TAKE = 3,          /* the pixel is taken from the stream */
    AT_ROWS = 4,          /* it and the four above it */
    AT_PICK_ROWS = 5,     /* which rows smoothing sums */
    AT_ABOUT_COLUMNS = 6, /* the same */
    AT_PAIR_ROWS = 6,     /* the two next to the middle, the two outside */
    AT_SUM_ROWS = 7,      /* its vertical sum */
    AT_PICK_COLUMNS = 10,
    AT_PAIR_COLUMNS = 11, /* the same */
    AT_SUM_COLUMNS = 12,  /* its horizontal sum: a smoothed pixel */
    AT_LEVELS = 13,       /* three of them, one above the other */
    AT_WINDOW = 14,       /* they enter their window */
    AT_SIDES = 16,        /* sums of the window's sides */
    AT_GRADIENT = 17,
    AT_MAGNITUDE = 18,
    AT_MAGNITUDES = 19, /* three, one above the other */
    AT_COLUMN = 20,     /* 0 outside; then they enter their window */
    AT_ABSOLUTE = 20,   /* of the middle row's gradient */
    AT_TANGENT = 21,
    AT_SECTOR = 22,
    AT_NEIGHBOURS = 23,
    AT_SUPPRESS = 24,
    AT_VERTEX = 24,
    AT_REST = 25,   /* the division begins */
    AT_DIVIDE = 26, /* five ticks */
    AT_OFFSET = 31,
    AT_PLACE = 32, /* the word of the edge list */
    AT_LABEL = 33, /* the component's; the arc's a tick later */
    AT_LIST = 35,
    PLACES = 36
};

/* A row of ticks is IDLE_PX longer than the region is wide: the roots of labels above come three columns ahead, arcs and
 * points follow two ticks behind. It is LEAST_PERIOD at least: before so many ticks no word of a line buffer is met
 * again. Labels of row 0 come LAG_ROWS rows of ticks after the start. */
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
    int32_t last_x; /* the last tick of a row */
    int32_t turn_x; /* twice the last column, row: what reflects at it */
    int32_t turn_y;
    int32_t smooth;
    uint16_t low;
    uint16_t high;
    int32_t use_ring;
    int64_t ring_least_x9; /* of drogue_hls_in_ring() */
    int64_t ring_most;
} drogue_hls_frame;

/* Registers between the stages of pixels.c; all 0 at the start of a frame but for the place counted off. */
typedef struct drogue_hls_windows {
    uint16_t x[PLACES]; /* places of the last ticks, the newest first: row y of pixels comes in while row y - 2 is */
    uint16_t y[PLACES]; /* smoothed, y - 3 has its gradient taken, y - 4 is suppressed and labelled */
    uint32_t wraps;     /* 1: x[0] is a row's last */
    uint8_t inside[AT_SUPPRESS + 1]; /* is x one of the region's columns? From 1 on */
    uint32_t take;                   /* is there a pixel at x[AT_TAKE]? */
    uint8_t pixel;
    int16_t row_about[5];  /* indices of the five rows about the one smoothed */
    int16_t row_folded[5]; /* the same, reflected at 0 */
    int16_t near_row[5];   /* and at the last, for its sign */
    uint8_t row_tap[5];    /* which of rows y - 4 .. y are the five of smoothing */
    uint8_t raw[5];        /* rows y - 4 .. y */
    uint8_t rows[5];       /* those five */
    uint16_t outer_rows;   /* sums of two of them, and the middle one */
    uint16_t inner_rows;
    uint8_t middle_row;
    uint16_t sum[5];         /* vertical sums of the newest five columns */
    uint8_t middle[6];       /* and their middle pixels */
    int16_t column_about[5]; /* and so the columns */
    int16_t column_folded[5];
    int16_t near_column[5];
    uint8_t column_tap[5];
    uint16_t columns[5];
    uint16_t outer; /* sums of two columns, and the middle one */
    uint16_t inner;
    uint16_t centre;
    uint8_t smoothed;
    uint8_t is_top; /* 1: the row of the gradient at x[AT_LEVELS] is the first; the last */
    uint8_t is_bottom;
    uint8_t level_column[3];
    uint8_t is_first;     /* 1: x[AT_WINDOW] is 0 */
    uint8_t levels[3][3]; /* window of smoothed pixels, [row][column] */
    uint64_t sides;
    uint32_t gradient[2]; /* of a pixel; and of the one whose magnitude this is */
    uint16_t magnitude;
    uint8_t has_above[2]; /* is there a row above x[AT_MAGNITUDES]'s that is suppressed, in the region? One below? */
    uint8_t has_below[2]; /* And those of x[AT_COLUMN] */
    uint16_t stacked[3];  /* magnitudes of a column, top to bottom, as they lie there */
    uint16_t column[3];   /* and 0 outside */
    uint16_t magnitudes[3][3];
    uint32_t middle_gradient[AT_PLACE + 1]; /* gradient of the middle row, by tick */
    uint16_t absolute_x[2];                 /* |gx| of x[AT_TANGENT], x[AT_SECTOR]; |gy| */
    uint16_t absolute_y[2];
    uint32_t tangent;
    uint32_t sector[AT_OFFSET + 1]; /* sector and direction class, by tick */
    uint64_t neighbours;
    uint32_t is_in;              /* is x[AT_SUPPRESS] in the region? */
    uint32_t code[AT_LABEL + 1]; /* drogue_hls_suppress()'s, by tick; at AT_LABEL 0 outside the ring */
    uint64_t vertex[AT_OFFSET + 1];
    uint32_t offset;
    uint64_t point[AT_LIST + 1]; /* word of the edge list, by tick */
    int64_t ring_square;         /* (2x - centre2_x)^2 of the column that comes to AT_LABEL - 1 after the next */
    int64_t ring_tested;         /* that of the next, and nine times that */
    int64_t ring_tested_x9;
    int32_t ring_step; /* what the next square is more */
    uint32_t in_ring;  /* the column at AT_LABEL - 1 */
} drogue_hls_windows;

/* Stages of pixels.c. */
void drogue_hls_pixels_begin(drogue_hls_windows *w);
void drogue_hls_pixels_tick(drogue_hls_windows *w, const drogue_hls_frame *frame, const drogue_hls_words *read,
                            drogue_hls_writes *write);

/* Registers of labels.c, in each table the same: what lies about the pixel whose label comes next, as far as it can be known
 * before the label on its left is. */
typedef struct drogue_hls_near {
    uint32_t count;  /* labels given + 1 */
    uint32_t room;   /* 1: there is one left */
    uint32_t full;   /* 1: a pixel found none left */
    uint32_t next;   /* label as stored, three columns ahead; then its root comes */
    uint32_t coming; /* 1: that is a label */
    uint32_t right;  /* root above right, and whether there is one */
    uint32_t has_right;
    uint32_t above; /* the same above */
    uint32_t has_above;
    uint32_t fixed;     /* 1: the pixel has the label above it */
    uint32_t nearest;   /* that, or the one above left; */
    uint32_t is_near;   /* 1: it can be its label */
    uint32_t may_right; /* 1: the one above right can */
    uint32_t may_left;  /* 1: the left one can, where there is one */
    uint32_t label;     /* of the pixel of the tick before, 0: none */
    uint32_t labelled;  /* 1: it has one, */
    uint32_t given;     /* that nobody had before */
    uint32_t meets;     /* 1: it may join two labels, */
    uint32_t met[2];    /* these */
    uint32_t merges;    /* of the row */
} drogue_hls_near;
typedef struct drogue_hls_labels {
    drogue_hls_near component;
    drogue_hls_near arc;
    uint32_t strong;       /* is the pixel of the component's label strong? */
    uint32_t key;          /* and its direction class + 1 */
    uint32_t component_of; /* component of the pixel of the arc's label, and its key */
    uint32_t key_of;
    uint32_t key_next; /* keys of the pixels above, as their labels */
    uint32_t key_coming;
    uint32_t key_right;
    uint32_t key_above;
} drogue_hls_labels;

void drogue_hls_labels_begin(drogue_hls_labels *l);

/* Label the arc of the pixel at AT_LABEL + 1, then the component of the pixel at AT_LABEL. */
void drogue_hls_labels_tick(drogue_hls_labels *l, const drogue_hls_windows *w, const drogue_hls_words *read,
                            drogue_hls_places *places, drogue_hls_writes *write);

/* The merges of a row in one table: a merge a clock forward, to join, then one backward, so that every label of the row points
 * at its root: drogue_labels_resolve(). A merge's word, its labels, their parents, and what is made of them are a clock each. */
typedef struct drogue_hls_settling {
    uint32_t at;       /* the merge whose word is there */
    uint32_t coming;   /* 1: it is to be taken */
    uint32_t back;     /* 1: on the way back */
    uint32_t here[3];  /* 1: a merge is in this stage: its parents are asked for, there, in registers */
    uint32_t place[3]; /* its place */
    uint32_t label[3]; /* its labels */
    uint32_t label_2[3];
    uint32_t parent;
    uint32_t parent_2;
    uint32_t written; /* what the merge before wrote, and where */
    uint32_t written_at;
    uint32_t done;
} drogue_hls_settling;

/* What a clock of settling does to a table: where to look for parents, where to write one, and the merge. */
typedef struct drogue_hls_settled {
    uint32_t place;
    uint32_t place_2;
    drogue_hls_write parent;
    drogue_hls_write merge;
} drogue_hls_settled;

/* In the last tick of a row: the first merge's word is there. */
void drogue_hls_settle_begin(drogue_hls_settling *s, uint32_t merges, uint32_t merge);
drogue_hls_settled drogue_hls_settle(drogue_hls_settling *s, uint32_t merges, uint32_t merge, uint32_t parent,
                                     uint32_t parent_2);

/* The lists: lists.c. At the end of a frame labels and points go through one a clock: asked for, then LIST_STAGES stages. A
 * word read is a register before anything is made of it. */
enum { LIST_STAGES = 7 };
typedef struct drogue_hls_lists {
    uint32_t points; /* listed so far */
    uint32_t points_full;
    uint32_t counted[2]; /* arcs of the two pixels whose points are counted: its word is there; and is a register */
    uint32_t counts[2];  /* 1: it is listed */
    uint32_t anew;       /* 1: the first of its arc */
    uint32_t before;     /* points of the arc */
    uint32_t again;      /* 1: the same arc as the pixel before it, whose points are these */
    uint32_t sum;
    uint32_t entries;               /* of the phase */
    uint32_t at[LIST_STAGES + 1];   /* the entry asked for; the one whose words are there; those of the clocks before */
    uint32_t here[LIST_STAGES + 1]; /* 1: there is one; [0] not used */
    uint32_t label;                 /* what a stage hands to the next: an arc; */
    uint32_t parent;                /* a parent, and its own parent; */
    uint32_t grandparent;
    uint32_t follows[2]; /* 1: the parent is the entry before; */
    uint32_t root[3];
    uint32_t component[2]; /* the arc's component, and that one's root; */
    uint32_t strong[3];
    uint32_t count[6];
    uint32_t is_root;
    uint32_t key[2];
    uint32_t next[2];
    uint32_t has_next; /* 1: the point's arc is in the table; */
    uint32_t kept;     /* 1: it is in a strong component */
    uint64_t point[2];
    uint32_t arcs; /* entries of the arc table */
    uint32_t arcs_full;
    uint32_t first; /* points in arcs so far */
    uint32_t last;  /* where the next point without arc goes */
    uint32_t left;  /* points in strong components */
} drogue_hls_lists;

/* All registers of the block. A phase is a bit: to know it is one register, not a compare before every other one. */
enum {
    PHASE_IDLE = 0,
    PHASE_ROWS = 1,    /* a tick a clock */
    PHASE_SETTLE = 2,  /* the merges of a row, where there are any */
    PHASE_SQUARES = 4, /* a bit a clock */
    PHASE_NINE = 8,    /* times one of them */
    PHASE_BEGIN = 16,
    PHASE_COMPONENTS = 32, /* the roots of components, which of them are strong */
    PHASE_ARCS = 64,       /* the roots of arcs, 0 in a weak component, and their points */
    PHASE_PLACE = 128,     /* the arc table */
    PHASE_SORT = 256,      /* the edge list */
    PHASE_BITS = 9
};
typedef struct drogue_hls_registers {
    uint32_t phase;
    uint32_t status;
    uint32_t refused[7]; /* 1: a register of the frame is not one that DROGUE_E_ARGUMENT, _REGION, _WORKSPACE allow */
    uint32_t row;        /* of ticks */
    uint32_t last_row;
    uint32_t column; /* tick of the row */
    uint32_t ends;   /* 1: its last */
    drogue_hls_frame frame;
    int32_t ring_dx;    /* 2x - centre2_x of the first column that a row of ticks tests */
    int32_t ring_dy;    /* 2y - centre2_y of row -LAG_ROWS */
    int32_t row_step;   /* what the square of the next row of labels is more */
    uint32_t bit;       /* of the three squares at work */
    uint32_t side[3];   /* ring_dx, ring_dy, the ring's longest side: their size, the bit at work on top */
    uint32_t factor[3]; /* the size */
    uint64_t square[3];
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
    return (uint32_t)((r->phase & PHASE_ROWS) != 0) & r->windows.take;
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

/* No point and no arc; the stages are empty at the end of a frame. */
void drogue_hls_lists_begin(drogue_hls_lists *list);

/* Append a point when it has an arc; count it there in the clocks after, which are any up to those of PHASE_COMPONENTS. */
uint32_t drogue_hls_append(drogue_hls_lists *list, uint64_t point, const drogue_hls_near *arc,
                           drogue_hls_writes *write);
void drogue_hls_count(drogue_hls_lists *list, uint32_t arc, uint32_t listed, uint32_t anew,
                      const drogue_hls_words *read, drogue_hls_places *places, drogue_hls_writes *write);

/* A clock of a phase from PHASE_COMPONENTS on; 1 when the phase is complete. */
uint32_t drogue_hls_lists_step(drogue_hls_lists *list, uint32_t phase, uint32_t min_arc_px,
                               const drogue_hls_words *read, drogue_hls_places *places, drogue_hls_writes *write);

#endif
