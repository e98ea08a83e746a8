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
    double at, slope, level; /* px from the ellipse outwards; that of taps of 12 a level; grey on the sample nearest */
};

/* Peaks of the slopes along a ray by a derivative of Gaussian, with the parabola's vertex. */
std::vector<Edge> edges_along(const cv::Mat &image, const Ray &r, double step, int out, double least, bool either)
{
    const std::array<double, 9> taps = {-2, -3, -4, -3, 0, 3, 4, 3, 2};
    const auto grey = [&](int i) { return read(image, r.x + i * step * r.nx, r.y + i * step * r.ny, false); };
    const auto slope = [&](int i) {
        double sum = 0;
        for (int k = 0; k < 9; k++) {
            sum += taps[(std::size_t)k] * grey(i + k - 4);
        }
        return sum;
    };
    std::vector<Edge> edges;
    for (int i = 1 - out; i < out; i++) {
        for (const double sign : {1.0, -1.0}) {
            const double before = sign * slope(i - 1), at = sign * slope(i), after = sign * slope(i + 1);
            if ((sign > 0 || either) && at >= least && at > before && at >= after) {
                edges.push_back({(i + (after - before) / 2 / (2 * at - before - after)) * step, at, grey(i)});
            }
        }
    }
    return edges;
}

std::vector<Edge> edges_of(const drogue_ray &ray)
{
    std::vector<Edge> edges;
    for (std::uint32_t n = 0; n < ray.count; n++) {
        const drogue_ray_edge &e = ray.edges[n];
        edges.push_back({real(e.at_px_q16), e.slope_q8 / 256.0, e.level_q8 / 256.0});
    }
    return edges;
}

struct Reports {
    Report place{"rays_edge_place", 1200}, slope{"rays_edge_slope", 660}, level{"rays_edge_level", 100};
};

/* Of one list each edge steeper than so much has one in the other: whether others count is a matter of last bits. */
void compare(Reports &reports, const std::vector<Edge> &these, const std::vector<Edge> &those, double steep,
             double step, int number)
{
    for (const Edge &edge : these) {
        Edge nearest = {INFINITY, INFINITY, INFINITY};
        for (const Edge &other : those) {
            nearest = std::fabs(other.at - edge.at) < std::fabs(nearest.at - edge.at) ? other : nearest;
        }
        if (edge.slope > steep) {
            reports.place.add(std::fabs(nearest.at - edge.at) * 0x1p16, name_of("ring", number));
            reports.slope.add(std::fabs(nearest.slope - edge.slope) * 256, name_of("ring", number));
            const double steps = edge.at / step;
            if (std::fabs(steps - std::round(steps)) < 0.4) { /* else the next sample may be the highest */
                reports.level.add(std::fabs(nearest.level - edge.level) * 256, name_of("ring", number));
            }
        }
    }
}

bool edges()
{
    constexpr int REACH = 6, LEAST = 12;
    Reports reports;
    Report truth("rays_edge_truth", 0.2 * 65536);
    for (int i = 1; i <= 160; i++) {
        std::uint64_t rng = 0xED6Eu + (std::uint64_t)i;
        const auto look = static_cast<drogue_ray_look>(i % 4);
        const bool line = look == DROGUE_RAY_LINES || look == DROGUE_RAY_STEPS, fine = look >= DROGUE_RAY_FINE_RISES;
        const double step = fine ? 0.25 : 0.5, least = LEAST * DROGUE_RAY_WEIGHT * step;
        const cv::Point2d centre{rng_real(&rng, 70, 90), rng_real(&rng, 70, 90)}; /* in this order */
        const double radius = rng_real(&rng, 8, 50);
        const cv::Mat image = ring_of(&rng, centre, radius, line);
        const drogue_image view = view_of(image);
        const int every = i % 8 < 4 ? 1 : 2;
        drogue_ellipse e = {q16_of(centre.x + rng_real(&rng, -1, 1)), q16_of(centre.y + rng_real(&rng, -1, 1)), 0, 0,
                            q16_of(rng_real(&rng, -1.5, 1.5))};
        e.a_px_q16 = q16_of(radius + rng_real(&rng, 0, 1.5));
        e.b_px_q16 = q16_of(radius - rng_real(&rng, 0, 1.5));
        drogue_ray rays[DROGUE_RAYS];
        drogue_rays_cast(rays, &view, &e, DROGUE_Q16(REACH, 1), 4, every, LEAST, look);
        for (int k = 0; k < DROGUE_RAYS; k += every) {
            const Ray r = ray_of(e, 4, k);
            const std::vector<Edge> found = edges_of(rays[k]);
            const std::vector<Edge> wanted = edges_along(image, r, step, (int)(REACH / step) + 1, least, line);
            compare(reports, wanted, found, 1.25 * least, step, i);
            compare(reports, found, wanted, 1.25 * least, step, i);
            if (!line && found.size() == 1) { /* where the ring is: no reference of taps and peaks */
                const double x = r.x + found[0].at * r.nx, y = r.y + found[0].at * r.ny;
                truth.add(std::fabs(std::hypot(x - centre.x, y - centre.y) - radius) * 0x1p16, name_of("ring", i));
            }
        }
        for (int k = 1; every == 2 && k < DROGUE_RAYS; k += 2) {
            truth.add(rays[k].count == 0 ? 0 : INFINITY, name_of("ray without edges of ring", i));
        }
    }
    const bool ok[] = {reports.place.finish(14000), reports.slope.finish(14000), reports.level.finish(14000),
                       truth.finish(4000)};
    return ok[0] && ok[1] && ok[2] && ok[3];
}

} // namespace

int main()
{
    const bool ok[] = {places(), ramps(), edges()};
    return ok[0] && ok[1] && ok[2] ? EXIT_SUCCESS : EXIT_FAILURE;
}
