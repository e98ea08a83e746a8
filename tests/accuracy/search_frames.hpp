/* SPDX-License-Identifier: Apache-2.0 */
/* Whole frames of 1280 x 720 with a drogue, or without, and what a search of them gives. */
#pragma once

#include <string>

#include "drogue/drogue.h"
#include "painted.hpp"

namespace accuracy {

struct WholeFrame {
    cv::Mat image;
    Scene scene; /* camera, pose and drogue */
    Ellipse rim;
    bool has_drogue;
    std::string kind; /* background and what is in it */
};

/* Frame number 'index': backgrounds in turn; a from 8 to 150 px, log-uniform. */
WholeFrame make_whole_frame(uint64_t seed, int index, bool has_drogue, const Variety &variety,
                            const std::string &cache);

enum class Finding { hit, wrong, none };

struct Search {
    Finding finding;
    drogue_result result;
    double seconds;          /* of the thread */
    double log_odds;         /* of what was measured, sure or not; NaN: nothing was */
    bool unsure_right;       /* it would have been a hit, had the search been sure */
    int sighted;             /* rank of the sighting that suits; -1: none */
    bool can_be, can_decide; /* measured in the true region it is right, and its inner part decides */
};

/* A hit has its centre and semi-axis within 3 % of the semi-axis or 1 px. */
Search search_whole(const WholeFrame &frame);

} // namespace accuracy
