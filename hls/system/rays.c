/* SPDX-License-Identifier: Apache-2.0 */
/* Grey levels along rays of the frame memory by the unit beside the soft core, in the place of the library's function; that one
 * reads what lies elsewhere. */
#define drogue_ray_read ray_read_by_core
#define drogue_ray_read_light ray_read_light_by_core /* these three are left out by the linker */
#define drogue_rays_aim rays_aim_by_core
#define drogue_rays_cast rays_cast_by_core
#include "../../src/outline/rays.c"
#undef drogue_ray_read

#include "machine.h"
#include "unit.h"

void drogue_ray_read(int32_t *grey_q8_out, const drogue_ray *r, const drogue_image *image, drogue_q16 from_px_q16,
                     int32_t count)
{
    const uint32_t first = (uint32_t)(image->data - FRAME);
    int32_t *const end = grey_q8_out + count;
    uint32_t none;
    if (first >= FRAME_BYTES) {
        ray_read_by_core(grey_q8_out, r, image, from_px_q16, count);
        return;
    }
    UNIT(none, UNIT_RAY_IMAGE, 0, first, image->stride);
    UNIT(none, UNIT_RAY_SIZE, 0, image->width_px, image->height_px);
    UNIT(none, UNIT_RAY_STEP, 0, drogue_ray_part(r->nx_q14, r->step_px_q16),
         drogue_ray_part(r->ny_q14, r->step_px_q16));
    UNIT(none, UNIT_RAY_BEGIN, 0, r->x_px_q16 + drogue_ray_part(r->nx_q14, from_px_q16),
         r->y_px_q16 + drogue_ray_part(r->ny_q14, from_px_q16));
    (void)none;
    for (; end - grey_q8_out >= 4; grey_q8_out += 4) {
        UNIT(grey_q8_out[0], UNIT_RAY_GREY, 0, 0, 0);
        UNIT(grey_q8_out[1], UNIT_RAY_GREY, 0, 0, 0);
        UNIT(grey_q8_out[2], UNIT_RAY_GREY, 0, 0, 0);
        UNIT(grey_q8_out[3], UNIT_RAY_GREY, 0, 0, 0);
    }
    for (; grey_q8_out < end; grey_q8_out++) {
        UNIT(*grey_q8_out, UNIT_RAY_GREY, 0, 0, 0);
    }
}
