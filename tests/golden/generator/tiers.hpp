/* SPDX-License-Identifier: Apache-2.0 */
/* The reference tiers that have files of their own; reference_tier.cpp has the others. */
#pragma once

#include <cmath>

#include "case.hpp"
#include "reference.hpp"

namespace vectors {

using Arrays = std::vector<Array>;
using Tiers = std::vector<Expected>;

/* Words as numbers, and numbers as words. */
inline reference::Real real(int64_t word) { return static_cast<reference::Real>(word) / 65536; }
inline int as_int(int64_t word) { return static_cast<int>(word); }
inline int64_t rounded(reference::Real v, int frac)
{
    return static_cast<int64_t>(std::floor(std::ldexp(v, frac) + 0.5L));
}

/* The exact tier's array with the reference's words. */
Array like(const Array &exact, std::vector<int64_t> words);

/* For 'more' of bounds(): no bit of this word may differ in this case; nothing can be said of it. */
constexpr reference::Real EXACTLY = -HUGE_VALL, UNDEFINED = HUGE_VALL;

/* Bounds of a stage's output from the table of tests/conformance/stages_words.c: each word's base and beside it what this
 * case's conditioning adds, LSB ('more'; empty: nothing). A word that needs more than the table grants is undefined; throws
 * where the table says that it cannot be. */
Bound bounds(const std::string &stage, const Array &reference, const std::vector<reference::Real> &more = {});

/* An output with its words of the bit-exact tier that has no reference. */
Expected unreferenced(const std::string &stage, const Array &exact);

/* LSB by which the angle may turn when each semi-axis may differ by 'px' LSB: it says less the rounder the ellipse. */
reference::Real angle_turn(reference::Real a, reference::Real b, reference::Real px);

Tiers select_tier(const Arrays &inputs, const Arrays &exact);
Tiers support_tier(const Arrays &inputs, const Arrays &exact);
Tiers joint_tier(const Arrays &inputs, const Arrays &exact);
Tiers frame_tier(const Arrays &inputs, const Arrays &exact);
Tiers decide_tier(const Arrays &inputs, const Arrays &exact);
Tiers look_tier(const Arrays &inputs, const Arrays &exact);
Tiers rim_tier(const Arrays &inputs, const Arrays &exact);
Tiers search_tier(const Arrays &inputs, const Arrays &exact);
Tiers acquire_tier(const Arrays &inputs, const Arrays &exact);
Tiers track_tier(const Arrays &inputs, const Arrays &exact);
Tiers follow_tier(const Arrays &inputs, const Arrays &exact);

} // namespace vectors
