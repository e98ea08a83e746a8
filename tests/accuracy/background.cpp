/* SPDX-License-Identifier: Apache-2.0 */
/* What is behind the drogue: gradient, texture, ramp, things. */
#include <algorithm>
#include <cmath>

#include "scene.hpp"

namespace accuracy {

namespace {

constexpr int64_t stream_texture = 1; /* 2 is the noise's */

/* Value noise in [-1, 1] with a quintic fade between lattice values. */
double value_noise(uint64_t seed, double x, double y)
{
    const double fx = std::floor(x);
    const double fy = std::floor(y);
    const auto ix = static_cast<int64_t>(fx);
    const auto iy = static_cast<int64_t>(fy);
    const auto fade = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
    const auto at = [&](int64_t dx, int64_t dy) { return 2 * unit(hash_at(seed, ix + dx, iy + dy)) - 1; };
    const double u = fade(x - fx);
    const double v = fade(y - fy);
    return (at(0, 0) * (1 - u) + at(1, 0) * u) * (1 - v) + (at(0, 1) * (1 - u) + at(1, 1) * u) * v;
}

/* Share of a pixel that a thing covers. */
double cover(const Clutter &c, double x_px, double y_px)
{
    const double dx = x_px - c.at_px.x;
    const double dy = y_px - c.at_px.y;
    const double u = std::cos(c.angle_rad) * dx + std::sin(c.angle_rad) * dy;
    const double v = std::cos(c.angle_rad) * dy - std::sin(c.angle_rad) * dx;
    double outside; /* distance from its outline, px */
    if (c.round) {
        const double k = std::hypot(u / c.half_length_px, v / c.half_width_px);
        const double slope =
            std::hypot(u / (c.half_length_px * c.half_length_px), v / (c.half_width_px * c.half_width_px));
        outside = slope > 0 ? k * (k - 1) / slope : -c.half_width_px;
    } else {
        outside = std::max(std::fabs(u) - c.half_length_px, std::fabs(v) - c.half_width_px);
    }
    return std::clamp(0.5 - outside / c.soft_px, 0.0, 1.0);
}

} // namespace

Background Background::sky() { return {205, 225, 6, 256, 3}; }

Background Background::cloud() { return {125, 115, 20, 192, 4}; }

Background Background::ground() { return {60, 50, 18, 48, 4}; }

double background_grey(const Scene &scene, int x_px, int y_px)
{
    const Background &b = scene.background;
    if (!b.plate.empty()) {
        return b.plate.at<float>(std::clamp(y_px, 0, b.plate.rows - 1), std::clamp(x_px, 0, b.plate.cols - 1));
    }
    const double down = static_cast<double>(y_px) / scene.image_px.height;
    double sum = 0;
    double weights = 0;
    for (int k = 0; k < b.octaves; k++) {
        const double size = b.texture_px / (1 << k);
        const double weight = 1.0 / (1 << k);
        const uint64_t seed = hash_at(scene.seed, stream_texture, k);
        sum += weight * value_noise(seed, x_px / size, y_px / size);
        weights += weight;
    }
    double grey = b.top_grey + (b.bottom_grey - b.top_grey) * down + (weights > 0 ? b.texture_grey * sum / weights : 0);
    if (b.ramp_per_px != cv::Point2d(0, 0)) {
        grey = std::clamp(grey + b.ramp_per_px.dot(cv::Point2d(x_px, y_px) - b.ramp_at_px), 0.0, 255.0);
    }
    for (const Clutter &c : b.clutter) {
        grey += cover(c, x_px, y_px) * (c.grey - grey);
    }
    return grey;
}

} // namespace accuracy
