/* SPDX-License-Identifier: Apache-2.0 */
/* The plain scenes of the accuracy table: one drogue, no disturbance but optics and sensor. */
#pragma once

#include "scene.hpp"

namespace accuracy {

struct PlainScene {
    Scene scene;
    cv::Rect region; /* where a detector would send the library */
};

/* A place at a distance, within so much of the optical axis across and down. Components are drawn from the last to the
 * first: arguments of a call would be drawn in an order of the compiler's own. */
cv::Vec3d draw_place(Random &random, double distance_m, double field);

/* A direction of the sun: above, before or behind. */
cv::Vec3d draw_sun(Random &random);

/* Scene number 'index' of a distance.
 *
 *  axis        yaw and pitch uniform in +-20 degrees
 *  position    within +-14 degrees of the optical axis, across and down, since the receiver flies at it
 *  background  sky, ground, cloud in turn; canopy dark before the sky, bright before the ground, either before cloud
 *  sensor      optics' blur of sigma 0.5 to 0.9 px, noise of sigma 2 grey levels
 *  region      square of side 2.5 true semi-axes, off by up to 3 % of one in x and y
 */
PlainScene plain_scene(uint64_t seed, double distance_m, int index);

} // namespace accuracy
