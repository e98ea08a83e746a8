/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the measurement: a frame on its way, the looks at it, and what is made of an outline. */
#ifndef DROGUE_LOOK_H
#define DROGUE_LOOK_H

#include "drogue/inner.h"
#include "drogue/measure.h"
#include "drogue/outline.h"

#define DROGUE_BY_RAYS (-1) /* in place of a threshold */

/* What the workspace's edge points are: whoever wants others looks for them again. */
typedef struct drogue_held {
    drogue_region region; /* where they were looked for */
    int32_t canny_high;   /* by which upper threshold, or DROGUE_BY_RAYS */
} drogue_held;

/* What the best try so far gave. It lies in the workspace, which leaves the stack free. */
typedef struct drogue_best_try {
    drogue_q16 least_q16;  /* its doubt; DROGUE_Q16_MAX: it has no outline */
    drogue_q16 larger_q16; /* as the frame's */
    int32_t smeared;       /* does motion blur its outline, or what is taken for that? */
    int32_t crowded;       /* were edges everywhere where an outline was looked for first? */
    drogue_held held;      /* the edges that it is of */
    drogue_result result;
} drogue_best_try;

typedef char drogue_assume_best_try_fits[sizeof(drogue_best_try) + 4 <= DROGUE_BEST_BYTES ? 1 : -1];

typedef struct drogue_frame {
    drogue_result *out;
    drogue_workspace *workspace;
    const drogue_setup *setup;
    const drogue_image *image;
    drogue_image view; /* the region's pixels */
    drogue_mask mask;
    drogue_outline outline;
    drogue_held held;
    drogue_edge_list list; /* and how many there are */
    drogue_second_look second_look;
    drogue_second_look room; /* TOO_WIDE or FULL: what a try had too little room in; else NONE */
    int32_t canny_high;      /* to look by; the lower threshold is in proportion, as the configured ones are */
    int32_t crowded;         /* were edges everywhere in the region that the outline was looked for in first? */
    drogue_q16 larger_q16;   /* by what share the inner disc is larger than of its size; 0: it is not, or is not seen */
    drogue_q16 ring_px_q16;  /* semi-axis of the outline that a disc allows which was sought; 0: there is none */
    drogue_q16 doubt_q16;    /* in the inner disc's size, as in drogue_inner_evidence, a little more where disc and
                               outline contradict each other or it says that the outline is too far; 1: not seen, or
                               too large for the outline; more: no outline */
} drogue_frame;

/* Doubt where disc and outline contradict each other. It is less than that of a disc off its size, which another edge
 * of the drogue has: they do at a rim that fills the region, too, by what is not flat, thin or evenly lit. */
#define DROGUE_CONTRADICTION_Q16 DROGUE_Q16(1, 200)

/* Move an ellipse. */
void drogue_frame_move(drogue_ellipse *e, int32_t x_px, int32_t y_px);

/* The view becomes a region's pixels, and that the result's region. */
drogue_status drogue_frame_view(drogue_frame *f, const drogue_region *region);

/* Find the edges of a region by the frame's thresholds; the view becomes the region's pixels. */
drogue_status drogue_frame_edges(drogue_frame *f, const drogue_region *region);

/* An outline that the ring mask cuts is looked for once more; unless that is better, what was found first stands, and
 * where that is an outline its edges are found again. */
drogue_status drogue_frame_outline(drogue_frame *f, const drogue_region *region);

/* Look along rays for an outline about one in a region asked for, px of the whole image, that is larger by a share:
 * where the inner disc says that it is. The workspace's edge points become those of the rays, without arcs, if it has
 * room for them (DROGUE_E_EDGES_FULL). */
drogue_status drogue_frame_beyond(drogue_frame *f, const drogue_region *region, const drogue_ellipse *was,
                                  drogue_q16 larger_q16);

/* The rim's outer edge about an outline that is its inner one, three quarters of it and more: by the edge points that
 * there are, which are those that the outline was found by; else as above. */
drogue_status drogue_frame_outer(drogue_frame *f, const drogue_region *region, const drogue_ellipse *was);

/* The outline about the inner disc, which is sought: of those that it allows the one that edge points cover best, whose
 * size the frame has then, settled. DROGUE_E_NO_INNER_PART: there is no disc, and no edges were looked for. */
drogue_status drogue_frame_about_disc(drogue_frame *f, const drogue_region *region);

/* From the outline to the pose. Apart from the rest for its stack: that of the looks is not below it. */
drogue_status drogue_frame_judge(drogue_frame *f);

#endif
