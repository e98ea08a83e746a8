/* SPDX-License-Identifier: Apache-2.0 */
/* The floating-point reference of every stage, on OpenCV where OpenCV has it: what agreement tests compare with
 * and what the generator of the golden vectors writes, each value to be rounded once. */
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace reference {

/* round(v * 2^16), ties toward +infinity, saturated. */
int32_t q16(double v);

/* --- pixels: exact --- */
cv::Mat smooth(const cv::Mat &image);                                           /* cv::GaussianBlur 5x5 */
void gradient(const cv::Mat &image, cv::Mat &gx, cv::Mat &gy);                  /* cv::Sobel, CV_16S, replicate */
cv::Mat canny(const cv::Mat &image, int low, int high, bool smoothed);          /* cv::Canny L1: 0 and 255 */
cv::Mat ring(int width, int height, int centre2_x, int centre2_y, int longest); /* 0 and 255 */
cv::Mat disc(int width, int height, int centre2_x, int centre2_y, int longest);

struct Arc {
    int direction;                 /* class 0..3 */
    std::vector<cv::Point> pixels; /* raster order */
};
/* Arcs of an edge map by cv::connectedComponents per direction class, in raster order of their first pixel. */
std::vector<Arc> arcs(const cv::Mat &edges, const cv::Mat &gx, const cv::Mat &gy);

/* --- geometry: double --- */
struct Rect {
    double xc, yc, shorter, longer;
};
Rect min_area_rect(
    const std::vector<cv::Point> &pixels); /* brute force over hull edges; cross-checked with cv::minAreaRect */

struct Ellipse {
    double xc, yc, a, b, angle; /* semi-axes a >= b; angle of the major axis in (-pi/2, pi/2] */
    bool ok;
};
/* Direct fit (Halir and Flusser), centred and scaled, long double where that helps; points in px. */
Ellipse fit(const std::vector<cv::Point2d> &points);

double deviation(const Ellipse &e, cv::Point2d p); /* |X + Y - 1| of (10) */
double circumference(const Ellipse &e);            /* Ramanujan */
struct Quality {
    double fit_ratio, length_ratio, axis_ratio, score, reliability;
};
Quality quality(const Ellipse &e, int near_count, int total, double k1, double k2);

struct Candidate {
    Ellipse ellipse;
    double reliability;
    int polarity;
};
struct ClusterConfig {
    double centre, a, b, angle, round;
};
int cluster_best(const std::vector<Candidate> &c, const ClusterConfig &config, int &members);

struct DarkPart {
    bool found;
    int threshold;         /* cv::threshold(OTSU) over the disc's pixels */
    bool threshold_unique; /* no other level has the same variance */
    cv::Mat mask;          /* opened, 0 and 255 */
    int area;
    double x, y;
};
DarkPart dark_part(const cv::Mat &image, int centre2_x, int centre2_y, int longest, int min_area);

struct Eigen3 {
    std::array<double, 3> value;                 /* descending */
    std::array<std::array<double, 3>, 3> vector; /* signs as in drogue/eigen.h */
};
Eigen3 eigen(const std::array<double, 6> &matrix); /* cv::eigen */

struct Camera {
    double fx, fy, cx, cy, k1, k2, p1, p2, k3;
};
bool undistort(const Camera &c, cv::Point2d &p); /* cv::undistortPoints to convergence; false when it does not */
void distort(const Camera &c, cv::Point2d &p);

struct Pose {
    std::array<double, 3> position, axis;
    double yaw, pitch;
};
/* Closed form (20)-(30) as corrected; order and signs of the pair as in drogue/pose.h. */
bool poses(const Ellipse &e, const Camera &c, double radius, std::array<Pose, 2> &out);
cv::Point2d project(const Pose &p, double depth, const Camera &c);

/* cv::KalmanFilter(15, 5, 0, CV_64F) with the model of drogue/kalman.h. */
class Kalman {
public:
    Kalman(const std::array<double, 5> &value, const std::array<std::array<double, 3>, 5> &std);
    void predict(double dt, const std::array<double, 5> &std);
    void correct(const std::array<double, 5> &value, const std::array<double, 5> &std);
    double state(int parameter, int order) const; /* order 0 value, 1 rate, 2 acceleration */

private:
    cv::Mat state_, covariance_;
};

} // namespace reference
