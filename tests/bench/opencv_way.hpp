/* SPDX-License-Identifier: Apache-2.0 */
/* The measurement as one would put it together from OpenCV: what the benchmark compares the library with. */
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/video/tracking.hpp>

#include "geometry.hpp"

namespace bench {

/* Smoothing and Canny of a whole image, thresholds as the library's. */
cv::Mat edges(const cv::Mat &image);

struct Found {
    bool ok = false;
    accuracy::Pose pose;
};

/* Edges; ring mask; contours, cut where the gradient leaves its quadrant; direct fits of pairs of the twelve longest, each
 * scored by all edge points; refit; both circle poses; the inner part by Otsu's threshold, opening and connected
 * components; the pose whose inner centre is nearer. */
Found measure(const cv::Mat &image, const accuracy::Camera &camera, double rim_radius_m, double inner_depth_m);

/* Circles in an image halved step by step, one level an octave of sizes: how many. */
size_t search(const cv::Mat &frame);

/* measure() and a Kalman filter of constant acceleration in five parameters. */
class Tracker {
public:
    Tracker();
    bool frame(const cv::Mat &image, const accuracy::Camera &camera, double rim_radius_m, double inner_depth_m);

private:
    cv::KalmanFilter filter_;
};

} // namespace bench
