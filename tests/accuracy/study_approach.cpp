/* SPDX-License-Identifier: Apache-2.0 */
/* The paper's Fig. 12 and 13 and table 4 (single pictures over the range), and Fig. 14 (a sequence with swing, the
 * tracker choosing its own regions). */
#include <array>
#include <cmath>
#include <limits>

#include "approach.hpp"
#include "drogue/track.h"
#include "pose_noise.hpp"
#include "study.hpp"

namespace accuracy {

namespace {

constexpr std::array<const char *, 3> letters = {"x", "y", "z"};
constexpr int paper_measurements = 103;

/* Fig. 12: what was measured over what is. */
void plot_positions(Report &report, const std::vector<Trial> &trials, const std::vector<Outcome> &outcomes)
{
    Plot plot = {
        "approach_positions",
        "Measured and true position, in the order of the distance (the paper's Fig. 12).",
        "picture",
        "position, m",
        {},
        false,
        false,
        {"set pointsize 0.8", "set yrange [-7:27]", "set xrange [0:" + std::to_string(trials.size() + 1) + "]"}};
    for (int axis = 0; axis < 3; axis++) {
        const std::string letter = letters[static_cast<size_t>(axis)];
        Series truth = {letter + ", true", {}, {}, "lines"};
        Series measured = {letter + ", measured", {}, {}, "points"};
        for (size_t i = 0; i < trials.size(); i++) {
            const double at = trials[i].pose.position_m[axis];
            const bool seen = outcomes[i].verdict != Verdict::unmeasured;
            truth.x.push_back(static_cast<double>(i) + 1), truth.y.push_back(at);
            measured.x.push_back(static_cast<double>(i) + 1);
            measured.y.push_back(seen ? at + outcomes[i].position_m[axis] : std::nan(""));
        }
        plot.series.push_back(truth);
        plot.series.push_back(measured);
    }
    report.plot(plot);
}

/* Fig. 13: absolute or relative errors against the distance. */
void plot_errors(Report &report, const std::vector<Outcome> &outcomes, bool relative)
{
    Plot plot = {relative ? "approach_relative" : "approach_absolute",
                 relative ? "Errors of the position relative to the distance (the paper's Fig. 13 b)."
                          : "Errors of the position (the paper's Fig. 13 a).",
                 "distance, m",
                 relative ? "error, % of the distance" : "absolute error, cm",
                 {},
                 false,
                 true,
                 {"set format y '%g'", "set xrange [4:26]"}};
    for (int axis = 0; axis < 3; axis++) {
        Series s = {letters[static_cast<size_t>(axis)], {}, {}, "points"};
        for (const Outcome &o : outcomes) {
            if (o.verdict != Verdict::unmeasured) {
                s.x.push_back(o.distance_m);
                s.y.push_back(relative ? o.percent()[axis] : std::fabs(o.position_m[axis]) * 100);
            }
        }
        plot.series.push_back(s);
    }
    report.plot(plot);
}

void range_table(Report &report, const std::vector<Outcome> &outcomes)
{
    const std::vector<std::pair<double, double>> ranges = {{5, 10}, {10, 15}, {15, 20}, {20, 25.01}, {5, 25.01}};
    std::vector<Report::Row> rows;
    for (const auto &[from, to] : ranges) {
        std::array<std::vector<double>, 3> cm, percent;
        for (const Outcome &o : outcomes) {
            if (o.verdict != Verdict::unmeasured && o.distance_m >= from && o.distance_m < to) {
                for (size_t k = 0; k < 3; k++) {
                    cm[k].push_back(std::fabs(o.position_m[static_cast<int>(k)]) * 100);
                    percent[k].push_back(o.percent()[static_cast<int>(k)]);
                }
            }
        }
        Report::Row row = {fixed(from, 0) + "-" + fixed(to, 0) + " m", std::to_string(cm[0].size())};
        for (const auto &set : {cm, percent}) {
            for (const auto &axis : set) {
                row.push_back(significant(mean(axis), 2));
            }
        }
        rows.push_back(row);
    }
    report.text("Mean absolute error by distance (the paper: less than 6 cm in x and y):");
    report.table({"distance", "pictures", "x, cm", "y, cm", "z, cm", "x, %", "y, %", "z, %"}, rows);
}

Report::Row angle_row(const std::string &name, const AngleErrors &e)
{
    return {name, fixed(e.min, 3), fixed(e.max, 2), fixed(e.mean, 2), fixed(e.std, 2)};
}

void angle_table(Report &report, const std::vector<Outcome> &outcomes)
{
    std::vector<double> pitch, yaw, pitch_resolved, yaw_resolved;
    for (const Outcome &o : outcomes) {
        if (o.verdict != Verdict::unmeasured) {
            const double y = std::fabs(o.angles_rad[0]) * 180 / CV_PI;
            const double p = std::fabs(o.angles_rad[1]) * 180 / CV_PI;
            pitch.push_back(p), yaw.push_back(y);
            if (o.resolved) {
                pitch_resolved.push_back(p), yaw_resolved.push_back(y);
            }
        }
    }
    report.text("Errors of pitch and yaw, degrees (table 4). " + std::to_string(pitch_resolved.size()) + " of " +
                std::to_string(pitch.size()) +
                " measurements say that the orientation is resolved; the others give both poses and leave it open.");
    report.table({"angle", "min", "max", "mean", "std"},
                 {angle_row("pitch", summary_of(pitch)), angle_row("yaw", summary_of(yaw)),
                  angle_row("pitch, where resolved", summary_of(pitch_resolved)),
                  angle_row("yaw, where resolved", summary_of(yaw_resolved)),
                  angle_row("pitch, paper", {0.43, 7.21, 3.34, 1.92}),
                  angle_row("yaw, paper", {0.21, 6.32, 2.97, 1.57})});
}

void single_pictures(Report &report, const StudyOptions &options)
{
    const int pictures = options.pick(paper_measurements, 24);
    std::vector<Trial> trials;
    for (int i = 0; i < pictures; i++) {
        const double distance =
            approach_to_m + (approach_from_m - approach_to_m) * i / static_cast<double>(pictures - 1);
        trials.push_back(trial_at(hash_at(options.seed, 12, 13), static_cast<Condition>(i % conditions), i, distance));
    }
    const std::vector<Outcome> outcomes = run_trials(trials, run_options(report, options, "positions, Fig. 12"));
    const Summary s = summarise(outcomes);
    report.text(
        std::to_string(pictures) +
        " single pictures, evenly from 5 to 25 m, the study's conditions in turn, tilt to 30 degrees, no filter; " +
        std::to_string(s.unmeasured) + " not measured, " + std::to_string(s.wrong) +
        " with a wrong ellipse. The paper has " + std::to_string(paper_measurements) + " pictures of a real drogue.");
    plot_positions(report, trials, outcomes);
    plot_errors(report, outcomes, false);
    plot_errors(report, outcomes, true);
    range_table(report, outcomes);
    angle_table(report, outcomes);
}

/* One frame of the sequence. */
struct Step {
    double time_s;
    Pose truth;
    bool measured = false, tracked = false;
    Pose raw, filtered;
};

Pose pose_of(const drogue_q16 position_m_q16[3], const drogue_q16 axis_q16[3])
{
    Pose p;
    for (int k = 0; k < 3; k++) {
        p.position_m[k] = from_q16(position_m_q16[k]);
        p.axis[k] = from_q16(axis_q16[k]);
    }
    return p;
}

/* The tracker as it is meant: its regions, its filter, from the detector's first region. */
std::vector<Step> run_sequence(const Approach &approach, Report &report)
{
    const Scene first = approach.scene(0);
    const cv::Rect found = approach.region(0);
    const drogue_camera camera = {to_q16(first.camera.fx_px),
                                  to_q16(first.camera.fy_px),
                                  to_q16(first.camera.cx_px),
                                  to_q16(first.camera.cy_px),
                                  0,
                                  0,
                                  0,
                                  0,
                                  0};
    const drogue_region first_region = {found.x, found.y, found.width, found.height};
    const drogue_model model = approach.model();
    drogue_track_config config;
    drogue_track track;
    std::vector<Step> steps;
    drogue_track_config_default(&config);
    (void)drogue_track_init(&track, &config, &camera, &model, &first_region);
    for (int i = 0; i < approach.frames; i++) {
        const Scene scene = approach.scene(i);
        drogue_region region;
        drogue_track_estimate estimate;
        Step s;
        drogue_track_begin(&region, &track, static_cast<uint32_t>(std::lround(approach.dt_s * 1e6)));
        const cv::Rect wanted(region.x_px, region.y_px, region.width_px, region.height_px);
        /* A margin, should the library look again beside the region. */
        const int margin = wanted.width / 4;
        const cv::Rect wide(wanted.x - margin, wanted.y - margin, wanted.width + 2 * margin,
                            wanted.height + 2 * margin);
        const cv::Rect seen = wide & cv::Rect({0, 0}, scene.image_px);
        cv::Mat image = cv::Mat::zeros(scene.image_px, CV_8U);
        if (!seen.empty()) {
            render(scene, seen).copyTo(image(seen));
        }
        const Measurement m = measure(image, scene.camera, model, wanted);
        s.time_s = approach.time_s(i);
        s.truth = approach.pose(i);
        s.measured = m.ok;
        s.raw = m.pose;
        s.tracked = drogue_track_end(&track, &m.raw) != DROGUE_LOST;
        drogue_track_get(&estimate, &track);
        s.filtered = pose_of(estimate.position_m_q16, estimate.axis_q16);
        steps.push_back(s);
        report.progress("sequence, Fig. 14", static_cast<size_t>(i) + 1, static_cast<size_t>(approach.frames));
    }
    return steps;
}

void plot_sequence(Report &report, const std::vector<Step> &steps, int axis)
{
    const std::string letter = letters[static_cast<size_t>(axis)];
    Series raw = {"error, single measurements", {}, {}, "lines"};
    Series filtered = {"error, filtered", {}, {}, "lines linewidth 2"};
    Series place = {letter + ", true (right)", {}, {}, "lines linewidth 2 dashtype 2 axes x1y2"};
    for (const Step &s : steps) {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        const double truth = s.truth.position_m[axis];
        raw.x.push_back(s.time_s), raw.y.push_back(s.measured ? (s.raw.position_m[axis] - truth) * 100 : nan);
        filtered.x.push_back(s.time_s),
            filtered.y.push_back(s.tracked ? (s.filtered.position_m[axis] - truth) * 100 : nan);
        place.x.push_back(s.time_s), place.y.push_back(truth);
    }
    report.plot({"dynamic_" + letter,
                 "Error and displacement of " + letter + " in the sequence (the paper's Fig. 14).",
                 "time, s",
                 "error of " + letter + ", cm",
                 {raw, filtered, place},
                 false,
                 false,
                 {"set ytics nomirror", "set y2tics", "set y2label '" + letter + ", m'"}});
}

void sequence_table(Report &report, const std::vector<Step> &steps)
{
    std::array<std::vector<double>, 6> raw, filtered;
    int missed = 0;
    int lost = 0;
    const auto add = [](std::array<std::vector<double>, 6> &to, const Pose &got, const Pose &truth) {
        for (int k = 0; k < 3; k++) {
            to[static_cast<size_t>(k)].push_back(std::fabs(got.position_m[k] - truth.position_m[k]) * 100);
        }
        to[3].push_back(std::fabs(pitch_of(got.axis) - pitch_of(truth.axis)) * 180 / CV_PI);
        to[4].push_back(std::fabs(yaw_of(got.axis) - yaw_of(truth.axis)) * 180 / CV_PI);
        to[5].push_back(angle_between_deg(got.axis, truth.axis));
    };
    for (const Step &s : steps) {
        missed += !s.measured;
        lost += !s.tracked;
        if (s.measured) {
            add(raw, s.raw, s.truth);
        }
        if (s.tracked) {
            add(filtered, s.filtered, s.truth);
        }
    }
    std::vector<Report::Row> rows = {{"single measurements"}, {"filtered"}};
    for (size_t k = 0; k < 6; k++) {
        rows[0].push_back(significant(mean(raw[k]), 2));
        rows[1].push_back(significant(mean(filtered[k]), 2));
    }
    rows.push_back({"paper", "below 6", "below 6", "below 15", "-", "-", "-"});
    report.text("Mean absolute errors over the sequence; " + std::to_string(missed) + " pictures not measured, " +
                std::to_string(lost) + " without a track.");
    report.table({"", "x, cm", "y, cm", "z, cm", "pitch, degrees", "yaw, degrees", "axis, degrees"}, rows);
}

void sequence(Report &report, const StudyOptions &options)
{
    const Approach approach = {options.seed + 1, 1, options.pick(300, 70), options.quick ? 0.1 : 1.0 / 30};
    const std::vector<Step> steps = run_sequence(approach, report);
    report.text("A sequence (Fig. 14): from 25 to 5 m in " + significant(approach.time_s(approach.frames), 2) +
                " s at " + significant(1 / approach.dt_s, 2) + " pictures a second, swing of " +
                fixed(approach.amplitude_m(), 1) +
                " m across and down at 0.15 to 0.2 Hz. The tracker chooses its own regions.");
    for (int axis = 0; axis < 3; axis++) {
        plot_sequence(report, steps, axis);
    }
    sequence_table(report, steps);
}

} // namespace

void section_approach(Report &report, const StudyOptions &options)
{
    report.section("Position and orientation over the range, and in motion (the paper's Fig. 12 to 14, table 4)");
    single_pictures(report, options);
    sequence(report, options);
}

} // namespace accuracy
