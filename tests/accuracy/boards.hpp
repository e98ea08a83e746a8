/* SPDX-License-Identifier: Apache-2.0 */
/* Pose of each circle on photographs of calibration boards, against the pose from hand-labelled ellipses of all
 * boards jointly. A flat circle allows two poses: the one with the better axis counts. */
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "geometry.hpp"

namespace accuracy {

struct BoardErrors {
    int circles = 0;
    /* Of the measured circles: mean absolute position error, % of z; angle between measured and true normal, degrees;
     * mean over 360 directions of the difference from the hand-labelled outline, px, as seen; signed distance of the
     * centre from the hand-labelled one, px. */
    std::vector<double> dx, dy, dz, axis, ellipse, shift_x, shift_y;

    void add(const BoardErrors &other);
    double measured_percent() const { return 100.0 * static_cast<double>(axis.size()) / circles; }
};

struct Boards {
    std::vector<std::string> names;
    std::vector<BoardErrors> errors; /* one a name */
    BoardErrors total;
    std::map<std::string, int> statuses; /* of the circles not measured */
};

/* The camera of all photographs. */
extern const Camera boards_camera;

/* Where the photographs are expected, beside the project. */
extern const char *const boards_folder;

bool boards_there(const std::string &folder);

struct BoardCircle {
    std::string image;
    int col, row;
    Ellipse hand;       /* as seen, hand-labelled */
    cv::Vec3d position; /* circle radii */
    cv::Vec3d axis;     /* away from the camera */
};

/* Every circle with its photograph in grey, photograph by photograph; the region is a square of +-half semi-axes. */
using BoardVisitor = std::function<void(const BoardCircle &circle, const cv::Mat &grey, const cv::Rect &region)>;
void visit_circles(const std::string &folder, double half, const BoardVisitor &visit);

/* Measure all circles in regions of +-half semi-axes; verbose prints a line for each. Throws on files it cannot read. */
Boards measure_boards(const std::string &folder, double half, bool verbose);

} // namespace accuracy
