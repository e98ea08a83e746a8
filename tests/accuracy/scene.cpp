/* SPDX-License-Identifier: Apache-2.0 */
/* Ray tracer, optics and sensor of the rendered scenes. */
#include "scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace accuracy {

namespace {

/* Rays of a pixel: a Fibonacci lattice of an odd number of points covers it evenly, no two of them in one row or
 * column, and is its own mirror image through the pixel's centre, so that no direction of an edge is favoured. */
struct Lattice {
    int points;
    int step;
};
constexpr Lattice outline_lattice = {233, 89}; /* pixels that hold background and drogue */
constexpr Lattice detail_lattice = {89, 34};   /* edges within the drogue */
constexpr Lattice coarse_outline_lattice = {55, 34};
constexpr Lattice coarse_detail_lattice = {13, 8};

std::vector<cv::Point2d> points_of(const Lattice &lattice)
{
    std::vector<cv::Point2d> points;
    for (int i = -(lattice.points / 2); i <= lattice.points / 2; i++) {
        const double dx = static_cast<double>(i) / lattice.points;
        points.emplace_back(dx, std::remainder(dx * lattice.step, 1.0));
    }
    return points;
}

constexpr int64_t stream_noise = 2; /* 1 is the background's */

/* Rays and light in the drogue's frame, where the axis is z and the end plane z = 0. */
class Tracer {
public:
    explicit Tracer(const Scene &scene) : scene_(scene), d_(scene.drogue), look_(scene.look)
    {
        const cv::Vec3d e1 = scene.pose.first();
        const cv::Vec3d e2 = scene.pose.second();
        const cv::Vec3d n = scene.pose.axis;
        to_drogue_ = cv::Matx33d(e1[0], e1[1], e1[2], e2[0], e2[1], e2[2], n[0], n[1], n[2]);
        eye_ = to_drogue_ * -scene.pose.position_m;
        sun_ = to_drogue_ * scene.look.sun;
        slope_ = (d_.coupling_radius_m - d_.rim_radius_m) / d_.inner_depth_m;
    }

    Hit operator()(const cv::Point2d &seen_px) const
    {
        if (on_probe(seen_px)) {
            return {Surface::probe, scene_.probe.grey, {0, 0, 0}};
        }
        const cv::Vec3d ray = to_drogue_ * scene_.camera.ray(seen_px);
        Hit hit = {Surface::background, 0, {0, 0, 0}};
        double nearest = std::numeric_limits<double>::infinity();
        const double housing_end_m = d_.inner_depth_m + d_.housing_length_m;
        meet_tube(hit, nearest, ray);
        meet_disc(hit, nearest, ray);
        meet_cone(hit, nearest, ray);
        meet_cylinder(hit, nearest, ray, d_.coupling_radius_m, d_.inner_depth_m, housing_end_m, Surface::housing);
        meet_cylinder(hit, nearest, ray, d_.hose_radius_m, housing_end_m, housing_end_m + d_.hose_length_m,
                      Surface::hose);
        return hit;
    }

private:
    bool on_probe(const cv::Point2d &p) const
    {
        const Probe &probe = scene_.probe;
        if (probe.half_width_px <= 0) {
            return false;
        }
        const cv::Point2d along = probe.root_px - probe.tip_px;
        const cv::Point2d to = p - probe.tip_px;
        const double t = std::clamp(to.dot(along) / along.dot(along), 0.0, 1.0);
        return cv::norm(to - t * along) <= probe.half_width_px;
    }

    double scallop_at(double part) const
    {
        const double half = std::sin(CV_PI * part);
        return d_.scallop_m * half * half;
    }

    bool on_spoke(const cv::Vec3d &p) const
    {
        for (int i = 0; i < d_.spokes; i++) {
            const double angle = d_.spoke_phase_rad + 2 * CV_PI * i / d_.spokes;
            const double along = std::cos(angle) * p[0] + std::sin(angle) * p[1];
            const double aside = std::cos(angle) * p[1] - std::sin(angle) * p[0];
            if (along >= 0 && std::fabs(aside) <= d_.spoke_width_m / 2) {
                return true;
            }
        }
        return false;
    }

