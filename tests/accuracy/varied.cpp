/* SPDX-License-Identifier: Apache-2.0 */
/* Draws the varied scenes. */
#include "varied.hpp"

#include <algorithm>
#include <cmath>

#include "measure.hpp"

namespace accuracy {

namespace {

constexpr const char *names[varieties] = {"plain",  "far",    "offset", "noise",   "spot", "blur", "probe",
                                          "tilted", "bright", "half",   "clutter", "ribs", "torus"};

cv::Point2d direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

double any_angle(Random &random) { return random.uniform(-CV_PI, CV_PI); }

int whole(Random &random, int low, int high) { return static_cast<int>(random.uniform(low, high + 1)); }

/* Shape and greys: a bright canopy, a wall behind it, the black disc, in one of three builds. */
void draw_drogue(Scene &s, Random &random, Variety variety, bool held_out)
{
    Drogue &d = s.drogue;
    Look &look = s.look;
    d.rim_radius_m = held_out ? random.uniform(0.25, 0.55) : 0.35;
    d.inner_radius_m = d.rim_radius_m * (held_out ? random.uniform(0.24, 0.4) : random.uniform(0.28, 0.38));
    d.coupling_radius_m = d.inner_radius_m * (held_out ? random.uniform(1.0, 1.3) : random.uniform(1.0, 1.2));
    d.inner_depth_m = d.rim_radius_m * (held_out ? random.uniform(0.45, 0.9) : random.uniform(0.55, 0.8));
    d.ribs = held_out ? whole(random, 12, 40) : whole(random, 20, 32);
    d.rib_share = random.uniform(0.15, held_out ? 0.4 : 0.3);
    d.rib_phase = random.uniform(0, 1);
    d.texture = random.uniform(0, held_out ? 0.16 : 0.1);
    d.texture_turn = any_angle(random);
    look.canopy_grey = random.uniform(held_out ? 140 : 160, 225);
    look.rib_gain = random.uniform(0.75, 1.1);
    look.depth_loss = random.uniform(0.05, 0.3);
    look.inner_grey = random.uniform(8, held_out ? 35 : 25);
    look.coupling_grey = random.uniform(60, 130);
    look.hose_grey = random.uniform(30, 110);
    const double build = random.uniform(0, 1);
    if (variety == Variety::ribs || (variety != Variety::torus && build < 0.25)) { /* dark ribs touch the disc */
        d.wall_share = random.uniform(0.8, 0.97);
        d.wall_ribs = whole(random, 8, held_out ? 24 : 16);
        d.rib_share = random.uniform(0.15, 0.4);
        look.wall_grey = random.uniform(60, 140);
        look.wall_rib_grey = look.inner_grey + random.uniform(0, 15);
        d.coupling_radius_m = d.inner_radius_m * random.uniform(1.0, 1.06);
    } else if (build < 0.8) { /* a wall whose edge is the canopy's inner one */
        d.wall_share = held_out ? random.uniform(0.66, 0.9) : random.uniform(0.7, 0.8);
        look.wall_grey = random.uniform(45, 110);
    }
    look.sun = draw_sun(random);
    look.ambient = random.uniform(0.6, 0.85);
}

void draw_background(Scene &s, Random &random, bool held_out)
{
    const int kind = whole(random, 0, 3);
    Background &b = s.background;
    b = kind == 0 ? Background::sky() : kind == 1 ? Background::cloud() : Background::ground();
    if (kind == 0) { /* a darker sky than the canopy */
        b.top_grey = random.uniform(90, 130);
        b.bottom_grey = b.top_grey + random.uniform(0, 40);
    } else if (kind == 3) {
        b.top_grey = random.uniform(20, 40);
        b.bottom_grey = b.top_grey;
    }
    b.texture_grey *= random.uniform(0.4, held_out ? 1.6 : 1.0);
    b.texture_px = random.uniform(24, 256);
    /* the rim must show: what is behind it differs from the canopy by 25 grey levels and more */
    const double most = std::max(b.top_grey, b.bottom_grey) + b.texture_grey;
    const double canopy = s.look.canopy_grey * s.look.ambient * std::min(1.0, s.look.rib_gain);
    if (most > canopy - 25) {
        const double less = most - (canopy - 25);
        b.top_grey = std::max(5.0, b.top_grey - less);
        b.bottom_grey = std::max(5.0, b.bottom_grey - less);
    }
}

/* A tube that shows before what is behind it, if only by 20 grey levels. */
void draw_tube(Scene &s, Random &random, bool held_out)
{
    const double behind = std::max(s.background.top_grey, s.background.bottom_grey);
    s.drogue.tube_m = s.drogue.rim_radius_m * random.uniform(0.02, held_out ? 0.06 : 0.05);
    s.look.tube_grey = (behind + random.uniform(20, 70)) / s.look.ambient;
    s.look.shine_grey = random.uniform(40, 160);
}

void draw_pose(Trial &t, Random &random, Variety variety, bool held_out)
{
    Scene &s = t.scene;
    const bool tilted = variety == Variety::tilted;
    const double tilt = (tilted ? random.uniform(30, 42) : random.uniform(2, 28)) * CV_PI / 180;
    const double low = variety == Variety::far ? 9 : held_out ? 28 : 35;
    const double high = variety == Variety::far ? 25 : held_out ? 170 : 140;
    const double a = low * std::pow(high / low, random.uniform(0, 1));
    if (held_out) {
        s.camera = {900, 910, 640, 355};
        s.image_px = {1280, 720};
    }
    const double distance = s.camera.fx_px * s.drogue.rim_radius_m / a;
    const double down = held_out ? random.uniform(-0.15, 0.15) : random.uniform(-0.25, 0.25);
    const cv::Point2d off(held_out ? random.uniform(-0.4, 0.4) : random.uniform(-0.25, 0.25), down);
    const double turn = any_angle(random);
    s.pose.position_m = distance * cv::Vec3d(off.x, off.y, 1);
    const cv::Vec3d sight = cv::normalize(s.pose.position_m);
    const cv::Vec3d e1 = cv::normalize(cv::Vec3d(sight[2], 0, -sight[0]));
    const cv::Vec3d e2 = sight.cross(e1);
    s.pose.axis = std::cos(tilt) * sight + std::sin(tilt) * (std::cos(turn) * e1 + std::sin(turn) * e2);
}

void add_probe(Trial &t, Random &random)
{
    const double a = t.rim.a_px;
    const Ellipse disc =
        project_circle(t.scene.camera, t.scene.pose, t.scene.drogue.inner_radius_m, t.scene.drogue.inner_depth_m);
    const cv::Point2d from = direction(any_angle(random));
    const cv::Point2d side(-from.y, from.x);
    const double reach = random.uniform(-0.3, 1.1); /* of the tip: over the disc where it is small */
    Probe &p = t.scene.probe;
    const cv::Point2d middle(disc.xc_px, disc.yc_px);
    p.tip_px = middle + random.uniform(-0.3, 0.3) * disc.a_px * side + (reach * disc.a_px) * from;
    p.root_px = middle + 6 * a * from + random.uniform(-1, 1) * a * side;
    p.half_width_px = random.uniform(0.05, 0.13) * a;
    p.grey = random.uniform(10, 70);
}

void add_spot(Trial &t, Random &random)
{
    Sensor &s = t.scene.sensor;
    const double a = t.rim.a_px;
    const cv::Point2d aside = direction(any_angle(random));
    s.glare_at_px = cv::Point2d(t.rim.xc_px, t.rim.yc_px) + random.uniform(0.5, 1.1) * a * aside;
    s.glare_radius_px = random.uniform(0.12, 0.35) * a;
    s.glare_grey = random.uniform(150, 350);
}

void add_half(Trial &t, Random &random)
{
    Look &look = t.scene.look;
    Background &b = t.scene.background;
    look.ambient = random.uniform(0.25, 0.4);
    const double ahead = random.uniform(-0.4, 0.1), down = random.uniform(-0.6, 0.2), sign = random.uniform(-1, 1);
    look.sun = cv::normalize(cv::Vec3d(std::copysign(random.uniform(0.6, 1), sign), down, ahead));
    b.top_grey = b.bottom_grey = look.canopy_grey * random.uniform(0.45, 0.6);
    b.texture_grey = random.uniform(6, 14);
    b.texture_px = random.uniform(60, 200);
}

void add_clutter(Trial &t, Random &random)
{
    const double a = t.rim.a_px;
    Background &b = t.scene.background;
    const cv::Point2d centre(t.rim.xc_px, t.rim.yc_px);
    const double horizon = random.uniform(-0.15, 0.15); /* slope */
    b.clutter.push_back({centre + cv::Point2d(0, (20 + random.uniform(-0.9, 0.9)) * a), 40 * a, 20 * a, horizon,
                         random.uniform(30, 110), false, 1.5});
    for (int i = whole(random, 2, 6); i > 0; i--) {
        const double size = random.uniform(0.1, 0.4) * a;
        const cv::Point2d aside = direction(any_angle(random));
        b.clutter.push_back({centre + random.uniform(0.9, 1.5) * a * aside, size, size * random.uniform(0.1, 1),
                             any_angle(random), random.uniform(5, 150), random.uniform(0, 1) < 0.5,
                             std::max(1.0, random.uniform(0, 0.1) * a)});
    }
    b.texture_grey = random.uniform(8, 22);
    b.texture_px = random.uniform(0.3, 1.5) * a;
}

void set_truth(Trial &t)
{
    const Drogue &d = t.scene.drogue;
    t.pose = t.scene.pose;
    t.rim = t.scene.rim();
    t.model = {to_q16(d.rim_radius_m), to_q16(d.inner_radius_m), to_q16(d.inner_depth_m)};
}

} // namespace

const char *name_of(Variety variety) { return names[static_cast<int>(variety)]; }

Trial varied_trial(uint64_t seed, Variety variety, int index, bool held_out)
{
    Trial t;
    t.condition = Condition::all;
    t.index = index;
    t.scene.seed = hash_at(seed, index, 3000 + static_cast<int>(variety) + (held_out ? 100 : 0));
    Random random(t.scene.seed);
    Scene &s = t.scene;
    draw_drogue(s, random, variety, held_out);
    draw_background(s, random, held_out);
    if (variety == Variety::torus) {
        draw_tube(s, random, held_out);
    }
    draw_pose(t, random, variety, held_out);
    s.sensor.blur_px = held_out ? random.uniform(0.4, 1.2) : random.uniform(0.5, 0.9);
    set_truth(t);
    switch (variety) {
    case Variety::noise: s.sensor.noise = 8; break;
    case Variety::spot: add_spot(t, random); break;
    case Variety::blur:
        s.sensor.motion_length_px = 9;
        s.sensor.motion_angle_rad = any_angle(random);
        break;
    case Variety::probe: add_probe(t, random); break;
    case Variety::bright:
        s.look.canopy_grey = 215 / s.look.ambient;
        s.look.rib_gain = random.uniform(0.97, 1.03);
        s.look.ambient = 1;
        s.look.canopy_grey = 215;
        s.drogue.texture *= 0.2;
        s.background = {205, 205, random.uniform(0, 3), 256, 3};
        break;
    case Variety::half: add_half(t, random); break;
    case Variety::clutter: add_clutter(t, random); break;
    default: break;
    }
    const double off = variety == Variety::offset ? 0.15 : 0.03;
    const double a = t.rim.a_px;
    const int side =
        static_cast<int>(std::lround((2.5 + (variety == Variety::offset ? random.uniform(-0.3, 0.3) : 0)) * a));
    const double x = t.rim.xc_px + off * a * random.uniform(-1, 1);
    const double y = t.rim.yc_px + off * a * random.uniform(-1, 1);
    t.region = cv::Rect(static_cast<int>(std::lround(x - (side - 1) / 2.0)),
                        static_cast<int>(std::lround(y - (side - 1) / 2.0)), side, side) &
               cv::Rect({0, 0}, s.image_px);
    return t;
}

} // namespace accuracy
