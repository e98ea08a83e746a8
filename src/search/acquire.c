/* SPDX-License-Identifier: Apache-2.0 */
/* Search, then measure what was found. */
#include "drogue/search.h"

#include <string.h>

#include "sightings.h"
#include "sure.h"

#define SURE (1 << 30)    /* the worth of what is sure is as much and more */
#define MOST_WHOLE_PX 512 /* a larger image is not measured itself: a drogue in it shows its inner part */

/* How much a result is worth: 0 without a pose; else by its log odds, or without an inner part by its cover. */
static int32_t worth(const drogue_result *r, const drogue_model *model)
{
    if (r->status != DROGUE_OK) {
        return 0;
    }
    if (model->inner_radius_m_q16 == 0) {
        return (drogue_result_sure(r, model) ? SURE : 1) + r->cover_q16;
    }
    return SURE - DROGUE_SURE_Q16 + drogue_result_log_odds_q16(r, model);
}

/* Is it good enough to look at nothing else but larger outlines about it? */
static int settles(const drogue_result *r, const drogue_model *model)
{
    return drogue_result_sure(r, model) && (model->inner_radius_m_q16 == 0 || drogue_result_decided(r));
}

/* Is a sighting one of a larger outline about whose middle the other lies, as the canopy's inner edge or a coupling? */
static int surrounds(const drogue_sighting *s, const drogue_sighting *what)
{
    const int32_t dx = s->x_px - what->x_px;
    const int32_t dy = s->y_px - what->y_px;
    const int32_t most = s->radius_px / 4 + 1;
    return 8 * s->radius_px > 9 * what->radius_px && dx <= most && dx >= -most && dy <= most && dy >= -most;
}

static void put_asked(drogue_region *out, const drogue_region *region, const drogue_image *image)
{
    if (region != NULL) {
        *out = *region;
        return;
    }
    out->x_px = 0;
    out->y_px = 0;
    out->width_px = image->width_px;
    out->height_px = image->height_px;
}

/* Sightings of a part of an image in coordinates of the image. */
static void shift(drogue_sighting *sightings, int32_t count, const drogue_region *part)
{
    int32_t i;
    for (i = 0; i < count; i++) {
        sightings[i].x_px += part->x_px;
        sightings[i].y_px += part->y_px;
        sightings[i].region.x_px += part->x_px;
        sightings[i].region.y_px += part->y_px;
    }
}

/* The drogue about a dark disc: half a pixel more is the middle of what a radius in whole pixels may be. */
static void frame_drogue(drogue_sighting *s, const drogue_model *model)
{
    const int64_t radius_px = drogue_div_round_s64((2 * s->radius_px + 1) * (int64_t)model->rim_radius_m_q16,
                                                   2 * (int64_t)model->inner_radius_m_q16);
    s->radius_px = (int32_t)(radius_px < DROGUE_MAX_SIDE ? radius_px : DROGUE_MAX_SIDE);
    drogue_sighting_frame(s);
}

/* Sightings in the region asked for; none of dark discs where the model has none. */
static drogue_status search_part(drogue_search *search, const drogue_model *model, const drogue_image *image,
                                 const drogue_region *region)
{
    const int32_t most_rows = DROGUE_SEARCH_MOST_ROWS;
    drogue_region part;
    drogue_status status;
    int32_t y;
    int32_t i;
    put_asked(&part, region, image);
    drogue_clip(&part.x_px, &part.width_px, image->width_px);
    drogue_clip(&part.y_px, &part.height_px, image->height_px < most_rows ? image->height_px : most_rows);
    if (part.width_px < 1 || part.height_px < 1) {
        return DROGUE_E_REGION;
    }
    status = drogue_search_begin(search, part.width_px);
    if (status != DROGUE_OK) {
        return status;
    }
    for (y = 0; y < part.height_px; y++) {
        drogue_search_row(search, drogue_image_row(image, part.y_px + y) + part.x_px);
    }
    drogue_search_end(search);
    search->dark_count = model->inner_radius_m_q16 > 0 ? search->dark_count : 0;
    for (i = 0; i < search->dark_count; i++) {
        frame_drogue(&search->dark[i], model);
    }
    shift(search->best, search->count, &part);
    shift(search->dark, search->dark_count, &part);
    return DROGUE_OK;
}

/* Places that are measured, by number: those of the sightings, of the dark discs, what is asked for. */
#define DARK DROGUE_SEARCH_MAX
#define WHOLE (DARK + DROGUE_SEARCH_DARK)

static void place(drogue_search *search, int32_t where, const drogue_region *region, const drogue_image *image)
{
    drogue_region *out = &search->asked;
    if (where < DARK) {
        *out = search->best[where].region;
    } else if (where < WHOLE) {
        *out = search->dark[where - DARK].region;
    } else {
        put_asked(out, region, image);
    }
}

/* Is there such a place, to be measured after what was before it? */
static int is_wanted(const drogue_search *search, int32_t where, int32_t settled, const drogue_model *model)
{
    int32_t most_px;
    if (where < DARK) {
        return where < search->count && (settled < 0 || (model->inner_radius_m_q16 > 0 &&
                                                         surrounds(&search->best[where], &search->best[settled])));
    }
    if (search->worth >= SURE) {
        return 0;
    }
    if (where < WHOLE) {
        return where - DARK < search->dark_count;
    }
    most_px = model->inner_radius_m_q16 == 0 ? DROGUE_MAX_SIDE : MOST_WHOLE_PX;
    return search->width_px <= most_px && search->rows_in <= most_px;
}

drogue_status drogue_acquire(drogue_result *out, drogue_workspace *workspace, drogue_search *search,
                             const drogue_setup *setup, const drogue_image *image, const drogue_region *region)
{
    drogue_status furthest = DROGUE_OK;           /* of what could not be measured */
    int32_t settled = -1;                         /* the sighting after which only larger ones about it are looked at */
    int current = 0;                              /* was the best measured last? */
    drogue_second_look room = DROGUE_SECOND_NONE; /* the first want of it */
    int32_t own;
    int32_t i;
    drogue_result_clear(out);
    out->status =
        drogue_input_valid(image, setup) ? search_part(search, setup->model, image, region) : DROGUE_E_ARGUMENT;
    if (out->status != DROGUE_OK) {
        return out->status;
    }
    search->worth = 0;
    for (i = 0; i <= WHOLE; i++) {
        if (!is_wanted(search, i, settled, setup->model)) {
            continue;
        }
        place(search, i, region, image);
        (void)drogue_measure(out, workspace, setup, image, &search->asked);
        drogue_note_room(&room, out->status, out->second_look);
        furthest = out->status > furthest ? out->status : furthest;
        own = worth(out, setup->model);
        current = own > search->worth;
        if (current) {
            search->worth = own;
            search->where = i;
            if (i < DARK && (settled >= 0 || settles(out, setup->model))) {
                settled = i;
            }
        }
    }
    if (search->worth == 0) {
        drogue_result_clear(out);
        out->status = furthest > DROGUE_OK ? furthest : DROGUE_E_NO_INNER_PART;
        out->second_look = room;
    } else if (!current) { /* again, so that the workspace holds its points */
        place(search, search->where, region, image);
        (void)drogue_measure(out, workspace, setup, image, &search->asked);
    }
    if (out->status == DROGUE_OK && !drogue_result_sure(out, setup->model)) {
        out->status = DROGUE_E_UNSURE;
        if (room != DROGUE_SECOND_NONE && out->second_look <= DROGUE_SECOND_BETTER) {
            out->second_look = DROGUE_SECOND_ROOM;
        }
    }
    return out->status;
}
