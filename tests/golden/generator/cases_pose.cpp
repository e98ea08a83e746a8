/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of the lens and of the two poses of an ellipse. */
#include <cmath>

#include "case.hpp"
#include "geometry.hpp"
#include "reference.hpp"

namespace vectors {

namespace {

constexpr int64_t ONE = 65536;
using Words = std::vector<int64_t>;

int64_t q16(double v) { return static_cast<int64_t>(std::floor(v * 65536 + 0.5)); }

Words camera_words(const accuracy::Camera &c)
{
    return {q16(c.fx_px), q16(c.fy_px), q16(c.cx_px), q16(c.cy_px), q16(c.k1),
            q16(c.k2),    q16(c.p1),    q16(c.p2),    q16(c.k3)};
}

const accuracy::Camera plain = {1465.5, 1465.5, 1023.5, 1023.5};
const accuracy::Camera oblong = {1210.25, 1377.5, 640.3, 511.8};
const accuracy::Camera barrel = {802.5, 801.25, 639.5, 511.5, -0.38, 0.17, 0.0011, -0.0007, -0.04};
const accuracy::Camera pincushion = {900, 910, 320, 240, 0.21, 0.05, -0.002, 0.003, 0.01};
const accuracy::Camera tangential = {700, 700, 319.5, 239.5, 0, 0, 0.02, -0.015, 0};
const accuracy::Camera folded = {500, 500, 400, 300, -0.5, 0, 0, 0, 0};

void add_lens(Set &set, const std::string &name, Tier tier, const Flags &flags, const Words &camera,
              const Words &points)
{
    set.add(name, tier, flags, {word_array("camera", 32, 16, camera), word_array("points", 32, 16, points)});
}

Words grid(int64_t left, int64_t top, int64_t right, int64_t bottom, int steps)
{
    Words words;
    for (int y = 0; y <= steps; y++) {
        for (int x = 0; x <= steps; x++) {
            words.push_back(left + (right - left) * x / steps);
            words.push_back(top + (bottom - top) * y / steps);
        }
    }
    return words;
}

/* Points from the principal point outward in one direction. */
Words fan(const accuracy::Camera &c, double dx, double dy, double from, double to, int steps)
{
    Words words;
    for (int i = 0; i <= steps; i++) {
        const double r = from + (to - from) * i / steps;
        words.push_back(q16(c.cx_px + c.fx_px * r * dx));
        words.push_back(q16(c.cy_px + c.fy_px * r * dy));
    }
    return words;
}

void add_lens_limits(Set &set)
{
    /* four focal lengths off the axis, and one LSB beyond */
    const Words wide = {100 * ONE, 50 * ONE, 10 * ONE, -20 * ONE, 0, 0, 0, 0, 0};
    add_lens(set, "domain-limit", Tier::boundary, {"threshold-met"}, wide,
             {410 * ONE, 0,        410 * ONE + 1, 0, -390 * ONE, 0, -390 * ONE - 1, 0,         0,
              180 * ONE, 0,        180 * ONE + 1, 0, -220 * ONE, 0, -220 * ONE - 1, 410 * ONE, 180 * ONE,
              10 * ONE,  -20 * ONE});
    add_lens(set, "format-limit", Tier::boundary, {"saturation"}, {20000 * ONE, 21000 * ONE, 0, 0, 0, 0, 0, 0, 0},
             {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN, INT32_MAX, INT32_MIN, INT32_MAX - 1, 7, 0, INT32_MIN + 1});
    add_lens(
        set, "beyond-format", Tier::must_reject, {"saturation"}, {9000 * ONE, 9000 * ONE, 0, 0, 3 * ONE, ONE, 0, 0, 0},
        {20000 * ONE, 0, 0, 20000 * ONE, -20000 * ONE, 0, 0, -20000 * ONE, 9000 * ONE, 9000 * ONE, 30000 * ONE, ONE});
    const int64_t most = 256 * ONE; /* largest coefficient */
    for (int k = 0; k < 5; k++) {
        for (const int64_t sign : {1, -1}) {
            const int64_t far = k == 2 || k == 3 ? ONE / 1000 : ONE; /* tangential ones fold the image near the axis */
            const Words through = {1100 * far, 0,          200 * far,   150 * far,  far, 0,
                                   0,          3000 * far, -4000 * far, 4000 * far, 0,   0};
            Words camera = {1000 * ONE, 1000 * ONE, 0, 0, 0, 0, 0, 0, 0};
            const std::string name = "largest-coefficient-" + std::to_string(k) + (sign > 0 ? "" : "-negative");
            camera[static_cast<size_t>(4 + k)] = sign * most;
            add_lens(set, name, Tier::boundary, {"threshold-met"}, camera, through);
            camera[static_cast<size_t>(4 + k)] += sign;
            add_lens(set, name + "-and-more", Tier::must_reject, {"threshold-met"}, camera, through);
        }
    }
    add_lens(set, "coefficients-largest", Tier::stress, {"saturation"},
             {1000 * ONE, 1000 * ONE, 0, 0, most, most, most, most, most},
             {-4000 * ONE, 4000 * ONE, 10, 10, 4000 * ONE, 0, 0, 4000 * ONE, -4000 * ONE, 4000 * ONE, ONE, 0});
    add_lens(set, "coefficients-least", Tier::stress, {"saturation", "rounding-negative"},
             {1000 * ONE, 1000 * ONE, 0, 0, -most, -most, -most, -most, -most},
             {4000 * ONE, 4000 * ONE, 10, 10, 4000 * ONE, 0, 0, 4000 * ONE, -4000 * ONE, 4000 * ONE, ONE, 0});
    add_lens(set, "camera-tiny", Tier::stress, {"saturation"}, {1, 1, 0, 0, 0, 0, 0, 0, 0},
             {0, 0, 4, -4, 5, 0, 1, -5, 2, 1});
    add_lens(set, "normalisation-saturates", Tier::must_reject, {"saturation"},
             {1, 1, -16384 * ONE, -16384 * ONE, 0, 0, 0, 0, 0}, {16384 * ONE, 16384 * ONE});
    add_lens(set, "fold-on-the-way", Tier::must_reject, {"folded-lens"},
             {1000 * ONE, 1000 * ONE, 500 * ONE, 500 * ONE, 6209, 9628, 1970, 29078, 5825}, {-39712743, 158842256});
    add_lens(set, "to-and-fro", Tier::stress, {"tie"}, {172076256, 176724429, 0, 0, -11154, 4630, 652, -547, -792},
             {132086166, 209699345});
    add_lens(set, "camera-largest", Tier::stress, {"saturation"},
             {INT32_MAX, INT32_MAX, INT32_MAX, INT32_MIN, 6554, 0, 0, 0, 0},
             {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN, 0, 0, INT32_MAX - 77777, INT32_MIN + 99999});
}

struct View {
    accuracy::Camera camera = plain;
    double x = 0, y = 0, z = 10, tilt_deg = 0, towards_deg = 0;
    double radius = 0.35, depth = 0.25;
};

void add_pair(Set &set, const std::string &name, Tier tier, const Flags &flags, const Words &ellipse,
              const Words &camera, const Words &params)
{
    set.add(name, tier, flags,
            {word_array("ellipse", 32, 16, ellipse), word_array("camera", 32, 16, camera),
             word_array("params", 32, 16, params)});
}

Words seen_ellipse(const View &v, cv::Point2d &inner)
{
    const double tilt = v.tilt_deg * CV_PI / 180;
    const double towards = v.towards_deg * CV_PI / 180;
    const accuracy::Pose pose = {
        {v.x, v.y, v.z}, {std::sin(tilt) * std::cos(towards), std::sin(tilt) * std::sin(towards), std::cos(tilt)}};
    const accuracy::Ellipse e = accuracy::project_circle(v.camera, pose, v.radius, 0);
    inner = v.camera.project_ideal(pose.position_m + v.depth * pose.axis);
    return {q16(e.xc_px), q16(e.yc_px), q16(e.a_px), q16(e.b_px), std::max<int64_t>(q16(e.angle_rad), -102944)};
}

void add_view(Set &set, const std::string &name, Tier tier, const Flags &flags, const View &v)
{
    cv::Point2d inner;
    const Words ellipse = seen_ellipse(v, inner);
    add_pair(set, name, tier, flags, ellipse, camera_words(v.camera),
             {q16(v.radius), q16(v.depth), q16(inner.x), q16(inner.y)});
}

void add_views(Set &set)
{
    static const double distances[] = {2, 5, 10, 25};
    static const double tilts[] = {0, 2, 10, 20, 30, 60};
    int towards = 0;
    for (const double z : distances) {
        for (const double tilt : tilts) {
            const std::string name =
                "at-" + std::to_string(static_cast<int>(z)) + "m-tilt-" + std::to_string(static_cast<int>(tilt));
            accuracy::Random random = set.random(name);
            View v;
            v.z = z;
            v.x = z * random.uniform(-0.25, 0.25);
            v.y = z * random.uniform(-0.25, 0.25);
            v.tilt_deg = tilt;
            v.towards_deg = 47 * towards++;
            add_view(set, name, tilt == 60 ? Tier::stress : Tier::ordinary, {tilt < 5 ? "head-on" : "twin-pose"}, v);
        }
    }
}

void add_symmetric(Set &set)
{
    /* tilted exactly up, down, left, right before the principal point: both poses mirror each other */
    static const char *const names[] = {"tilt-right", "tilt-down", "tilt-left", "tilt-up"};
    for (int k = 0; k < 4; k++) {
        View v;
        v.tilt_deg = 15;
        v.towards_deg = 90 * k;
        v.z = 6;
        add_view(set, names[k], Tier::boundary, {"twin-pose", "angle-wrap"}, v);
    }
    const Words round = {q16(1023.5), q16(1023.5), 64 * ONE, 64 * ONE, 0};
    add_pair(set, "head-on-circle", Tier::boundary, {"head-on"}, round, camera_words(plain),
             {q16(0.35), q16(0.25), q16(1023.5), q16(1023.5)});
    add_pair(set, "head-on-inner-beside", Tier::boundary, {"head-on", "twin-pose"}, round, camera_words(plain),
             {q16(0.35), q16(0.25), q16(1030.5), q16(1020)});
    add_pair(set, "circle-off-centre", Tier::boundary, {"near-circle"}, {q16(1400), q16(600), 50 * ONE, 50 * ONE, 0},
             camera_words(plain), {q16(0.35), q16(0.25), q16(1401), q16(600)});
    /* the measured centre is as far from both projections: the first pose is taken */
    const Words leaning = {q16(1023.5), q16(1023.5), 64 * ONE, 60 * ONE, 0};
    add_pair(set, "ambiguous-middle", Tier::boundary, {"twin-pose", "tie"}, leaning, camera_words(plain),
             {q16(0.35), q16(0.25), q16(1023.5), q16(1023.5)});
    add_pair(set, "ambiguous-on-the-line", Tier::boundary, {"twin-pose", "tie"}, leaning, camera_words(plain),
             {q16(0.35), q16(0.25), q16(1063.5), q16(1023.5)});
    add_pair(set, "no-depth", Tier::boundary, {"twin-pose", "tie"}, leaning, camera_words(plain),
             {q16(0.35), 0, q16(1023.5), q16(1023.5)});
    add_pair(set, "depth-before-plane", Tier::ordinary, {"rounding-negative"}, leaning, camera_words(plain),
             {q16(0.35), q16(-0.2), q16(1023.5), q16(1043)});
    for (const int64_t angle : {INT64_C(102944), INT64_C(-102944), INT64_C(51472), INT64_C(-51472)}) {
        add_pair(set, "angle-" + std::string(angle < 0 ? "minus-" : "") + std::to_string(std::abs(angle)),
                 Tier::boundary, {"angle-wrap", "tie"}, {q16(1023.5), q16(1023.5), 64 * ONE, 57 * ONE, angle},
                 camera_words(plain), {q16(0.35), q16(0.25), q16(1010), q16(1015)});
    }
}

void add_pose_limits(Set &set)
{
    const Words camera = camera_words(plain);
    const Words e = {q16(900), q16(1100), 40 * ONE, 36 * ONE, 20000};
    const Words params = {q16(0.35), q16(0.25), q16(905), q16(1095)};
    Words bad = e;
    bad[3] = 0;
    add_pair(set, "no-minor-axis", Tier::must_reject, {"domain"}, bad, camera, params);
    bad[3] = e[2] + 1;
    add_pair(set, "minor-above-major", Tier::must_reject, {"domain"}, bad, camera, params);
    bad[3] = e[2];
    add_pair(set, "minor-equals-major", Tier::boundary, {"near-circle"}, bad, camera, params);
    Words p = params;
    p[0] = 0;
    add_pair(set, "no-radius", Tier::must_reject, {"domain"}, e, camera, p);
    Words c = camera;
    c[0] = 0;
    add_pair(set, "no-focal-length-x", Tier::must_reject, {"domain"}, e, c, params);
    c = camera;
    c[1] = -ONE;
    add_pair(set, "negative-focal-length-y", Tier::must_reject, {"domain"}, e, c, params);
    p[0] = 1;
    add_pair(set, "radius-one-lsb", Tier::boundary, {"threshold-met"}, e, camera, p);
    p = params;
    p[1] = -20 * ONE;
    add_pair(set, "inner-behind-camera", Tier::must_reject, {"behind-camera"}, e, camera, p);
    add_pair(set, "flat", Tier::stress, {"degenerate"}, {q16(900), q16(1100), 400 * ONE, ONE, 20000}, camera, params);
    add_pair(set, "smallest", Tier::stress, {"degenerate"}, {q16(900), q16(1100), 3300, 2600, 0}, camera, params);
    add_pair(set, "beyond-q16", Tier::must_reject, {"saturation"}, {0, 0, 30, 28, 5000},
             {32000 * ONE, 32000 * ONE, 0, 0, 0, 0, 0, 0, 0}, {3 * ONE, ONE, 0, 0});
    add_pair(set, "far-to-the-side", Tier::stress, {"saturation"},
             {32000 * ONE, -32000 * ONE, 300 * ONE, 200 * ONE, 700}, {300 * ONE, 300 * ONE, 0, 0, 0, 0, 0, 0, 0},
             {ONE, ONE / 4, 31000 * ONE, -31000 * ONE});
    add_pair(set, "largest", Tier::stress, {"saturation"}, {INT32_MAX, INT32_MIN, INT32_MAX, INT32_MAX - 5, -9},
             {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MAX, 0, 0, 0, 0, 0}, {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MAX});
    add_pair(set, "inner-far-away", Tier::boundary, {"saturation"}, e, camera,
             {q16(0.35), q16(0.25), INT32_MAX, INT32_MIN});
}

/* Poses one of whose angles lies next to a tie of its rounding: it moves with the last bits of what it is made of. */
void add_poses_near_ties(Set &set)
{
    const auto real = [](int64_t word) { return static_cast<reference::Real>(word) / 65536; };
    for (int k = 0; k < 12; k++) {
        const std::string name = "near-tie-" + std::to_string(k);
        accuracy::Random random = set.random(name);
        const Words camera = camera_words(k % 2 == 0 ? oblong : plain);
        const reference::Camera c = {real(camera[0]), real(camera[1]), real(camera[2]), real(camera[3])};
        Words ellipse;
        std::array<reference::Pose, 2> pair;
        double off = 1;
        while (off > 0.001) { /* LSB */
            ellipse = {between(random, 0, 1300 * 65536), between(random, 0, 1000 * 65536),
                       between(random, 20 * 65536, 120 * 65536), 0, between(random, -102943, 102944)};
            ellipse[3] = static_cast<int64_t>(static_cast<double>(ellipse[2]) * random.uniform(0.7, 0.99));
            if (reference::poses(
                    {real(ellipse[0]), real(ellipse[1]), real(ellipse[2]), real(ellipse[3]), real(ellipse[4])}, c,
                    real(22938), pair)) {
                const reference::Real angle = 65536 * (k % 4 < 2 ? pair[0].yaw : pair[1].pitch);
                off = static_cast<double>(std::fabs(angle - std::floor(angle) - 0.5L));
            }
        }
        add_pair(set, name, Tier::boundary, {"half-lsb"}, ellipse, camera,
                 {22938, 16384, ellipse[0] + 65536, ellipse[1] - 65536});
    }
}

/* Found by search: in each an angle ends, in the 32 bits below its rounding, at the last value before a tie or the first
 * behind it. Together they notice an error of one in any entry of the arctangent's table. */
void add_last_bits(Set &set)
{
    for (const int number : {110, 392440, 167960, 54964}) {
        const std::string name = "angle-last-bit-" + std::to_string(number);
        accuracy::Random random = set.random(name);
        Words e = {between(random, 0, 1300 * 65536), between(random, 0, 1000 * 65536),
                   between(random, 20 * 65536, 120 * 65536), 0, 0};
        e[3] = e[2] / 16 * between(random, 11, 15);
        e[4] = between(random, -102943, 102944);
        add_pair(set, name, Tier::boundary, {"half-lsb"}, e, camera_words(plain), {22938, 16384, e[0], e[1]});
    }
}

} // namespace

void add_undistort(Set &set)
{
    set.begin("undistort");
    const int64_t w = 1280 * ONE;
    const int64_t h = 1024 * ONE;
    add_lens(set, "no-distortion", Tier::ordinary, {}, camera_words(oblong), grid(3, 7, w, h, 7));
    add_lens(set, "barrel", Tier::ordinary, {"barrel"}, camera_words(barrel), grid(13, -5, w, h, 9));
    add_lens(set, "pincushion", Tier::ordinary, {"pincushion"}, camera_words(pincushion),
             grid(-7, 11, w / 2, h / 2, 9));
    add_lens(set, "tangential", Tier::ordinary, {"tangential"}, camera_words(tangential), grid(1, 1, w / 2, h / 2, 7));
    add_lens(set, "folded-lens", Tier::must_reject, {"folded-lens"}, camera_words(folded),
             grid(0, 0, 800 * ONE, 600 * ONE, 9));
    add_lens(set, "fold-from-inside", Tier::boundary, {"folded-lens"}, camera_words(folded),
             fan(folded, 0.8, 0.6, 0.53, 0.56, 30));
    add_lens(set, "fold-along-axis", Tier::boundary, {"folded-lens"}, camera_words(folded),
             fan(folded, 1, 0, -0.56, -0.52, 20));
    add_lens(set, "principal-point", Tier::boundary, {"degenerate"}, camera_words(barrel),
             fan(barrel, 1, 0, -0.0001, 0.0001, 8));
    add_lens(set, "barrel-fan", Tier::ordinary, {"barrel"}, camera_words(barrel), fan(barrel, -0.6, 0.8, 0, 0.9, 30));
    add_lens(set, "pincushion-fan", Tier::ordinary, {"pincushion"}, camera_words(pincushion),
             fan(pincushion, 0.8, -0.6, 0, 3.5, 35));
    add_lens_limits(set);
    static const char *const coefficient[] = {"k1", "k2", "p1", "p2", "k3"};
    for (int k = 0; k < 5; k++) { /* each coefficient alone, both signs: a wrong factor cannot hide */
        for (const int sign : {1, -1}) {
            Words camera = camera_words({640.5, 655.25, 320.5, 239.75});
            camera[static_cast<size_t>(4 + k)] = sign * (k < 2 || k == 4 ? 9000 : 1500);
            add_lens(set, std::string(coefficient[k]) + (sign > 0 ? "-alone" : "-alone-negative"), Tier::ordinary,
                     {"single-coefficient"}, camera, grid(5, 3, 640 * ONE, 480 * ONE, 4));
        }
    }
    for (int k = 0; k < 5; k++) {
        const std::string name = "random-" + std::to_string(k);
        accuracy::Random random = set.random(name);
        const accuracy::Camera c = {
            random.uniform(300, 2000),   random.uniform(300, 2000),   random.uniform(100, 1000),
            random.uniform(100, 1000),   random.uniform(-0.3, 0.2),   random.uniform(-0.1, 0.1),
            random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01), random.uniform(-0.02, 0.02)};
        Words points;
        for (int i = 0; i < 60; i++) {
            points.push_back(between(random, 0, 1200 * 65536));
            points.push_back(between(random, 0, 1000 * 65536));
        }
        add_lens(set, name, Tier::ordinary, {}, camera_words(c), points);
    }
}

void add_pose(Set &set)
{
    set.begin("pose");
    add_views(set);
    add_symmetric(set);
    add_poses_near_ties(set);
    add_last_bits(set);
    add_pose_limits(set);
    for (int k = 0; k < 10; k++) {
        const std::string name = "random-" + std::to_string(k);
        accuracy::Random random = set.random(name);
        View v;
        v.camera = k % 2 == 0 ? oblong : plain;
        v.z = random.uniform(2, 25);
        v.x = v.z * random.uniform(-0.4, 0.4);
        v.y = v.z * random.uniform(-0.4, 0.4);
        v.tilt_deg = random.uniform(0, 35);
        v.towards_deg = random.uniform(0, 360);
        v.radius = random.uniform(0.2, 0.6);
        v.depth = random.uniform(0.05, 0.4);
        add_view(set, name, Tier::ordinary, {}, v);
    }
}

} // namespace vectors
