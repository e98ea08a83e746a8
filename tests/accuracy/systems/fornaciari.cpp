/* SPDX-License-Identifier: Apache-2.0 */
/* Fornaciari: triplets of arcs, and an ellipse's parameters one after the other. */
#include "detectors.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "edges.hpp"
#include "quadrants.hpp"

namespace accuracy {

namespace {

constexpr size_t most_arcs = 8;       /* of a quadrant */
constexpr size_t most_chords = 16;    /* parallel ones, of a pair */
constexpr double centre_share = 0.05; /* two pairs' centres agree within this share of the picture's side, */
constexpr double centre_px = 5;       /* or this near */
constexpr double near_share = 0.6;    /* of the points must lie on the ellipse, */
constexpr double near_px = 1.5;       /* this near */
constexpr int ratio_bins = 100;
constexpr int angle_bins = 180;

double cross(const cv::Point2d &a, const cv::Point2d &b) { return a.x * b.y - a.y * b.x; }

/* Parallel chords and the line through their middles: conjugate directions. */
struct Midline {
    bool ok = false;
    cv::Point2d chord, through, direction;
    std::vector<cv::Point2d> along; /* several estimates of the line's direction */
};

struct PairCentre {
    bool ok = false;
    cv::Point2d centre;
    std::array<Midline, 2> lines;
};

/* Where the chord from p in the given direction meets the arc again, between two of its points. */
bool meets(cv::Point2d &out, const Chain &arc, const cv::Point2d &p, const cv::Point2d &way)
{
    double before = cross(way, cv::Point2d(arc[0].at) - p);
    for (size_t i = 1; i < arc.size(); i++) {
        const double now = cross(way, cv::Point2d(arc[i].at) - p);
        if ((before <= 0) != (now <= 0)) {
            const double t = before / (before - now);
            out = (1 - t) * cv::Point2d(arc[i - 1].at) + t * cv::Point2d(arc[i].at);
            return true;
        }
        before = now;
    }
    return false;
}

double median_of(std::vector<double> v)
{
    std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
    return v[v.size() / 2];
}

Midline midline(const Chain &a, const Chain &b, const cv::Point2d &chord)
{
    Midline line;
    std::vector<cv::Point2d> middles;
    const size_t step = std::max<size_t>(1, b.size() / most_chords);
    for (size_t i = 0; i < b.size(); i += step) {
        cv::Point2d other;
        if (meets(other, a, b[i].at, chord)) {
            middles.push_back(0.5 * (other + cv::Point2d(b[i].at)));
        }
    }
    if (middles.size() < 4) {
        return line;
    }
    const size_t half = middles.size() / 2;
    for (size_t i = 0; i < half; i++) {
        const cv::Point2d d = middles[half + i] - middles[i];
        if (cv::norm(d) > 1) {
            line.along.push_back(d * (1 / cv::norm(d)));
        }
    }
    line.ok = !line.along.empty();
    line.chord = chord;
    cv::Vec4d fitted;
    cv::fitLine(std::vector<cv::Point2f>(middles.begin(), middles.end()), fitted, cv::DIST_HUBER, 0, 0.01, 0.01);
    line.direction = {fitted[0], fitted[1]};
    line.through = {fitted[2], fitted[3]};
    return line;
}

/* Where two midlines meet; false when they hardly do. */
bool intersect(cv::Point2d &out, const Midline &a, const Midline &b)
{
    const double sine = cross(a.direction, b.direction);
    if (std::fabs(sine) < 0.1) {
        return false;
    }
    out = a.through + a.direction * (cross(b.through - a.through, b.direction) / sine);
    return true;
}

/* The middle in x and in y of all places where two of both pairs' midlines meet. */
cv::Point2d common_centre(const PairCentre &first, const PairCentre &second)
{
    const std::array<const Midline *, 4> lines = {&first.lines[0], &first.lines[1], &second.lines[0], &second.lines[1]};
    std::vector<double> xs, ys;
    for (size_t i = 0; i < lines.size(); i++) {
        for (size_t j = i + 1; j < lines.size(); j++) {
            cv::Point2d p;
            if (intersect(p, *lines[i], *lines[j])) {
                xs.push_back(p.x);
                ys.push_back(p.y);
            }
        }
    }
    return {median_of(xs), median_of(ys)};
}

PairCentre centre_of(const Chain &a, const Chain &b)
{
    PairCentre pair;
    /* The end of each that is away from the other, to the other's middle. */
    const auto far_end = [](const Chain &c, const cv::Point &from) {
        return cv::norm(c.front().at - from) > cv::norm(c.back().at - from) ? c.front().at : c.back().at;
    };
    const cv::Point middle_a = a[a.size() / 2].at;
    const cv::Point middle_b = b[b.size() / 2].at;
    pair.lines[0] = midline(a, b, middle_b - far_end(a, middle_b));
    pair.lines[1] = midline(b, a, middle_a - far_end(b, middle_a));
    pair.ok = pair.lines[0].ok && pair.lines[1].ok && intersect(pair.centre, pair.lines[0], pair.lines[1]);
    return pair;
}

/* Ratio and angle from two pairs of conjugate directions: u' M v = 0 for each. */
bool shape_of(double &ratio, double &angle, const cv::Point2d &u1, const cv::Point2d &v1, const cv::Point2d &u2,
              const cv::Point2d &v2)
{
    const auto row = [](const cv::Point2d &u, const cv::Point2d &v) {
        return cv::Vec3d(u.x * v.x, u.x * v.y + u.y * v.x, u.y * v.y);
    };
    cv::Vec3d m = row(u1, v1).cross(row(u2, v2));
    m = m[0] + m[2] < 0 ? -m : m;
    const double half = (m[0] + m[2]) / 2;
    const double apart = std::hypot((m[0] - m[2]) / 2, m[1]);
    if (!(half > apart)) {
        return false;
    }
    ratio = std::sqrt((half - apart) / (half + apart));
    angle = std::atan2(2 * m[1], m[0] - m[2]) / 2 + CV_PI / 2; /* of the smaller eigenvalue */
    return true;
}

size_t peak_of(const std::vector<int> &votes)
{
    return static_cast<size_t>(std::max_element(votes.begin(), votes.end()) - votes.begin());
}

/* Ratio, angle and size by votes, one after the other. */
bool vote(Ellipse &e, const PairCentre &first, const PairCentre &second, const std::array<const Chain *, 3> &arcs)
{
    std::vector<int> ratios(ratio_bins + 1), angles(angle_bins);
    for (const Midline &p : first.lines) {
        for (const Midline &q : second.lines) {
            for (const cv::Point2d &u : p.along) {
                for (const cv::Point2d &v : q.along) {
                    double ratio, angle;
                    if (shape_of(ratio, angle, p.chord, u, q.chord, v)) {
                        ratios[static_cast<size_t>(std::lround(ratio * ratio_bins))]++;
                        angles[static_cast<size_t>((std::lround(angle / CV_PI * angle_bins) % angle_bins + angle_bins) %
                                                   angle_bins)]++;
                    }
                }
            }
        }
    }
    const size_t ratio_at = peak_of(ratios);
    if (ratios[ratio_at] == 0 || ratio_at < 20) {
        return false;
    }
    const cv::Point2d centre = common_centre(first, second);
    e.xc_px = centre.x;
    e.yc_px = centre.y;
    const double ratio = static_cast<double>(ratio_at) / ratio_bins;
    e.angle_rad = std::remainder(static_cast<double>(peak_of(angles)) * CV_PI / angle_bins, CV_PI);
    std::vector<int> sizes(2000);
    const double c = std::cos(e.angle_rad);
    const double s = std::sin(e.angle_rad);
    for (const Chain *arc : arcs) {
        for (const EdgePoint &p : *arc) {
            const double x = c * (p.at.x - e.xc_px) + s * (p.at.y - e.yc_px);
            const double y = c * (p.at.y - e.yc_px) - s * (p.at.x - e.xc_px);
            const double size = std::hypot(x, y / ratio);
            sizes[static_cast<size_t>(std::min(1999L, std::lround(size)))]++;
        }
    }
    e.a_px = static_cast<double>(peak_of(sizes));
    e.b_px = ratio * e.a_px;
    return e.b_px > 1;
}

bool on_it(const Ellipse &e, const std::array<const Chain *, 3> &arcs)
{
    size_t close = 0, all = 0;
    for (const Chain *arc : arcs) {
        for (const EdgePoint &p : *arc) {
            close += distance_px(e, p.at) <= near_px;
            all++;
        }
    }
    return static_cast<double>(close) >= near_share * static_cast<double>(all);
}

} // namespace

std::vector<Ellipse> detect_fornaciari(const cv::Mat &grey)
{
    const EdgeImage image(grey);
    const QuadrantArcs arcs = quadrant_arcs(image, most_arcs);
    const double limit = std::max(centre_px, centre_share * std::max(grey.cols, grey.rows));
    std::vector<Ellipse> found;
    /* Centres of pairs of neighbouring quadrants, q and q + 1. */
    std::array<std::vector<std::vector<PairCentre>>, 4> pairs;
    for (size_t q = 0; q < 4; q++) {
        for (const QuadrantArc &a : arcs[q]) {
            pairs[q].emplace_back();
            for (const QuadrantArc &b : arcs[(q + 1) % 4]) {
                pairs[q].back().push_back(in_order(a, b) ? centre_of(a.chain, b.chain) : PairCentre());
            }
        }
    }
    for (size_t q = 0; q < 4; q++) { /* triplets about the middle quadrant q + 1 */
        const size_t mid = (q + 1) % 4, last = (q + 2) % 4;
        for (size_t i = 0; i < arcs[q].size(); i++) {
            for (size_t j = 0; j < arcs[mid].size(); j++) {
                for (size_t k = 0; k < arcs[last].size(); k++) {
                    const PairCentre &first = pairs[q][i][j];
                    const PairCentre &second = pairs[mid][j][k];
                    const std::array<const Chain *, 3> three = {&arcs[q][i].chain, &arcs[mid][j].chain,
                                                                &arcs[last][k].chain};
                    Ellipse e;
                    if (first.ok && second.ok && in_order(arcs[q][i], arcs[last][k]) &&
                        cv::norm(first.centre - second.centre) <= limit && vote(e, first, second, three) &&
                        on_it(e, three)) {
                        found.push_back(e);
                    }
                }
            }
        }
    }
    return found;
}

} // namespace accuracy
