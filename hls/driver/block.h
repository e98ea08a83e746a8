/* SPDX-License-Identifier: Apache-2.0 */
/* Driver of the front end's block, without an operating system: start a frame, poll or be interrupted, read the lists.
 *
 * block_frontend.c puts the block in the place of the library's front end: linked before the library, its
 * drogue_frontend_begin(), _row() and _end() are what drogue_measure() and drogue_track_frame() call, second looks
 * included.
 *
 * The registers must not be cached. Block and camera reach the frame memory behind the cache: it is not cached, or what
 * the processor wrote is written back before the start and its lines are invalidated when the camera has written. A
 * processor that reorders or delays writes needs a barrier before START: drogue_bank_write() is the place for it. */
#ifndef DROGUE_BLOCK_H
#define DROGUE_BLOCK_H

#include "drogue/frontend.h"

/* What became of a frame. */
typedef enum drogue_block_status {
    DROGUE_BLOCK_OK = 0,
    DROGUE_BLOCK_ABSENT, /* no front end at that address, or one of another kind */
    DROGUE_BLOCK_SMALL,  /* its tables are smaller than the workspace's: it could not do what the library does */
    DROGUE_BLOCK_LARGE,  /* one is larger: it would not fill where the library's does */
    DROGUE_BLOCK_BUSY,   /* the frame before is still under way: nothing was started, or read */
    DROGUE_BLOCK_EARLY,  /* no frame has ended since the last start: nothing was read */
    DROGUE_BLOCK_STUCK,  /* the frame did not end in time; the block was reset */
    DROGUE_BLOCK_LENGTH, /* a list longer than its table, or than the workspace's; block_frontend.c: rows outside the
                            frame memory or not one stride apart */
    DROGUE_BLOCK_LIST,   /* arcs that do not lie one after the other among the points, or a status that is none */
    DROGUE_BLOCK_STATUSES
} drogue_block_status;

/* Name of a status in lower case, such as "stuck"; never NULL. */
const char *drogue_block_status_name(drogue_block_status status);

/* A register bank; what it is, is for the two functions below to know. In bank.c: an address. */
typedef struct drogue_bank_of_registers {
    volatile uint32_t *base;
    const uint8_t *frame; /* the frame memory as the processor sees it */
    uint32_t frame_bytes;
    uint32_t most_polls; /* reads of the state before a frame counts as stuck; how long that is, is the bus's */
} drogue_bank_of_registers;

/* A word of the bank at a byte offset. */
uint32_t drogue_bank_read(const drogue_bank_of_registers *bank, uint32_t offset);
void drogue_bank_write(const drogue_bank_of_registers *bank, uint32_t offset, uint32_t word);

/* What the block is asked for. */
typedef struct drogue_block_frame {
    drogue_frontend_config config;
    int32_t width_px;
    int32_t height_px;
    uint32_t source; /* byte of the frame memory that is the first pixel */
    uint32_t stride;
} drogue_block_frame;

/* Is there a block, and does it hold what the workspace holds?  OK, ABSENT, SMALL, LARGE.
 *
 * It may take wider regions. Its tables of edge points, arcs and labels have as many entries as the workspace's and not
 * one more: where a table fills, the library tries other thresholds and the result says so; a larger one fills later or
 * not at all, and the bits would be others. So the workspace has DROGUE_CAPACITY_FOR(WIDTH) for a block of rtl.sh WIDTH;
 * who wants a smaller workspace makes a smaller block. */
drogue_block_status drogue_block_examine(const drogue_bank_of_registers *bank, const drogue_capacity *capacity);

/* Start a frame and return at once.  interrupt  1: the block's line goes high at the end of this frame, until
 * drogue_block_acknowledge() or the next start.  OK, BUSY. */
drogue_block_status drogue_block_start(const drogue_bank_of_registers *bank, const drogue_block_frame *frame,
                                       int interrupt);

/* In the interrupt's handler: the line goes low. The frame stays ended, its lists can be read. */
void drogue_block_acknowledge(const drogue_bank_of_registers *bank);

/* Has the frame ended?  OK, BUSY, EARLY (none was started). */
drogue_block_status drogue_block_poll(const drogue_bank_of_registers *bank);

/* Poll until the frame has ended, most_polls times.  OK, EARLY, STUCK. */
drogue_block_status drogue_block_wait(const drogue_bank_of_registers *bank);

/* The lists of the frame that has ended into the workspace, as drogue_frontend_end() leaves them there.
 *
 *  list    out; empty unless OK is returned
 *  status  out: what drogue_frontend_begin() or _end() would have returned; a full table is told here, and what did fit is in the
 *          list
 *  return  OK, BUSY, EARLY, LENGTH, LIST
 */
drogue_block_status drogue_block_read(drogue_edge_list *list, drogue_status *status, drogue_workspace *workspace,
                                      const drogue_bank_of_registers *bank);

/* --- block_frontend.c --- */

/* The bank that the front end uses from now on; it must live as long. */
void drogue_block_use(const drogue_bank_of_registers *bank);

/* What became of the last frame. Where it is not OK, drogue_frontend_end() gave DROGUE_E_ARGUMENT and empty lists. */
drogue_block_status drogue_block_last(void);

#endif
