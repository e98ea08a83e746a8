/* SPDX-License-Identifier: Apache-2.0 */
/* Layout of a workspace: for every capacity each table has its room, one after the other, within the bytes asked for;
 * and clipping. */
#include "frontend/workspace.c"

#include "drogue/cluster.h"
#include "drogue/constraints.h"
#include "drogue/inner.h"
#include "drogue/outline.h"
#include "drogue/rays.h"
#include "proof.h"

static uint8_t memory[8] __attribute__((aligned(8)));

static size_t place(const void *at) { return (size_t)((const uint8_t *)at - memory); }

/* 'count' elements at a place, aligned for them, from where the last ended. */
static size_t after(size_t from, const void *at, size_t count, size_t size, size_t alignment)
{
    PROVE(place(at) == from);
    PROVE(place(at) % alignment == 0);
    return from + count * size;
}

void layout(void)
{
    drogue_capacity capacity;
    drogue_workspace w;
    size_t at = 0;
    size_t half;
    size_t rows;
    capacity.width_px = nondet_u32();
    capacity.edges = nondet_u32();
    capacity.labels = nondet_u32();
    capacity.arcs = nondet_u32();
    ASSUME(drogue_workspace_init(&w, memory, SIZE_MAX, &capacity) == DROGUE_OK);
    half = DROGUE_HALF(capacity.width_px);
    at = after(at, w.edges, capacity.edges, sizeof(drogue_edge), 4);
    at = after(at, w.arcs, capacity.arcs, sizeof(drogue_arc), 4);
    at = after(at, w.component_parent, capacity.labels, 4, 4);
    at = after(at, w.component_strong, capacity.labels, 4, 4);
    at = after(at, w.arc_parent, capacity.labels, 4, 4);
    at = after(at, w.arc_component, capacity.labels, 4, 4);
    at = after(at, w.histogram, 256, 4, 4);
    PROVE(place(w.best) == at || place(w.best) == at + 4);
    PROVE(((uintptr_t)w.best & 4u) == 0); /* the memory may lie at a multiple of 4 alone */
    at += DROGUE_BEST_BYTES;
    rows = at;
    at = after(at, w.merges, capacity.width_px, sizeof(drogue_merge), 4);
    at = after(at, w.component_rows, 2 * (size_t)capacity.width_px, 4, 4);
    at = after(at, w.arc_rows, 2 * (size_t)capacity.width_px, 4, 4);
    at = after(at, w.raw_rows, 5 * (2 * half + 4), 1, 4);
    at = after(at, w.smooth_rows, 3 * 4 * (half + 2), 1, 4);
    at = after(at, w.magnitude_rows, 4 * 2 * (half + 2), 2, 4);
    at = after(at, w.slope_rows, 4 * half, sizeof(drogue_slope), 4);
    at = after(at, w.code_rows, 4 * half, 1, 1);
    PROVE(place(w.hull) == rows && place(w.rays) == rows);
    PROVE(place(w.outline) == rows || place(w.outline) == rows + 4);
    PROVE(((uintptr_t)w.outline & 4u) == 0);
}

/* The rows, what lies before them and what takes their place later fit into the bytes asked for. */
void room(void)
{
    const uint32_t width = any_unsigned(12);
    const size_t half = DROGUE_HALF(width);
    const size_t bytes = DROGUE_WORKSPACE_BYTES(width, 0, 0, 0) - 256 * sizeof(uint32_t) - DROGUE_BEST_BYTES;
    ASSUME(width >= 1 && width <= DROGUE_MAX_SIDE);
    PROVE(width * sizeof(drogue_merge) + 4 * width * sizeof(uint32_t) + 5 * (2 * half + 4) + 7 * 4 * (half + 2) +
              4 * half * sizeof(drogue_slope) + 4 * half <=
          bytes);
    PROVE(DROGUE_HULL_MAX * sizeof(drogue_point) <= bytes);
    PROVE(sizeof(drogue_outline_room) + 4 <= bytes);
    PROVE(DROGUE_RAYS * sizeof(drogue_ray) <= bytes);
}

/* A workspace is refused rather than laid out past its memory, and no size wraps where size_t has 32 bits. */
void refusal(void)
{
    drogue_capacity capacity;
    drogue_workspace w;
    const size_t bytes = (size_t)nondet_u64();
    drogue_status status;
    uint64_t need;
    capacity.width_px = nondet_u32();
    capacity.edges = nondet_u32();
    capacity.labels = nondet_u32();
    capacity.arcs = nondet_u32();
    status = drogue_workspace_init(&w, memory, bytes, &capacity);
    PROVE(status == DROGUE_OK || status == DROGUE_E_ARGUMENT || status == DROGUE_E_WORKSPACE);
    ASSUME(status != DROGUE_E_ARGUMENT);
    need = (uint64_t)capacity.edges * sizeof(drogue_edge) + (uint64_t)capacity.arcs * sizeof(drogue_arc) +
           (uint64_t)capacity.labels * 16;
    PROVE(drogue_workspace_bytes(&capacity) > need);
    PROVE((status == DROGUE_OK) == (bytes >= drogue_workspace_bytes(&capacity)));
}

void clipping(void)
{
    const int32_t from = nondet_s32();
    const int32_t n = nondet_s32();
    const int32_t limit = nondet_s32();
    const int32_t pixel = nondet_s32(); /* any one */
    int32_t at = from;
    int32_t length = n;
    drogue_clip(&at, &length, limit);
    PROVE(at >= 0 && length >= 0);
    PROVE(limit < 0 || (int64_t)at + length <= limit);
    PROVE((pixel >= at && (int64_t)pixel < (int64_t)at + length) ==
          (pixel >= from && (int64_t)pixel < (int64_t)from + n && pixel >= 0 && pixel < limit));
}
