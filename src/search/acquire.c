/* SPDX-License-Identifier: Apache-2.0 */
/* Search, then measure what was found. */
#include "drogue/search.h"

#include <string.h>

#include "drogue/decide.h"
#include "sightings.h"

/* What a search must show to be sure: where the model knows no inner part cover of the outline and reliability; else an
 * inner part that is dark, sharp and near to its size, and cover. One that decides the orientation and has its size
 * needs less of it, least where it is so sharp and so exactly of its size as nothing else is, a witness; or it need
 * not be sharp; nor need one of some pixels within an outline that is whole. Shade about a disc makes it larger: sharp
 * and deciding it is one still, and the covariance has what that leaves in doubt. A large one of its size and nearly as
 * sharp may lie beside its place: then the outline's shape is a little off. */
#define SURE_COVER DROGUE_Q16(3, 4)
#define SURE_RELIABILITY DROGUE_Q16(9, 10)
#define DECIDED_COVER DROGUE_Q16(6, 10)
#define EXACT_COVER DROGUE_Q16(1, 2)
#define BLURRED_COVER DROGUE_Q16(9, 10)
#define EVIDENT_COVER DROGUE_Q16(31, 32)
#define EVIDENT_RELIABILITY DROGUE_Q16(99, 100)
#define EVIDENT_PX DROGUE_Q16(5, 1) /* radius of the inner part */
#define MOST_SPREAD_PX DROGUE_Q16(3, 10)
#define WITNESS_SPREAD_PX DROGUE_Q16(5, 10)
#define WITNESS_PX DROGUE_Q16(2, 10)    /* and a 64th, of the inner part's radius: by no chance; */
#define MOST_OFF_PX DROGUE_Q16(6, 10)   /* and a tenth, of the inner part's radius: near; */
#define MOST_DOUBT DROGUE_Q16(1, 8)     /* in the distance: an inner part of more may be something else, */
#define SHADED_DOUBT DROGUE_Q16(3, 10)  /* or, where it is too large, in shade; */
#define SHADED_PX DROGUE_Q16(35, 10)    /* one of this radius */
#define EXACT_PX DROGUE_Q16(3, 10)      /* and a twenty-fifth: its size */
#define BESIDE_PX DROGUE_Q16(9, 1)      /* radius of an inner part that may lie beside its place, */
#define BESIDE_COVER DROGUE_Q16(7, 8)   /* in such an outline */
#define SETTLED_COVER DROGUE_Q16(8, 10) /* of a result after which only larger outlines about it are looked at */
#define SURE (2 * DROGUE_Q16_ONE)       /* the worth of what is sure is more */
#define LARGER (DROGUE_Q16_ONE / 8)     /* the worth of being the larger one of two outlines about one inner part */
#define MOST_PRODUCT (INT64_MAX / 4)
#define MOST_EXPECTED (INT64_C(1) << 40) /* px Q16: no inner part's area says more */
#define WIDER 2                          /* so many sightings are measured once more */
#define MOST_WHOLE_PX 512 /* a larger image is not measured itself: a drogue in it shows its inner part */

/* Radius of a circle of an inner part's area, px Q16. */
static int64_t radius_of(const drogue_inner_part *p)
{
    return (int64_t)drogue_isqrt_u64((((uint64_t)p->area_px << 32) / (uint64_t)DROGUE_Q16_PI) << 16);
}

/* Radii of the inner part, px Q16, as circles of its area: what the model expects in this outline, and by how much it
 * is larger. A ring about some dark disc has another; and of concentric outlines the rim fits best. */
static int sizes(int64_t *expected, int64_t *larger, const drogue_result *r, const drogue_model *model)
{
    const int64_t z = r->pose.position_m_q16[2];
    const int64_t end = z + model->inner_depth_m_q16;
    if (!r->has_inner || z <= 0 || end <= 0) {
        return 0;
    }
    *expected = (int64_t)drogue_isqrt_u64((uint64_t)((int64_t)r->ellipse.a_px_q16 * r->ellipse.b_px_q16));
    *expected = drogue_div_round_s64(*expected * model->inner_radius_m_q16, model->rim_radius_m_q16);
    *expected = *expected < MOST_PRODUCT / z ? *expected : MOST_PRODUCT / z; /* of a model that fits no outline */
    *expected = drogue_div_round_s64(*expected * z, end);
    *expected = *expected < MOST_EXPECTED ? *expected : MOST_EXPECTED;
    *larger = radius_of(&r->inner) - *expected;
    return 1;
}

