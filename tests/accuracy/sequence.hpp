/* SPDX-License-Identifier: Apache-2.0 */
/* Rendered sequences: a receiver that closes in at constant speed on a drogue that swings as in turbulence, through
 * the library's tracker frame by frame. */
#pragma once

#include <functional>
#include <vector>

#include "drogue/track.h"
#include "measure.hpp"
#include "scene.hpp"

namespace accuracy {

/* Swing of a drogue on its hose: x at 0.2 Hz with the amplitude, y at 0.15 Hz with seven tenths of it, and the
 * hose's angle turns the axis along. */
struct Motion {
    double amplitude_m = 0.5;
    double from_m = 25; /* distance at time 0 */
    double to_m = 4;    /* where the approach stops; with 'shuttle' a swing between the two, speed its peak */
    double speed_mps = 1.5;
    bool shuttle = false;
    double phase_rad = 0;

    Pose at(double seconds) const;
    double approach_seconds() const { return (from_m - to_m) / speed_mps; }
};

struct SequenceOptions {
    Motion motion;
    Scene scene; /* its pose is set frame by frame */
    double frames_per_second = 25;
    int frames = 100;
    double blanked_share = 0; /* of the frames, at random: nothing but background in them */
    uint64_t seed = 1;
    std::function<void(size_t, size_t)> progress;
};

struct SequenceFrame {
    double seconds;
    Pose truth;
    bool blanked;
    bool measured; /* the library gave a pose */
    drogue_track_state state;
    bool gated;
    Pose raw;                        /* meaningful when measured */
    Pose filtered;                   /* meaningful unless lost */
    cv::Vec<double, 5> filtered_std; /* x, y, z, yaw, pitch */
};

struct SequenceRun {
    std::vector<SequenceFrame> frames;
    std::vector<drogue_result> results; /* of each frame */
    int losses = 0;                     /* times that a track which had begun was lost */
};

/* Run from a whole-frame search on. Only what the tracker looks at is rendered. */
SequenceRun run_sequence(const SequenceOptions &options);

/* x, y, z in metres, yaw, pitch in radians: estimate less truth. */
cv::Vec<double, 5> pose_error(const Pose &estimate, const Pose &truth);

/* Root mean square of raw and filtered errors over the frames after 'settle' that were measured, tracked and not
 * refused. A raw pose whose orientation was mistaken counts as it is. */
struct SequenceErrors {
    cv::Vec<double, 5> raw, filtered;
    int frames = 0;
};
SequenceErrors sequence_errors(const SequenceRun &run, int settle);

} // namespace accuracy
