/* SPDX-License-Identifier: Apache-2.0 */
#include "block.h"

#include "../drogue_hls.h"
#include "registers.h"

const char *drogue_block_status_name(drogue_block_status status)
{
    static const char *const names[DROGUE_BLOCK_STATUSES] = {"ok",    "absent", "small",  "large", "busy",
                                                             "early", "stuck",  "length", "list"};
    return (unsigned)status < DROGUE_BLOCK_STATUSES ? names[status] : "unknown";
}

drogue_block_status drogue_block_examine(const drogue_bank_of_registers *bank, const drogue_capacity *capacity)
{
    uint32_t edges; /* more than the workspace's; "negative": fewer */
    uint32_t arcs;
    uint32_t labels;
    if (drogue_bank_read(bank, DROGUE_BANK_IDENTITY) != DROGUE_BANK_IS) {
        return DROGUE_BLOCK_ABSENT;
    }
    edges = drogue_bank_read(bank, DROGUE_BANK_EDGES) - capacity->edges;
    arcs = drogue_bank_read(bank, DROGUE_BANK_ARCS) - capacity->arcs;
    labels = drogue_bank_read(bank, DROGUE_BANK_LABELS) - capacity->labels;
    if ((edges | arcs | labels) >> 31 || capacity->edges > DROGUE_BANK_LIST_WORDS ||
        drogue_bank_read(bank, DROGUE_BANK_WIDTH) < capacity->width_px) {
        return DROGUE_BLOCK_SMALL;
    }
    return edges | arcs | labels ? DROGUE_BLOCK_LARGE : DROGUE_BLOCK_OK;
}

drogue_block_status drogue_block_start(const drogue_bank_of_registers *bank, const drogue_block_frame *frame,
                                       int interrupt)
{
    const drogue_frontend_config *c = &frame->config;
    if (drogue_bank_read(bank, DROGUE_BANK_STATE) & DROGUE_BANK_BUSY) {
        return DROGUE_BLOCK_BUSY;
    }
    drogue_bank_write(bank, DROGUE_BANK_INTERRUPT, 0); /* DONE is still the frame before's */
    drogue_bank_write(bank, DROGUE_BANK_WIDTH_PX, (uint32_t)frame->width_px);
    drogue_bank_write(bank, DROGUE_BANK_HEIGHT_PX, (uint32_t)frame->height_px);
    drogue_bank_write(bank, DROGUE_BANK_CANNY_LOW, (uint32_t)c->canny_low);
    drogue_bank_write(bank, DROGUE_BANK_CANNY_HIGH, (uint32_t)c->canny_high);
    drogue_bank_write(bank, DROGUE_BANK_SMOOTH, (uint32_t)c->smooth);
    drogue_bank_write(bank, DROGUE_BANK_MIN_ARC_PX, c->min_arc_px);
    drogue_bank_write(bank, DROGUE_BANK_USE_RING, (uint32_t)c->use_ring);
    drogue_bank_write(bank, DROGUE_BANK_CENTRE2_X, (uint32_t)c->ring.centre2_x);
    drogue_bank_write(bank, DROGUE_BANK_CENTRE2_Y, (uint32_t)c->ring.centre2_y);
    drogue_bank_write(bank, DROGUE_BANK_LONGEST_PX, (uint32_t)c->ring.longest_px);
    drogue_bank_write(bank, DROGUE_BANK_SOURCE, frame->source);
    drogue_bank_write(bank, DROGUE_BANK_STRIDE, frame->stride);
    drogue_bank_write(bank, DROGUE_BANK_CONTROL, DROGUE_BANK_START);
    drogue_bank_write(bank, DROGUE_BANK_INTERRUPT, interrupt != 0);
    return DROGUE_BLOCK_OK;
}

void drogue_block_acknowledge(const drogue_bank_of_registers *bank)
{
    drogue_bank_write(bank, DROGUE_BANK_INTERRUPT, 0);
}

drogue_block_status drogue_block_poll(const drogue_bank_of_registers *bank)
{
    const uint32_t state = drogue_bank_read(bank, DROGUE_BANK_STATE);
    return state & DROGUE_BANK_BUSY   ? DROGUE_BLOCK_BUSY
           : state & DROGUE_BANK_DONE ? DROGUE_BLOCK_OK
                                      : DROGUE_BLOCK_EARLY;
}

drogue_block_status drogue_block_wait(const drogue_bank_of_registers *bank)
{
    uint32_t polls;
    for (polls = 0; polls < bank->most_polls; polls++) {
        const drogue_block_status status = drogue_block_poll(bank);
        if (status != DROGUE_BLOCK_BUSY) {
            return status;
        }
    }
    drogue_bank_write(bank, DROGUE_BANK_CONTROL, DROGUE_BANK_RESET);
    return DROGUE_BLOCK_STUCK;
}

static uint64_t read_word(const drogue_bank_of_registers *bank, uint32_t list, uint32_t i)
{
    const uint64_t low = drogue_bank_read(bank, list + 8u * i);
    return low | (uint64_t)drogue_bank_read(bank, list + 8u * i + 4u) << 32;
}

/* Arcs lie one after the other from the first point on. */
static drogue_block_status read_lists(drogue_workspace *workspace, const drogue_edge_list *list,
                                      const drogue_bank_of_registers *bank)
{
    uint32_t next = 0;
    uint32_t i;
    for (i = 0; i < list->edge_count; i++) {
        workspace->edges[i] = drogue_hls_unpack_edge(read_word(bank, DROGUE_BANK_EDGE_LIST, i));
    }
    for (i = 0; i < list->arc_count; i++) {
        const drogue_arc arc = drogue_hls_unpack_arc(read_word(bank, DROGUE_BANK_ARC_LIST, i));
        const uint32_t end = arc.first + arc.count;
        if (arc.first != next || arc.count < 1 || end > list->edge_count) {
            return DROGUE_BLOCK_LIST;
        }
        workspace->arcs[i] = arc;
        for (; next < end; next++) {
            workspace->edges[next].arc = i;
        }
    }
    return DROGUE_BLOCK_OK;
}

drogue_block_status drogue_block_read(drogue_edge_list *list, drogue_status *status, drogue_workspace *workspace,
                                      const drogue_bank_of_registers *bank)
{
    const drogue_block_status ended = drogue_block_poll(bank);
    drogue_block_status found;
    uint32_t said;
    list->edge_count = 0;
    list->arc_count = 0;
    *status = DROGUE_E_ARGUMENT;
    if (ended != DROGUE_BLOCK_OK) {
        return ended;
    }
    said = drogue_bank_read(bank, DROGUE_BANK_STATUS) & DROGUE_HLS_STATUS;
    list->edge_count = drogue_bank_read(bank, DROGUE_BANK_EDGE_COUNT);
    list->arc_count = drogue_bank_read(bank, DROGUE_BANK_ARC_COUNT);
    if (said >= DROGUE_STATUS_COUNT) {
        found = DROGUE_BLOCK_LIST;
    } else if (list->edge_count > drogue_bank_read(bank, DROGUE_BANK_EDGES) ||
               list->edge_count > workspace->capacity.edges ||
               list->arc_count > drogue_bank_read(bank, DROGUE_BANK_ARCS) ||
               list->arc_count > workspace->capacity.arcs) {
        found = DROGUE_BLOCK_LENGTH;
    } else {
        found = read_lists(workspace, list, bank);
    }
    if (found != DROGUE_BLOCK_OK) {
        list->edge_count = 0;
        list->arc_count = 0;
        return found;
    }
    *status = (drogue_status)said;
    return DROGUE_BLOCK_OK;
}
