/* SPDX-License-Identifier: Apache-2.0 */
/* How large gradients are that noise alone makes. */
#ifndef DROGUE_NOISE_H
#define DROGUE_NOISE_H

#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Upper threshold that noise alone hardly passes: ten standard deviations. Noise is measured by second differences of
 * means of 3 x 3 px along every third row, summed over blocks of 9; the lowest tenth of the blocks counts, so that
 * edges do not. It is taken for white: a codec's or a sharpened image's counts as what smoothing leaves of it.
 *
 *  histogram  work area, 256 counts
 *  return     L1 Sobel magnitude, grey levels * 8, below 700; 0 for less noise than 0.3 levels, and of an image
 *             under 17 x 3 px
 */
int32_t drogue_noise_threshold(uint32_t *histogram, const drogue_image *image);

#ifdef __cplusplus
}
#endif
#endif
