/* SPDX-License-Identifier: Apache-2.0 */
/* One frame: front end, outline, inner part, pose. */
#include "drogue/drogue.h"

#include <string.h>

#include "drogue/decide.h"
#include "drogue/inner.h"
#include "drogue/undistort.h"

#define TEXT(x) #x
#define VERSION_TEXT(major, minor, patch) TEXT(major) "." TEXT(minor) "." TEXT(patch)

const char *drogue_version(void)
{
    return VERSION_TEXT(DROGUE_VERSION_MAJOR, DROGUE_VERSION_MINOR, DROGUE_VERSION_PATCH);
}

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

static drogue_status run_frontend(drogue_edge_list *list, drogue_workspace *workspace, const drogue_config *config,
                                  int32_t canny_low, int32_t canny_high, const drogue_image *view,
                                  const drogue_mask *mask)
{
    drogue_frontend_config front;
    drogue_frontend frontend;
    drogue_status status;
    int32_t y;
    front.canny_low = canny_low;
    front.canny_high = canny_high;
    front.smooth = config->smooth;
    front.use_ring = 1;
    front.ring = *mask;
    front.min_arc_px = (uint32_t)drogue_shr_round_s64((int64_t)config->min_arc_share_q16 * mask->longest_px, 16);
    if (front.min_arc_px < config->min_arc_px) {
        front.min_arc_px = config->min_arc_px;
    }
    status = drogue_frontend_begin(&frontend, workspace, &front, view->width_px, view->height_px);
    if (status != DROGUE_OK) {
        return status;
    }
    for (y = 0; y < view->height_px; y++) {
        drogue_frontend_row(&frontend, drogue_image_row(view, y));
    }
    return drogue_frontend_end(list, &frontend);
}

/* Does the ring mask hold the whole outline? */
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

/* A frame on its way. */
typedef struct frame {
    drogue_result *out;
    drogue_workspace *workspace;
    const drogue_setup *setup;
    const drogue_image *image;
    drogue_image view; /* the region's pixels */
    drogue_mask mask;
    drogue_outline outline;
    drogue_second_look second_look;
    int32_t canny_low;
    int32_t canny_high;
    int32_t tried;
    int32_t too_large;    /* the inner disc is seen, but too large for the outline */
    drogue_q16 doubt_q16; /* by what share the inner disc's size is off; 1 and more: not seen, or no outline */
} frame;

static drogue_status find_outline(frame *f, const drogue_region *region)
{
    drogue_result *out = f->out;
    drogue_status status = place_region(&out->region, &f->mask, f->image, region);
    if (status != DROGUE_OK) {
        return status;
    }
    f->view.data = drogue_image_row(f->image, out->region.y_px) + out->region.x_px;
    f->view.width_px = out->region.width_px;
    f->view.height_px = out->region.height_px;
    f->view.stride = f->image->stride;
    status = run_frontend(&out->list, f->workspace, f->setup->config, f->canny_low, f->canny_high, &f->view, &f->mask);
    return status == DROGUE_OK ? drogue_outline_find(&f->outline, f->workspace, &out->list, &f->mask, f->setup->config)
                               : status;
}

/* Is one ellipse about where the other is, and about as large: within a third of its semi-axis? Each in the coordinates
 * of its own region. */
static int about_the_same(const drogue_ellipse *e, const drogue_region *at, const drogue_ellipse *was,
                          const drogue_region *was_at)
{
    const drogue_q16 most = was->a_px_q16 / 3;
    const drogue_q16 dx =
        drogue_sat_s32((int64_t)e->xc_px_q16 - was->xc_px_q16 + (int64_t)(at->x_px - was_at->x_px) * DROGUE_Q16_ONE);
    const drogue_q16 dy =
        drogue_sat_s32((int64_t)e->yc_px_q16 - was->yc_px_q16 + (int64_t)(at->y_px - was_at->y_px) * DROGUE_Q16_ONE);
    const int64_t da = (int64_t)e->a_px_q16 - was->a_px_q16;
    return da <= most && da >= -most && drogue_square_sum(dx, dy) <= drogue_square_sum(most, 0);
}