    bool on_patch(const cv::Vec3d &p) const
    {
        for (const Patch &patch : d_.patches) {
            const double off = std::remainder(std::atan2(p[1], p[0]) - patch.angle_rad, 2 * CV_PI);
            if (std::fabs(off) <= patch.half_angle_rad && p[2] >= patch.from_m && p[2] <= patch.to_m) {
                return true;
            }
        }
        return false;
    }

    double lambert(double albedo, const cv::Vec3d &unit_normal) const
    {
        return albedo * (look_.ambient + (1 - look_.ambient) * std::max(0.0, unit_normal.dot(sun_)));
    }

    /* Black disc and the coupling's face around it. */
    void meet_disc(Hit &hit, double &nearest, const cv::Vec3d &ray) const
    {
        const double t = (d_.inner_depth_m - eye_[2]) / ray[2];
        if (!(t > 0) || t >= nearest) {
            return;
        }
        const cv::Vec3d p = eye_ + t * ray;
        const double r = std::hypot(p[0], p[1]);
        if (r > d_.coupling_radius_m) {
            return;
        }
        nearest = t;
        const double facing = ray[2] > 0 ? -1 : 1;
        if (r <= d_.inner_radius_m && on_spoke(p)) {
            hit = {Surface::spoke, lambert(look_.spoke_grey, {0, 0, facing}), p};
            return;
        }
        const bool black = r <= d_.inner_radius_m;
        const bool rib = !black && on_wall_rib(p);
        hit = {black ? Surface::inner
               : rib ? Surface::wall_rib
                     : Surface::coupling,
               black ? look_.inner_grey : lambert(rib ? look_.wall_rib_grey : look_.coupling_grey, {0, 0, facing}), p};
    }

    bool on_wall_rib(const cv::Vec3d &p) const
    {
        const double turn = std::atan2(p[1], p[0]) / (2 * CV_PI) * d_.wall_ribs + d_.rib_phase;
        return d_.wall_ribs > 0 && std::fabs(turn - std::floor(turn + 0.5)) < d_.rib_share / 2;
    }

    /* A weave: two waves about the axis and one along it. */
    double weave(const cv::Vec3d &p) const
    {
        const double angle = std::atan2(p[1], p[0]) + d_.texture_turn;
        return 1 + d_.texture * (0.5 * std::sin(7 * angle) + 0.3 * std::sin(19 * angle) +
                                 0.4 * std::sin(3 * angle + 40 * p[2] / d_.inner_depth_m));
    }

    /* The torus, by steps of its distance from the ray's point. */
    void meet_tube(Hit &hit, double &nearest, const cv::Vec3d &ray) const
    {
        if (d_.tube_m <= 0 || ray[2] == 0) {
            return;
        }
        const double middle_m = d_.rim_radius_m - d_.tube_m;
        const double length = cv::norm(ray);
        const auto away = [&](const cv::Vec3d &p) {
            return std::hypot(std::hypot(p[0], p[1]) - middle_m, p[2]) - d_.tube_m;
        };
        double t = (-eye_[2] - std::copysign(3 * d_.tube_m, ray[2])) / ray[2];
        const double end = (-eye_[2] + std::copysign(3 * d_.tube_m, ray[2])) / ray[2];
        if (std::fabs(std::hypot(eye_[0] + t * ray[0], eye_[1] + t * ray[1]) - middle_m) > 12 * d_.tube_m) {
            return;
        }
        for (int i = 0; i < 60 && t < end; i++) {
            const cv::Vec3d p = eye_ + t * ray;
            const double off = away(p);
            if (off < 1e-6) {
                if (t <= 0 || t >= nearest) {
                    return;
                }
                const double r = std::hypot(p[0], p[1]);
                const cv::Vec3d normal =
                    cv::normalize(cv::Vec3d(p[0] * (1 - middle_m / r), p[1] * (1 - middle_m / r), p[2]));
                const cv::Vec3d mirrored = ray / length - 2 * (ray / length).dot(normal) * normal;
                nearest = t;
                hit = {Surface::tube,
                       lambert(look_.tube_grey, normal) +
                           look_.shine_grey * std::pow(std::max(0.0, mirrored.dot(sun_)), 24),
                       p};
                return;
            }
            t += off / length;
        }
    }

