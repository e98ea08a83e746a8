/* SPDX-License-Identifier: Apache-2.0 */
/* Search, then measure what was found. */
#include "drogue/search.h"

#include <string.h>

#include "drogue/decide.h"

/* What a search must show to be sure: where the model knows no inner part cover of the outline and reliability; else an
 * inner part that is dark, sharp and near to its size, and cover. One that decides the orientation and has its size
 * needs less of it, least where it is so sharp and so exactly of its size as nothing else is, or need not be sharp; nor
 * need one of some pixels within an outline that is whole. */
#define SURE_COVER DROGUE_Q16(3, 4)
#define SURE_RELIABILITY DROGUE_Q16(9, 10)
#define DECIDED_COVER DROGUE_Q16(6, 10)
#define EXACT_COVER DROGUE_Q16(1, 2)
#define BLURRED_COVER DROGUE_Q16(9, 10)
#define EVIDENT_COVER DROGUE_Q16(31, 32)
#define EVIDENT_RELIABILITY DROGUE_Q16(99, 100)
#define EVIDENT_PX DROGUE_Q16(5, 1) /* radius of the inner part */
#define MOST_SPREAD_PX DROGUE_Q16(3, 10)
#define WITNESS_PX DROGUE_Q16(2, 10)    /* and a 64th, of the inner part's radius: by no chance; */
#define MOST_OFF_PX DROGUE_Q16(6, 10)   /* and a tenth, of the inner part's radius: near; */
#define MOST_DOUBT DROGUE_Q16(1, 8)     /* in the distance: an inner part of more may be something else */
#define EXACT_PX DROGUE_Q16(3, 10)      /* and a twenty-fifth: its size */
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
 * is off. A ring about some dark disc has another; and of concentric outlines the rim fits best. */
static int sizes(int64_t *expected, int64_t *off, const drogue_result *r, const drogue_model *model)
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
    *off = radius_of(&r->inner) - *expected;
    *off = *off < 0 ? -*off : *off;
    return 1;
}

/* Does the inner part decide which pose it is, and agree with the outline, in its place and about its size? */
static int decided(const drogue_result *r) { return r->orientation_resolved && r->doubt_q16 < DROGUE_CONTRADICTED_Q16; }

int drogue_result_sure(const drogue_result *r, const drogue_model *model)
{
    int64_t expected;
    int64_t off;
    int sharp;
    if (model->inner_radius_m_q16 == 0) {
        return r->cover_q16 >= SURE_COVER && r->quality.reliability_q16 >= SURE_RELIABILITY;
    }
    if (!sizes(&expected, &off, r, model) || 4 * r->inner.contrast < r->inner.threshold || r->doubt_q16 > MOST_DOUBT) {
        return 0;
    }
    sharp = r->inner.spread_px_q16 <= MOST_SPREAD_PX;
    if (decided(r) && sharp && expected >= EVIDENT_PX && 64 * (off - WITNESS_PX) <= expected) {
        return r->cover_q16 >= EXACT_COVER;
    }
    if (decided(r) && 25 * (off - EXACT_PX) <= expected) {
        return r->cover_q16 >= (sharp ? DECIDED_COVER : BLURRED_COVER);
    }
    if (10 * (off - MOST_OFF_PX) > expected) {
        return 0;
    }
    return sharp ? r->cover_q16 >= SURE_COVER
                 : r->orientation_resolved && expected >= EVIDENT_PX && r->cover_q16 >= EVIDENT_COVER &&
                       r->quality.reliability_q16 >= EVIDENT_RELIABILITY;
}

/* How much a result is worth: 0 without a pose; more where it is sure; most when the inner part decides, too; and then
 * by cover, less the share by which the inner part's size is off. What is not sure is worth a quarter more with an
 * inner part, and another one where that decides. */
