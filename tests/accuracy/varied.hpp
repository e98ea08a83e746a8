/* SPDX-License-Identifier: Apache-2.0 */
/* Scenes that vary the drogue itself, what lies behind it and its light: what the conditions (conditions.hpp) leave
 * alike. */
#pragma once

#include "conditions.hpp"

namespace accuracy {

/* What a scene shows, each with a drogue whose canopy, wall, ribs, disc and texture are drawn anew.
 *
 *  plain     semi-axis of 35 to 140 px, noise of 2 grey levels
 *  far       9 to 25 px
 *  offset    the region's centre off by up to 0.15 a, its side 2.2 to 2.8 a
 *  noise     sigma of 8 grey levels
 *  spot      a spot of light on the canopy that saturates the sensor
 *  blur      motion blur of 9 px
 *  probe     a probe over rim or disc, or both
 *  tilted    30 to 42 degrees off the line of sight
 *  bright    a canopy of 215 before a ground of 205
 *  half      half of the drogue in shade, the background between the two greys
 *  clutter   a horizon, rough ground, blobs and bars behind the rim
 *  ribs      dark ribs that touch the disc, no wall
 *  torus     a torus for a rim, with a highlight
 */
enum class Variety { plain, far, offset, noise, spot, blur, probe, tilted, bright, half, clutter, ribs, torus };
constexpr int varieties = 13;

const char *name_of(Variety variety);

/* Trial number 'index': a pure function of the arguments. The held-out ones are drawn from other ranges. */
Trial varied_trial(uint64_t seed, Variety variety, int index, bool held_out);

} // namespace accuracy
