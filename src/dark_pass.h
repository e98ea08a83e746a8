/* SPDX-License-Identifier: Apache-2.0 */
/* What the two ways to find the dark inner part share: rows of a disc, its threshold, the components in it. */
#ifndef DROGUE_DARK_PASS_H
#define DROGUE_DARK_PASS_H

#include "drogue/centroid.h"

/* Components of the opened binary image with area and coordinate sums, in the tables of the workspace. The sums
 * fit 32 bits: those over all pixels of 2048 x 2048 do. */
typedef struct drogue_dark_pass {
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
} drogue_dark_pass;

static inline drogue_q16 drogue_dark_mean_q16(int64_t sum, int64_t count)
{
    return (drogue_q16)drogue_div_round_s64(sum * DROGUE_Q16_ONE, count);
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
drogue_status drogue_dark_components(drogue_dark_pass *pass, drogue_dark_part *out, drogue_workspace *workspace,
                                     const drogue_image *image, const drogue_mask *disc);

#endif
