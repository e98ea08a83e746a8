/* SPDX-License-Identifier: Apache-2.0 */
/* One clock of the front end: which phase it is, and what the next one reads. */
#include "stages.h"

enum { SQUARE_BITS = 21 };

/* What the library's drogue_frontend_begin() says of the arguments: each part in a clock, and what follows from them in the
 * next. */
static void check(uint32_t refused[7], const drogue_hls_asked *a)
{
    const drogue_mask x = {a->centre2_x, 0, 1};
    const drogue_mask y = {0, a->centre2_y, 1};
    const drogue_mask longest = {0, 0, a->longest_px};
    refused[0] = (uint32_t)(a->canny_low < 0 || a->canny_high < a->canny_low);
    refused[1] = (uint32_t)(a->use_ring && !drogue_mask_valid(&x));
    refused[2] = (uint32_t)(a->use_ring && !drogue_mask_valid(&y));
    refused[3] = (uint32_t)(a->use_ring && !drogue_mask_valid(&longest));
    refused[4] = (uint32_t)(a->width_px < 1 || a->width_px > DROGUE_MAX_SIDE);
    refused[5] = (uint32_t)(a->height_px < 1 || a->height_px > DROGUE_MAX_SIDE);
    refused[6] = (uint32_t)(a->width_px > DROGUE_HLS_WIDTH || a->height_px > DROGUE_HLS_HEIGHT);
}

static drogue_status checked(const uint32_t refused[7])
{
    return refused[0] | refused[1] | refused[2] | refused[3] ? DROGUE_E_ARGUMENT
           : refused[4] | refused[5]                         ? DROGUE_E_REGION
           : refused[6]                                      ? DROGUE_E_WORKSPACE
                                                             : DROGUE_OK;
}

static uint16_t threshold(int32_t magnitude)
{
    return (uint16_t)(magnitude < DROGUE_L1_MAX ? magnitude : DROGUE_L1_MAX);
}

/* A centre of a mask that is valid takes 18 bits. */
static int32_t narrow(int32_t centre2) { return (int32_t)((uint32_t)centre2 << 14) >> 14; }

static void start(drogue_hls_registers *r, const drogue_hls_asked *a)
{
    check(r->refused, a);
    r->phase = PHASE_SQUARES;
    r->frame.width_px = a->width_px & 0xFFF;
    r->frame.height_px = a->height_px & 0xFFF;
    r->frame.smooth = a->smooth != 0;
    r->frame.low = threshold(a->canny_low) & 0x7FF;
    r->frame.high = threshold(a->canny_high) & 0x7FF;
    r->frame.use_ring = a->use_ring != 0;
    r->ring_dx = -narrow(a->centre2_x); /* of the column that comes to AT_LABEL - 1 in the third tick */
    r->ring_dy = 2 * -LAG_ROWS - narrow(a->centre2_y);
    r->bit = SQUARE_BITS + 1;
}

static uint32_t size_of(int32_t v) { return (uint32_t)(v < 0 ? -v : v) & 0x3FFFFu; }

/* Before the squares: what the registers of a frame give by themselves. */
static void begin_frame(drogue_hls_registers *r, int32_t longest_px)
{
    const int32_t last_x = r->frame.width_px + (IDLE_PX - 1);
    int k;
    r->status = (uint32_t)checked(r->refused);
    r->lists.left = 0; /* all there will be of a frame refused */
    r->lists.arcs = 0;
    r->frame.last_x = (last_x > LEAST_PERIOD - 1 ? last_x : LEAST_PERIOD - 1) & 0xFFF;
    r->frame.turn_x = 2 * r->frame.width_px - 2;
    r->frame.turn_y = 2 * r->frame.height_px - 2;
    r->last_row = drogue_hls_narrow((uint32_t)r->frame.height_px + LAG_ROWS - 1u, ROW_BITS);
    r->factor[0] = size_of(r->ring_dx);
    r->factor[1] = size_of(r->ring_dy);
    r->factor[2] = (uint32_t)longest_px & 0x1FFFFFu;
    for (k = 0; k < 3; k++) {
        r->side[k] = r->factor[k];
        r->square[k] = 0;
    }
}

