/* SPDX-License-Identifier: Apache-2.0 */
/* The library's tracker with its memory, for frames of one size. */
#pragma once

#include <vector>

#include "drogue/track.h"
#include "sequence.hpp"

namespace accuracy {

drogue_camera camera_of(const Camera &c);
Pose pose_of(const drogue_pose &p);

/* Memory for tracker, workspace and search. */
class Tracker {
public:
    /* Defaults of the library; the model is the scene's drogue. */
    explicit Tracker(const Scene &scene);

    void frame(drogue_result &result, const drogue_image &image, uint32_t dt_us);

    drogue_track track;

private:
    std::vector<uint32_t> memory_;
    std::vector<uint8_t> search_memory_;
    drogue_workspace workspace_;
    drogue_search search_;
    drogue_config config_;
};

/* The tracker after a frame; time and truth are left to the caller. */
SequenceFrame describe(const drogue_track &track, const drogue_result &result);

} // namespace accuracy
