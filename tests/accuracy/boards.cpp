/* SPDX-License-Identifier: Apache-2.0 */
/* Reads the boards' truth and measures their circles. */
#include "boards.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>

#include "measure.hpp"

namespace accuracy {

namespace {

std::vector<BoardCircle> read_truth(const std::string &path)
{
    const std::string header = "image,col,row,ell_x,ell_y,ell_a,ell_b,ell_theta,X_R,Y_R,Z_R,nx,ny,nz,";
    std::ifstream in(path);
    std::string line;
    std::vector<BoardCircle> circles;
    if (!std::getline(in, line) || line.compare(0, header.size(), header) != 0) {
        throw std::runtime_error(path + ": not the table expected");
    }
    while (std::getline(in, line)) {
        std::istringstream fields(line);
        std::string field;
        BoardCircle c;
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

void measure_circle(BoardErrors &errors, std::map<std::string, int> &statuses, const cv::Mat &grey,
                    const BoardCircle &c, const cv::Rect &region, bool verbose)
{
    const drogue_model model = {DROGUE_Q16_ONE, 0, 0};
    const Measurement m = measure(grey, boards_camera, model, region);
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

} // namespace

const Camera boards_camera = {842.16254, 841.36851, 510.28250,  365.61146, -0.4352204,
                              0.2898102, 0.0008622, -0.0001471, -0.1643185};

const char *const boards_folder = CIRCLE_BOARDS_DIR;

void BoardErrors::add(const BoardErrors &other)
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

bool boards_there(const std::string &folder) { return std::ifstream(folder + "/truth.csv").good(); }

void visit_circles(const std::string &folder, double half, const BoardVisitor &visit)
{
    std::string shown;
    cv::Mat grey;
    for (const BoardCircle &c : read_truth(folder + "/truth.csv")) {
        if (c.image != shown) {
            const cv::Mat colour = cv::imread(folder + "/" + c.image + ".png", cv::IMREAD_COLOR);
            if (colour.empty()) {
                throw std::runtime_error("cannot read " + c.image + ".png");
            }
            grey = grey_of(colour);
            shown = c.image;
        }
        visit(c, grey, region_of(c.hand, half));
    }
}

Boards measure_boards(const std::string &folder, double half, bool verbose)
{
    Boards boards;
    visit_circles(folder, half, [&](const BoardCircle &c, const cv::Mat &grey, const cv::Rect &region) {
        auto at = std::find(boards.names.begin(), boards.names.end(), c.image);
        if (at == boards.names.end()) {
            boards.names.push_back(c.image);
            boards.errors.emplace_back();
            at = boards.names.end() - 1;
        }
        measure_circle(boards.errors[static_cast<size_t>(at - boards.names.begin())], boards.statuses, grey, c, region,
                       verbose);
    });
    for (const BoardErrors &errors : boards.errors) {
        boards.total.add(errors);
    }
    return boards;
}

} // namespace accuracy