/* The squares from their highest bit on; the end for what start() refused. */
static void square(drogue_hls_registers *r, int32_t longest_px)
{
    int k;
    for (k = 0; k < 3; k++) {
        const uint32_t bit = r->side[k] >> (SQUARE_BITS - 1) & 1u;
        r->square[k] = (uint64_t)drogue_hls_narrow_s64(
            (int64_t)((r->square[k] << 1) + (r->factor[k] & drogue_hls_when((int)bit))), RING_BITS);
        r->side[k] = drogue_hls_narrow(r->side[k] << 1, SQUARE_BITS);
    }
    r->bit = (r->bit - 1u) & 31u;
    r->phase = r->bit == 0 ? PHASE_NINE : PHASE_SQUARES;
    if (r->bit == SQUARE_BITS) {
        begin_frame(r, longest_px);
    } else if (r->status != (uint32_t)DROGUE_OK) {
        r->phase = PHASE_IDLE;
    }
}

/* A row of ticks comes next: the ring in its row of labels. */
static void begin_row(drogue_hls_registers *r)
{
    const int64_t side2 = (int64_t)r->square[2];
    const int64_t dy2 = (int64_t)r->square[1];
    r->frame.ring_least_x9 = drogue_hls_narrow_s64(4 * side2 - r->ring_dy2_x9, RING_BITS);
    r->frame.ring_most = drogue_hls_narrow_s64(side2 - dy2, RING_BITS);
    r->windows.ring_step = 4 * r->ring_dx + 4;
    r->windows.ring_square = (int64_t)r->square[0];
    r->square[1] = (uint64_t)drogue_hls_narrow_s64(dy2 + r->row_step, RING_BITS); /* (v + 2)^2 */
    r->row_step += 8;
    r->column = 0;
    r->ends = 0;
}

static void begin_list(drogue_hls_lists *l, uint32_t first, uint32_t entries)
{
    int k;
    l->entries = entries;
    l->at[0] = first;
    for (k = 1; k <= LIST_STAGES; k++) {
        l->here[k] = 0;
    }
}

static void take_nine(drogue_hls_registers *r)
{
    r->ring_dy2_x9 = drogue_hls_narrow_s64(9 * (int64_t)r->square[1], RING_BITS);
}

/* A row is complete, its merges settled. */
static void end_row(drogue_hls_registers *r)
{
    const int last = r->row == r->last_row;
    r->phase = last ? PHASE_COMPONENTS : PHASE_ROWS;
    r->row = drogue_hls_narrow(r->row + 1u, ROW_BITS);
    r->labels.component.merges = 0;
    r->labels.arc.merges = 0;
}

static void tick(drogue_hls_registers *r, uint32_t pixel, const drogue_hls_words *read, drogue_hls_places *places,
                 drogue_hls_writes *write)
{
    drogue_hls_windows *w = &r->windows;
    const uint32_t ends = r->ends;
    const uint32_t component_merges = r->labels.component.merges;
    const uint32_t arc_merges = r->labels.arc.merges;
    const uint32_t components = r->labels.component.count;
    const uint32_t listed = drogue_hls_append(&r->lists, w->point[AT_LIST], &r->labels.arc, write);
    drogue_hls_count(&r->lists, r->labels.arc.label, listed, r->labels.arc.given, read, places, write);
    drogue_hls_labels_tick(&r->labels, w, read, places, write);
    drogue_hls_pixels_tick(w, &r->frame, read, write);
    w->pixel = (uint8_t)pixel;
    take_nine(r);
    r->ends = (uint32_t)(r->column + 1u == (uint32_t)r->frame.last_x);
    r->column = drogue_hls_narrow(r->column + 1u, COLUMN_BITS);
    r->components.at = 0; /* the first merge's word is there in the last tick of a row */
    r->arcs.at = 0;
    if (ends) { /* all merges are noted, all labels given: nothing is right of a region's last column */
        drogue_hls_settle_begin(&r->components, component_merges, (uint32_t)read->component_merges);
        drogue_hls_settle_begin(&r->arcs, arc_merges, (uint32_t)read->arc_merges);
        begin_list(&r->lists, 1, components);
        begin_row(r);
        r->phase = PHASE_SETTLE;
    }
}

