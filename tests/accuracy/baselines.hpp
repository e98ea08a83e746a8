/* SPDX-License-Identifier: Apache-2.0 */
/* Published ways from image features to position, in double precision: what the study compares the library with.
 * All take the same features, measured by the library; pixels are those of an ideal pinhole camera. */
#pragma once

#include <array>

#include "geometry.hpp"

namespace accuracy {

struct Features {
    Ellipse outer; /* outline of the end plane */
    bool has_inner = false;
    double inner_area_px = 0;
    cv::Point2d inner_px = {0, 0}; /* centroid of the inner part */
    bool has_inner_ellipse = false;
    Ellipse inner = {0, 0, 0, 0, 0}; /* outline of the inner part */
};

struct Body {
    double rim_radius_m;
    double inner_radius_m;
    double inner_depth_m; /* behind the end plane, along the axis */
};

struct Estimate {
    bool ok = false; /* false: the features it needs are missing, or have no solution */
    cv::Vec3d position_m = {0, 0, 0};
    bool has_axis = false;
    cv::Vec3d axis = {0, 0, 0};
};

/* Both circles of a radius whose image is the ellipse (Shiu and Ahmad 1989; paper (20)-(30)), in no particular order;
 * false when the conic's cone is none. */
bool circle_poses(std::array<Pose, 2> &out, const Camera &camera, const Ellipse &ellipse, double radius_m);

/* The upright box about the ellipse, w by h, as that of a frontal circle: z = 2 R f / ((w + h) / 2), x and y from the
 * box's centre. */
Estimate martinez(const Features &features, const Camera &camera, const Body &body);

/* The inner part as a frontal disc: its distance is f r / sqrt(area / pi), x and y come from its centroid there;
 * the end plane lies nearer by the inner part's depth. */
Estimate yin(const Features &features, const Camera &camera, const Body &body);

/* z = R f / a with the major semi-axis, x and y from the ellipse's centre. */
Estimate ma_zhao(const Features &features, const Camera &camera, const Body &body);

/* Circle poses of the outer and of the inner ellipse; of the four pairs that whose line from outer to inner centre
 * agrees best with both axes; the inner centre moved back by its depth; both weighted by their squared semi-axes. */
Estimate sun(const Features &features, const Camera &camera, const Body &body);

/* The closed form alone, one ellipse, no refinement. It leaves two poses: the one whose inner centre projects nearer to
 * the measured centroid is taken, which is kinder to it than a rule on u alone; the first without a centroid. */
Estimate shiu_ahmad(const Features &features, const Camera &camera, const Body &body);

/* The outline of the inner part in a grey picture, for sun(): level crossing at the given threshold round the
 * given centroid, then a direct fit. False when there is no outline there.
 *
 *  out       in pixels of the picture as seen
 *  picture   CV_8UC1
 *  centre    of the inner part, inside it
 *  area_px   of the inner part: sets the neighbourhood looked at
 */
bool inner_ellipse(Ellipse &out, const cv::Mat &picture, const cv::Point2d &centre_px, double area_px, int threshold);

} // namespace accuracy