/* Look for an outline once more, in a region that suits it. */
static drogue_second_look look_again(frame *f)
{
    const drogue_ellipse was = f->outline.ellipse;
    const drogue_region was_at = f->out->region;
    const drogue_q16 cover_q16 = f->outline.cover_q16;
    const drogue_region better = region_about(&was, &was_at);
    if ((uint32_t)better.width_px > f->workspace->capacity.width_px) {
        return DROGUE_SECOND_TOO_WIDE;
    }
    switch (find_outline(f, &better)) {
    case DROGUE_OK: break;
    case DROGUE_E_LABELS_FULL:
    case DROGUE_E_EDGES_FULL:
    case DROGUE_E_ARCS_FULL: return DROGUE_SECOND_FULL;
    case DROGUE_E_REGION: return DROGUE_SECOND_REGION;
    default: return DROGUE_SECOND_NO_MORE;
    }
    return f->outline.cover_q16 >= cover_q16 && about_the_same(&f->outline.ellipse, &f->out->region, &was, &was_at)
               ? DROGUE_SECOND_BETTER
               : DROGUE_SECOND_NO_MORE;
}

/* An outline that the ring mask cuts is looked for once more; unless that is better, what was found first stands. */
static drogue_status find_outline_twice(frame *f, const drogue_region *region)
{
    const drogue_config *config = f->setup->config;
    const drogue_status first = find_outline(f, region);
    const drogue_q16 cover_q16 = f->outline.cover_q16;
    f->second_look = DROGUE_SECOND_NONE;
    if ((first != DROGUE_OK && first != DROGUE_E_NO_ELLIPSE) ||
        cover_q16 < drogue_shr_round_s64(config->min_cover_q16, 1) || cover_q16 >= config->recentre_cover_q16 ||
        ring_holds(&f->outline.ellipse, &f->mask)) {
        return first;
    }
    f->second_look = look_again(f);
    switch (f->second_look) {
    case DROGUE_SECOND_BETTER: return DROGUE_OK;
    case DROGUE_SECOND_TOO_WIDE: return first; /* it was not begun */
    default: return find_outline(f, region);
    }
}

static drogue_q16 shifted(drogue_q16 v_px_q16, int32_t by_px)
{
    return drogue_q16_add(v_px_q16, drogue_q16_from_int(by_px));
}

static void describe(drogue_result *out, const drogue_outline *outline)
{
    memcpy(out->arcs, outline->arcs, sizeof out->arcs);
    out->quality = outline->quality;
    out->polarity = outline->polarity;
    out->cluster_members = outline->cluster_members;
    out->refit_points = outline->refit_points;
    out->cover_q16 = outline->cover_q16;
    out->ellipse = outline->ellipse;
    out->ellipse.xc_px_q16 = shifted(out->ellipse.xc_px_q16, out->region.x_px);
    out->ellipse.yc_px_q16 = shifted(out->ellipse.yc_px_q16, out->region.y_px);
    out->ideal = out->ellipse;
}

#define SEEN_TO_PX_Q16 DROGUE_Q16(1, 2) /* blur and what touches the inner disc move its edge by so much */

