/* SPDX-License-Identifier: Apache-2.0 */
/* From the exact front end's edge points to the outline, in floating point. */
#pragma once

#include <optional>
#include <vector>

#include "reference.hpp"

#include "drogue/drogue.h"

namespace vectors {

inline reference::Real real(int64_t q16) { return static_cast<reference::Real>(q16) / 65536; }

/* The library's thresholds: the stage uses the defaults. */
const drogue_config &default_config();

struct Edge {
    cv::Point pixel;
    reference::Point at;    /* region coordinates */
    reference::Real gx, gy; /* y down */
};

/* What the front end leaves: edge points, and those of each arc. */
struct FrontEnd {
    drogue_status status;
    std::vector<Edge> edges;
    std::vector<std::vector<Edge>> arcs;
    std::vector<int> direction;
};
FrontEnd run_front_end(const cv::Mat &view, const drogue_mask &mask);

/* An outline: its ellipse in region coordinates, the arcs it came from. */
struct Outline {
    reference::Ellipse ellipse;
    int polarity = 0, combination = 0;
    int64_t refit_points = 0;
};

/* The outline with its blur undone, or why there is none. */
drogue_status find_outline(Outline &out, const FrontEnd &front, const drogue_mask &mask);

/* Ellipse as the ideal camera would see it, px of the whole image; not ok when the lens cannot be undone. */
reference::Ellipse ideal_of(const Outline &outline, const FrontEnd &front, const reference::Camera &camera,
                            cv::Point origin);

} // namespace vectors
