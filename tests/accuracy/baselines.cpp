/* SPDX-License-Identifier: Apache-2.0 */
/* Martinez, Yin, Ma and Zhao, Sun, Shiu and Ahmad: the geometry of each, in double precision. */
#include "baselines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace accuracy {

namespace {

/* Conic of an ellipse in normalised coordinates (x / z, y / z), negative inside. */
cv::Matx33d cone_of(const Camera &camera, const Ellipse &e)
{
    const double c = std::cos(e.angle_rad);
    const double s = std::sin(e.angle_rad);
    /* Rows take a pixel to the coordinates in which the ellipse is the unit circle. */
    const cv::Matx33d to_unit(c / e.a_px, s / e.a_px, -(c * e.xc_px + s * e.yc_px) / e.a_px, -s / e.b_px, c / e.b_px,
                              (s * e.xc_px - c * e.yc_px) / e.b_px, 0, 0, 1);
    const cv::Matx33d k(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1);
    const cv::Matx33d m = to_unit * k;
    return m.t() * cv::Matx33d::diag({1, 1, -1}) * m;
}

cv::Vec3d back_project(const Camera &camera, const cv::Point2d &px, double z_m)
{
    return {(px.x - camera.cx_px) / camera.fx_px * z_m, (px.y - camera.cy_px) / camera.fy_px * z_m, z_m};
}

double focal_px(const Camera &camera) { return (camera.fx_px + camera.fy_px) / 2; }

Estimate frontal(const Camera &camera, const cv::Point2d &px, double z_m)
{
    Estimate e;
    e.ok = z_m > 0;
    e.position_m = back_project(camera, px, z_m);
    return e;
}

Estimate with_axis(const cv::Vec3d &position_m, const cv::Vec3d &axis)
{
    Estimate e;
    e.ok = e.has_axis = true;
    e.position_m = position_m;
    e.axis = axis;
    return e;
}

} // namespace

bool circle_poses(std::array<Pose, 2> &out, const Camera &camera, const Ellipse &ellipse, double radius_m)
{
    cv::Vec3d value; /* descending: two positive, one negative */
    cv::Matx33d vector;
    if (!(ellipse.a_px > 0 && ellipse.b_px > 0)) {
        return false;
    }
    cv::Matx33d cone = cone_of(camera, ellipse);
    cone *= 1 / cv::norm(cone);
    cv::eigen(cone, value, vector);
    if (!(value[1] > 0 && value[2] < 0)) {
        return false;
    }
    const cv::Vec3d e1(vector(0, 0), vector(0, 1), vector(0, 2));
    cv::Vec3d e3(vector(2, 0), vector(2, 1), vector(2, 2));
    e3 = e3[2] < 0 ? -e3 : e3;
    const double sum = value[0] - value[2];
    const double tilt = std::sqrt((value[0] - value[1]) / sum);
    const double upright = std::sqrt((value[1] - value[2]) / sum);
    const double stretch = std::sqrt(-value[2] / value[0]);
    for (size_t i = 0; i < 2; i++) {
        const double side = i == 0 ? 1 : -1;
        out[i].position_m = radius_m * (side * tilt * stretch * e1 + upright / stretch * e3);
        out[i].axis = -side * tilt * e1 + upright * e3;
    }
    return true;
}

Estimate martinez(const Features &features, const Camera &camera, const Body &body)
{
    const Ellipse &e = features.outer;
    const double c = std::cos(e.angle_rad);
    const double s = std::sin(e.angle_rad);
    const double w = 2 * std::hypot(e.a_px * c, e.b_px * s);
    const double h = 2 * std::hypot(e.a_px * s, e.b_px * c);
    return frontal(camera, {e.xc_px, e.yc_px}, 2 * body.rim_radius_m * focal_px(camera) / ((w + h) / 2));
}

Estimate yin(const Features &features, const Camera &camera, const Body &body)
{
    if (!features.has_inner || !(features.inner_area_px > 0)) {
        return {};
    }
    const double z = focal_px(camera) * body.inner_radius_m / std::sqrt(features.inner_area_px / CV_PI);
    Estimate e = frontal(camera, features.inner_px, z);
    e.position_m[2] -= body.inner_depth_m;
    return e;
}