/* Find the inner part where a pose expects it, weigh it, and see which pose it is nearer to. */
static void find_inner(drogue_evidence *evidence, frame *f)
{
    drogue_result *out = f->out;
    const drogue_ellipse *outline = &f->outline.ellipse;
    drogue_inner_evidence inner;
    drogue_inner_expected expected;
    drogue_inner_edge edge;
    memset(&inner, 0, sizeof inner);
    drogue_inner_expect(&expected, evidence->poses, f->setup, out->region.x_px, out->region.y_px);
    if (drogue_inner_edge_find(&edge, f->workspace->rays, &f->view, &expected, outline, f->setup->config) ==
        DROGUE_OK) {
        drogue_inner_weigh(&inner, &edge, &out->region, &expected, outline, evidence->poses, f->setup);
        evidence->inner = inner.weighed;
        evidence->nearer = inner.nearer;
        out->inner = inner.part;
        out->has_inner = inner.weighed.std_px_q16 > 0;
        out->ambiguity_q16 = inner.ambiguity_q16;
        f->too_large = inner.too_large;
    }
    f->doubt_q16 = DROGUE_Q16_ONE;
    if (out->has_inner) {
        const drogue_q16 off_px_q16 = edge.grown_px_q16 < 0 ? -edge.grown_px_q16 : edge.grown_px_q16;
        f->doubt_q16 =
            off_px_q16 <= SEEN_TO_PX_Q16 ? 0 : drogue_q16_div(off_px_q16, expected.disc[edge.which].a_px_q16);
    }
}

/* Decide between the poses; the result has what was decided. */
static drogue_status decide(drogue_result *out, const drogue_evidence *evidence, const drogue_setup *setup)
{
    drogue_decision decision;
    drogue_status status = drogue_decide(&decision, evidence, setup);
    if (status == DROGUE_OK) {
        out->pose = decision.pose;
        out->alternative = decision.alternative;
        out->orientation_resolved = decision.orientation_resolved;
        memcpy(out->covariance_q48, decision.covariance_q48, sizeof out->covariance_q48);
        memcpy(out->position_std_m_q32, decision.position_std_m_q32, sizeof out->position_std_m_q32);
        out->axis_std_rad_q32 = decision.axis_std_rad_q32;
    }
    return status;
}

static void clear(drogue_result *out)
{
    int k;
    memset(out, 0, sizeof *out);
    out->ambiguity_q16 = DROGUE_Q16_ONE;
    for (k = 0; k < 4; k++) {
        out->arcs[k] = DROGUE_NO_ARC;
    }
}

/* From the outline to the pose. */
static drogue_status judge(frame *f)
{
    const drogue_setup *setup = f->setup;
    drogue_result *out = f->out;
    drogue_evidence evidence;
    drogue_status status;
    drogue_outline_pull(&f->outline, f->workspace->rays, &f->view, setup->config);
    describe(out, &f->outline);
    out->tried = f->tried;
    if (drogue_camera_distorts(setup->camera)) {
        status = drogue_outline_undistorted(&out->ideal, &f->outline, f->workspace, &out->list, setup, out->region.x_px,
                                            out->region.y_px);
        if (status != DROGUE_OK) {
            memset(&out->ideal, 0, sizeof out->ideal);
            return DROGUE_E_NO_ELLIPSE;
        }
    }
    memset(&evidence, 0, sizeof evidence);
    evidence.ideal = out->ideal;
    evidence.support = &f->outline.support;
    status = drogue_pose_from_ellipse(evidence.poses, &out->ideal, setup->camera, setup->model->rim_radius_m_q16);
    if (status != DROGUE_OK) {
        return status;
    }
    f->doubt_q16 = 0;
    if (setup->model->inner_radius_m_q16 > 0) {
        find_inner(&evidence, f);
    }
    return decide(out, &evidence, setup);
}

/* What may be tried, in this order: the configured thresholds of Canny or those of the region's own noise, and of either
 * the outline found or a larger one about it. */
enum { FIRST, FIRST_LARGER, LOWER, LOWER_LARGER, TRIES };

static drogue_status try_out(frame *f, const drogue_region *region, int what, int looked)
{
    drogue_status status = DROGUE_OK;
    f->doubt_q16 = DROGUE_Q16_MAX;
    f->tried = what;
    f->too_large = 0;
    if (!looked) {
        clear(f->out);
        status = find_outline_twice(f, region);
    }
    if (status == DROGUE_OK && (what == FIRST_LARGER || what == LOWER_LARGER)) {
        const drogue_region used = f->out->region;
        const drogue_edge_list list = f->out->list;
        clear(f->out);
        f->out->region = used;
        f->out->list = list;
        if (!drogue_outline_enlarge(&f->outline, f->workspace, &f->out->list, &f->mask, f->setup->config)) {
            return DROGUE_E_NO_ELLIPSE;
        }
    }
    return status == DROGUE_OK ? judge(f) : status;
}