    /* Canopy: radius(z) = rim + slope z on [0, depth]. */
    void meet_cone(Hit &hit, double &nearest, const cv::Vec3d &ray) const
    {
        const double radius = d_.rim_radius_m + slope_ * eye_[2];
        const double a = ray[0] * ray[0] + ray[1] * ray[1] - slope_ * slope_ * ray[2] * ray[2];
        const double b = ray[0] * eye_[0] + ray[1] * eye_[1] - slope_ * ray[2] * radius;
        const double c = eye_[0] * eye_[0] + eye_[1] * eye_[1] - radius * radius;
        const double disc = b * b - a * c;
        if (disc < 0) {
            return;
        }
        const double q = -(b + std::copysign(std::sqrt(disc), b)); /* stable roots q / a and c / q */
        for (const double t : {q / a, c / q}) {
            if (!(t > 0) || t >= nearest) {
                continue;
            }
            const cv::Vec3d p = eye_ + t * ray;
            if (p[2] < 0 || p[2] > d_.inner_depth_m) {
                continue; /* also drops the cone's other half */
            }
            const double turn = std::atan2(p[1], p[0]) / (2 * CV_PI) * d_.ribs + d_.rib_phase;
            const double part = turn - std::floor(turn + 0.5); /* [-0.5, 0.5), 0 in the middle of a rib */
            if (d_.scallop_m > 0 && p[2] < scallop_at(part)) {
                continue;
            }
            const bool rib = d_.ribs > 0 && std::fabs(part) < d_.rib_share / 2;
            const double r = std::hypot(p[0], p[1]);
            cv::Vec3d normal = cv::Vec3d(p[0] / r, p[1] / r, -slope_) / std::sqrt(1 + slope_ * slope_); /* outward */
            const bool inside = ray.dot(normal) > 0;
            double albedo = look_.canopy_grey * (rib ? look_.rib_gain : 1.0);
            if (inside) {
                normal = -normal;
                albedo *= 1 - look_.depth_loss * p[2] / d_.inner_depth_m;
            }
            nearest = t;
            albedo *= weave(p);
            if (inside && r < d_.wall_share * d_.rim_radius_m) {
                const bool dark = on_wall_rib(p);
                hit = {dark ? Surface::wall_rib : Surface::wall,
                       lambert((dark ? look_.wall_rib_grey : look_.wall_grey) * weave(p), normal), p};
                continue;
            }
            if (inside && on_patch(p)) {
                hit = {Surface::patch, lambert(look_.patch_grey, normal), p};
                continue;
            }
            hit = {inside ? (rib ? Surface::inside_rib : Surface::inside)
                          : (rib ? Surface::outside_rib : Surface::outside),
                   lambert(albedo, normal), p};
        }
    }

    void meet_cylinder(Hit &hit, double &nearest, const cv::Vec3d &ray, double radius, double from, double to,
                       Surface surface) const
    {
        const double a = ray[0] * ray[0] + ray[1] * ray[1];
        const double b = ray[0] * eye_[0] + ray[1] * eye_[1];
        const double c = eye_[0] * eye_[0] + eye_[1] * eye_[1] - radius * radius;
        const double disc = b * b - a * c;
        if (disc < 0 || a == 0) {
            return;
        }
        const double t = (-b - std::sqrt(disc)) / a; /* the outside is met first */
        const cv::Vec3d p = eye_ + t * ray;
        if (!(t > 0) || t >= nearest || p[2] < from || p[2] > to) {
            return;
        }
        nearest = t;
        hit = {surface,
               lambert(surface == Surface::hose ? look_.hose_grey : look_.coupling_grey,
                       {p[0] / radius, p[1] / radius, 0}),
               p};
    }

