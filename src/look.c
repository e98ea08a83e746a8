/* SPDX-License-Identifier: Apache-2.0 */
/* Region, front end, outline; and the second look at an outline that the ring cuts. */
#include "look.h"

#include <string.h>

#include "drogue/frontend.h"
#include "drogue/inner.h"

/* Parts of a semi-axis within which one ellipse is the other. */
#define SAME_AGAIN 3  /* of a second look: the first one's arcs were cut, and tell its size roughly */
#define AS_ALLOWED 10 /* of a disc's outline: the guess that was settled is good to some per cent of its size, */
#define THERE 8       /* and to this part in its place */

#define THIN 5 /* eighths of min_cover are enough about a disc: every other panel may be as bright as what is behind */

#define OUTER_Q16 DROGUE_Q16(3, 4)  /* least cover of an outer edge of the rim, */
#define OUTER_BAND DROGUE_Q16(1, 1) /* px: and half the width of the band about it that points along rays lie in */

/* Clip the region to the image; the mask stays that of the region asked for, in the clipped one's coordinates. */
static drogue_status place_region(drogue_region *clipped, drogue_mask *mask, const drogue_image *image,
                                  const drogue_region *region)
{
    const int32_t far_px = 1 << 20;
    drogue_region r = *region;
    if (r.width_px < 1 || r.height_px < 1 || r.width_px > DROGUE_MAX_REGION || r.height_px > DROGUE_MAX_REGION ||
        r.x_px > far_px || r.x_px < -far_px || r.y_px > far_px || r.y_px < -far_px) {
        return DROGUE_E_REGION;
    }
    drogue_clip(&r.x_px, &r.width_px, image->width_px);
    drogue_clip(&r.y_px, &r.height_px, image->height_px);
    if (r.width_px < 1 || r.height_px < 1 || r.width_px > DROGUE_MAX_SIDE || r.height_px > DROGUE_MAX_SIDE ||
        r.x_px + r.width_px > INT16_MAX || r.y_px + r.height_px > INT16_MAX) { /* coordinates are Q16 */
        return DROGUE_E_REGION;
    }
    *mask = drogue_mask_of_size(region->width_px, region->height_px);
    mask->centre2_x += 2 * (region->x_px - r.x_px);
    mask->centre2_y += 2 * (region->y_px - r.y_px);
    *clipped = r;
    return DROGUE_OK;
}

static drogue_status run_frontend(drogue_frame *f)
{
    const drogue_config *config = f->setup->config;
    const drogue_image *view = &f->view;
    drogue_frontend_config front;
    drogue_frontend frontend;
    drogue_status status;
    int32_t y;
    front.canny_high = f->canny_high;
    front.canny_low =
        config->canny_high > 0 ? (int32_t)((int64_t)f->canny_high * config->canny_low / config->canny_high) : 0;
    front.smooth = config->smooth;
    front.use_ring = 1;
    front.ring = f->mask;
    front.min_arc_px = (uint32_t)drogue_shr_round_s64((int64_t)config->min_arc_share_q16 * f->mask.longest_px, 16);
    if (front.min_arc_px < config->min_arc_px) {
        front.min_arc_px = config->min_arc_px;
    }
    status = drogue_frontend_begin(&frontend, f->workspace, &front, view->width_px, view->height_px);
    if (status != DROGUE_OK) {
        return status;
    }
    for (y = 0; y < view->height_px; y++) {
        drogue_frontend_row(&frontend, drogue_image_row(view, y));
    }
    return drogue_frontend_end(&f->list, &frontend);
}

/* Does the ring mask, from a third to half of the longest side, hold the whole outline with a pixel to spare? */
static int ring_holds(const drogue_ellipse *e, const drogue_mask *mask)
{
    const drogue_q16 dx = drogue_sat_s32((int64_t)e->xc_px_q16 - (int64_t)mask->centre2_x * (DROGUE_Q16_ONE / 2));
    const drogue_q16 dy = drogue_sat_s32((int64_t)e->yc_px_q16 - (int64_t)mask->centre2_y * (DROGUE_Q16_ONE / 2));
    const int64_t off = (int64_t)drogue_isqrt_u64(drogue_square_sum(dx, dy));
    const int64_t longest = (int64_t)mask->longest_px * DROGUE_Q16_ONE;
    return 2 * (e->a_px_q16 + off + DROGUE_Q16_ONE) <= longest && 3 * (e->b_px_q16 - off - DROGUE_Q16_ONE) >= longest;
}

