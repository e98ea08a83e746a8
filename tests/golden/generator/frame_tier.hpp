/* SPDX-License-Identifier: Apache-2.0 */
/* The reference tier of a frame, and how far the library may be from it. */
#pragma once

#include "case.hpp"

namespace vectors {

std::vector<Expected> frame_tier(const std::vector<Array> &inputs, const std::vector<Array> &exact);

} // namespace vectors
