/* SPDX-License-Identifier: Apache-2.0 */
/* The block in the place of the library's front end. Rows are not copied: they must lie in the frame memory, one stride apart,
 * and the block reads them there. */
#include "block.h"

static const drogue_bank_of_registers *the_bank;
static drogue_block_status the_last;

/* Of the frame under way: one at a time, as there is one block. */
static struct {
    drogue_block_frame frame;
    const uint8_t *first;
    const uint8_t *last;
    int rows_misplaced;
} at_work;

void drogue_block_use(const drogue_bank_of_registers *bank)
{
    the_bank = bank;
    the_last = DROGUE_BLOCK_OK;
}

drogue_block_status drogue_block_last(void) { return the_last; }

drogue_status drogue_frontend_begin(drogue_frontend *frontend, drogue_workspace *workspace,
                                    const drogue_frontend_config *config, int32_t width_px, int32_t height_px)
{
    const drogue_status status = drogue_frontend_check(workspace, config, width_px, height_px);
    frontend->rows_in = 0;
    frontend->height_px = -1;
    if (status != DROGUE_OK) {
        return status;
    }
    the_last = the_bank == NULL ? DROGUE_BLOCK_ABSENT : drogue_block_examine(the_bank, &workspace->capacity);
    frontend->workspace = workspace;
    frontend->height_px = height_px;
    at_work.frame.config = *config;
    at_work.frame.width_px = width_px;
    at_work.frame.height_px = height_px;
    at_work.frame.stride = (uint32_t)width_px;
    at_work.rows_misplaced = 0;
    return DROGUE_OK;
}

void drogue_frontend_row(drogue_frontend *frontend, const uint8_t *row)
{
    const int32_t y = frontend->rows_in;
    if (y >= frontend->height_px) {
        frontend->rows_in = frontend->height_px + 1; /* not a frame any more */
        return;
    }
    frontend->rows_in++;
    if (y == 0) {
        at_work.first = row;
    } else if (y == 1) {
        at_work.frame.stride = (uint32_t)(row - at_work.first);
    } else if (row != at_work.last + at_work.frame.stride) {
        at_work.rows_misplaced = 1;
    }
    at_work.last = row;
}

/* Do all rows lie in the frame memory? */
static int within(const drogue_bank_of_registers *bank)
{
    const uint8_t *end = bank->frame + bank->frame_bytes;
    return !at_work.rows_misplaced && at_work.first >= bank->frame && at_work.first <= at_work.last &&
           at_work.last < end && end - at_work.last >= at_work.frame.width_px;
}

drogue_status drogue_frontend_end(drogue_edge_list *list, drogue_frontend *frontend)
{
    drogue_status status = DROGUE_E_ARGUMENT;
    list->edge_count = 0;
    list->arc_count = 0;
    if (frontend->rows_in != frontend->height_px || the_last != DROGUE_BLOCK_OK) {
        return DROGUE_E_ARGUMENT;
    }
    frontend->rows_in++; /* a frame ends once */
    if (!within(the_bank)) {
        the_last = DROGUE_BLOCK_LENGTH;
        return DROGUE_E_ARGUMENT;
    }
    at_work.frame.source = (uint32_t)(at_work.first - the_bank->frame);
    the_last = drogue_block_start(the_bank, &at_work.frame, 0);
    if (the_last == DROGUE_BLOCK_OK) {
        the_last = drogue_block_wait(the_bank);
    }
    if (the_last == DROGUE_BLOCK_OK) {
        the_last = drogue_block_read(list, &status, frontend->workspace, the_bank);
    }
    return status;
}
