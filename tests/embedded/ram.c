/* SPDX-License-Identifier: Apache-2.0 */
/* What the caller keeps in RAM, as arrays whose sizes sizes.py reads from the object. */
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