    const Scene &scene_;
    const Drogue &d_;
    const Look &look_;
    cv::Matx33d to_drogue_;
    cv::Vec3d eye_;
    cv::Vec3d sun_;
    double slope_;
};

/* Grey of each pixel averaged over its area. Pixels whose neighbourhood shows one surface need one ray. */
cv::Mat trace_area(const Scene &scene, const cv::Rect &area)
{
    const Tracer tracer(scene);
    const std::vector<cv::Point2d> outline_points = points_of(scene.coarse ? coarse_outline_lattice : outline_lattice);
    const std::vector<cv::Point2d> detail_points = points_of(scene.coarse ? coarse_detail_lattice : detail_lattice);
    const auto background = static_cast<uint8_t>(Surface::background);
    cv::Mat surface(area.height + 2, area.width + 2, CV_8U);
    cv::Mat grey(area.height + 2, area.width + 2, CV_64F);
    for (int y = 0; y < surface.rows; y++) {
        for (int x = 0; x < surface.cols; x++) {
            const Hit hit = tracer(cv::Point2d(area.x - 1 + x, area.y - 1 + y));
            surface.at<uint8_t>(y, x) = static_cast<uint8_t>(hit.surface);
            grey.at<double>(y, x) = hit.grey;
        }
    }
    cv::Mat out(area.size(), CV_64F);
    for (int y = 0; y < area.height; y++) {
        for (int x = 0; x < area.width; x++) {
            const uint8_t own = surface.at<uint8_t>(y + 1, x + 1);
            bool plain = true;
            bool outline = false;
            for (int k = 0; k < 9; k++) {
                const uint8_t near = surface.at<uint8_t>(y + k / 3, x + k % 3);
                plain = plain && near == own;
                outline = outline || near == background;
            }
            const double behind = outline ? background_grey(scene, area.x + x, area.y + y) : 0;
            double &result = out.at<double>(y, x);
            if (plain) {
                result = own == background ? behind : grey.at<double>(y + 1, x + 1);
                continue;
            }
            double sum = 0;
            const std::vector<cv::Point2d> &points = outline ? outline_points : detail_points;
            for (const cv::Point2d &d : points) {
                const Hit hit = tracer(cv::Point2d(area.x + x + d.x, area.y + y + d.y));
                sum += hit.surface == Surface::background ? behind : hit.grey;
            }
            result = sum / static_cast<double>(points.size());
        }
    }
    return out;
}

/* Gaussian sampled out to four sigma, sum 1. */
std::vector<double> gaussian(double sigma)
{
    const int reach = static_cast<int>(std::ceil(4 * sigma));
    std::vector<double> taps(static_cast<size_t>(2 * reach + 1));
    double sum = 0;
    for (int i = -reach; i <= reach; i++) {
        sum += taps[static_cast<size_t>(i + reach)] = sigma > 0 ? std::exp(-0.5 * i * i / (sigma * sigma)) : 1;
    }
    for (double &t : taps) {
        t /= sum;
    }
    return taps;
}

/* Both passes of a separable filter; the result loses the filter's reach on every side. */
cv::Mat filter(const cv::Mat &in, const std::vector<double> &taps)
{
    const int reach = static_cast<int>(taps.size()) / 2;
    cv::Mat rows = cv::Mat::zeros(in.rows, in.cols - 2 * reach, CV_64F);
    cv::Mat out = cv::Mat::zeros(in.rows - 2 * reach, in.cols - 2 * reach, CV_64F);
    for (int i = -reach; i <= reach; i++) {
        rows += taps[static_cast<size_t>(i + reach)] * in.colRange(reach + i, reach + i + rows.cols);
    }
    for (int i = -reach; i <= reach; i++) {
        out += taps[static_cast<size_t>(i + reach)] * rows.rowRange(reach + i, reach + i + out.rows);
    }
    return out;
}

/* Mean along a straight path of the given length about each pixel; the result loses 'reach' on every side. */
cv::Mat smear(const cv::Mat &in, double length, double angle, int reach)
{
    const int steps = std::max(1, static_cast<int>(std::ceil(4 * length)));
    cv::Mat out = cv::Mat::zeros(in.rows - 2 * reach, in.cols - 2 * reach, CV_64F);
    for (int i = 0; i < steps; i++) {
        const double s = length * ((i + 0.5) / steps - 0.5);
        const double x = reach + s * std::cos(angle);
        const double y = reach + s * std::sin(angle);
        const int ix = static_cast<int>(std::floor(x));
        const int iy = static_cast<int>(std::floor(y));
        const auto part = [&](int dx, int dy) { return in(cv::Rect(ix + dx, iy + dy, out.cols, out.rows)); };
        out += ((1 - (x - ix)) * (1 - (y - iy)) / steps) * part(0, 0);
        out += ((x - ix) * (1 - (y - iy)) / steps) * part(1, 0);
        out += ((1 - (x - ix)) * (y - iy) / steps) * part(0, 1);
        out += ((x - ix) * (y - iy) / steps) * part(1, 1);
    }
    return out;
}

} // namespace

