/* SPDX-License-Identifier: Apache-2.0 */
/* Dong: arcs by gradient, false detections held down by the gradients that an ellipse explains. */
#include "detectors.hpp"

#include <algorithm>
#include <cmath>

#include "edges.hpp"
#include "quadrants.hpp"

namespace accuracy {

namespace {

constexpr double band_px = 1.5;
constexpr double aligned_cos = 0.92388; /* 22.5 degrees */
constexpr double by_chance = 0.125;     /* that a direction lies within 22.5 degrees of a normal, of its polarity */

/* All edge points near the ellipse whose gradient is along its normal, of one polarity. */
Chain explained_by(const EdgeImage &image, const Ellipse &e, bool outward)
{
    Chain points;
    for (int y = 0; y < image.edges.rows; y++) {
        for (int x = 0; x < image.edges.cols; x++) {
            if (!image.edge_at(x, y) || distance_px(e, cv::Point2d(x, y)) > band_px) {
                continue;
            }
            const cv::Point2d g = image.gradient_at({x, y});
            const double along = g.dot(normal_at(e, cv::Point2d(x, y))) * (outward ? 1 : -1);
            if (along >= aligned_cos * cv::norm(g)) {
                points.push_back({{x, y}, g});
            }
        }
    }
    return points;
}

/* Is the expected number of such ellipses in noise below one? Chernoff's bound of the binomial tail; as many tests as
 * there are ellipses, five parameters over the picture's sides. */
bool meaningful(double points, double aligned, const cv::Size &size)
{
    const double share = std::min(aligned / points, 1 - 1e-9);
    if (share <= by_chance) {
        return false;
    }
    const double divergence =
        share * std::log(share / by_chance) + (1 - share) * std::log((1 - share) / (1 - by_chance));
    const double log_tests = 2.5 * std::log(static_cast<double>(size.area()));
    return log_tests - points * divergence < 0;
}

} // namespace

std::vector<Ellipse> detect_dong(const cv::Mat &grey)
{
    const EdgeImage image(grey);
    const QuadrantArcs arcs = quadrant_arcs(image, 10);
    std::vector<const QuadrantArc *> all;
    std::vector<Ellipse> found;
    for (const auto &quadrant : arcs) {
        for (const QuadrantArc &arc : quadrant) {
            all.push_back(&arc);
        }
    }
    const auto suit = [](const QuadrantArc &a, const QuadrantArc &b) {
        return a.outward == b.outward && a.quadrant != b.quadrant && in_order(a, b) &&
               face_each_other(a.chain, b.chain);
    };
    for (size_t i = 0; i < all.size(); i++) {
        for (size_t j = i + 1; j < all.size(); j++) {
            Ellipse e;
            if (!suit(*all[i], *all[j]) || !fit_arcs(e, {&all[i]->chain, &all[j]->chain}) ||
                std::max(rms_px(e, all[i]->chain), rms_px(e, all[j]->chain)) > band_px) {
                continue;
            }
            std::vector<const Chain *> group = {&all[i]->chain, &all[j]->chain};
            for (const QuadrantArc *other : all) {
                if (suit(*all[i], *other) && suit(*all[j], *other) && rms_px(e, other->chain) <= 2 * band_px) {
                    group.push_back(&other->chain);
                }
            }
            if (group.size() < 3 || !fit_arcs(e, group)) {
                continue;
            }
            const Chain support = explained_by(image, e, all[i]->outward);
            if (meaningful(circumference_px(e), static_cast<double>(support.size()), grey.size()) &&
                fit_arcs(e, {&support})) {
                found.push_back(e);
            }
        }
    }
    return found;
}

} // namespace accuracy
