/* SPDX-License-Identifier: Apache-2.0 */
/* The inner part: where a pose expects it, its edge by rays, and how far what was found is to be believed. */
#ifndef DROGUE_INNER_H
#define DROGUE_INNER_H

#include "drogue/config.h"
#include "drogue/decide.h"
#include "drogue/frontend.h"
#include "drogue/rays.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The inner part as a result of drogue_measure() holds it, px of the whole image. */
typedef struct drogue_inner_part {
    drogue_q16 x_px_q16;      /* centre of the edge */
    drogue_q16 y_px_q16;      /* downward */
    uint32_t area_px;         /* of the ellipse */
    drogue_q16 spread_px_q16; /* root mean square of the rays' residuals */
    uint8_t threshold;        /* grey level at the edge */
    uint8_t contrast;         /* grey levels across the edge */
    uint8_t rays;             /* that see the edge, of DROGUE_RAYS */
} drogue_inner_part;

/* What is looked for. */
typedef struct drogue_inner_expected {
    uint32_t count;         /* how many of them there are */
    drogue_ellipse disc[2]; /* images of the inner disc for either pose, as seen, region coordinates */
} drogue_inner_expected;

/* Images of the inner disc for both poses, through the lens: a pose whose disc is behind the camera, edge-on or under a
 * pixel has none.
 *
 *  expected  out, coordinates of the region whose pixel (0, 0) is pixel (x_px, y_px) of the image
 */
void drogue_inner_expect(drogue_inner_expected *expected, const drogue_pose poses[2], const drogue_setup *setup,
                         int32_t x_px, int32_t y_px);

typedef char drogue_assume_rays_fit[DROGUE_RAYS * sizeof(drogue_ray) <= DROGUE_SCRATCH_BYTES ? 1 : -1];

/* The inner disc as its own edge shows it. */
typedef struct drogue_inner_edge {
    drogue_q16 x_px_q16;      /* centre, region coordinates */
    drogue_q16 y_px_q16;      /* downward */
    drogue_q16 grown_px_q16;  /* by how much its semi-axes are larger than expected */
    drogue_q16 std_px_q16;    /* standard deviation of either coordinate, from the rays' residuals */
    drogue_q16 spread_px_q16; /* root mean square of the residuals */
    uint32_t rays;     /* that agree, of 64; a disc under 10 px is measured by half of them, and each counts twice */
    uint32_t which;    /* of the expected discs: the nearer one */
    uint8_t threshold; /* mean grey at the edge */
    uint8_t contrast;  /* mean step of grey across the edge */
} drogue_inner_edge;

/* Squared distance of its centre from an expected one, px^2 Q32. */
uint64_t drogue_inner_away2_q32(const drogue_inner_edge *edge, const drogue_ellipse *expected);

/* How far from the expected centre the disc may be, by the configured gate. */
static inline drogue_q16 drogue_inner_gate(const drogue_ellipse *outline, const drogue_config *config)
{
    return drogue_q16_add(config->inner_gate_px_q16, drogue_q16_mul(config->inner_gate_q16, outline->a_px_q16));
}

/* By how much its semi-axes may be longer or shorter than expected. */
static inline drogue_q16 drogue_inner_room(const drogue_ellipse *expected, const drogue_config *config)
{
    return drogue_q16_add(config->inner_size_px_q16, drogue_q16_mul(config->inner_size_q16, expected->a_px_q16));
}

/* px: semi-axis of a disc; the ends of ribs and panels about a larger one are seen by themselves. */
#define DROGUE_INNER_JAGGED DROGUE_Q16(15, 1)

/* By how much a disc is larger than that, px Q16, at most 10 px. */
static inline drogue_q16 drogue_inner_jagged(const drogue_ellipse *disc)
{
    return drogue_clamp_s32(disc->a_px_q16, DROGUE_INNER_JAGGED, DROGUE_Q16(25, 1)) - DROGUE_INNER_JAGGED;
}

