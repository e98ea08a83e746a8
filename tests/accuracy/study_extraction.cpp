/* SPDX-License-Identifier: Apache-2.0 */
/* The paper's Fig. 6 on rendered scenes: error of the extracted ellipse against distance under illumination (41) and
 * under Gaussian motion blur; linear blur besides. */
#include <algorithm>
#include <cmath>

#include "study.hpp"

namespace accuracy {

namespace {

struct Disturbance {
    Condition condition;
    const char *title;
    const char *name;
    double paper_px; /* worst error in the paper's figure; 0: not there */
};

constexpr Disturbance disturbances[] = {
    {Condition::illumination, "illumination (41)", "illumination", 3},
    {Condition::gaussian, "Gaussian motion blur", "blur", 3.5},
    {Condition::linear, "linear motion blur", "linear", 0},
};

const std::vector<double> distances_m = {2, 3, 4, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25};

void one(Report &report, const StudyOptions &options, const Disturbance &d, std::vector<Report::Row> &rows)
{
    const int scenes = options.pick(24, 2);
    std::vector<Trial> trials;
    for (const double distance : distances_m) {
        for (int i = 0; i < scenes; i++) {
            trials.push_back(trial_at(hash_at(options.seed, std::lround(distance * 10), 6), d.condition, i, distance));
        }
    }
    const std::vector<Outcome> outcomes = run_trials(trials, run_options(report, options, d.title));
    Series middle = {"median", {}, {}}, worst = {"worst", {}, {}};
    std::vector<double> all;
    int unmeasured = 0;
    for (size_t k = 0; k < distances_m.size(); k++) {
        std::vector<double> errors;
        for (size_t i = 0; i < static_cast<size_t>(scenes); i++) {
            const Outcome &o = outcomes[k * static_cast<size_t>(scenes) + i];
            if (o.verdict == Verdict::unmeasured) {
                unmeasured++;
            } else {
                errors.push_back(o.ellipse_px);
            }
        }
        middle.x.push_back(distances_m[k]), middle.y.push_back(median(errors));
        worst.x.push_back(distances_m[k]), worst.y.push_back(percentile(errors, 100));
        all.insert(all.end(), errors.begin(), errors.end());
    }
    rows.push_back({d.title, std::to_string(outcomes.size()), std::to_string(unmeasured), significant(median(all), 2),
                    significant(percentile(all, 99), 2), significant(percentile(all, 100), 2),
                    d.paper_px > 0 ? "below " + plain(d.paper_px) : "-"});
    Plot plot = {std::string("extraction_") + d.name,
                 std::string("Error of the extracted ellipse under ") + d.title + ".",
                 "distance, m",
                 "mean distance of the outlines, px",
                 {middle, worst},
                 false,
                 true,
                 {"set xrange [0:27]"}};
    if (d.paper_px > 0) {
        plot.series.push_back({"the paper's bound", {0, 27}, {d.paper_px, d.paper_px}, "lines dashtype 2"});
    }
    report.plot(plot);
}

} // namespace

void section_extraction(Report &report, const StudyOptions &options)
{
    report.section("Extraction under illumination and blur (the paper's Fig. 6)");
    report.text(
        "Mean distance between extracted and true outline over 360 directions, in pixels, at 14 distances from 2 "
        "to 25 m, " +
        std::to_string(options.pick(24, 2)) +
        " scenes each; tilt to 30 degrees. Illumination falls off to a third across the drogue at worst; the blur's "
        "sigma goes to 3 px and to a tenth of the semi-major axis, linear blur to 9 px and to a quarter of it.");
    std::vector<Report::Row> rows;
    for (const Disturbance &d : disturbances) {
        one(report, options, d, rows);
    }
    report.table({"disturbance", "scenes", "not measured", "median, px", "99th percentile", "worst", "paper"}, rows);
}

} // namespace accuracy
