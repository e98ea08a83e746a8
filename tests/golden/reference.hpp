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

/* Ring mask by the inequality on squared distances: 0 and 255. */
cv::Mat ring(int width, int height, int centre2_x, int centre2_y, int longest);
/* Canny's edges of which every candidate lies in a mask: the components of what cv::Canny finds above the low threshold
 * there that hold something above the high one. */
cv::Mat canny_within(const cv::Mat &image, int low, int high, bool smoothed, const cv::Mat &mask);

struct Arc {
    int direction;                 /* class 0..3 */
    std::vector<cv::Point> pixels; /* raster order */
};
/* Arcs of an edge map by cv::connectedComponents per direction class, in raster order of their first pixel. */
std::vector<Arc> arcs(const cv::Mat &edges, const cv::Mat &gx, const cv::Mat &gy);

/* --- geometry --- */
struct Ellipse {
    Real xc, yc, a, b, angle; /* semi-axes a >= b; angle of the major axis in (-pi/2, pi/2] */
    bool ok = true;
};

struct Rect {
    Real xc, yc, shorter, longer;
};
/* Smallest-area rectangles by every hull edge, exactly equal areas in drogue/constraints.h's order; never empty. */
std::vector<Rect> min_area_rects(const std::vector<cv::Point> &pixels);
inline Rect min_area_rect(const std::vector<cv::Point> &pixels) { return min_area_rects(pixels).front(); }

struct Verdict {
    Rect rect;
    int quadrant; /* -1: rejected */
    int polarity; /* 0 dark, 1 bright, 2 rejected */
    Real distance2;
};
/* Straightness and position of an arc of a direction class, its rectangle rounded to Q16 as thresholds are. */
Verdict judge_arc(const std::vector<cv::Point> &pixels, int centre2_x, int centre2_y, int direction,
                  int64_t min_short_q16);

/* Arcs of each quadrant: of the four longest, the farthest with at least half the points of the longest, then the longest
 * of the others; -1: none. Polarity 2: arcs of either. */
using Choices = std::array<std::array<int, 2>, 4>;
Choices select_arcs(const std::vector<Verdict> &verdicts, const std::vector<int> &points, int polarity);

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
/* The same with the covered share of the circumference in place of (12). */
Quality quality_of_cover(const Ellipse &e, Real fit_ratio, Real cover, Real k1, Real k2);

/* --- support of an ellipse by edge points --- */
constexpr int SUPPORT_BINS = 32;
struct Edge {
    Point at;
    Real gx, gy; /* y down */
};
struct Band {
    Real width, cosine; /* largest distance |F| / |grad F|, px; least cosine between gradient and normal */
};
/* An edge point in an ellipse's frame. */
struct BandPoint {
    Real u, v, f; /* f = u^2 + v^2 - 1 */
    bool held;    /* belongs to the outline */
    int polarity; /* 0: the gradient points outward */
    int bin;
    Real past_width, past_cosine; /* beyond the band's limits: px, cosine; negative inside */
    Real from_next_bin;           /* rad to the nearest limit of a bin */

    /* Would limits that move by so much decide 'held' otherwise? */
    bool undecided(Real width, Real cosine) const
    {
        const bool fails = past_width > width || past_cosine > cosine || f > 1 + cosine || f < -0.75L - cosine;
        return !fails && !(past_width < -width && past_cosine < -cosine && held);
    }
};
BandPoint band_point(const Ellipse &e, const Band &band, const Edge &edge);

struct Support {
    std::array<std::array<int, 2>, SUPPORT_BINS> count = {};
    std::array<Real, SUPPORT_BINS> sum = {}; /* of f / 2 over the points of the bin's polarity */
    Real squares = 0, gradient = 0;
    int points = 0;
    std::array<Real, 5> pull = {};  /* by what lies beside the outline: harmonics, in semi-axes */
    std::array<Real, 2> smear = {}; /* motion blur: variance along it less that across, px^2, by twice its angle */
    uint32_t bright = 0;            /* bit set of the bins that are brighter inside */
    int covered = 0;
};
/* Count a point; add it to the sums when its polarity is that of its bin. */
bool support_add(Support &s, const BandPoint &p, const Edge &edge);
/* Polarity of the bins and how many are covered, from the counts; polarity 2: either. */
void support_judge(Support &s, const Ellipse &e, int polarity, int stride);
/* How many bins are covered by points of the given polarities. */
void support_judge_as(Support &s, const Ellipse &e, uint32_t bright, int stride);
/* Points that cover a bin, not rounded. */
Real support_needed(const Ellipse &e, int bin);

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
/* Ellipse of a conic A x^2 + B xy + C y^2 + D x + E y + F = 0, A + C > 0. */
Ellipse conic_ellipse(const std::array<Real, 6> &theta);

/* Brown-Conrady; false (p unchanged) where the domain of drogue/undistort.h ends. */
bool distort(const Camera &c, Point &p);
/* An ellipse as the lens shows it: halves of what lies between the images of its axes' ends are conjugate radii. */
bool distort(const Camera &c, Ellipse &e);
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

/* --- joint pose --- */
using Covariance = cv::Matx<double, 5, 5>;
/* Covariance of m0 .. m4 (drogue/joint.h) from the residuals of the bins; false when too few hold points. */
bool outline_covariance(Covariance &out, const Ellipse &e, const Support &s, Real shading, Real blur);
/* Trace of the counts' matrix times that of its inverse: at least its condition. */
double condition_of(const Support &s);

struct Model {
    Real rim_radius, inner_radius, inner_depth;
};
struct Inner {
    Point at;
    Real std; /* 0: none */
};
enum class Solved { ok, degenerate, domain, behind };
struct Joint {
    Pose pose;
    Covariance covariance; /* of x, y, z, yaw, pitch */
    double chi2;
    Solved solved;
};
/* Gauss-Newton from a pose, at most 'steps' after the first; 0: none at all. */
Joint solve_joint(const Pose &start, const Ellipse &e, const Covariance &outline, const Inner &inner, const Camera &c,
                  const Model &model, int steps);
/* Image of the inner disc of a pose. */
Solved disc_image(Ellipse &out, const Pose &pose, const Camera &c, const Model &model);

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
