/* SPDX-License-Identifier: Apache-2.0 */
/* One frame: front end, outline, inner part, pose. */
#include "drogue/drogue.h"

#include <string.h>

#include "drogue/joint.h"
#include "drogue/undistort.h"

#define TEXT(x) #x
#define VERSION_TEXT(major, minor, patch) TEXT(major) "." TEXT(minor) "." TEXT(patch)

const char *drogue_version(void)
{
    return VERSION_TEXT(DROGUE_VERSION_MAJOR, DROGUE_VERSION_MINOR, DROGUE_VERSION_PATCH);
}

static void clip(int32_t *at, int32_t *length, int32_t limit)
{
    int32_t end = *at + *length;
    *at = *at < 0 ? 0 : *at;
    *length = (end > limit ? limit : end) - *at;
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
    clip(&r.x_px, &r.width_px, image->width_px);
    clip(&r.y_px, &r.height_px, image->height_px);
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
                                  const drogue_image *view, const drogue_mask *mask)
{
    drogue_frontend_config front;
    drogue_frontend frontend;
    drogue_status status;
    int32_t y;
    front.canny_low = config->canny_low;
    front.canny_high = config->canny_high;
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
    const int64_t dx = (int64_t)e->xc_px_q16 - (int64_t)mask->centre2_x * (DROGUE_Q16_ONE / 2);
    const int64_t dy = (int64_t)e->yc_px_q16 - (int64_t)mask->centre2_y * (DROGUE_Q16_ONE / 2);
    const int64_t off = (int64_t)drogue_isqrt_u64((uint64_t)(dx * dx + dy * dy));
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
    drogue_image view; /* the region's pixels */
    drogue_mask mask;
    drogue_outline outline;
} frame;

static drogue_status find_outline(drogue_result *out, frame *f, drogue_workspace *workspace,
                                  const drogue_config *config, const drogue_image *image, const drogue_region *region)
{
    drogue_status status = place_region(&out->region, &f->mask, image, region);
    if (status != DROGUE_OK) {
        return status;
    }
    f->view.data = drogue_image_row(image, out->region.y_px) + out->region.x_px;
    f->view.width_px = out->region.width_px;
    f->view.height_px = out->region.height_px;
    f->view.stride = image->stride;
    status = run_frontend(&out->list, workspace, config, &f->view, &f->mask);
    return status == DROGUE_OK ? drogue_outline_find(&f->outline, workspace, &out->list, &f->mask, config) : status;
}

/* An outline that the ring mask cuts is looked for once more in a region that suits it. */
static drogue_status find_outline_twice(drogue_result *out, frame *f, drogue_workspace *workspace,
                                        const drogue_config *config, const drogue_image *image,
                                        const drogue_region *region)
{
    drogue_region better;
    drogue_status status = find_outline(out, f, workspace, config, image, region);
    if ((status != DROGUE_OK && status != DROGUE_E_NO_ELLIPSE) ||
        f->outline.cover_q16 < drogue_shr_round_s64(config->min_cover_q16, 1) ||
        f->outline.cover_q16 >= config->recentre_cover_q16 || ring_holds(&f->outline.ellipse, &f->mask)) {
        return status;
    }
    better = region_about(&f->outline.ellipse, &out->region);
    if ((uint32_t)better.width_px > workspace->capacity.width_px) {
        return status;
    }
    return find_outline(out, f, workspace, config, image, &better);
}

static drogue_q16 shifted(drogue_q16 v_px_q16, int32_t by_px)
{
    return drogue_q16_add(v_px_q16, drogue_q16_from_int(by_px));
}

/* Look for the inner part where either pose expects it, within a disc about the outline's centre of 5/6 of its
 * semi-minor axis. 'expected' returns the disc that fits, region coordinates. */
