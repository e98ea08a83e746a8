/* SPDX-License-Identifier: Apache-2.0 */
/* How often the measurement is right, wrong or refused under every condition (conditions.hpp), and how accurate.
 *
 *  right       ellipse within max(1 px, 3 % of the semi-major axis) of the truth
 *  wrong       reported as ok, but not right
 *  unmeas.     no pose; the statuses are counted at the end of the line
 *  no inner    measured, but without the inner part
 *  open        measured, orientation not resolved
 *  twin        resolved, but the other pose is nearer to the true axis, by more than 2 degrees
 *  x, y, z     median absolute error, % of the distance; 'xyz' of their mean, median and mean over the scenes
 *  axis        angle between measured and true axis of the pose reported, degrees: median, mean, 90th percentile
 *  NEES        normalised error squared over right scenes with resolved orientation: mean (5 when calibrated), median
 *              (4.35), mean over x, y, z (3), mean over yaw and pitch (2)
 *
 * Errors are over the right scenes. */
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <getopt.h>

#include <opencv2/imgcodecs.hpp>

#include "evaluate.hpp"

using namespace accuracy;

namespace {

struct Options {
    int scenes = 84;
    int first = 0;
    uint64_t seed = 1;
    std::string only;
    bool verbose = false;
    bool dump_all = false;
    std::string dump;
    RunOptions run;
};

const char *verdict_name(Verdict v)
{
    return v == Verdict::right ? "right" : v == Verdict::wrong ? "WRONG" : "UNMEASURED";
}

void print_trial(const Trial &t, const Measurement &m, const Outcome &o)
{
    std::printf("  %-12s %4d  %5.2f m  a %6.2f  tilt %4.1f  %-10s", name_of(t.condition), t.index, t.distance_m(),
                t.rim.a_px, angle_between_deg(t.pose.axis, cv::normalize(t.pose.position_m)), verdict_name(o.verdict));
    if (m.ok) {
        std::printf(" ellipse %.3f px  xyz %.4f %.4f %.4f %%  axis %.3f  other %.2f  ambiguity %.2f  cover %.2f  nees "
                    "%.1f%s%s%s",
                    o.ellipse_px, o.percent()[0], o.percent()[1], o.percent()[2], o.axis_deg,
                    angle_between_deg(m.alternative.axis, t.pose.axis), from_q16(m.raw.ambiguity_q16),
                    from_q16(m.raw.cover_q16), o.nees, o.inner ? "" : "  NO INNER", o.resolved ? "" : "  OPEN",
                    o.twin ? "  TWIN" : "");
    } else {
        std::printf(" %s", drogue_status_name(o.status));
    }
    std::printf("\n");
}

void print_summary(const char *name, const Summary &s)
{
    std::printf("%-12s | %6d %6d %5d %7d %8d %5d %5d | %6.4f %6.4f %6.4f | %6.4f %7.4f | %6.3f %6.3f %6.3f |", name,
                s.scenes, s.right, s.wrong, s.unmeasured, s.no_inner, s.unresolved, s.twin, s.median_percent[0],
                s.median_percent[1], s.median_percent[2], s.median_position, s.mean_position, s.median_axis,
                s.mean_axis, s.p90_axis);
    if (s.with_covariance > 0) {
        std::printf(" %6.2f %6.2f %6.2f %6.2f", s.mean_nees, s.median_nees, s.mean_nees_position, s.mean_nees_angles);
    } else {
        std::printf(" %27s", "no covariance");
    }
    for (const auto &[status, count] : s.statuses) {
        std::printf("  %s %d", status.c_str(), count);
    }
    std::printf("\n");
    std::fflush(stdout);
}

void usage(FILE *to)
{
    std::fputs(
        "usage: robustness [--scenes N] [--first I] [--seed S] [--only NAME] [--verbose] [--dump DIR]\n"
        "                  [--dump-all DIR] [--cache DIR] [--threads N]\n"
        "  --scenes N    scenes a condition (84)\n"
        "  --first I     index of the first (0)\n"
        "  --seed S      seed of the scenes (1)\n"
        "  --only NAME   one condition\n"
        "  --verbose     a line for each scene, in no fixed order\n"
        "  --dump DIR    write scenes that are not right, or twins, as PNG: truth green, measurement red\n"
        "  --dump-all DIR  write every scene\n"
        "  --cache DIR   keep rendered regions there and use those that are (empty it when the renderer changes)\n"
        "  --threads N   as many as the machine has\n",
        to);
}

Options parse(int argc, char **argv)
{
    const option known[] = {{"scenes", required_argument, nullptr, 'n'},
                            {"first", required_argument, nullptr, 'f'},
                            {"seed", required_argument, nullptr, 's'},
                            {"only", required_argument, nullptr, 'o'},
                            {"verbose", no_argument, nullptr, 'v'},
                            {"dump", required_argument, nullptr, 'd'},
                            {"dump-all", required_argument, nullptr, 'D'},
                            {"cache", required_argument, nullptr, 'c'},
                            {"threads", required_argument, nullptr, 't'},
                            {"help", no_argument, nullptr, 'h'},
                            {nullptr, 0, nullptr, 0}};
    Options o;
    int c;
    while ((c = getopt_long(argc, argv, "", known, nullptr)) != -1) {
        switch (c) {
        case 'n': o.scenes = std::atoi(optarg); break;
        case 'f': o.first = std::atoi(optarg); break;
        case 's': o.seed = std::strtoull(optarg, nullptr, 10); break;
        case 'o': o.only = optarg; break;
        case 'v': o.verbose = true; break;
        case 'd': o.dump = optarg; break;
        case 'D': o.dump = optarg, o.dump_all = true; break;
        case 'c': o.run.cache = optarg; break;
        case 't': o.run.threads = std::atoi(optarg); break;
        case 'h': usage(stdout); std::exit(0);
        default: usage(stderr); std::exit(2);
        }
    }
    bool known_name = o.only.empty();
    for (int i = 0; i < conditions; i++) {
        known_name = known_name || o.only == name_of(static_cast<Condition>(i));
    }
    if (optind != argc || o.scenes < 1 || o.first < 0 || !known_name) {
        usage(stderr);
        std::exit(2);
    }
    return o;
}

void dump(const Options &options, const Trial &t, const cv::Mat &region, const Measurement &m)
{
    const std::string path = options.dump + "/" + name_of(t.condition) + "_" + std::to_string(t.index) + ".png";
    if (!cv::imwrite(path, overlay(t, region, m))) {
        std::fprintf(stderr, "robustness: cannot write %s\n", path.c_str());
        std::exit(2);
    }
}

} // namespace

