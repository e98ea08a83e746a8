/* SPDX-License-Identifier: Apache-2.0 */
/* The list of detectors, the choice of the outline, and OpenCV's own detectors. */
#include "detectors.hpp"

#include <cmath>

#include <opencv2/imgproc.hpp>
#ifdef HAVE_XIMGPROC
#include <opencv2/ximgproc/edge_drawing.hpp>
#endif

#include "edges.hpp"

namespace accuracy {

#ifdef HAVE_XIMGPROC
const bool has_ximgproc = true;

std::vector<Ellipse> detect_edge_drawing(const cv::Mat &grey)
{
    std::vector<Ellipse> found;
    std::vector<cv::Vec6d> raw;
    const cv::Ptr<cv::ximgproc::EdgeDrawing> detector = cv::ximgproc::createEdgeDrawing();
    detector->detectEdges(grey);
    detector->detectEllipses(raw);
    for (const cv::Vec6d &e : raw) {
        /* A circle has its radius in the third place, an ellipse its semi-axes and angle in the last three. */
        const double first = e[2] > 0 ? e[2] : e[3];
        const double second = e[2] > 0 ? e[2] : e[4];
        const double angle = e[2] > 0 ? 0 : e[5] * CV_PI / 180 + (first < second ? CV_PI / 2 : 0);
        found.push_back({e[0], e[1], std::max(first, second), std::min(first, second), std::remainder(angle, CV_PI)});
    }
    return found;
}
#else
const bool has_ximgproc = false;
#endif

const std::vector<OutlineDetector> &outline_detectors()
{
    static const std::vector<OutlineDetector> list = {
#ifdef HAVE_XIMGPROC
        {"EdgeDrawing", "OpenCV contrib, ximgproc::EdgeDrawing::detectEllipses at its defaults", detect_edge_drawing},
#endif
        {"HoughCircles",
         "OpenCV, cv::HoughCircles (gradient method), radii 0.28 to 0.55 of the region's side: circles only",
         detect_hough},
        {"contour, direct fit",
         "OpenCV, cv::findContours on the edges and at Otsu's threshold, cv::fitEllipseDirect to each",
         detect_contours},
        {"Fornaciari",
         "written here: arcs by the gradient's direction and convexity, triplets by position, centre from midpoints of "
         "parallel chords, then ratio, angle and size each from a histogram",
         detect_fornaciari},
        {"Mai",
         "written here: chains of line segments that connect and turn alike are arcs, arcs whose ends meet are one",
         detect_mai},
        {"Bai", "written here: arcs on each other's concave side whose joint fit holds are grouped", detect_bai},
        {"Liu, Qiao",
         "written here: every arc is an ellipse's of its own, the two that agree best are joined, until none agree",
         detect_liu_qiao},
        {"Dong",
         "written here: arcs by quadrant and polarity of the gradient, grouped by their normals, false ones rejected by "
         "the number of aligned gradients, a last fit to those",
         detect_dong},
    };
    return list;
}

bool choose_outline(Ellipse &out, const std::vector<Ellipse> &candidates, const cv::Mat &grey)
{
    const double side = std::max(grey.cols, grey.rows);
    const cv::Point2d middle((grey.cols - 1) / 2.0, (grey.rows - 1) / 2.0);
    const EdgeImage edges(grey);
    double best = 0.3;
    bool found = false;
    for (const Ellipse &e : candidates) {
        const bool in_place = cv::norm(cv::Point2d(e.xc_px, e.yc_px) - middle) <= side / 4 && e.a_px >= 0.28 * side &&
                              e.a_px <= 0.55 * side && e.b_px >= 0.4 * e.a_px;
        if (!in_place) {
            continue;
        }
        const double share = support_of(edges, e).share();
        if (share >= best) {
            best = share;
            out = e;
            found = true;
        }
    }
    return found;
}

std::vector<Ellipse> detect_hough(const cv::Mat &grey)
{
    const int side = std::max(grey.cols, grey.rows);
    std::vector<cv::Vec3f> circles;
    std::vector<Ellipse> found;
    cv::Mat smooth;
    cv::GaussianBlur(grey, smooth, {5, 5}, 0);
    cv::HoughCircles(smooth, circles, cv::HOUGH_GRADIENT, 1, 2, 80, 15, cvFloor(0.28 * side), cvCeil(0.55 * side));
    for (size_t i = 0; i < circles.size() && i < 20; i++) { /* most votes first */
        const cv::Vec3d c = circles[i];
        found.push_back({c[0], c[1], c[2], c[2], 0});
    }
    return found;
}

std::vector<Ellipse> detect_contours(const cv::Mat &grey)
{
    std::vector<Ellipse> found;
    /* A filled part's contour runs over the centres of its outermost pixels, half a pixel inside it. */
    const auto add = [&](const cv::Mat &binary, double half_px) {
        std::vector<std::vector<cv::Point>> contours;
        cv::findContours(binary, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
        for (const auto &contour : contours) {
            if (contour.size() >= 20) {
                Ellipse e = ellipse_of(cv::fitEllipseDirect(contour));
                e.a_px += half_px;
                e.b_px += half_px;
                if (e.b_px > 1) { /* false for NaN, too */
                    found.push_back(e);
                }
            }
        }
    };
    cv::Mat binary;
    add(EdgeImage(grey).edges, 0);
    cv::threshold(grey, binary, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
    add(binary, 0.5);
    cv::bitwise_not(binary, binary);
    add(binary, 0.5);
    return found;
}

} // namespace accuracy