/* Square region whose ring mask suits an outline found in another region. */
static drogue_region region_about(const drogue_ellipse *e, const drogue_region *found_in)
{
    const int64_t least = 2 * (int64_t)e->a_px_q16 + 4 * DROGUE_Q16_ONE;
    const int64_t middle = (2 * (int64_t)e->a_px_q16 + 3 * (int64_t)e->b_px_q16) / 2;
    const int32_t side = (int32_t)drogue_shr_round_s64(middle > least ? middle : least, 16);
    drogue_region r;
    r.x_px = found_in->x_px + (int32_t)drogue_shr_round_s64((int64_t)e->xc_px_q16 - (int64_t)(side - 1) * 32768, 16);
    r.y_px = found_in->y_px + (int32_t)drogue_shr_round_s64((int64_t)e->yc_px_q16 - (int64_t)(side - 1) * 32768, 16);
    r.width_px = side;
    r.height_px = side;
    return r;
}

drogue_status drogue_frame_view(drogue_frame *f, const drogue_region *region)
{
    drogue_result *out = f->out;
    drogue_status status = place_region(&out->region, &f->mask, f->image, region);
    if (status == DROGUE_OK) {
        f->view.data = drogue_image_row(f->image, out->region.y_px) + out->region.x_px;
        f->view.width_px = out->region.width_px;
        f->view.height_px = out->region.height_px;
        f->view.stride = f->image->stride;
    }
    return status;
}

drogue_status drogue_frame_edges(drogue_frame *f, const drogue_region *region)
{
    const drogue_status status = drogue_frame_view(f, region);
    if (status != DROGUE_OK) {
        return status;
    }
    f->held.region = *region;
    f->held.canny_high = f->canny_high;
    return run_frontend(f);
}

/* Are edges everywhere, a quarter of the ring's pixels, 7/16 of a square region's? Outlines show in them by chance. */
static int is_crowded(const drogue_frame *f)
{
    return 4 * 16 * (int64_t)f->list.edge_count > 7 * (int64_t)f->view.width_px * f->view.height_px;
}

static drogue_status find_outline(drogue_frame *f, const drogue_region *region)
{
    const drogue_status status = drogue_frame_edges(f, region);
    return status == DROGUE_OK ? drogue_outline_find(&f->outline, f->workspace, &f->list, &f->mask, f->setup->config)
                               : status;
}

/* Is one ellipse about where the other is, and about as large: within parts of its semi-axis? Each in the coordinates
 * of its own region, of which the one's lies (x, y) beside the other's. */
static int about_the_same(const drogue_ellipse *e, const drogue_ellipse *was, int32_t x_px, int32_t y_px, int32_t there,
                          int32_t as_large)
{
    const drogue_q16 away = was->a_px_q16 / there;
    const drogue_q16 most = was->a_px_q16 / as_large;
    const drogue_q16 dx = drogue_sat_s32((int64_t)e->xc_px_q16 - was->xc_px_q16 + (int64_t)x_px * DROGUE_Q16_ONE);
    const drogue_q16 dy = drogue_sat_s32((int64_t)e->yc_px_q16 - was->yc_px_q16 + (int64_t)y_px * DROGUE_Q16_ONE);
    const int64_t da = (int64_t)e->a_px_q16 - was->a_px_q16;
    return da <= most && da >= -most && drogue_square_sum(dx, dy) <= drogue_square_sum(away, 0);
}