/* Does the inner part decide which pose it is, and agree with the outline, in its place and about its size? */
static int decided(const drogue_result *r) { return r->orientation_resolved && r->doubt_q16 < DROGUE_CONTRADICTED_Q16; }

/* Is what is too large a disc in shade? */
static int is_shaded(const drogue_result *r, int64_t expected)
{
    return r->orientation_resolved && r->doubt_q16 <= SHADED_DOUBT && expected >= SHADED_PX &&
           r->cover_q16 >= SURE_COVER;
}

/* drogue_result_sure() of what was found where nothing is darker than this. */
static int is_sure(const drogue_result *r, const drogue_model *model, int32_t darkest)
{
    int64_t expected;
    int64_t larger;
    int64_t off;
    int sharp;
    int exact;
    int witness;
    if (model->inner_radius_m_q16 == 0) {
        return r->cover_q16 >= SURE_COVER && r->quality.reliability_q16 >= SURE_RELIABILITY;
    }
    if (!sizes(&expected, &larger, r, model) || 4 * r->inner.contrast < r->inner.threshold - darkest) {
        return 0;
    }
    off = (int64_t)drogue_abs_u64(larger);
    sharp = r->inner.spread_px_q16 <= MOST_SPREAD_PX;
    if (r->doubt_q16 > MOST_DOUBT || 10 * (off - MOST_OFF_PX) > expected) {
        return larger > 0 && sharp && is_shaded(r, expected);
    }
    exact = 25 * (off - EXACT_PX) <= expected;
    witness = decided(r) && expected >= EVIDENT_PX && 64 * (off - WITNESS_PX) <= expected &&
              r->inner.spread_px_q16 <= WITNESS_SPREAD_PX;
    if (4 * r->inner.contrast < r->inner.threshold) { /* dark for what haze leaves */
        return decided(r) && expected >= EVIDENT_PX && exact &&
               r->cover_q16 >= (witness ? DECIDED_COVER : BLURRED_COVER);
    }
    if (witness) {
        return r->cover_q16 >= EXACT_COVER;
    }
    if (decided(r) && exact) {
        return r->cover_q16 >= (sharp ? DECIDED_COVER : BLURRED_COVER);
    }
    if (exact && expected >= BESIDE_PX && r->inner.spread_px_q16 <= WITNESS_SPREAD_PX &&
        r->doubt_q16 <= DROGUE_CONTRADICTED_Q16 && r->cover_q16 >= BESIDE_COVER) {
        return 1;
    }
    return sharp ? r->cover_q16 >= SURE_COVER
                 : r->orientation_resolved && expected >= EVIDENT_PX && r->cover_q16 >= EVIDENT_COVER &&
                       r->quality.reliability_q16 >= EVIDENT_RELIABILITY;
}

int drogue_result_sure(const drogue_result *r, const drogue_model *model) { return is_sure(r, model, 0); }

/* How much a result is worth: 0 without a pose; more where it is sure; most when the inner part decides, too; and then
 * by cover, less the share by which the inner part's size is off. What is not sure is worth a quarter more with an
 * inner part, and another one where that decides. */
static int32_t worth(const drogue_result *r, const drogue_model *model, int32_t darkest)
{
    int64_t expected;
    int64_t larger;
    int64_t off;
    if (r->status != DROGUE_OK) {
        return 0;
    }
    if (!is_sure(r, model, darkest)) {
        return 1 + r->cover_q16 + (r->has_inner + decided(r)) * (DROGUE_Q16_ONE / 4);
    }
    if (!sizes(&expected, &larger, r, model)) {
        return SURE + r->cover_q16;
    }
    off = drogue_div_round_s64((int64_t)drogue_abs_u64(larger) * DROGUE_Q16_ONE, expected > 0 ? expected : 1);
    return (decided(r) ? 5 * DROGUE_Q16_ONE : 3 * DROGUE_Q16_ONE) + r->cover_q16 -
           (int32_t)(off < DROGUE_Q16_ONE ? off : DROGUE_Q16_ONE);
}

