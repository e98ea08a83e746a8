/* SPDX-License-Identifier: Apache-2.0 */
/* The search of a frame, over whole images of block means; circles by least squares in floating point. */
#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace mirror {

/* A dark disc, cells; radius of the brighter circle about it in 16ths. */
struct DarkDisc {
    int x, y, ring_q4, contrast;
};

/* A circle relative to the disc, 16ths of a cell. */
struct Rim {
    int x, y, radius;
    int64_t score;
};

std::vector<Rim> rims_about(const cv::Mat &cells, const DarkDisc &disc);

struct Sighting {
    int x, y, radius;
    int64_t score;
    cv::Rect region;
};

struct Sightings {
    std::vector<Sighting> best, dark; /* by falling score */
};

Sightings sightings_in(const cv::Mat &image, int min_contrast);

/* What is measured about a sighting of a radius. */
cv::Rect frame_of(int x, int y, int radius);

} // namespace mirror
