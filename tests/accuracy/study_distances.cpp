/* SPDX-License-Identifier: Apache-2.0 */
/* Medians on plain scenes per distance, beside those of the double-precision prototype. */
#include <array>

#include "study.hpp"

namespace accuracy {

namespace {

struct Mark {
    double distance_m;
    std::array<double, 6> prototype; /* ellipse, centroid, x, y, z, axis without subpixel edges */
    double z_percent, axis_deg;      /* with subpixel edges: the bars */
    double axis_bar_deg;             /* both features together, where it is lower */
};

constexpr std::array<Mark, 5> marks = {{
    {3, {0.03, 0.25, 0.002, 0.001, 0.005, 0.08}, 0.004, 0.016, 0.016},
    {5, {0.04, 0.11, 0.005, 0.005, 0.03, 0.07}, 0.017, 0.03, 0.03},
    {10, {0.05, 0.16, 0.004, 0.005, 0.035, 0.32}, 0.046, 0.08, 0.08},
    {15, {0.07, 0.12, 0.018, 0.012, 0.14, 0.49}, 0.12, 0.23, 0.20},
    {25, {0.08, 0.18, 0.041, 0.039, 0.32, 1.0}, 0.24, 0.50, 0.35},
}};

struct Medians {
    double ellipse, centroid;
    Summary summary;
};

Medians medians_at(Report &report, const StudyOptions &options, double distance_m)
{
    std::vector<Trial> trials;
    for (int i = 0; i < options.pick(96, 12); i++) {
        trials.push_back(trial_of(plain_scene(options.seed, distance_m, i), i));
    }
    const std::string what = "plain scenes at " + fixed(distance_m, 0) + " m";
    const std::vector<Outcome> outcomes = run_trials(trials, run_options(report, options, what));
    std::vector<double> ellipse, centroid;
    for (const Outcome &o : outcomes) {
        if (o.verdict == Verdict::right) {
            ellipse.push_back(o.ellipse_px);
            if (o.inner) {
                centroid.push_back(o.centroid_px);
            }
        }
    }
    return {median(ellipse), median(centroid), summarise(outcomes)};
}

std::string beside(double value, double mark) { return significant(value, 2) + " (" + plain(mark) + ")"; }

} // namespace

void section_distances(Report &report, const StudyOptions &options)
{
    report.section("Plain scenes by distance");
    report.text(
        "Medians over " + std::to_string(options.pick(96, 12)) +
        " scenes a row; in brackets the double-precision prototype's: without subpixel edges, and with them in "
        "the columns marked 'subpixel', which are the bars. x, y, z are in % of the distance, the axis in "
        "degrees. Yaw and pitch to 20 degrees, three backgrounds, blur of 0.5 to 0.9 px, noise of 2 grey levels." +
        (options.quick ? " With so few scenes a median scatters: the quick run judges against 1.5 times the bar."
                       : ""));
    const double slack = options.quick ? 1.5 : 1;
    std::vector<Report::Row> rows;
    Series z = {"z", {}, {}}, z_mark = {"z, prototype with subpixel edges", {}, {}};
    Series axis = {"axis", {}, {}}, axis_mark = {"axis, prototype with subpixel edges", {}, {}};
    for (const Mark &mark : marks) {
        const Medians m = medians_at(report, options, mark.distance_m);
        const Summary &s = m.summary;
        const auto &p = mark.prototype;
        rows.push_back({fixed(mark.distance_m, 0) + " m", beside(m.ellipse, p[0]), beside(m.centroid, p[1]),
                        beside(s.median_percent[0], p[2]), beside(s.median_percent[1], p[3]),
                        beside(s.median_percent[2], p[4]), beside(s.median_axis, p[5]),
                        beside(s.median_percent[2], mark.z_percent), beside(s.median_axis, mark.axis_deg),
                        std::to_string(s.scenes - s.right), std::to_string(s.twin)});
        const std::string at = " at " + fixed(mark.distance_m, 0) + " m, median";
        report.at_most("z" + at, s.median_percent[2], slack * mark.z_percent, "%");
        report.at_most("axis" + at, s.median_axis, slack * mark.axis_bar_deg, "degrees");
        z.x.push_back(mark.distance_m), z.y.push_back(s.median_percent[2]);
        axis.x.push_back(mark.distance_m), axis.y.push_back(s.median_axis);
        z_mark.x.push_back(mark.distance_m), z_mark.y.push_back(mark.z_percent);
        axis_mark.x.push_back(mark.distance_m), axis_mark.y.push_back(mark.axis_deg);
    }
    report.table({"distance", "ellipse, px", "centroid, px", "x", "y", "z", "axis", "z, subpixel", "axis, subpixel",
                  "not right", "twin"},
                 rows);
    report.plot({"distances",
                 "Medians on plain scenes against distance.",
                 "distance, m",
                 "z error, % of distance; axis error, degrees",
                 {z, z_mark, axis, axis_mark},
                 true,
                 true,
                 {"set xrange [2.7:28]", "set xtics (3, 5, 10, 15, 25)"}});
}

} // namespace accuracy
