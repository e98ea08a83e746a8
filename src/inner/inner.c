/* SPDX-License-Identifier: Apache-2.0 */
/* Expectation of the inner part and its credibility. */
#include "drogue/inner.h"

#include <string.h>

#include "drogue/ellipse.h"
#include "drogue/quality.h"
#include "drogue/real.h"
#include "drogue/undistort.h"

/* Half the way between the images of two points to either side of an ellipse's centre along a vector, px Q16. */
static drogue_status half_chord(drogue_q16 out_px_q16[2], const drogue_ellipse *e, int64_t dx_q16, int64_t dy_q16,
                                const drogue_camera *camera)
{
    drogue_q16 x = drogue_sat_s32(e->xc_px_q16 + dx_q16);
    drogue_q16 y = drogue_sat_s32(e->yc_px_q16 + dy_q16);
    drogue_q16 u = drogue_sat_s32(e->xc_px_q16 - dx_q16);
    drogue_q16 v = drogue_sat_s32(e->yc_px_q16 - dy_q16);
    if (drogue_distort_point(&x, &y, camera) != DROGUE_OK || drogue_distort_point(&u, &v, camera) != DROGUE_OK) {
        return DROGUE_E_DOMAIN;
    }
    out_px_q16[0] = drogue_q16_sub(x, u) / 2;
    out_px_q16[1] = drogue_q16_sub(y, v) / 2;
    return DROGUE_OK;
}

/* An ideal ellipse as the lens shows it: its axes become conjugate diameters. */
static drogue_status distort_ellipse(drogue_ellipse *e, const drogue_camera *camera)
{
    drogue_ellipse as_seen;
    drogue_real shape[3];
    drogue_real p[2][2];
    drogue_q16 half[2][2];
    int32_t s_q30;
    int32_t c_q30;
    int i;
    if (!drogue_camera_distorts(camera)) {
        return DROGUE_OK;
    }
    drogue_sincos_of_q16(&s_q30, &c_q30, e->angle_rad_q16);
    if (half_chord(half[0], e, drogue_shr_round_s64((int64_t)e->a_px_q16 * c_q30, 30),
                   drogue_shr_round_s64((int64_t)e->a_px_q16 * s_q30, 30), camera) != DROGUE_OK ||
        half_chord(half[1], e, -drogue_shr_round_s64((int64_t)e->b_px_q16 * s_q30, 30),
                   drogue_shr_round_s64((int64_t)e->b_px_q16 * c_q30, 30), camera) != DROGUE_OK) {
        return DROGUE_E_DOMAIN;
    }
    for (i = 0; i < 2; i++) {
        drogue_real_set_q16(&p[i][0], half[i][0]);
        drogue_real_set_q16(&p[i][1], half[i][1]);
    }
    drogue_real_products(&shape[0], &p[0][0], &p[0][0], &p[1][0], &p[1][0]);
    drogue_real_products(&shape[1], &p[0][0], &p[0][1], &p[1][0], &p[1][1]);
    drogue_real_products(&shape[2], &p[0][1], &p[0][1], &p[1][1], &p[1][1]);
    if (drogue_shape_ellipse(&as_seen, shape) != DROGUE_OK) {
        return DROGUE_E_DOMAIN;
    }
    as_seen.xc_px_q16 = e->xc_px_q16;
    as_seen.yc_px_q16 = e->yc_px_q16;
    *e = as_seen;
    return drogue_distort_point(&e->xc_px_q16, &e->yc_px_q16, camera);
}

void drogue_inner_expect(drogue_inner_expected *expected, const drogue_pose poses[2], const drogue_setup *setup,
                         int32_t x_px, int32_t y_px)
{
    int i;
    memset(expected, 0, sizeof *expected);
    for (i = 0; i < 2; i++) {
        drogue_ellipse *e = &expected->disc[expected->count];
        if (drogue_inner_disc_image(e, &poses[i], setup->camera, setup->model) == DROGUE_OK &&
            e->b_px_q16 >= DROGUE_Q16_ONE && distort_ellipse(e, setup->camera) == DROGUE_OK) {
            e->xc_px_q16 = drogue_q16_sub(e->xc_px_q16, drogue_q16_from_int(x_px));
            e->yc_px_q16 = drogue_q16_sub(e->yc_px_q16, drogue_q16_from_int(y_px));
            expected->count++;
        }
    }
}

uint64_t drogue_inner_away2_q32(const drogue_inner_edge *edge, const drogue_ellipse *expected)
{
    return drogue_square_sum(drogue_q16_sub(edge->x_px_q16, expected->xc_px_q16),
                             drogue_q16_sub(edge->y_px_q16, expected->yc_px_q16));
}

/* Does the expected disc lie wholly within the outline when its centre is the part's? Their planes are parallel: to the
 * outline's frame, where that is a circle, the disc is one too. */
