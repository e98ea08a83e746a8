/* SPDX-License-Identifier: Apache-2.0 */
/* The reference tier: every stage in floating point or by OpenCV, each value rounded once, with what it may differ. */
#include <algorithm>
#include <cmath>
#include <map>

#include "case.hpp"
#include "reference.hpp"
#include "stages.h"
#include "tiers.hpp"

#include "drogue/drogue.h"

namespace vectors {

namespace {

using reference::q16;
using reference::Real;
using Words = std::vector<int64_t>;

Array image_like(const Array &exact, const cv::Mat &image)
{
    Array a = image_array(exact.name, image);
    a.q = exact.q;
    return a;
}

Tiers smooth_tier(const Arrays &in, const Arrays &exact)
{
    return {{image_like(exact[0], reference::smooth(image_of(in[0]))), {}}};
}

Tiers gradient_tier(const Arrays &in, const Arrays &exact)
{
    cv::Mat g[2];
    Tiers tiers;
    reference::gradient(image_of(in[0]), g[0], g[1]);
    for (size_t k = 0; k < 2; k++) {
        Words words;
        for (int y = 0; y < g[k].rows; y++) {
            for (int x = 0; x < g[k].cols; x++) {
                words.push_back(g[k].at<int16_t>(y, x));
            }
        }
        tiers.push_back({like(exact[k], words), {}});
    }
    return tiers;
}

cv::Mat canny(const Array &image, const Array &params)
{
    return reference::canny(image_of(image), static_cast<int>(params.words[0]), static_cast<int>(params.words[1]),
                            params.words[2] != 0);
}

Tiers canny_tier(const Arrays &in, const Arrays &exact) { return {{image_like(exact[0], canny(in[0], in[1])), {}}}; }

/* centre2_x centre2_y longest */
bool valid_mask(const int64_t *p)
{
    return p[2] >= 1 && p[2] <= 1 << 20 && std::abs(p[0]) <= 1 << 15 && std::abs(p[1]) <= 1 << 15;
}

Tiers mask_tier(const Arrays &in, const Arrays &exact)
{
    const Words &p = in[0].words;
    const cv::Mat ring = reference::ring(as_int(p[0]), as_int(p[1]), as_int(p[2]), as_int(p[3]), as_int(p[4]));
    return {{image_like(exact[0], ring), {}}};
}

/* Across the edge, the vertex of the parabola through the L1 magnitudes of a pixel and its two neighbours, Q5. */
class Offsets {
public:
    Offsets(const cv::Mat &gx, const cv::Mat &gy) : gx_(gx), gy_(gy) {}
    void put(Words &words, int x, int y) const
    {
        const int gx = gx_.at<int16_t>(y, x), gy = gy_.at<int16_t>(y, x), ax = std::abs(gx), ay = std::abs(gy);
        const int64_t tan22 = int64_t{13573} * ax, tan67 = tan22 + (int64_t{ax} << 16); /* as cv::Canny's, Q15 */
        int step_x = (gx ^ gy) < 0 ? -1 : 1, step_y = 1;
        if (int64_t{ay} << 15 < tan22) {
            step_x = 1;
            step_y = 0;
        } else if (int64_t{ay} << 15 > tan67) {
            step_x = 0;
        }
        const Real before = magnitude(x - step_x, y - step_y), at = magnitude(x, y),
                   after = magnitude(x + step_x, y + step_y), curvature = 2 * at - before - after;
        const Real offset = curvature > 0 ? std::floor(16 * (after - before) / curvature + 0.5L) : 0;
        const int q5 = static_cast<int>(std::clamp<Real>(offset, -15, 15));
        words.insert(words.end(), {32 * x + step_x * q5, 32 * y + step_y * q5, gx, gy});
    }

private:
    Real magnitude(int x, int y) const
    {
        return x < 0 || y < 0 || x >= gx_.cols || y >= gx_.rows
                   ? 0
                   : std::abs(gx_.at<int16_t>(y, x)) + std::abs(gy_.at<int16_t>(y, x));
    }
    const cv::Mat &gx_, &gy_;
};

Tiers arcs_tier(const Arrays &in, const Arrays &exact)
{
    const Words &p = in[1].words;
    const cv::Mat image = image_of(in[0]);
    if (p[0] < 0 || p[1] < p[0] || (p[3] != 0 && !valid_mask(&p[4]))) {
        return {{like(exact[0], {DROGUE_E_ARGUMENT, 0, 0}), {}}, {like(exact[1], {}), {}}};
    }
    const cv::Mat mask = p[3] != 0 ? reference::ring(image.cols, image.rows, as_int(p[4]), as_int(p[5]), as_int(p[6]))
                                   : cv::Mat(image.size(), CV_8U, cv::Scalar(255));
    const cv::Mat candidates = reference::canny(image, as_int(p[0]), as_int(p[0]), p[2] != 0) & mask;
    const cv::Mat edges =
        p[3] != 0 ? reference::canny_within(image, as_int(p[0]), as_int(p[1]), p[2] != 0, mask) : canny(in[0], in[1]);
    cv::Mat gx, gy;
    reference::gradient(p[2] != 0 ? reference::smooth(image) : image, gx, gy);
    const std::vector<reference::Arc> arcs = reference::arcs(edges, gx, gy);
    std::map<std::pair<int, int>, int> rest_class;
    Words points;
    int64_t count = 0;
    for (const reference::Arc &a : arcs) {
        const bool long_enough = static_cast<int64_t>(a.pixels.size()) >= p[7];
        for (const cv::Point &q : a.pixels) {
            if (long_enough) {
                points.insert(points.end(), {q.x, q.y, a.direction, count});
            } else {
                rest_class[{q.y, q.x}] = a.direction;
            }
        }
        count += long_enough ? 1 : 0;
    }
    for (const auto &q : rest_class) {
        points.insert(points.end(), {q.first.second, q.first.first, q.second, -1});
    }
    Words words = {DROGUE_OK, static_cast<int64_t>(points.size() / 4), count};
    words.insert(words.end(), points.begin(), points.end());
    if (reference::arcs(candidates, gx, gy).size() >= CONF_MAX_LABELS) { /* provisional labels are no fewer */
        words = {DROGUE_E_LABELS_FULL, 0, 0};
    } else if (cv::countNonZero(candidates) > CONF_MAX_EDGES) {
        words = {DROGUE_E_EDGES_FULL, 0, 0};
    } else if (count > CONF_MAX_ARCS) {
        words = {DROGUE_E_ARCS_FULL, 0, 0};
    }
    const Offsets offsets(gx, gy);
    Words places;
    for (size_t i = 3; i < words.size(); i += 4) {
        offsets.put(places, as_int(words[i]), as_int(words[i + 1]));
    }
    return {{like(exact[0], words), {}}, {like(exact[1], places), {}}};
}

Tiers constraints_tier(const Arrays &in, const Arrays &exact)
{
    const Words &p = in[1].words;
    std::vector<cv::Point> points;
    for (size_t i = 0; i < in[0].words.size(); i += 2) {
        points.emplace_back(as_int(in[0].words[i]), as_int(in[0].words[i + 1]));
    }
    const reference::Verdict v = reference::judge_arc(points, as_int(p[0]), as_int(p[1]), as_int(p[3]), p[4]);
    const Array verdict = like(
        exact[0], {q16(v.rect.xc), q16(v.rect.yc), q16(v.rect.shorter), q16(v.rect.longer), v.quadrant, v.polarity});
    const Array distance2 = like(exact[1], {rounded(v.distance2, 32)});
    /* the library's is that of the rounded centre */
    const Real each = std::fabs(v.rect.xc - p[0] / 2.0L) + std::fabs(v.rect.yc - p[1] / 2.0L);
    return {{verdict, bounds("constraints", verdict)},
            {distance2, bounds("constraints", distance2, {std::max<Real>(0, 0x1p17L * each - 0x1p20L)})}};
}

Tiers ellipse_tier(const Arrays &in, const Arrays &exact)
{
    const int64_t frac = in[1].words[0];
    const size_t count = in[0].words.size() / 2;
    std::vector<cv::Point2d> points;
    if (frac < 0 || frac > 15) {
        return {{like(exact[0], {DROGUE_E_ARGUMENT, 0, 0, 0, 0, 0}), {}}};
    }
    if (count < 6) {
        return {{like(exact[0], {DROGUE_E_TOO_FEW_POINTS, 0, 0, 0, 0, 0}), {}}};
    }
    for (size_t i = 0; i < count; i++) {
        points.emplace_back(std::ldexp(static_cast<double>(in[0].words[2 * i]), -as_int(frac)),
                            std::ldexp(static_cast<double>(in[0].words[2 * i + 1]), -as_int(frac)));
    }
    const reference::Ellipse e = reference::fit(points);
    if (!e.ok) {
        return {{like(exact[0], {DROGUE_E_DEGENERATE, 0, 0, 0, 0, 0}), {}}};
    }
    const Array ellipse = like(exact[0], {DROGUE_OK, q16(e.xc), q16(e.yc), q16(e.a), q16(e.b), q16(e.angle)});
    const Real flat = e.a > 8 * e.b ? 4 : 0; /* the minor axis takes the last bits of the major one's */
    return {{ellipse, bounds("ellipse", ellipse, {0, flat, flat, flat, flat, angle_turn(e.a, e.b, 4)})}};
}

reference::Ellipse ellipse_of(const Words &w)
{
    return {real(w[0]), real(w[1]), real(w[2]), real(w[3]), real(w[4]), true};
}

/* The deviation of (10) with the coordinates in units of the semi-axes saturated as drogue/quality.h says. */
Real saturated_deviation(const reference::Ellipse &e, reference::Point p)
{
    const Real dx = p.x - e.xc, dy = p.y - e.yc, c = std::cos(e.angle), s = std::sin(e.angle);
    const Real u = std::clamp<Real>((dx * c + dy * s) / e.a, -16, 16),
               v = std::clamp<Real>((dy * c - dx * s) / e.b, -16, 16);
    return std::max(std::fabs(dx), std::fabs(dy)) < 15 * e.b ? reference::deviation(e, p)
                                                             : std::fabs(u * u + v * v - 1);
}

Tiers quality_tier(const Arrays &in, const Arrays &exact)
{
    const reference::Ellipse e = ellipse_of(in[0].words);
    const Words &points = in[1].words;
    const Words &p = in[2].words;
    const int total = static_cast<int>(points.size() / 2);
    const bool ok = e.b >= 1 && e.a >= e.b;
    const int64_t threshold = q16(reference::deviation_threshold(e, real(p[0])));
    int near_count = 0;
    Words words = {threshold, q16(reference::circumference(e))};
    std::vector<Real> more(2, 0);
    if (!(e.a > 0) || e.a + e.b >= 8192) { /* beyond the domain of these two */
        words = {exact[0].words[0], exact[0].words[1]};
        more = {UNDEFINED, UNDEFINED};
    }
    for (int i = 0; i < total; i++) {
        const size_t k = 2 * static_cast<size_t>(i);
        words.push_back(ok ? q16(saturated_deviation(e, {real(points[k]), real(points[k + 1])})) : 0);
        near_count += ok && words.back() < threshold;
    }
    if (!ok || e.a + e.b >= 8192) {
        more.resize(words.size(), ok ? 0 : EXACTLY);
        for (size_t i = words.size(); i < exact[0].words.size(); i++) {
            words.push_back(exact[0].words[i]);
            more.push_back(UNDEFINED);
        }
        const Array quality = like(exact[0], words);
        return {{quality, bounds("quality", quality, more)}, {like(exact[1], {ok ? DROGUE_OK : DROGUE_E_DOMAIN}), {}}};
    }
    const reference::Quality q = reference::quality(e, near_count, total, real(p[1]), real(p[2]));
    for (const Real v : {q.fit_ratio, q.length_ratio, q.axis_ratio, q.score, q.reliability}) {
        words.push_back(q16(v));
    }
    const Array quality = like(exact[0], words);
    return {{quality, bounds("quality", quality)}, {like(exact[1], {DROGUE_OK}), {}}};
}

Tiers cluster_tier(const Arrays &in, const Arrays &exact)
{
    const Words &w = in[0].words;
    const Words &p = in[1].words;
    std::vector<reference::Candidate> candidates;
    int members = 0;
    for (size_t i = 0; i < w.size(); i += 7) {
        candidates.push_back({ellipse_of(Words(w.begin() + static_cast<long>(i), w.begin() + static_cast<long>(i) + 5)),
                              real(w[i + 5]), as_int(w[i + 6])});
    }
    const int best =
        reference::cluster_best(candidates, {real(p[0]), real(p[1]), real(p[2]), real(p[3]), real(p[4])}, members);
    return {{like(exact[0], {best, members}), {}}};
}

int64_t q30(Real v) { return static_cast<int64_t>(std::floor(v * 0x1p30L + 0.5L)); }

/* How far vector k may turn, of 1, when each entry of the matrix is off by so much. */
Real eigenvector_turn(const reference::Eigen3 &e, size_t k, Real entry)
{
    Real turn = 0;
    for (size_t other = 0; other < 3; other++) {
        turn += other != k ? entry / std::max<Real>(std::fabs(e.value[k] - e.value[other]), 1) : 0;
    }
    return turn;
}

/* Are two components of the vector, one of which gives its sign, equally large? */
bool sign_is_free(std::array<Real, 3> v)
{
    for (Real &c : v) {
        c = std::fabs(c);
    }
    std::sort(v.begin(), v.end());
    return v[2] - v[1] < 1e-12L;
}

Tiers eigen_tier(const Arrays &in, const Arrays &exact)
{
    constexpr Real ENTRY = 0x1p-28L; /* of the largest value: what the others are good to */
    std::array<int64_t, 6> a;
    std::copy(in[0].words.begin(), in[0].words.end(), a.begin());
    const reference::Eigen3 e = reference::eigen(a);
    const Real size = std::max(std::fabs(e.value[0]), std::fabs(e.value[2]));
    std::array<bool, 3> free;
    Words values, vectors;
    std::vector<Real> turn;
    for (size_t k = 0; k < 3; k++) {
        values.push_back(q30(e.value[k] * 0x1p-60L));
        /* the third is the product of the others, and has its sign from theirs */
        free[k] = k < 2 ? sign_is_free(e.vector[k]) : free[0] || free[1];
        for (size_t other = 0; other < 3; other++) {
            free[k] = free[k] || (other != k && std::fabs(e.value[k] - e.value[other]) <= size * 1e-3L);
        }
    }
    for (size_t k = 0; k < 3; k++) {
        for (const Real v : e.vector[k]) {
            vectors.push_back(q30(v));
            turn.push_back(free[k] ? UNDEFINED : 0x1p30L * eigenvector_turn(e, k, ENTRY * size));
        }
    }
    const Array v = like(exact[0], values), d = like(exact[1], vectors);
    return {{v, bounds("eigen", v)}, {d, bounds("eigen", d, turn)}, unreferenced("eigen", exact[2])};
}

reference::Camera camera_of(const Words &w)
{
    return {real(w[0]), real(w[1]), real(w[2]), real(w[3]), real(w[4]), real(w[5]), real(w[6]), real(w[7]), real(w[8])};
}

Tiers undistort_tier(const Arrays &in, const Arrays &exact)
{
    const reference::Camera c = camera_of(in[0].words);
    Words words[2];
    for (size_t i = 0; i < in[1].words.size(); i += 2) {
        for (int k = 0; k < 2; k++) {
            reference::Point p = {real(in[1].words[i]), real(in[1].words[i + 1])};
            const bool ok = k == 0 ? reference::undistort(c, p) : reference::distort(c, p);
            words[k].insert(words[k].end(), {ok ? DROGUE_OK : DROGUE_E_DOMAIN, q16(p.x), q16(p.y)});
        }
    }
    /* 31 bits of an offset: beyond any image, more than the last place */
    std::vector<Real> more[2];
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < words[k].size(); i++) {
            more[k].push_back(i % 3 == 0 ? 0
                                         : std::max<Real>(0, std::fabs(static_cast<Real>(words[k][i])) * 0x1p-26L - 2));
        }
    }
    const Array undone = like(exact[0], words[0]), done = like(exact[1], words[1]);
    return {{undone, bounds("undistort", undone, more[0])}, {done, bounds("undistort", done, more[1])}};
}

