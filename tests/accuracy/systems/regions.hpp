/* SPDX-License-Identifier: Apache-2.0 */
/* Finding the drogue in a whole frame as the paper's text says that others do, as far as it says so. */
#pragma once

#include <opencv2/core.hpp>

#include "baselines.hpp"

namespace accuracy {

/* Where the outline is thought to be: its middle and semi-axis. */
struct Sight {
    bool ok = false;
    cv::Point2d middle_px;
    double semi_axis_px = 0;
};

/* Huang: the circular refuelling port inside the drogue, a dark disc. Contours at thresholds 16 grey levels apart; the one
 * that is most like a disc (area over that of the fitted ellipse, share of its points on it) and darkest against its
 * surround. The rim lies about it at the ratio of the radii. */
Sight find_port(const cv::Mat &grey, const Body &body);

/* Ma: features of the drogue's projection: an outline with the inner part's within it. Direct fits to the contours of all
 * edges; the pair whose sizes and centres suit the drogue's, that with most of both circumferences on edges. */
Sight find_nested(const cv::Mat &grey, const Body &body);

/* Xin: feature matching under a perspective transform: ORB features of a reference view of the drogue, matched by Hamming
 * distance with the ratio test, a homography by RANSAC that at least 8 of them follow. */
class FeatureMatcher {
public:
    /* reference: a picture whose outline is the given ellipse */
    FeatureMatcher(const cv::Mat &reference, const Ellipse &outline);
    Sight find(const cv::Mat &grey) const;

private:
    std::vector<cv::Point2f> points_;
    cv::Mat descriptors_;
    Ellipse outline_;
};

} // namespace accuracy
