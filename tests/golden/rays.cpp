/* SPDX-License-Identifier: Apache-2.0 */
/* Rays across an ellipse against floating point: where they lie, what they read, and where on them the grey rises. */
#include <array>
#include <cmath>

#include "geometry.h"
#include "golden.hpp"

#include "drogue/rays.h"

namespace {

constexpr double PI = 3.14159265358979323846;

double real(drogue_q16 q16) { return q16 * 0x1p-16; }

/* A place, and the direction outwards. */
struct Ray {
    double x, y, nx, ny;
};

Ray ray_of(const drogue_ellipse &e, int phase, int k)
{
    const double t = (8 * k + phase) * 2 * PI / (8 * DROGUE_RAYS), angle = real(e.angle_rad_q16);
    const double a = real(e.a_px_q16), b = real(e.b_px_q16), c = std::cos(angle), s = std::sin(angle);
    const double u = a * std::cos(t), v = b * std::sin(t), nu = b * std::cos(t), nv = a * std::sin(t);
    const double n = std::hypot(nu, nv);
    return {real(e.xc_px_q16) + c * u - s * v, real(e.yc_px_q16) + s * u + c * v, (c * nu - s * nv) / n,
            (s * nu + c * nv) / n};
}

double light_of(double level)
{
    const double v = level / 255;
    return 255 * (v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
}

/* Between the four pixels about a place; beyond the image as at its border. */
double read(const cv::Mat &image, double x, double y, bool light)
{
    x = std::clamp<double>(x, 0, image.cols - 1);
    y = std::clamp<double>(y, 0, image.rows - 1);
    const int left = std::min((int)x, image.cols - 1), top = std::min((int)y, image.rows - 1);
    const int right = std::min(left + 1, image.cols - 1), bottom = std::min(top + 1, image.rows - 1);
    const auto at = [&](int row, int column) {
        const double level = image.at<std::uint8_t>(row, column);
        return light ? light_of(level) : level;
    };
    const double upper = at(top, left) + (x - left) * (at(top, right) - at(top, left));
    const double lower = at(bottom, left) + (x - left) * (at(bottom, right) - at(bottom, left));
    return upper + (y - top) * (lower - upper);
}

drogue_ellipse random_ellipse(std::uint64_t *rng, double least, double most, double side)
{
    const double a = least * std::pow(most / least, rng_real(rng, 0, 1));
    drogue_ellipse e;
    e.xc_px_q16 = q16_of(rng_real(rng, 0.3 * side, 0.7 * side));
    e.yc_px_q16 = q16_of(rng_real(rng, 0.3 * side, 0.7 * side));
    e.a_px_q16 = q16_of(a);
    e.b_px_q16 = q16_of(std::max(1.0, a * rng_real(rng, 0.3, 1)));
    e.angle_rad_q16 = q16_of(rng_real(rng, -PI / 2, PI / 2));
    return e;
}

drogue_image view_of(const cv::Mat &image)
{
    return {image.data, image.cols, image.rows, static_cast<std::int32_t>(image.step)};
}

bool places()
{
    Report place("rays_place", 2.5), normal("rays_normal", 1.25);
    for (int i = 1; i <= 500; i++) {
        std::uint64_t rng = 0x4A75u + (std::uint64_t)i;
        const drogue_ellipse e = random_ellipse(&rng, 2, 1000, 2048);
        const int phase = rng_range(&rng, 0, 7);
        drogue_ray rays[DROGUE_RAYS];
        drogue_rays_aim(rays, &e, phase, 0, DROGUE_RAYS / 2);
        for (int k = 0; k < DROGUE_RAYS; k++) {
            const Ray r = ray_of(e, phase, k);
            place.add(std::max(std::fabs(rays[k].x_px_q16 - r.x * 0x1p16), std::fabs(rays[k].y_px_q16 - r.y * 0x1p16)),
                      name_of("ellipse", i));
            normal.add(std::max(std::fabs(rays[k].nx_q14 - r.nx * 0x1p14), std::fabs(rays[k].ny_q14 - r.ny * 0x1p14)),
                       name_of("ellipse", i));
        }
    }
    const bool ok[] = {place.finish(32000), normal.finish(32000)};
    return ok[0] && ok[1];
}

/* Ramps of a level a pixel: what is read is where. A place is cut to 1/256 px, a level rounded to that. */
bool ramps()
{
    Report across("rays_read_x", 1.25), down("rays_read_y", 1.25), light("rays_read_light", 3.25);
    cv::Mat x(256, 256, CV_8U), y(256, 256, CV_8U);
    for (int k = 0; k < 256; k++) {
        x.col(k) = k;
        y.row(k) = k;
    }
    const drogue_image view_x = view_of(x), view_y = view_of(y);
    for (int i = 1; i <= 200; i++) {
        std::uint64_t rng = 0x4EADu + (std::uint64_t)i;
        const drogue_ellipse e = random_ellipse(&rng, 2, 160, 256); /* some beyond the border */
        const double from = rng_real(&rng, -8, 2);
        drogue_ray rays[DROGUE_RAYS];
        drogue_rays_aim(rays, &e, 4, 0, DROGUE_RAYS / 2);
        for (int k = 0; k < DROGUE_RAYS; k++) {
            enum { COUNT = 20 };
            const Ray r = ray_of(e, 4, k);
            std::array<std::int32_t, COUNT> gx = {}, gy = {}, lx = {};
            drogue_ray_read(gx.data(), &rays[k], &view_x, q16_of(from), COUNT);
            drogue_ray_read(gy.data(), &rays[k], &view_y, q16_of(from), COUNT);
            drogue_ray_read_light(lx.data(), &rays[k], &view_x, q16_of(from), COUNT);
            for (std::size_t s = 0; s < COUNT; s++) {
                const double way = from + 0.5 * (double)s, px = r.x + way * r.nx, py = r.y + way * r.ny;
                across.add(std::fabs(gx[s] - 256 * read(x, px, py, false)), name_of("ellipse", i));
                down.add(std::fabs(gy[s] - 256 * read(y, px, py, false)), name_of("ellipse", i));
                light.add(std::fabs(lx[s] - 256 * read(x, px, py, true)), name_of("ellipse", i));
            }
        }
    }
    const bool ok[] = {across.finish(200000), down.finish(200000), light.finish(200000)};
    return ok[0] && ok[1] && ok[2];
}

/* Round edges that rise outwards, or to either side of a line, and noise. */
cv::Mat ring_of(std::uint64_t *rng, const cv::Point2d &centre, double radius, bool line)
{
    cv::Mat image(160, 160, CV_8U);
    const double blur = rng_real(rng, 0.7, 1.5), wide = rng_real(rng, 3, 4);
    for (int y = 0; y < image.rows; y++) {
        for (int x = 0; x < image.cols; x++) {
            const double d = std::hypot(x - centre.x, y - centre.y) - radius;
            const double rise = std::erf(d / blur / std::sqrt(2.0)),
                         fall = std::erf((d - wide) / blur / std::sqrt(2.0));
            const double grey = 110 + 70 * rise - (line ? 60 * (1 + fall) : 0) + rng_real(rng, -1, 1);
            image.at<std::uint8_t>(y, x) = (std::uint8_t)std::lround(grey);
        }
    }
    return image;
}

struct Edge {
    double at, slope;
};

/* Peaks of the slopes along a ray by a derivative of Gaussian, with the parabola's vertex. */
std::vector<Edge> edges_along(const cv::Mat &image, const Ray &r, double step, int out, double least, bool either)
{
    const std::array<double, 9> taps = {-2, -3, -4, -3, 0, 3, 4, 3, 2};
    const auto slope = [&](int i) {
        double sum = 0;
        for (int k = 0; k < 9; k++) {
            const double way = (i + k - 4) * step;
            sum += taps[(std::size_t)k] * read(image, r.x + way * r.nx, r.y + way * r.ny, false);
        }
        return sum;
    };
    std::vector<Edge> edges;
    for (int i = 1 - out; i < out; i++) {
        for (const double sign : {1.0, -1.0}) {
            const double before = sign * slope(i - 1), at = sign * slope(i), after = sign * slope(i + 1);
            if ((sign > 0 || either) && at >= least && at > before && at >= after) {
                edges.push_back({(i + (after - before) / 2 / (2 * at - before - after)) * step, at});
            }
        }
    }
    return edges;
}

/* Steps that are steeper than the least one by a quarter: whether others count is a matter of last bits. */
bool edges()
{
    constexpr int REACH = 6, LEAST = 12;
    Report place("rays_edge_place", 1000), steep("rays_edge_slope", 620);
    for (int i = 1; i <= 120; i++) {
        std::uint64_t rng = 0xED6Eu + (std::uint64_t)i;
        const drogue_ray_look look = i % 2 != 0 ? DROGUE_RAY_RISES : DROGUE_RAY_LINES;
        const double step = look == DROGUE_RAY_LINES ? 0.25 : 0.5;
        const cv::Point2d centre(rng_real(&rng, 70, 90), rng_real(&rng, 70, 90));
        const double radius = rng_real(&rng, 8, 50);
        const cv::Mat image = ring_of(&rng, centre, radius, look == DROGUE_RAY_LINES);
        const drogue_image view = view_of(image);
        drogue_ellipse e = {q16_of(centre.x + rng_real(&rng, -1, 1)), q16_of(centre.y + rng_real(&rng, -1, 1)), 0, 0,
                            q16_of(rng_real(&rng, -1.5, 1.5))};
        e.a_px_q16 = q16_of(radius + rng_real(&rng, 0, 1.5));
        e.b_px_q16 = q16_of(radius - rng_real(&rng, 0, 1.5));
        drogue_ray rays[DROGUE_RAYS];
        drogue_rays_cast(rays, &view, &e, DROGUE_Q16(REACH, 1), 4, 1, LEAST, look);
        for (int k = 0; k < DROGUE_RAYS; k++) {
            const double least = LEAST * DROGUE_RAY_WEIGHT * step;
            for (const Edge &edge :
                 edges_along(image, ray_of(e, 4, k), step, (int)(REACH / step) + 1, least, look == DROGUE_RAY_LINES)) {
                double off = INFINITY, slope_off = INFINITY;
                for (std::uint32_t n = 0; n < rays[k].count; n++) {
                    const drogue_ray_edge &found = rays[k].edges[n];
                    if (std::fabs(real(found.at_px_q16) - edge.at) * 0x1p16 < off) {
                        off = std::fabs(real(found.at_px_q16) - edge.at) * 0x1p16;
                        slope_off = std::fabs(found.slope_q8 - 256 * edge.slope);
                    }
                }
                if (edge.slope > 1.25 * least) {
                    place.add(off, name_of("ring", i));
                    steep.add(slope_off, name_of("ring", i));
                }
            }
        }
    }
    const bool ok[] = {place.finish(7000), steep.finish(7000)};
    return ok[0] && ok[1];
}

} // namespace

int main()
{
    const bool ok[] = {places(), ramps(), edges()};
    return ok[0] && ok[1] && ok[2] ? EXIT_SUCCESS : EXIT_FAILURE;
}
