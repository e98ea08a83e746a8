/* SPDX-License-Identifier: Apache-2.0 */
/* Sequences: the receiver closes in from 25 to 5 m at constant speed, the drogue swings in turbulence. */
#pragma once

#include <cstdint>
#include <string>

#include "drogue/types.h"
#include "scene.hpp"

namespace accuracy {

struct Approach {
    uint64_t seed;
    int index; /* turbulence light, moderate, severe in turn; conditions below in turn */
    int frames;
    double dt_s;

    /* Turbulence of this index: amplitude of the swing in x and y. */
    double amplitude_m() const;
    const char *turbulence() const;
    /* plain sky, plain ground, moving light (41), Gaussian motion blur, strong noise, probe before the rim. */
    const char *condition() const;

    double time_s(int frame) const { return frame * dt_s; }
    Pose pose(int frame) const;
    Scene scene(int frame) const;
    /* Where a detector would send the library: a square of side 2.5 semi-axes, off by up to 5 % of one. */
    cv::Rect region(int frame) const;
    drogue_model model() const;
};

constexpr double approach_from_m = 25;
constexpr double approach_to_m = 5;
constexpr int approach_conditions = 6;

} // namespace accuracy