/* 1 when there are thresholds lower than the configured ones. */
static int lower_thresholds(frame *f)
{
    const drogue_config *config = f->setup->config;
    int32_t high = drogue_noise_threshold(f->workspace->histogram, &f->view);
    high = high < config->canny_least ? config->canny_least : high;
    f->canny_low = config->canny_low;
    f->canny_high = config->canny_high;
    if (high < config->canny_high) {
        f->canny_low = (int32_t)((int64_t)high * config->canny_low / config->canny_high);
        f->canny_high = high;
    }
    return high < config->canny_high;
}

#define SURE_Q16 DROGUE_Q16(4, 100)    /* the inner disc is of its size to this */
#define CLEARLY_Q16 DROGUE_Q16(1, 256) /* a later try is better by more than this */

/* Take back what was measured. */
static void refuse(drogue_result *out)
{
    const drogue_region used = out->region;
    const drogue_edge_list list = out->list;
    const int32_t tried = out->tried;
    clear(out);
    out->region = used;
    out->list = list;
    out->tried = tried;
}

/* Measure; while the inner disc is not seen or not of its size, try what else the outline may be. What has the disc
 * nearest to its size stands. */
static drogue_status measure(frame *f, const drogue_region *region)
{
    const drogue_config *config = f->setup->config;
    drogue_q16 least_q16 = DROGUE_Q16_MAX;
    drogue_status status = DROGUE_OK;
    int best = FIRST;
    int last = -1;
    int what;
    f->canny_low = config->canny_low;
    f->canny_high = config->canny_high;
    for (what = FIRST; what < TRIES && least_q16 > SURE_Q16; what++) {
        const int larger = what == FIRST_LARGER || what == LOWER_LARGER;
        if (larger && status != DROGUE_OK) {
            continue;
        }
        if (what == LOWER && !lower_thresholds(f)) {
            break;
        }
        status = try_out(f, region, what, larger);
        last = what;
        if (what == FIRST && status != DROGUE_OK && status != DROGUE_E_NO_ELLIPSE && status != DROGUE_E_NO_EDGES &&
            status != DROGUE_E_NO_ARCS) {
            return status;
        }
        if (f->doubt_q16 < least_q16 - CLEARLY_Q16) {
            least_q16 = f->doubt_q16;
            best = what;
        }
    }
    if (best != last) {
        if (best < LOWER) {
            f->canny_low = config->canny_low;
            f->canny_high = config->canny_high;
        }
        status = try_out(f, region, best, 0);
    }
    if (status == DROGUE_OK && f->too_large) { /* an edge within the drogue: the canopy's inner one, or its wall's */
        refuse(f->out);
        return DROGUE_E_NO_ELLIPSE;
    }
    return status;
}

static int valid(const drogue_image *image, const drogue_setup *setup)
{
    return image->data != NULL && image->width_px >= 1 && image->height_px >= 1 && image->stride >= image->width_px &&
           setup->camera->fx_px_q16 > 0 && setup->camera->fy_px_q16 > 0 && setup->model->rim_radius_m_q16 > 0 &&
           setup->model->inner_radius_m_q16 >= 0 && drogue_config_valid(setup->config);
}

drogue_status drogue_measure(drogue_result *out, drogue_workspace *workspace, const drogue_setup *setup,
                             const drogue_image *image, const drogue_region *region)
{
    frame f;
    clear(out);
    memset(&f, 0, sizeof f);
    f.out = out;
    f.workspace = workspace;
    f.setup = setup;
    f.image = image;
    out->status = valid(image, setup) ? measure(&f, region) : DROGUE_E_ARGUMENT;
    out->second_look = f.second_look;
    return out->status;
}
