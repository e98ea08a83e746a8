/* SPDX-License-Identifier: Apache-2.0 */
/* The search of whole frames in the study: how often it sights the drogue, and how often a measurement follows. */
#include <algorithm>
#include <cmath>

#include "parallel.hpp"
#include "study.hpp"
#include "whole_frame.hpp"

namespace accuracy {

namespace {

struct Found {
    Condition condition;
    int rank = -1; /* of the sighting that suits the drogue */
    bool right = false;
    bool wrong = false;
};

Found search_frame(const Trial &t)
{
    const cv::Rect frame = frame_of(t);
    const Acquired acquired = acquire(whole_frame(t, frame), t.scene.camera.cropped(frame.tl()), t.model);
    const drogue_result &result = acquired.result;
    Found found;
    found.condition = t.condition;
    found.rank = rank_of(acquired.sightings, t.rim, frame.tl());
    if (result.status == DROGUE_OK) {
        const double limit = std::max(1.0, 0.03 * t.rim.a_px);
        found.right = std::fabs(from_q16(result.ideal.xc_px_q16) + frame.x - t.rim.xc_px) < limit &&
                      std::fabs(from_q16(result.ideal.yc_px_q16) + frame.y - t.rim.yc_px) < limit &&
                      std::fabs(from_q16(result.ideal.a_px_q16) - t.rim.a_px) < limit;
        found.wrong = !found.right;
    }
    return found;
}

} // namespace

void section_search(Report &report, const StudyOptions &options)
{
    std::vector<Trial> trials;
    for (int c = 0; c < conditions; c++) {
        const auto condition = static_cast<Condition>(c);
        const int count = condition == Condition::plain ? options.pick(100, 3) : options.pick(16, 1);
        for (int i = 0; i < count; i++) {
            trials.push_back(trial(hash_at(options.seed, 41, 7), condition, i));
        }
    }
    std::vector<Found> found(trials.size());
    report.section("Search of whole frames");
    parallel_for(
        trials.size(), options.threads, [&](size_t i) { found[i] = search_frame(trials[i]); },
        [&](size_t done, size_t total) { report.progress("search", done, total); });
    report.text("Frames of " + std::to_string(frame_px) +
                " px and more a side with the drogue anywhere in them, 2 to "
                "25 m: its place among the sightings, and what drogue_acquire() made of them (right: centre and "
                "semi-axis within 3 % of the semi-axis or 1 px).");
    std::vector<Report::Row> rows;
    for (int c = 0; c < conditions; c++) {
        const auto condition = static_cast<Condition>(c);
        int frames = 0, first = 0, among = 0, right = 0, wrong = 0;
        for (const Found &f : found) {
            if (f.condition == condition) {
                frames++;
                first += f.rank == 0;
                among += f.rank >= 0;
                right += f.right;
                wrong += f.wrong;
            }
        }
        rows.push_back({name_of(condition), std::to_string(frames), std::to_string(first), std::to_string(among),
                        std::to_string(right), std::to_string(wrong)});
        if (condition == Condition::plain) {
            report.at_least("plain frames whose drogue is among the sightings", 100.0 * among / frames, 98, "%");
        }
    }
    report.table({"condition", "frames", "first", "sighted", "measured right", "wrong"}, rows);
}

} // namespace accuracy
