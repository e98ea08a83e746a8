/* SPDX-License-Identifier: Apache-2.0 */
/* The measurement of a frame in floating point, on the edge list of the exact front end. */
#pragma once

#include <array>

#include "edge.hpp"
#include "outline.hpp"

namespace mirror {

/* What a frame is measured with; 'image' 8-bit grey. */
struct Task {
    cv::Mat image;
    reference::Camera camera;
    reference::Model model;
    std::array<int64_t, 4> region; /* x y width height */
    drogue_config config;
    drogue_capacity capacity;     /* of the workspace */
    drogue_camera library_camera; /* the same as the library has them */
    drogue_model library_model;
};

/* As drogue_result, unrounded. */
struct Result {
    drogue_status status = DROGUE_OK;
    drogue_second_look second_look = DROGUE_SECOND_NONE;
    int tried = 0; /* drogue_tried */
    cv::Rect region;
    bool found = false; /* an outline, whatever came of it */
    Outline outline;    /* in coordinates of the region */
    reference::Ellipse seen = {0, 0, 0, 0, 0, false}, ideal = {0, 0, 0, 0, 0, false};
    bool has_inner = false;
    Disc part = {};
    Real area = 0;                   /* of the disc, px^2 */
    reference::Point inner = {0, 0}; /* as seen, px of the whole image */
    Real ambiguity = 1;
    drogue_q16 larger_q16 = 0; /* by what share the disc seen is larger than of its size, where that tells */
    bool too_large = false;    /* a disc is seen that would be believed but for its size */
    bool resolved = false;
    reference::Pose pose = {}, alternative = {};
    reference::Covariance covariance = {};
    std::array<Real, 3> position_std = {};
    Real axis_std = 0;
    Real doubt = 0;            /* in the covariance */
    bool contradicted = false; /* the library sees the inner disc, or an outline about it, elsewhere than the mirror */
};

/* What the last part of a measurement starts from, for those who ask how far its result moves with it. */
struct Features {
    reference::Ellipse ideal;
    reference::Support support;
    reference::Inner inner; /* undistorted */
    bool trusted;           /* in its place and of its size */
    bool placed;            /* there, and its lens undone */
    Real doubt;             /* share by which it is not of its size, where it is trusted */
    Real too_far;           /* share by which size and place say that the outline's pose is, likewise */
    int outside;            /* parts of the outline outside which another edge shows */
};

/* Follows the library's documented method from edge points to the pose.
 *
 *  library   what drogue_measure() gave for the same task, to decide as it did where the margin is below what it
 *            resolves (outline.hpp); NULL: all decisions are the mirror's own
 *  features  out: what finish() starts from; NULL: not wanted
 */
Result measure(const Task &task, const drogue_result *library = nullptr, Features *features = nullptr);

/* The poses, their choice and covariance from the features; 'out' has what comes before. */
void finish(Result &out, const Task &task, const Features &features, const drogue_result *library = nullptr);

/* What a doubt adds to the covariance of the position. */
std::array<std::array<Real, 3>, 3> doubt_covariance(const std::array<Real, 3> &position, Real doubt, Real rim_radius);

/* The choice between the two poses, the one that is nearer to the inner part given; 'out' has has_inner. */
void decide(Result &out, const Task &task, const Features &features, const std::array<reference::Pose, 2> &pair,
            size_t nearer, const drogue_result *library = nullptr);

} // namespace mirror
