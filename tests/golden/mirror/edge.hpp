/* SPDX-License-Identifier: Apache-2.0 */
/* The inner disc by its own edge in floating point, from the edges along rays that the library finds: these are integers
 * from pixels, as the front end's edge points are. */
#pragma once

#include <vector>

#include "reference.hpp"

#include "drogue/inner.h"

namespace mirror {

using reference::Real;

/* As drogue_inner_edge, unrounded. */
struct Disc {
    bool found = false;
    int which = 0, level = 0, contrast = 0;
    int64_t rays = 0;
    Real x = 0, y = 0, grown = 0, std = 0, rms = 0;
};

/* 'expected' as the library rounds it; 'outline' likewise. 'library': its own result, to round the first place as it did
 * where that lies near the middle between two; NULL: all decisions are the mirror's own. */
Disc inner_edge(const drogue_image &view, const drogue_inner_expected &expected, const drogue_ellipse &outline,
                const drogue_config &config, const drogue_inner_edge *library);

} // namespace mirror
