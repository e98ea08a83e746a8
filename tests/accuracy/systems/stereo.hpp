/* SPDX-License-Identifier: Apache-2.0 */
/* Two cameras side by side, the right one a baseline to +x, both with the library's outline and inner part; and a range
 * image of a flash lidar. */
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "baselines.hpp"
#include "scene.hpp"

namespace accuracy {

constexpr double baseline_m = 0.5;

/* Plane through points by least squares: their mean, two unit vectors along it, its normal away from the camera. */
struct PlaneFit {
    cv::Vec3d mean, first, second, normal;
};
PlaneFit fit_plane(const std::vector<cv::Vec3d> &points);

/* The scene as the right camera sees it: the drogue so much farther left, noise of its own. */
Scene seen_from_right(const Scene &scene);

/* Duan: the centre's direction in each view, by the cone's closed form, does not depend on the rim's radius; both are
 * triangulated (middle of the shortest line between them). The axis is the mean of both cones', each chosen by its inner
 * part. */
Estimate duan(const Features &left, const Features &right, const Camera &camera, const Body &body);

/* Xu: seven points of known geometry, each triangulated: the centre as above and six of the rim, where three rows cut
 * both outlines. Axis: normal of the plane through them; centre: that of the circle of the rim's radius through the six in
 * that plane. */
Estimate xu(const Features &left, const Features &right, const Camera &camera, const Body &body);

/* 3D flash lidar of 128 x 128 pixels over 45 degrees, which covers the scenes' field at 3 m; a pixel gives the first return
 * of 5 x 5 rays; beyond 60 m and from the sky there is none (NaN). Range along the ray, m, CV_64F. */
constexpr int lidar_side_px = 128;
Camera lidar_camera();
cv::Mat lidar_range(const Scene &scene, double noise_m);

/* Chen: RANSAC of a plane and a circle of about the rim's radius in it, over the pixels at the edge of what returns; least
 * squares over those that agree. The circle's centre is the position, the plane's normal the axis. */
Estimate chen(const cv::Mat &range_m, const Body &body, uint64_t seed);

} // namespace accuracy
