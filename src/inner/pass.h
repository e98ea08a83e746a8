/* SPDX-License-Identifier: Apache-2.0 */
/* What the two ways to find the inner part share: rows of a disc, its threshold, the components in it. */
#ifndef DROGUE_INNER_PASS_H
#define DROGUE_INNER_PASS_H

#include "drogue/inner.h"

/* Components of the opened binary image with area and coordinate sums, in the tables of the workspace. The sums
 * fit 32 bits: those over all pixels of 2048 x 2048 do. */
typedef struct drogue_inner_pass {
    drogue_workspace *workspace;
    const drogue_image *image;
    const drogue_mask *disc;
    drogue_labels labels;
    uint32_t *binary; /* ring of 3 rows */
    uint32_t *eroded; /* ring of 3 rows */
    uint32_t *opened; /* 1 row */
    uint32_t *ones;   /* 1 row: outside the image for the erosion */
    uint32_t *zeros;  /* 1 row: outside the disc, and outside the image for the dilation */
    int32_t words;
    int32_t first_row; /* of the disc, within the image */
    int32_t last_row;
    uint32_t valid; /* columns of the last word */
    uint8_t threshold;
} drogue_inner_pass;

/* Darkness falls from 1 to 0 between two grey levels: a pixel at the edge counts by its grey, one of the surround not at
 * all. */
typedef struct drogue_inner_ramp {
    int32_t full;  /* level of darkness 'range' and more */
    int32_t range; /* levels to darkness 0, [1, 171]: 2 / 3 of 255, and 1 */
} drogue_inner_ramp;

/* Sums of darkness over a window of at most 2^22 pixels. */
typedef struct drogue_inner_sums {
    int64_t sum;
    int64_t x; /* weighted by the column */
    int64_t y; /* weighted by the row */
} drogue_inner_sums;

/* Mean of coordinates, within 1/32 of Q16's last place before it is rounded. */
drogue_q16 drogue_inner_mean_q16(int64_t sum, int64_t count);

/* Darkness of a grey level, [0, range]. */
static inline int32_t drogue_inner_darkness(int32_t level, const drogue_inner_ramp *ramp)
{
    const int32_t above = level - ramp->full;
    return above < 0 ? ramp->range : above > ramp->range ? 0 : ramp->range - above;
}

/* Add row y: its darkness and that weighted by the column, which 32 bits hold for 2048 columns. */
static inline void drogue_inner_add_row(drogue_inner_sums *sums, int32_t darkness, int32_t x_darkness, int32_t y)
{
    sums->sum += darkness;
    sums->x += x_darkness;
    sums->y += (int64_t)darkness * y;
}

/* Columns [*first, *last] of the disc in row y, within the image; 0 when there are none. */
int drogue_disc_span(int32_t *first, int32_t *last, const drogue_mask *disc, int32_t y, int32_t width_px);

/* Rows that a disc can reach, within the image. */
void drogue_disc_rows(int32_t *first, int32_t *last, const drogue_mask *disc, int32_t height_px);

/* Otsu's threshold of a disc, which leaves its histogram. */
uint8_t drogue_disc_threshold(uint32_t *histogram, const drogue_image *image, const drogue_mask *disc);

/* Threshold, open and label a disc: area and coordinate sums of each component's root in the workspace's tables
 * component_strong, arc_parent and arc_component.
 *
 *  out     zero but for the threshold
 *  return  DROGUE_OK, DROGUE_E_LABELS_FULL, DROGUE_E_ARGUMENT, DROGUE_E_WORKSPACE
 */
drogue_status drogue_inner_components(drogue_inner_pass *pass, drogue_inner_part *out, drogue_workspace *workspace,
                                      const drogue_image *image, const drogue_mask *disc);

/* Join what is summed by label, 1 .. count - 1: afterwards parent[i] is the root of i and roots alone have an area. */
void drogue_inner_join(uint32_t *parent, uint32_t *area, uint32_t *x_sum, uint32_t *y_sum, uint32_t count);

/* Choose among the expected discs the one that the components within it fit best; these together are the part.
 *
 *  out     area and place; as it was when the call fails
 *  which   out: index of the disc, 0 when the call fails
 *  area, x_sum, y_sum, labels  as drogue_inner_join() left them
 *  return  DROGUE_OK, DROGUE_E_NO_INNER_PART
 */
drogue_status drogue_inner_choose(drogue_inner_part *out, uint32_t *which, const uint32_t *area, const uint32_t *x_sum,
                                  const uint32_t *y_sum, uint32_t labels, const drogue_inner_expected *expected);

/* Disc about the part of a multiple of the expected semi-axis, and a pixel: WIDE to find its threshold, then NARROW to
 * weigh it. */
#define DROGUE_INNER_WIDE DROGUE_Q16(16, 10)
#define DROGUE_INNER_NARROW DROGUE_Q16(12, 10)
void drogue_inner_window(drogue_mask *window, const drogue_inner_part *part, drogue_q16 a_px_q16,
                         drogue_q16 factor_q16);

/* Contrast of a part and its ramp from its threshold and the histogram that gave that. The lower and the upper ramp
 * begin a third of the way to the dark level below and above. */
void drogue_inner_ramp_of(drogue_inner_ramp *ramp, drogue_inner_part *part, const uint32_t *histogram);
static inline int32_t drogue_inner_ramp_step(const drogue_inner_ramp *ramp) { return ramp->range / 2; }

/* Place and area of the darkness summed; without any the part stays as it is. */
void drogue_inner_place(drogue_inner_part *part, const drogue_inner_sums *sums, const drogue_inner_ramp *ramp);

/* Distance of a part from a point, px Q16. */
drogue_q16 drogue_inner_distance(const drogue_inner_part *part, drogue_q16 x_px_q16, drogue_q16 y_px_q16);

#endif