/* Is a pose good enough to look at nothing else but larger outlines about it? */
static int settles(const drogue_result *r, const drogue_model *model, int32_t darkest)
{
    int64_t expected;
    int64_t larger;
    if (r->cover_q16 < SETTLED_COVER || !is_sure(r, model, darkest)) {
        return 0;
    }
    return model->inner_radius_m_q16 == 0 || (decided(r) && sizes(&expected, &larger, r, model) &&
                                              16 * ((int64_t)drogue_abs_u64(larger) - MOST_OFF_PX / 2) <= expected);
}

static int within(drogue_q16 x, drogue_q16 y, drogue_q16 of_x, drogue_q16 of_y, drogue_q16 px_q16)
{
    return drogue_square_sum(drogue_q16_sub(x, of_x), drogue_q16_sub(y, of_y)) < drogue_square_sum(px_q16, 0);
}

/* Is an outline a ring about the inner part of a larger one, as its coupling's? */
static int is_part(const drogue_weighed *small, const drogue_weighed *large)
{
    return 5 * (int64_t)small->a_px_q16 < 4 * (int64_t)large->a_px_q16 &&
           small->a_px_q16 < 2 * (int64_t)large->inner_px_q16 &&
           within(small->xc_px_q16, small->yc_px_q16, large->inner_x_px_q16, large->inner_y_px_q16,
                  large->inner_px_q16 / 2);
}

/* Keep a result that is worth more; returns whether it is. Of two sure outlines about one inner part the larger one is
 * more likely the rim, and the other an edge of the canopy; what is a part of a larger outline is none. */
static int keep_better(drogue_search *search, const drogue_result *r, int32_t where, const drogue_model *model)
{
    drogue_weighed *stands = &search->stands;
    drogue_weighed *last = &search->last;
    int32_t own = worth(r, model, search->darkest);
    int32_t other = stands->worth;
    last->worth = own;
    last->where = where;
    last->a_px_q16 = r->ellipse.a_px_q16;
    last->xc_px_q16 = r->ellipse.xc_px_q16;
    last->yc_px_q16 = r->ellipse.yc_px_q16;
    last->inner_x_px_q16 = r->inner.x_px_q16;
    last->inner_y_px_q16 = r->inner.y_px_q16;
    last->inner_px_q16 = own > SURE && decided(r) ? drogue_sat_s32(radius_of(&r->inner)) : 0;
    if (r->has_inner && own > SURE && other > SURE &&
        within(last->inner_x_px_q16, last->inner_y_px_q16, stands->inner_x_px_q16, stands->inner_y_px_q16,
               DROGUE_Q16_ONE)) {
        own += 8 * (int64_t)last->a_px_q16 > 9 * (int64_t)stands->a_px_q16 ? LARGER : 0;
        other += 9 * (int64_t)last->a_px_q16 < 8 * (int64_t)stands->a_px_q16 ? LARGER : 0;
    }
    if (is_part(last, stands) || (own <= other && !is_part(stands, last))) {
        return 0;
    }
    *stands = *last;
    return 1;
}

