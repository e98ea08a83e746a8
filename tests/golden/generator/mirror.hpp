/* SPDX-License-Identifier: Apache-2.0 */
/* The measurement of a frame in floating point, on the edge list of the exact front end. */
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace vectors {

struct FrameReference {
    std::vector<int64_t> words; /* as output 'frame' of the stage, rounded once */
    std::vector<uint32_t> bound;
};

/* Follows the library's documented method from edge points and arcs to the pose. The words are those of the stage's
 * inputs: camera 9, model 3, region 4. */
FrameReference mirror_frame(const cv::Mat &image, const std::vector<int64_t> &camera, const std::vector<int64_t> &model,
                            const std::vector<int64_t> &region);

} // namespace vectors
