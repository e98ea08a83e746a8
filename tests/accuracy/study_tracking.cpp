/* SPDX-License-Identifier: Apache-2.0 */
/* Courses of the tracker and painted whole frames in the study. */
#include <algorithm>
#include <cmath>

#include "course.hpp"
#include "parallel.hpp"
#include "search_frames.hpp"
#include "study.hpp"

namespace accuracy {

namespace {

Report::Row row_of(const std::string &name, const CourseScore &s)
{
    const auto ratio = [&](int k) { return fixed(std::sqrt(s.filtered2[k] / s.raw2[k]), 2); };
    return {name,
            fixed(100.0 * s.right / s.visible, 1),
            std::to_string(s.false_frames),
            std::to_string(s.wrong_twins),
            fixed(100.0 * s.resolved / s.visible, 1),
            std::to_string(s.gated),
            std::to_string(s.first_right),
            std::to_string(s.again_right),
            ratio(0),
            ratio(1),
            ratio(2),
            fixed(std::sqrt(s.axis_filtered2 / s.axis_raw2), 2),
            fixed(std::sqrt(s.velocity2 / s.velocities), 4),
            fixed(100 * std::sqrt(s.z_share2 / s.compared), 3),
            fixed(s.nees_raw / s.nees_frames, 2),
            fixed(s.nees_filtered / s.nees_frames, 2)};
}

void whole_frames(Report &report, const StudyOptions &options, bool has_drogue, Report::Row &row)
{
    const auto count = static_cast<size_t>(options.pick(100, 8));
    std::vector<Finding> found(count);
    parallel_for(
        count, options.threads,
        [&](size_t i) {
            found[i] = search_whole(make_whole_frame(options.seed, static_cast<int>(i), has_drogue, {}, "")).finding;
        },
        [&](size_t done, size_t total) { report.progress("whole frames", done, total); });
    for (const Finding f : {Finding::hit, Finding::wrong, Finding::none}) {
        row.push_back(std::to_string(std::count(found.begin(), found.end(), f)));
    }
}

} // namespace

void section_tracking(Report &report, const StudyOptions &options)
{
    struct Job {
        std::string name;
        int index;
    };
    std::vector<Job> jobs;
    for (const std::string &name : options.quick ? std::vector<std::string>{"B"} : course_names()) {
        for (int i = 0; i < options.pick(3, 1); i++) {
            jobs.push_back({name, i});
        }
    }
    std::vector<CourseScore> scores(jobs.size());
    report.section("Tracking under disturbance");
    parallel_for(
        jobs.size(), options.threads,
        [&](size_t i) {
            CourseOptions o;
            o.seed = options.seed;
            o.index = jobs[i].index;
            scores[i] = run_course(make_course(jobs[i].name, o));
        },
        [&](size_t done, size_t total) { report.progress("courses", done, total); });
    std::map<std::string, CourseScore> by;
    for (size_t i = 0; i < jobs.size(); i++) {
        by[jobs[i].name] += scores[i];
    }
    std::vector<Report::Row> rows;
    for (const auto &[name, score] : by) {
        rows.push_back(row_of(name, score));
    }
    report.text(
        "Sequences of 1280 x 720 at 50 frames a second (course.hpp) with drogues that vary, from a search of the "
        "whole image on. Right: share of the frames in sight that are tracking, within 3 % of the range and, where "
        "the orientation is known, within 10 degrees; false: tracking, and not within 3 %; twins: tracking and known, "
        "but more than 10 degrees off; first, again: frames in sight until right. Filtered over raw error of x, y, z "
        "and axis; error of the velocity across; of raw z; mean normalised squared error per degree of freedom.");
    report.table({"course", "right, %", "false", "twins", "resolved, %", "refused", "first", "again", "x", "y", "z",
                  "axis", "v, m/s", "z, %", "raw", "filtered"},
                 rows);
    std::vector<Report::Row> searched = {{"with a drogue"}, {"without"}};
    whole_frames(report, options, true, searched[0]);
    whole_frames(report, options, false, searched[1]);
    report.text(
        "Painted frames of 1280 x 720 with a drogue of 8 to 150 px, tilted by up to 33 degrees, or without one: sky, "
        "clouds, ground, horizon, dark; discs and rings, parts of aircraft, a probe. What drogue_acquire() says.");
    report.table({"frames", "right", "wrong", "none or unsure"}, searched);
}

} // namespace accuracy
