/* SPDX-License-Identifier: Apache-2.0 */
/* The shipped frames as C: the pixels of each region, written by make_frames.c on the host from vectors/frame. The
 * camera is that of the cropped picture, whose whole area is the region. */
#ifndef FRAMES_H
#define FRAMES_H

#include <stddef.h>

#include "drogue/drogue.h"

#define FRAMES_SIDE_PX 256 /* longest side of a region; make_frames refuses longer ones */

typedef struct frame {
    const char *name;
    drogue_image image;
    drogue_camera camera;
    drogue_model model;
    drogue_q16 true_position_m_q16[3];
} frame;

extern const frame frames[];
extern const size_t frame_count;

extern const frame *const frame_demo; /* the one called demo */

#endif
