/* SPDX-License-Identifier: Apache-2.0 */
/* The inner disc where no outline says where it is and how large, and the outlines that it allows. */
#include "drogue/inner.h"

#include <string.h>

#include "drogue/undistort.h"
#include "fit.h"

#define PLACES 13                     /* tried about the region's middle */
#define EVERY 2                       /* so many-th ray will do */
#define PHASE 4                       /* two evenly in each bin */
#define ENOUGH (3 * RAYS / 4 / EVERY) /* rays that agree */
#define LAST_PX DROGUE_Q16(3, 2)      /* they agree within this, or a sixteenth of the radius */
#define SMALLEST_PX DROGUE_Q16(3, 1)  /* least radius, as the region suggests it */
#define LEAST_PX DROGUE_Q16(2, 1)     /* least radius, as it is found */
#define STEEPER 2                     /* least step of an edge seen from the middle, in least contrasts */
#define FAR_PX DROGUE_Q16(512, 1)     /* of a larger outline rays from the middle do not reach all */

/* Rays from the middle that must see an edge: so many do where a disc is a tenth of the outline's size and a third off
 * the middle. */
#define SOME 3

/* The places, in sixths of the outline's semi-axis as the region suggests it. */
static const int8_t places[PLACES][2] = {{0, 0}, {1, 0},  {-1, 0}, {0, 1},  {0, -1}, {2, 0},  {-2, 0},
                                         {0, 2}, {0, -2}, {1, 1},  {-1, 1}, {1, -1}, {-1, -1}};

/* Rays that see an edge. */
static int32_t seeing(const drogue_ray rays[RAYS])
{
    int32_t seen = 0;
    int32_t k;
    for (k = 0; k < RAYS; k++) {
        seen += rays[k].count > 0;
    }
    return seen;
}

/* The sum of the slopes of the rays that agree is no more than that of the steepest of all; 0 when too few see an edge
 * for enough to agree. */
static int32_t most_slopes_q8(const drogue_ray rays[RAYS])
{
    int32_t sum_q8 = 0;
    int32_t k;
    for (k = 0; k < RAYS; k++) {
        int32_t most_q8 = 0;
        uint32_t i;
        for (i = 0; i < rays[k].count; i++) { /* bound: DROGUE_RAY_EDGES */
            most_q8 = larger(rays[k].edges[i].slope_q8, most_q8);
        }
        sum_q8 += most_q8;
    }
    return seeing(rays) < ENOUGH ? 0 : sum_q8;
}

/* Settle the rays' edges on a circle, which is larger by so much at first; the sum of the slopes of the rays that
 * agree, 0 when too few do. */
static int32_t settle(drogue_ellipse *e, const drogue_ray rays[RAYS], drogue_q16 larger_px_q16, drogue_q16 gate_px_q16)
{
    drogue_q16 v_px_q16[3] = {0, 0, 0};
    drogue_ray_sums s;
    v_px_q16[2] = larger_px_q16;
    if (!drogue_ray_sums_settle(&s, v_px_q16, rays, gate_px_q16, larger(LAST_PX, e->a_px_q16 / 16), 1) ||
        s.rays < ENOUGH || drogue_q16_add(e->a_px_q16, v_px_q16[2]) < LEAST_PX) {
        return 0;
    }
    e->xc_px_q16 = drogue_q16_add(e->xc_px_q16, v_px_q16[0]);
    e->yc_px_q16 = drogue_q16_add(e->yc_px_q16, v_px_q16[1]);
    e->a_px_q16 = drogue_q16_add(e->a_px_q16, v_px_q16[2]);
    e->b_px_q16 = e->a_px_q16;
    return s.slopes_q8;
}

/* Do some rays from there see an edge, out to so far? Where the frame is blank none does, as noise is not so steep. */
static int sees_edge(drogue_ray rays[RAYS], const drogue_image *view, const drogue_ellipse *middle,
                     drogue_q16 far_px_q16, int32_t least)
{
    drogue_ellipse half = *middle;
    half.a_px_q16 = far_px_q16 / 2;
    half.b_px_q16 = half.a_px_q16;
    drogue_rays_cast(rays, view, &half, half.a_px_q16, PHASE, EVERY, STEEPER * least, DROGUE_RAY_RISES);
    return seeing(rays) >= SOME;
}

