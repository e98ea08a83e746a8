/* SPDX-License-Identifier: Apache-2.0 */
/* The second pass: threshold, opening, labelling, area and coordinate sums of each dark component. */
#ifndef DROGUE_HLS_COMPONENTS_H
#define DROGUE_HLS_COMPONENTS_H

#include "../../src/dark_pass.h"
#include "../drogue_hls.h"

/* A pass over the region's pixels. */
typedef struct drogue_hls_region {
    int32_t width_px;
    int32_t height_px;
} drogue_hls_region;

/* Take the components of a pass, pixels[at] its first; full is set when a label was refused. */
void drogue_hls_take_components(const uint8_t *pixels, uint32_t at, const drogue_hls_region *region,
                                const drogue_mask *disc, uint8_t threshold, uint32_t *full);

/* Choose among them, as drogue_dark_choose(). */
drogue_status drogue_hls_choose_components(drogue_dark_part *part, uint32_t *which, uint32_t min_area,
                                           const drogue_ellipse expected[2], uint32_t count);

#endif
