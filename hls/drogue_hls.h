/* SPDX-License-Identifier: Apache-2.0 */
/* What the synthesisable tops share: largest sizes, packing of the lists, bits of the status register. */
#ifndef DROGUE_HLS_H
#define DROGUE_HLS_H

#include "drogue/frontend.h"

/* Largest sides of a region, px: the width sets the length of the line buffers, nothing grows with the height alone. */
#ifndef DROGUE_HLS_WIDTH
#define DROGUE_HLS_WIDTH 256
#endif
#ifndef DROGUE_HLS_HEIGHT
#define DROGUE_HLS_HEIGHT DROGUE_HLS_WIDTH
#endif
#define DROGUE_HLS_SIDE (DROGUE_HLS_WIDTH > DROGUE_HLS_HEIGHT ? DROGUE_HLS_WIDTH : DROGUE_HLS_HEIGHT)

/* Entries of the tables; a table that fills says so in the status register. */
#ifndef DROGUE_HLS_EDGES
#define DROGUE_HLS_EDGES ((int)DROGUE_EDGES_FOR(DROGUE_HLS_SIDE))
#endif
#ifndef DROGUE_HLS_LABELS
#define DROGUE_HLS_LABELS ((int)DROGUE_LABELS_FOR(DROGUE_HLS_SIDE))
#endif
#ifndef DROGUE_HLS_ARCS
#define DROGUE_HLS_ARCS ((int)DROGUE_ARCS_FOR(DROGUE_HLS_SIDE))
#endif

/* Status register: what the library returns, and each table that filled. */
#define DROGUE_HLS_STATUS 0xFFu           /* drogue_status */
#define DROGUE_HLS_COMPONENTS_FULL 0x100u /* labels of candidate components */
#define DROGUE_HLS_ARC_LABELS_FULL 0x200u
#define DROGUE_HLS_EDGES_FULL 0x400u
#define DROGUE_HLS_ARCS_FULL 0x800u

/* All bits when the condition (0 or 1) holds: masks instead of branches, so that a tick is one block of operations. */
static inline uint32_t drogue_hls_when(int condition) { return 0u - (uint32_t)condition; }

#define DROGUE_HLS_ELLIPSE_WORDS 5 /* xc yc a b angle, as drogue_ellipse */

static inline drogue_ellipse drogue_hls_unpack_ellipse(const int32_t words[DROGUE_HLS_ELLIPSE_WORDS])
{
    drogue_ellipse e;
    e.xc_px_q16 = words[0];
    e.yc_px_q16 = words[1];
    e.a_px_q16 = words[2];
    e.b_px_q16 = words[3];
    e.angle_rad_q16 = words[4];
    return e;
}

static inline void drogue_hls_pack_ellipse(int32_t words[DROGUE_HLS_ELLIPSE_WORDS], const drogue_ellipse *e)
{
    words[0] = e->xc_px_q16;
    words[1] = e->yc_px_q16;
    words[2] = e->a_px_q16;
    words[3] = e->b_px_q16;
    words[4] = e->angle_rad_q16;
}

/* Word of the edge list: x_q5, y_q5, gx, gy from the lowest bits up, 16 each. Points of arc 0, 1, ... first. */
static inline uint64_t drogue_hls_pack_edge(const drogue_edge *e)
{
    return (uint64_t)e->x_q5 | (uint64_t)e->y_q5 << 16 | (uint64_t)(uint16_t)e->gx << 32 |
           (uint64_t)(uint16_t)e->gy << 48;
}

/* Word of the arc table: first 24 bits, count 24, direction 2. */
static inline uint64_t drogue_hls_pack_arc(const drogue_arc *arc)
{
    return (uint64_t)arc->first | (uint64_t)arc->count << 24 | (uint64_t)arc->direction << 48;
}

static inline drogue_edge drogue_hls_unpack_edge(uint64_t word)
{
    drogue_edge e;
    e.arc = DROGUE_NO_ARC; /* the arc table says which arc */
    e.x_q5 = (uint16_t)(word & 0xFFFFu);
    e.y_q5 = (uint16_t)(word >> 16 & 0xFFFFu);
    e.gx = (int16_t)(uint16_t)(word >> 32 & 0xFFFFu);
    e.gy = (int16_t)(uint16_t)(word >> 48);
    return e;
}

static inline drogue_arc drogue_hls_unpack_arc(uint64_t word)
{
    drogue_arc arc;
    arc.first = (uint32_t)(word & 0xFFFFFFu);
    arc.count = (uint32_t)(word >> 24 & 0xFFFFFFu);
    arc.direction = (uint32_t)(word >> 48 & 3u);
    return arc;
}

#endif