int drogue_inner_seek(drogue_ellipse *out, drogue_ray rays[RAYS], const drogue_image *view, const drogue_mask *mask,
                      const drogue_setup *setup)
{
    const drogue_q16 a = drogue_sat_s32((int64_t)mask->longest_px * DROGUE_Q16(5, 12)); /* 2.4 of it in the region */
    const drogue_q16 r =
        drogue_q16_div(drogue_q16_mul(a, setup->model->inner_radius_m_q16), setup->model->rim_radius_m_q16);
    const int32_t least = setup->config->min_inner_contrast;
    drogue_ellipse middle;
    int32_t steepest = 0;
    int32_t k;
    if (r < SMALLEST_PX || r > a) {
        return 0;
    }
    memset(&middle, 0, sizeof middle);
    middle.xc_px_q16 = mask->centre2_x * (DROGUE_Q16_ONE / 2);
    middle.yc_px_q16 = mask->centre2_y * (DROGUE_Q16_ONE / 2);
    if (a <= FAR_PX && !sees_edge(rays, view, &middle, a / 5 * 6, least)) {
        return 0;
    }
    for (k = 0; k < PLACES; k++) {
        drogue_ellipse place = middle;
        int32_t most;
        int32_t size;
        place.xc_px_q16 = drogue_q16_add(middle.xc_px_q16, places[k][0] * (a / 6));
        place.yc_px_q16 = drogue_q16_add(middle.yc_px_q16, places[k][1] * (a / 6));
        place.a_px_q16 = r;
        place.b_px_q16 = r;
        drogue_rays_cast(rays, view, &place, r / 4 * 3, PHASE, EVERY, least, DROGUE_RAY_RISES);
        most = most_slopes_q8(rays);
        for (size = -1; size <= 1 && most > steepest; size++) { /* a collar's edge beside the disc's: each by itself */
            drogue_ellipse e = place;
            const int32_t slopes_q8 = settle(&e, rays, size * (r / 3), r / 4 * 3);
            if (slopes_q8 > steepest) {
                steepest = slopes_q8;
                *out = e;
            }
        }
    }
    if (steepest > 0) { /* once more from there, where all rays see it alike */
        drogue_rays_cast(rays, view, out, r / 4, PHASE, EVERY, least, DROGUE_RAY_RISES);
        steepest = settle(out, rays, 0, r / 4); /* 0, too, when too few see an edge */
    }
    return steepest > 0;
}

/* Tangents of a pixel's direction; 0 where that is more than 45 degrees off the axis, or beyond the lens model. */
static int direction_of(drogue_q16 tangent_q16[2], drogue_q16 x_px_q16, drogue_q16 y_px_q16,
                        const drogue_camera *camera)
{
    if (drogue_undistort_point(&x_px_q16, &y_px_q16, camera) != DROGUE_OK) {
        return 0;
    }
    tangent_q16[0] = drogue_q16_div(drogue_q16_sub(x_px_q16, camera->cx_px_q16), camera->fx_px_q16);
    tangent_q16[1] = drogue_q16_div(drogue_q16_sub(y_px_q16, camera->cy_px_q16), camera->fy_px_q16);
    return tangent_q16[0] <= DROGUE_Q16_ONE && tangent_q16[0] >= -DROGUE_Q16_ONE && tangent_q16[1] <= DROGUE_Q16_ONE &&
           tangent_q16[1] >= -DROGUE_Q16_ONE;
}