Estimate ma_zhao(const Features &features, const Camera &camera, const Body &body)
{
    const Ellipse &e = features.outer;
    return frontal(camera, {e.xc_px, e.yc_px}, body.rim_radius_m * focal_px(camera) / e.a_px);
}

Estimate sun(const Features &features, const Camera &camera, const Body &body)
{
    std::array<Pose, 2> outer;
    std::array<Pose, 2> inner;
    if (!features.has_inner_ellipse || !circle_poses(outer, camera, features.outer, body.rim_radius_m) ||
        !circle_poses(inner, camera, features.inner, body.inner_radius_m)) {
        return {};
    }
    std::pair<Pose, Pose> best;
    double best_agreement = -std::numeric_limits<double>::infinity();
    for (const Pose &o : outer) {
        for (const Pose &i : inner) {
            const cv::Vec3d line = cv::normalize(i.position_m - o.position_m);
            const double agreement = line.dot(o.axis) + line.dot(i.axis);
            if (agreement > best_agreement) {
                best_agreement = agreement;
                best = {o, i};
            }
        }
    }
    const double outer_weight = features.outer.a_px * features.outer.a_px;
    const double inner_weight = features.inner.a_px * features.inner.a_px;
    const cv::Vec3d moved = best.second.position_m - body.inner_depth_m * best.second.axis;
    return with_axis((outer_weight * best.first.position_m + inner_weight * moved) / (outer_weight + inner_weight),
                     cv::normalize(outer_weight * best.first.axis + inner_weight * best.second.axis));
}

Estimate shiu_ahmad(const Features &features, const Camera &camera, const Body &body)
{
    std::array<Pose, 2> poses;
    if (!circle_poses(poses, camera, features.outer, body.rim_radius_m)) {
        return {};
    }
    const auto miss = [&](const Pose &p) {
        return cv::norm(camera.project_ideal(p.position_m + body.inner_depth_m * p.axis) - features.inner_px);
    };
    const Pose &p = poses[features.has_inner && miss(poses[1]) < miss(poses[0]) ? 1 : 0];
    return with_axis(p.position_m, p.axis);
}

bool inner_ellipse(Ellipse &out, const cv::Mat &picture, const cv::Point2d &centre_px, double area_px, int threshold)
{
    const int half = static_cast<int>(std::ceil(2 * std::sqrt(area_px / CV_PI))) + 3;
    const cv::Rect wanted(static_cast<int>(std::lround(centre_px.x)) - half,
                          static_cast<int>(std::lround(centre_px.y)) - half, 2 * half + 1, 2 * half + 1);
    const cv::Rect part = wanted & cv::Rect({0, 0}, picture.size());
    if (part.width < 5 || part.height < 5) {
        return false;
    }
    /* Enlarged, so that the contour, which runs over pixels' centres, follows the level between them. */
    const int zoom = std::clamp(600 / part.width, 2, 8);
    cv::Mat large;
    cv::Mat dark;
    std::vector<std::vector<cv::Point>> contours;
    cv::resize(picture(part), large, {}, zoom, zoom, cv::INTER_CUBIC);
    cv::threshold(large, dark, threshold, 255, cv::THRESH_BINARY_INV);
    cv::findContours(dark, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    const cv::Point2d at = (centre_px - cv::Point2d(part.tl()) + cv::Point2d(0.5, 0.5)) * zoom - cv::Point2d(0.5, 0.5);
    for (const auto &contour : contours) {
        if (contour.size() >= 12 && cv::pointPolygonTest(contour, cv::Point2f(at), false) >= 0) {
            const Ellipse e = ellipse_of(cv::fitEllipseDirect(contour));
            const cv::Point2d centre = (cv::Point2d(e.xc_px, e.yc_px) + cv::Point2d(0.5, 0.5)) / zoom +
                                       cv::Point2d(part.tl()) - cv::Point2d(0.5, 0.5);
            out = {centre.x, centre.y, (e.a_px + 0.5) / zoom, (e.b_px + 0.5) / zoom, e.angle_rad};
            return out.b_px > 0; /* false for NaN, too */
        }
    }
    return false;
}

} // namespace accuracy
