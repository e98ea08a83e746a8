/* SPDX-License-Identifier: Apache-2.0 */
/* The tracker in floating point: five filters of three states with whole covariance matrices, models side by side, gates
 * by the inverse of the summed covariance. */
#pragma once

#include <array>
#include <vector>

#include "reference.hpp"

#include "drogue/track.h"

namespace mirror {

using reference::Real;

using Five = std::array<Real, 5>; /* x y z pitch yaw */

struct Filter {
    struct Parameter {
        std::array<Real, 3> state = {};
        std::array<std::array<Real, 3>, 3> covariance = {};
    };
    std::array<Parameter, 5> parameter;
};

/* A frame's result: one of the two poses as the filter takes it. */
struct Measured {
    Five value = {}, std = {}, apart = {}, doubt = {};
    std::array<std::array<Real, 5>, 5> noise = {};
    bool solid = false;
};

class Tracker {
public:
    Tracker(const drogue_track_config &config, const drogue_camera &camera, const drogue_model &model,
            const drogue_region &first);
    drogue_region begin(uint32_t dt_us);
    void end(const drogue_result &result);

    /* as of drogue_track */
    drogue_track_state state = DROGUE_LOST;
    int missed = 0, open_frames = 0, turned = 0, trial = 0, agreeing = 0;
    bool gated = false, search = false, orientation_known = false, second_known = false;
    drogue_region reach = {};
    /* the estimate */
    Five value = {}, rate = {}, std = {};
    Real axis_std = 0;

private:
    void estimate(int ahead);
    Real wrong2(size_t p, int frames) const;
    void mix(int wider, Filter &out) const;
    bool place(drogue_region &region);
    drogue_region square(Real x, Real y, Real side) const;
    Measured read(const drogue_result &result, bool twin) const;
    void start(Filter &f, const Measured &m) const;
    void correct(Filter &f, const Measured &m) const;
    void follow(const Filter &f, bool known);
    void believe(const Measured &m);
    void keep_noise(const Measured &m);
    void miss();
    void refuse(const Measured &m, bool resolved);
    void unresolved(const Measured &pose, const Measured &twin);
    void resolved(const Measured &pose, const Measured &twin);
    Filter gate() const;

    drogue_track_config config_;
    drogue_camera camera_;
    drogue_model model_;
    drogue_region first_;
    std::array<Filter, DROGUE_BANK_MODELS> bank_;
    std::array<Five, DROGUE_BANK_MODELS> error2_ = {};
    std::array<size_t, 5> chosen_ = {};
    int weighed_ = 0;
    Filter second_;
    Five noise_ = {}, shake_ = {};
};

} // namespace mirror
