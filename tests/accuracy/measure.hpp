/* SPDX-License-Identifier: Apache-2.0 */
/* The library as the accuracy tests call it: OpenCV images and floating-point numbers in and out. */
#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "drogue/drogue.h"
#include "geometry.hpp"

namespace accuracy {

/* Nearest Q16, throws when it does not fit. */
drogue_q16 to_q16(double v);
inline double from_q16(drogue_q16 v) { return v / 65536.0; }

struct Measurement {
    drogue_result raw;
    bool ok;
    Ellipse seen;  /* distorted */
    Ellipse ideal; /* undistorted */
    Pose pose;
    Pose alternative;
    cv::Point2d inner_px; /* as seen; meaningful when raw.has_inner */
};

/* Measure the drogue in one region of an 8-bit grey image, with the library's defaults but what its levels stand for. */
Measurement measure(const cv::Mat &image, const Camera &camera, const drogue_model &model, const cv::Rect &region,
                    drogue_transfer transfer = DROGUE_TRANSFER_LINEAR);

/* The library's grey of a colour image, as the host program computes it. */
cv::Mat grey_of(const cv::Mat &bgr);

/* Order statistics of a copy; NaN when empty. */
double median(std::vector<double> values);
double percentile(std::vector<double> values, double percent); /* nearest rank */
double mean(const std::vector<double> &values);

} // namespace accuracy
