/* SPDX-License-Identifier: Apache-2.0 */
/* A dark disc, nested ellipses, matched views. */
#include "regions.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "edges.hpp"

namespace accuracy {

namespace {

constexpr double least_disc_px = 3; /* semi-axis */
constexpr double least_outline_px = 10;
constexpr double least_fill = 0.9, most_fill = 1.1; /* area of a contour over that of its ellipse */
constexpr double least_contrast = 8;                /* grey levels */

constexpr double view_semi_axis_px = 14;
constexpr double view_step_rad = 0.26; /* 15 degrees */
constexpr int view_sizes = 17;
constexpr double least_correlation = 0.4;

/* Magnitude of Sobel's gradient, CV_32F. */
cv::Mat gradients_of(const cv::Mat &grey)
{
    cv::Mat gx, gy, magnitude;
    cv::Sobel(grey, gx, CV_32F, 1, 0);
    cv::Sobel(grey, gy, CV_32F, 0, 1);
    cv::magnitude(gx, gy, magnitude);
    return magnitude;
}

std::vector<Ellipse> ellipses_of(const std::vector<std::vector<cv::Point>> &contours, double least_px)
{
    std::vector<Ellipse> found;
    for (const auto &contour : contours) {
        if (static_cast<double>(contour.size()) < 4 * least_px) {
            continue;
        }
        const Ellipse e = ellipse_of(cv::fitEllipseDirect(contour));
        if (e.b_px >= least_px && e.b_px >= 0.5 * e.a_px && e.a_px < 2000) {
            found.push_back(e);
        }
    }
    return found;
}

/* Mean grey on the ellipse at so many times its size. */
double mean_grey(const cv::Mat &grey, const Ellipse &e, double scale)
{
    const Ellipse at = {e.xc_px, e.yc_px, scale * e.a_px, scale * e.b_px, e.angle_rad};
    double sum = 0;
    int count = 0;
    for (int i = 0; i < 32; i++) {
        const cv::Point p(at.at(i * CV_PI / 16));
        if (cv::Rect({0, 0}, grey.size()).contains(p)) {
            sum += grey.at<uint8_t>(p);
            count++;
        }
    }
    return count > 0 ? sum / count : std::nan("");
}

} // namespace

Sight find_port(const cv::Mat &grey, const Body &body)
{
    Sight best;
    double best_score = 0;
    cv::Mat smooth, dark;
    cv::GaussianBlur(grey, smooth, {3, 3}, 0);
    for (int threshold = 16; threshold < 256; threshold += 16) {
        std::vector<std::vector<cv::Point>> contours;
        cv::threshold(smooth, dark, threshold, 255, cv::THRESH_BINARY_INV);
        cv::findContours(dark, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
        for (const auto &contour : contours) {
            for (const Ellipse &e : ellipses_of({contour}, least_disc_px)) {
                /* A contour runs over pixels' centres: half a pixel less than the disc all round. */
                const double fill = cv::contourArea(contour) / (CV_PI * e.a_px * e.b_px);
                const double contrast = mean_grey(smooth, e, 1.4) - mean_grey(smooth, e, 0.6);
                if (!(fill >= least_fill && fill <= most_fill && contrast >= least_contrast)) {
                    continue;
                }
                int on = 0;
                for (const cv::Point &p : contour) {
                    on += distance_px(e, p) <= 1;
                }
                const double score = contrast * on / static_cast<double>(contour.size());
                if (score > best_score) {
                    best_score = score;
                    best = {true, {e.xc_px, e.yc_px}, (e.a_px + 0.5) * body.rim_radius_m / body.inner_radius_m};
                }
            }
        }
    }
    return best;
}

Sight find_nested(const cv::Mat &grey, const Body &body)
{
    const EdgeImage edges(grey);
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(edges.edges, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
    struct Candidate {
        Ellipse e;
        double share;
    };
    std::vector<Candidate> all;
    std::vector<Ellipse> ellipses = ellipses_of(contours, least_disc_px);
    for (const Chain &arc : convex_arcs_of(edges)) {
        Ellipse e;
        if (fit_arcs(e, {&arc}) && e.b_px >= least_disc_px && e.b_px >= 0.5 * e.a_px) {
            ellipses.push_back(e);
        }
    }
    for (const Ellipse &e : ellipses) {
        const double share = support_of(edges, e).share();
        if (share >= 0.4) {
            all.push_back({e, share});
        }
    }
    const double ratio = body.rim_radius_m / body.inner_radius_m;
    Sight best;
    double best_score = 0;
    for (const Candidate &outer : all) {
        for (const Candidate &inner : all) {
            const double apart = std::hypot(outer.e.xc_px - inner.e.xc_px, outer.e.yc_px - inner.e.yc_px);
            const double size = outer.e.a_px / inner.e.a_px / ratio; /* above 1: the inner part is farther away */
            const double score = outer.share + inner.share;
            if (outer.e.a_px >= least_outline_px && size > 0.9 && size < 1.25 && apart < 0.45 * outer.e.a_px &&
                score > best_score) {
                best_score = score;
                best = {true, {outer.e.xc_px, outer.e.yc_px}, outer.e.a_px};
            }
        }
    }
    return best;
}

ViewMatcher::ViewMatcher(const cv::Mat &reference, const Ellipse &outline)
{
    const double scale = view_semi_axis_px / outline.a_px;
    const int side = 2 * static_cast<int>(std::lround(1.25 * view_semi_axis_px)) + 1;
    const double focal = 1e4; /* px of the view: tilts of a drogue far away */
    cv::Mat smooth;
    cv::GaussianBlur(reference, smooth, {0, 0}, 0.4 / scale); /* what the smaller view can hold */
    for (int yaw = -2; yaw <= 2; yaw++) {
        for (int pitch = -2; pitch <= 2; pitch++) {
            if (std::abs(yaw) + std::abs(pitch) > 2) {
                continue;
            }
            const Pose p = {{0, 0, focal}, axis_of(yaw * view_step_rad, pitch * view_step_rad)};
            const cv::Vec3d x = p.first(), y = p.second();
            /* Plane of the end, px about the outline's centre, to the view. */
            const cv::Matx33d tilt(x[0], y[0], 0, x[1], y[1], 0, x[2] / focal, y[2] / focal, 1);
            const cv::Matx33d from(scale, 0, -scale * outline.xc_px, 0, scale, -scale * outline.yc_px, 0, 0, 1);
            const cv::Matx33d to(1, 0, (side - 1) / 2.0, 0, 1, (side - 1) / 2.0, 0, 0, 1);
            cv::Mat view;
            cv::warpPerspective(smooth, view, to * tilt * from, {side, side}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
            views_.push_back(gradients_of(view));
        }
    }
}

Sight ViewMatcher::find(const cv::Mat &grey) const
{
    Sight best;
    double best_score = least_correlation;
    for (int step = 0; step < view_sizes; step++) {
        const double semi_axis = 20 * std::pow(1.17, step); /* to 246 px */
        const double scale = view_semi_axis_px / semi_axis;
        cv::Mat small;
        cv::resize(grey, small, {}, scale, scale, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
        if (std::min(small.cols, small.rows) < views_[0].cols) {
            continue;
        }
        const cv::Mat gradients = gradients_of(small);
        for (const cv::Mat &view : views_) {
            cv::Mat score;
            double high;
            cv::Point at;
            cv::matchTemplate(gradients, view, score, cv::TM_CCOEFF_NORMED);
            cv::minMaxLoc(score, nullptr, &high, nullptr, &at);
            if (high > best_score) {
                best_score = high;
                const cv::Point2d middle = cv::Point2d(at) + 0.5 * cv::Point2d(view.cols, view.rows);
                best = {true, middle * (1 / scale) - cv::Point2d(0.5, 0.5), semi_axis};
            }
        }
    }
    return best;
}

} // namespace accuracy
