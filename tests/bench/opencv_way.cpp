/* SPDX-License-Identifier: Apache-2.0 */
/* Steps of OpenCV's own wherever it has one. */
#include "opencv_way.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "baselines.hpp"

namespace bench {

namespace {

const double low = 30, high = 80; /* as drogue_config_default() has them */

/* Share of the edge points within a pixel and a half of an ellipse, against its circumference. */
double score(const cv::RotatedRect &e, const std::vector<cv::Point> &points, std::vector<cv::Point> *near = nullptr)
{
    const double a = e.size.width / 2.0, b = e.size.height / 2.0, angle = e.angle * CV_PI / 180;
    const double c = std::cos(angle), s = std::sin(angle);
    size_t count = 0;
    if (!(a > 2) || !(b > 2)) {
        return 0;
    }
    for (const cv::Point &p : points) {
        const double x = p.x - e.center.x, y = p.y - e.center.y;
        const double u = (c * x + s * y) / a, v = (c * y - s * x) / b;
        const double r = std::sqrt(u * u + v * v);
        if (std::abs(r - 1) * std::min(a, b) < 1.5) {
            count++;
            if (near != nullptr) {
                near->push_back(p);
            }
        }
    }
    return static_cast<double>(count) / (CV_PI * (a + b));
}

/* Arcs: runs of points of one quadrant of the gradient along the contours of the ring's edges; the longest first. */
std::vector<std::vector<cv::Point>> arcs_of(const cv::Mat &dx, const cv::Mat &dy, const cv::Mat &edge,
                                            std::vector<cv::Point> &all)
{
    const double side = std::max(edge.cols, edge.rows);
    const cv::Point centre(edge.cols / 2, edge.rows / 2);
    cv::Mat ring = cv::Mat::zeros(edge.size(), CV_8U), ringed;
    std::vector<std::vector<cv::Point>> contours, arcs;
    cv::circle(ring, centre, cvRound(side / 2), 255, cv::FILLED);
    cv::circle(ring, centre, cvRound(side / 3), 0, cv::FILLED);
    cv::bitwise_and(edge, ring, ringed);
    cv::findContours(ringed, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
    for (const auto &contour : contours) {
        std::vector<cv::Point> run;
        int run_class = -1;
        for (const cv::Point &p : contour) {
            const int of = (dx.at<int16_t>(p) < 0 ? 1 : 0) + (dy.at<int16_t>(p) < 0 ? 2 : 0);
            if (of != run_class && static_cast<double>(run.size()) >= std::max(10.0, side / 8)) {
                arcs.push_back(run);
            }
            if (of != run_class) {
                run.clear();
                run_class = of;
            }
            run.push_back(p);
        }
        if (static_cast<double>(run.size()) >= std::max(10.0, side / 8)) {
            arcs.push_back(run);
        }
        all.insert(all.end(), contour.begin(), contour.end());
    }
    std::sort(arcs.begin(), arcs.end(), [](const auto &a, const auto &b) { return a.size() > b.size(); });
    if (arcs.size() > 12) {
        arcs.resize(12);
    }
    return arcs;
}

/* Centroid of the largest dark component in the disc within the ring. */
bool inner_part(cv::Point2d &out, const cv::Mat &image)
{
    const int radius = std::max(image.cols, image.rows) / 3;
    const cv::Rect box = cv::Rect(image.cols / 2 - radius, image.rows / 2 - radius, 2 * radius + 1, 2 * radius + 1) &
                         cv::Rect({0, 0}, image.size());
    cv::Mat disc = cv::Mat::zeros(box.size(), CV_8U), dark, labels, stats, centroids;
    cv::circle(disc, {radius, radius}, radius, 255, cv::FILLED);
    cv::threshold(image(box), dark, 0, 255, cv::THRESH_BINARY_INV | cv::THRESH_OTSU);
    cv::bitwise_and(dark, disc, dark);
    cv::morphologyEx(dark, dark, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
    const int count = cv::connectedComponentsWithStats(dark, labels, stats, centroids, 8, CV_32S);
    int best = 0;
    for (int i = 1; i < count; i++) {
        if (best == 0 || stats.at<int>(i, cv::CC_STAT_AREA) > stats.at<int>(best, cv::CC_STAT_AREA)) {
            best = i;
        }
    }
    out = cv::Point2d(box.x + centroids.at<double>(best, 0), box.y + centroids.at<double>(best, 1));
    return best != 0;
}

} // namespace

cv::Mat edges(const cv::Mat &image)
{
    cv::Mat blurred, edge;
    cv::GaussianBlur(image, blurred, {5, 5}, 0);
    cv::Canny(blurred, edge, low, high, 3, false);
    return edge;
}

Found measure(const cv::Mat &image, const accuracy::Camera &camera, double rim_radius_m, double inner_depth_m)
{
    cv::Mat blurred, dx, dy, edge;
    std::vector<cv::Point> all, near;
    cv::RotatedRect best;
    double best_score = 0;
    Found found;
    cv::GaussianBlur(image, blurred, {5, 5}, 0);
    cv::Sobel(blurred, dx, CV_16S, 1, 0);
    cv::Sobel(blurred, dy, CV_16S, 0, 1);
    cv::Canny(dx, dy, edge, low, high, false);
    const auto arcs = arcs_of(dx, dy, edge, all);
    for (size_t i = 0; i < arcs.size(); i++) {
        for (size_t j = i + 1; j < arcs.size(); j++) {
            std::vector<cv::Point> both = arcs[i];
            both.insert(both.end(), arcs[j].begin(), arcs[j].end());
            const cv::RotatedRect fit = cv::fitEllipseDirect(both);
            const double s = score(fit, all);
            if (s > best_score) {
                best_score = s;
                best = fit;
            }
        }
    }
    if (best_score == 0) {
        return found;
    }
    (void)score(best, all, &near);
    if (near.size() >= 5) {
        best = cv::fitEllipseDirect(near);
    }
    const bool wide = best.size.width >= best.size.height;
    const accuracy::Ellipse ellipse = {best.center.x, best.center.y, (wide ? best.size.width : best.size.height) / 2.0,
                                       (wide ? best.size.height : best.size.width) / 2.0,
                                       (wide ? best.angle : best.angle - 90) * CV_PI / 180};
    std::array<accuracy::Pose, 2> poses;
    if (!accuracy::circle_poses(poses, camera, ellipse, rim_radius_m)) {
        return found;
    }
    found.ok = true;
    found.pose = poses[0];
    cv::Point2d seen;
    if (inner_part(seen, image)) {
        double least = INFINITY;
        for (const accuracy::Pose &p : poses) {
            const double d = cv::norm(camera.project_ideal(p.position_m + inner_depth_m * p.axis) - seen);
            if (d < least) {
                least = d;
                found.pose = p;
            }
        }
    }
    return found;
}

size_t search(const cv::Mat &frame)
{
    cv::Mat level = frame;
    size_t count = 0;
    while (std::min(level.cols, level.rows) >= 64) {
        cv::Mat half;
        std::vector<cv::Vec3f> circles;
        cv::resize(level, half, level.size() / 2, 0, 0, cv::INTER_AREA);
        level = half;
        cv::HoughCircles(level, circles, cv::HOUGH_GRADIENT, 2, 8, high, 20, 6, 12);
        count += circles.size();
    }
    return count;
}

Tracker::Tracker() : filter_(15, 5, 0, CV_64F)
{
    const double dt = 0.04;
    cv::setIdentity(filter_.transitionMatrix);
    cv::setIdentity(filter_.processNoiseCov, 1e-4);
    cv::setIdentity(filter_.measurementNoiseCov, 1e-3);
    cv::setIdentity(filter_.errorCovPost);
    for (int i = 0; i < 5; i++) {
        filter_.transitionMatrix.at<double>(3 * i, 3 * i + 1) = dt;
        filter_.transitionMatrix.at<double>(3 * i, 3 * i + 2) = dt * dt / 2;
        filter_.transitionMatrix.at<double>(3 * i + 1, 3 * i + 2) = dt;
        filter_.measurementMatrix.at<double>(i, 3 * i) = 1;
    }
}

bool Tracker::frame(const cv::Mat &image, const accuracy::Camera &camera, double rim_radius_m, double inner_depth_m)
{
    (void)filter_.predict();
    const Found found = measure(image, camera, rim_radius_m, inner_depth_m);
    if (found.ok) {
        const accuracy::Pose &p = found.pose;
        (void)filter_.correct(cv::Mat_<double>({5, 1}, {p.position_m[0], p.position_m[1], p.position_m[2],
                                                        accuracy::yaw_of(p.axis), accuracy::pitch_of(p.axis)}));
    }
    return found.ok;
}

} // namespace bench
