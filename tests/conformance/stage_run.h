/* SPDX-License-Identifier: Apache-2.0 */
/* Between the files of the stage adapters only: guarded memory, inputs and outputs of one run. */
#ifndef DROGUE_TESTS_STAGE_RUN_H
#define DROGUE_TESTS_STAGE_RUN_H

#include "case_words.h"
#include "stages.h"

#include "drogue/drogue.h"
#include "drogue/support.h"
#include "drogue/track.h"

#define STAGE_MAX_BUFFERS 9

/* Run in progress. */
typedef struct stage_run {
    const conf_array *in;
    int in_count;
    drogue_image image; /* the first input, its rows apart, where the stage takes an image */
    conf_array *out;
    int out_capacity;
    int out_count;
    size_t used;                     /* bytes of the static memory */
    size_t guard[STAGE_MAX_BUFFERS]; /* offset of each buffer's guard */
    int guard_count;
} stage_run;

/* Cut a buffer from the static memory, a guard behind it, filled with a pattern; NULL when it does not fit. */
void *stage_take(stage_run *r, size_t bytes);

/* Workspace for regions of the given width; 0 when it does not fit. */
int stage_workspace(stage_run *r, drogue_workspace *workspace, int32_t width_px);

/* New output; NULL when it does not fit. */
void *stage_output(stage_run *r, const char *name, int bits, size_t count);
int32_t *stage_output32(stage_run *r, const char *name, size_t count); /* all 0 */
uint8_t *stage_output_image(stage_run *r, const char *name, int32_t width_px, int32_t height_px);

/* Words of a 32-bit input. */
const int32_t *stage_input32(const stage_run *r, int i);

/* Words to structs and back; stage_put_* return where to go on. */
drogue_ellipse stage_ellipse(const int32_t *words);
int32_t *stage_put_region(int32_t *at, const drogue_region *r);
int32_t *stage_put_ellipse(int32_t *at, const drogue_ellipse *e);
int32_t *stage_put_pose(int32_t *at, const drogue_pose *p);
int32_t *stage_put_estimate(int32_t *at, const drogue_track_estimate *e); /* without standard deviations */

/* Is the angle within [-pi/2, pi/2], what the library takes? */
int stage_angle_valid(const drogue_ellipse *e);

/* Mask from centre2_x centre2_y longest; 0 when out of the range that the library is for. */
int stage_mask(drogue_mask *mask, const int32_t *words);

/* Support with the given counts and sums, all bins dark; 0 when out of range. */
int stage_support_of_words(drogue_support *support, const int32_t *bins, int32_t gradient, int32_t axis);

/* The outputs of stage 'frame'. */
void stage_put_result(int32_t frame[38], int32_t detail[20], int64_t covariance[15], int64_t std[4],
                      const drogue_result *result);

/* The stages: 0 or CONF_E_*. Names, widths and counts of the inputs are checked before. */
int stage_smooth(stage_run *r);
int stage_gradient(stage_run *r);
int stage_canny(stage_run *r);
int stage_mask_images(stage_run *r);
int stage_arcs(stage_run *r);
int stage_constraints(stage_run *r);
int stage_select(stage_run *r);
int stage_ellipse_fit(stage_run *r);
int stage_quality(stage_run *r);
int stage_support(stage_run *r);
int stage_cluster(stage_run *r);
int stage_eigen(stage_run *r);
int stage_undistort(stage_run *r);
int stage_pose(stage_run *r);
int stage_joint(stage_run *r);
int stage_kalman(stage_run *r);
int stage_frame(stage_run *r);
int stage_rim(stage_run *r);
int stage_search(stage_run *r);
int stage_decide(stage_run *r);
int stage_look(stage_run *r);
int stage_acquire(stage_run *r);
int stage_follow(stage_run *r);
int stage_track(stage_run *r);

#endif
