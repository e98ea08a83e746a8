/* SPDX-License-Identifier: Apache-2.0 */
/* Draws the scenes of every condition. */
#include "conditions.hpp"
#include "plain.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "measure.hpp"

namespace accuracy {

namespace {

constexpr double nearest_m = 2;
constexpr double farthest_m = 25;

double signed_uniform(Random &random, double low, double high)
{
    const double size = random.uniform(low, high);
    return random.uniform(0, 1) < 0.5 ? -size : size;
}

cv::Point2d direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

cv::Point2d centre_of(const Ellipse &e) { return {e.xc_px, e.yc_px}; }

double any_angle(Random &random) { return random.uniform(-CV_PI, CV_PI); }

/* Mean grey of the canopy just inside the rim, between the ribs, unlit by the sensor's tricks, within an angle about a direction. */
double rim_grey(const Scene &scene, const cv::Point2d &towards, double half_angle_rad)
{
    double sum = 0;
    int points = 0;
    const Ellipse e = scene.rim();
    for (int i = 0; i < 360; i++) {
        const cv::Point2d away = e.at(i * CV_PI / 180) - centre_of(e);
        if (away.dot(towards) < std::cos(half_angle_rad) * cv::norm(away)) {
            continue;
        }
        const Hit hit = trace(scene, centre_of(e) + 0.985 * away);
        if (hit.surface == Surface::inside) {
            sum += hit.grey;
            points++;
        }
    }
    CV_Assert(points > 0);
    return sum / points;
}

void draw_pose(Trial &t, Random &random, double distance_m)
{
    const double field = 0.25; /* tan 14 degrees */
    const double tilt = random.uniform(0, 30) * CV_PI / 180;
    const double towards = any_angle(random);
    Pose &pose = t.scene.pose;
    pose.axis = {std::sin(tilt) * std::cos(towards), std::sin(tilt) * std::sin(towards), std::cos(tilt)};
    do {
        pose.position_m = draw_place(random, distance_m, field);
    } while (angle_between_deg(pose.axis, cv::normalize(pose.position_m)) > 36);
}

void draw_plain(Trial &t, Random &random)
{
    Scene &s = t.scene;
    const int i = t.index;
    s.drogue.rib_phase = random.uniform(0, 1);
    s.look = i % 3 == 1 || i % 6 == 5 ? Look::bright() : Look::dark();
    s.background = i % 3 == 0 ? Background::sky() : i % 3 == 1 ? Background::ground() : Background::cloud();
    s.look.sun = draw_sun(random);
    s.sensor.blur_px = random.uniform(0.5, 0.9);
}

/* The region; 'off' and 'spread' in semi-axes: largest error of its centre, largest deviation of its side from 2.5. */
void draw_region(Trial &t, Random &random, double off, double spread)
{
    const double a = t.rim.a_px;
    const int side = static_cast<int>(std::lround((2.5 + random.uniform(-spread, spread)) * a));
    const double x = t.rim.xc_px + off * a * random.uniform(-1, 1);
    const double y = t.rim.yc_px + off * a * random.uniform(-1, 1);
    t.region = cv::Rect(static_cast<int>(std::lround(x - (side - 1) / 2.0)),
                        static_cast<int>(std::lround(y - (side - 1) / 2.0)), side, side);
}

/* Model, pose and rim of the outline's mean plane. */
void set_truth(Trial &t)
{
    const Drogue &d = t.scene.drogue;
    const double depth = d.scallop_m / 2; /* mean of scallop * sin^2 over the edge */
    const double radius = d.rim_radius_m + (d.coupling_radius_m - d.rim_radius_m) * depth / d.inner_depth_m;
    t.pose = {t.scene.pose.position_m + depth * t.scene.pose.axis, t.scene.pose.axis};
    t.rim = project_circle(t.scene.camera, t.pose, radius, 0);
    t.model = {to_q16(radius), to_q16(d.inner_radius_m), to_q16(d.inner_depth_m - depth)};
}

/* Each disturbance at a strength in (0, 1]; lengths in pixels need t.rim. */

void add_illumination(Trial &t, Random &random, double strength)
{
    const double a = t.rim.a_px;
    const double away = random.uniform(0, 2) * a * strength;
    Sensor &s = t.scene.sensor;
    s.light_at_px = centre_of(t.rim) + away * direction(any_angle(random));
    s.light_radius_px = away + random.uniform(2.5, 6) * a / strength;
    s.light_k = random.uniform(0.8, 1.4);
}

void add_gaussian(Trial &t, Random &random, double strength)
{
    t.scene.sensor.motion_sigma_px = strength * random.uniform(0.2, 1) * std::min(3.0, 0.1 * t.rim.a_px);
}

void add_linear(Trial &t, Random &random, double strength)
{
    t.scene.sensor.motion_length_px = strength * random.uniform(0.2, 1) * std::min(9.0, 0.25 * t.rim.a_px);
    t.scene.sensor.motion_angle_rad = any_angle(random);
}

void add_noise(Trial &t, Random &random, double strength)
{
    t.scene.sensor.noise = 2 + strength * random.uniform(2, 6);
}

void add_probe(Trial &t, Random &random, double strength)
{
    const double a = t.rim.a_px;
    const cv::Point2d from = direction(any_angle(random));
    const cv::Point2d side(-from.y, from.x);
    const cv::Point2d centre = centre_of(t.rim) + random.uniform(-0.4, 0.4) * a * side;
    Probe &p = t.scene.probe;
    p.tip_px = centre + random.uniform(0.35, 0.9) * a * from;
    p.root_px = centre + 6 * a * from;
    p.half_width_px = strength * random.uniform(0.05, 0.15) * a;
    p.grey = random.uniform(20, 235);

    const double angle = any_angle(random); /* the hose */
    const double half = 4 * a;
    t.scene.drogue.hose_length_m = 0;
    t.scene.background.clutter.push_back({centre_of(t.rim) + half * direction(angle), half,
                                          std::max(0.6, random.uniform(0.06, 0.14) * a), angle, t.scene.look.hose_grey,
                                          false, 1});
}

void add_clutter(Trial &t, Random &random, double strength)
{
    const double a = t.rim.a_px;
    Background &b = t.scene.background;
    b.texture_grey = strength * random.uniform(25, 45);
    b.texture_px = std::max(12.0, random.uniform(0.3, 1.5) * a);
    b.octaves = 4;
    const int things = static_cast<int>(strength * random.uniform(3, 9));
    for (int i = 0; i < things; i++) {
        const double angle = any_angle(random);
        const cv::Point2d at = centre_of(t.rim) + random.uniform(0.85, 1.5) * a * direction(angle);
        const bool round = random.uniform(0, 1) < 0.6;
        const double half_length = random.uniform(0.1, round ? 0.4 : 1.2) * a;
        const double half_width = round ? half_length * random.uniform(0.4, 1) : random.uniform(0.02, 0.1) * a;
        b.clutter.push_back({at, half_length, half_width, any_angle(random), random.uniform(10, 245), round,
                             std::max(1.0, random.uniform(0, 0.05) * a)});
    }
}

void add_low_contrast(Trial &t, Random &random, double strength)
{
    const double a = t.rim.a_px;
    const cv::Point2d towards = direction(any_angle(random));
    Scene &s = t.scene;
    if (random.uniform(0, 1) < 0.5) {
        s.look.canopy_grey = random.uniform(100, 190); /* room on both sides */
        const double level = rim_grey(s, towards, CV_PI);
        s.background.top_grey = s.background.bottom_grey = level;
        s.background.texture_grey = std::min(s.background.texture_grey, 5.0);
        s.background.ramp_at_px = centre_of(t.rim) + strength * signed_uniform(random, 0, 0.6) * a * towards;
        s.background.ramp_per_px = random.uniform(40, 80) / (strength * a) * towards;
    } else {
        const double half = random.uniform(0.4, 0.7) * a * strength;
        const double level = rim_grey(s, towards, half / a) + random.uniform(-10, 10);
        s.background.clutter.push_back({centre_of(t.rim) + a * towards, half, half, 0, std::clamp(level, 0.0, 255.0),
                                        true, random.uniform(0.1, 0.3) * a});
    }
}

void add_scallops(Trial &t, Random &random, double strength)
{
    t.scene.drogue.ribs = static_cast<int>(random.uniform(20, 41));
    t.scene.drogue.scallop_m = strength * random.uniform(0.01, 0.03) * t.scene.drogue.rim_radius_m;
}

void add_inner(Trial &t, Random &random, double strength)
{
    Drogue &d = t.scene.drogue;
    d.spokes = static_cast<int>(random.uniform(2, 7));
    d.spoke_width_m = strength * random.uniform(0.08, 0.25) * d.inner_radius_m;
    d.spoke_phase_rad = any_angle(random);
    t.scene.look.spoke_grey = random.uniform(70, 200);
    const int patches = static_cast<int>(random.uniform(1, 5));
    const double first = any_angle(random);
    for (int i = 0; i < patches; i++) {
        const double from = random.uniform(0.04, 0.1);
        d.patches.push_back({first + 2 * CV_PI * i / patches, random.uniform(0.15, 0.8) * strength, from,
                             random.uniform(from + 0.05, 0.2)});
    }
    t.scene.look.patch_grey = random.uniform(12, 30);
}

using Add = void (*)(Trial &, Random &, double);
struct Kind {
    const char *name;
    Add add; /* before the truth is set: null for what is no disturbance of the scene */
};
constexpr Kind kinds[conditions] = {
    {"plain", nullptr},
    {"illumination", add_illumination},
    {"gaussian", add_gaussian},
    {"linear", add_linear},
    {"noise", add_noise},
    {"off_centre", nullptr},
    {"probe", add_probe},
    {"clutter", add_clutter},
    {"low_contrast", add_low_contrast},
    {"scallops", add_scallops},
    {"inner", add_inner},
    {"all", nullptr},
};

} // namespace

const char *name_of(Condition condition) { return kinds[static_cast<int>(condition)].name; }

Trial trial_at(uint64_t seed, Condition condition, int index, double distance_m)
{
    Trial t;
    t.condition = condition;
    t.index = index;
    t.scene.seed = hash_at(seed, index, 1000 + static_cast<int>(condition));
    Random random(t.scene.seed);
    draw_pose(t, random, distance_m);
    draw_plain(t, random);
    set_truth(t);

    bool off_centre = condition == Condition::off_centre;
    double strength = 1;
    if (condition == Condition::all) {
        strength = 0.5;
        for (const Kind &kind : kinds) {
            const bool chosen = random.uniform(0, 1) < 0.35;
            if (chosen && kind.add != nullptr) {
                kind.add(t, random, strength);
            }
        }
        off_centre = random.uniform(0, 1) < 0.35;
    } else if (kinds[static_cast<int>(condition)].add != nullptr) {
        kinds[static_cast<int>(condition)].add(t, random, strength);
    }
    set_truth(t);
    draw_region(t, random, off_centre ? 0.15 * strength : 0.03, off_centre ? 0.3 * strength : 0);
    return t;
}

Trial trial(uint64_t seed, Condition condition, int index)
{
    const double start = unit(hash_at(seed, -1, static_cast<int>(condition)));
    const double share = start + index * 0.6180339887498949; /* golden section: any run of indices is spread evenly */
    const double at = share - std::floor(share);
    return trial_at(seed, condition, index, nearest_m * std::pow(farthest_m / nearest_m, at));
}

Trial trial_of(const PlainScene &plain, int index)
{
    Trial t;
    t.condition = Condition::plain;
    t.index = index;
    t.scene = plain.scene;
    t.region = plain.region;
    set_truth(t);
    return t;
}

uint64_t fingerprint(const Trial &t)
{
    uint64_t sum = t.scene.seed;
    const auto add = [&](double v) {
        uint64_t bits;
        std::memcpy(&bits, &v, sizeof bits);
        sum = mix64(sum ^ bits) + UINT64_C(0x9E3779B97F4A7C15);
    };
    const Scene &s = t.scene;
    for (int i = 0; i < 3; i++) {
        add(s.pose.position_m[i]);
        add(s.pose.axis[i]);
        add(s.look.sun[i]);
    }
    for (const double v : {s.drogue.rib_phase,         s.drogue.scallop_m,
                           s.drogue.spoke_width_m,     s.drogue.spoke_phase_rad,
                           s.drogue.hose_length_m,     s.look.canopy_grey,
                           s.look.spoke_grey,          s.look.patch_grey,
                           s.background.top_grey,      s.background.texture_grey,
                           s.background.texture_px,    s.background.ramp_at_px.x,
                           s.background.ramp_per_px.x, s.background.ramp_per_px.y,
                           s.sensor.blur_px,           s.sensor.noise,
                           s.sensor.motion_sigma_px,   s.sensor.motion_length_px,
                           s.sensor.motion_angle_rad,  s.sensor.light_k,
                           s.sensor.light_radius_px,   s.sensor.light_at_px.x,
                           s.probe.tip_px.x,           s.probe.root_px.x,
                           s.probe.half_width_px,      s.probe.grey,
                           s.drogue.wall_share,        s.drogue.tube_m,
                           s.drogue.texture,           s.drogue.texture_turn,
                           s.drogue.rim_radius_m,      s.drogue.inner_radius_m,
                           s.drogue.inner_depth_m,     s.drogue.coupling_radius_m,
                           s.look.wall_grey,           s.look.wall_rib_grey,
                           s.look.tube_grey,           s.look.shine_grey,
                           s.look.inner_grey,          s.look.ambient,
                           s.sensor.glare_grey,        s.sensor.glare_radius_px,
                           s.sensor.glare_at_px.x,     s.background.bottom_grey}) {
        add(v);
    }
    for (const int v : {s.drogue.wall_ribs, s.drogue.ribs, s.drogue.spokes, t.region.x, t.region.y, t.region.width}) {
        add(v);
    }
    for (const Patch &p : s.drogue.patches) {
        add(p.angle_rad + p.half_angle_rad);
        add(p.from_m + 10 * p.to_m);
    }
    for (const Clutter &c : s.background.clutter) {
        add(c.at_px.x + c.half_length_px + c.half_width_px);
        add(c.grey + c.soft_px);
    }
    return sum;
}

} // namespace accuracy
