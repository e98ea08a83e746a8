/* SPDX-License-Identifier: Apache-2.0 */
/* One frame: drogue_measure(), and what it gives. */
#ifndef DROGUE_MEASURE_H
#define DROGUE_MEASURE_H

#include "drogue/config.h"
#include "drogue/frontend.h"
#include "drogue/inner.h"
#include "drogue/outline.h"
#include "drogue/pose.h"
#include "drogue/version.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Initialiser of a drogue_capacity that suits a region of the given longest side: workspace.h. */
#define DROGUE_CAPACITY_FOR(side_px)                                                                    \
    {                                                                                                   \
        (uint32_t)(side_px), (uint32_t)DROGUE_EDGES_FOR(side_px), (uint32_t)DROGUE_LABELS_FOR(side_px), \
            (uint32_t)DROGUE_ARCS_FOR(side_px)                                                          \
    }

#define DROGUE_MAX_REGION 8192 /* px, largest side of a region asked for, before it is clipped to the image */

/* What of all that was tried stands, in the order in which it is tried, but RAYS last. */
typedef enum drogue_tried {
    DROGUE_TRIED_FOUND = 0,    /* the outline found by the configured thresholds of Canny */
    DROGUE_TRIED_LARGER,       /* a larger one about it; or the rim's outer edge about any, by the edges of that */
    DROGUE_TRIED_NOISE,        /* one by thresholds that follow the region's noise, higher where a table filled */
    DROGUE_TRIED_NOISE_LARGER, /* a larger one about that */
    DROGUE_TRIED_RAYS,         /* one along rays, for which the inner disc is of its size, or the rim's outer edge: its
                                  points are the list's edges, its quality that of the outline it was found from */
    DROGUE_TRIED_DISC          /* one that the inner disc led to, without arcs */
} drogue_tried;

/* What a frame gives. Coordinates are px of the whole image. */
typedef struct drogue_result {
    drogue_status status;           /* what drogue_measure() returned */
    drogue_second_look second_look; /* from TOO_WIDE on, of any try, a larger workspace may give another result */
    drogue_region region;           /* the region used: the one asked for, that of a better second look, or with
                                 DROGUE_TRIED_DISC one that suits the disc; where no try gave an outline the last
                                 one in which edges were looked for; clipped to the image */
    drogue_edge_list list;    /* edges and arcs in the workspace, in coordinates of the region; where no try gave an
                                 outline those of the last one; empty where drogue_track_frame() has looked elsewhere
                                 since */
    uint32_t arcs[4];         /* the arcs of the winning combination by quadrant, or DROGUE_NO_ARC; of a list that may
                                 be gone */
    drogue_tried tried;       /* what stands */
    drogue_ellipse ellipse;   /* outline of the end plane, as seen (distorted) */
    drogue_ellipse ideal;     /* the same without distortion: what the pose is computed from; the inner part may bring
                                 that nearer than its size says (drogue_decide()) */
    drogue_quality quality;   /* of the fit of the arcs */
    drogue_polarity polarity; /* DARK or BRIGHT: the outline's inside against its outside; BOTH: it changes */
    uint32_t cluster_members; /* candidates that agree with the winner, itself included */
    uint32_t refit_points;    /* points in the final fit */
    drogue_q16 cover_q16;     /* edge points that belong to the outline over its circumference, at most 1 */
    uint32_t outside;  /* parts of the ellipse, of eight, outside which another edge shows: that may be the rim's */
    int32_t has_inner; /* 1: an inner part was found and believed: of its size, in its place, with contrast */
    drogue_inner_part inner;      /* its centre, as seen; meaningful when has_inner */
    drogue_pose pose;             /* the pose chosen; unresolved: the one nearer to what is dark inside, unproved */
    drogue_pose alternative;      /* the other one that the outline allows */
    int32_t orientation_resolved; /* 1: the inner part decided between the two */
    drogue_q16 doubt_q16;      /* share of the distance that is in doubt by the inner part and by another edge outside,
                                  [0, 1): in the covariance */
    drogue_q16 ambiguity_q16;  /* [0, 1]: nearer over farther distance of the projected inner centres; 1 without one */
    int32_t covariance_halved; /* so often are all entries halved, for a variance of 2^15 or more to fit; mostly 0 */
    int64_t covariance_q48[5][5];  /* of x, y, z (m), yaw, pitch (rad); Q48, symmetric */
    int64_t position_std_m_q32[3]; /* roots of its first three diagonal entries, not halved, Q32 */
    int64_t axis_std_rad_q32;      /* root mean square angle between measured and true axis, Q32 */
} drogue_result;

/* No result yet: zero, without arcs, nothing decided. */
void drogue_result_clear(drogue_result *out);

/* Are an image, which may be of any size, and camera, model and thresholds within their ranges? */
int drogue_input_valid(const drogue_image *image, const drogue_setup *setup);

/* Measure one frame.
 *
 *  out        result; every member is defined for every return value, zero where there is nothing to say
 *  workspace  holds the edge points and arcs after the call. An outline that the ring mask cuts is looked for once more
 *             in a square region of its own, at most 5/2 of its semi-major axis a side: of an outline that fits into
 *             the region asked for, 5/4 of its longest side, of one as large as the default max_size takes, 15/8. A
 *             workspace for that width holds every second look; a smaller one keeps the first, and second_look says
 *             so. A region about a disc (DROGUE_TRIED_DISC) is as large as the outline that the disc allows asks for;
 *             with the lens and model of a real camera no larger
 *  setup      camera, model, thresholds, each within its range; the model's inner_radius 0: inner part unknown, both
 *             poses are given and the orientation stays unresolved
 *  image      the caller's, of any size, of which any pixel may be read, whatever the region; not written
 *  region     where to look, drogue about its middle, longest side 2 to 3 major semi-axes; may reach past the
 *             image, then the part inside is used and the masks stay where they were. In a region of another size the
 *             rim is cut or not in the ring, and what stands may be another edge, its covariance that edge's. Where
 *             nothing is found that stands, nor are more than a quarter of the ring's pixels edges, three quarters of
 *             the region's sides and five quarters, by whole eighths rounded down, are tried by the configured
 *             thresholds, with which rims in regions of 1.7 to 3.5 semi-axes lie in a ring mask; what is found there
 *             stands where its inner part is seen and less than a tenth off its size, or none is known. Five quarters
 *             are tried, too, where what stands has an inner part that is not seen or 4 % off its size, and take its
 *             place with one that is nearer to it. The workspace has to hold the wider one's width; second_look says
 *             where it does not
 *  return     DROGUE_OK, or why there is no pose: DROGUE_E_ARGUMENT, DROGUE_E_REGION, DROGUE_E_WORKSPACE,
 *             DROGUE_E_LABELS_FULL, DROGUE_E_EDGES_FULL, DROGUE_E_ARCS_FULL, DROGUE_E_NO_EDGES, DROGUE_E_NO_ARCS,
 *             DROGUE_E_NO_ELLIPSE, DROGUE_E_DOMAIN. Where the model has an inner part, an ellipse in which none is
 *             believed is none, either: when it lies all in the image and less than 7/10 of it is covered, when a disc
 *             is seen in its place that is too large for it, or when the disc that was sought asks for a rim that is
 *             larger by more than an eighth
 */
drogue_status drogue_measure(drogue_result *out, drogue_workspace *workspace, const drogue_setup *setup,
                             const drogue_image *image, const drogue_region *region);

#ifdef __cplusplus
}
#endif
#endif
