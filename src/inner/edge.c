/* SPDX-License-Identifier: Apache-2.0 */
/* The inner disc by its own edge. */
#include "drogue/inner.h"

#include <string.h>

#include "shade.h"

#define APART DROGUE_Q16(3, 4)       /* px */
#define EVERY 2                      /* so many-th ray will do to find a disc, and to measure a small one */
#define SMALL DROGUE_Q16(10, 1)      /* px: semi-axis below which a disc is small */
#define INWARD DROGUE_Q16(45, 100)   /* px: a quarter of a blurred step is this far within its middle */
#define APPEAR (RAYS / 4 / EVERY)    /* rays that see two edges apart; */
#define APPEAR_FINE (APPEAR * 3 / 2) /* of those that are less than 3 px apart, where noise shows more */
#define WITHIN DROGUE_Q16(3, 2)      /* px: where edges are the disc's, to either side; of one that is jagged */
#define JAGGED 10                    /* that, and so many-th part of what it is larger than one that is not */
#define LARGER 64 /* so many-th part of its size: a disc that is larger by more may be something else */

/* The band narrows to what agrees. */
static int narrow(drogue_ray_sums *s, drogue_q16 v_px_q16[3], drogue_q16 *within_px_q16, const drogue_ray rays[RAYS])
{
    drogue_real normal[6];
    int round;
    for (round = 0; round < 3; round++) {
        drogue_q16 rms;
        memset(s, 0, sizeof *s);
        drogue_ray_sums_add_edges(s, NULL, rays, v_px_q16, *within_px_q16);
        if (!drogue_ray_sums_solve(v_px_q16, normal, s, 1)) {
            return 0;
        }
        rms = drogue_ray_sums_rms(s);
        *within_px_q16 = larger(DROGUE_Q16(1, 4), 3 * rms < *within_px_q16 ? 3 * rms : *within_px_q16);
    }
    return 1;
}

/* Where the steepest edge is of another size than expected, as a collar's about the disc, one of the size that lies
 * beyond it takes its place: so many rays see it apart, elsewhere both may be one. Returns whether there is one. */
static int prefer_size(drogue_q16 v_px_q16[3], drogue_ray rays[RAYS], uint32_t least)
{
    drogue_q16 v[3];
    drogue_ray_sums s;
    v[0] = v_px_q16[0];
    v[1] = v_px_q16[1];
    v[2] = 0;
    drogue_rays_keep(rays, v_px_q16, v_px_q16[2] > 0 ? DROGUE_Q16_MIN : APART,
                     v_px_q16[2] > 0 ? -APART : DROGUE_Q16_MAX);
    if (!drogue_ray_sums_settle(&s, v, rays, drogue_q16_add(drogue_q16_abs(v_px_q16[2]), DROGUE_Q16(1, 1)), APART, 0) ||
        s.rays < least) {
        return 0;
    }
    memcpy(v_px_q16, v, sizeof v);
    return 1;
}

/* Measure about a first place: which rays see the edge, and how large it is, by its steepest place; where it is, by
 * half as many rays as it has pixels, at most 512. */
static drogue_status measure(drogue_inner_edge *out, drogue_ray rays[RAYS], const drogue_image *image,
                             const drogue_ellipse *e, drogue_ray_look look, drogue_q16 within_px_q16,
                             const drogue_config *config)
{
    drogue_q16 within = within_px_q16;
    drogue_q16 v[3] = {0, 0, 0};
    drogue_q16 size;
    drogue_inner_shade grey;
    drogue_ray_sums s;
    drogue_ray_bins bins;
    int32_t phases = e->a_px_q16 / DROGUE_Q16(20, 1); /* pi a over 64 */
    const int32_t every = e->a_px_q16 < SMALL ? EVERY : 1;
    int32_t k;
    phases = drogue_clamp_s32(phases, 1, 8);
    drogue_rays_cast(rays, image, e, 0, 4, every, config->min_inner_contrast, look);
    if (!narrow(&s, v, &within, rays) || !drogue_inner_shade_find(&grey, rays, image, config->transfer, v, within)) {
        return DROGUE_E_NO_INNER_PART;
    }
    out->contrast = (uint8_t)drogue_clamp_s32(
        (int32_t)drogue_div_round_s64(s.slopes_q8, (int64_t)s.rays * DROGUE_RAY_WEIGHT * 256), 0, 255);
    out->threshold =
        (uint8_t)drogue_clamp_s32((int32_t)drogue_div_round_s64(s.levels_q8, (int64_t)s.rays * 256), 0, 255);
    drogue_inner_shade_cross(rays, image, config->transfer, &grey, v, every);
    within = within_px_q16;
    size = v[2];
    if (!narrow(&s, v, &within, rays)) {
        return DROGUE_E_NO_INNER_PART;
    }
    memset(&s, 0, sizeof s);
    memset(&bins, 0, sizeof bins);
    for (k = 0; k < phases; k++) {
        const drogue_q16 about[3] = {v[0], v[1], size};
        if (phases > 1) { /* or they have been cast */
            drogue_rays_aim(rays, e, (8 * k + 4) / phases % 8, 0, DROGUE_RAYS / 2);
            drogue_inner_shade_cross(rays, image, config->transfer, &grey, about, 1);
        }
        drogue_ray_sums_add_edges(&s, &bins, rays, v, within);
    }
    if (!drogue_ray_sums_place(v, &out->std_px_q16, &s, &bins)) {
        return DROGUE_E_NO_INNER_PART;
    }
    out->spread_px_q16 = drogue_ray_sums_rms(&s);
    out->rays = ((uint32_t)every * s.rays + (uint32_t)phases / 2) / (uint32_t)phases;
    out->grown_px_q16 = drogue_q16_add(v[2], INWARD);
    out->x_px_q16 = drogue_q16_add(e->xc_px_q16, v[0]);
    out->y_px_q16 = drogue_q16_add(e->yc_px_q16, v[1]);
    return DROGUE_OK;
}

