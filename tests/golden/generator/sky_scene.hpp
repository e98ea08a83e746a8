/* SPDX-License-Identifier: Apache-2.0 */
/* A small scene that several stages' cases begin with. */
#pragma once

#include "scene.hpp"

namespace vectors {

/* A dark drogue before the sky, seen with a focal length of 500 px. */
inline accuracy::Scene sky_scene(uint64_t seed, double x, double y, double z, double yaw, double pitch)
{
    accuracy::Scene s;
    s.seed = seed;
    s.camera = {500, 500, 1023.5, 1023.5};
    s.pose = {{x, y, z}, accuracy::axis_of(yaw, pitch)};
    s.look = accuracy::Look::dark();
    s.background = accuracy::Background::sky();
    s.sensor.noise = 1;
    return s;
}

} // namespace vectors
