/* SPDX-License-Identifier: Apache-2.0 */
/* Triangulation of centre and rim. */
#include "stereo.hpp"

#include <cmath>
#include <vector>

namespace accuracy {

namespace {

/* Middle of the shortest line between the rays from both cameras; false when they do not converge. */
bool triangulate(cv::Vec3d &out, const cv::Vec3d &left, const cv::Vec3d &right)
{
    const cv::Vec3d a = cv::normalize(left);
    const cv::Vec3d b = cv::normalize(right);
    const cv::Vec3d base(baseline_m, 0, 0);
    const double cosine = a.dot(b);
    const double sine2 = 1 - cosine * cosine;
    if (sine2 < 1e-12) {
        return false;
    }
    const double s = (base.dot(a) - base.dot(b) * cosine) / sine2;
    const double t = (base.dot(a) * cosine - base.dot(b)) / sine2;
    out = 0.5 * (s * a + base + t * b);
    return s > 0 && t > 0;
}

/* Half the height of an ellipse. */
double half_height_px(const Ellipse &e)
{
    return std::hypot(e.a_px * std::sin(e.angle_rad), e.b_px * std::cos(e.angle_rad));
}

/* Where a row cuts the ellipse: left and right; false when it does not. */
bool cut(double &low, double &high, const Ellipse &e, double row)
{
    const double c = std::cos(e.angle_rad);
    const double s = std::sin(e.angle_rad);
    const double y = row - e.yc_px;
    const double ia = 1 / (e.a_px * e.a_px);
    const double ib = 1 / (e.b_px * e.b_px);
    /* qa x^2 + 2 qb x + qc = 0 */
    const double qa = c * c * ia + s * s * ib;
    const double qb = c * s * (ia - ib) * y;
    const double qc = (s * s * ia + c * c * ib) * y * y - 1;
    const double root2 = qb * qb - qa * qc;
    if (!(root2 > 0)) {
        return false;
    }
    low = e.xc_px + (-qb - std::sqrt(root2)) / qa;
    high = e.xc_px + (-qb + std::sqrt(root2)) / qa;
    return true;
}

} // namespace

PlaneFit fit_plane(const std::vector<cv::Vec3d> &points)
{
    PlaneFit plane;
    for (const cv::Vec3d &p : points) {
        plane.mean += p * (1.0 / static_cast<double>(points.size()));
    }
    cv::Matx33d spread = cv::Matx33d::zeros();
    for (const cv::Vec3d &p : points) {
        spread += (p - plane.mean) * (p - plane.mean).t();
    }
    cv::Vec3d value;
    cv::Matx33d vector;
    cv::eigen(spread, value, vector);
    plane.first = {vector(0, 0), vector(0, 1), vector(0, 2)};
    plane.second = {vector(1, 0), vector(1, 1), vector(1, 2)};
    plane.normal = plane.first.cross(plane.second);
    plane.normal = plane.normal[2] < 0 ? -plane.normal : plane.normal;
    return plane;
}

Scene seen_from_right(const Scene &scene)
{
    Scene right = scene;
    right.pose.position_m[0] -= baseline_m;
    right.seed = mix64(scene.seed + 77);
    return right;
}

Estimate duan(const Features &left, const Features &right, const Camera &camera, const Body &body)
{
    const Estimate l = shiu_ahmad(left, camera, body);
    const Estimate r = shiu_ahmad(right, camera, body);
    Estimate e;
    if (l.ok && r.ok && triangulate(e.position_m, l.position_m, r.position_m)) {
        e.ok = e.has_axis = true;
        e.axis = cv::normalize(l.axis + r.axis);
    }
    return e;
}

Estimate xu(const Features &left, const Features &right, const Camera &camera, const Body &body)
{
    const Estimate centre = duan(left, right, camera, body);
    std::vector<cv::Vec3d> points; /* the centre comes last */
    if (!centre.ok) {
        return {};
    }
    for (const double at : {-0.6, 0.0, 0.6}) {
        const double row = left.outer.yc_px + at * half_height_px(left.outer);
        double l[2], r[2];
        if (!cut(l[0], l[1], left.outer, row) || !cut(r[0], r[1], right.outer, row)) {
            return {};
        }
        for (int side = 0; side < 2; side++) {
            if (!(l[side] > r[side])) {
                return {};
            }
            const double z = camera.fx_px * baseline_m / (l[side] - r[side]);
            points.emplace_back((l[side] - camera.cx_px) / camera.fx_px * z, (row - camera.cy_px) / camera.fy_px * z,
                                z);
        }
    }
    points.push_back(centre.position_m);

    const PlaneFit plane = fit_plane(points);
    /* In the plane: every point of the rim says where the centre is; the centre itself is one more such word. */
    const auto in_plane = [&](const cv::Vec3d &p) { return p - plane.normal * (p - plane.mean).dot(plane.normal); };
    cv::Vec3d c = plane.mean;
    for (int step = 0; step < 200; step++) {
        cv::Vec3d next = in_plane(points.back());
        for (size_t i = 0; i + 1 < points.size(); i++) {
            const cv::Vec3d p = in_plane(points[i]);
            next += p - body.rim_radius_m * cv::normalize(p - c);
        }
        c = next * (1.0 / static_cast<double>(points.size()));
    }
    Estimate e;
    e.ok = e.has_axis = true;
    e.position_m = c;
    e.axis = plane.normal;
    return e;
}

} // namespace accuracy
