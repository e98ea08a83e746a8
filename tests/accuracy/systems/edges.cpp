/* SPDX-License-Identifier: Apache-2.0 */
/* Canny edges, chains, convex arcs, fits and their support. */
#include "edges.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "drogue/config.h"

namespace accuracy {

namespace {

constexpr size_t min_arc_px = 10;
constexpr double min_short_px = 1.5;
constexpr double max_residual_px = 1.5;
constexpr double aligned_cos = 0.92388; /* 22.5 degrees */

std::vector<cv::Point> points_of(const Chain &chain)
{
    std::vector<cv::Point> points;
    for (const EdgePoint &p : chain) {
        points.push_back(p.at);
    }
    return points;
}

/* The unvisited neighbour that lies straightest on, the nearest ones first; false at an end. */
bool next_of(cv::Point &next, const EdgeImage &image, const cv::Mat &visited, const cv::Point &at, const cv::Point &way)
{
    double best = -10;
    for (int dy = -1; dy <= 1; dy++) {
        for (int dx = -1; dx <= 1; dx++) {
            const cv::Point to(at.x + dx, at.y + dy);
            if ((dx == 0 && dy == 0) || !image.edge_at(to.x, to.y) || visited.at<uint8_t>(to) != 0) {
                continue;
            }
            const double straight = (dx * way.x + dy * way.y) / (std::hypot(dx, dy) * std::max(1.0, cv::norm(way)));
            if (straight > best) {
                best = straight;
                next = to;
            }
        }
    }
    return best > -10;
}

/* On from a pixel until no neighbour is left; the way is over the last four pixels. */
std::vector<cv::Point> walk(const EdgeImage &image, cv::Mat &visited, const cv::Point &from, const cv::Point &way)
{
    std::vector<cv::Point> path = {from};
    cv::Point next;
    cv::Point heading = way;
    while (next_of(next, image, visited, path.back(), heading)) {
        visited.at<uint8_t>(next) = 1;
        path.push_back(next);
        heading = next - path[path.size() > 4 ? path.size() - 5 : 0];
    }
    return path;
}

double turn_rad(const cv::Point &a, const cv::Point &b, const cv::Point &c)
{
    const cv::Point u = b - a;
    const cv::Point v = c - b;
    return std::atan2(u.x * v.y - u.y * v.x, u.dot(v));
}

/* In the ellipse's frame, in semi-axes. */
cv::Point2d in_frame(const Ellipse &e, const cv::Point2d &p)
{
    const double c = std::cos(e.angle_rad);
    const double s = std::sin(e.angle_rad);
    const cv::Point2d d(p.x - e.xc_px, p.y - e.yc_px);
    return {(c * d.x + s * d.y) / e.a_px, (c * d.y - s * d.x) / e.b_px};
}

} // namespace

EdgeImage::EdgeImage(const cv::Mat &grey)
{
    drogue_config config;
    cv::Mat smooth;
    drogue_config_default(&config);
    cv::GaussianBlur(grey, smooth, {5, 5}, 0, 0, cv::BORDER_REPLICATE);
    cv::Sobel(smooth, gx, CV_16S, 1, 0, 3, 1, 0, cv::BORDER_REPLICATE);
    cv::Sobel(smooth, gy, CV_16S, 0, 1, 3, 1, 0, cv::BORDER_REPLICATE);
    cv::Canny(gx, gy, edges, config.canny_low, config.canny_high);
}

bool EdgeImage::edge_at(int x, int y) const
{
    return x >= 0 && y >= 0 && x < edges.cols && y < edges.rows && edges.at<uint8_t>(y, x) != 0;
}

cv::Point2d EdgeImage::gradient_at(const cv::Point &p) const
{
    return {static_cast<double>(gx.at<int16_t>(p)), static_cast<double>(gy.at<int16_t>(p))};
}

std::vector<Chain> chains_of(const EdgeImage &image)
{
    cv::Mat visited = cv::Mat::zeros(image.edges.size(), CV_8U);
    std::vector<Chain> chains;
    for (int y = 0; y < image.edges.rows; y++) {
        for (int x = 0; x < image.edges.cols; x++) {
            if (!image.edge_at(x, y) || visited.at<uint8_t>(y, x) != 0) {
                continue;
            }
            visited.at<uint8_t>(y, x) = 1;
            std::vector<cv::Point> path = walk(image, visited, {x, y}, {0, 0});
            const cv::Point way = path.front() - path[std::min<size_t>(path.size() - 1, 4)];
            const std::vector<cv::Point> back = walk(image, visited, {x, y}, way);
            std::reverse(path.begin(), path.end());
            path.insert(path.end(), back.begin() + 1, back.end());
            Chain chain;
            for (const cv::Point &p : path) {
                chain.push_back({p, image.gradient_at(p)});
            }
            chains.push_back(chain);
        }
    }
    return chains;
}

bool is_arc(const Chain &chain)
{
    if (chain.size() < min_arc_px) {
        return false;
    }
    const cv::RotatedRect r = cv::minAreaRect(points_of(chain));
    return static_cast<double>(std::min(r.size.width, r.size.height)) >= min_short_px;
}

std::vector<Chain> convex_arcs(const Chain &chain, double tolerance_px, double max_turn_rad)
{
    std::vector<Chain> arcs;
    if (chain.size() < min_arc_px) {
        return arcs;
    }
    const std::vector<cv::Point> points = points_of(chain);
    std::vector<cv::Point> polygon;
    cv::approxPolyDP(points, polygon, tolerance_px, false);
    std::vector<size_t> at; /* of the vertices in the chain */
    size_t from = 0;
    for (const cv::Point &v : polygon) {
        while (from < points.size() && points[from] != v) {
            from++;
        }
        at.push_back(std::min(from, points.size() - 1));
    }
    const auto add = [&](size_t first, size_t last) {
        const Chain arc(chain.begin() + static_cast<std::ptrdiff_t>(first),
                        chain.begin() + static_cast<std::ptrdiff_t>(last) + 1);
        if (is_arc(arc)) {
            arcs.push_back(arc);
        }
    };
    size_t begin = 0; /* vertex where the arc begins */
    double side = 0;
    for (size_t i = 1; i + 1 < polygon.size(); i++) {
        const double turn = turn_rad(polygon[i - 1], polygon[i], polygon[i + 1]);
        if (std::fabs(turn) > max_turn_rad || turn * side < 0) {
            add(at[begin], at[i]);
            begin = i;
            side = 0;
        } else {
            side = turn;
        }
    }
    add(at[begin], at.back());
    return arcs;
}

std::vector<Chain> convex_arcs_of(const EdgeImage &image)
{
    std::vector<Chain> all;
    for (const Chain &chain : chains_of(image)) {
        for (Chain &arc : convex_arcs(chain, 1.5, CV_PI / 3)) {
            all.push_back(std::move(arc));
        }
    }
    /* Longest first. */
    std::stable_sort(all.begin(), all.end(), [](const Chain &a, const Chain &b) { return a.size() > b.size(); });
    return all;
}

cv::Point2d bulge_of(const Chain &arc)
{
    return cv::Point2d(arc[arc.size() / 2].at) - 0.5 * cv::Point2d(arc.front().at + arc.back().at);
}

bool face_each_other(const Chain &a, const Chain &b)
{
    const auto behind = [](const Chain &arc, const Chain &other) {
        const cv::Point middle = arc[arc.size() / 2].at;
        const cv::Point2d bulge = bulge_of(arc);
        return bulge.dot(other.front().at - middle) < 0 && bulge.dot(other[other.size() / 2].at - middle) < 0 &&
               bulge.dot(other.back().at - middle) < 0;
    };
    return behind(a, b) && behind(b, a);
}

bool fit_arcs(Ellipse &out, const std::vector<const Chain *> &arcs)
{
    std::vector<cv::Point> points;
    for (const Chain *arc : arcs) {
        for (const EdgePoint &p : *arc) {
            points.push_back(p.at);
        }
    }
    if (points.size() < min_arc_px) {
        return false;
    }
    out = ellipse_of(cv::fitEllipseDirect(points));
    return out.b_px > 1 && out.a_px < 1e4; /* false for NaN, too */
}

double distance_px(const Ellipse &e, const cv::Point2d &p)
{
    const cv::Point2d q = in_frame(e, p);
    const double slope = 2 * std::hypot(q.x / e.a_px, q.y / e.b_px);
    return slope > 0 ? std::fabs(q.dot(q) - 1) / slope : e.b_px;
}

double rms_px(const Ellipse &e, const Chain &chain)
{
    double sum = 0;
    for (const EdgePoint &p : chain) {
        const double d = distance_px(e, p.at);
        sum += d * d;
    }
    return std::sqrt(sum / static_cast<double>(chain.size()));
}

cv::Point2d normal_at(const Ellipse &e, const cv::Point2d &p)
{
    const cv::Point2d q = in_frame(e, p);
    const double u = q.x / e.a_px;
    const double v = q.y / e.b_px;
    const double length = std::max(1e-12, std::hypot(u, v));
    const double c = std::cos(e.angle_rad);
    const double s = std::sin(e.angle_rad);
    return {(c * u - s * v) / length, (s * u + c * v) / length};
}

double circumference_px(const Ellipse &e)
{
    const double a = e.a_px;
    const double b = e.b_px;
    return CV_PI * (3 * (a + b) - std::sqrt((3 * a + b) * (a + 3 * b))); /* Ramanujan */
}

EdgeSupport support_of(const EdgeImage &image, const Ellipse &e)
{
    EdgeSupport s = {std::max(8, static_cast<int>(std::lround(circumference_px(e)))), 0};
    for (int i = 0; i < s.points; i++) {
        const cv::Point2d p = e.at(2 * CV_PI * i / s.points);
        const cv::Point2d n = normal_at(e, p);
        const cv::Point middle(cvRound(p.x), cvRound(p.y));
        bool aligned = false;
        for (int dy = -2; dy <= 2 && !aligned; dy++) {
            for (int dx = -2; dx <= 2 && !aligned; dx++) {
                const cv::Point at(middle.x + dx, middle.y + dy);
                if (!image.edge_at(at.x, at.y) || cv::norm(cv::Point2d(at) - p) > max_residual_px) {
                    continue;
                }
                const cv::Point2d g = image.gradient_at(at);
                aligned = std::fabs(g.dot(n)) >= aligned_cos * cv::norm(g);
            }
        }
        s.aligned += aligned;
    }
    return s;
}

} // namespace accuracy
