/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of the tracker: results of frames as they may come, without images. */
#include <array>
#include <cmath>
#include <functional>

#include "case.hpp"

#include "drogue/track.h"

namespace vectors {

namespace {

int64_t q16(double v) { return static_cast<int64_t>(std::floor(v * 65536 + 0.5)); }

using Five = std::array<double, 5>; /* x y z yaw pitch */

/* What a frame's result says. */
struct Seen {
    Five pose = {0.5, -0.3, 9, 0.2, -0.15};
    Five off_twin = {0.004, -0.003, 0.01, -0.5, 0.42}; /* the other pose less this one */
    int64_t dt_us = 40000, status = DROGUE_OK, look = DROGUE_SECOND_NONE, inner = 1, resolved = 1;
    double cover = 1;
    double doubt = 0;                                /* share of the distance */
    Five std = {0.0015, 0.0015, 0.02, 0.012, 0.011}; /* all 0: no covariance */
    double with_z = 0; /* correlation of x and y with z, of yaw and pitch with each other */
};

/* A track's configuration, camera, model and frames. */
struct Script {
    drogue_track_config config;
    std::vector<int64_t> camera = {q16(1465.5), q16(1465.5), q16(1023.5), q16(1023.5), 0, 0, 0, 0, 0};
    double rim = 0.35, inner = 0.12, depth = 0.25;
    std::array<int64_t, 4> first = {0, 0, 0, 0};
    Seen seen;
    std::vector<int64_t> frames, covariance;

    Script() { drogue_track_config_default(&config); }

    void put()
    {
        const Seen &s = seen;
        frames.insert(frames.end(), {s.dt_us, s.status, s.look, s.inner, s.resolved, q16(s.cover)});
        for (size_t k = 0; k < 5; k++) {
            frames.push_back(q16(s.pose[k]));
        }
        for (size_t k = 0; k < 5; k++) {
            frames.push_back(q16(s.pose[k] + s.off_twin[k]));
        }
        frames.push_back(q16(s.doubt));
        for (size_t i = 0; i < 5; i++) {
            for (size_t j = 0; j <= i; j++) {
                const bool together = (i == 2 && j < 2) || (i == 4 && j == 3);
                const double share = i == j ? 1 : together ? s.with_z : 0;
                const double apart = s.resolved != 0 || s.std[0] == 0 ? 0 : s.off_twin[i] * s.off_twin[j] / 2;
                const double doubted = s.std[0] == 0 ? 0 : doubted_by(i, j);
                covariance.push_back(static_cast<int64_t>(
                    std::floor(std::ldexp(share * s.std[i] * s.std[j] + apart + doubted, 48) + 0.5)));
            }
        }
    }

    /* What the inner part's size adds to an entry of the covariance. */
    double doubted_by(size_t i, size_t j) const
    {
        const double doubt = std::floor(seen.doubt * 65536 + 0.5) / 65536;
        const double along = i < 3 && j < 3 ? doubt * doubt * seen.pose[i] * seen.pose[j] / 2 : 0;
        return along + (i == j && i < 2 ? 2 * std::pow(doubt * doubt * rim, 2) : 0);
    }