/* Is a sighting one of a larger outline about the same middle? */
static int surrounds(const drogue_sighting *s, const drogue_sighting *what)
{
    const int32_t dx = s->x_px - what->x_px;
    const int32_t dy = s->y_px - what->y_px;
    const int32_t most = what->radius_px / 4 + 1;
    return 8 * s->radius_px > 9 * what->radius_px && s->radius_px < 2 * what->radius_px && dx <= most && dx >= -most &&
           dy <= most && dy >= -most;
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
    drogue_region part;
    drogue_status status;
    int32_t y;
    int32_t i;
    put_asked(&part, region, image);
    drogue_clip(&part.x_px, &part.width_px, image->width_px);
    drogue_clip(&part.y_px, &part.height_px, image->height_px);
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

/* About the same middle, a quarter larger. */
static void widen(drogue_region *r)
{
    r->x_px -= r->width_px / 8;
    r->y_px -= r->height_px / 8;
    r->width_px += r->width_px / 4;
    r->height_px += r->height_px / 4;
}

/* Places that are measured, by number: those of the sightings, of the dark discs, larger ones about the first of the
 * sightings, what is asked for. */
#define DARK DROGUE_SEARCH_MAX
#define WIDE (DARK + DROGUE_SEARCH_DARK)
#define WHOLE (WIDE + WIDER)

static void place(drogue_search *search, int32_t where, const drogue_region *region, const drogue_image *image)
{
    drogue_region *out = &search->asked;
    if (where < DARK) {
        *out = search->best[where].region;
    } else if (where < WIDE) {
        *out = search->dark[where - DARK].region;
    } else if (where < WHOLE) {
        *out = search->best[where - WIDE].region;
        widen(out); /* what was sighted may be an edge within the drogue */
    } else {
        put_asked(out, region, image);
    }
}

/* Is there such a place, to be measured after what was before it? */
static int is_wanted(const drogue_search *search, int32_t where, int32_t settled, const drogue_model *model)
{
    if (where < DARK) {
        return where < search->count && (settled < 0 || (model->inner_radius_m_q16 > 0 &&
                                                         surrounds(&search->best[where], &search->best[settled])));
    }
    if (search->stands.worth > SURE) {
        return 0;
    }
    if (where < WIDE) {
        return where - DARK < search->dark_count;
    }
    if (where < WHOLE) {
        return where - WIDE < search->count && model->inner_radius_m_q16 > 0;
    }
    return model->inner_radius_m_q16 == 0 || (search->width_px <= MOST_WHOLE_PX && search->rows_in <= MOST_WHOLE_PX);
}

drogue_status drogue_acquire(drogue_result *out, drogue_search *search, drogue_workspace *workspace,
                             const drogue_setup *setup, const drogue_image *image, const drogue_region *region)
{
    drogue_status furthest = DROGUE_OK;           /* of what could not be measured */
    int32_t settled = -1;                         /* the sighting after which only larger ones about it are looked at */
    int current = 0;                              /* was the best measured last? */
    drogue_second_look room = DROGUE_SECOND_NONE; /* the first want of it */
    int32_t i;
    drogue_result_clear(out);
    out->status =
        drogue_input_valid(image, setup) ? search_part(search, setup->model, image, region) : DROGUE_E_ARGUMENT;
    if (out->status != DROGUE_OK) {
        return out->status;
    }
    memset(&search->stands, 0, sizeof search->stands);
    for (i = 0; i <= WHOLE; i++) {
        if (!is_wanted(search, i, settled, setup->model)) {
            continue;
        }
        place(search, i, region, image);
        if (i >= WIDE && i < WHOLE && !drogue_workspace_spans(workspace, &search->asked, image)) {
            drogue_note_room(&room, DROGUE_E_WORKSPACE, DROGUE_SECOND_NONE);
            continue;
        }
        (void)drogue_measure(out, workspace, setup, image, &search->asked);
        drogue_note_room(&room, out->status, out->second_look);
        furthest = out->status > furthest ? out->status : furthest;
        current = keep_better(search, out, i, setup->model);
        if (current && i < DARK && (settled >= 0 || settles(out, setup->model, search->darkest))) {
            settled = i;
        }
    }
    if (search->stands.worth == 0) {
        drogue_result_clear(out);
        out->status = furthest > DROGUE_OK ? furthest : DROGUE_E_NO_INNER_PART;
        out->second_look = room;
    } else if (!current) { /* again, so that the workspace holds its points */
        place(search, search->stands.where, region, image);
        (void)drogue_measure(out, workspace, setup, image, &search->asked);
    }
    if (out->status == DROGUE_OK && !is_sure(out, setup->model, search->darkest)) {
        out->status = DROGUE_E_UNSURE;
        if (room != DROGUE_SECOND_NONE && out->second_look <= DROGUE_SECOND_BETTER) {
            out->second_look = DROGUE_SECOND_ROOM;
        }
    }
    return out->status;
}
