/* SPDX-License-Identifier: Apache-2.0 */
/* One frame through the library: the region to look in, and a workspace on the heap that no frame can fill. */
#ifndef CLI_FRAME_H
#define CLI_FRAME_H

#include <stddef.h>

#include "drogue/track.h"
#include "options.h"
#include "png_io.h"

/* A workspace that grows with what it must hold. Start with all zero. */
typedef struct frame_workspace {
    void *memory;
    size_t bytes;
    drogue_workspace workspace;
    void *search_memory;
    int32_t search_width_px;
    drogue_search search;
} frame_workspace;

/* Make room for any region of so many pixels, every pixel a candidate edge point.
 *
 *  min_arc_px  least length of an arc in the arc table
 *  return      EXIT_MEASURED, or EXIT_BAD after a complaint about 'path'
 */
int frame_workspace_fit(frame_workspace *w, const char *path, int32_t width_px, int32_t height_px, uint32_t min_arc_px);

void frame_workspace_free(frame_workspace *w);

/* The picture as the library takes it. */
drogue_image frame_image(const picture *grey);

/* Can the camera be that of this picture: its size, where a camera file says one; a principal point not far outside?
 *
 *  return  EXIT_MEASURED, or EXIT_BAD after a complaint
 */
int frame_check_camera(const options *o, const char *path, const picture *grey);

/* The region asked for.
 *
 *  return  EXIT_MEASURED, or EXIT_BAD after a complaint when the part in the image exceeds DROGUE_MAX_SIDE
 */
int frame_region(drogue_region *out, const options *o, const char *path, const picture *grey);

/* Search one whole frame and measure what is found.
 *
 *  region  out, where it was measured; the whole image when nothing was
 *  return  EXIT_MEASURED, or EXIT_BAD after a complaint: no memory, or more than 32767 pixels a side and no --roi
 */
int frame_acquire(drogue_result *out, drogue_region *region, frame_workspace *w, const options *o, const char *path,
                  const picture *grey);

/* One frame of a track.
 *
 *  dt_us   microseconds since the one before
 *  region  out, asked for; where it was measured when the whole image was searched
 *  return  EXIT_MEASURED, or EXIT_BAD after a complaint: no memory, or more than 32767 pixels a side and no --roi
 */
int frame_track(drogue_result *out, drogue_region *region, drogue_track *track, frame_workspace *w, const options *o,
                const char *path, const picture *grey, uint32_t dt_us);

/* Measure one frame; what the library found, or why it found nothing, is in the result. Where the region asked for has
 * edges but no outline of its own size, it is searched for a smaller one.
 *
 *  searched  out, 1 when that search found what is in the result
 *  return    EXIT_MEASURED, or EXIT_BAD after a complaint when there is no memory
 */
int frame_measure(drogue_result *out, int *searched, frame_workspace *w, const options *o, const char *path,
                  const picture *grey, const drogue_region *region);

/* Was it measured, but with a reliability below --min-reliability? */
int frame_unreliable(const options *o, const drogue_result *result);

#endif
