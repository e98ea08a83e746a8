/* SPDX-License-Identifier: Apache-2.0 */
/* The flash lidar and what is fitted to its range image. */
#include "stereo.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace accuracy {

namespace {

constexpr double reach_m = 60;
constexpr int rays = 5;          /* of a pixel, across and down */
constexpr int samples = 2000;    /* of RANSAC */
constexpr double plane_m = 0.06; /* three times the noise */
constexpr double field_deg = 45;

struct Circle {
    cv::Vec3d centre, axis;
    double radius = 0;
};

/* Through three points; false when they are on a line. */
bool through(Circle &out, const cv::Vec3d &a, const cv::Vec3d &b, const cv::Vec3d &c)
{
    const cv::Vec3d u = b - a;
    const cv::Vec3d v = c - a;
    const cv::Vec3d n = u.cross(v);
    const double n2 = n.dot(n);
    if (n2 < 1e-12) {
        return false;
    }
    const cv::Vec3d to = (u.dot(u) * v.cross(n) + v.dot(v) * n.cross(u)) * (0.5 / n2);
    out = {a + to, cv::normalize(n[2] < 0 ? -n : n), cv::norm(to)};
    return true;
}

/* Plane and, in it, circle by least squares (Kasa's algebraic form). */
bool fit(Circle &out, const std::vector<cv::Vec3d> &points)
{
    const PlaneFit plane = fit_plane(points);
    cv::Matx33d left = cv::Matx33d::zeros();
    cv::Vec3d right;
    for (const cv::Vec3d &p : points) {
        const cv::Vec3d row((p - plane.mean).dot(plane.first), (p - plane.mean).dot(plane.second), 1);
        left += row * row.t();
        right += row * (row[0] * row[0] + row[1] * row[1]);
    }
    cv::Vec3d x;
    if (!cv::solve(left, right, x, cv::DECOMP_CHOLESKY)) {
        return false;
    }
    out.centre = plane.mean + plane.first * (x[0] / 2) + plane.second * (x[1] / 2);
    out.axis = plane.normal;
    out.radius = std::sqrt(x[2] + (x[0] * x[0] + x[1] * x[1]) / 4);
    return std::isfinite(out.radius);
}

} // namespace

Camera lidar_camera()
{
    const double f = lidar_side_px / 2.0 / std::tan(field_deg / 2 * CV_PI / 180);
    return {f, f, (lidar_side_px - 1) / 2.0, (lidar_side_px - 1) / 2.0};
}

cv::Mat lidar_range(const Scene &scene, double noise_m)
{
    Scene view = scene;
    view.camera = lidar_camera();
    const cv::Vec3d e1 = view.pose.first();
    const cv::Vec3d e2 = view.pose.second();
    cv::Mat range(lidar_side_px, lidar_side_px, CV_64F);
    for (int y = 0; y < range.rows; y++) {
        for (int x = 0; x < range.cols; x++) {
            double nearest = std::numeric_limits<double>::infinity();
            for (int i = 0; i < rays * rays; i++) {
                const cv::Point2d at(x + (i % rays + 0.5) / rays - 0.5, y + (i / rays + 0.5) / rays - 0.5);
                const Hit hit = trace(view, at);
                if (hit.surface != Surface::background) {
                    const cv::Vec3d p = view.pose.position_m + hit.point_m[0] * e1 + hit.point_m[1] * e2 +
                                        hit.point_m[2] * view.pose.axis;
                    nearest = std::min(nearest, cv::norm(p));
                }
            }
            range.at<double>(y, x) = nearest < reach_m ? nearest + noise_m * normal_at(scene.seed + 9, x, y)
                                                       : std::numeric_limits<double>::quiet_NaN();
        }
    }
    return range;
}

Estimate chen(const cv::Mat &range_m, const Body &body, uint64_t seed)
{
    const Camera camera = lidar_camera();
    const auto returns = [&](int x, int y) {
        return x >= 0 && y >= 0 && x < range_m.cols && y < range_m.rows && std::isfinite(range_m.at<double>(y, x));
    };
    std::vector<cv::Vec3d> edge;
    for (int y = 0; y < range_m.rows; y++) {
        for (int x = 0; x < range_m.cols; x++) {
            const bool inside = returns(x - 1, y) && returns(x + 1, y) && returns(x, y - 1) && returns(x, y + 1);
            if (returns(x, y) && !inside) {
                edge.push_back(cv::normalize(camera.ray(cv::Point2d(x, y))) * range_m.at<double>(y, x));
            }
        }
    }
    if (edge.size() < 6) {
        return {};
    }
    Random random(seed);
    std::vector<cv::Vec3d> best;
    for (int i = 0; i < samples; i++) {
        const auto pick = [&] { return edge[random.next() % edge.size()]; };
        const cv::Vec3d a = pick();
        const cv::Vec3d b = pick();
        const cv::Vec3d c = pick();
        Circle circle;
        if (!through(circle, a, b, c)) {
            continue;
        }
        const double pixel_m = circle.centre[2] / camera.fx_px;
        if (std::fabs(circle.radius - body.rim_radius_m) > 0.1 * body.rim_radius_m + 0.5 * pixel_m ||
            circle.axis[2] < 0.7) {
            continue;
        }
        std::vector<cv::Vec3d> agree;
        for (const cv::Vec3d &p : edge) {
            const double off = (p - circle.centre).dot(circle.axis);
            const double radius = cv::norm(p - circle.centre - off * circle.axis);
            if (std::fabs(off) <= plane_m && std::fabs(radius - circle.radius) <= 0.5 * pixel_m) {
                agree.push_back(p);
            }
        }
        if (agree.size() > best.size()) {
            best = agree;
        }
    }
    Circle circle;
    Estimate e;
    if (best.size() >= 6 && fit(circle, best)) {
        e.ok = e.has_axis = true;
        e.position_m = circle.centre;
        e.axis = circle.axis;
    }
    return e;
}

} // namespace accuracy