/* Look for an outline once more, in a region that suits what was found. */
static drogue_second_look look_again(drogue_frame *f, const drogue_outline *was)
{
    const int32_t x_px = f->out->region.x_px;
    const int32_t y_px = f->out->region.y_px;
    const drogue_region better = region_about(&was->ellipse, &f->out->region);
    drogue_status status;
    if (!drogue_workspace_spans(f->workspace, &better, f->image)) {
        return DROGUE_SECOND_TOO_WIDE;
    }
    status = find_outline(f, &better);
    if (status != DROGUE_OK) {
        return drogue_status_full(status)  ? DROGUE_SECOND_FULL
               : status == DROGUE_E_REGION ? DROGUE_SECOND_REGION
                                           : DROGUE_SECOND_NO_MORE;
    }
    return f->outline.cover_q16 >= was->cover_q16 &&
                   about_the_same(&f->outline.ellipse, &was->ellipse, f->out->region.x_px - x_px,
                                  f->out->region.y_px - y_px, SAME_AGAIN, SAME_AGAIN)
               ? DROGUE_SECOND_BETTER
               : DROGUE_SECOND_NO_MORE;
}

drogue_status drogue_frame_outline(drogue_frame *f, const drogue_region *region)
{
    const drogue_config *config = f->setup->config;
    const drogue_status first = find_outline(f, region);
    const drogue_outline found = f->outline;
    f->crowded = is_crowded(f);
    f->second_look = DROGUE_SECOND_NONE;
    if ((first != DROGUE_OK && first != DROGUE_E_NO_ELLIPSE) ||
        found.cover_q16 < drogue_shr_round_s64(config->min_cover_q16, 1) ||
        found.cover_q16 >= config->recentre_cover_q16 || ring_holds(&f->outline.ellipse, &f->mask)) {
        return first;
    }
    f->second_look = look_again(f, &found);
    switch (f->second_look) {
    case DROGUE_SECOND_BETTER: return DROGUE_OK;
    case DROGUE_SECOND_REGION:
    case DROGUE_SECOND_TOO_WIDE: return first; /* it was not begun */
    default: break;
    }
    f->outline = found;
    if (first == DROGUE_OK) {
        return drogue_frame_edges(f, region);
    }
    (void)drogue_frame_view(f, region);
    return first;
}

void drogue_frame_move(drogue_ellipse *e, int32_t x_px, int32_t y_px)
{
    e->xc_px_q16 = drogue_q16_add(e->xc_px_q16, drogue_q16_from_int(x_px));
    e->yc_px_q16 = drogue_q16_add(e->yc_px_q16, drogue_q16_from_int(y_px));
}

/* View where an outline was found; returns that in its coordinates. */
static drogue_ellipse view_again(drogue_frame *f, const drogue_region *region, const drogue_ellipse *was)
{
    drogue_ellipse here = *was;
    (void)drogue_frame_view(f, region);
    drogue_outline_clear(&f->outline);
    drogue_frame_move(&here, -f->out->region.x_px, -f->out->region.y_px);
    return here;
}

/* Is there room for edge points along rays? */
static int bears_rays(const drogue_workspace *workspace)
{
    return workspace->capacity.edges >= DROGUE_INNER_BEYOND_POINTS;
}

/* Is there an outline about an ellipse? */
static int settles_about(drogue_frame *f, const drogue_ellipse *about, drogue_q16 band_px_q16,
                         drogue_q16 least_cover_q16)
{
    return drogue_outline_settle(&f->outline, about, band_px_q16, least_cover_q16, f->workspace, &f->list, &f->mask,
                                 f->setup->config);
}

/* The outline about an ellipse by edge points along rays, which the workspace holds now in place of the edges. */
static drogue_status settle_on_rays(drogue_frame *f, const drogue_region *region, const drogue_ellipse *about,
                                    uint32_t points, drogue_q16 band_px_q16)
{
    f->held.region = *region;
    f->held.canny_high = DROGUE_BY_RAYS;
    f->list.arc_count = 0;
    f->list.edge_count = points;
    return points > 0 && settles_about(f, about, band_px_q16, f->setup->config->min_cover_q16) ? DROGUE_OK
                                                                                               : DROGUE_E_NO_ELLIPSE;
}

