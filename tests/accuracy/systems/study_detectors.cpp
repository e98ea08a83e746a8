/* SPDX-License-Identifier: Apache-2.0 */
/* Ellipse detectors beside the library's outline: scenes under all conditions, photographs of boards. */
#include <algorithm>
#include <cmath>

#include "all_systems.hpp"
#include "boards.hpp"
#include "detectors.hpp"
#include "parallel.hpp"
#include "study.hpp"

namespace accuracy {

namespace {

/* One finder over pictures: the library's (number 0), then the detectors in their order. */
struct Tally {
    int pictures = 0, right = 0, wrong = 0;
    std::vector<double> error_px;   /* of the right ones */
    std::vector<double> times_ours; /* time over the library's on the same picture */
};

struct Outline {
    bool found = false;
    Ellipse ellipse = {0, 0, 0, 0, 0};
    double ms = 0;
};

void add(Tally &tally, const Outline &outline, const Ellipse &truth, double ours_ms)
{
    tally.pictures++;
    tally.times_ours.push_back(outline.ms / ours_ms);
    if (!outline.found) {
        return;
    }
    const double error = ellipse_error_px(outline.ellipse, truth);
    const bool right = error <= std::max(1.0, 0.03 * truth.a_px); /* as the study judges the library */
    tally.right += right;
    tally.wrong += !right;
    if (right) {
        tally.error_px.push_back(error);
    }
}

/* What all finders say of a region: 'seen' for the outline as seen, else without distortion. */
std::vector<Outline> find_all(const cv::Mat &image, const Camera &camera, const drogue_model &model,
                              const cv::Rect &region, bool seen)
{
    std::vector<Outline> all(1);
    double begin = thread_ms();
    const Measurement m = measure(image, camera, model, region);
    all[0] = {m.ok, seen ? m.seen : m.ideal, thread_ms() - begin};
    const cv::Rect inside = region & cv::Rect({0, 0}, image.size());
    const cv::Mat picture = image(inside).clone();
    for (const OutlineDetector &d : outline_detectors()) {
        Outline o;
        begin = thread_ms();
        o.found = choose_outline(o.ellipse, d.detect(picture), picture);
        o.ms = thread_ms() - begin;
        o.ellipse.xc_px += inside.x;
        o.ellipse.yc_px += inside.y;
        all.push_back(o);
    }
    return all;
}

void add_all(std::vector<Tally> &tallies, const std::vector<Outline> &outlines, const Ellipse &truth)
{
    tallies.resize(outlines.size());
    for (size_t k = 0; k < outlines.size(); k++) {
        add(tallies[k], outlines[k], truth, outlines[0].ms);
    }
}

std::vector<Tally> over_scenes(Report &report, const StudyOptions &options)
{
    const std::vector<Trial> all = study_trials(options); /* condition by condition */
    std::vector<Trial> trials;
    for (size_t i = 0; i < all.size(); i += static_cast<size_t>(options.pick(5, 1))) {
        trials.push_back(all[i]);
    }
    std::vector<std::vector<Outline>> found(trials.size());
    std::vector<Tally> tallies;
    parallel_for(
        trials.size(), options.threads,
        [&](size_t i) {
            const Trial &t = trials[i];
            cv::Mat image = cv::Mat::zeros(t.scene.image_px, CV_8U);
            picture_of(t, options.cache).copyTo(image(t.region));
            found[i] = find_all(image, t.scene.camera, t.model, t.region, false);
        },
        [&](size_t done, size_t total) { report.progress("ellipse detectors", done, total); });
    for (size_t i = 0; i < trials.size(); i++) {
        add_all(tallies, found[i], trials[i].rim);
    }
    return tallies;
}

std::vector<Tally> over_boards(const StudyOptions &options)
{
    const drogue_model model = {DROGUE_Q16_ONE, 0, 0};
    std::vector<Tally> tallies;
    const int every = options.pick(1, 14);
    int count = 0;
    visit_circles(boards_folder, 1.25, [&](const BoardCircle &c, const cv::Mat &grey, const cv::Rect &region) {
        if (count++ % every == 0) {
            add_all(tallies, find_all(grey, boards_camera, model, region, true), c.hand);
        }
    });
    return tallies;
}

void add_cells(Report::Row &row, const std::vector<Tally> &tallies, size_t k)
{
    if (tallies.empty()) {
        row.insert(row.end(), {"-", "-", "-", "-", "-"});
        return;
    }
    const Tally &t = tallies[k];
    row.insert(row.end(), {std::to_string(t.right) + " of " + std::to_string(t.pictures), std::to_string(t.wrong),
                           std::to_string(t.pictures - t.right - t.wrong), significant(median(t.error_px), 2),
                           significant(median(t.times_ours), 2)});
}

} // namespace

void section_detectors(Report &report, const StudyOptions &options)
{
    report.section("Ellipse detectors");
    const std::vector<Tally> scenes = over_scenes(report, options);
    const std::vector<Tally> boards = boards_there(boards_folder) ? over_boards(options) : std::vector<Tally>();
    report.text(
        "The outline in the same regions, under all conditions of the study and on photographs of boards (truth by "
        "hand there). Right: the outline is off by at most 1 px or 3 % of the semi-major axis on average. Of a "
        "detector's ellipses that which lies as the drogue must and has most of its circumference on edges counts, by "
        "one rule for all, whose edges are in its time; ours does the rest of the measurement in its time, too. Error: median of the right ones.");
    if (boards.empty()) {
        report.text("The photographs are not there: not measured.");
        report.not_judged("ellipse detectors on boards", "the photographs are not there");
    }
    std::vector<Report::Row> rows, sources;
    for (size_t k = 0; k < scenes.size(); k++) {
        Report::Row row = {k == 0 ? "ours" : outline_detectors()[k - 1].name};
        add_cells(row, scenes, k);
        add_cells(row, boards, k);
        rows.push_back(row);
        if (k > 0) {
            sources.push_back({outline_detectors()[k - 1].name, outline_detectors()[k - 1].source});
            report.at_least("outlines right on scenes of all conditions: ours less those of " + rows.back()[0],
                            scenes[0].right - scenes[k].right, 0, "");
        }
    }
    report.table({"detector", "scenes: right", "wrong", "none", "error, px", "time, ours", "boards: right", "wrong",
                  "none", "error, px", "time, ours"},
                 rows);
    report.text("What was taken from where:");
    report.table({"detector", "source"}, sources);
}

} // namespace accuracy