/* What comes next follows from registers alone. */
static void settle(drogue_hls_registers *r, const drogue_hls_words *read, drogue_hls_places *places,
                   drogue_hls_writes *write)
{
    const uint32_t done = r->components.done & r->arcs.done;
    const drogue_hls_settled component =
        drogue_hls_settle(&r->components, r->labels.component.merges, (uint32_t)read->component_merges,
                          (uint32_t)read->component_parent, (uint32_t)read->component_parent_2);
    const drogue_hls_settled arc = drogue_hls_settle(&r->arcs, r->labels.arc.merges, (uint32_t)read->arc_merges,
                                                     (uint32_t)read->arc_parent, (uint32_t)read->arc_parent_2);
    drogue_hls_count(&r->lists, 0, 0, 0, read, places, write);
    write->component_parent = component.parent;
    write->component_merges = component.merge;
    write->arc_parent = arc.parent;
    write->arc_merges = arc.merge;
    places->component_parent = component.place;
    places->component_parent_2 = component.place_2;
    places->arc_parent = arc.place;
    places->arc_parent_2 = arc.place_2;
    if (done) {
        end_row(r);
    }
}

static uint32_t status_of(const drogue_hls_labels *labels, const drogue_hls_lists *lists)
{
    const uint32_t which = (labels->component.full ? DROGUE_HLS_COMPONENTS_FULL : 0u) |
                           (labels->arc.full ? DROGUE_HLS_ARC_LABELS_FULL : 0u) |
                           (lists->points_full ? DROGUE_HLS_EDGES_FULL : 0u) |
                           (lists->arcs_full ? DROGUE_HLS_ARCS_FULL : 0u);
    const drogue_status status = labels->component.full || labels->arc.full ? DROGUE_E_LABELS_FULL
                                 : lists->points_full                       ? DROGUE_E_EDGES_FULL
                                 : lists->arcs_full                         ? DROGUE_E_ARCS_FULL
                                                                            : DROGUE_OK;
    return which | (uint32_t)status;
}

static void list(drogue_hls_registers *r, const drogue_hls_asked *asked, const drogue_hls_words *read,
                 drogue_hls_places *places, drogue_hls_writes *write)
{
    if (drogue_hls_lists_step(&r->lists, r->phase, asked->min_arc_px, read, places, write)) {
        const uint32_t first = (uint32_t)((r->phase & PHASE_COMPONENTS) != 0); /* label 0 is none, place 0 is written */
        begin_list(&r->lists, first, r->phase & PHASE_PLACE ? r->lists.points : r->labels.arc.count);
        r->phase = r->phase & PHASE_SORT ? PHASE_IDLE : r->phase << 1;
        r->status = status_of(&r->labels, &r->lists);
    }
}

/* Words that registers name, whatever the phase: what the next tick needs. A place hangs on the phase at work, not on the one
 * that comes next, which would be a long path to every memory. */
static void ask(drogue_hls_places *p, const drogue_hls_registers *r)
{
    const drogue_hls_windows *w = &r->windows;
    p->raw_rows = w->x[AT_ROWS];
    p->smooth_rows = w->x[AT_LEVELS];
    p->gradient_row = w->x[AT_MAGNITUDES];
    p->magnitude_rows = w->x[AT_MAGNITUDES];
    p->component_row = w->x[AT_LABEL - 4];
    p->arc_row = w->x[AT_LABEL + 1 - 4];
    p->component_merges = r->components.at;
    p->arc_merges = r->arcs.at;
    p->arc_component = r->lists.at[1];
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
    if (phase & PHASE_ROWS) {
        tick(r, asked->pixel, read, places, write);
    } else if (phase & PHASE_SETTLE) {
        settle(r, read, places, write);
    } else if (phase & PHASE_BEGIN) {
        r->row = 0;
        r->phase = PHASE_ROWS;
        drogue_hls_lists_begin(&r->lists);
        drogue_hls_pixels_begin(&r->windows);
        drogue_hls_labels_begin(&r->labels);
        begin_row(r);
    } else if (phase & (PHASE_COMPONENTS | PHASE_ARCS | PHASE_PLACE | PHASE_SORT)) {
        list(r, asked, read, places, write);
    } else if (phase & PHASE_SQUARES) {
        square(r, asked->longest_px);
    } else if (phase & PHASE_NINE) {
        take_nine(r);
        r->row_step = 4 * r->ring_dy + 4;
        r->phase = PHASE_BEGIN;
    } else if (asked->start) {
        start(r, asked);
    }
    ask(places, r);
}
