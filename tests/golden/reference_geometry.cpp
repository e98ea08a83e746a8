/* SPDX-License-Identifier: Apache-2.0 */
/* Reference of the stages on points and ellipses: rectangle, fit, quality, clusters. */
#include "reference.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "quad.h"

namespace reference {

namespace {

constexpr Real PI = 3.14159265358979323846264338327950288L;

/* Convex hull, clockwise as seen, from the first point in raster order. */
std::vector<cv::Point> hull_of(const std::vector<cv::Point> &pixels)
{
    std::vector<cv::Point> hull;
    cv::convexHull(pixels, hull);
    int64_t area = 0;
    for (size_t i = 0; i < hull.size(); i++) {
        area += hull[i].cross(hull[(i + 1) % hull.size()]);
    }
    if (area < 0) {
        std::reverse(hull.begin(), hull.end());
    }
    std::rotate(hull.begin(),
                std::min_element(hull.begin(), hull.end(),
                                 [](cv::Point p, cv::Point q) { return p.y != q.y ? p.y < q.y : p.x < q.x; }),
                hull.end());
    return hull;
}

/* Box around points with a side along d. All but the edge's length are exact; quad holds the area's products. */
struct Box {
    cv::Point d;
    int64_t length2, low[2], high[2];

    quad scaled_area() const { return static_cast<quad>(high[0] - low[0]) * (high[1] - low[1]); }
    Rect rect() const
    {
        const Real length = std::sqrt(static_cast<Real>(length2)), dx = d.x, dy = d.y;
        const Real along = (high[0] - low[0]) / length, across = (high[1] - low[1]) / length;
        const Real u = high[0] + low[0], v = high[1] + low[1];
        return {(dx * u - dy * v) / 2 / length2, (dy * u + dx * v) / 2 / length2, std::min(along, across),
                std::max(along, across)};
    }
};

Box box_along(const std::vector<cv::Point> &hull, cv::Point d)
{
    Box box = {d,
               static_cast<int64_t>(d.x) * d.x + static_cast<int64_t>(d.y) * d.y,
               {INT64_MAX, INT64_MAX},
               {INT64_MIN, INT64_MIN}};
    for (const cv::Point p : hull) {
        const int64_t at[2] = {static_cast<int64_t>(d.x) * p.x + static_cast<int64_t>(d.y) * p.y,
                               static_cast<int64_t>(d.x) * p.y - static_cast<int64_t>(d.y) * p.x};
        for (int k = 0; k < 2; k++) {
            box.low[k] = std::min(box.low[k], at[k]);
            box.high[k] = std::max(box.high[k], at[k]);
        }
    }
    return box;
}

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

/* Is a sum of squares no more than what rounding leaves of terms of the given size? */
bool vanishes(quad value, quad terms) { return value <= quad_scale(terms, -90); }

/* Quadratic part of the conic: the vector of M a = lambda K a with the positive lambda, K the matrix of 4ac - b^2.
 * M was reduced from terms of the given size. Points exactly on a conic: that one, if it is an ellipse. */
bool quadratic_part(quad out[3], const quad m[3][3], quad terms)
{
    quad value[3], vector[3][3], n[3][3], w[3][3];
    quad_eigen3(value, vector, m);
    if (vanishes(value[1], terms)) { /* more than one conic through the points */
        return false;
    }
    if (vanishes(value[2], terms)) {
        for (int i = 0; i < 3; i++) {
            out[i] = vector[2][i];
        }
        return 4 * out[0] * out[2] - out[1] * out[1] > quad_scale(1, -90);
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

/* Scatter of (x^2, xy, y^2, x, y, 1) about (mx, my). */
void scatter_of(quad s[6][6], const std::vector<cv::Point2d> &points, quad mx, quad my)
{
    for (const cv::Point2d &p : points) {
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
}

/* Conic a x^2 + b xy + c y^2 + d x + e y + f of the least algebraic error with 4ac - b^2 fixed. */
bool conic_of(quad theta[6], const quad s[6][6])
{
    quad linear[3][3], m[3][3], t[3], r[3];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            linear[i][j] = s[3 + i][3 + j];
        }
    }
    const quad trace = linear[0][0] + linear[1][1];
    if (!(trace > 0) || vanishes(linear[0][0] * linear[1][1] - linear[0][1] * linear[0][1], trace * trace)) {
        return false; /* on a line */
    }
    for (int i = 0; i < 3; i++) { /* M = S1 - S2 S3^-1 S2' */
        for (int j = 0; j < 3; j++) {
            r[j] = s[i][3 + j];
        }
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
    if (!quadratic_part(theta, m, s[0][0] + s[1][1] + s[2][2])) {
        return false;
    }
    for (int j = 0; j < 3; j++) {
        r[j] = -(theta[0] * s[0][3 + j] + theta[1] * s[1][3 + j] + theta[2] * s[2][3 + j]);
    }
    solve3(theta + 3, linear, r);
    if (theta[0] + theta[2] < 0) {
        for (int k = 0; k < 6; k++) {
            theta[k] = -theta[k];
        }
    }
    return true;
}

Ellipse ellipse_of_conic(const quad theta[6], quad mx, quad my)
{
    const quad a = theta[0], b = theta[1], c = theta[2], d = theta[3], e = theta[4], det = 4 * a * c - b * b;
    const quad x = (b * e - 2 * c * d) / det, y = (b * d - 2 * a * e) / det, f = -(theta[5] + (d * x + e * y) / 2);
    const quad larger = a + c + quad_sqrt((a - c) * (a - c) + b * b);
    Ellipse out = {static_cast<Real>(x + mx),
                   static_cast<Real>(y + my),
                   static_cast<Real>(quad_sqrt(2 * f * larger / det)),
                   static_cast<Real>(quad_sqrt(2 * f / larger)),
                   atan2l(static_cast<Real>(0 - b), static_cast<Real>(c - a)) / 2,
                   det > 0 && f > 0};
    out.ok = out.ok && in_q16(out.xc) && in_q16(out.yc) && in_q16(out.a) && in_q16(out.b) && q16(out.b) > 0;
    if (out.ok && q16(out.a) <= q16(out.b)) {
        out.angle = 0;
    } else if (out.ok && q16(out.angle) <= q16(-PI / 2)) {
        out.angle = PI / 2;
    }
    return out;
}

bool is_round(const Ellipse &e, Real ratio) { return e.b > ratio * e.a; }

} // namespace

Ellipse conic_ellipse(const std::array<Real, 6> &theta)
{
    quad q[6];
    std::copy(theta.begin(), theta.end(), q);
    return ellipse_of_conic(q, 0, 0);
}

bool in_q16(Real v)
{
    const Real r = std::floor(v * 65536 + 0.5L);
    return r >= INT32_MIN && r <= INT32_MAX;
}

int32_t q16(Real v)
{
    const Real r = std::floor(v * 65536 + 0.5L);
    return r >= INT32_MAX ? INT32_MAX : r <= INT32_MIN ? INT32_MIN : static_cast<int32_t>(r);
}

std::vector<Rect> min_area_rects(const std::vector<cv::Point> &pixels)
{
    const std::vector<cv::Point> hull = hull_of(pixels);
    std::vector<Box> best;
    for (size_t i = 0; i < hull.size(); i++) {
        const Box box = box_along(hull, hull[(i + 1) % hull.size()] - hull[i]);
        if (box.length2 == 0) {
            continue;
        }
        const quad own = best.empty() ? 0 : box.scaled_area() * best[0].length2;
        const quad least = best.empty() ? 0 : best[0].scaled_area() * box.length2;
        if (own < least) {
            best.clear();
        }
        if (best.empty() || own == least) {
            best.push_back(box);
        }
    }
    std::vector<Rect> rects;
    for (const Box &box : best) {
        rects.push_back(box.rect());
    }
    if (rects.empty()) { /* a single point */
        rects.push_back({static_cast<Real>(hull[0].x), static_cast<Real>(hull[0].y), 0, 0});
    }
    return rects;
}

Verdict judge_arc(const std::vector<cv::Point> &pixels, int centre2_x, int centre2_y, int direction,
                  int64_t min_short_q16)
{
    Verdict v = {min_area_rect(pixels), -1, 2, 0};
    const int64_t dx = q16(v.rect.xc) - static_cast<int64_t>(centre2_x) * 32768;
    const int64_t dy = q16(v.rect.yc) - static_cast<int64_t>(centre2_y) * 32768;
    v.distance2 = (static_cast<Real>(dx) * dx + static_cast<Real>(dy) * dy) / 4294967296.0L;
    if (dx != 0 && dy != 0 && q16(v.rect.shorter) >= min_short_q16) {
        const int quadrant = dy < 0 ? (dx > 0 ? 0 : 1) : (dx < 0 ? 2 : 3);
        const int turn = (quadrant - direction) & 3;
        v.quadrant = turn % 2 == 0 ? quadrant : -1;
        v.polarity = turn % 2 == 0 ? turn / 2 : 2;
    }
    return v;
}

Choices select_arcs(const std::vector<Verdict> &verdicts, const std::vector<int> &points, int polarity)
{
    Choices chosen;
    for (int q = 0; q < 4; q++) {
        std::vector<size_t> own;
        for (size_t i = 0; i < verdicts.size(); i++) {
            if (verdicts[i].quadrant == q && (polarity == 2 || verdicts[i].polarity == polarity)) {
                own.push_back(i);
            }
        }
        std::stable_sort(own.begin(), own.end(), [&](size_t i, size_t k) { return points[i] > points[k]; });
        own.resize(std::min<size_t>(own.size(), 4));
        size_t far = 0;
        for (size_t i = 1; i < own.size(); i++) {
            if (2 * points[own[i]] >= points[own[0]] && verdicts[own[i]].distance2 > verdicts[own[far]].distance2) {
                far = i;
            }
        }
        const size_t other = far == 0 ? 1 : 0;
        chosen[static_cast<size_t>(q)] = {far < own.size() ? static_cast<int>(own[far]) : -1,
                                          other < own.size() ? static_cast<int>(own[other]) : -1};
    }
    return chosen;
}

Ellipse fit(const std::vector<cv::Point2d> &points)
{
    quad mx = 0, my = 0, s[6][6] = {}, theta[6];
    const Ellipse none = {0, 0, 0, 0, 0, false};
    if (points.size() < 6) {
        return none;
    }
    for (const cv::Point2d &p : points) {
        mx += p.x;
        my += p.y;
    }
    mx /= static_cast<quad>(points.size());
    my /= static_cast<quad>(points.size());
    scatter_of(s, points, mx, my);
    if (!conic_of(theta, s)) {
        return none;
    }
    const Ellipse e = ellipse_of_conic(theta, mx, my);
    return e.ok ? e : none;
}

Real deviation(const Ellipse &e, Point p)
{
    const Real dx = p.x - e.xc, dy = p.y - e.yc, c = std::cos(e.angle), s = std::sin(e.angle);
    const Real u = (dx * c + dy * s) / e.a, v = (dy * c - dx * s) / e.b;
    return std::fabs(u * u + v * v - 1);
}

Real deviation_threshold(const Ellipse &e, Real error) { return 2 * error / e.a; }

Real circumference(const Ellipse &e) { return PI * (3 * (e.a + e.b) - std::sqrt((3 * e.a + e.b) * (e.a + 3 * e.b))); }

Quality quality_of_cover(const Ellipse &e, Real fit_ratio, Real cover, Real k1, Real k2)
{
    Quality q;
    q.fit_ratio = fit_ratio;
    q.length_ratio = cover;
    q.axis_ratio = e.b / e.a;
    const Real s = (q.axis_ratio - k2) / (1 - k2);
    q.score = q.length_ratio / 2 + (s > 0 ? ((s - 1) * std::exp(-k1 * s) + 1) / 2 : 0);
    q.reliability = (q.score + q.fit_ratio) / 2;
    return q;
}

Quality quality(const Ellipse &e, int near_count, int total, Real k1, Real k2)
{
    return quality_of_cover(e, static_cast<Real>(near_count) / total, std::min<Real>(1, total / circumference(e)), k1,
                            k2);
}

bool same_ellipse(const Candidate &i, const Candidate &j, const ClusterConfig &config)
{
    const Ellipse &p = i.ellipse, &q = j.ellipse;
    const Real dx = p.xc - q.xc, dy = p.yc - q.yc;
    if (i.polarity != j.polarity || !(dx * dx + dy * dy < config.centre * config.centre) ||
        !(std::fabs(p.a - q.a) < config.a) || !(std::fabs(p.b - q.b) < config.b)) {
        return false;
    }
    return (is_round(p, config.round) && is_round(q, config.round)) ||
           std::fabs(std::remainder(p.angle - q.angle, PI)) < config.angle;
}

int cluster_best(const std::vector<Candidate> &candidates, const ClusterConfig &config, int &members)
{
    int best = -1;
    members = 0;
    for (size_t i = 0; i < candidates.size(); i++) {
        int like = 0;
        for (size_t j = 0; j < candidates.size(); j++) {
            like += j == i || same_ellipse(candidates[i], candidates[j], config);
        }
        const Real most = best < 0 ? 0 : candidates[static_cast<size_t>(best)].reliability;
        if (best < 0 || candidates[i].reliability > most || (candidates[i].reliability == most && like > members)) {
            best = static_cast<int>(i);
            members = like;
        }
    }
    return best;
}

} // namespace reference
