/* SPDX-License-Identifier: Apache-2.0 */
/* Cuts chains into arcs of a quadrant. */
#include "quadrants.hpp"

#include <algorithm>

namespace accuracy {

namespace {

constexpr double tolerance_px = 2;

int class_of(const cv::Point2d &g) { return (g.x >= 0 ? 1 : 0) + (g.y >= 0 ? 2 : 0); }

void add(QuadrantArcs &arcs, const Chain &chain)
{
    if (!is_arc(chain)) {
        return;
    }
    const cv::Point2d bulge = bulge_of(chain);
    const cv::Point2d gradient = chain[chain.size() / 2].gradient;
    /* The gradient knows the diagonal, the bulge which end of it. */
    const bool outward = gradient.dot(bulge) > 0;
    const cv::Point2d out = outward ? gradient : -gradient;
    const int quadrant = out.y >= 0 ? (out.x >= 0 ? 0 : 1) : (out.x < 0 ? 2 : 3);
    arcs[static_cast<size_t>(quadrant)].push_back({quadrant, outward, chain});
}

/* The middle of an arc's box. */
cv::Point2d middle_of(const Chain &chain)
{
    cv::Point low = chain.front().at;
    cv::Point high = low;
    for (const EdgePoint &p : chain) {
        low = {std::min(low.x, p.at.x), std::min(low.y, p.at.y)};
        high = {std::max(high.x, p.at.x), std::max(high.y, p.at.y)};
    }
    return 0.5 * cv::Point2d(low + high);
}

} // namespace

QuadrantArcs quadrant_arcs(const EdgeImage &image, size_t most)
{
    QuadrantArcs arcs;
    for (const Chain &chain : chains_of(image)) {
        size_t begin = 0;
        for (size_t i = 1; i <= chain.size(); i++) {
            if (i == chain.size() || class_of(chain[i].gradient) != class_of(chain[begin].gradient)) {
                add(arcs, Chain(chain.begin() + static_cast<std::ptrdiff_t>(begin),
                                chain.begin() + static_cast<std::ptrdiff_t>(i)));
                begin = i;
            }
        }
    }
    for (auto &quadrant : arcs) {
        std::stable_sort(quadrant.begin(), quadrant.end(),
                         [](const QuadrantArc &a, const QuadrantArc &b) { return a.chain.size() > b.chain.size(); });
        if (quadrant.size() > most) {
            quadrant.erase(quadrant.begin() + static_cast<std::ptrdiff_t>(most), quadrant.end());
        }
    }
    return arcs;
}

bool in_order(const QuadrantArc &a, const QuadrantArc &b)
{
    const auto right = [](int q) { return q == 0 || q == 3; };
    const auto below = [](int q) { return q <= 1; };
    const cv::Point2d d = middle_of(a.chain) - middle_of(b.chain);
    const bool across = right(a.quadrant) == right(b.quadrant) || (d.x > -tolerance_px) == right(a.quadrant);
    const bool down = below(a.quadrant) == below(b.quadrant) || (d.y > -tolerance_px) == below(a.quadrant);
    return across && down;
}

} // namespace accuracy
