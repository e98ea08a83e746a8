/* SPDX-License-Identifier: Apache-2.0 */
/* The related systems side by side in the study: one table, one plot. */
#include <algorithm>
#include <cmath>
#include <limits>

#include "all_systems.hpp"
#include "detectors.hpp"
#include "parallel.hpp"
#include "study.hpp"

namespace accuracy {

namespace {

const std::vector<double> shown_m = {3, 8, 15, 25};

/* Errors and times of each system at one distance. */
struct AtDistance {
    double distance_m;
    std::vector<MethodErrors> errors;
};

struct Everything {
    std::vector<AtDistance> at;
    std::vector<std::vector<double>> times_ours; /* of each system, a scene: its time over ours */
};

Everything run(Report &report, const StudyOptions &options)
{
    const std::vector<double> distances_m = options.quick ? shown_m : std::vector<double>{3, 5, 8, 11, 15, 20, 25};
    const size_t scenes = static_cast<size_t>(options.pick(24, 4));
    const size_t systems = all_systems().size();
    std::vector<SceneEstimates> results(distances_m.size() * scenes);
    std::vector<Trial> trials;
    for (const double distance : distances_m) {
        for (size_t i = 0; i < scenes; i++) {
            const int index = static_cast<int>(i);
            trials.push_back(trial_of(plain_scene(options.seed, distance, index), index));
        }
    }
    parallel_for(
        trials.size(), options.threads, [&](size_t i) { results[i] = estimate_all(trials[i], options.cache); },
        [&](size_t done, size_t total) { report.progress("all systems", done, total); });

    Everything all;
    all.times_ours.resize(systems);
    for (size_t d = 0; d < distances_m.size(); d++) {
        AtDistance at = {distances_m[d], std::vector<MethodErrors>(systems)};
        for (size_t i = d * scenes; i < (d + 1) * scenes; i++) {
            for (size_t k = 0; k < systems; k++) {
                at.errors[k].add(results[i].estimates[k], trials[i].pose);
                all.times_ours[k].push_back(results[i].ms[k] / results[i].ms[0]);
            }
        }
        all.at.push_back(at);
    }
    return all;
}

/* Median x, y, z in % and axis in degrees; NaN where there is none. */
std::array<double, 4> medians_of(const MethodErrors &e)
{
    const std::array<double, 4> m = e.median_percent();
    return {m[0], m[1], m[2], median(e.axis_deg)};
}

std::string cell_of(const MethodErrors &e)
{
    if (e.measured() == 0) {
        return "-";
    }
    const std::array<double, 4> m = medians_of(e);
    return significant(m[0], 2) + ", " + significant(m[1], 2) + ", " + significant(m[2], 2) + "; " +
           significant(m[3], 2);
}

bool shown(const AtDistance &at) { return std::find(shown_m.begin(), shown_m.end(), at.distance_m) != shown_m.end(); }

bool in_main_table(const System &s)
{
    return s.sensors != Sensors::stand_in && (s.sensors != Sensors::marks || s.noise_px == shown_noise_px);
}

std::string missed_of(const Everything &all, size_t k)
{
    int none = 0, gross = 0;
    for (const AtDistance &at : all.at) {
        none += at.errors[k].pictures - static_cast<int>(at.errors[k].measured());
        gross += at.errors[k].gross;
    }
    return std::to_string(none) + ", " + std::to_string(gross);
}

Report::Row head(const char *first)
{
    Report::Row row = {first};
    for (const double d : shown_m) {
        row.push_back(fixed(d, 0) + " m: x, y, z; axis");
    }
    return row;
}

void add_cells(Report::Row &row, const Everything &all, size_t k)
{
    for (const AtDistance &at : all.at) {
        if (shown(at)) {
            row.push_back(cell_of(at.errors[k]));
        }
    }
}

void main_table(Report &report, const Everything &all)
{
    Report::Row columns = head("system");
    columns.insert(columns.end(), {"none, gross", "time, ours", "on the drogue", "on the receiver"});
    std::vector<Report::Row> rows;
    for (size_t k = 0; k < all_systems().size(); k++) {
        const System &s = all_systems()[k];
        if (in_main_table(s)) {
            Report::Row row = {s.name};
            add_cells(row, all, k);
            row.insert(row.end(),
                       {missed_of(all, k), significant(median(all.times_ours[k]), 2), s.on_drogue, s.on_receiver});
            rows.push_back(row);
        }
    }
    report.table(columns, rows);
}

void marks_table(Report &report, const Everything &all)
{
    report.text("Systems with marks by the sensor's noise, and beside them cv::solvePnP on the same lamps:");
    Report::Row columns = head("system, noise");
    columns.insert(columns.end(), {"none, gross", "time, ours"});
    std::vector<Report::Row> rows;
    for (size_t first = 0; first < all_systems().size(); first++) {
        const System &s = all_systems()[first];
        if (s.noise_px != mark_noises_px[0]) {
            continue;
        }
        for (size_t k = 0; k < all_systems().size(); k++) {
            if (all_systems()[k].name == s.name && all_systems()[k].noise_px > 0) {
                Report::Row row = {s.name + ", " + plain(all_systems()[k].noise_px) + " px"};
                add_cells(row, all, k);
                row.insert(row.end(), {missed_of(all, k), significant(median(all.times_ours[k]), 2)});
                rows.push_back(row);
            }
        }
    }
    report.table(columns, rows);
}

void plot(Report &report, const Everything &all)
{
    Plot p = {"systems_z",
              "Median z error of every system against distance, marks at 0.1 px.",
              "distance, m",
              "median z error, % of distance",
              {},
              true,
              true,
              {"set terminal pngcairo size 1100,700 font 'sans,11' linewidth 1.5 noenhanced",
               "set key outside right top vertical maxrows 40", "set xrange [2.8:27]",
               "set xtics (3, 5, 8, 11, 15, 20, 25)", "set yrange [0.0005:30]"}};
    int colour = 0;
    for (size_t k = 0; k < all_systems().size(); k++) {
        const System &s = all_systems()[k];
        if (!in_main_table(s)) {
            continue;
        }
        /* Ours thick and black; one camera solid, marks dashed, two cameras and range dotted. */
        const std::string dash = s.sensors == Sensors::one_camera ? "1" : s.sensors == Sensors::marks ? "2" : "3";
        const std::string style = k == 0 ? "linespoints lw 3 lc rgb 'black' pt 7"
                                         : "linespoints lc " + std::to_string(1 + colour % 7) + " dt " + dash + " pt " +
                                               std::to_string(1 + colour % 13);
        colour += k > 0;
        Series series = {s.name, {}, {}, style};
        for (const AtDistance &at : all.at) {
            series.x.push_back(at.distance_m);
            series.y.push_back(medians_of(at.errors[k])[2]);
        }
        p.series.push_back(series);
    }
    report.plot(p);
}

/* Where another system of one camera and no marks has the lower median. */
void compare_columns(Report &report, const Everything &all)
{
    const char *const quantity[4] = {"x", "y", "z", "axis"};
    std::vector<Report::Row> rows;
    int columns = 0;
    for (const AtDistance &at : all.at) {
        if (!shown(at)) {
            continue;
        }
        const std::array<double, 4> ours = medians_of(at.errors[0]);
        for (size_t i = 0; i < 4; i++) {
            double best = std::numeric_limits<double>::infinity();
            std::string name;
            for (size_t k = 1; k < all_systems().size(); k++) {
                const double v = medians_of(at.errors[k])[i];
                if (all_systems()[k].sensors == Sensors::one_camera && v < best) {
                    best = v;
                    name = all_systems()[k].name;
                }
            }
            columns++;
            if (!(ours[i] <= best)) {
                const char *const unit = i == 3 ? " degrees" : " %";
                rows.push_back({fixed(at.distance_m, 0) + " m, " + quantity[i], significant(ours[i], 3) + unit,
                                significant(best, 3) + unit, name});
            }
        }
    }
    report.text("Of the " + std::to_string(columns) +
                " columns ours has the lowest median of all systems of one camera "
                "without marks in " +
                std::to_string(columns - static_cast<int>(rows.size())) + (rows.empty() ? "." : "; not in these:"));
    if (!rows.empty()) {
        report.table({"column", "ours", "lowest", "whose"}, rows);
    }
}

} // namespace

void section_systems(Report &report, const StudyOptions &options)
{
    report.section("All systems");
    const Everything all = run(report, options);
    report.text(
        "Every system of the paper's sections I and II on the same " + std::to_string(options.pick(24, 4)) +
        " plain scenes a distance (yaw and pitch to 20 degrees, 14 degrees about the optical axis): medians of the "
        "absolute errors in x, y, z, % of the distance, and of the axis, degrees. 'None, gross': scenes over all "
        "distances without an estimate, and with one that is off by more than 3 % of the distance. Time: processor's "
        "time over ours on the same scene, median; a sensor's own processing is not in it. Martinez to Shiu and Ahmad take "
        "our outline and inner part; the detectors find the outline, the rest is as for Shiu and Ahmad. Marks are simulated "
        "with normal noise of 0.1 px in x and in y, of the camera's pixels for all; two cameras are two rendered views; the "
        "range image has 2 cm of noise.");
    if (!has_ximgproc) {
        report.text("EdgeDrawing is not in the tables: this build did not find OpenCV's ximgproc.");
        report.not_judged("EdgeDrawing beside ours", "built without OpenCV's ximgproc (libopencv-contrib-dev)");
    }
    main_table(report, all);
    plot(report, all);
    compare_columns(report, all);
    marks_table(report, all);
    section_detectors(report, options);
    section_regions(report, options);
}

} // namespace accuracy
