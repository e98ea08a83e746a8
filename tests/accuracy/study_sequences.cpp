/* SPDX-License-Identifier: Apache-2.0 */
/* Sequences in the study: raw against filtered errors at three levels of turbulence, and a long run with blanked
 * frames. */
#include <array>
#include <cmath>
#include <limits>

#include "parallel.hpp"
#include "sequence.hpp"
#include "study.hpp"

namespace accuracy {

namespace {

constexpr int settle = 10; /* frames at the start of a track that do not count */
constexpr double degrees = 180 / CV_PI;
const std::array<const char *, 5> names = {"x", "y", "z", "yaw", "pitch"};

struct Level {
    const char *name;
    double amplitude_m;
    Look look;
    Background background;
};

std::vector<Level> levels()
{
    return {{"light", 0.1, Look::dark(), Background::sky()},
            {"moderate", 0.5, Look::dark(), Background::cloud()},
            {"severe", 1.1, Look::bright(), Background::ground()}};
}

SequenceOptions approach_of(const Level &level, const StudyOptions &options, uint64_t index)
{
    SequenceOptions o;
    o.seed = hash_at(options.seed, static_cast<int64_t>(index), 77);
    o.motion.amplitude_m = level.amplitude_m;
    o.motion.phase_rad = static_cast<double>(index);
    if (options.quick) {
        o.motion.from_m = 25;
        o.motion.to_m = 20;
    }
    o.scene.look = level.look;
    o.scene.background = level.background;
    o.frames = static_cast<int>(o.motion.approach_seconds() * o.frames_per_second);
    return o;
}

/* Back and forth between 25 and 10 m, where frames are cheap. */
SequenceOptions blanked_of(const StudyOptions &options)
{
    SequenceOptions o;
    o.seed = hash_at(options.seed, 3, 78);
    o.motion.to_m = 10;
    o.motion.shuttle = true;
    o.blanked_share = 0.05;
    o.scene.look = Look::dark();
    o.scene.background = Background::sky();
    o.frames = options.pick(10000, 200);
    return o;
}

/* Error of one parameter over time, raw and filtered; centimetres or degrees. */
void plot_error(Report &report, const Level &level, const SequenceRun &run, int parameter)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double unit = parameter < 3 ? 100 : degrees;
    const std::string name = names[static_cast<size_t>(parameter)];
    Series raw = {"single measurements", {}, {}, "lines"};
    Series filtered = {"filtered", {}, {}, "lines linewidth 2"};
    for (const SequenceFrame &f : run.frames) {
        raw.x.push_back(f.seconds);
        raw.y.push_back(f.measured ? pose_error(f.raw, f.truth)[parameter] * unit : nan);
        filtered.x.push_back(f.seconds);
        filtered.y.push_back(f.state != DROGUE_LOST ? pose_error(f.filtered, f.truth)[parameter] * unit : nan);
    }
    report.plot({"sequence_" + std::string(level.name) + "_" + name,
                 "Error of " + name + ", " + level.name + " turbulence.",
                 "time, s",
                 "error of " + name + (parameter < 3 ? ", cm" : ", degrees"),
                 {raw, filtered},
                 false,
                 false,
                 {"set key outside top center horizontal"}});
}

Report::Row error_row(const std::string &name, const cv::Vec<double, 5> &errors)
{
    Report::Row row = {name};
    for (int k = 0; k < 5; k++) {
        row.push_back(significant(errors[k] * (k < 3 ? 1000 : degrees), 3));
    }
    return row;
}

double worst_ratio(const SequenceErrors &e, Report::Row &row)
{
    double worst = 0;
    for (int k = 0; k < 5; k++) {
        const double ratio = e.filtered[k] / e.raw[k];
        row.push_back(fixed(ratio, 2));
        worst = std::isfinite(ratio) ? std::max(worst, ratio) : ratio;
    }
    return worst;
}

struct Count {
    int tracked = 0, coasted = 0, gated = 0;
};

Count count_states(const SequenceRun &run)
{
    Count c;
    for (const SequenceFrame &f : run.frames) {
        c.tracked += f.state == DROGUE_TRACKING;
        c.coasted += f.state == DROGUE_COASTING;
        c.gated += f.gated;
    }
    return c;
}

void approaches(Report &report, const std::vector<SequenceRun> &runs, const StudyOptions &options)
{
    std::vector<Report::Row> rows, counts;
    const std::vector<Level> all = levels();
    for (size_t i = 0; i < all.size(); i++) {
        const SequenceErrors e = sequence_errors(runs[i], settle);
        const Count c = count_states(runs[i]);
        Report::Row ratio = {std::string(all[i].name) + ", ratio"};
        const double worst = worst_ratio(e, ratio);
        rows.push_back(error_row(std::string(all[i].name) + ", raw", e.raw));
        rows.push_back(error_row(std::string(all[i].name) + ", filtered", e.filtered));
        rows.push_back(ratio);
        counts.push_back({all[i].name, fixed(all[i].amplitude_m, 1), std::to_string(runs[i].frames.size()),
                          std::to_string(c.tracked), std::to_string(c.coasted), std::to_string(c.gated),
                          std::to_string(runs[i].losses)});
        report.at_most("filtered over raw error, " + std::string(all[i].name) + " turbulence, worst of five", worst, 1,
                       "");
    }
    const SequenceOptions first = approach_of(all[0], options, 0);
    report.text("Approach from " + fixed(first.motion.from_m, 0) + " to " + fixed(first.motion.to_m, 0) + " m at " +
                fixed(first.motion.speed_mps, 1) + " m/s, " + fixed(first.frames_per_second, 0) +
                " frames a second; the drogue swings across at 0.2 Hz and down at 0.15 Hz, its axis along with the "
                "hose. The first frame is searched as a whole; from there the tracker chooses its regions.");
    report.table({"turbulence", "amplitude, m", "frames", "tracked", "coasted", "refused", "lost"}, counts);
    report.text("Root mean square errors over the tracked frames, the first " + std::to_string(settle) +
                " left out; a raw pose whose orientation was mistaken counts as it is.");
    report.table({"turbulence", "x, mm", "y, mm", "z, mm", "yaw, degrees", "pitch, degrees"}, rows);
    for (size_t i = 0; i < all.size(); i++) {
        for (const int parameter : {0, 2, 3}) {
            plot_error(report, all[i], runs[i], parameter);
        }
    }
}

/* Largest errors of the prediction by the number of frames coasted in a row. */
void coasting_table(Report &report, const SequenceRun &run)
{
    constexpr size_t longest = 4;
    std::array<std::array<std::vector<double>, 3>, longest> cm;
    size_t coasted = 0;
    for (const SequenceFrame &f : run.frames) {
        coasted = f.state == DROGUE_COASTING ? coasted + 1 : 0;
        if (coasted >= 1 && coasted <= longest) {
            for (int k = 0; k < 3; k++) {
                cm[coasted - 1][static_cast<size_t>(k)].push_back(std::fabs(pose_error(f.filtered, f.truth)[k]) * 100);
            }
        }
    }
    std::vector<Report::Row> rows;
    for (size_t n = 0; n < longest; n++) {
        Report::Row row = {std::to_string(n + 1), std::to_string(cm[n][0].size())};
        for (const auto &axis : cm[n]) {
            row.push_back(significant(median(axis), 2));
            row.push_back(significant(percentile(axis, 100), 2));
        }
        rows.push_back(row);
    }
    report.text("Error of the prediction while coasting, median and largest:");
    report.table({"frame without measurement", "times", "x, cm", "largest", "y, cm", "largest", "z, cm", "largest"},
                 rows);
}

void blanked(Report &report, const SequenceRun &run)
{
    const Count c = count_states(run);
    const SequenceErrors e = sequence_errors(run, settle);
    int blank = 0;
    for (const SequenceFrame &f : run.frames) {
        blank += f.blanked;
    }
    report.text("A run of " + std::to_string(run.frames.size()) +
                " frames, swinging between 25 and 10 m in "
                "moderate turbulence, with " +
                std::to_string(blank) + " frames blanked at random: " + std::to_string(c.tracked) + " tracked, " +
                std::to_string(c.coasted) + " coasted through, " + std::to_string(c.gated) +
                " of them refused by the gate, " + std::to_string(run.losses) + " losses.");
    report.table({"root mean square", "x, mm", "y, mm", "z, mm", "yaw, degrees", "pitch, degrees"},
                 {error_row("raw", e.raw), error_row("filtered", e.filtered)});
    coasting_table(report, run);
    report.at_most("losses of track with 5 % of " + std::to_string(run.frames.size()) + " frames blanked", run.losses,
                   0, "");
}

} // namespace

void section_sequences(Report &report, const StudyOptions &options)
{
    const std::vector<Level> all = levels();
    std::vector<SequenceRun> runs(all.size() + 1);
    std::vector<SequenceOptions> jobs;
    report.section("Sequences through the tracker");
    jobs.push_back(blanked_of(options)); /* the longest first */
    for (size_t i = 0; i < all.size(); i++) {
        jobs.push_back(approach_of(all[i], options, i));
    }
    jobs[0].progress = [&](size_t frames, size_t of) {
        if (frames % 50 == 0 || frames == of) {
            report.progress("long sequence", frames, of);
        }
    };
    parallel_for(
        jobs.size(), options.threads, [&](size_t i) { runs[i] = run_sequence(jobs[i]); }, [](size_t, size_t) {});
    const SequenceRun long_run = runs[0];
    runs.erase(runs.begin());
    approaches(report, runs, options);
    blanked(report, long_run);
}

} // namespace accuracy
