/* SPDX-License-Identifier: Apache-2.0 */
/* The second pass: threshold, opening, labelling, area and coordinate sums of each dark component. */
#ifndef DROGUE_HLS_COMPONENTS_H
#define DROGUE_HLS_COMPONENTS_H

#include "../../src/inner/pass.h"
#include "../drogue_hls.h"

/* Next pixel of the stream. It is taken whether its level matters or not: an ordinary load may be moved to where it does. */
static inline uint8_t drogue_hls_take_pixel(const uint8_t *pixels, uint32_t at)
{
    return *(const volatile uint8_t *)&pixels[at];
}

/* Take the components of a pass, pixels[at] its first, in a disc: drogue_hls_disc_left() and centre; full is set when a
 * label was refused. */
void drogue_hls_take_components(const uint8_t *pixels, uint32_t at, int32_t width, int32_t height, int64_t disc_left,
                                int32_t centre2_x, int32_t centre2_y, uint8_t threshold, uint32_t *full);

/* Choose among them, as drogue_inner_choose(). */
drogue_status drogue_hls_choose_components(drogue_inner_part *part, uint32_t *which,
                                           const drogue_inner_expected *expected);

#endif
