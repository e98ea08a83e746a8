/* SPDX-License-Identifier: Apache-2.0 */
/* Camera, pose and conic in double precision. */
#include "geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace accuracy {

cv::Point2d Camera::project_ideal(const cv::Vec3d &p) const
{
    return {fx_px * p[0] / p[2] + cx_px, fy_px * p[1] / p[2] + cy_px};
}

cv::Point2d Camera::project(const cv::Vec3d &p) const { return distort(project_ideal(p)); }

cv::Point2d Camera::distort(const cv::Point2d &ideal_px) const
{
    const double x = (ideal_px.x - cx_px) / fx_px;
    const double y = (ideal_px.y - cy_px) / fy_px;
    const double r2 = x * x + y * y;
    const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
    return {fx_px * (x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)) + cx_px,
            fy_px * (y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y) + cy_px};
}

cv::Point2d Camera::undistort(const cv::Point2d &seen_px) const
{
    const double step = 1e-4; /* px, of the central differences */
    cv::Point2d guess = seen_px;
    if (!distorts()) {
        return guess;
    }
    for (int i = 0; i < 50; i++) {
        const cv::Point2d miss = seen_px - distort(guess);
        if (std::hypot(miss.x, miss.y) < 1e-9) {
            return guess;
        }
        const cv::Point2d dx =
            (distort(guess + cv::Point2d(step, 0)) - distort(guess - cv::Point2d(step, 0))) / (2 * step);
        const cv::Point2d dy =
            (distort(guess + cv::Point2d(0, step)) - distort(guess - cv::Point2d(0, step))) / (2 * step);
        const double det = dx.x * dy.y - dx.y * dy.x;
        guess += cv::Point2d(miss.x * dy.y - miss.y * dy.x, dx.x * miss.y - dx.y * miss.x) / det;
    }
    throw std::domain_error("the camera's distortion has no inverse here");
}

cv::Vec3d Camera::ray(const cv::Point2d &seen_px) const
{
    const cv::Point2d ideal = undistort(seen_px);
    return {(ideal.x - cx_px) / fx_px, (ideal.y - cy_px) / fy_px, 1.0};
}

Camera Camera::cropped(const cv::Point &origin_px) const
{
    Camera c = *this;
    c.cx_px -= origin_px.x;
    c.cy_px -= origin_px.y;
    return c;
}

cv::Vec3d Pose::first() const { return cv::normalize(cv::Vec3d(axis[2], 0, -axis[0])); }

cv::Vec3d Pose::second() const { return axis.cross(first()); }

cv::Vec3d axis_of(double yaw_rad, double pitch_rad)
{
    return {std::sin(yaw_rad) * std::cos(pitch_rad), std::sin(pitch_rad), std::cos(yaw_rad) * std::cos(pitch_rad)};
}

double yaw_of(const cv::Vec3d &axis) { return std::atan2(axis[0], axis[2]); }

double pitch_of(const cv::Vec3d &axis) { return std::asin(std::clamp(axis[1], -1.0, 1.0)); }

double angle_between_deg(const cv::Vec3d &a, const cv::Vec3d &b)
{
    return std::atan2(cv::norm(a.cross(b)), a.dot(b)) * 180 / CV_PI; /* well conditioned at small angles */
}

cv::Point2d Ellipse::at(double t) const
{
    const double u = a_px * std::cos(t);
    const double v = b_px * std::sin(t);
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return {xc_px + c * u - s * v, yc_px + s * u + c * v};
}

double Ellipse::radius_from(const cv::Point2d &p, double direction_rad) const
{
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    const double px = (c * (p.x - xc_px) + s * (p.y - yc_px)) / a_px;
    const double py = (c * (p.y - yc_px) - s * (p.x - xc_px)) / b_px;
    const double dx = std::cos(direction_rad - angle_rad) / a_px;
    const double dy = std::sin(direction_rad - angle_rad) / b_px;
    const double qa = dx * dx + dy * dy;
    const double qb = px * dx + py * dy;
    const double qc = px * px + py * py - 1;
    return qc >= 0 ? -1 : (-qb + std::sqrt(qb * qb - qa * qc)) / qa;
}

Ellipse project_circle(const Camera &camera, const Pose &pose, double radius_m, double depth_m)
{
    /* Plane coordinates (X, Y, 1) go to the image by H; the circle's conic by its inverse. */
    const cv::Vec3d e1 = pose.first() * radius_m;
    const cv::Vec3d e2 = pose.second() * radius_m;
    const cv::Vec3d p = pose.position_m + depth_m * pose.axis;
    const cv::Matx33d k(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1);
    const cv::Matx33d h = k * cv::Matx33d(e1[0], e2[0], p[0], e1[1], e2[1], p[1], e1[2], e2[2], p[2]);
    const cv::Matx33d hi = h.inv();
    const cv::Matx33d q = hi.t() * cv::Matx33d::diag(cv::Vec3d(1, 1, -1)) * hi;

    const double det = q(0, 0) * q(1, 1) - q(0, 1) * q(0, 1);
    if (!(det > 0)) {
        throw std::domain_error("the circle's image is no ellipse");
    }
    Ellipse e;
    e.xc_px = (q(0, 1) * q(1, 2) - q(1, 1) * q(0, 2)) / det;
    e.yc_px = (q(0, 1) * q(0, 2) - q(0, 0) * q(1, 2)) / det;
    const double scale = -(q(0, 2) * e.xc_px + q(1, 2) * e.yc_px + q(2, 2)); /* value to which the form is equal */
    const double mean = (q(0, 0) + q(1, 1)) / 2;
    const double half = std::hypot((q(0, 0) - q(1, 1)) / 2, q(0, 1));
    e.a_px = std::sqrt(scale * (mean + half) / det);
    e.b_px = std::sqrt(scale / (mean + half));
    e.angle_rad = std::atan2(-2 * q(0, 1), q(1, 1) - q(0, 0)) / 2; /* direction of the smaller eigenvalue */
    if (e.angle_rad <= -CV_PI / 2) {
        e.angle_rad += CV_PI;
    }
    return e;
}

Ellipse ellipse_of(const cv::RotatedRect &rect)
{
    const bool wide = rect.size.width >= rect.size.height;
    const double major = std::max(rect.size.width, rect.size.height) / 2.0;
    const double minor = std::min(rect.size.width, rect.size.height) / 2.0;
    const double angle = (rect.angle + (wide ? 0 : 90)) * CV_PI / 180;
    return {rect.center.x, rect.center.y, major, minor, std::remainder(angle, CV_PI)};
}

double ellipse_error_px(const Ellipse &measured, const Ellipse &truth)
{
    const cv::Point2d centre(truth.xc_px, truth.yc_px);
    double sum = 0;
    for (int i = 0; i < 360; i++) {
        const double direction = i * CV_PI / 180;
        const double r = measured.radius_from(centre, direction);
        if (!(r > 0)) {
            return std::numeric_limits<double>::infinity();
        }
        sum += std::fabs(r - truth.radius_from(centre, direction));
    }
    return sum / 360;
}

} // namespace accuracy