static drogue_status find_inner(drogue_result *out, drogue_ellipse *expected, frame *f, const drogue_pose poses[2],
                                drogue_workspace *workspace, const drogue_config *config, const drogue_camera *camera,
                                const drogue_model *model)
{
    const drogue_ellipse *outline = &f->outline.ellipse;
    drogue_ellipse discs[2];
    drogue_mask within; /* radius longest / 3 */
    drogue_status status;
    uint32_t count = 0;
    uint32_t which;
    int i;
    for (i = 0; i < 2; i++) {
        drogue_ellipse *e = &discs[count];
        if (drogue_inner_disc_image(e, &poses[i], camera, model) == DROGUE_OK && e->a_px_q16 >= DROGUE_Q16_ONE &&
            drogue_distort_point(&e->xc_px_q16, &e->yc_px_q16, camera) == DROGUE_OK) {
            e->xc_px_q16 = shifted(e->xc_px_q16, -out->region.x_px);
            e->yc_px_q16 = shifted(e->yc_px_q16, -out->region.y_px);
            count++;
        }
    }
    if (count == 0) {
        return DROGUE_E_NO_DARK_PART;
    }
    within.centre2_x = (int32_t)drogue_shr_round_s64(outline->xc_px_q16, 15);
    within.centre2_y = (int32_t)drogue_shr_round_s64(outline->yc_px_q16, 15);
    within.longest_px = (int32_t)drogue_shr_round_s64((int64_t)outline->b_px_q16 * 5, 17);
    status = drogue_dark_disc_find(&out->inner, &which, workspace, &f->view, &within, config->min_dark_area_px, discs,
                                   count);
    *expected = discs[which];
    return status;
}

/* Can the inner part be believed: of about the expected size, near the expected place, not cut by the rim? */
static int trust_inner(const drogue_result *out, const drogue_ellipse *expected, const frame *f,
                       const drogue_config *config)
{
    const drogue_q16 fill = drogue_dark_fill(&out->inner, expected);
    const int64_t dx = (int64_t)out->inner.x_px_q16 - expected->xc_px_q16;
    const int64_t dy = (int64_t)out->inner.y_px_q16 - expected->yc_px_q16;
    const int64_t gate = drogue_q16_mul(config->inner_gate_q16, f->outline.ellipse.a_px_q16);
    drogue_ellipse_frame rim;
    int32_t u_q24;
    int32_t v_q24;
    int64_t room_q24;
    if (fill < config->min_fill_q16 || fill > config->max_fill_q16 || dx * dx + dy * dy > gate * gate ||
        drogue_ellipse_frame_of(&rim, &f->outline.ellipse) != DROGUE_OK) {
        return 0;
    }
    drogue_ellipse_frame_point(&u_q24, &v_q24, &rim, out->inner.x_px_q16, out->inner.y_px_q16);
    room_q24 =
        (INT64_C(1) << 24) - drogue_div_round_s64((int64_t)expected->a_px_q16 << 24, f->outline.ellipse.b_px_q16);
    return room_q24 > 0 && (int64_t)u_q24 * u_q24 + (int64_t)v_q24 * v_q24 <= room_q24 * room_q24;
}

/* Standard deviation of the inner centroid: a floor, a share of the disc's size, and what the threshold moves it. */
static drogue_q16 inner_std(const drogue_result *out, const drogue_ellipse *expected, const drogue_config *config)
{
    const int64_t share = drogue_q16_mul(config->inner_std_share_q16, expected->a_px_q16);
    const int64_t least = config->inner_std_px_q16;
    const int64_t spread = drogue_q16_mul(out->inner.spread_px_q16, config->inner_std_spread_q16);
    return drogue_sat_s32((int64_t)drogue_isqrt_u64((uint64_t)(share * share + least * least + spread * spread)));
}

static int64_t q48_of(drogue_wide v) { return drogue_wide_to_s64(v, 48); }