/* An edge may be reached from both expected discs: the nearer one is what it is compared with. */
static void name_nearer(drogue_inner_edge *edge, const drogue_inner_expected *expected)
{
    const drogue_ellipse *was = &expected->disc[edge->which];
    uint32_t i;
    for (i = 0; i < expected->count; i++) { /* bound: 2 */
        const drogue_ellipse *e = &expected->disc[i];
        if (drogue_inner_away2_q32(edge, e) < drogue_inner_away2_q32(edge, &expected->disc[edge->which])) {
            edge->which = i;
        }
    }
    edge->grown_px_q16 =
        drogue_q16_add(edge->grown_px_q16, drogue_q16_sub(was->a_px_q16, expected->disc[edge->which].a_px_q16));
}

/* Rounded to 1/256 px, in which rays read the image: a first place's last bits need not move them. */
static drogue_q16 whole(drogue_q16 v_px_q16) { return drogue_q16_add(v_px_q16, 128) & ~255; }

/* Where an expected disc may be: how far off and how much larger, how steep the edges are that say so, and what shows
 * it. */
typedef struct first_place {
    drogue_q16 v_px_q16[3];
    int32_t slopes_q8; /* 0: nowhere */
    drogue_ray_look look;
} first_place;

/* Look for a disc within the gate about where it is expected. One that shade surrounds, as within a coupling, is the
 * smaller step of two that are near each other. Returns 1 when it is seen in its place, of its size. */
static int look_about(first_place *out, drogue_ray rays[RAYS], const drogue_image *image, const drogue_ellipse *e,
                      drogue_q16 gate_px_q16, const drogue_config *config)
{
    const drogue_q16 room = drogue_inner_room(e, config);
    const drogue_q16 reach = drogue_q16_add(gate_px_q16, drogue_q16_add(e->a_px_q16 / 16, DROGUE_Q16(2, 1)));
    drogue_q16 *const v = out->v_px_q16;
    drogue_ray_sums s;
    memset(out, 0, sizeof *out);
    drogue_rays_cast(rays, image, e, reach, 4, EVERY, config->min_inner_contrast, DROGUE_RAY_RISES);
    if (!drogue_ray_sums_settle(&s, v, rays, drogue_q16_add(gate_px_q16, DROGUE_Q16(1, 1)),
                                larger(DROGUE_Q16(3, 2), reach / 16), 1)) {
        return 0;
    }
    out->slopes_q8 = s.slopes_q8;
    if (drogue_q16_abs(v[2]) > drogue_q16_add(e->a_px_q16 / 64, DROGUE_Q16(1, 2))) {
        const int is_too_large = v[2] > room;
        if (!prefer_size(v, rays, APPEAR) && is_too_large) {
            drogue_rays_cast(rays, image, e, reach, 4, EVERY, config->min_inner_contrast, DROGUE_RAY_FINE_RISES);
            out->look = prefer_size(v, rays, APPEAR_FINE) ? DROGUE_RAY_FINE_RISES : DROGUE_RAY_RISES;
        }
    }
    return 8 * s.rays * EVERY >= 7 * RAYS && drogue_q16_abs(v[2]) <= room &&
           drogue_square_sum(v[0], v[1]) <= drogue_square_sum(gate_px_q16, 0);
}

