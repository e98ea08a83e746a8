/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of whole tracks: small rendered sequences, from the search for the drogue to its loss and back. What a frame's parts
 * do has a reference in their own stages; these hold when each is called. */
#include <cmath>

#include "drogue/track.h"
#include "images.hpp"
#include "sky_scene.hpp"
#include "tiers.hpp"

namespace vectors {

namespace {

constexpr int WIDTH = 112, HEIGHT = 84;

int64_t q16(double v) { return static_cast<int64_t>(std::floor(v * 65536 + 0.5)); }

cv::Rect part() { return {1024 - WIDTH / 2, 1024 - HEIGHT / 2, WIDTH, HEIGHT}; }

cv::Mat blank() { return constant(WIDTH, HEIGHT, 215); }

struct Sequence {
    std::vector<cv::Mat> frames;
    accuracy::Camera camera = sky_scene(0, 0, 0, 0, 0, 0).camera.cropped(part().tl());
    cv::Rect first = {0, 0, 0, 0};
    int dt_us = 40000, room = 128, max_missed = 10, reconsider_frames = 50, known_frames = 25;
};

void add_sequence(Set &set, const std::string &name, Tier tier, const Flags &flags, const Sequence &s)
{
    const accuracy::Camera &c = s.camera;
    cv::Mat all;
    cv::vconcat(s.frames, all);
    set.add(name, tier, flags,
            {image_array("image", all),
             word_array("camera", 32, 16,
                        {q16(c.fx_px), q16(c.fy_px), q16(c.cx_px), q16(c.cy_px), q16(c.k1), q16(c.k2), q16(c.p1),
                         q16(c.p2), q16(c.k3)}),
             word_array("model", 32, 16, {q16(0.35), q16(0.12), q16(0.25)}),
             word_array("params", 32, 0,
                        {static_cast<int64_t>(s.frames.size()), s.dt_us, s.first.x, s.first.y, s.first.width,
                         s.first.height, s.room, 2000, 1200, 96, s.frames[0].cols, s.max_missed, s.reconsider_frames,
                         s.known_frames})});
}

/* The drogue comes nearer and drifts; frames from 'gone' to before 'back' are without it, after them it is 'aside' m off. */
Sequence approach(uint64_t seed, int frames, int gone, int back, double aside)
{
    Sequence s;
    for (int k = 0; k < frames; k++) {
        const double x = -0.1 + 0.012 * k + (k >= back ? aside : 0), z = 7 - 0.05 * k;
        const accuracy::Scene scene = sky_scene(seed + static_cast<uint64_t>(k), x, 0.04, z, 0.12, -0.08 + 0.01 * k);
        s.frames.push_back(k >= gone && k < back ? blank() : accuracy::render(scene, part()));
    }
    return s;
}

/* A drogue whose inner part does not show, and another beside it from a frame on. */
Sequence unresolved_then_another()
{
    Sequence s;
    for (int k = 0; k < 12; k++) {
        accuracy::Scene shy = sky_scene(70 + static_cast<uint64_t>(k), 0, 0, 8, 0.2, 0.1);
        accuracy::Scene other = sky_scene(90 + static_cast<uint64_t>(k), 8 * WIDTH / 500.0, 0.02, 8, -0.1, 0.2);
        cv::Rect beside = part();
        cv::Mat both;
        beside.x += WIDTH;
        shy.look.inner_grey = 110;
        shy.look.coupling_grey = 60;
        cv::hconcat(accuracy::render(shy, part()), k < 7 ? blank() : accuracy::render(other, beside), both);
        s.frames.push_back(both);
    }
    s.first = {28, 14, 56, 56};
    s.reconsider_frames = 3;
    s.known_frames = 5;
    return s;
}

} // namespace

Tiers follow_tier(const Arrays &, const Arrays &exact)
{
    return {unreferenced("follow", exact[0]), unreferenced("follow", exact[1])};
}

void add_follow(Set &set)
{
    set.begin("follow");
    add_sequence(set, "approach", Tier::ordinary, {}, approach(1, 12, 99, 99, 0));
    Sequence s = approach(20, 14, 4, 9, 0.15); /* lost after three frames, and found by a search of the frame */
    s.max_missed = 3;
    s.first = {14, 10, 84, 64};
    add_sequence(set, "lost-and-found", Tier::stress, {"missed-frames"}, s);
    s = approach(40, 14, 5, 11, 0.3); /* elsewhere, as far as it may have come */
    s.dt_us = 300000;
    add_sequence(set, "found-within-reach", Tier::stress, {"missed-frames"}, s);
    s = approach(60, 8, 99, 99, 0); /* the predicted region is wider */
    s.room = 60;
    add_sequence(set, "narrow-workspace", Tier::boundary, {"table-full"}, s);
    s.room = 40; /* and the rim, too */
    add_sequence(set, "workspace-narrower-than-the-rim", Tier::boundary, {"table-full"}, s);
    add_sequence(set, "reconsidered", Tier::stress, {"inner-missing", "twin-pose"}, unresolved_then_another());
}

} // namespace vectors
