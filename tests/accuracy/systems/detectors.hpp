/* SPDX-License-Identifier: Apache-2.0 */
/* Ellipse detectors beside the library's own outline: OpenCV's, and those that the paper names, each as far as the
 * paper's text defines it. All look at the same region of a grey picture and give candidates in its pixels. */
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "geometry.hpp"

namespace accuracy {

struct OutlineDetector {
    const char *name;
    const char *source; /* what is taken from where */
    std::vector<Ellipse> (*detect)(const cv::Mat &grey);
};

/* All that were built: EdgeDrawing only with OpenCV's ximgproc. */
const std::vector<OutlineDetector> &outline_detectors();
extern const bool has_ximgproc;

/* The outline among a detector's candidates, by one rule for all: of those that lie in the region as the drogue's must
 * (centre within a quarter of the side of the middle, semi-major axis 0.28 to 0.55 of it, axis ratio at least 0.4) the
 * one with most of its circumference on edges along it. False when there is none with at least 0.3 of it. */
bool choose_outline(Ellipse &out, const std::vector<Ellipse> &candidates, const cv::Mat &grey);

/* OpenCV. */
std::vector<Ellipse> detect_edge_drawing(const cv::Mat &grey); /* with ximgproc alone */
std::vector<Ellipse> detect_hough(const cv::Mat &grey);
std::vector<Ellipse> detect_contours(const cv::Mat &grey);
/* The paper's section II. */
std::vector<Ellipse> detect_fornaciari(const cv::Mat &grey);
std::vector<Ellipse> detect_mai(const cv::Mat &grey);
std::vector<Ellipse> detect_bai(const cv::Mat &grey);
std::vector<Ellipse> detect_liu_qiao(const cv::Mat &grey);
std::vector<Ellipse> detect_dong(const cv::Mat &grey);

} // namespace accuracy
