/* SPDX-License-Identifier: Apache-2.0 */
/* One clock of the front end: which phase it is, and what the next one reads. */
#include "stages.h"

enum { SQUARE_BITS = 21 };

/* What the library's drogue_frontend_begin() says of the arguments. */
static drogue_status check(const drogue_hls_asked *a)
{
    const drogue_mask ring = {a->centre2_x, a->centre2_y, a->longest_px};
    if (a->canny_low < 0 || a->canny_high < a->canny_low || (a->use_ring && !drogue_mask_valid(&ring))) {
        return DROGUE_E_ARGUMENT;
    }
    if (a->width_px < 1 || a->width_px > DROGUE_MAX_SIDE || a->height_px < 1 || a->height_px > DROGUE_MAX_SIDE) {
        return DROGUE_E_REGION;
    }
    return a->width_px > DROGUE_HLS_WIDTH || a->height_px > DROGUE_HLS_HEIGHT ? DROGUE_E_WORKSPACE : DROGUE_OK;
}

static uint16_t threshold(int32_t magnitude) { return (uint16_t)(magnitude < 2040 ? magnitude : 2040); }

/* A centre of a mask that is valid takes 18 bits. */
static int32_t narrow(int32_t centre2) { return (int32_t)((uint32_t)centre2 << 14) >> 14; }

static void start(drogue_hls_registers *r, const drogue_hls_asked *a)
{
    static const drogue_hls_lists empty;
    const int32_t period = a->width_px + IDLE_PX;
    r->status = (uint32_t)check(a);
    r->phase = PHASE_SQUARES;
    r->frame.width_px = a->width_px & 0xFFF;
    r->frame.height_px = a->height_px & 0xFFF;
    r->frame.period = (period > LEAST_PERIOD ? period : LEAST_PERIOD) & 0xFFF;
    r->frame.smooth = a->smooth != 0;
    r->frame.low = threshold(a->canny_low) & 0x7FF;
    r->frame.high = threshold(a->canny_high) & 0x7FF;
    r->frame.use_ring = a->use_ring != 0;
    r->ring_dx = 2 * -1 - narrow(a->centre2_x); /* from the column that comes to AT_LABEL in the third tick */
    r->ring_dy = 2 * -LAG_ROWS - narrow(a->centre2_y);
    r->bit = SQUARE_BITS;
    r->square[0] = 0;
    r->square[1] = 0;
    r->square[2] = 0;
    r->lists = empty;
    drogue_hls_pixels_begin(&r->windows);
    drogue_hls_labels_begin(&r->labels);
}

static uint64_t next_bit(uint64_t square, uint32_t v, uint32_t bit)
{
    return (uint64_t)drogue_hls_narrow_s64((int64_t)((square << 1) + (v & drogue_hls_when((int)(v >> bit & 1u)))),
                                           RING_BITS);
}

static uint32_t size_of(int32_t v) { return (uint32_t)(v < 0 ? -v : v) & 0x3FFFFu; }

/* The squares from their highest bit on; the end for what start() refused. */
static void square(drogue_hls_registers *r, int32_t longest_px)
{
    r->bit = (r->bit - 1u) & 31u;
    r->square[0] = next_bit(r->square[0], size_of(r->ring_dx), r->bit);
    r->square[1] = next_bit(r->square[1], size_of(r->ring_dy), r->bit);
    r->square[2] = next_bit(r->square[2], (uint32_t)longest_px & 0x1FFFFFu, r->bit);
    r->phase = r->status != (uint32_t)DROGUE_OK ? PHASE_IDLE : r->bit == 0 ? PHASE_NINE : PHASE_SQUARES;
}