/* Measure about a first place of one of the expected discs. */
static drogue_status measure_at(drogue_inner_edge *out, drogue_ray rays[RAYS], const drogue_image *image,
                                const drogue_inner_expected *expected, uint32_t which, const first_place *first,
                                const drogue_config *config)
{
    const drogue_q16 grown = whole(first->v_px_q16[2]);
    drogue_ellipse at = expected->disc[which];
    drogue_status status;
    memset(out, 0, sizeof *out);
    at.xc_px_q16 = whole(drogue_q16_add(at.xc_px_q16, first->v_px_q16[0]));
    at.yc_px_q16 = whole(drogue_q16_add(at.yc_px_q16, first->v_px_q16[1]));
    at.a_px_q16 = drogue_q16_add(at.a_px_q16, grown);
    at.b_px_q16 = drogue_q16_add(at.b_px_q16, grown);
    if (at.b_px_q16 < DROGUE_Q16_ONE) {
        return DROGUE_E_NO_INNER_PART;
    }
    status = measure(out, rays, image, &at, first->look, WITHIN, config);
    if (status == DROGUE_OK && out->spread_px_q16 > config->inner_rms_px_q16 && drogue_inner_jagged(&at) > 0) {
        status = measure(out, rays, image, &at, first->look, WITHIN + drogue_inner_jagged(&at) / JAGGED, config);
    }
    if (status != DROGUE_OK) {
        memset(out, 0, sizeof *out);
        return status;
    }
    out->grown_px_q16 = drogue_q16_add(out->grown_px_q16, grown);
    out->which = which;
    name_nearer(out, expected);
    return DROGUE_OK;
}

/* What its standard deviation says of a disc: 0 where it is not to be believed. */
static drogue_q16 credit(const drogue_inner_edge *edge, const drogue_inner_expected *expected,
                         const drogue_ellipse *outline, const drogue_config *config)
{
    return drogue_inner_std(edge, &expected->disc[edge->which], outline, config);
}

/* Look between the discs of the two poses: of an outline seen nearly head-on a shape a little off puts both beside the
 * disc, to either side of it, where arcs of other edges may stand for it. Returns 1 when one is seen all about; its
 * place is told from the first one's. */
static int look_between(first_place *out, drogue_ray rays[RAYS], const drogue_image *image,
                        const drogue_inner_expected *expected, drogue_q16 gate_px_q16, const drogue_config *config)
{
    const drogue_q16 x = drogue_q16_sub(expected->disc[1].xc_px_q16, expected->disc[0].xc_px_q16) / 2;
    const drogue_q16 y = drogue_q16_sub(expected->disc[1].yc_px_q16, expected->disc[0].yc_px_q16) / 2;
    const drogue_q16 half = drogue_q16_add(drogue_q16_abs(x), drogue_q16_abs(y));
    drogue_ellipse e = expected->disc[0];
    e.xc_px_q16 += x; /* between the two */
    e.yc_px_q16 += y;
    if (half <= gate_px_q16 || /* it has been looked for there */
        !look_about(out, rays, image, &e, drogue_q16_add(gate_px_q16, half / 4), config)) {
        return 0;
    }
    out->v_px_q16[0] = drogue_q16_add(out->v_px_q16[0], x);
    out->v_px_q16[1] = drogue_q16_add(out->v_px_q16[1], y);
    return 1;
}

drogue_status drogue_inner_edge_find(drogue_inner_edge *out, drogue_ray rays[RAYS], const drogue_image *image,
                                     const drogue_inner_expected *expected, const drogue_ellipse *outline,
                                     const drogue_config *config)
{
    const drogue_q16 gate_px_q16 = drogue_inner_gate(outline, config);
    first_place first[2];
    first_place between;
    drogue_inner_edge other;
    drogue_status status;
    uint32_t which;
    memset(out, 0, sizeof *out);
    memset(first, 0, sizeof first);
    if (expected->count == 0) {
        return DROGUE_E_NO_INNER_PART;
    }
    if (!look_about(&first[0], rays, image, &expected->disc[0], gate_px_q16, config) && expected->count > 1 &&
        !look_about(&first[1], rays, image, &expected->disc[1], gate_px_q16, config) &&
        look_between(&between, rays, image, expected, gate_px_q16, config)) { /* where one is seen no other is sought */
        status = measure_at(&other, rays, image, expected, 0, &between, config);
        if (status == DROGUE_OK && credit(&other, expected, outline, config) > 0) {
            *out = other;
            return DROGUE_OK;
        }
    }
    which = first[1].slopes_q8 > first[0].slopes_q8;
    if (first[which].slopes_q8 == 0) {
        return DROGUE_E_NO_INNER_PART;
    }
    status = measure_at(out, rays, image, expected, which, &first[which], config);
    if (first[1 - which].slopes_q8 > 0 && (status != DROGUE_OK || credit(out, expected, outline, config) == 0) &&
        measure_at(&other, rays, image, expected, 1 - which, &first[1 - which], config) == DROGUE_OK &&
        other.grown_px_q16 <= expected->disc[other.which].a_px_q16 / LARGER &&
        credit(&other, expected, outline, config) > 0) {
        *out = other; /* what is steeper is another edge of the drogue */
        status = DROGUE_OK;
    }
    return status;
}
