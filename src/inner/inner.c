/* SPDX-License-Identifier: Apache-2.0 */
/* Expectation of the inner part and its credibility. */
#include "drogue/inner.h"

#include <string.h>

#include "drogue/quality.h"
#include "drogue/real.h"
#include "drogue/undistort.h"

void drogue_inner_expect(drogue_inner_expected *expected, const drogue_pose poses[2], const drogue_setup *setup,
                         int32_t x_px, int32_t y_px)
{
    int i;
    memset(expected, 0, sizeof *expected);
    expected->min_area_px = setup->config->min_inner_area_px;
    for (i = 0; i < 2; i++) {
        drogue_ellipse *e = &expected->disc[expected->count];
        if (drogue_inner_disc_image(e, &poses[i], setup->camera, setup->model) == DROGUE_OK &&
            e->a_px_q16 >= DROGUE_Q16_ONE &&
            drogue_distort_point(&e->xc_px_q16, &e->yc_px_q16, setup->camera) == DROGUE_OK) {
            e->xc_px_q16 = drogue_q16_sub(e->xc_px_q16, drogue_q16_from_int(x_px));
            e->yc_px_q16 = drogue_q16_sub(e->yc_px_q16, drogue_q16_from_int(y_px));
            expected->count++;
        }
    }
}

drogue_mask drogue_inner_disc(const drogue_ellipse *outline)
{
    drogue_mask disc; /* radius longest / 3 */
    disc.centre2_x = (int32_t)drogue_shr_round_s64(outline->xc_px_q16, 15);
    disc.centre2_y = (int32_t)drogue_shr_round_s64(outline->yc_px_q16, 15);
    disc.longest_px = (int32_t)drogue_shr_round_s64((int64_t)outline->b_px_q16 * 5, 17);
    return disc;
}

/* Does the expected disc lie wholly within the outline when its centre is the part's? */
static int within_outline(const drogue_inner_part *part, const drogue_ellipse *expected, const drogue_ellipse *outline)
{
    drogue_ellipse_frame rim;
    int32_t u_q24;
    int32_t v_q24;
    drogue_real room;
    drogue_real b;
    int32_t room_q24;
    if (drogue_ellipse_frame_of(&rim, outline) != DROGUE_OK) {
        return 0;
    }
    drogue_ellipse_frame_point(&u_q24, &v_q24, &rim, part->x_px_q16, part->y_px_q16);
    drogue_real_set_q16(&room, drogue_q16_sub(outline->b_px_q16, expected->a_px_q16));
    drogue_real_set_q16(&b, outline->b_px_q16);
    drogue_real_quotient(&room, &room, &b);
    room_q24 = drogue_real_to_s32(room, 24);
    return room_q24 > 0 && drogue_square_sum(u_q24, v_q24) <= drogue_square_sum(room_q24, 0);
}

#define FILL_ROOM DROGUE_Q16(1, 2) /* px that blur and threshold may move the disc's edge */

/* Area over that of the expected disc, made larger by so many pixels all round. */
static drogue_q16 fill_of(const drogue_inner_part *part, const drogue_ellipse *expected, drogue_q16 by_px_q16)
{
    drogue_ellipse grown = *expected;
    grown.a_px_q16 = drogue_q16_add(grown.a_px_q16, by_px_q16);
    grown.b_px_q16 = drogue_q16_add(grown.b_px_q16, by_px_q16);
    return drogue_inner_fill(part, &grown);
}

drogue_q16 drogue_inner_std(const drogue_inner_part *part, const drogue_ellipse *expected,
                            const drogue_ellipse *outline, const drogue_config *config)
{
    const uint64_t away2_q32 = drogue_square_sum(drogue_q16_sub(part->x_px_q16, expected->xc_px_q16),
                                                 drogue_q16_sub(part->y_px_q16, expected->yc_px_q16));
    const drogue_q16 gate =
        drogue_q16_add(config->inner_gate_px_q16, drogue_q16_mul(config->inner_gate_q16, outline->a_px_q16));
    const drogue_q16 share = drogue_q16_mul(config->inner_std_share_q16, expected->a_px_q16);
    const drogue_q16 spread = drogue_q16_mul(part->spread_px_q16, config->inner_std_spread_q16);
    if (part->contrast < config->min_inner_contrast || fill_of(part, expected, -FILL_ROOM) < config->min_fill_q16 ||
        fill_of(part, expected, FILL_ROOM) > config->max_fill_q16 || away2_q32 > drogue_square_sum(gate, 0) ||
        !within_outline(part, expected, outline)) {
        return 0;
    }
    return drogue_sat_s32(
        drogue_isqrt_u64(drogue_square_sum(share, config->inner_std_px_q16) + drogue_square_sum(spread, 0)));
}

void drogue_inner_weigh(drogue_inner_evidence *evidence, const drogue_region *region, const drogue_ellipse *expected,
                        const drogue_ellipse *outline, const drogue_pose poses[2], const drogue_setup *setup)
{
    drogue_inner_part *part = &evidence->part;
    drogue_joint_inner *weighed = &evidence->weighed;
    drogue_choice choice;
    weighed->std_px_q16 = drogue_inner_std(part, expected, outline, setup->config);
    weighed->x_px_q16 = part->x_px_q16 = drogue_q16_add(part->x_px_q16, drogue_q16_from_int(region->x_px));
    weighed->y_px_q16 = part->y_px_q16 = drogue_q16_add(part->y_px_q16, drogue_q16_from_int(region->y_px));
    if (drogue_undistort_point(&weighed->x_px_q16, &weighed->y_px_q16, setup->camera) != DROGUE_OK ||
        drogue_choose_pose(&choice, poses, weighed->x_px_q16, weighed->y_px_q16, setup->model->inner_depth_m_q16,
                           setup->camera) != DROGUE_OK) {
        weighed->std_px_q16 = 0; /* beyond the lens model, or behind the camera for one of the poses */
        choice.index = 0;
    }
    evidence->nearer = choice.index;
    evidence->ambiguity_q16 = weighed->std_px_q16 > 0 ? choice.ambiguity_q16 : DROGUE_Q16_ONE;
    if (weighed->std_px_q16 == 0) { /* what is dark orders the poses, but is not to be believed */
        memset(part, 0, sizeof *part);
    }
}
