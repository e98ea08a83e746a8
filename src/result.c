/* SPDX-License-Identifier: Apache-2.0 */
/* A result before anything is known, and what must hold for one to be sought. */
#include <string.h>

#include "drogue/measure.h"
#include "drogue/undistort.h"

void drogue_result_clear(drogue_result *out)
{
    int k;
    memset(out, 0, sizeof *out);
    out->ambiguity_q16 = DROGUE_Q16_ONE;
    for (k = 0; k < 4; k++) {
        out->arcs[k] = DROGUE_NO_ARC;
    }
}

int drogue_input_valid(const drogue_image *image, const drogue_setup *setup)
{
    return image->data != NULL && image->width_px >= 1 && image->height_px >= 1 && image->stride >= image->width_px &&
           drogue_camera_valid(setup->camera) && drogue_model_valid(setup->model) && drogue_config_valid(setup->config);
}
