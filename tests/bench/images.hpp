/* SPDX-License-Identifier: Apache-2.0 */
/* What is measured on: rendered scenes, the photographs beside the project, noise; and cluttered images for the worst case. */
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace bench {

struct Image {
    std::string name;
    std::function<cv::Mat(int)> of_side;
};

/* quick: rendered scenes and noise alone. */
std::vector<Image> images(bool quick);

/* A rendered drogue's place taken by 10 to 40 ellipses, bars and arcs of any grey, blurred, with noise; another for each seed. */
cv::Mat cluttered(int side, int seed);

} // namespace bench