Look Look::dark() { return Look(); }

Look Look::bright()
{
    Look look;
    look.canopy_grey = 215;
    look.rib_gain = 0.85;
    look.coupling_grey = 120;
    look.hose_grey = 90;
    return look;
}

Hit trace(const Scene &scene, const cv::Point2d &seen_px) { return Tracer(scene)(seen_px); }

cv::Mat render_light(const Scene &scene, const cv::Rect &region)
{
    const Sensor &s = scene.sensor;
    const std::vector<double> taps = gaussian(std::hypot(s.blur_px, s.motion_sigma_px));
    const int blur_reach = static_cast<int>(taps.size()) / 2;
    const int smear_reach = s.motion_length_px > 0 ? static_cast<int>(std::ceil(s.motion_length_px / 2)) + 1 : 0;
    const int reach = blur_reach + smear_reach;
    cv::Mat light = trace_area(
        scene, cv::Rect(region.x - reach, region.y - reach, region.width + 2 * reach, region.height + 2 * reach));
    light = filter(light, taps);
    if (smear_reach > 0) {
        light = smear(light, s.motion_length_px, s.motion_angle_rad, smear_reach);
    }
    if (s.light_radius_px > 0) {
        for (int y = 0; y < region.height; y++) {
            for (int x = 0; x < region.width; x++) {
                const double distance = std::hypot(region.x + x - s.light_at_px.x, region.y + y - s.light_at_px.y);
                light.at<double>(y, x) *= std::max(0.0, s.light_k * (1 - distance / s.light_radius_px));
            }
        }
    }
    if (s.glare_grey > 0) {
        for (int y = 0; y < region.height; y++) {
            for (int x = 0; x < region.width; x++) {
                const double r = std::hypot(region.x + x - s.glare_at_px.x, region.y + y - s.glare_at_px.y);
                light.at<double>(y, x) +=
                    s.glare_grey * std::exp(-0.5 * r * r / (s.glare_radius_px * s.glare_radius_px));
            }
        }
    }
    return light;
}

cv::Mat render(const Scene &scene, const cv::Rect &region)
{
    const cv::Mat light = render_light(scene, region);
    const uint64_t seed = hash_at(scene.seed, stream_noise, 0);
    cv::Mat out(region.size(), CV_8U);
    for (int y = 0; y < region.height; y++) {
        for (int x = 0; x < region.width; x++) {
            const double noisy =
                light.at<double>(y, x) + scene.sensor.noise * normal_at(seed, region.x + x, region.y + y);
            out.at<uint8_t>(y, x) = static_cast<uint8_t>(std::clamp(std::floor(noisy + 0.5), 0.0, 255.0));
        }
    }
    return out;
}

} // namespace accuracy
