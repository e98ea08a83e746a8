/* SPDX-License-Identifier: Apache-2.0 */
/* A picture of what was found: edges, arcs, ellipse, inner centre, axis, region, and the pose in words below. */
#ifndef CLI_OVERLAY_H
#define CLI_OVERLAY_H

#include "drogue/drogue.h"
#include "members.h"
#include "options.h"
#include "png_io.h"

/* Draw and write.
 *
 *  region     asked for, before it was clipped
 *  workspace  with the edges and arcs of the result
 *  m          what was measured; a pose that the output does not have is not drawn
 *  state      of the track in words, or NULL
 *  return     EXIT_MEASURED, or EXIT_BAD after a complaint
 */
int overlay_write(const char *path, const options *o, const picture *grey, const drogue_region *region,
                  const drogue_workspace *workspace, const measurement *m, const char *state);

#endif
