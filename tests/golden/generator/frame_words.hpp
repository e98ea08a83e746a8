/* SPDX-License-Identifier: Apache-2.0 */
/* The words of a frame's reference tier, for the stages that measure frames. */
#pragma once

#include "mirror.hpp"
#include "stages.h"
#include "tiers.hpp"

namespace vectors {

struct FrameWords {
    mirror::Result result;
    std::vector<int64_t> words;        /* of the three outputs with a reference, one after the other */
    std::vector<reference::Real> more; /* for bounds() */
};

namespace frame_words {

enum Word {
    STATUS = 0,
    SEEN = 1,
    IDEAL = 6,
    POLARITY = 11,
    ARCS,
    REFIT,
    HAS_INNER,
    INNER, /* x y area threshold spread */
    POSE = 20,
    OTHER = 28,
    RESOLVED = 36,
    AMBIGUITY,
    WORDS
};
/* The three outputs with a reference, one after the other. */
constexpr size_t COVARIANCE = WORDS, STD = COVARIANCE + 15, ALL = STD + 4;

/* From the words of image, camera and model; a region, and a workspace for its width. */
mirror::Task task_of(const std::vector<Array> &in, const std::array<int64_t, 4> &region);

/* By the mirror, which follows what the library gave. */
FrameWords of(const mirror::Task &task, const drogue_result &library);

} // namespace frame_words

} // namespace vectors