    /* So many frames of a truth that moves, measured with noise of the given share of the deviations. */
    void follow(accuracy::Random &random, int count, const std::function<Five(double t)> &truth, double noise = 0.5)
    {
        for (int i = 0; i < count; i++) {
            const Five own = truth(static_cast<double>(seen.dt_us) * i / 1e6);
            const Five was = seen.pose;
            for (size_t k = 0; k < 5; k++) {
                seen.pose[k] = own[k] + noise * (seen.std[k] > 0 ? seen.std[k] : 0.002) * normal(random);
            }
            put();
            seen.pose = was;
        }
    }
    void stay(int count)
    {
        for (int i = 0; i < count; i++) {
            put();
        }
    }
    void miss(int count, int64_t status = DROGUE_E_NO_ELLIPSE)
    {
        const Seen was = seen;
        seen.status = status;
        stay(count);
        seen = was;
    }
};

void add_script(Set &set, const std::string &name, Tier tier, const Flags &flags, const Script &s)
{
    const drogue_track_config &c = s.config;
    std::vector<int64_t> setup = s.camera;
    setup.insert(setup.end(), {q16(s.rim), q16(s.inner), q16(s.depth)});
    setup.insert(setup.end(), s.first.begin(), s.first.end());
    std::vector<int64_t> config = {
        c.max_missed,      c.agree_frames,  c.reconsider_frames, c.known_frames,         c.min_region_px,
        c.max_region_px,   c.gate_q16,      c.position_gate_q16, c.region_scale_q16,     c.region_sigmas_q16,
        c.lateral_std_q16, c.depth_std_q16, c.angle_std_rad_q16, c.position_floor_m_q16, c.angle_floor_rad_q16};
    config.insert(config.end(), c.process_std_q16, c.process_std_q16 + 5);
    config.insert(config.end(), {c.process_step_q16, c.lasting_share_q16, c.start_rate_std_q16, c.start_accel_std_q16});
    set.add(name, tier, flags,
            {word_array("setup", 32, 16, setup), word_array("config", 32, 16, config),
             word_array("frames", 32, 16, s.frames), word_array("covariance", 64, 48, s.covariance)});
}

Five approach(double t) { return {0.5 + 0.3 * std::sin(1.2 * t), -0.3 + 0.1 * t, 9 - 0.7 * t, 0.2 + 0.1 * t, -0.15}; }

void add_following(Set &set)
{
    accuracy::Random random = set.random("following");
    Script s;
    s.follow(random, 20, approach);
    add_script(set, "approach", Tier::ordinary, {}, s);
    s = Script();
    s.seen.with_z = 0.95;
    s.follow(random, 14, approach, 1);
    add_script(set, "errors-go-with-z", Tier::ordinary, {}, s);
    s = Script();
    s.seen.std = {0, 0, 0, 0, 0};
    s.follow(random, 8, approach);
    add_script(set, "no-covariance", Tier::ordinary, {}, s);
    s = Script();
    s.follow(random, 34, [](double t) { /* calm, then a gust */
                                        return Five{t < 0.6 ? 0.2 : 0.2 + 2.5 * (t - 0.6) * (t - 0.6), 0.1, 6,
                                                    t < 0.7 ? 0.1 : 0.1 + 0.4 * std::sin(9 * (t - 0.7)), 0};
    });
    add_script(set, "gust", Tier::ordinary, {}, s);
    s = Script();
    s.seen.dt_us = 20000;
    s.follow(
        random, 14,
        [](double t) {
            return Five{0, 0, 7, 3.1 + 0.3 * t, 0.1};
        },
        0.2);
    add_script(set, "angle-wrap", Tier::boundary, {"angle-wrap"}, s);
    s = Script();
    s.camera = {q16(1200), q16(1195),   q16(1023.5),  q16(1023.5), q16(-0.32),
                q16(0.12), q16(0.0008), q16(-0.0005), q16(-0.02)};
    s.follow(random, 6, [](double t) { return Five{3 + t, 2 - t, 9, 0.1, 0.1}; });
    add_script(set, "lens", Tier::ordinary, {"barrel"}, s);
    s = Script();
    for (const int64_t dt : {40000, 1, 1000, 400000, 40000, 2000000, 40000, 15000000, 40000}) {
        s.seen.dt_us = dt;
        s.stay(2);
    }
    add_script(set, "time-steps", Tier::stress, {"time-step"}, s);
    s = Script();
    s.inner = 0;
    s.seen.inner = s.seen.resolved = 0;
    s.follow(random, 8, approach);
    add_script(set, "inner-unknown", Tier::ordinary, {"inner-missing"}, s);
    s = Script();
    for (const double share : {0.0, 1.0}) { /* of a measurement's variance that lasts */
        s.config.lasting_share_q16 = static_cast<int32_t>(q16(share));
        s.frames.clear();
        s.covariance.clear();
        s.stay(4);
        add_script(set, share > 0 ? "all-lasts" : "nothing-lasts", Tier::boundary, {"threshold-met"}, s);
    }
    s = Script();
    s.config.process_step_q16 = static_cast<int32_t>(q16(1.37));
    s.follow(random, 10, approach);
    add_script(set, "small-step", Tier::ordinary, {}, s);
    s = Script();
    s.seen.std = {0.00002, 0.00002, 0.00002, 0.00002, 0.00002}; /* below the floors */
    s.follow(random, 8, [](double) { return Five{0.1, 0.2, 5, 0.1, 0}; });
    add_script(set, "sharper-than-the-floors", Tier::boundary, {}, s);
    s = Script();
    s.seen.dt_us = 20000;
    const auto shaken = [](double t) { /* a camera that turns by 5 mrad */
                                       return Five{0.06 * std::sin(55 * t), 0.05 * std::sin(41 * t), 12 - t,
                                                   0.1 + 0.005 * std::sin(55 * t), 0};
    };
    s.follow(random, 24, shaken);
    s.miss(3);
    s.follow(random, 6, shaken);
    add_script(set, "camera-shakes", Tier::stress, {"missed-frames"}, s);
}

/* A disc that is not of its size: doubted are all frames, some, or by more than the covariance has. */
void add_doubted(Set &set)
{
    accuracy::Random random = set.random("doubted");
    Script s;
    s.seen.doubt = 0.09;
    s.seen.with_z = 0.9;
    s.follow(random, 20, approach);
    add_script(set, "doubted", Tier::ordinary, {}, s);
    s = Script();
    for (const double doubt : {0.0, 0.02, 0.14, 0.0, 0.999}) {
        s.seen.doubt = doubt;
        s.follow(random, 4, [](double) { return Five{0.5, -0.3, 9, 0.2, -0.15}; });
    }
    add_script(set, "doubt-changes", Tier::ordinary, {}, s);
    s = Script();
    s.seen.doubt = 0.05;
    s.seen.resolved = 0;
    s.stay(4);
    s.seen.resolved = 1;
    s.stay(2);
    s.seen.resolved = 0;
    s.seen.off_twin = {0.002, 0.001, -0.003, 0.01, 0.02};
    s.stay(4);
    add_script(set, "doubted-unresolved", Tier::ordinary, {"twin-pose"}, s);
    s = Script();
    s.seen.doubt = 0.05;
    s.stay(4);
    for (int64_t &c : s.covariance) { /* less than the doubt: it does not hold that */
        c /= 4;
    }
    s.stay(3);
    add_script(set, "doubt-not-held", Tier::boundary, {}, s);
}

void add_missing(Set &set)
{
    accuracy::Random random = set.random("missing");
    Script s;
    s.miss(2, DROGUE_E_NO_EDGES);
    s.follow(random, 6, approach);
    s.miss(3);
    s.stay(2);
    s.miss(10, DROGUE_E_UNSURE); /* as many as are borne */
    s.stay(2);
    s.miss(12); /* lost with the eleventh */
    s.stay(2);
    add_script(set, "coasting-and-lost", Tier::ordinary, {"missed-frames"}, s);
    s = Script();
    s.first = {700, 650, 300, 300};
    s.config.max_missed = 0;
    s.miss(1);
    s.stay(3);
    s.miss(2);
    s.stay(2);
    add_script(set, "first-region", Tier::boundary, {"missed-frames"}, s);
    s = Script();
    s.follow(
        random, 10,
        [](double t) {
            return Five{0, 0, 1.5 - 3.5 * t, 0, 0};
        },
        0.1);
    s.miss(8); /* the prediction passes the camera */
    s.stay(2);
    add_script(set, "past-the-camera", Tier::stress, {"behind-camera", "missed-frames"}, s);
    s = Script();
    s.config.min_region_px = 150;
    s.config.max_region_px = 180;
    s.follow(random, 6, [](double t) { return Five{0, 0, 12 - 30 * t, 0, 0}; });
    s.miss(3);
    add_script(set, "region-limits", Tier::boundary, {"threshold-met"}, s);
    s = Script();
    s.config.region_scale_q16 = static_cast<int32_t>(q16(3));
    s.config.region_sigmas_q16 = static_cast<int32_t>(q16(1.5));
    s.config.start_accel_std_q16 = static_cast<int32_t>(q16(3));
    s.stay(3);
    s.miss(9); /* the region grows, then the drogue may be anywhere */
    add_script(set, "region-grows", Tier::ordinary, {"missed-frames"}, s);
}

void add_gates(Set &set)
{
    accuracy::Random random = set.random("gates");
    const auto steady = [&random](Script &s, int count = 6) {
        s.follow(random, count, [](double) { return Five{0.5, -0.3, 9, 0.2, -0.15}; });
    };
    const auto jump = [](Script &s, double x, double z) {
        s.seen.pose[0] += x;
        s.seen.pose[2] += z;
    };
    Script s;
    steady(s);
    jump(s, 0.8, 0);
    s.stay(1); /* one outlier */
    jump(s, -0.8, 0);
    s.stay(2);
    jump(s, 0.8, 0.2);
    s.stay(3); /* one less than believed */
    jump(s, -0.8, -0.2);
    s.stay(2);
    jump(s, 0.9, 0);
    s.stay(2);
    s.miss(2); /* not counted */
    s.stay(4); /* believed with the fourth */
    add_script(set, "jumps", Tier::ordinary, {"threshold-met"}, s);
    s = Script();
    steady(s);
    for (int i = 0; i < 14; i++) { /* no two agree: the last one begins anew */
        const double to = i % 2 == 0 ? 1.5 : -1.5;
        jump(s, to, 0);
        s.stay(1);
        jump(s, -to, 0);
    }
    add_script(set, "jumps-that-disagree", Tier::stress, {"threshold-met"}, s);
    s = Script();
    steady(s);
    jump(s, 0.25, 0); /* near: one region holds both predictions */
    s.seen.resolved = 0;
    s.stay(3);
    s.seen.resolved = 1;
    s.stay(2);
    add_script(set, "jump-nearby", Tier::ordinary, {"twin-pose"}, s);
    s = Script();
    steady(s);
    jump(s, 0.9, 0);
    s.seen.inner = s.seen.resolved = 0; /* without its inner part it opens no second filter */
    s.stay(11);
    add_script(set, "jump-without-inner", Tier::stress, {"inner-missing"}, s);
    for (const double share : {0.04, 0.048, 0.052, 0.07}) { /* of the range: a twentieth is believed */
        s = Script();
        s.seen.std = {0.01, 0.01, 0.4, 0.02, 0.02};
        steady(s, 4);
        s.seen.inner = s.seen.resolved = 0;
        s.seen.pose[2] = 9 * (1 + share);
        s.stay(1);
        s.seen.pose[2] = 9 * (1 - share);
        s.stay(1);
        add_script(set, "range-off-" + std::to_string(static_cast<int>(share * 1000)), Tier::boundary,
                   {"threshold-met"}, s);
    }
    for (const int shown : {0, 1}) { /* what began with an inner part must show it again within five */
        s = Script();
        s.stay(1);
        s.seen.inner = s.seen.resolved = 0;
        s.stay(3);
        s.seen.inner = shown;
        s.stay(1);
        s.seen.inner = 0;
        s.stay(4);
        add_script(set, shown != 0 ? "trial-passed" : "trial-failed", Tier::boundary,
                   {"inner-missing", "threshold-met"}, s);
    }
    s = Script();
    s.config.agree_frames = 1;
    steady(s, 5);
    jump(s, 0.8, 0);
    s.stay(2);
    add_script(set, "one-agrees", Tier::boundary, {"threshold-met"}, s);
    for (const double off : {3.5, 3.8, 4.2, 4.6, 6.0}) { /* about the gate, in deviations of y alone */
        s = Script();
        s.config.depth_std_q16 = 0;
        s.seen.std = {0.05, 0.05, 0.05, 0.05, 0.05};
        steady(s, 6);
        s.seen.pose[1] += 0.05 * off * 1.3;
        s.seen.resolved = 0;
        s.stay(1);
        add_script(set, "gate-" + std::to_string(static_cast<int>(10 * off)), Tier::boundary, {"threshold-met"}, s);
    }
    s = Script();
    s.seen.with_z = 1.4; /* no covariance can be so: its diagonal counts */
    steady(s, 8);
    add_script(set, "covariance-impossible", Tier::stress, {"covariance-loss", "domain"}, s);
    s = Script();
    s.seen.with_z = 0.99;
    s.config.depth_std_q16 = 0;
    steady(s, 8);
    s.seen.pose[0] += 0.004; /* near for each alone, far for both together */
    s.seen.pose[2] -= 0.03;
    s.stay(3);
    add_script(set, "correlation-gates", Tier::stress, {}, s);
    for (const int look : {1, 2, 3, 4, 5, 6}) { /* a cut outline counts for less */
        s = Script();
        steady(s, 5);
        s.seen.look = look;
        s.seen.cover = 0.5;
        s.seen.pose[0] += 0.06;
        s.stay(2);
        add_script(set, "cut-look-" + std::to_string(look), Tier::ordinary, {"arc"}, s);
    }
}

void add_twins(Set &set)
{
    accuracy::Random random = set.random("twins");
    const auto steady = [&random](Script &s, int count) {
        s.follow(
            random, count,
            [](double) {
                return Five{0.5, -0.3, 9, 0.2, -0.15};
            },
            0.3);
    };
    const auto turn = [](Script &s) { /* the result has chosen the other pose */
                                      for (size_t k = 0; k < 5; k++) {
                                          s.seen.pose[k] += s.seen.off_twin[k];
                                          s.seen.off_twin[k] = -s.seen.off_twin[k];
                                      }
    };
    Script s;
    steady(s, 8);
    turn(s);
    s.stay(3); /* gives way to its twin */
    turn(s);
    s.stay(2);
    turn(s);
    s.stay(6); /* the fourth is believed, the angles start anew */
    add_script(set, "turned", Tier::ordinary, {"twin-pose"}, s);
    s = Script();
    s.seen.resolved = 0;
    s.stay(4); /* begins unknown */
    s.seen.resolved = 1;
    turn(s);
    s.stay(3); /* the position alone agrees: the orientation is this */
    s.seen.pose[3] += 0.9;
    s.seen.resolved = 0;
    s.stay(2);
    add_script(set, "unknown-then-known", Tier::ordinary, {"twin-pose"}, s);
    s = Script();
    s.seen.resolved = 0;
    s.stay(5);
    s.seen.resolved = 1;
    s.seen.pose[0] += 0.9; /* neither the angles nor the position */
    s.seen.pose[3] += 1;
    s.stay(2);
    add_script(set, "unknown-and-elsewhere", Tier::stress, {"twin-pose"}, s);
    for (const double off : {3.4, 3.7, 4.0, 4.3, 4.6, 5.0}) { /* unknown: the position's own gate */
        for (const int z : {0, 1}) {
            s = Script();
            s.config.depth_std_q16 = 0;
            s.seen.std = {0.05, 0.05, 0.05, 0.05, 0.05};
            s.seen.resolved = 0;
            s.stay(2);
            s.seen.resolved = 1;
            s.seen.pose[z != 0 ? 2 : 0] += 0.075 * off;
            s.seen.pose[3] += 2;
            s.stay(1);
            add_script(set, "position-" + std::to_string(static_cast<int>(10 * off)) + (z != 0 ? "-deep" : ""),
                       Tier::boundary, {"twin-pose", "threshold-met"}, s);
        }
    }
    s = Script();
    steady(s, 4);
    s.seen.pose[0] += 0.9;
    s.stay(1);
    s.seen.resolved = 0;
    s.stay(3); /* refused ones that agree: the first was resolved */
    add_script(set, "jump-resolved-first", Tier::ordinary, {"twin-pose"}, s);
    s = Script();
    s.seen.off_twin = {0.02, 0.01, 0.03, 0.02, 0.01}; /* nearer than the deviations: no part of a resolved covariance */
    s.seen.std = {0.05, 0.05, 0.08, 0.05, 0.05};
    s.stay(4);
    add_script(set, "twin-near-resolved", Tier::boundary, {"twin-pose"}, s);
    s = Script();
    s.seen.off_twin = {0, 0, 0, -0.5, 0.42};
    s.seen.with_z = 0.97;
    s.seen.std = {0.0015, 0.0015, 0.02, 0.04, 0.04};
    steady(s, 4);
    turn(s);
    s.seen.off_twin[3] += 0.09; /* against the correlation, which the twin's angles do not have */
    s.seen.off_twin[4] -= 0.09;
    s.stay(2);
    add_script(set, "turned-against-correlation", Tier::stress, {"twin-pose"}, s);
    s = Script();
    s.stay(3);
    for (size_t i = 2; i < s.covariance.size(); i += 15) {
        s.covariance[i] = -s.covariance[i]; /* y: no variance can be so */
    }
    add_script(set, "variance-negative", Tier::stress, {"covariance-loss", "domain"}, s);
    s = Script();
    s.inner = 0;
    s.seen.inner = s.seen.resolved = 0;
    s.stay(3);
    s.seen.pose[0] += 0.9;
    s.stay(5); /* no inner part to be shown: it is followed */
    add_script(set, "jump-inner-unknown", Tier::ordinary, {"inner-missing"}, s);
    s = Script();
    s.config.known_frames = 4;
    steady(s, 6);
    s.seen.resolved = 0;
    s.stay(6); /* what is known expires with the fourth */
    s.seen.resolved = 1;
    s.stay(2);
    add_script(set, "known-expires", Tier::boundary, {"twin-pose", "threshold-met"}, s);
    s = Script();
    s.config.known_frames = 0;
    steady(s, 4);
    s.seen.resolved = 0;
    s.stay(8);
    add_script(set, "known-for-good", Tier::boundary, {"twin-pose"}, s);
    s = Script();
    steady(s, 5);
    s.seen.resolved = 0;
    turn(s);
    s.stay(4); /* unresolved, named the other way round: the nearer counts */
    add_script(set, "unresolved-turned", Tier::ordinary, {"twin-pose"}, s);
    for (const double apart : {0.03, 0.09, 0.12, 0.18}) { /* the twin nearer and nearer to the gate */
        s = Script();
        s.seen.off_twin = {0, 0, 0, -apart, apart};
        steady(s, 6);
        s.seen.resolved = 0;
        s.stay(3);
        add_script(set, "twin-at-" + std::to_string(static_cast<int>(1000 * apart)), Tier::boundary,
                   {"twin-pose", "threshold-met"}, s);
    }
    s = Script();
    s.seen.with_z = 0.9; /* the twin's own angles are not known to go together, its position is */
    steady(s, 6);
    turn(s);
    s.stay(3);
    add_script(set, "turned-correlated", Tier::stress, {"twin-pose"}, s);
    s = Script();
    s.seen.off_twin = {0.01, 0.02, -0.03, 0.2, 0.15};
    s.seen.resolved = 0;
    s.stay(4);
    for (int64_t &c : s.covariance) { /* less than what lies between the poses: it does not hold that */
        c /= 4;
    }
    s.stay(3);
    add_script(set, "spread-not-held", Tier::boundary, {"twin-pose"}, s);
}

void add_refusals(Set &set)
{
    const std::pair<const char *, std::function<void(drogue_track_config &)>> bad[] = {
        {"no-agree-frames", [](auto &c) { c.agree_frames = 0; }},
        {"step-below-one", [](auto &c) { c.process_step_q16 = 65535; }},
        {"share-above-one", [](auto &c) { c.lasting_share_q16 = 65537; }},
        {"regions-crossed", [](auto &c) { c.min_region_px = c.max_region_px + 1; }},
        {"gate-negative", [](auto &c) { c.gate_q16 = -1; }}};
    for (const auto &[name, spoil] : bad) {
        Script s;
        spoil(s.config);
        s.stay(1);
        add_script(set, name, Tier::must_reject, {"argument"}, s);
    }
}

} // namespace

void add_track(Set &set)
{
    set.begin("track");
    add_following(set);
    add_doubted(set);
    add_missing(set);
    add_gates(set);
    add_twins(set);
    add_refusals(set);
}

} // namespace vectors