drogue_status drogue_frame_beyond(drogue_frame *f, const drogue_region *region, const drogue_ellipse *was,
                                  drogue_q16 larger_q16)
{
    const drogue_q16 by_px_q16 = drogue_q16_mul(was->a_px_q16, larger_q16);
    drogue_ellipse about = view_again(f, region, was);
    about.a_px_q16 = drogue_q16_add(about.a_px_q16, by_px_q16);
    about.b_px_q16 = drogue_q16_add(about.b_px_q16, by_px_q16);
    return bears_rays(f->workspace)
               ? settle_on_rays(f, region, &about, drogue_inner_beyond(f->workspace, &f->view, &about, by_px_q16), 0)
               : DROGUE_E_EDGES_FULL;
}

/* Is an outline larger than the one within by half of what was seen, or back at that one? */
static int has_grown(const drogue_ellipse *e, const drogue_ellipse *was, const drogue_ellipse *seen)
{
    return 2 * ((int64_t)e->a_px_q16 + e->b_px_q16) >=
           (int64_t)was->a_px_q16 + was->b_px_q16 + seen->a_px_q16 + seen->b_px_q16;
}

drogue_status drogue_frame_outer(drogue_frame *f, const drogue_region *region, const drogue_ellipse *was)
{
    drogue_ellipse about = view_again(f, region, was);
    const drogue_ellipse *e = &f->outline.ellipse;
    const drogue_config *config = f->setup->config;
    int32_t grown_q24[5];
    uint32_t points;
    if (!drogue_outline_outer(&about, grown_q24, f->workspace->rays, &f->view)) {
        return DROGUE_E_NO_ELLIPSE;
    }
    if (settles_about(f, &about, config->refit_band_px_q16, config->min_cover_q16) &&
        f->outline.cover_q16 >= OUTER_Q16) {
        drogue_outline_pull(&f->outline, f->workspace->rays, &f->view, config);
        if (has_grown(e, was, &about)) {
            return DROGUE_OK;
        }
    }
    if (!bears_rays(f->workspace)) {
        return DROGUE_E_EDGES_FULL;
    }
    points = drogue_inner_along(f->workspace, &f->view, &about);
    if (points == 0 || settle_on_rays(f, region, &about, points, OUTER_BAND) != DROGUE_OK ||
        f->outline.cover_q16 < OUTER_Q16 || !has_grown(e, was, &about)) {
        return DROGUE_E_NO_ELLIPSE;
    }
    f->outline.outer = 1;
    drogue_turn_pull(f->outline.support.pull_q24, grown_q24,
                     drogue_q16_sub(f->outline.fitted.angle_rad_q16, was->angle_rad_q16));
    return DROGUE_OK;
}

/* Of the outlines that a disc allows the one that edge points cover best. */
typedef struct best_ring {
    drogue_ellipse ring;
    drogue_q16 cover_q16;
    int32_t yaw; /* by which the drogue is turned, steps */
    int32_t pitch;
} best_ring;

/* Score the outlines about a disc of a drogue turned by so much and of one turned the opposite way. */
static void score(best_ring *best, const drogue_frame *f, const drogue_inner_sight *disc, int32_t yaw, int32_t pitch)
{
    drogue_inner_expected rims;
    uint32_t i;
    if (yaw * yaw + pitch * pitch > DROGUE_INNER_TURNS * DROGUE_INNER_TURNS) {
        return;
    }
    drogue_inner_rims(&rims, disc, yaw, pitch, f->setup, f->out->region.x_px, f->out->region.y_px);
    for (i = 0; i < rims.count; i++) {
        const drogue_q16 cover_q16 =
            drogue_outline_covered(&rims.disc[i], f->workspace, &f->list, &f->mask, f->setup->config);
        if (cover_q16 > best->cover_q16) {
            best->ring = rims.disc[i];
            best->cover_q16 = cover_q16;
            best->yaw = i == 0 ? yaw : -yaw;
            best->pitch = i == 0 ? pitch : -pitch;
        }
    }
}