static int within_outline(const drogue_inner_edge *edge, const drogue_ellipse *expected, const drogue_ellipse *outline)
{
    drogue_ellipse_frame rim;
    int32_t u_q24;
    int32_t v_q24;
    drogue_real room;
    drogue_real a;
    int32_t room_q24;
    if (drogue_ellipse_frame_of(&rim, outline) != DROGUE_OK) {
        return 0;
    }
    drogue_ellipse_frame_point(&u_q24, &v_q24, &rim, edge->x_px_q16, edge->y_px_q16);
    drogue_real_set_q16(&room, drogue_q16_sub(outline->a_px_q16, expected->a_px_q16));
    drogue_real_set_q16(&a, outline->a_px_q16);
    drogue_real_quotient(&room, &room, &a);
    room_q24 = drogue_real_to_s32(room, 24);
    return room_q24 > 0 && drogue_square_sum(u_q24, v_q24) <= drogue_square_sum(room_q24, 0);
}

#define LARGER_Q16 DROGUE_Q16(1, 64)    /* of its size: a disc is seen to that */
#define SMALLER_PX_Q16 DROGUE_Q16(1, 2) /* by as much blur and what touches the disc move its edge */
#define ELSEWHERE 8                     /* so many-th part of its size: what is off it by more may be something else */

/* A disc that is too large may be that of a larger outline than the one found, and is so in one of eight; one that is
 * too small hardly ever says more than that its edge is blurred or touched. */
static drogue_q16 doubt_of(const drogue_inner_edge *edge, const drogue_ellipse *expected)
{
    const drogue_q16 smaller_px_q16 = drogue_q16_sub(-SMALLER_PX_Q16, edge->grown_px_q16);
    const drogue_q16 share = drogue_q16_div(edge->grown_px_q16, expected->a_px_q16);
    const drogue_q16 beyond = drogue_q16_sub(share, LARGER_Q16);
    if (smaller_px_q16 > 0) {
        return drogue_q16_div(smaller_px_q16, expected->a_px_q16) / 2;
    }
    return beyond > LARGER_Q16 ? drogue_clamp_s32(share, 0, DROGUE_Q16_ONE - 1) : beyond > 0 ? 2 * beyond : 0;
}

#define SEEN 256 /* so many-th part of its size: no disc is seen to be larger by less */

static int all_about(const drogue_inner_edge *edge) { return 8 * edge->rays >= 7 * DROGUE_RAYS; }

/* By what share an outline's pose is too far. An edge within the rim, as that of its band, is too small for the disc
 * and, cut by light and shade, tilted otherwise: the disc lies beside its place, too. A disc whose edge is another one,
 * as a collar's, is too large as well, but in its place: of one that is off it by three times what it is off its size
 * all counts, by no more than once nothing. Of what counts three quarters. */
static drogue_q16 too_far(const drogue_inner_edge *edge, const drogue_ellipse *expected)
{
    const int64_t away = (int64_t)drogue_isqrt_u64(drogue_inner_away2_q32(edge, expected));
    const int64_t larger = (int64_t)edge->grown_px_q16 - expected->a_px_q16 / SEEN;
    const int64_t beside = (away - edge->grown_px_q16) / 2;
    const int64_t by = larger < beside ? larger : beside;
    if (by <= 0 || !all_about(edge) || edge->grown_px_q16 > expected->a_px_q16 / ELSEWHERE) {
        return 0;
    }
    return drogue_q16_div((drogue_q16)(by - by / 4), expected->a_px_q16);
}

#define EVIDENT_PX_Q16 DROGUE_Q16(3, 10) /* and a 64th: of its size */

/* Sharp, of its size and seen nearly all about: then it is the disc, and what puts it elsewhere than expected is that
 * an outline seen nearly head-on, or one that is the wall's on one side, says little of its own tilt. */
static int evident(const drogue_inner_edge *edge, const drogue_ellipse *expected, const drogue_config *config)
{
    const drogue_q16 off = drogue_q16_abs(edge->grown_px_q16);
    return all_about(edge) && 2 * (int64_t)edge->spread_px_q16 <= config->inner_rms_px_q16 &&
           off <= drogue_q16_add(EVIDENT_PX_Q16, drogue_q16_mul(LARGER_Q16, expected->a_px_q16));
}

/* Most that rays lie about an edge, root mean square: of a large one that is seen nearly all about as much more as it
 * is larger than one that is not jagged. */
static drogue_q16 most_spread(const drogue_inner_edge *edge, const drogue_ellipse *expected,
                              const drogue_config *config)
{
    const drogue_q16 larger_px_q16 = all_about(edge) ? drogue_inner_jagged(expected) : 0;
    const drogue_q16 larger_q16 = larger_px_q16 / (DROGUE_INNER_JAGGED / DROGUE_Q16_ONE);
    return drogue_q16_add(config->inner_rms_px_q16, drogue_q16_mul(config->inner_rms_px_q16, larger_q16));
}