int main(int argc, char **argv)
{
    Options options = parse(argc, argv);
    if (!options.dump.empty()) {
        std::filesystem::create_directories(options.dump);
    }
    options.run.inspect = [&](const Trial &t, const cv::Mat &region, const Measurement &m, const Outcome &o) {
        if (options.verbose) {
            print_trial(t, m, o);
        }
        if (!options.dump.empty() && (options.dump_all || o.verdict != Verdict::right || o.twin)) {
            dump(options, t, region, m);
        }
    };
    std::printf("%-12s | %6s %6s %5s %7s %8s %5s %5s | %-20s | %-14s | %-20s | %s\n", "", "scenes", "right", "wrong",
                "unmeas.", "no inner", "open", "twin", "x, y, z, %", "xyz, %", "axis, degrees", "NEES");
    std::vector<Outcome> all;
    for (int i = 0; i < conditions; i++) {
        const auto condition = static_cast<Condition>(i);
        if (!options.only.empty() && options.only != name_of(condition)) {
            continue;
        }
        std::vector<Trial> trials;
        for (int k = 0; k < options.scenes; k++) {
            trials.push_back(trial(options.seed, condition, options.first + k));
        }
        const std::vector<Outcome> outcomes = run_trials(trials, options.run);
        print_summary(name_of(condition), summarise(outcomes));
        all.insert(all.end(), outcomes.begin(), outcomes.end());
    }
    const Summary s = summarise(all);
    print_summary("total", s);
    std::printf("robustness: scenes=%d right=%d wrong=%d unmeasured=%d twin=%d right%%=%.2f wrong%%=%.2f\n", s.scenes,
                s.right, s.wrong, s.unmeasured, s.twin, 100.0 * s.right / s.scenes, 100.0 * s.wrong / s.scenes);
    return 0;
}
