/* SPDX-License-Identifier: Apache-2.0 */
/* What one frame measures over scenes that vary the drogue itself (varied.hpp).
 *
 *  ok, wrong    measured; of these the ellipse off by more than 1 px and 3 % of the semi-major axis
 *  inner, bad   inner part believed; of these its centre off by more than 1 px and 4 % of the disc's semi-axis
 *  open, twin   orientation not resolved; resolved to the wrong twin
 *  rim, disc    mean error of the outline, of the inner centre, px
 *  z, axis      mean absolute error over all that was measured, % of the distance and degrees
 *  NEES         mean normalised error squared per degree of freedom over what was measured: all, resolved, not resolved;
 *               and the median over all over that of chi-square
 */
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <getopt.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "evaluate.hpp"
#include "processing.hpp"
#include "varied.hpp"

using namespace accuracy;

namespace {

struct Options {
    int scenes = 24;
    uint64_t seed = 1;
    bool held_out = false;
    bool verbose = false;
    bool rows = true;
    std::string only, sheet;
    RunOptions run;
};

bool bad_inner(const Trial &t, const Outcome &o)
{
    const Drogue &d = t.scene.drogue;
    const Ellipse disc = project_circle(t.scene.camera, t.scene.pose, d.inner_radius_m, d.inner_depth_m);
    return o.inner && o.centroid_px > std::max(1.0, 0.04 * disc.a_px);
}

struct Row {
    int scenes = 0, ok = 0, wrong = 0, inner = 0, bad = 0, open = 0, twin = 0;
    std::vector<double> rim, disc, z, axis, nees, resolved, unresolved;

    void add(const Trial &t, const Outcome &o)
    {
        scenes++;
        if (o.verdict == Verdict::unmeasured) {
            return;
        }
        ok++;
        wrong += o.verdict == Verdict::wrong;
        inner += o.inner;
        bad += bad_inner(t, o);
        open += !o.resolved;
        twin += o.twin;
        rim.push_back(o.ellipse_px);
        if (o.inner) {
            disc.push_back(o.centroid_px);
        }
        z.push_back(o.percent()[2]);
        axis.push_back(o.axis_deg);
        if (o.has_covariance) {
            nees.push_back(o.nees / 5);
            (o.resolved ? resolved : unresolved).push_back(o.nees / 5);
        }
    }