/* A row of labels begins: the ring in it. */
static void begin_row(drogue_hls_registers *r)
{
    const int64_t side2 = (int64_t)r->square[2];
    const int64_t dy2 = (int64_t)r->square[1];
    r->frame.ring_least_x9 = drogue_hls_narrow_s64(4 * side2 - r->ring_dy2_x9, RING_BITS);
    r->frame.ring_most = drogue_hls_narrow_s64(side2 - dy2, RING_BITS);
    r->windows.ring_dx = r->ring_dx;
    r->windows.ring_square = (int64_t)r->square[0];
    r->square[1] = (uint64_t)drogue_hls_narrow_s64(dy2 + 4 * (int64_t)r->ring_dy + 4, RING_BITS); /* (v + 2)^2 */
    r->ring_dy += 2;
    r->column = 0;
    r->ends = 0;
    r->labels.component_merges = 0;
    r->labels.arc_merges = 0;
}

static void begin_list(drogue_hls_lists *l, uint32_t first)
{
    l->at[0] = first;
    l->here[1] = 0;
    l->here[2] = 0;
    l->here[3] = 0;
    l->here[4] = 0;
}

static void take_nine(drogue_hls_registers *r)
{
    r->ring_dy2_x9 = drogue_hls_narrow_s64(9 * (int64_t)r->square[1], RING_BITS);
}

/* A row is complete, its merges settled. */
static void end_row(drogue_hls_registers *r)
{
    const int last = r->row == (uint32_t)r->frame.height_px + LAG_ROWS - 1u;
    r->phase = last ? PHASE_COMPONENTS : PHASE_ROWS;
    r->row = last ? 0 : drogue_hls_narrow(r->row + 1u, ROW_BITS);
    begin_list(&r->lists, 1);
    begin_row(r);
}

static void tick(drogue_hls_registers *r, uint32_t pixel, const drogue_hls_words *read, drogue_hls_writes *write)
{
    drogue_hls_windows *w = &r->windows;
    const uint32_t code = w->code[AT_LABEL] & drogue_hls_when((int)w->in_ring); /* no candidate outside the ring */
    /* Of the last tick of a row: no pixel of the region is labelled in it, so that no merge comes after these. */
    const uint32_t component_merges = drogue_hls_row_merges(r->labels.component_merges, r->labels.component_met);
    const uint32_t arc_merges = drogue_hls_row_merges(r->labels.arc_merges, r->labels.arc_met);
    drogue_hls_append(&r->lists, w->point[AT_LIST], &r->labels, read, write);
    drogue_hls_labels_tick(&r->labels, w, read, write, code);
    drogue_hls_pixels_tick(w, &r->frame, read, write);
    w->pixel = (uint8_t)pixel;
    take_nine(r);
    if (r->ends) {
        drogue_hls_settle_begin(&r->components, component_merges);
        drogue_hls_settle_begin(&r->arcs, arc_merges);
        r->phase = PHASE_SETTLE;
    }
    r->column = drogue_hls_narrow(r->column + 1u, COLUMN_BITS);
    r->ends = r->column + 1u == (uint32_t)r->frame.period;
}

/* What comes next follows from registers alone, a clock after the last merge; a table that is done asks for what the next
 * tick needs. */
static void settle(drogue_hls_registers *r, const drogue_hls_words *read, drogue_hls_places *places,
                   drogue_hls_writes *write)
{
    const uint32_t components_done = r->components.done;
    const uint32_t arcs_done = r->arcs.done;
    const drogue_hls_settled component =
        drogue_hls_settle(&r->components, r->labels.component_merges, (uint32_t)read->component_merges,
                          (uint32_t)read->component_parent, (uint32_t)read->component_parent_2);
    const drogue_hls_settled arc = drogue_hls_settle(&r->arcs, r->labels.arc_merges, (uint32_t)read->arc_merges,
                                                     (uint32_t)read->arc_parent, (uint32_t)read->arc_parent_2);
    write->component_parent = component.parent;
    write->component_merges = component.merge;
    write->arc_parent = arc.parent;
    write->arc_merges = arc.merge;
    places->component_parent = components_done ? r->labels.component_next : component.place;
    places->component_parent_2 = component.place_2;
    places->arc_parent = arcs_done ? r->labels.arc_next : arc.place;
    places->arc_parent_2 = arc.place_2;
    places->arc_points = r->labels.arc;
    places->component_merges = drogue_hls_settle_place(&r->components);
    places->arc_merges = drogue_hls_settle_place(&r->arcs);
    if (components_done & arcs_done) {
        end_row(r);
    }
}

