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
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <getopt.h>

#include <opencv2/imgcodecs.hpp>

#include "measure.hpp"

using namespace accuracy;

namespace {

constexpr int skipped = 77;
constexpr double bar_measured_percent = 98;
constexpr double bar_z_percent = 0.33;
constexpr double bar_axis_deg = 1.4;

const Camera camera = {842.16254, 841.36851, 510.28250,  365.61146, -0.4352204,
                       0.2898102, 0.0008622, -0.0001471, -0.1643185};

struct Circle {
    std::string image;
    int col, row;
    Ellipse hand;       /* as seen */
    cv::Vec3d position; /* circle radii */
    cv::Vec3d axis;     /* away from the camera */
};

struct Errors {
    int circles = 0;
    std::vector<double> dx, dy, dz, axis, ellipse, shift_x, shift_y;

    void add(const Errors &other)
    {
        circles += other.circles;
        dx.insert(dx.end(), other.dx.begin(), other.dx.end());
        dy.insert(dy.end(), other.dy.begin(), other.dy.end());
        dz.insert(dz.end(), other.dz.begin(), other.dz.end());
        axis.insert(axis.end(), other.axis.begin(), other.axis.end());
        ellipse.insert(ellipse.end(), other.ellipse.begin(), other.ellipse.end());
        shift_x.insert(shift_x.end(), other.shift_x.begin(), other.shift_x.end());
        shift_y.insert(shift_y.end(), other.shift_y.begin(), other.shift_y.end());
    }

    double measured_percent() const { return 100.0 * static_cast<double>(axis.size()) / circles; }
};

std::vector<Circle> read_truth(const std::string &path)
{
    const std::string header = "image,col,row,ell_x,ell_y,ell_a,ell_b,ell_theta,X_R,Y_R,Z_R,nx,ny,nz,";
    std::ifstream in(path);
    std::string line;
    std::vector<Circle> circles;
    if (!std::getline(in, line) || line.compare(0, header.size(), header) != 0) {
        throw std::runtime_error(path + ": not the table expected");
    }
    while (std::getline(in, line)) {
        std::istringstream fields(line);
        std::string field;
        Circle c;
        std::vector<double> v;
        std::getline(fields, c.image, ',');
        while (std::getline(fields, field, ',')) {
            v.push_back(std::stod(field));
        }
        if (v.size() < 13) {
            throw std::runtime_error(path + ": a line is short");
        }
        c.col = static_cast<int>(v[0]);
        c.row = static_cast<int>(v[1]);
        c.hand = {v[2], v[3], v[4], v[5], v[6]};
        c.position = {v[7], v[8], v[9]};
        c.axis = -cv::normalize(cv::Vec3d(v[10], v[11], v[12]));
        circles.push_back(c);
    }
    return circles;
}

/* Square of +-half semi-axes about the hand ellipse, rounded outward to whole pixels. */
cv::Rect region_of(const Ellipse &e, double half)
{
    const int left = cvFloor(e.xc_px - half * e.a_px);
    const int top = cvFloor(e.yc_px - half * e.a_px);
    const int right = cvCeil(e.xc_px + half * e.a_px);
    const int bottom = cvCeil(e.yc_px + half * e.a_px);
    return {left, top, right - left + 1, bottom - top + 1};
}

void measure_circle(Errors &errors, std::map<std::string, int> &statuses, const cv::Mat &grey, const Circle &c,
                    double half, bool verbose)
{
    const drogue_model model = {DROGUE_Q16_ONE, 0, 0};
    const Measurement m = measure(grey, camera, model, region_of(c.hand, half));
    errors.circles++;
    if (verbose) {
        std::printf("  %-12s %d,%-2d a %.2f b %.2f  %-12s", c.image.c_str(), c.col, c.row, c.hand.a_px, c.hand.b_px,
                    drogue_status_name(m.raw.status));
    }
    if (!m.ok) {
        statuses[drogue_status_name(m.raw.status)]++;
    } else {
        const bool first = angle_between_deg(m.pose.axis, c.axis) <= angle_between_deg(m.alternative.axis, c.axis);
        const Pose &pose = first ? m.pose : m.alternative;
        const cv::Vec3d miss = (pose.position_m - c.position) * (100 / c.position[2]);
        errors.dx.push_back(std::fabs(miss[0]));
        errors.dy.push_back(std::fabs(miss[1]));
        errors.dz.push_back(std::fabs(miss[2]));
        errors.axis.push_back(angle_between_deg(pose.axis, c.axis));
        errors.ellipse.push_back(ellipse_error_px(m.seen, c.hand));
        errors.shift_x.push_back(m.seen.xc_px - c.hand.xc_px);
        errors.shift_y.push_back(m.seen.yc_px - c.hand.yc_px);
        if (verbose) {
            std::printf(" %+.3f %+.3f %+.3f  axis %.2f  ellipse %.3f  a %+.3f b %+.3f", miss[0], miss[1], miss[2],
                        errors.axis.back(), errors.ellipse.back(), m.seen.a_px - c.hand.a_px,
                        m.seen.b_px - c.hand.b_px);
        }
    }
    if (verbose) {
        std::printf("\n");
    }
}

void print(const std::string &name, const Errors &e)
{
    std::printf("%-12s %7d %9.1f %9.3f %7.3f %7.3f %8.2f %7.2f %7.2f %9.3f %+7.2f %+.2f\n", name.c_str(), e.circles,
                e.measured_percent(), mean(e.dx), mean(e.dy), mean(e.dz), mean(e.axis), median(e.axis),
                percentile(e.axis, 95), mean(e.ellipse), mean(e.shift_x), mean(e.shift_y));
}

struct Options {
    std::string folder = CIRCLE_BOARDS_DIR;
    double half = 1.25;
    bool verbose = false;
};

void usage(FILE *to)
{
    std::fputs("usage: circle_boards [--half K] [--verbose] [FOLDER]\n"
               "  --half K    regions of +-K semi-axes (1.25)\n"
               "  --verbose   a line for each circle\n"
               "  FOLDER      the photographs and truth.csv (" CIRCLE_BOARDS_DIR ")\n",
               to);
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
    if (!std::ifstream(options.folder + "/truth.csv")) {
        std::printf("circle_boards: SKIPPED, no truth.csv in %s\n", options.folder.c_str());
        return skipped;
    }
    std::vector<std::string> names;
    std::map<std::string, std::vector<Circle>> boards;
    for (const Circle &c : read_truth(options.folder + "/truth.csv")) {
        if (boards[c.image].empty()) {
            names.push_back(c.image);
        }
        boards[c.image].push_back(c);
    }
    std::map<std::string, int> statuses;
    Errors total;
    std::printf("%-12s %7s %9s %9s %7s %7s %8s %7s %7s %9s %s\n", "image", "circles", "measured%", "dx %", "dy %",
                "dz %", "axis deg", "median", "95th", "ellipse", "shift x, y");
    for (const std::string &name : names) {
        const cv::Mat colour = cv::imread(options.folder + "/" + name + ".png", cv::IMREAD_COLOR);
        if (colour.empty()) {
            throw std::runtime_error("cannot read " + name + ".png");
        }
        const cv::Mat grey = grey_of(colour);
        Errors errors;
        for (const Circle &c : boards[name]) {
            measure_circle(errors, statuses, grey, c, options.half, options.verbose);
        }
        print(name, errors);
        total.add(errors);
    }
    print("all", total);
    for (const auto &[name, count] : statuses) {
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
