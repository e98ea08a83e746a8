/* SPDX-License-Identifier: Apache-2.0 */
/* Ellipse fit against the same direct method in quadruple precision on the same points, and against OpenCV's. */
#include <opencv2/imgproc.hpp>

#include "geometry.h"
#include "golden.hpp"
#include "quad.h"

#include "drogue/ellipse.h"

namespace {

struct Point {
    std::int32_t x, y; /* units of 2^-frac_bits px */
};

struct Reference {
    bool ok;
    long double xc, yc, a, b, angle; /* units of the points */
};

/* Solves s x = r for a symmetric positive 3x3 s. */
void solve3(quad x[3], const quad s[3][3], const quad r[3])
{
    quad m[3][4];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            m[i][j] = s[i][j];
        }
        m[i][3] = r[i];
    }
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++) {
            if (i != k) {
                const quad f = m[i][k] / m[k][k];
                for (int j = k; j < 4; j++) {
                    m[i][j] -= f * m[k][j];
                }
            }
        }
    }
    for (int i = 0; i < 3; i++) {
        x[i] = m[i][3] / m[i][i];
    }
}

/* Quadratic part of the conic: the vector of M a = lambda K a with the positive lambda, K the matrix of 4ac - b^2. */
bool quadratic_part(quad out[3], const quad m[3][3])
{
    quad value[3], vector[3][3], n[3][3], w[3][3];
    quad_eigen3(value, vector, m);
    if (value[2] <= quad_scale(value[0], -90)) { /* points exactly on a conic */
        for (int i = 0; i < 3; i++) {
            out[i] = vector[2][i];
        }
        return 4 * out[0] * out[2] - out[1] * out[1] > 0;
    }
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++) {
            w[k][i] = vector[k][i] / quad_sqrt(value[k]);
        }
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            n[i][j] = 2 * (w[i][0] * w[j][2] + w[i][2] * w[j][0]) - w[i][1] * w[j][1];
        }
    }
    quad_eigen3(value, vector, n);
    for (int i = 0; i < 3; i++) {
        out[i] = vector[0][0] * w[0][i] + vector[0][1] * w[1][i] + vector[0][2] * w[2][i];
    }
    return value[0] > 0;
}

Reference reference_fit(const std::vector<Point> &points)
{
    quad mx = 0, my = 0, s[6][6] = {}, linear[3][3], m[3][3], theta[6], t[3];
    for (const Point &p : points) {
        mx += p.x;
        my += p.y;
    }
    mx /= (quad)points.size();
    my /= (quad)points.size();
    for (const Point &p : points) {
        const quad x = p.x - mx, y = p.y - my, row[6] = {x * x, x * y, y * y, x, y, 1};
        for (int i = 0; i < 6; i++) {
            for (int j = 0; j <= i; j++) {
                s[i][j] += row[i] * row[j];
            }
        }
    }
    for (int i = 0; i < 6; i++) {
        for (int j = i + 1; j < 6; j++) {
            s[i][j] = s[j][i];
        }
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            linear[i][j] = s[3 + i][3 + j];
        }
    }
    for (int i = 0; i < 3; i++) { /* M = S1 - S2 S3^-1 S2' */
        const quad r[3] = {s[i][3], s[i][4], s[i][5]};
        solve3(t, linear, r);
        for (int j = 0; j < 3; j++) {
            m[i][j] = s[i][j] - t[0] * s[j][3] - t[1] * s[j][4] - t[2] * s[j][5];
        }
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < i; j++) {
            m[i][j] = m[j][i] = (m[i][j] + m[j][i]) / 2;
        }
    }
    if (!quadratic_part(theta, m)) {
        return {false, 0, 0, 0, 0, 0};
    }
    quad r[3];
    for (int j = 0; j < 3; j++) {
        r[j] = -(theta[0] * s[0][3 + j] + theta[1] * s[1][3 + j] + theta[2] * s[2][3 + j]);
    }
    solve3(theta + 3, linear, r);
    if (theta[0] + theta[2] < 0) {
        for (quad &v : theta) {
            v = -v;
        }
    }
    const quad a = theta[0], b = theta[1], c = theta[2], d = theta[3], e = theta[4], det = 4 * a * c - b * b;
    const quad x = (b * e - 2 * c * d) / det, y = (b * d - 2 * a * e) / det, f = -(theta[5] + (d * x + e * y) / 2);
    const quad larger = a + c + quad_sqrt((a - c) * (a - c) + b * b);
    if (!(det > 0) || !(f > 0)) {
        return {false, 0, 0, 0, 0, 0};
    }
    return {true,
            (long double)(x + mx),
            (long double)(y + my),
            (long double)quad_sqrt(2 * f * larger / det),
            (long double)quad_sqrt(2 * f / larger),
            atan2l((long double)-b, (long double)(c - a)) / 2};
}

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
    const Reference r = reference_fit(points);
    const long double unit = std::ldexp(1.0L, -frac_bits);
    const bool fits = r.ok && std::max({std::fabs(r.xc), std::fabs(r.yc), r.a}) * unit < 32767.9L;
    const bool accepted = drogue_ellipse_fit(&got, &moments, frac_bits) == DROGUE_OK;
    if (accepted != fits) {
        return {true, INFINITY, INFINITY, false};
    }
    if (!fits) {
        return {false, 0, 0, false};
    }
    const double lsb = std::max(std::max(lsb_from(got.xc_px_q16, r.xc * unit), lsb_from(got.yc_px_q16, r.yc * unit)),
                                std::max(lsb_from(got.a_px_q16, r.a * unit), lsb_from(got.b_px_q16, r.b * unit)));
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
    Report arcs("ellipse", 1), quarter("ellipse_90_degrees", 1), angles("ellipse_angle", 1),
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
