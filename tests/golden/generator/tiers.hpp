/* SPDX-License-Identifier: Apache-2.0 */
/* The reference tiers that have files of their own; reference_tier.cpp has the others. */
#pragma once

#include "case.hpp"

namespace vectors {

using Arrays = std::vector<Array>;
using Tiers = std::vector<Expected>;

Tiers select_tier(const Arrays &inputs, const Arrays &exact);
Tiers support_tier(const Arrays &inputs, const Arrays &exact);
Tiers disc_tier(const Arrays &inputs, const Arrays &exact);
Tiers joint_tier(const Arrays &inputs, const Arrays &exact);
Tiers frame_tier(const Arrays &inputs, const Arrays &exact);

} // namespace vectors