/* The best of every second turn, and of those beside it. */
static void seek_ring(best_ring *best, const drogue_frame *f, const drogue_inner_sight *disc)
{
    const int32_t turns = DROGUE_INNER_TURNS;
    best_ring middle;
    int32_t yaw;
    int32_t pitch;
    for (yaw = 0; yaw <= turns; yaw++) { /* bound: 7; the opposite ones come with them */
        for (pitch = yaw == 0 ? 0 : -turns; pitch <= turns; pitch++) {
            if ((yaw + pitch) % 2 == 0) {
                score(best, f, disc, yaw, pitch);
            }
        }
    }
    middle = *best;
    for (yaw = -1; yaw <= 1 && middle.cover_q16 > 0; yaw++) {
        for (pitch = -1; pitch <= 1; pitch++) {
            if (yaw != 0 || pitch != 0) {
                score(best, f, disc, middle.yaw + yaw, middle.pitch + pitch);
            }
        }
    }
}

/* Is the ring mask, from a third to half of the longest side, made for an outline of that size: has it a twentieth of
 * the semi-axes to spare to either side? */
static int of_size(const drogue_ellipse *e, const drogue_mask *mask)
{
    const int64_t longest = 20 * (int64_t)mask->longest_px * DROGUE_Q16_ONE;
    return 2 * (20 + 1) * (int64_t)e->a_px_q16 <= longest && 3 * (20 - 1) * (int64_t)e->b_px_q16 >= longest;
}

/* Look for the inner disc in a region. */
static int seek_disc(drogue_inner_sight *sight, drogue_frame *f)
{
    drogue_ellipse disc;
    if (!drogue_inner_seek(&disc, f->workspace->rays, &f->view, &f->mask, f->setup)) {
        return 0;
    }
    drogue_frame_move(&disc, f->out->region.x_px, f->out->region.y_px);
    return drogue_inner_sight_of(sight, &disc, f->setup->camera);
}

/* Look for the inner disc in a region, then for edges in one that suits what outlines the disc allows, which becomes
 * the result's; choose of those outlines. DROGUE_E_NO_INNER_PART: there is no disc, and no edges were looked for. */
static drogue_status find_ring(best_ring *best, drogue_frame *f, const drogue_region *region)
{
    drogue_result *out = f->out;
    drogue_region about = *region;
    drogue_inner_sight disc;
    drogue_inner_expected rims;
    drogue_status status = drogue_frame_view(f, region);
    f->second_look = DROGUE_SECOND_NONE;
    memset(best, 0, sizeof *best);
    if (status != DROGUE_OK || !seek_disc(&disc, f)) {
        return DROGUE_E_NO_INNER_PART;
    }
    drogue_inner_rims(&rims, &disc, 0, 0, f->setup, out->region.x_px, out->region.y_px);
    if (rims.count > 0 && !of_size(&rims.disc[0], &f->mask)) {
        about = region_about(&rims.disc[0], &out->region);
    }
    if (!drogue_workspace_spans(f->workspace, &about, f->image)) {
        f->second_look = DROGUE_SECOND_TOO_WIDE;
        return DROGUE_E_NO_ELLIPSE;
    }
    status = drogue_frame_edges(f, &about);
    if (status == DROGUE_OK) {
        seek_ring(best, f, &disc);
    }
    return status;
}

drogue_status drogue_frame_about_disc(drogue_frame *f, const drogue_region *region)
{
    const drogue_q16 thin_q16 = (THIN * f->setup->config->min_cover_q16 + 4) / 8;
    best_ring best;
    const drogue_status status = find_ring(&best, f, region);
    f->ring_px_q16 = best.ring.a_px_q16;
    if (status != DROGUE_OK) {
        return status;
    }
    return settles_about(f, &best.ring, 0, thin_q16) &&
                   about_the_same(&f->outline.ellipse, &best.ring, 0, 0, THERE, AS_ALLOWED)
               ? DROGUE_OK
               : DROGUE_E_NO_ELLIPSE;
}
