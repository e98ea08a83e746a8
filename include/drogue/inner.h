/* SPDX-License-Identifier: Apache-2.0 */
/* The inner part as a measurement: where the poses expect it, and how far what was found is to be believed. */
#ifndef DROGUE_INNER_H
#define DROGUE_INNER_H

#include "drogue/drogue.h"
#include "drogue/joint.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Images of the inner disc for both poses, as seen.
 *
 *  expected  out, coordinates of the region whose pixel (0, 0) is pixel (x_px, y_px) of the image
 *  return    how many of them there are: a pose whose disc is behind the camera, edge-on or under a pixel has none
 */
uint32_t drogue_inner_expect(drogue_ellipse expected[2], const drogue_pose poses[2], const drogue_camera *camera,
                             const drogue_model *model, int32_t x_px, int32_t y_px);

/* Where to look: a disc about the outline's centre of 5/6 of its semi-minor axis. */
drogue_mask drogue_inner_disc(const drogue_ellipse *outline);

/* Standard deviation of a inner part's centroid as that of the expected disc: a floor, a share of the disc's size, and
 * what the threshold moves it.
 *
 *  part, expected, outline  region coordinates
 *  return                   px Q16; 0 when it is not to be believed: of another size, in another place, cut by the rim
 */
drogue_q16 drogue_inner_std(const drogue_inner_part *part, const drogue_ellipse *expected,
                            const drogue_ellipse *outline, const drogue_config *config);

/* Weigh a inner part, and see which pose it is nearer to.
 *
 *  weighed            out: what drogue_decide() takes, std 0 when the part is not to be believed
 *  out                in: region, inner in its coordinates; out: inner in those of the image or zero, has_inner and
 *                     ambiguity when it is believed
 *  expected, outline  region coordinates: the disc that drogue_inner_find() chose, the ellipse as seen
 *  return             index of the pose whose projected inner centre is nearer
 */
uint32_t drogue_inner_weigh(drogue_joint_inner *weighed, drogue_result *out, const drogue_ellipse *expected,
                            const drogue_ellipse *outline, const drogue_pose poses[2], const drogue_config *config,
                            const drogue_camera *camera, const drogue_model *model);

#ifdef __cplusplus
}
#endif
#endif
