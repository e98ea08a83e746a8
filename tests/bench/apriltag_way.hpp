/* SPDX-License-Identifier: Apache-2.0 */
/* AprilTag's detector at half resolution, where the library is there: what a search of a whole frame costs that looks for marks. */
#pragma once

#include <memory>

#include <opencv2/core.hpp>

namespace bench {

class Tags {
public:
    Tags();
    ~Tags();
    static bool there(); /* was it there when this was built? */
    int count(const cv::Mat &frame);

private:
    struct Detector;
    std::unique_ptr<Detector> detector_;
};

} // namespace bench
