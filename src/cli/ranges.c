/* SPDX-License-Identifier: Apache-2.0 */
/* Ranges of what a person gives: the library's own, and narrower where a number can only be a mistake. */
#include "ranges.h"

#include <stddef.h>

#include "drogue/drogue.h"
#include "drogue/undistort.h"

#define TEXT(x) #x
#define TEXT_OF(x) TEXT(x)

#define MOST_ASPECT 8  /* of a pixel; beyond it one of the two is no focal length */
#define MOST_OUTSIDE 4 /* longest sides that a principal point may lie outside: of a part cut from an image */
#define LEAST_FAR 1024 /* px: the least longest side that counts for it */
#define LEAST_RIM DROGUE_Q16(1, 100) /* rounded by less than a thousandth of itself, and with it the distance */

const char *ranges_focal(const drogue_camera *c)
{
    if (c->fx_px_q16 <= 0 || c->fy_px_q16 <= 0) {
        return "focal lengths must be above 0 (at least 1/65536)";
    }
    if (c->fx_px_q16 / MOST_ASPECT > c->fy_px_q16 || c->fy_px_q16 / MOST_ASPECT > c->fx_px_q16) {
        return "focal lengths are too unlike; decimals stand behind a point, not a comma";
    }
    return NULL;
}

const char *ranges_lens(const drogue_camera *c)
{
    return drogue_lens_valid(c) ? NULL : "a coefficient of distortion is beyond 256";
}

/* Pixels by which a coordinate lies outside [0, size). */
static int64_t outside(drogue_q16 v_q16, int32_t size)
{
    const int64_t v = v_q16 / DROGUE_Q16_ONE;
    return v < 0 ? -v : v >= size ? v - size : 0;
}

const char *ranges_centre(const drogue_camera *c, int32_t width_px, int32_t height_px)
{
    const int32_t longest = width_px > height_px ? width_px : height_px;
    const int64_t far = longest < LEAST_FAR ? MOST_OUTSIDE * LEAST_FAR : (int64_t)MOST_OUTSIDE * longest;
    return outside(c->cx_px_q16, width_px) > far || outside(c->cy_px_q16, height_px) > far
               ? "the principal point lies far outside the image"
               : NULL;
}

const char *ranges_model(const drogue_model *m)
{
    if (m->rim_radius_m_q16 < LEAST_RIM) {
        return "the rim's radius must be at least 0.01: lengths are multiples of 1/65536; give all in a smaller unit";
    }
    if (m->inner_radius_m_q16 < 0 || m->inner_depth_m_q16 < 0) {
        return "radius and depth of the inner part must not be negative";
    }
    if (m->inner_radius_m_q16 > m->rim_radius_m_q16) {
        return "the inner part must not be larger than the rim";
    }
    return NULL;
}

const char *ranges_region(const drogue_region *r)
{
    if (r->width_px <= 0 || r->height_px <= 0) {
        return "width and height must be greater than 0";
    }
    if (r->width_px > DROGUE_MAX_REGION || r->height_px > DROGUE_MAX_REGION) {
        return "width and height must not exceed " TEXT_OF(DROGUE_MAX_REGION);
    }
    return NULL;
}
