/* SPDX-License-Identifier: Apache-2.0 */
/* A dark disc, nested ellipses, matched features. */
#include "regions.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "edges.hpp"

namespace accuracy {

namespace {

constexpr double least_disc_px = 3; /* semi-axis */
constexpr double least_outline_px = 10;
constexpr double least_fill = 0.9, most_fill = 1.1; /* area of a contour over that of its ellipse */
constexpr double least_contrast = 8;                /* grey levels */

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
    for (const Ellipse &e : ellipses_of(contours, least_disc_px)) {
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

FeatureMatcher::FeatureMatcher(const cv::Mat &reference, const Ellipse &outline) : outline_(outline)
{
    std::vector<cv::KeyPoint> key_points;
    cv::ORB::create(1000)->detectAndCompute(reference, cv::noArray(), key_points, descriptors_);
    cv::KeyPoint::convert(key_points, points_);
}

Sight FeatureMatcher::find(const cv::Mat &grey) const
{
    std::vector<cv::KeyPoint> key_points;
    cv::Mat descriptors;
    std::vector<std::vector<cv::DMatch>> matches;
    std::vector<cv::Point2f> from, to;
    cv::ORB::create(2000)->detectAndCompute(grey, cv::noArray(), key_points, descriptors);
    if (descriptors.rows < 2 || descriptors_.rows < 2) {
        return {};
    }
    cv::BFMatcher(cv::NORM_HAMMING).knnMatch(descriptors_, descriptors, matches, 2);
    for (const auto &m : matches) {
        if (m.size() == 2 && m[0].distance < 0.8F * m[1].distance) {
            from.push_back(points_[static_cast<size_t>(m[0].queryIdx)]);
            to.push_back(key_points[static_cast<size_t>(m[0].trainIdx)].pt);
        }
    }
    cv::Mat follow;
    const cv::Mat homography = from.size() < 8 ? cv::Mat() : cv::findHomography(from, to, cv::RANSAC, 5, follow);
    if (homography.empty() || cv::countNonZero(follow) < 8) {
        return {};
    }
    std::vector<cv::Point2f> rim, seen;
    for (int i = 0; i < 64; i++) {
        rim.emplace_back(outline_.at(i * CV_PI / 32));
    }
    cv::perspectiveTransform(rim, seen, homography);
    const Ellipse e = ellipse_of(cv::fitEllipseDirect(seen));
    return {e.b_px > 1, {e.xc_px, e.yc_px}, e.a_px};
}

} // namespace accuracy
