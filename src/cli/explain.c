/* SPDX-License-Identifier: Apache-2.0 */
/* Sentences for statuses. */
#include "explain.h"

const char *explain_status(drogue_status status)
{
    switch (status) {
    case DROGUE_OK: return "measured";
    case DROGUE_E_ARGUMENT: return "camera, drogue or a threshold is outside its range";
    case DROGUE_E_REGION:
        return "the region does not meet the image, ends beyond pixel 32766, or is too large to be measured as a whole";
    case DROGUE_E_WORKSPACE: return "the workspace is too small for the region";
    case DROGUE_E_LABELS_FULL: return "more components than the workspace holds";
    case DROGUE_E_EDGES_FULL: return "more edge points than the workspace holds";
    case DROGUE_E_ARCS_FULL: return "more arcs than the workspace holds";
    case DROGUE_E_NO_EDGES:
        return "no edge where an outline could be: nothing is there, or not about the middle of --roi; or lower canny_high "
               "and canny_low (--set) where contrast is low";
    case DROGUE_E_NO_ARCS:
        return "edges, but no arc long and curved enough: --roi with the drogue about its middle and a longest side of "
               "2 to 3 major semi-axes helps, or a lower min_arc_share, min_arc_px or canny_low (--set)";
    case DROGUE_E_NO_ELLIPSE:
        return "arcs, but no ellipse that enough edge points agree on: less than min_cover of the outline is seen, or less "
               "than 0.7 and no inner part, or it is flatter than min_axis_ratio, or nothing here is a drogue";
    case DROGUE_E_TOO_FEW_POINTS: return "fewer than the six points that a conic needs";
    case DROGUE_E_DEGENERATE: return "the points do not determine an ellipse";
    case DROGUE_E_NO_INNER_PART:
        return "no dark disc inside a ring is in sight, nor a dark inner part of the least size";
    case DROGUE_E_DOMAIN:
        return "an outline, but its pose is beyond what the numbers hold: are camera and radius right?";
    case DROGUE_E_BEHIND_CAMERA: return "the outline's pose lies behind the camera: is the camera right?";
    case DROGUE_E_UNSURE:
        return "something was found, but not enough of a drogue is seen in it: no inner part of the drogue's size in an "
               "outline seen well; --roi where it is known to be";
    case DROGUE_STATUS_COUNT: break;
    }
    return "a status that this program does not know";
}
