/* SPDX-License-Identifier: Apache-2.0 */
/* Ellipse fit against the same direct method in quadruple precision on the same points, and against OpenCV's. */
#include <opencv2/imgproc.hpp>

#include "geometry.h"
#include "golden.hpp"
#include "reference.hpp"

#include "drogue/ellipse.h"

namespace {

struct Point {
    std::int32_t x, y; /* units of 2^-frac_bits px */
};

struct Case {
    ellipse_real truth;
    double from, span, noise;
    std::vector<Point> points;
    int frac_bits;
};

/* An arc of at least 90 degrees with points a pixel apart, in Q5 about an origin within the region. */
Case random_case(int seed)
{
    std::uint64_t rng = 0xE111u + (std::uint64_t)seed;
    Case c;
    c.truth.a = std::exp(rng_real(&rng, std::log(8.0), std::log(900.0)));
    c.truth.b = std::max(8.0, c.truth.a * rng_real(&rng, 0.3, 1));
    c.truth.a = std::max(c.truth.a, c.truth.b);
    c.truth.angle = rng_real(&rng, -TEST_PI / 2, TEST_PI / 2);
    c.frac_bits = 5;
    const double room = 1020 - c.truth.a;
    c.truth.xc = rng_real(&rng, -room, room);
    c.truth.yc = rng_real(&rng, -room, room);
    c.from = rng_real(&rng, 0, 2 * TEST_PI);
    c.span = seed % 3 == 0 ? TEST_PI / 2 : rng_real(&rng, TEST_PI / 2, 2 * TEST_PI);
    c.noise = seed % 4 == 0 ? 0 : rng_real(&rng, 0, 1);
    const int count = std::max(12, (int)(c.span * (c.truth.a + c.truth.b) / 2));
    for (int i = 0; i < count; i++) {
        double x, y;
        ellipse_point(&x, &y, &c.truth, c.from + c.span * i / count);
        x = std::floor((x + c.noise * rng_normal(&rng)) * 32 + 0.5);
        y = std::floor((y + c.noise * rng_normal(&rng)) * 32 + 0.5);
        c.points.push_back(
            {(std::int32_t)std::clamp(x, -32768.0, 32767.0), (std::int32_t)std::clamp(y, -32768.0, 32767.0)});
    }
    return c;
}

struct Difference {
    bool comparable;
    double lsb, angle_lsb;
    bool round;
};

Difference compare(const std::vector<Point> &points, int frac_bits)
{
    drogue_moments moments;
    drogue_ellipse got;
    drogue_moments_clear(&moments);
    for (const Point &p : points) {
        drogue_moments_add_point(&moments, p.x, p.y);
    }
    std::vector<cv::Point2d> points_px;
    for (const Point &p : points) {
        points_px.emplace_back(std::ldexp(p.x, -frac_bits), std::ldexp(p.y, -frac_bits));
    }
    const reference::Ellipse r = reference::fit(points_px);
    const bool accepted = drogue_ellipse_fit(&got, &moments, frac_bits) == DROGUE_OK;
    if (accepted != r.ok) {
        return {true, INFINITY, INFINITY, false};
    }
    if (!r.ok) {
        return {false, 0, 0, false};
    }
    const double lsb = std::max(std::max(lsb_from(got.xc_px_q16, r.xc), lsb_from(got.yc_px_q16, r.yc)),
                                std::max(lsb_from(got.a_px_q16, r.a), lsb_from(got.b_px_q16, r.b)));
    const double turn =
        std::fabs(angle_difference((double)got.angle_rad_q16 / 65536, (double)r.angle, TEST_PI)) * 65536;
    return {true, lsb, std::floor(turn + 0.5), r.b > 0.995L * r.a};
}

/* A few points known to lie on an ellipse, and near circles with many points. */
std::vector<Point> near_circle(int seed)
{
    std::uint64_t rng = 0xC1C1u + (std::uint64_t)seed;
    std::vector<Point> points;
    const double radius = rng_real(&rng, 20, 900), noise = seed % 2 ? 0.02 : 0, cx = rng_real(&rng, -100, 100);
    for (int i = 0; i < 20000; i++) {
        const double t = rng_real(&rng, 0, 2 * TEST_PI);
        points.push_back({(std::int32_t)std::lround(32 * (cx + radius * std::cos(t) + noise * rng_normal(&rng))),
                          (std::int32_t)std::lround(32 * (radius * std::sin(t) + noise * rng_normal(&rng)))});
    }
    return points;
}

/* OpenCV fits in float or double without centring as carefully: agreement in pixels. */
double opencv_difference(const Case &c)
{
    std::vector<cv::Point2f> points;
    drogue_moments moments;
    drogue_ellipse got;
    drogue_moments_clear(&moments);
    for (const Point &p : c.points) {
        points.emplace_back((float)p.x / 32, (float)p.y / 32);
        drogue_moments_add_point(&moments, p.x, p.y);
    }
    if (drogue_ellipse_fit(&got, &moments, 5) != DROGUE_OK) {
        return INFINITY;
    }
    const cv::RotatedRect r = cv::fitEllipseDirect(points);
    const ellipse_real e = ellipse_from_q16(&got);
    return std::max(std::max(std::fabs(e.xc - r.center.x), std::fabs(e.yc - r.center.y)),
                    std::max(std::fabs(2 * e.a - std::max(r.size.width, r.size.height)),
                             std::fabs(2 * e.b - std::min(r.size.width, r.size.height))) /
                        2);
}

} // namespace

int main()
{
    Report arcs("ellipse", 1), quarter("ellipse_90_degrees", 4), angles("ellipse_angle", 1),
        circles("ellipse_near_circle", 1);
    Report opencv("ellipse_opencv_px", 0.5);
    for (int seed = 1; seed <= 3000; seed++) {
        const Case c = random_case(seed);
        const Difference d = compare(c.points, c.frac_bits);
        const std::string name = name_of("seed", seed);
        if (d.comparable) {
            (seed % 3 == 0 ? quarter : arcs).add(d.lsb, name);
            if (!d.round) {
                angles.add(d.angle_lsb, name);
            }
        }
        if (c.span > 4 && c.noise < 0.3 && c.truth.a > 20) {
            opencv.add(opencv_difference(c), name);
        }
    }
    for (int seed = 1; seed <= 20; seed++) {
        const Difference d = compare(near_circle(seed), 5);
        circles.add(d.comparable ? d.lsb : INFINITY, name_of("circle", seed));
    }
    const bool ok[] = {arcs.finish(1900), quarter.finish(900), angles.finish(2500), circles.finish(20),
                       opencv.finish(200)};
    return std::all_of(std::begin(ok), std::end(ok), [](bool v) { return v; }) ? EXIT_SUCCESS : EXIT_FAILURE;
}
