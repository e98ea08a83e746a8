/* SPDX-License-Identifier: Apache-2.0 */
/* Random scenes under every condition that the measurement must stand. */
#pragma once

#include <string>
#include <vector>

#include "drogue/types.h"
#include "plain.hpp"

namespace accuracy {

/* What disturbs the picture; every one has the plain scene beneath it.
 *
 *  plain         nothing but optics and noise of 2 grey levels
 *  illumination  (41): the light falls off to a third across the drogue at worst, gain 0.8 to 1.4
 *  gaussian      Gaussian motion blur, sigma to 3 px and to 0.1 a
 *  linear        linear motion blur, length to 9 px and to 0.25 a
 *  noise         sigma of 4 to 8 grey levels
 *  off_centre    the region's centre off by up to 0.15 a in x and in y, its side 2.2 to 2.8 a
 *  probe         a rod over part of the rim, and a hose that leaves sideways behind it
 *  clutter       rough background, blobs and bars of any grey behind the rim
 *  low_contrast  background within 10 grey levels of the canopy over part of the outline: a ramp through the canopy's
 *                grey, so that the polarity flips round the rim, or a soft patch of that grey
 *  scallops      20 to 40 lobes, 1 to 3 % of the rim's radius deep
 *  inner         bright spokes before the black disc, dark patches beside it in the canopy
 *  all           each of them with a chance of 0.35, at half strength
 */
enum class Condition {
    plain,
    illumination,
    gaussian,
    linear,
    noise,
    off_centre,
    probe,
    clutter,
    low_contrast,
    scallops,
    inner,
    all
};
constexpr int conditions = 12;

const char *name_of(Condition condition);

/* A scene with all that a measurement needs, and its truth.
 *
 * The truth of a scalloped rim is its mean outline: the circle through the mean depth of the edge, of the radius that
 * the canopy has there. Model, pose and rim refer to that circle's plane; scene.pose and scene.drogue do not. */
struct Trial {
    Condition condition;
    int index;
    Scene scene;
    cv::Rect region;
    drogue_model model;
    Pose pose;
    Ellipse rim; /* ideal pixels */
    double distance_m() const { return pose.position_m[2]; }
};

/* Trial number 'index' of a condition: a pure function of the three arguments.
 *
 *  distance    2 to 25 m along z, log-uniform; consecutive indices cover it evenly
 *  axis        0 to 30 degrees from the camera's, at most 36 degrees from the line of sight: beyond 40 the outside of
 *              the canopy joins the outline, which is no ellipse then
 *  the rest    as the plain scenes (plain.hpp)
 */
Trial trial(uint64_t seed, Condition condition, int index);

/* The same at a given distance. */
Trial trial_at(uint64_t seed, Condition condition, int index, double distance_m);

/* A scene of the accuracy table. */
Trial trial_of(const PlainScene &plain, int index);

/* A number that changes with anything drawn for the trial: the key of stored pictures. */
uint64_t fingerprint(const Trial &t);

} // namespace accuracy
