/* SPDX-License-Identifier: Apache-2.0 */
/* Every system on the same scenes: one camera, marks, two cameras, range image. */
#pragma once

#include <string>
#include <vector>

#include "comparison.hpp"
#include "conditions.hpp"

namespace accuracy {

enum class Sensors { one_camera, marks, stand_in, two_cameras, range };

struct System {
    std::string name;
    Sensors sensors;
    double noise_px;         /* of marks; 0 elsewhere */
    std::string on_drogue;   /* what it needs there */
    std::string on_receiver; /* and there */
};

/* The first is ours. */
const std::vector<System> &all_systems();
constexpr double mark_noises_px[] = {0.05, 0.1, 0.3};
constexpr double shown_noise_px = 0.1; /* in the table of all */
constexpr double lidar_noise_m = 0.02;

/* What each system says of one scene, in the order of all_systems(), and the processor's time that it took, ms.
 *
 *  t    a plain scene; its right view, range image and marks are rendered here, their time is not counted
 */
struct SceneEstimates {
    std::vector<Estimate> estimates;
    std::vector<double> ms;
};
SceneEstimates estimate_all(const Trial &t, const std::string &cache);

/* Time of the calling thread, ms. */
double thread_ms();

} // namespace accuracy
