/* SPDX-License-Identifier: Apache-2.0 */
/* The plain scenes of the accuracy table: one drogue, no disturbance but optics and sensor. */
#pragma once

#include "scene.hpp"

namespace accuracy {

struct PlainScene {
    Scene scene;
    cv::Rect region; /* where a detector would send the library */
};

/* Scene number 'index' of a distance: yaw and pitch uniform in +-20 degrees; the drogue anywhere within +-14 degrees of
 * the optical axis, across and down, since the receiver flies at it; sky, ground and cloud in turn, the canopy dark
 * before the sky, bright before the ground, one and the other before cloud. The region is a square of side 2.5 true
 * semi-axes, off by up to 3 % of one in x and y. */
PlainScene plain_scene(uint64_t seed, double distance_m, int index);

} // namespace accuracy
