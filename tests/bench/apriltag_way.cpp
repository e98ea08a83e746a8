/* SPDX-License-Identifier: Apache-2.0 */
#include "apriltag_way.hpp"

#ifdef HAVE_APRILTAG
extern "C" {
#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
}
#endif

namespace bench {

#ifdef HAVE_APRILTAG
struct Tags::Detector {
    apriltag_family_t *family = tag36h11_create();
    apriltag_detector_t *detector = apriltag_detector_create();

    Detector()
    {
        apriltag_detector_add_family(detector, family);
        detector->quad_decimate = 2;
        detector->nthreads = 1;
    }
    ~Detector()
    {
        apriltag_detector_destroy(detector);
        tag36h11_destroy(family);
    }
};

bool Tags::there() { return true; }

int Tags::count(const cv::Mat &frame)
{
    image_u8_t image = {frame.cols, frame.rows, static_cast<int32_t>(frame.step), frame.data};
    zarray_t *found = apriltag_detector_detect(detector_->detector, &image);
    const int count = zarray_size(found);
    apriltag_detections_destroy(found);
    return count;
}
#else
struct Tags::Detector {};
bool Tags::there() { return false; }
int Tags::count(const cv::Mat &) { return 0; }
#endif

Tags::Tags() : detector_(new Detector) {}
Tags::~Tags() = default;

} // namespace bench
