/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the outline stage: what light an encoded level stands for. */
#ifndef DROGUE_LIGHT_H
#define DROGUE_LIGHT_H

#include <stdint.h>

/* By the inverse of sRGB's transfer function (IEC 61966-2-1), such that white stays 255, Q8: v / 12.92 up to 0.04045,
 * then ((v + 0.055) / 1.055)^2.4. */
extern const uint16_t drogue_srgb_light_q8[256];

#endif
