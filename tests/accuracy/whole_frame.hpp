/* SPDX-License-Identifier: Apache-2.0 */
/* Whole frames with the drogue anywhere in them, and the library's search of them. */
#pragma once

#include <vector>

#include "conditions.hpp"
#include "drogue/search.h"

namespace accuracy {

constexpr int frame_px = 1024; /* larger when the drogue is */

/* A part of the trial's image with the drogue somewhere in it. */
cv::Rect frame_of(const Trial &t);

/* The frame: about the drogue as rendered, elsewhere the background with the sensor's noise alone. */
cv::Mat whole_frame(const Trial &t, const cv::Rect &frame);
/* The same without the drogue. */
cv::Mat empty_frame(const Trial &t, const cv::Rect &frame);

/* drogue_acquire() on a frame. */
struct Acquired {
    std::vector<drogue_sighting> sightings; /* by falling score */
    drogue_result result;
};
Acquired acquire(const cv::Mat &image, const Camera &camera, const drogue_model &model);

/* Does a region suit, is it one that drogue_measure() can use: middle within 0.35 semi-axes, side within a quarter of
 * 2.5 of them. */
bool suits(const cv::Point2d &middle_px, double side_px, const Ellipse &rim);

/* Place among the sightings of the first that suits, -1 when none does. */
int rank_of(const std::vector<drogue_sighting> &sightings, const Ellipse &rim, const cv::Point &origin);

} // namespace accuracy
