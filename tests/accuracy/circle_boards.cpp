/* SPDX-License-Identifier: Apache-2.0 */
/* Pose of each circle on photographs of calibration boards, against the pose from hand-labelled ellipses of all
 * boards jointly. A flat circle allows two poses: the one with the better axis counts. Exit status 1 when a bar is
 * missed, 77 when the photographs are not there.
 *
 *  dx, dy, dz  mean absolute error of the position, % of z
 *  axis        angle between measured and true normal, degrees
 *  ellipse     mean over 360 directions of the difference from the hand-labelled outline, px, as seen
 *  shift       mean signed distance of the centre from the hand-labelled one, px: what all circles share is where the
 *              labels put a pixel's centre, not an error */
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include <getopt.h>

#include "boards.hpp"
#include "measure.hpp"

using namespace accuracy;

namespace {

constexpr int skipped = 77;
constexpr double bar_measured_percent = 98;
constexpr double bar_z_percent = 0.33;
constexpr double bar_axis_deg = 1.4;

void print(const std::string &name, const BoardErrors &e)
{
    std::printf("%-12s %7d %9.1f %9.3f %7.3f %7.3f %8.2f %7.2f %7.2f %9.3f %+7.2f %+.2f\n", name.c_str(), e.circles,
                e.measured_percent(), mean(e.dx), mean(e.dy), mean(e.dz), mean(e.axis), median(e.axis),
                percentile(e.axis, 95), mean(e.ellipse), mean(e.shift_x), mean(e.shift_y));
}

struct Options {
    std::string folder = boards_folder;
    double half = 1.25;
    bool verbose = false;
};

void usage(FILE *to)
{
    std::fprintf(to,
                 "usage: circle_boards [--half K] [--verbose] [FOLDER]\n"
                 "  --half K    regions of +-K semi-axes (1.25)\n"
                 "  --verbose   a line for each circle\n"
                 "  FOLDER      the photographs and truth.csv (%s)\n",
                 boards_folder);
}

Options parse(int argc, char **argv)
{
    const option known[] = {{"half", required_argument, nullptr, 'k'},
                            {"verbose", no_argument, nullptr, 'v'},
                            {"help", no_argument, nullptr, 'h'},
                            {nullptr, 0, nullptr, 0}};
    Options o;
    int c;
    while ((c = getopt_long(argc, argv, "", known, nullptr)) != -1) {
        switch (c) {
        case 'k': o.half = std::atof(optarg); break;
        case 'v': o.verbose = true; break;
        case 'h': usage(stdout); std::exit(0);
        default: usage(stderr); std::exit(2);
        }
    }
    if (optind < argc) {
        o.folder = argv[optind++];
    }
    if (optind != argc || !(o.half > 0)) {
        usage(stderr);
        std::exit(2);
    }
    return o;
}

int run(const Options &options)
{
    if (!boards_there(options.folder)) {
        std::printf("circle_boards: SKIPPED, no truth.csv in %s\n", options.folder.c_str());
        return skipped;
    }
    const Boards boards = measure_boards(options.folder, options.half, options.verbose);
    const BoardErrors &total = boards.total;
    std::printf("%-12s %7s %9s %9s %7s %7s %8s %7s %7s %9s %s\n", "image", "circles", "measured%", "dx %", "dy %",
                "dz %", "axis deg", "median", "95th", "ellipse", "shift x, y");
    for (size_t i = 0; i < boards.names.size(); i++) {
        print(boards.names[i], boards.errors[i]);
    }
    print("all", total);
    for (const auto &[name, count] : boards.statuses) {
        std::printf("not measured: %s %d\n", name.c_str(), count);
    }
    const bool met = total.measured_percent() >= bar_measured_percent && mean(total.dz) <= bar_z_percent &&
                     mean(total.axis) <= bar_axis_deg;
    std::printf("circle_boards: circles=%d measured=%.1f%% dz=%.3f%% axis=%.2f (bars %.0f%%, %.2f%%, %.1f) bars=%s\n",
                total.circles, total.measured_percent(), mean(total.dz), mean(total.axis), bar_measured_percent,
                bar_z_percent, bar_axis_deg, met ? "met" : "missed");
    return met ? 0 : 1;
}

} // namespace

int main(int argc, char **argv)
{
    try {
        return run(parse(argc, argv));
    } catch (const std::exception &e) {
        std::fprintf(stderr, "circle_boards: %s\n", e.what());
        return 2;
    }
}
