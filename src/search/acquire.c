/* SPDX-License-Identifier: Apache-2.0 */
/* Search, then measure what was found. */
#include "drogue/search.h"

#include <string.h>

/* How much a result is worth: 0 without a pose; more with an inner part; most when that decides, and then by cover. */
static int32_t worth(const drogue_result *r)
{
    if (r->status != DROGUE_OK) {
        return 0;
    }
    return r->orientation_resolved ? 3 + r->cover_q16 : r->has_inner ? 2 : 1;
}

/* Good enough not to look at what scored less? */
static int settles(const drogue_result *r, const drogue_model *model)
{
    return r->status == DROGUE_OK && (r->orientation_resolved || model->inner_radius_m_q16 == 0) &&
           r->cover_q16 >= DROGUE_Q16(8, 10);
}

/* Sightings in a part of the image, in coordinates of the image. */
static drogue_status search_part(drogue_search *search, const drogue_image *image, const drogue_region *part)
{
    int32_t y;
    int32_t i;
    drogue_status status = drogue_search_begin(search, part->width_px);
    if (status != DROGUE_OK) {
        return status;
    }
    for (y = 0; y < part->height_px; y++) {
        drogue_search_row(search, drogue_image_row(image, part->y_px + y) + part->x_px);
    }
    for (i = drogue_search_end(search) - 1; i >= 0; i--) {
        drogue_sighting *c = &search->best[i];
        c->x_px += part->x_px;
        c->y_px += part->y_px;
        c->region.x_px += part->x_px;
        c->region.y_px += part->y_px;
    }
    return DROGUE_OK;
}

drogue_status drogue_acquire(drogue_result *out, drogue_search *search, drogue_workspace *workspace,
                             const drogue_setup *setup, const drogue_image *image, const drogue_region *region)
{
    drogue_region part;
    drogue_region whole;
    drogue_status status;
    int32_t most = 0;
    int32_t best = 0;
    int32_t i;
    memset(out, 0, sizeof *out);
    whole.x_px = 0;
    whole.y_px = 0;
    whole.width_px = image->width_px;
    whole.height_px = image->height_px;
    whole = region != NULL ? *region : whole;
    if (image->data == NULL || image->stride < image->width_px) {
        out->status = DROGUE_E_ARGUMENT;
        return out->status;
    }
    if (whole.width_px < 1 || whole.height_px < 1) {
        out->status = DROGUE_E_REGION;
        return out->status;
    }
    part = whole;
    drogue_clip(&part.x_px, &part.width_px, image->width_px);
    drogue_clip(&part.y_px, &part.height_px, image->height_px);
    if (part.width_px < 1 || part.height_px < 1) {
        out->status = DROGUE_E_REGION;
        return out->status;
    }
    status = search_part(search, image, &part);
    if (status != DROGUE_OK) {
        out->status = status;
        return status;
    }
    for (i = 0; i <= search->count; i++) {
        (void)drogue_measure(out, workspace, setup, image, i < search->count ? &search->best[i].region : &whole);
        if (settles(out, setup->model)) {
            return DROGUE_OK;
        }
        if (worth(out) > most) {
            most = worth(out);
            best = i;
        }
    }
    if (most > 0 && best < search->count) { /* again, so that the workspace holds its points */
        (void)drogue_measure(out, workspace, setup, image, &search->best[best].region);
    }
    return out->status;
}
