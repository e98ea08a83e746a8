/* SPDX-License-Identifier: Apache-2.0 */
/* drogue_measure() taken apart, so that a stage can be replaced: edge points of a region, and the pose from any outline
 * by the rules that the library has for its own. Without the second look at an outline that the ring mask cuts. */
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "drogue/drogue.h"
#include "geometry.hpp"

namespace accuracy {

/* Edge points and arcs of a region, by the library's front end with its default thresholds. */
struct RegionEdges {
    /* image: CV_8UC1, the whole image; only the region is looked at */
    RegionEdges(const cv::Mat &image, const cv::Rect &region);

    drogue_status status; /* of the front end */
    drogue_config config;
    drogue_mask mask;
    cv::Mat view;        /* the region's part inside the image */
    cv::Point origin_px; /* of that */
    drogue_workspace workspace;
    drogue_edge_list list = {0, 0};

    std::vector<drogue_edge> points_of(const drogue_arc &arc) const;
    std::vector<drogue_edge> all_points() const;

private:
    std::vector<uint32_t> memory_;
};

/* What points say about the ellipse fitted to them: counts and residuals by bin, all of one polarity. */
drogue_support support_of(const drogue_ellipse &ellipse, const std::vector<drogue_edge> &points);

/* Outline, poses, choice, covariance and status of a result, from an outline in the region's coordinates; 'inner' in
 * the result is taken as it is.
 *
 *  support  of the fit, about the ellipse before blur was put back
 *  camera   without distortion
 */
void put_pose(drogue_result &result, const RegionEdges &edges, const drogue_ellipse &ellipse,
              const drogue_support &support, const Camera &camera, const drogue_model &model);

} // namespace accuracy
