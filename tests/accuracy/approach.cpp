/* SPDX-License-Identifier: Apache-2.0 */
/* Draws the frames of an approach: each is a function of seed, index and frame alone. */
#include "approach.hpp"
#include "plain.hpp"

#include <cmath>

#include "measure.hpp"

namespace accuracy {

namespace {

enum : int64_t { of_track = -1, of_frame_region = -2 };

/* One swinging quantity. */
struct Swing {
    double amplitude, hertz, phase;
    double at(double t) const { return amplitude * std::sin(2 * CV_PI * hertz * t + phase); }
};

struct Motion {
    cv::Vec2d aim; /* tangents of the direction in which the drogue hangs, seen from the camera */
    Swing x, y;
    double yaw, pitch; /* means, rad */
    Swing yaw_swing, pitch_swing;
};

Swing draw_swing(Random &random, double amplitude)
{
    const double hertz = random.uniform(0.15, 0.2);
    return {amplitude, hertz, random.uniform(-CV_PI, CV_PI)};
}

Motion draw_motion(const Approach &a)
{
    const double degree = CV_PI / 180;
    Random random(hash_at(a.seed, of_track, a.index));
    Motion m;
    m.aim = {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
    m.x = draw_swing(random, a.amplitude_m());
    m.y = draw_swing(random, a.amplitude_m());
    m.yaw = random.uniform(-8, 8) * degree;
    m.pitch = random.uniform(-8, 8) * degree;
    m.yaw_swing = draw_swing(random, random.uniform(2, 8) * degree);
    m.pitch_swing = draw_swing(random, random.uniform(2, 8) * degree);
    return m;
}

int condition_of(const Approach &a) { return a.index % approach_conditions; }

} // namespace

double Approach::amplitude_m() const
{
    const double level[3] = {0.1, 0.5, 1.1};
    return level[index % 3];
}

const char *Approach::turbulence() const
{
    const char *const level[3] = {"light", "moderate", "severe"};
    return level[index % 3];
}

const char *Approach::condition() const
{
    const char *const name[approach_conditions] = {"plain, sky",           "plain, ground", "moving light (41)",
                                                   "Gaussian motion blur", "strong noise",  "probe before the rim"};
    return name[condition_of(*this)];
}

Pose Approach::pose(int frame) const
{
    const Motion m = draw_motion(*this);
    const double t = time_s(frame);
    const double z = approach_from_m + (approach_to_m - approach_from_m) * frame / std::max(1, frames - 1);
    return {{m.aim[0] * z + m.x.at(t), m.aim[1] * z + m.y.at(t), z},
            axis_of(m.yaw + m.yaw_swing.at(t), m.pitch + m.pitch_swing.at(t))};
}

Scene Approach::scene(int frame) const
{
    Random random(hash_at(seed, of_track, index + 1000));
    Scene s;
    s.seed = hash_at(seed, index, frame); /* noise and texture anew */
    s.pose = pose(frame);
    s.drogue.rib_phase = random.uniform(0, 1);
    s.look.sun = draw_sun(random);
    s.sensor.blur_px = random.uniform(0.5, 0.9);
    const Ellipse rim = s.rim();
    const cv::Point2d centre(rim.xc_px, rim.yc_px);
    const double side = random.uniform(-CV_PI, CV_PI);
    const double sun_turn = random.uniform(-CV_PI, CV_PI);
    const cv::Vec3d sun = s.look.sun;
    switch (condition_of(*this)) {
    case 0: break;
    case 1:
        s.look = Look::bright();
        s.background = Background::ground();
        break;
    case 2: { /* the light wanders round the drogue, its brightness changes */
        const double turn = sun_turn + 2 * CV_PI * 0.1 * time_s(frame);
        s.background = Background::cloud();
        s.sensor.light_at_px = centre + 1.5 * rim.a_px * cv::Point2d(std::cos(turn), std::sin(turn));
        s.sensor.light_radius_px = 5 * rim.a_px;
        s.sensor.light_k = 1.1 + 0.25 * std::sin(2 * turn);
        break;
    }
    case 3:
        s.look = Look::bright();
        s.background = Background::cloud();
        s.sensor.motion_sigma_px = std::min(2.0, 0.06 * rim.a_px);
        break;
    case 4: s.sensor.noise = 6; break;
    default: { /* a rod from one side, its tip over the rim */
        const cv::Point2d from(std::cos(side), std::sin(side));
        s.background = Background::cloud();
        s.probe = {centre + 0.7 * rim.a_px * from, centre + 6 * rim.a_px * from, 0.1 * rim.a_px, 150};
        break;
    }
    }
    s.look.sun = sun;
    return s;
}

cv::Rect Approach::region(int frame) const
{
    const Ellipse rim = project_circle(Scene().camera, pose(frame), Drogue().rim_radius_m, 0);
    Random random(hash_at(seed, of_frame_region, index * 100000 + frame));
    const int side = static_cast<int>(std::lround(2.5 * rim.a_px));
    const double x = rim.xc_px + 0.05 * rim.a_px * random.uniform(-1, 1);
    const double y = rim.yc_px + 0.05 * rim.a_px * random.uniform(-1, 1);
    return {static_cast<int>(std::lround(x - (side - 1) / 2.0)), static_cast<int>(std::lround(y - (side - 1) / 2.0)),
            side, side};
}

drogue_model Approach::model() const
{
    const Drogue d;
    return {to_q16(d.rim_radius_m), to_q16(d.inner_radius_m), to_q16(d.inner_depth_m)};
}

} // namespace accuracy