drogue_q16 drogue_inner_std(const drogue_inner_edge *edge, const drogue_ellipse *expected,
                            const drogue_ellipse *outline, const drogue_config *config)
{
    const drogue_q16 near_px_q16 = drogue_inner_gate(outline, config);
    const drogue_q16 gate = evident(edge, expected, config) ? drogue_q16_add(near_px_q16, near_px_q16) : near_px_q16;
    const drogue_q16 room = drogue_inner_room(expected, config);
    const drogue_q16 share = drogue_q16_mul(config->inner_std_share_q16, expected->a_px_q16);
    const drogue_q16 doubt = doubt_of(edge, expected);
    const drogue_q16 off = doubt > DROGUE_Q16_ONE / ELSEWHERE ? drogue_q16_mul(doubt, expected->a_px_q16) : 0;
    if (edge->contrast < config->min_inner_contrast ||
        (int64_t)edge->rays * DROGUE_Q16_ONE < (int64_t)config->min_inner_cover_q16 * DROGUE_RAYS ||
        edge->spread_px_q16 > most_spread(edge, expected, config) || edge->grown_px_q16 < -room ||
        drogue_inner_away2_q32(edge, expected) > drogue_square_sum(gate, 0) ||
        !within_outline(edge, expected, outline)) {
        return 0;
    }
    if (edge->grown_px_q16 > room) {
        return -1;
    }
    return drogue_sat_s32((int64_t)drogue_isqrt_u64(drogue_square_sum(share, config->inner_std_px_q16) +
                                                    drogue_square_sum(edge->std_px_q16, off)));
}

/* A semi-axis made larger; 0 where that leaves nothing. */
static drogue_q16 grown(drogue_q16 axis_px_q16, drogue_q16 by_px_q16)
{
    const drogue_q16 sum = drogue_q16_add(axis_px_q16, by_px_q16);
    return sum > 0 ? sum : 0;
}

/* The disc as what a result says of the inner part, px of the whole image. */
static void describe(drogue_inner_part *part, const drogue_inner_edge *edge, const drogue_ellipse *expected,
                     const drogue_region *region)
{
    const int64_t a = grown(expected->a_px_q16, edge->grown_px_q16);
    const int64_t b = grown(expected->b_px_q16, edge->grown_px_q16);
    memset(part, 0, sizeof *part);
    part->x_px_q16 = drogue_q16_add(edge->x_px_q16, drogue_q16_from_int(region->x_px));
    part->y_px_q16 = drogue_q16_add(edge->y_px_q16, drogue_q16_from_int(region->y_px));
    part->area_px = (uint32_t)drogue_shr_round_s64(drogue_shr_round_s64(a * b, 20) * DROGUE_Q16_PI, 28);
    part->spread_px_q16 = edge->spread_px_q16;
    part->threshold = edge->threshold;
    part->contrast = edge->contrast;
    part->rays = (uint8_t)edge->rays;
}

void drogue_inner_weigh(drogue_inner_evidence *evidence, const drogue_inner_edge *edge, const drogue_region *region,
                        const drogue_inner_expected *expected, const drogue_ellipse *outline,
                        const drogue_pose poses[2], const drogue_setup *setup)
{
    const drogue_ellipse *disc = &expected->disc[edge->which];
    drogue_joint_inner *weighed = &evidence->weighed;
    drogue_choice choice;
    describe(&evidence->part, edge, disc, region);
    weighed->std_px_q16 = drogue_inner_std(edge, disc, outline, setup->config);
    evidence->too_large = weighed->std_px_q16 < 0;
    weighed->std_px_q16 = evidence->too_large ? 0 : weighed->std_px_q16;
    weighed->x_px_q16 = evidence->part.x_px_q16;
    weighed->y_px_q16 = evidence->part.y_px_q16;
    if (evidence->part.area_px < setup->config->min_inner_area_px ||
        drogue_undistort_point(&weighed->x_px_q16, &weighed->y_px_q16, setup->camera) != DROGUE_OK ||
        drogue_choose_pose(&choice, poses, weighed->x_px_q16, weighed->y_px_q16, setup->model->inner_depth_m_q16,
                           setup->camera) != DROGUE_OK) {
        weighed->std_px_q16 = 0;
        evidence->too_large = 0; /* too small, beyond the lens model, or behind the camera for one of the poses */
        choice.index = 0;
    }
    evidence->doubt_q16 = doubt_of(edge, disc);
    evidence->too_far_q16 = too_far(edge, disc);
    evidence->nearer = choice.index;
    evidence->ambiguity_q16 = weighed->std_px_q16 > 0 ? choice.ambiguity_q16 : DROGUE_Q16_ONE;
    if (weighed->std_px_q16 == 0) { /* what is dark orders the poses, but is not to be believed */
        memset(&evidence->part, 0, sizeof evidence->part);
    }
}
