/* SPDX-License-Identifier: Apache-2.0 */
/* Brown-Conrady lens distortion (k1 k2 p1 p2 k3, as OpenCV) applied and removed. */
#ifndef DROGUE_UNDISTORT_H
#define DROGUE_UNDISTORT_H

#include "drogue/types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_MAX_DISTORTION_Q16 (256 * DROGUE_Q16_ONE) /* largest magnitude of a coefficient */

/* Is a coefficient of the lens within its range? */
static inline int drogue_distortion_valid(drogue_q16 k)
{
    return k >= -DROGUE_MAX_DISTORTION_Q16 && k <= DROGUE_MAX_DISTORTION_Q16;
}

/* Are all? */
static inline int drogue_lens_valid(const drogue_camera *c)
{
    return drogue_distortion_valid(c->k1_q16) && drogue_distortion_valid(c->k2_q16) &&
           drogue_distortion_valid(c->p1_q16) && drogue_distortion_valid(c->p2_q16) &&
           drogue_distortion_valid(c->k3_q16);
}

/* Are focal lengths and lens within their ranges? */
static inline int drogue_camera_valid(const drogue_camera *c)
{
    return c->fx_px_q16 > 0 && c->fy_px_q16 > 0 && drogue_lens_valid(c);
}

/* Does the camera distort at all? */
static inline int drogue_camera_distorts(const drogue_camera *c)
{
    return (c->k1_q16 | c->k2_q16 | c->p1_q16 | c->p2_q16 | c->k3_q16) != 0;
}

/* Pixel as an ideal pinhole camera of the same fx, fy, cx, cy would see it -> pixel as seen.
 *
 *  x, y    in/out, px Q16
 *  return  DROGUE_OK; DROGUE_E_DOMAIN when the point lies more than 4 focal lengths off the axis in x or y, a
 *          coefficient exceeds DROGUE_MAX_DISTORTION_Q16, or the result leaves Q16
 *  error   1 LSB for lenses as calibration finds them (k1 within 0.25, focal lengths to 3000 px, 0.6 focal lengths off
 *          the axis in x and y); in any case 1 LSB, 2^-29 of the focal length and 2^-23 of the largest of the lens's
 *          terms, k1 r^3, k2 r^5, k3 r^7, p1 r^2 and p2 r^2 focal lengths, of which large ones may cancel each other
 */
drogue_status drogue_distort_point(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, const drogue_camera *camera);

/* Pixel as seen -> pixel of the ideal pinhole camera, by damped Newton steps from the axis.
 *
 *  x, y    in/out, px Q16; unchanged on failure
 *  return  DROGUE_OK; DROGUE_E_DOMAIN as above, when the model cannot be inverted there (beyond a
 *          fold, which is looked for at 16 places on the way from the axis), or when it stretches more than 64-fold
 *  error   3 LSB for the same lenses; in any case as above at the point returned, times what the lens compresses there
 */
drogue_status drogue_undistort_point(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, const drogue_camera *camera);

#ifdef __cplusplus
}
#endif
#endif