static int32_t worth(const drogue_result *r, const drogue_model *model)
{
    int64_t expected;
    int64_t off;
    if (r->status != DROGUE_OK) {
        return 0;
    }
    if (!drogue_result_sure(r, model)) {
        return 1 + r->cover_q16 + (r->has_inner + decided(r)) * (DROGUE_Q16_ONE / 4);
    }
    if (!sizes(&expected, &off, r, model)) {
        return SURE + r->cover_q16;
    }
    off = drogue_div_round_s64(off * DROGUE_Q16_ONE, expected > 0 ? expected : 1);
    return (decided(r) ? 5 * DROGUE_Q16_ONE : 3 * DROGUE_Q16_ONE) + r->cover_q16 -
           (int32_t)(off < DROGUE_Q16_ONE ? off : DROGUE_Q16_ONE);
}

/* Is a pose good enough to look at nothing else but larger outlines about it? */
static int settles(const drogue_result *r, const drogue_model *model)
{
    int64_t expected;
    int64_t off;
    if (r->cover_q16 < SETTLED_COVER || !drogue_result_sure(r, model)) {
        return 0;
    }
    return model->inner_radius_m_q16 == 0 ||
           (decided(r) && sizes(&expected, &off, r, model) && 16 * (off - MOST_OFF_PX / 2) <= expected);
}

/* What is kept of the best measurement. */
typedef struct best_seen {
    int32_t worth;
    int32_t where; /* it was measured: by place() */
    drogue_q16 a_px_q16;
    drogue_q16 xc_px_q16;
    drogue_q16 yc_px_q16;
    drogue_q16 inner_x_px_q16;
    drogue_q16 inner_y_px_q16;
    drogue_q16 inner_px_q16; /* its radius where it decides and the outline is sure; else 0 */
} best_seen;

static int within(drogue_q16 x, drogue_q16 y, drogue_q16 of_x, drogue_q16 of_y, drogue_q16 px_q16)
{
    return drogue_square_sum(drogue_q16_sub(x, of_x), drogue_q16_sub(y, of_y)) < drogue_square_sum(px_q16, 0);
}

/* Is an outline a ring about the inner part of a larger one, as its coupling's? */
static int is_part(const best_seen *small, const best_seen *large)
{
    return 5 * (int64_t)small->a_px_q16 < 4 * (int64_t)large->a_px_q16 &&
           small->a_px_q16 < 2 * (int64_t)large->inner_px_q16 &&
           within(small->xc_px_q16, small->yc_px_q16, large->inner_x_px_q16, large->inner_y_px_q16,
                  large->inner_px_q16 / 2);
}

/* Keep a result that is worth more; returns whether it is. Of two sure outlines about one inner part the larger one is
 * more likely the rim, and the other an edge of the canopy; what is a part of a larger outline is none. */
static int keep_better(best_seen *best, const drogue_result *r, int32_t where, const drogue_model *model)
{
    const int64_t was = best->a_px_q16;
    best_seen now;
    int32_t own;
    int32_t other = best->worth;
    now.worth = own = worth(r, model);
    now.where = where;
    now.a_px_q16 = r->ellipse.a_px_q16;
    now.xc_px_q16 = r->ellipse.xc_px_q16;
    now.yc_px_q16 = r->ellipse.yc_px_q16;
    now.inner_x_px_q16 = r->inner.x_px_q16;
    now.inner_y_px_q16 = r->inner.y_px_q16;
    now.inner_px_q16 = own > SURE && decided(r) ? drogue_sat_s32(radius_of(&r->inner)) : 0;
    if (r->has_inner && own > SURE && other > SURE &&
        within(now.inner_x_px_q16, now.inner_y_px_q16, best->inner_x_px_q16, best->inner_y_px_q16, DROGUE_Q16_ONE)) {
        own += 8 * (int64_t)now.a_px_q16 > 9 * was ? LARGER : 0;
        other += 9 * (int64_t)now.a_px_q16 < 8 * was ? LARGER : 0;
    }
    if (is_part(&now, best) || (own <= other && !is_part(best, &now))) {
        return 0;
    }
    *best = now;
    return 1;
}

