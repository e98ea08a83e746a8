/* SPDX-License-Identifier: Apache-2.0 */
/* What program and Python package refuse before the library sees it. Each function returns what is wrong, or NULL. */
#ifndef CLI_RANGES_H
#define CLI_RANGES_H

#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

const char *ranges_focal(const drogue_camera *c);
const char *ranges_lens(const drogue_camera *c);
const char *ranges_centre(const drogue_camera *c, int32_t width_px, int32_t height_px); /* of the image */
const char *ranges_model(const drogue_model *m);
const char *ranges_region(const drogue_region *r);

#ifdef __cplusplus
}
#endif

#endif
