/* SPDX-License-Identifier: Apache-2.0 */
/* Names of statuses and of what became of the second look. */
#include "drogue/status.h"

const char *drogue_status_name(drogue_status status)
{
    switch (status) {
    case DROGUE_OK: return "ok";
    case DROGUE_E_ARGUMENT: return "argument";
    case DROGUE_E_REGION: return "region";
    case DROGUE_E_WORKSPACE: return "workspace";
    case DROGUE_E_LABELS_FULL: return "labels_full";
    case DROGUE_E_EDGES_FULL: return "edges_full";
    case DROGUE_E_ARCS_FULL: return "arcs_full";
    case DROGUE_E_NO_EDGES: return "no_edges";
    case DROGUE_E_NO_ARCS: return "no_arcs";
    case DROGUE_E_NO_ELLIPSE: return "no_ellipse";
    case DROGUE_E_TOO_FEW_POINTS: return "too_few_points";
    case DROGUE_E_DEGENERATE: return "degenerate";
    case DROGUE_E_NO_INNER_PART: return "no_inner_part";
    case DROGUE_E_DOMAIN: return "domain";
    case DROGUE_E_BEHIND_CAMERA: return "behind_camera";
    case DROGUE_E_UNSURE: return "unsure";
    case DROGUE_STATUS_COUNT: break;
    }
    return "unknown";
}

const char *drogue_second_look_name(drogue_second_look look)
{
    switch (look) {
    case DROGUE_SECOND_NONE: return "none";
    case DROGUE_SECOND_BETTER: return "better";
    case DROGUE_SECOND_NO_MORE: return "no_more";
    case DROGUE_SECOND_REGION: return "region";
    case DROGUE_SECOND_TOO_WIDE: return "too_wide";
    case DROGUE_SECOND_FULL: return "full";
    case DROGUE_SECOND_ROOM: return "room";
    case DROGUE_SECOND_COUNT: break;
    }
    return "unknown";
}

void drogue_note_room(drogue_second_look *room, drogue_status status, drogue_second_look look)
{
    if (*room != DROGUE_SECOND_NONE) {
        return;
    }
    if (drogue_status_full(status)) {
        *room = DROGUE_SECOND_FULL;
    } else if (status == DROGUE_E_WORKSPACE) {
        *room = DROGUE_SECOND_TOO_WIDE;
    } else if (look >= DROGUE_SECOND_TOO_WIDE) {
        *room = look;
    }
}