/* Is a sighting one of a larger outline about the same middle? */
static int surrounds(const drogue_sighting *s, const drogue_sighting *what)
{
    const int32_t dx = s->x_px - what->x_px;
    const int32_t dy = s->y_px - what->y_px;
    const int32_t within = what->radius_px / 4 + 1;
    return 8 * s->radius_px > 9 * what->radius_px && s->radius_px < 2 * what->radius_px && dx <= within &&
           dx >= -within && dy <= within && dy >= -within;
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

/* Sightings in the region asked for, in coordinates of the image. */
static drogue_status search_part(drogue_search *search, const drogue_image *image, const drogue_region *region)
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
    for (i = drogue_search_end(search) - 1; i >= 0; i--) {
        drogue_sighting *c = &search->best[i];
        c->x_px += part.x_px;
        c->y_px += part.y_px;
        c->region.x_px += part.x_px;
        c->region.y_px += part.y_px;
    }
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

#define WHOLE (DROGUE_SEARCH_MAX + WIDER)

/* Regions that are measured, by number: those of the sightings, larger ones about the first of them, what is asked
 * for. */
static void place(drogue_region *out, int32_t where, const drogue_search *search, const drogue_region *region,
                  const drogue_image *image)
{
    if (where == WHOLE) {
        put_asked(out, region, image);
    } else if (where < DROGUE_SEARCH_MAX) {
        *out = search->best[where].region;
    } else {
        *out = search->best[where - DROGUE_SEARCH_MAX].region;
        widen(out); /* what was sighted may be an edge within the drogue */
    }
}

/* Is the part that was searched measured itself when nothing sighted decides? */
static int measures_whole(const drogue_search *search, const drogue_model *model)
{
    return model->inner_radius_m_q16 == 0 || (search->width_px <= MOST_WHOLE_PX && search->rows_in <= MOST_WHOLE_PX);
}

drogue_status drogue_acquire(drogue_result *out, drogue_search *search, drogue_workspace *workspace,
                             const drogue_setup *setup, const drogue_image *image, const drogue_region *region)
{
    drogue_status status;
    best_seen best;
    drogue_region asked;
    const drogue_sighting *settled = NULL; /* after which only larger ones about it are looked at */
    int current = 0;                       /* is the best what was measured last? */
    int32_t i;
    memset(out, 0, sizeof *out);
    memset(&best, 0, sizeof best);
    if (image->data == NULL || image->stride < image->width_px) {
        out->status = DROGUE_E_ARGUMENT;
        return out->status;
    }
    status = search_part(search, image, region);
    if (status != DROGUE_OK) {
        out->status = status;
        return status;
    }
    out->status = DROGUE_E_NO_INNER_PART;
    for (i = 0; i < search->count; i++) {
        if (settled != NULL && (setup->model->inner_radius_m_q16 == 0 || !surrounds(&search->best[i], settled))) {
            continue;
        }
        (void)drogue_measure(out, workspace, setup, image, &search->best[i].region);
        current = keep_better(&best, out, i, setup->model);
        if (current && (settled != NULL || settles(out, setup->model))) {
            settled = &search->best[i];
        }
    }
    for (i = 0; i < WIDER && i < search->count && best.worth <= SURE && setup->model->inner_radius_m_q16 > 0; i++) {
        place(&asked, DROGUE_SEARCH_MAX + i, search, region, image);
        if (drogue_workspace_spans(workspace, &asked, image)) {
            (void)drogue_measure(out, workspace, setup, image, &asked);
            current = keep_better(&best, out, DROGUE_SEARCH_MAX + i, setup->model);
        }
    }
    if (best.worth <= SURE && measures_whole(search, setup->model)) {
        place(&asked, WHOLE, search, region, image);
        (void)drogue_measure(out, workspace, setup, image, &asked);
        current = keep_better(&best, out, WHOLE, setup->model);
    }
    if (best.worth > 0 && !current) { /* again, so that the workspace holds its points */
        place(&asked, best.where, search, region, image);
        (void)drogue_measure(out, workspace, setup, image, &asked);
    }
    if (out->status == DROGUE_OK && !drogue_result_sure(out, setup->model)) {
        out->status = DROGUE_E_UNSURE;
    }
    return out->status;
}
