/* SPDX-License-Identifier: Apache-2.0 */
/* Arcs by the quadrant of an ellipse that they can be of. */
#pragma once

#include <array>
#include <vector>

#include "edges.hpp"

namespace accuracy {

struct QuadrantArc {
    int quadrant; /* 0 to 3: right below, left below, left above, right above */
    bool outward; /* the gradient points to where the arc bulges */
    Chain chain;
};
using QuadrantArcs = std::array<std::vector<QuadrantArc>, 4>;

/* Chains cut where the sign of a gradient's component changes; of each quadrant the longest, at most so many. */
QuadrantArcs quadrant_arcs(const EdgeImage &image, size_t most);

/* Do two arcs of different quadrants lie to each other as their quadrants do, within 2 px? */
bool in_order(const QuadrantArc &a, const QuadrantArc &b);

} // namespace accuracy
