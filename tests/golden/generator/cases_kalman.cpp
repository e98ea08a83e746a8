/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of the filter: two long runs, and short ones about time steps, missed frames, wrapping angles, lost covariance. */
#include <array>
#include <cmath>
#include <functional>

#include "case.hpp"

namespace vectors {

namespace {

int64_t q16(double v) { return static_cast<int64_t>(std::floor(v * 65536 + 0.5)); }

using Five = std::array<double, 5>; /* x y z pitch yaw */

struct Run {
    int64_t dt_us = 33333;
    Five process = {0.2, 0.2, 0.2, 0.2, 0.2};
    Five start_std = {0.005, 0.005, 0.02, 0.02, 0.02};
    double rate_std = 2, acceleration_std = 2;
    Five std = {0.005, 0.005, 0.02, 0.02, 0.02}; /* of the measurements */
    double noise = 1;                            /* share of std */
    int frames = 40;
    std::function<Five(double t)> truth = [](double t) {
        return Five{0.1 + 0.2 * std::sin(t), -0.3 + 0.1 * t, 12 - 0.4 * t, 0.05 * std::cos(2 * t), -0.1 + 0.02 * t};
    };
    std::function<bool(int frame)> missed = [](int) { return false; };
};

/* An angle within [-pi, pi), as a measurement gives it. */
double wrapped(double angle) { return angle - 2 * CV_PI * std::floor((angle + CV_PI) / (2 * CV_PI)); }

void add_run(Set &set, const std::string &name, Tier tier, const Flags &flags, const Run &run)
{
    accuracy::Random random = set.random(name);
    const auto measured = [&](double t) {
        Five v = run.truth(t);
        for (size_t k = 0; k < 5; k++) {
            v[k] += run.noise * run.std[k] * normal(random);
            v[k] = k > 2 ? wrapped(v[k]) : v[k];
        }
        return v;
    };
    std::vector<int64_t> params = {run.dt_us};
    std::vector<int64_t> frames;
    for (const double s : run.process) {
        params.push_back(q16(s));
    }
    for (const double s : run.start_std) {
        params.insert(params.end(), {q16(s), q16(run.rate_std), q16(run.acceleration_std)});
    }
    for (const double v : measured(0)) {
        params.push_back(q16(v));
    }
    for (int i = 1; i <= run.frames; i++) {
        for (const double v : measured(static_cast<double>(run.dt_us) * i / 1e6)) {
            frames.push_back(std::clamp<int64_t>(q16(v), INT32_MIN, INT32_MAX));
        }
        for (const double s : run.std) {
            frames.push_back(run.missed(i) ? 0 : std::max<int64_t>(1, q16(s)));
        }
    }
    set.add(name, tier, flags, {word_array("params", 32, 16, params), word_array("frames", 32, 16, frames)});
}

} // namespace

void add_kalman(Set &set)
{
    set.begin("kalman");
    Run run;
    run.frames = 1000;
    add_run(set, "run-1000", Tier::ordinary, {"long-run"}, run);
    run.missed = [](int i) { return i % 97 > 85; };
    run.dt_us = 20000;
    run.truth = [](double t) {
        return Five{0.5 * std::sin(1.3 * t), 0.2 * std::cos(0.7 * t), 20 - 0.8 * t, 0.2 * std::sin(0.4 * t),
                    3.0 + 0.3 * t};
    };
    add_run(set, "run-1000-missed-wrapping", Tier::stress, {"long-run", "missed-frames", "angle-wrap"}, run);

    run = Run();
    add_run(set, "steady", Tier::ordinary, {}, run);
    run.noise = 0;
    run.truth = [](double) { return Five{1, -1, 8, 0.125, -0.125}; };
    add_run(set, "constant", Tier::boundary, {"degenerate"}, run);
    run.process = {0, 0, 0, 0, 0};
    add_run(set, "no-process-noise", Tier::stress, {"covariance-loss"}, run);
    run.rate_std = run.acceleration_std = 0;
    run.start_std = {0, 0, 0, 0, 0};
    add_run(set, "no-uncertainty", Tier::boundary, {"covariance-loss", "degenerate"}, run);
    run = Run();
    run.start_std = {100, 100, 1000, 3, 3};
    run.std = {0.00002, 0.00002, 0.00002, 0.00002, 0.00002};
    run.rate_std = run.acceleration_std = 1000;
    add_run(set, "sharp-after-vague", Tier::stress, {"covariance-loss"}, run);
    run.std = {3000, 3000, 30000, 900, 900};
    run.noise = 0.0001;
    add_run(set, "vague-measurements", Tier::stress, {"saturation"}, run);
    run = Run();
    run.dt_us = 1;
    add_run(set, "step-one-microsecond", Tier::boundary, {"time-step"}, run);
    run.dt_us = 2000000;
    add_run(set, "step-two-seconds", Tier::ordinary, {"time-step"}, run);
    run.dt_us = 2147483647;
    run.frames = 3;
    run.truth = [](double) { return Five{0, 0, 9, 0, 0}; };
    add_run(set, "step-longest", Tier::stress, {"time-step", "saturation"}, run);
    run = Run();
    run.missed = [](int i) { return i > 12; };
    add_run(set, "lost-for-good", Tier::ordinary, {"missed-frames"}, run);
    run.missed = [](int) { return true; };
    add_run(set, "never-measured", Tier::boundary, {"missed-frames"}, run);
    run = Run();
    run.noise = 0.3;
    run.dt_us = 100000;
    run.truth = [](double t) { return Five{0, 0, 9, 3.1 + 0.2 * t, -3.1 - 0.25 * t}; };
    add_run(set, "angle-wrap", Tier::boundary, {"angle-wrap"}, run);
    run.truth = [](double t) { return Five{0, 0, 9, -3.0 - 0.4 * t, 3.0 + 0.4 * t}; };
    add_run(set, "angle-wrap-back", Tier::boundary, {"angle-wrap"}, run);
    run = Run();
    run.frames = 12;
    run.truth = [](double t) { return Five{32000 + 9000 * t, -32000 - 9000 * t, 32767, 1, -1}; };
    run.process = {30000, 30000, 30000, 3, 3};
    run.rate_std = 20000;
    add_run(set, "beyond-format", Tier::stress, {"saturation"}, run);
    run = Run();
    run.frames = 25;
    run.process = {0.2, 2, 0.02, 0.7, 0.001}; /* unlike in every parameter: an index mixed up shows */
    run.start_std = {0.003, 0.05, 0.4, 0.01, 0.2};
    run.std = {0.001, 0.02, 0.3, 0.04, 0.5};
    add_run(set, "unlike-parameters", Tier::ordinary, {}, run);
}

} // namespace vectors
