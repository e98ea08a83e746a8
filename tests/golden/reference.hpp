/* SPDX-License-Identifier: Apache-2.0 */
/* The reference of every stage: what the agreement tests compare with and what the generator of the golden vectors
 * writes, each value rounded once. Pixels and the filter are OpenCV's; geometry is computed in long double or wider,
 * so that its own rounding never counts, and the tests check it against OpenCV where OpenCV has it. */
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace reference {

using Real = long double;

struct Point {
    Real x, y;
};

/* round(v * 2^16), ties toward +infinity, saturated. */
int32_t q16(Real v);
/* Does v round into Q16 without saturation? */
bool in_q16(Real v);

/* --- pixels: exact --- */
cv::Mat smooth(const cv::Mat &image);                                  /* cv::GaussianBlur 5x5 */
void gradient(const cv::Mat &image, cv::Mat &gx, cv::Mat &gy);         /* cv::Sobel, CV_16S, replicate, y down */
cv::Mat canny(const cv::Mat &image, int low, int high, bool smoothed); /* cv::Canny L1: 0 and 255 */

/* Masks by the inequality on squared distances: 0 and 255. */
cv::Mat ring(int width, int height, int centre2_x, int centre2_y, int longest);
cv::Mat disc(int width, int height, int centre2_x, int centre2_y, int longest);

struct Arc {
    int direction;                 /* class 0..3 */
    std::vector<cv::Point> pixels; /* raster order */
};
/* Arcs of an edge map by cv::connectedComponents per direction class, in raster order of their first pixel. */
std::vector<Arc> arcs(const cv::Mat &edges, const cv::Mat &gx, const cv::Mat &gy);

struct DarkPart {
    bool found;           /* a component of at least min_area */
    int threshold;        /* of the levels that maximise the variance the least, exact; 0: fewer than two levels */
    int threshold_opencv; /* cv::threshold(OTSU) over the disc's pixels, in double */
    bool opencv_equal;    /* that level has the same variance, or there are fewer than two levels */
    cv::Mat dark, opened; /* 0 and 255, inside the disc */
    int area;             /* of the largest component, found or not; 0: none */
    bool area_unique;     /* no other component is as large */
    Real x, y;            /* its centroid; of equals the one whose first pixel comes first */
};
DarkPart dark_part(const cv::Mat &image, int centre2_x, int centre2_y, int longest, int min_area);

/* --- geometry --- */
struct Rect {
    Real xc, yc, shorter, longer;
};
/* Smallest-area rectangles by every hull edge, exactly equal areas in drogue/constraints.h's order; never empty. */
std::vector<Rect> min_area_rects(const std::vector<cv::Point> &pixels);
inline Rect min_area_rect(const std::vector<cv::Point> &pixels) { return min_area_rects(pixels).front(); }

struct Ellipse {
    Real xc, yc, a, b, angle; /* semi-axes a >= b; angle of the major axis in (-pi/2, pi/2] */
    bool ok = true;
};
/* Direct fit (Halir and Flusser) in quadruple precision; points in px. Not ok: fewer than 6 points, points on a line
 * or on more than one conic, or exactly on one that is no ellipse, or a parameter beyond Q16. The angle of a circle
 * (equal in Q16) is 0. */
Ellipse fit(const std::vector<cv::Point2d> &points);

Real deviation(const Ellipse &e, Point p);              /* |X + Y - 1| of (10) */
Real deviation_threshold(const Ellipse &e, Real error); /* Th_error of (10): 2 error / a */
Real circumference(const Ellipse &e);                   /* Ramanujan */
struct Quality {
    Real fit_ratio, length_ratio, axis_ratio, score, reliability;
};
Quality quality(const Ellipse &e, int near_count, int total, Real k1, Real k2);

struct Candidate {
    Ellipse ellipse;
    Real reliability;
    int polarity;
};
struct ClusterConfig {
    Real centre, a, b, angle, round;
};
bool same_ellipse(const Candidate &i, const Candidate &j, const ClusterConfig &config);
/* Index of the winner, -1 of none; ties as in drogue/cluster.h. Exact for numbers that are Q16. */
int cluster_best(const std::vector<Candidate> &candidates, const ClusterConfig &config, int &members);

struct Eigen3 {
    std::array<Real, 3> value;                 /* descending, the matrix's unit */
    std::array<std::array<Real, 3>, 3> vector; /* unit vectors, signs as in drogue/eigen.h */
};
/* Matrix a00 a01 a02 a11 a12 a22, by Jacobi rotations in quadruple precision. */
Eigen3 eigen(const std::array<int64_t, 6> &matrix);

struct Camera {
    Real fx, fy, cx, cy, k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
};
/* Brown-Conrady; false (p unchanged) where the domain of drogue/undistort.h ends. */
bool distort(const Camera &c, Point &p);
/* Its inverse, followed from the axis without a step across a fold; false (p unchanged) when that ends before p. */
bool undistort(const Camera &c, Point &p);

struct Pose {
    std::array<Real, 3> position, axis;
    Real yaw, pitch;
};
/* Closed form (20)-(30) as corrected, in quadruple precision; order and signs of the pair as drogue/pose.c has them.
 * False for an ellipse that is none, no cone, and a position beyond Q16. */
bool poses(const Ellipse &e, const Camera &c, Real radius, std::array<Pose, 2> &out);
/* Image of the point at a depth on the axis; false when it lies behind the camera. */
bool project(const Pose &pose, Real depth, const Camera &c, Point &out);
struct Choice {
    int index;
    std::array<Real, 2> distance;
    Real ambiguity;
};
/* Pose whose projected inner centre is nearer to p; false when one lies behind the camera. */
bool choose(const std::array<Pose, 2> &pair, Point p, Real depth, const Camera &c, Choice &out);

/* cv::KalmanFilter(15, 5, 0, CV_64F) with the model of drogue/kalman.h; pitch and yaw compared modulo 2 pi. */
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
