/* SPDX-License-Identifier: Apache-2.0 */
/* Truth in floating point: pinhole camera with Brown-Conrady distortion, pose of the drogue, image ellipse of a
 * circle. Conventions as in the library: the top-left pixel's centre is (0, 0), x right, y down, z forward, the
 * axis points into the drogue. */
#pragma once

#include <opencv2/core.hpp>

namespace accuracy {

struct Camera {
    double fx_px, fy_px, cx_px, cy_px;
    double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;

    bool distorts() const { return k1 != 0 || k2 != 0 || p1 != 0 || p2 != 0 || k3 != 0; }
    /* Pixel of the ideal pinhole camera of the same fx, fy, cx, cy. */
    cv::Point2d project_ideal(const cv::Vec3d &point_m) const;
    /* Pixel as seen, distortion included. */
    cv::Point2d project(const cv::Vec3d &point_m) const;
    cv::Point2d distort(const cv::Point2d &ideal_px) const;
    /* Inverse of distort() by Newton's method, to 1e-9 px; throws where the model has no inverse. */
    cv::Point2d undistort(const cv::Point2d &seen_px) const;
    /* Viewing ray through a pixel as seen, z = 1. */
    cv::Vec3d ray(const cv::Point2d &seen_px) const;
    /* The same camera for an image whose top-left pixel is the given one of this camera's image. */
    Camera cropped(const cv::Point &origin_px) const;
};

struct Pose {
    cv::Vec3d position_m; /* centre of the end plane */
    cv::Vec3d axis;       /* unit, into the drogue */

    /* Unit vectors of the end plane; (first, second, axis) is right-handed. */
    cv::Vec3d first() const;
    cv::Vec3d second() const;
};

cv::Vec3d axis_of(double yaw_rad, double pitch_rad);
double yaw_of(const cv::Vec3d &axis);
double pitch_of(const cv::Vec3d &axis);
double angle_between_deg(const cv::Vec3d &a, const cv::Vec3d &b); /* of unit vectors */

/* Semi-axes a >= b, angle of the major axis from +x towards +y in (-pi/2, pi/2]. */
struct Ellipse {
    double xc_px, yc_px, a_px, b_px, angle_rad;

    cv::Point2d at(double eccentric_rad) const;
    /* Distance of the outline from a point inside, in a direction; negative when the point is outside. */
    double radius_from(const cv::Point2d &inside, double direction_rad) const;
};

/* Ideal image of the circle of the given radius about the axis, at the given depth behind the end plane. */
Ellipse project_circle(const Camera &camera, const Pose &pose, double radius_m, double depth_m);

/* OpenCV's rectangle about an ellipse. */
Ellipse ellipse_of(const cv::RotatedRect &rect);

/* Mean over 360 directions from the true centre of the absolute difference of the two outlines' distances;
 * infinite when the measured ellipse does not hold the true centre. */
double ellipse_error_px(const Ellipse &measured, const Ellipse &truth);

} // namespace accuracy