static void put_covariance(drogue_result *out, const drogue_joint *joint)
{
    drogue_wide angle2;
    int32_t s_q30;
    int32_t c_q30;
    drogue_wide c;
    int i;
    int j;
    for (i = 0; i < 5; i++) {
        for (j = 0; j < 5; j++) {
            out->covariance_q48[i][j] = q48_of(joint->covariance[DROGUE_PACKED(i, j)]);
        }
    }
    for (i = 0; i < 3; i++) {
        out->position_std_m_q32[i] = drogue_wide_to_s64(drogue_wide_sqrt(joint->covariance[DROGUE_PACKED(i, i)]), 32);
    }
    drogue_sincos_q30(&s_q30, &c_q30, (int32_t)drogue_shl_s64(joint->pose.pitch_rad_q16, 13));
    c = drogue_wide_from_s64(c_q30, -30);
    angle2 = drogue_wide_add(drogue_wide_mul(joint->covariance[DROGUE_PACKED(3, 3)], drogue_wide_mul(c, c)),
                             joint->covariance[DROGUE_PACKED(4, 4)]);
    out->axis_std_rad_q32 = drogue_wide_to_s64(drogue_wide_sqrt(angle2), 32);
}

/* Do two solutions differ by less than their standard deviations? Then there is nothing to choose. */
static int same_solution(const drogue_joint *p, const drogue_joint *q)
{
    const drogue_wide yaw = drogue_wide_from_s64((int64_t)p->pose.yaw_rad_q16 - q->pose.yaw_rad_q16, -16);
    const drogue_wide pitch = drogue_wide_from_s64((int64_t)p->pose.pitch_rad_q16 - q->pose.pitch_rad_q16, -16);
    return drogue_wide_cmp(drogue_wide_mul(yaw, yaw), p->covariance[DROGUE_PACKED(3, 3)]) <= 0 &&
           drogue_wide_cmp(drogue_wide_mul(pitch, pitch), p->covariance[DROGUE_PACKED(4, 4)]) <= 0;
}

#define STEPS 5 /* most Gauss-Newton steps of the pose taken: the start is within a few degrees */

/* Solve from the pose nearer to the inner part, and far enough from the other one to know how much worse it is. */
static drogue_status solve_both(drogue_joint joint[2], uint32_t *best, const drogue_pose poses[2],
                                const drogue_joint_outline *outline, const drogue_joint_inner *inner,
                                const drogue_camera *camera, const drogue_model *model, uint32_t nearer)
{
    const int with_inner = inner->std_px_q16 > 0;
    drogue_status status = drogue_joint_solve(&joint[nearer], &poses[nearer], outline, inner, camera, model,
                                              with_inner ? STEPS : 0);
    *best = nearer;
    if (status == DROGUE_OK) {
        status = drogue_joint_solve(&joint[1 - nearer], &poses[1 - nearer], outline, inner, camera, model, with_inner);
    }
    if (status == DROGUE_OK && drogue_wide_cmp(joint[1 - nearer].chi2, joint[nearer].chi2) < 0) {
        *best = 1 - nearer;
        status = drogue_joint_solve(&joint[*best], &poses[*best], outline, inner, camera, model, STEPS);
    }
    return status;
}

/* The pose from outline and inner part; from the outline alone when they contradict each other. Says whether the inner
 * part decided between the two. */