/* Measure the disc by its edge along rays across the ellipse that a pose expects: where the grey rises fastest says
 * which rays see it, where it has risen by a quarter of the usual step above the disc's own where it is and how large,
 * by a fit of place and size to the rays that agree; of an encoded image where its light has. Ribs, a wall or a probe
 * that touch the disc cost rays, not place; a ring about it or light from one side hardly move what is dark.
 * The grey beyond it must be above the disc's own by 12 standard errors of that: rays choose what rises, in noise
 * as well. Where the edge that rises fastest is of another size than expected, and one of the size is beside it, that
 * one is the disc's: shown by 16 of 64 rays or, of one that is too large to be believed, as shade's about the disc, by
 * 24 in samples half as far apart (DROGUE_RAY_FINE_RISES). Of a large one whose edge scatters more than that of a small
 * one may, edges in a wider band count: it may be jagged.
 *
 *  out      of the expected discs the one whose rays agree with the steepest edges; the other one where that is not to
 *           be believed (drogue_inner_std()), but the other is and is no larger than it should be. Where neither is
 *           seen whole, in its place, the one between them that is, and is to be believed. Zero on failure
 *  rays     work area; the workspace has one
 *  image    the region's pixels
 *  outline  region coordinates; the centre may lie from the expected one as far as the configured gate
 *  return   DROGUE_OK; DROGUE_E_NO_INNER_PART when fewer than eight rays agree, or noise explains what they see
 */
drogue_status drogue_inner_edge_find(drogue_inner_edge *out, drogue_ray rays[DROGUE_RAYS], const drogue_image *image,
                                     const drogue_inner_expected *expected, const drogue_ellipse *outline,
                                     const drogue_config *config);

/* Standard deviation of the disc's centre: a floor, a share of the disc's size, and what the rays' residuals show; and,
 * where its size puts more than an eighth in doubt (drogue_inner_weigh()), so much of it: what is so small or so large
 * may be something else. Its place is the expected one within the configured gate; within twice that where it is
 * evident: seen by seven of eight rays, with half of the scatter that is allowed of a small one, of its size to 0.3 px
 * and a 64th.
 *
 *  expected, outline  region coordinates
 *  return             px Q16; 0 when it is not to be believed: of another size, in another place, cut by the rim, or
 *                     too few rays agree; -1 when it is too large, and nothing else speaks against it
 */
drogue_q16 drogue_inner_std(const drogue_inner_edge *edge, const drogue_ellipse *expected,
                            const drogue_ellipse *outline, const drogue_config *config);

/* The inner part as evidence between the poses. */
typedef struct drogue_inner_evidence {
    drogue_inner_part part;     /* px of the whole image; zero when it is not believed */
    drogue_joint_inner weighed; /* its centre without distortion; std 0 when it is not believed */
    /* [0, 1]: nearer over farther distance of the projected inner centres; 1 when not believed */
    drogue_q16 ambiguity_q16;
    /* 1: a disc is seen that would be believed but for its size, which is too large for the outline */
    int32_t too_large;
    uint32_t nearer;        /* index of the pose whose projected inner centre is nearer, believed or not; 0 of a part
                               that is smaller than min_inner_area, beyond the lens model, or behind the camera for
                               one of the poses */
    drogue_q16 doubt_q16;   /* share by which the disc's size puts the distance in doubt */
    drogue_q16 too_far_q16; /* share by which size and place say that the outline's pose is too far */
} drogue_inner_evidence;

/* Weigh the disc, and see which pose it is nearer to. Its size puts the distance in doubt by the share by which it is
 * too large, if 1/32 or more, and not at all below 1/64; by half of that by which it is too small, beyond half a pixel.
 * Where it is seen by seven of eight rays, is too large by at most an eighth and lies farther beside its place than it
 * is too large, the outline is too far: by three quarters of the share by which it is too large beyond 1/256; or, if
 * that is less, of half of what it lies farther beside its place.
 *
 *  region             pixel (0, 0) of it is where coordinates of the region begin
 *  expected, outline  region coordinates: the discs, the ellipse as seen
 */
void drogue_inner_weigh(drogue_inner_evidence *evidence, const drogue_inner_edge *edge, const drogue_region *region,
                        const drogue_inner_expected *expected, const drogue_ellipse *outline,
                        const drogue_pose poses[2], const drogue_setup *setup);

/* What the disc says, as a part of a frame's evidence. */
static inline void drogue_inner_testify(drogue_evidence *out, const drogue_inner_evidence *inner)
{
    out->inner = inner->weighed;
    out->nearer = inner->nearer;
    out->doubt_q16 = inner->doubt_q16;
    out->too_far_q16 = inner->too_far_q16;
}

