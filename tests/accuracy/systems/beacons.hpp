/* SPDX-License-Identifier: Apache-2.0 */
/* Systems with marks on the drogue: lamps at known places whose directions a sensor gives with stated noise, and a
 * coloured ring whose edges a camera gives. */
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "baselines.hpp"
#include "geometry.hpp"
#include "random.hpp"

namespace accuracy {

/* Eight lamps in the drogue's frame (first, second, axis): five about the rim, three about the coupling, at uneven
 * angles, so that they tell the roll. */
const std::vector<cv::Vec3d> &lamps_m();
constexpr size_t rim_lamps = 5; /* the first, all in the end plane */

/* The lamps as a sensor sees them, ideal pixels, in the order of lamps_m(): the drogue turned about its axis by 'roll',
 * normal noise in x and in y. */
std::vector<cv::Point2d> see_lamps(const Camera &camera, const Pose &pose, double roll_rad, double noise_px,
                                   Random &random);

/* VisNav: the lamps' directions known one by one (each has its frequency); Gauss-Newton on unit directions
 * ("Gaussian least-squares differential correction"). Starts 10 m off in the mean direction, frontal, with the roll that
 * the lamps' angles about their middle show. */
Estimate visnav(const std::vector<cv::Point2d> &seen_px, const Camera &camera);

/* Pollini: which point is which lamp is not known. Every match that some attitude within 40 degrees and some roll suggest
 * gets ten steps of Lu, Hager and Mjolsness; that with the least collinearity error is iterated on until it stands. */
Estimate pollini(std::vector<cv::Point2d> seen_px, const Camera &camera);

/* Meng: orthogonal iteration, which is Lu, Hager and Mjolsness's, from weak perspective until it stands. */
Estimate meng(const std::vector<cv::Point2d> &seen_px, const Camera &camera);

/* cv::solvePnP with one of its methods (cv::SOLVEPNP_*); planar: from the lamps of the rim alone. */
Estimate opencv_pnp(const std::vector<cv::Point2d> &seen_px, const Camera &camera, int method, bool planar);

/* Wang: a ring of colour about the rim, 5 cm wide; points a pixel apart on both of its edges, normal noise in x and y
 * of each; a direct fit and the circle poses of either edge, the two whose centres lie nearest to one line of sight, weighted by
 * squared semi-axes. */
constexpr double ring_inner_radius_m = 0.3;
std::vector<cv::Point2d> see_circle(const Camera &camera, const Pose &pose, double radius_m, double noise_px,
                                    Random &random);
Estimate wang(const std::vector<cv::Point2d> &outer_px, const std::vector<cv::Point2d> &inner_px, const Camera &camera,
              double rim_radius_m);

} // namespace accuracy