static drogue_status solve(drogue_result *out, const drogue_pose poses[2], const frame *f,
                           const drogue_joint_inner *inner, const drogue_config *config, const drogue_camera *camera,
                           const drogue_model *model, uint32_t nearer)
{
    const drogue_joint_inner none = {0, 0, 0};
    drogue_joint_outline outline;
    drogue_joint joint[2];
    drogue_status status;
    uint32_t best = 0;
    int trusted = inner->std_px_q16 > 0;
    outline.ellipse = out->ideal;
    status = drogue_joint_outline_covariance(&outline, &f->outline.support, config->outline_shading_q16,
                                             config->optics_blur_std_px2_q16);
    if (status == DROGUE_OK && trusted) {
        status = solve_both(joint, &best, poses, &outline, inner, camera, model, nearer);
        trusted = status == DROGUE_OK &&
                  drogue_wide_cmp(joint[best].chi2, drogue_wide_from_q16(config->max_chi2_q16)) <= 0;
    }
    if (status == DROGUE_OK && !trusted) {
        status = solve_both(joint, &best, poses, &outline, &none, camera, model, nearer);
    }
    if (status != DROGUE_OK) {
        return DROGUE_E_DOMAIN;
    }
    out->orientation_resolved = trusted && (same_solution(&joint[best], &joint[1 - best]) ||
                                            drogue_wide_cmp(drogue_wide_sub(joint[1 - best].chi2, joint[best].chi2),
                                                            drogue_wide_from_q16(config->min_chi2_gap_q16)) >= 0);
    out->pose = joint[best].pose;
    out->alternative = joint[1 - best].pose;
    put_covariance(out, &joint[best]);
    return DROGUE_OK;
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

static drogue_status measure(drogue_result *out, drogue_workspace *workspace, const drogue_config *config,
                             const drogue_camera *camera, const drogue_model *model, const drogue_image *image,
                             const drogue_region *region)
{
    drogue_joint_inner inner = {0, 0, 0};
    drogue_ellipse expected;
    frame f;
    drogue_pose poses[2];
    drogue_choice choice;
    drogue_status status;
    memset(&f, 0, sizeof f);
    memset(&choice, 0, sizeof choice);
    status = find_outline_twice(out, &f, workspace, config, image, region);
    if (status != DROGUE_OK) {
        return status;
    }
    describe(out, &f.outline);
    if (drogue_camera_distorts(camera)) {
        status = drogue_outline_undistorted(&out->ideal, &f.outline, workspace, &out->list, config, camera,
                                            out->region.x_px, out->region.y_px);
        if (status != DROGUE_OK) {
            memset(&out->ideal, 0, sizeof out->ideal);
            return DROGUE_E_NO_ELLIPSE;
        }
    }
    status = drogue_pose_from_ellipse(poses, &out->ideal, camera, model->rim_radius_m_q16);
    if (status == DROGUE_OK && model->inner_radius_m_q16 > 0) {
        status = find_inner(out, &expected, &f, poses, workspace, config, camera, model);
        if (status == DROGUE_OK) {
            out->has_inner = 1;
            inner.std_px_q16 = trust_inner(out, &expected, &f, config) ? inner_std(out, &expected, config) : 0;
            inner.x_px_q16 = out->inner.x_px_q16 = shifted(out->inner.x_px_q16, out->region.x_px);
            inner.y_px_q16 = out->inner.y_px_q16 = shifted(out->inner.y_px_q16, out->region.y_px);
            status = drogue_undistort_point(&inner.x_px_q16, &inner.y_px_q16, camera);
            if (status == DROGUE_OK) {
                status = drogue_choose_pose(&choice, poses, inner.x_px_q16, inner.y_px_q16, model->inner_depth_m_q16,
                                            camera);
                out->ambiguity_q16 = choice.ambiguity_q16;
            }
        } else if (status == DROGUE_E_NO_DARK_PART) {
            status = DROGUE_OK;
        }
    }
    return status == DROGUE_OK ? solve(out, poses, &f, &inner, config, camera, model, choice.index) : status;
}

drogue_status drogue_measure(drogue_result *out, drogue_workspace *workspace, const drogue_config *config,
                             const drogue_camera *camera, const drogue_model *model, const drogue_image *image,
                             const drogue_region *region)
{
    int k;
    memset(out, 0, sizeof *out);
    out->ambiguity_q16 = DROGUE_Q16_ONE;
    for (k = 0; k < 4; k++) {
        out->arcs[k] = DROGUE_NO_ARC;
    }
    if (image->data == NULL || image->width_px < 1 || image->height_px < 1 || image->stride < image->width_px ||
        camera->fx_px_q16 <= 0 || camera->fy_px_q16 <= 0 || model->rim_radius_m_q16 <= 0 ||
        model->inner_radius_m_q16 < 0 || !drogue_config_valid(config)) {
        out->status = DROGUE_E_ARGUMENT;
    } else {
        out->status = measure(out, workspace, config, camera, model, image, region);
    }
    return out->status;
}
