/* SPDX-License-Identifier: Apache-2.0 */
/* The inner disc by its own edge in floating point, from the edges along rays that the library finds: these are integers
 * from pixels, as the front end's edge points are. */
#pragma once

#include <array>

#include "reference.hpp"

#include "drogue/inner.h"

namespace mirror {

using reference::Real;

reference::Ellipse real_of(const drogue_ellipse &e);

using Offset = std::array<Real, 3>; /* x, y, larger by */
using Rays = std::array<drogue_ray, DROGUE_RAYS>;

/* Of least squares over the rays that agree. */
struct Sums {
    cv::Matx33d normal = cv::Matx33d::zeros();
    cv::Vec3d right = {0, 0, 0};
    Real squares = 0, slopes = 0, levels = 0;
    std::array<Real, DROGUE_RAYS / 4> bin{}, bin_weight{};
    int rays = 0;
};

/* From all edges within a gate to those about one place, in the end within 'last' of it; false: too few. */
bool settle(Sums &s, Offset &v, const Rays &rays, Real within, Real last, bool size);

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

/* By how much a disc may be larger or smaller than expected. */
Real room_of(const reference::Ellipse &expected, const drogue_config &config);

/* Is a disc seen by enough rays, of about the expected size or larger, near the expected place, and not cut by the rim? */
bool in_its_place(const Disc &d, const reference::Ellipse &expected, const reference::Ellipse &rim,
                  const drogue_config &config);

} // namespace mirror
