/* SPDX-License-Identifier: Apache-2.0 */
/* The front end's register bank as ../system/bank.v has it: byte offsets, words of 32 bits. What is written reads as 0. */
#ifndef DROGUE_BLOCK_REGISTERS_H
#define DROGUE_BLOCK_REGISTERS_H

enum {
    DROGUE_BANK_IDENTITY = 0x00,  /* read: DROGUE_BANK_IS */
    DROGUE_BANK_WIDTH = 0x04,     /* read: longest side of a region, px */
    DROGUE_BANK_EDGES = 0x08,     /* read: words that the edge list holds */
    DROGUE_BANK_ARCS = 0x0C,      /* read: words that the arc table holds */
    DROGUE_BANK_CONTROL = 0x10,   /* write: START, or RESET, which ends whatever is under way */
    DROGUE_BANK_STATE = 0x14,     /* read: BUSY, DONE (from the end of a frame until the next START) */
    DROGUE_BANK_INTERRUPT = 0x18, /* write, at any time: 1: the interrupt's line is high while DONE; 0: it is low */
    DROGUE_BANK_LABELS = 0x1C,    /* read: labels that it can give, of components and of arcs */
    /* of the frame; write, not while BUSY */
    DROGUE_BANK_WIDTH_PX = 0x20,
    DROGUE_BANK_HEIGHT_PX = 0x24,
    DROGUE_BANK_CANNY_LOW = 0x28,
    DROGUE_BANK_CANNY_HIGH = 0x2C,
    DROGUE_BANK_SMOOTH = 0x30,
    DROGUE_BANK_MIN_ARC_PX = 0x34,
    DROGUE_BANK_USE_RING = 0x38,
    DROGUE_BANK_CENTRE2_X = 0x3C,
    DROGUE_BANK_CENTRE2_Y = 0x40,
    DROGUE_BANK_LONGEST_PX = 0x44,
    DROGUE_BANK_SOURCE = 0x48, /* byte of the frame memory that is the region's first pixel */
    DROGUE_BANK_STRIDE = 0x4C, /* bytes from row to row */
    /* of the last frame; read */
    DROGUE_BANK_STATUS = 0x50, /* drogue_status and DROGUE_HLS_*_FULL of ../drogue_hls.h */
    DROGUE_BANK_EDGE_COUNT = 0x54,
    DROGUE_BANK_ARC_COUNT = 0x58,
    DROGUE_BANK_EDGE_LIST = 0x10000, /* words of drogue_hls_pack_edge(), the lower half first */
    DROGUE_BANK_ARC_LIST = 0x20000   /* words of drogue_hls_pack_arc() */
};

#define DROGUE_BANK_IS UINT32_C(0x44524731)   /* "DRG1" */
#define DROGUE_BANK_LIST_WORDS UINT32_C(8192) /* that the map has room for, each list: regions up to 718 px */
#define DROGUE_BANK_START UINT32_C(1)
#define DROGUE_BANK_RESET UINT32_C(2)
#define DROGUE_BANK_BUSY UINT32_C(1)
#define DROGUE_BANK_DONE UINT32_C(2)

#endif