static uint32_t status_of(const drogue_hls_labels *labels, const drogue_hls_lists *lists)
{
    const uint32_t which = (labels->components_full ? DROGUE_HLS_COMPONENTS_FULL : 0u) |
                           (labels->arcs_full ? DROGUE_HLS_ARC_LABELS_FULL : 0u) |
                           (lists->points_full ? DROGUE_HLS_EDGES_FULL : 0u) |
                           (lists->arcs_full ? DROGUE_HLS_ARCS_FULL : 0u);
    const drogue_status status = labels->components_full || labels->arcs_full ? DROGUE_E_LABELS_FULL
                                 : lists->points_full                         ? DROGUE_E_EDGES_FULL
                                 : lists->arcs_full                           ? DROGUE_E_ARCS_FULL
                                                                              : DROGUE_OK;
    return which | (uint32_t)status;
}

static void list(drogue_hls_registers *r, const drogue_hls_asked *asked, const drogue_hls_words *read,
                 drogue_hls_places *places, drogue_hls_writes *write)
{
    if (drogue_hls_lists_step(&r->lists, &r->labels, r->phase, asked->min_arc_px, read, places, write)) {
        begin_list(&r->lists, r->phase == PHASE_COMPONENTS);
        r->phase = r->phase == PHASE_SORT ? PHASE_IDLE : r->phase + 1u;
        r->status = status_of(&r->labels, &r->lists);
    }
}

/* Words that registers name, in the phase at work, not in the one that comes next: that would be a long path to every memory.
 * What a phase's first clock reads is asked for in the last of the phase before, or, in the lists, a clock later. */
static void ask(drogue_hls_places *p, const drogue_hls_registers *r, uint32_t phase)
{
    const drogue_hls_windows *w = &r->windows;
    const uint32_t at = r->lists.at[1];
    if (phase == PHASE_IDLE) {
        return;
    }
    p->raw_rows = w->x[AT_PICK_ROWS];
    p->smooth_rows = w->x[AT_LEVELS];
    p->gradient_row = w->x[AT_MAGNITUDES];
    p->magnitude_rows = w->x[AT_MAGNITUDES];
    p->component_row = w->x[AT_LABEL - 3];
    p->arc_row = w->x[AT_LABEL + 1 - 3];
    p->arc_component = at;
    p->arc_key = at;
    p->point_arc = at;
    p->points = at;
    switch (phase) {
    case PHASE_ROWS:
        p->component_parent = r->labels.component_next;
        p->arc_parent = r->labels.arc_next;
        p->arc_points = r->labels.arc;
        break;
    case PHASE_COMPONENTS:
        p->component_parent = at;
        p->component_strong = at;
        break;
    case PHASE_ARCS:
        p->arc_parent = at;
        p->arc_points = at;
        break;
    case PHASE_PLACE:
        p->arc_points = at;
        p->arc_root = at;
        break;
    default: break;
    }
}

void drogue_hls_step(drogue_hls_registers *r, const drogue_hls_asked *asked, const drogue_hls_words *read,
                     drogue_hls_places *places, drogue_hls_writes *write)
{
    static const drogue_hls_places nowhere;
    static const drogue_hls_writes nothing;
    const uint32_t phase = drogue_hls_narrow(r->phase, PHASE_BITS);
    *places = nowhere;
    *write = nothing;
    r->phase = phase;
    switch (phase) {
    case PHASE_IDLE:
        if (asked->start) {
            start(r, asked);
        }
        break;
    case PHASE_SQUARES: square(r, asked->longest_px); break;
    case PHASE_NINE:
        take_nine(r);
        r->phase = PHASE_BEGIN;
        break;
    case PHASE_BEGIN:
        r->row = 0;
        r->phase = PHASE_ROWS;
        begin_row(r);
        break;
    case PHASE_ROWS: tick(r, asked->pixel, read, write); break;
    case PHASE_SETTLE: settle(r, read, places, write); break;
    default: list(r, asked, read, places, write); break;
    }
    ask(places, r, phase);
}