    void print(const char *name) const
    {
        std::printf("%-8s %4d %4d %5d | %5d %4d %5d %4d | %6.3f %6.3f %7.4f %7.3f | %9.2f %8.2f %9.2f %7.2f\n", name,
                    scenes, ok, wrong, inner, bad, open, twin, mean(rim), mean(disc), mean(z), mean(axis), mean(nees),
                    mean(resolved), mean(unresolved), median(nees) * 5 / 4.351);
        std::fflush(stdout);
    }
};

/* The pictures of a variety side by side, each 160 px. */
void write_sheet(const std::string &path, const std::vector<cv::Mat> &pictures)
{
    const int side = 200;
    const int columns = 8;
    const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
    cv::Mat sheet(rows * side, columns * side, CV_8UC3, cv::Scalar(0, 0, 0));
    for (size_t i = 0; i < pictures.size(); i++) {
        cv::Mat small;
        cv::resize(pictures[i], small, {side - 4, side - 4}, 0, 0, cv::INTER_AREA);
        small.copyTo(sheet(
            cv::Rect(static_cast<int>(i) % columns * side, static_cast<int>(i) / columns * side, side - 4, side - 4)));
    }
    if (!cv::imwrite(path, sheet)) {
        std::fprintf(stderr, "varied_table: cannot write %s\n", path.c_str());
        std::exit(2);
    }
}

/* The inner disc's radius over the one that the measured pose expects, less 1, in percent. */
double disc_size_percent(const Trial &t, const Measurement &m)
{
    const Drogue &d = t.scene.drogue;
    const Ellipse expected = project_circle(t.scene.camera, m.pose, d.inner_radius_m, d.inner_depth_m);
    return 100 * (std::sqrt(m.raw.inner.area_px / (CV_PI * expected.a_px * expected.b_px)) - 1);
}

void print_trial(const Trial &t, const Measurement &m, const Outcome &o)
{
    std::printf("  %3d a %6.2f tilt %4.1f %-10s", t.index, t.rim.a_px,
                angle_between_deg(t.pose.axis, cv::normalize(t.pose.position_m)), drogue_status_name(m.raw.status));
    if (m.ok) {
        std::printf(
            " rim %.3f a %+.3f disc %.3f size %+.1f%% z %+.3f%% axis %.3f other %.2f cover %.2f nees %.1f%s%s%s%s%s",
            o.ellipse_px, m.ideal.a_px - t.rim.a_px, o.centroid_px, disc_size_percent(t, m),
            100 * o.position_m[2] / o.distance_m, o.axis_deg, angle_between_deg(m.alternative.axis, t.pose.axis),
            from_q16(m.raw.cover_q16), o.nees / 5, o.verdict == Verdict::wrong ? " WRONG" : "",
            o.inner ? "" : " NO-INNER", bad_inner(t, o) ? " BAD-INNER" : "", o.resolved ? "" : " OPEN",
            o.twin ? " TWIN" : "");
    }
    std::printf("\n");
}

void run_variety(Variety variety, const Options &options, Row &total)
{
    std::vector<Trial> trials;
    std::vector<cv::Mat> pictures(static_cast<size_t>(options.scenes));
    for (int i = 0; i < options.scenes; i++) {
        trials.push_back(varied_trial(options.seed, variety, i, options.held_out));
    }
    std::vector<Measurement> measured(trials.size());
    RunOptions run = options.run;
    run.inspect = [&](const Trial &t, const cv::Mat &region, const Measurement &m, const Outcome &) {
        measured[static_cast<size_t>(t.index)] = m;
        if (!options.sheet.empty()) {
            pictures[static_cast<size_t>(t.index)] = overlay(t, region, m);
        }
    };
    const std::vector<Outcome> outcomes = run_trials(trials, run);
    Row row;
    for (size_t i = 0; i < trials.size(); i++) {
        row.add(trials[i], outcomes[i]);
        total.add(trials[i], outcomes[i]);
        if (options.verbose) {
            print_trial(trials[i], measured[i], outcomes[i]);
        }
    }
    if (options.rows) {
        row.print(name_of(variety));
    }
    if (!options.sheet.empty()) {
        write_sheet(options.sheet + "/" + name_of(variety) + ".png", pictures);
    }
}

void usage(FILE *to)
{
    std::fputs(
        "usage: varied_table [--scenes N] [--seed S] [--held-out] [--only NAME] [--processing NAME] [--verbose]\n"
        "                    [--side PART] [--cache DIR] [--sheet DIR]\n"
        "  --scenes N    scenes of each variety (24)\n"
        "  --held-out    from the ranges that nothing was tuned on\n"
        "  --only NAME   one variety\n"
        "  --processing NAME  of the pictures (processing.hpp); 'all': a line for each, and one for none\n"
        "  --side PART   regions with so many of the sides that are asked for (1)\n"
        "  --verbose     a line for each scene\n"
        "  --cache DIR   keep rendered regions there\n"
        "  --sheet DIR   write pictures there: truth green, measurement red\n",
        to);
}

Options parse(int argc, char **argv)
{
    const option known[] = {{"scenes", required_argument, nullptr, 'n'},
                            {"seed", required_argument, nullptr, 's'},
                            {"held-out", no_argument, nullptr, 'o'},
                            {"only", required_argument, nullptr, 'k'},
                            {"processing", required_argument, nullptr, 'r'},
                            {"side", required_argument, nullptr, 'w'},
                            {"verbose", no_argument, nullptr, 'v'},
                            {"cache", required_argument, nullptr, 'c'},
                            {"sheet", required_argument, nullptr, 'p'},
                            {"help", no_argument, nullptr, 'h'},
                            {nullptr, 0, nullptr, 0}};
    Options o;
    int c;
    while ((c = getopt_long(argc, argv, "", known, nullptr)) != -1) {
        switch (c) {
        case 'n': o.scenes = std::atoi(optarg); break;
        case 's': o.seed = std::strtoull(optarg, nullptr, 10); break;
        case 'o': o.held_out = true; break;
        case 'k': o.only = optarg; break;
        case 'r': o.run.processing = optarg; break;
        case 'w': o.run.side = std::atof(optarg); break;
        case 'v': o.verbose = true; break;
        case 'c': o.run.cache = optarg; break;
        case 'p': o.sheet = optarg; break;
        case 'h': usage(stdout); std::exit(0);
        default: usage(stderr); std::exit(2);
        }
    }
    const std::vector<std::string> &known_names = processings();
    if (optind != argc || o.scenes < 1 || !(o.run.side > 0) ||
        (!o.run.processing.empty() && o.run.processing != "all" &&
         std::find(known_names.begin(), known_names.end(), o.run.processing) == known_names.end())) {
        usage(stderr);
        std::exit(2);
    }
    return o;
}

} // namespace

int main(int argc, char **argv)
{
    Options options = parse(argc, argv);
    const bool each = options.run.processing == "all";
    std::vector<std::string> names = {options.run.processing};
    bool any = false;
    if (!options.sheet.empty()) {
        std::filesystem::create_directories(options.sheet);
    }
    std::printf("%-8s %4s %4s %5s | %5s %4s %5s %4s | %6s %6s %7s %7s | %9s %8s %9s %7s\n", "", "n", "ok", "wrong",
                "inner", "bad", "open", "twin", "rim px", "disc", "z %", "axis", "NEES all", "resolved", "open",
                "median");
    if (each) {
        names = processings();
        names.insert(names.begin(), "");
        options.rows = false;
    }
    for (const std::string &name : names) {
        Row total;
        options.run.processing = name;
        for (int v = 0; v < varieties; v++) {
            const auto variety = static_cast<Variety>(v);
            if (options.only.empty() || options.only == name_of(variety)) {
                run_variety(variety, options, total);
                any = true;
            }
        }
        total.print(!each ? "all" : name.empty() ? "none" : name.c_str());
    }
    if (!any) {
        std::fprintf(stderr, "varied_table: no variety %s\n", options.only.c_str());
        return 2;
    }
    return 0;
}
