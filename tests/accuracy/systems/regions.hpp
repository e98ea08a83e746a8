/* SPDX-License-Identifier: Apache-2.0 */
/* Finding the drogue in a whole frame as the paper's text says that others do, as far as it says so. */
#pragma once

#include <vector>

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

/* Xin: matching under a perspective transform. The gradients of a reference view, frontal, put into 13 tilts and 17 sizes
 * by such a transform, are correlated with the frame's; the best place counts when its coefficient is at least 0.4.
 * (Matching single features, cv::SIFT with a homography by RANSAC, finds nothing on this drogue: its ribs are all alike.) */
class ViewMatcher {
public:
    /* reference: a frontal picture whose outline is the given circle */
    ViewMatcher(const cv::Mat &reference, const Ellipse &outline);
    Sight find(const cv::Mat &grey) const;

private:
    std::vector<cv::Mat> views_; /* gradients, the outline's semi-axis being view_semi_axis_px */
};

} // namespace accuracy
