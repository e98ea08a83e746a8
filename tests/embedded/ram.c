/* SPDX-License-Identifier: Apache-2.0 */
/* What the caller keeps in RAM, as arrays whose sizes sizes.py reads from the object. */
#include "drogue/decide.h"
#include "drogue/drogue.h"
#include "drogue/track.h"

#define KEEP(name, bytes) \
    extern char name[];   \
    char name[bytes] = {0};

KEEP(workspace_256x256, DROGUE_WORKSPACE_BYTES_FOR(256))
KEEP(workspace_160x120, DROGUE_WORKSPACE_BYTES_FOR(160))
KEEP(drogue_workspace_, sizeof(drogue_workspace))
KEEP(drogue_config_, sizeof(drogue_config))
KEEP(drogue_result_, sizeof(drogue_result))
KEEP(drogue_frontend_, sizeof(drogue_frontend))
KEEP(drogue_track_, sizeof(drogue_track))
KEEP(drogue_search_, sizeof(drogue_search))
KEEP(search_640, DROGUE_SEARCH_BYTES(640))
KEEP(search_1280, DROGUE_SEARCH_BYTES(1280))

/* what passes from stage to stage */
KEEP(drogue_edge_, sizeof(drogue_edge))
KEEP(drogue_arc_, sizeof(drogue_arc))
KEEP(drogue_outline_, sizeof(drogue_outline))
KEEP(drogue_ellipse_, sizeof(drogue_ellipse))
KEEP(drogue_evidence_, sizeof(drogue_evidence))
KEEP(drogue_inner_evidence_, sizeof(drogue_inner_evidence))
KEEP(drogue_decision_, sizeof(drogue_decision))
KEEP(drogue_sighting_, sizeof(drogue_sighting))
KEEP(drogue_track_estimate_, sizeof(drogue_track_estimate))
