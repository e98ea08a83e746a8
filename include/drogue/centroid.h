/* SPDX-License-Identifier: Apache-2.0 */
/* The inner black part: disc mask, Otsu's threshold, 3x3 opening, largest dark component, centroid (paper (17)). */
#ifndef DROGUE_CENTROID_H
#define DROGUE_CENTROID_H

#include "drogue/frontend.h"
#include "drogue/mask.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Otsu's threshold: the level t that maximises the variance between the classes <= t and > t.
 *
 *  histogram  256 counts; their sum at most 2^22
 *  return     threshold in [0, 255]: the least of equals; 0 for a histogram of fewer than two levels
 *  error      exact: variances are compared as integer fractions
 */
uint8_t drogue_otsu(const uint32_t *histogram);

typedef struct drogue_inner_part {
    drogue_q16 x_px_q16; /* centroid, region coordinates */
    drogue_q16 y_px_q16;
    uint32_t area_px;         /* pixels; drogue_inner_find(): sum of darkness */
    drogue_q16 spread_px_q16; /* drogue_inner_find(): between the centroids at a lower and a higher threshold */
    uint8_t threshold;        /* Otsu's of the disc, or of drogue_inner_find()'s window about the part; grey level */
    uint8_t contrast;         /* drogue_inner_find(): between the means of what is above and below it, grey levels */
} drogue_inner_part;

/* Find the largest dark component inside a disc.
 *
 *  out        centroid and area; of equal areas the one whose first pixel comes first
 *  workspace  its edges and arcs are left alone
 *  image      the region's pixels, width_px <= capacity.width_px
 *  disc       in the image's own coordinates; the disc is of radius longest / 3
 *  min_area   least area of the component, px
 *  return     DROGUE_OK, DROGUE_E_NO_INNER_PART, DROGUE_E_LABELS_FULL, DROGUE_E_ARGUMENT, DROGUE_E_WORKSPACE
 *  error      threshold and mask exact; centroid <= 1 LSB
 */
drogue_status drogue_inner_part_find(drogue_inner_part *out, drogue_workspace *workspace, const drogue_image *image,
                                     const drogue_mask *disc, uint32_t min_area);

/* Find the inner disc where it is expected: the components whose centroids lie within one of the expected discs, taken
 * together (bright ribs may cut it), then the centroid of darkness in a window about it, which counts the pixels at its
 * edge by their grey.
 *
 *  out         centroid, area (sum of darkness, rounded), Otsu's threshold
 *  which       out: index of the expected disc that fits better in place and area
 *  image, disc, min_area, return  as drogue_inner_part_find()
 *  expected    count (1 or 2) discs, region coordinates: centre and semi-axes
 *  error       centroid <= 1 LSB of the exact sums' quotient
 */
drogue_status drogue_inner_find(drogue_inner_part *out, uint32_t *which, drogue_workspace *workspace,
                                const drogue_image *image, const drogue_mask *disc, uint32_t min_area,
                                const drogue_ellipse *expected, uint32_t count);

/* Area of a inner part over that of an expected disc, Q16, saturated. */
drogue_q16 drogue_inner_fill(const drogue_inner_part *part, const drogue_ellipse *expected);

#ifdef __cplusplus
}
#endif
#endif