/* Look for the inner disc about a region's middle, where no outline says where it is and how large: a dark circle of
 * which 24 of 32 rays see the edge, from the place among 13 whose rays see the steepest one: the disc's, or that of a
 * collar about it.
 *
 *  out     region coordinates, semi-axes alike
 *  rays    work area; the workspace has one
 *  view    the region's pixels
 *  mask    of the region asked for, at most DROGUE_MAX_REGION a side, as if made for a drogue in its middle: 2.4 times
 *          the outline's semi-axis
 *  return  1: there is one; none where the disc would be under 3 px, the model has none, or of 32 rays from the
 *          region's middle fewer than 3 see grey rise by twice the least contrast (of an outline up to 512 px)
 */
int drogue_inner_seek(drogue_ellipse *out, drogue_ray rays[DROGUE_RAYS], const drogue_image *view,
                      const drogue_mask *mask, const drogue_setup *setup);

/* A disc as seen from the camera. */
typedef struct drogue_inner_sight {
    drogue_q16 x_q16;         /* tangent of its middle's direction, to the right */
    drogue_q16 y_q16;         /* the same downward */
    drogue_q16 length_q16;    /* of (x, y, 1) */
    drogue_q16 yaw_rad_q16;   /* of its middle's direction: atan(x) */
    drogue_q16 pitch_rad_q16; /* the same: atan2(y, length of (x, 1)) */
    drogue_q16 radius_q16;    /* tangent of its radius, were it on the optical axis, about */
} drogue_inner_sight;

/* Where a disc is; 0 when it reaches farther than 45 degrees off the axis, or beyond the lens model.
 *
 *  disc  as the lens shows it, px of the whole image
 */
int drogue_inner_sight_of(drogue_inner_sight *sight, const drogue_ellipse *disc, const drogue_camera *camera);

#define DROGUE_INNER_TURNS 6 /* steps of 0.08 rad by which a drogue is turned from the line of sight at most */

/* Outlines of two drogues whose disc is seen there, turned from the line of sight by so many steps and by the opposite:
 * a first guess, to some per cent of their size. Through the lens; as drogue_inner_expect().
 *
 *  yaw, pitch  [-DROGUE_INNER_TURNS, DROGUE_INNER_TURNS]
 */
void drogue_inner_rims(drogue_inner_expected *rims, const drogue_inner_sight *sight, int32_t yaw, int32_t pitch,
                       const drogue_setup *setup, int32_t x_px, int32_t y_px);

/* Most edge points that drogue_inner_beyond() and drogue_inner_along() write: drogue_outline_settle() still looks at
 * every one of so many. */
#define DROGUE_INNER_BEYOND_POINTS 511

/* Look along rays for an outline that is larger than the one found: where an inner disc is of the size for it. It is
 * an edge of either sign in six of eight parts, within 3/4 px of one place and size: on 48 of 64 rays by
 * DROGUE_RAY_LINES, as the outer edge of a lip whose inner one was found; or, of a step that may be too low for the
 * edge detector, on 28 rays by DROGUE_RAY_STEPS. Steps are of 16 grey levels and half of drogue_noise_threshold(), or
 * of 10 and a quarter of it, whichever is more: noise alone is none.
 *
 *  workspace  out: its edge points, from 0 on, on eight times the rays; as many as there is room for
 *  view       the region's pixels
 *  about      where it is expected, region coordinates; b >= 1 px and a <= 180 px, else there is none
 *  beyond     px Q16, above 0: by how much the semi-axes of the outline found are shorter; the other is looked for from
 *             half of that within 'about' to 5/8 and 1 px outside of it
 *  return     the number of points; 0: there is none, and the edge points are as they were
 */
uint32_t drogue_inner_beyond(const drogue_workspace *workspace, const drogue_image *view, const drogue_ellipse *about,
                             drogue_q16 beyond_px_q16);

/* Edge points along rays where an edge of either sign is within 3/4 px of a place that many rays together have shown,
 * as drogue_outline_outer() does: a step of 8 grey levels and of three quarters of drogue_noise_threshold(), of which
 * noise alone has too few; of several the steeper and nearer one.
 *
 *  workspace  out: its edge points, from 0 on, on eight times the rays; as many as there is room for
 *  view       the region's pixels
 *  about      the place, region coordinates; b >= 1 px and a <= 180 px, else there is none
 *  return     the number of points
 */
uint32_t drogue_inner_along(const drogue_workspace *workspace, const drogue_image *view, const drogue_ellipse *about);

#ifdef __cplusplus
}
#endif
#endif