Real saturated(Real v) { return std::clamp<Real>(v, -32768, real(INT32_MAX)); }

/* Relative error of the cone: its matrix comes from a sine of 30 bits, whose last one weighs (a / b)^2. Nothing for a
 * drogue, something for a needle; far from the optical axis the frame along the ray takes more, with the fourth power of
 * its obliquity: not compared beyond three focal lengths, where no camera without distortion looks. */
Real cone_error(const reference::Ellipse &e, const reference::Camera &c)
{
    const Real flat = e.a / e.b;
    if (std::hypot((e.xc - c.cx) / c.fx, (e.yc - c.cy) / c.fy) > 3) {
        return UNDEFINED;
    }
    return 0x1p-30L * flat * flat;
}

Tiers pose_tier(const Arrays &in, const Arrays &exact)
{
    const Words &p = in[2].words;
    const reference::Camera c = camera_of(in[1].words);
    std::array<reference::Pose, 2> pair;
    Words words(21, 0);
    std::vector<Real> more(21, 0);
    if (!reference::poses(ellipse_of(in[0].words), c, real(p[0]), pair)) {
        words[0] = DROGUE_E_DOMAIN;
        return {{like(exact[0], words), {}}};
    }
    const Real error = cone_error(ellipse_of(in[0].words), c);
    for (size_t i = 0; i < 2; i++) {
        int64_t *at = &words[1 + 8 * i];
        for (size_t k = 0; k < 3; k++) {
            at[k] = q16(pair[i].position[k]);
            at[3 + k] = q16(pair[i].axis[k]);
            /* The choice starts from poses in Q16, and a last bit of theirs is many of a pixel's: from the library's. */
            pair[i].position[k] = real(exact[0].words[1 + 8 * i + k]);
            pair[i].axis[k] = real(exact[0].words[1 + 8 * i + 3 + k]);
        }
        at[6] = q16(pair[i].yaw);
        at[7] = q16(pair[i].pitch);
        const int64_t farthest = std::max({std::abs(at[0]), std::abs(at[1]), std::abs(at[2])});
        for (size_t k = 0; k < 8; k++) {
            more[1 + 8 * i + k] = std::floor(error * static_cast<Real>(k < 3 ? farthest : DROGUE_Q16_ONE));
        }
    }
    for (size_t i = 0; i < 2; i++) {
        reference::Point q;
        if (!reference::project(pair[i], real(p[1]), c, q)) {
            words[0] = DROGUE_E_BEHIND_CAMERA;
            words[18] = words[19] = 0;
            return {{like(exact[0], words), bounds("pose", like(exact[0], words), more)}};
        }
        words[18 + i] = q16(std::hypot(saturated(q.x) - real(p[2]), saturated(q.y) - real(p[3])));
    }
    words[17] = words[19] < words[18] ? 1 : 0;
    const auto [nearer, farther] = std::minmax(words[18], words[19]);
    words[20] = farther > 0 ? q16(real(nearer) / real(farther)) : 65536;
    return {{like(exact[0], words), bounds("pose", like(exact[0], words), more)}};
}

