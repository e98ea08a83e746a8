/* SPDX-License-Identifier: Apache-2.0 */
/* The outline as a camera without distortion would see it. */
#include "drogue/outline.h"

#include <string.h>

#include "collection.h"
#include "harmonics.h"

drogue_status drogue_outline_undistorted(drogue_ellipse *out, const drogue_outline *outline,
                                         const drogue_workspace *workspace, const drogue_edge_list *list,
                                         const drogue_setup *setup, int32_t x_px, int32_t y_px)
{
    const drogue_band band = drogue_band_of(outline->band_px_q16, setup->config->refit_cos_q16);
    drogue_ellipse_frame frame;
    drogue_ellipse centre = outline->fitted;
    drogue_status status;
    drogue_outline_room *room = workspace->outline; /* what found the outline has served */
    drogue_region_lens l;
    int32_t pull_q24[5];
    uint32_t own;
    memset(out, 0, sizeof *out);
    l.camera = setup->camera;
    l.x_px_q16 = drogue_q16_from_int(x_px);
    l.y_px_q16 = drogue_q16_from_int(y_px);
    centre.xc_px_q16 = drogue_q16_add(centre.xc_px_q16, l.x_px_q16);
    centre.yc_px_q16 = drogue_q16_add(centre.yc_px_q16, l.y_px_q16);
    if (drogue_ellipse_frame_of(&frame, &outline->fitted) != DROGUE_OK ||
        drogue_undistort_point(&centre.xc_px_q16, &centre.yc_px_q16, setup->camera) != DROGUE_OK) {
        return DROGUE_E_DEGENERATE;
    }
    drogue_collection_begin(&room->own, &centre, (int64_t)centre.a_px_q16 * 4); /* lenses may stretch */
    room->support = outline->support;
    own = drogue_collect_undistorted(&room->own, &room->support, &frame, &band, workspace->edges, list->edge_count, &l);
    status = drogue_collection_fit(out, &room->own);
    if (status == DROGUE_OK && (room->own.moments.n * 4 < (int64_t)own * 3 ||
                                !drogue_round_enough(out, setup->config) || out->b_px_q16 < DROGUE_Q16_ONE)) {
        status = DROGUE_E_DEGENERATE; /* most of the outline lies beyond what the lens model can undo */
    }
    if (status == DROGUE_OK) {
        if (!outline->outer) { /* as drogue_outline_pull() */
            drogue_turn_pull(pull_q24, outline->support.pull_q24, out->angle_rad_q16 - outline->fitted.angle_rad_q16);
            drogue_outline_put_back(out, pull_q24);
        }
        drogue_undo_blur(out, setup->config);
    }
    return status;
}