int drogue_inner_sight_of(drogue_inner_sight *sight, const drogue_ellipse *disc, const drogue_camera *camera)
{
    const drogue_q16 x = disc->xc_px_q16;
    const drogue_q16 y = disc->yc_px_q16;
    const drogue_q16 a = disc->a_px_q16;
    drogue_q16 middle[2];
    drogue_q16 end[4][2];
    uint64_t across2_q32;
    if (!direction_of(middle, x, y, camera) || !direction_of(end[0], drogue_q16_sub(x, a), y, camera) ||
        !direction_of(end[1], drogue_q16_add(x, a), y, camera) ||
        !direction_of(end[2], x, drogue_q16_sub(y, a), camera) ||
        !direction_of(end[3], x, drogue_q16_add(y, a), camera)) {
        return 0;
    }
    sight->radius_q16 = (end[1][0] - end[0][0] + end[3][1] - end[2][1]) / 4;
    across2_q32 = drogue_square_sum(middle[0], DROGUE_Q16_ONE);
    sight->x_q16 = middle[0];
    sight->y_q16 = middle[1];
    sight->length_q16 = (drogue_q16)drogue_isqrt_u64(across2_q32 + drogue_square_sum(middle[1], 0));
    sight->yaw_rad_q16 = (drogue_q16)drogue_shr_round_s64(drogue_atan2_q29(middle[0], DROGUE_Q16_ONE), 13);
    sight->pitch_rad_q16 =
        (drogue_q16)drogue_shr_round_s64(drogue_atan2_q29(middle[1], (int64_t)drogue_isqrt_u64(across2_q32)), 13);
    return sight->radius_q16 > 0;
}

/* A drogue whose disc is there and whose axis is turned by so much from the line of sight. */
static void turn(drogue_pose *pose, const drogue_inner_sight *sight, drogue_q16 yaw_rad_q16, drogue_q16 pitch_rad_q16,
                 const drogue_model *model)
{
    /* Seen head-on its mean semi-axis is as much as on the optical axis times (1 + length) / 2, turned times
     * (1 + cos) / 2, which is near 1 - turn^2 / 4. */
    const drogue_q16 turn2_q16 = drogue_sat_s32((int64_t)(drogue_square_sum(yaw_rad_q16, pitch_rad_q16) >> 16));
    const drogue_q16 facing_q16 = drogue_q16_mul(drogue_q16_add(DROGUE_Q16_ONE, sight->length_q16) / 2,
                                                 drogue_q16_sub(DROGUE_Q16_ONE, turn2_q16 / 4));
    const drogue_q16 z = drogue_q16_mul(drogue_q16_div(model->inner_radius_m_q16, sight->radius_q16), facing_q16);
    int k;
    pose->yaw_rad_q16 = sight->yaw_rad_q16 + yaw_rad_q16;
    pose->pitch_rad_q16 = sight->pitch_rad_q16 + pitch_rad_q16;
    drogue_pose_axis(pose->axis_q16, pose->yaw_rad_q16, pose->pitch_rad_q16);
    pose->position_m_q16[0] = drogue_q16_mul(sight->x_q16, z);
    pose->position_m_q16[1] = drogue_q16_mul(sight->y_q16, z);
    pose->position_m_q16[2] = z;
    for (k = 0; k < 3; k++) { /* from the disc's middle to the rim's */
        pose->position_m_q16[k] =
            drogue_q16_sub(pose->position_m_q16[k], drogue_q16_mul(pose->axis_q16[k], model->inner_depth_m_q16));
    }
}

void drogue_inner_rims(drogue_inner_expected *rims, const drogue_inner_sight *sight, int32_t yaw, int32_t pitch,
                       const drogue_setup *setup, int32_t x_px, int32_t y_px)
{
    const drogue_q16 step_rad_q16 = DROGUE_Q16(8, 100);
    drogue_model rim = *setup->model; /* whose disc is the rim */
    drogue_setup seen = *setup;
    drogue_pose poses[2];
    turn(&poses[0], sight, yaw * step_rad_q16, pitch * step_rad_q16, setup->model);
    turn(&poses[1], sight, -yaw * step_rad_q16, -pitch * step_rad_q16, setup->model);
    rim.inner_radius_m_q16 = rim.rim_radius_m_q16;
    rim.inner_depth_m_q16 = 0;
    seen.model = &rim;
    drogue_inner_expect(rims, poses, &seen, x_px, y_px);
}
