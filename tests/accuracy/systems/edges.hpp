/* SPDX-License-Identifier: Apache-2.0 */
/* Edge points of a picture in chains, and what the arc-based ellipse detectors do with them alike. */
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "geometry.hpp"

namespace accuracy {

struct EdgePoint {
    cv::Point at;
    cv::Point2d gradient; /* Sobel, y down */
};
using Chain = std::vector<EdgePoint>; /* neighbours in order */

/* cv::Canny after a 5 x 5 Gaussian, with the library's thresholds (drogue_config: 30 and 80). */
struct EdgeImage {
    explicit EdgeImage(const cv::Mat &grey);

    cv::Mat edges, gx, gy; /* CV_8U, CV_16S */

    bool edge_at(int x, int y) const;
    cv::Point2d gradient_at(const cv::Point &p) const;
};

/* Edge pixels walked into chains, 8-connected, straight on where there is a choice; each pixel once. */
std::vector<Chain> chains_of(const EdgeImage &image);

/* Parts of a chain that turn one way only: cut at the vertices of its polygon (cv::approxPolyDP, tolerance in px) where
 * the turn changes its sign or is sharper than max_turn_rad. Parts that are too short or too straight are left out. */
std::vector<Chain> convex_arcs(const Chain &chain, double tolerance_px, double max_turn_rad);
std::vector<Chain> convex_arcs_of(const EdgeImage &image);

/* At least 10 points, and no straight line: short side of the smallest rectangle about it at least 1.5 px. */
bool is_arc(const Chain &chain);

/* From the middle of the chord to the middle of the arc, px: the side to which the arc bulges. */
cv::Point2d bulge_of(const Chain &arc);
/* Each lies on the other's concave side: behind the line along the other's middle. */
bool face_each_other(const Chain &a, const Chain &b);

/* cv::fitEllipseDirect over all points; false when there are too few or no ellipse comes of it. */
bool fit_arcs(Ellipse &out, const std::vector<const Chain *> &arcs);

/* Distance of a point from an ellipse to first order, px. */
double distance_px(const Ellipse &e, const cv::Point2d &p);
/* Root mean square of it over a chain. */
double rms_px(const Ellipse &e, const Chain &chain);
/* Unit normal of the ellipse where a ray from its centre to the point meets it, outward. */
cv::Point2d normal_at(const Ellipse &e, const cv::Point2d &p);

double circumference_px(const Ellipse &e);

/* How many of the points about the ellipse, a pixel apart, have an edge pixel within 1.5 px whose gradient lies within
 * 22.5 degrees of the normal, either way. */
struct EdgeSupport {
    int points, aligned;
    double share() const { return points > 0 ? static_cast<double>(aligned) / points : 0; }
};
EdgeSupport support_of(const EdgeImage &image, const Ellipse &e);

} // namespace accuracy