Tiers kalman_tier(const Arrays &in, const Arrays &exact)
{
    const Words &p = in[0].words;
    const Words &f = in[1].words;
    std::array<double, 5> start, process;
    std::array<std::array<double, 3>, 5> start_std;
    Words words;
    for (size_t k = 0; k < 5; k++) {
        process[k] = static_cast<double>(real(p[1 + k]));
        start[k] = static_cast<double>(real(p[21 + k]));
        for (size_t i = 0; i < 3; i++) {
            start_std[k][i] = static_cast<double>(real(p[6 + 3 * k + i]));
        }
    }
    reference::Kalman filter(start, start_std);
    for (size_t i = 0; i < f.size(); i += 10) {
        std::array<double, 5> value, std;
        filter.predict(static_cast<double>(p[0]) / 1e6, process);
        for (size_t k = 0; k < 5; k++) {
            value[k] = static_cast<double>(real(f[i + k]));
            std[k] = static_cast<double>(real(f[i + 5 + k]));
        }
        if (std[0] > 0) {
            filter.correct(value, std);
        }
        for (int order = 0; order < 3; order++) {
            for (int k = 0; k < 5; k++) {
                words.push_back(q16(filter.state(k, order)));
            }
        }
    }
    return {{like(exact[0], words), bounds("kalman", like(exact[0], words))}};
}

} // namespace

Tiers reference_of(const std::string &stage, const Arrays &inputs, const Arrays &exact)
{
    using Tier = Tiers (*)(const Arrays &, const Arrays &);
    static const std::map<std::string, Tier> tiers = {{"smooth", smooth_tier},       {"gradient", gradient_tier},
                                                      {"canny", canny_tier},         {"mask", mask_tier},
                                                      {"arcs", arcs_tier},           {"constraints", constraints_tier},
                                                      {"ellipse", ellipse_tier},     {"quality", quality_tier},
                                                      {"cluster", cluster_tier},     {"eigen", eigen_tier},
                                                      {"undistort", undistort_tier}, {"pose", pose_tier},
                                                      {"kalman", kalman_tier},       {"frame", frame_tier},
                                                      {"select", select_tier},       {"support", support_tier},
                                                      {"joint", joint_tier},         {"decide", decide_tier},
                                                      {"look", look_tier},           {"rim", rim_tier},
                                                      {"search", search_tier},       {"acquire", acquire_tier},
                                                      {"track", track_tier},         {"follow", follow_tier}};
    return tiers.at(stage)(inputs, exact);
}

} // namespace vectors
