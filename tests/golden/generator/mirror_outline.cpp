/* SPDX-License-Identifier: Apache-2.0 */
/* From edge points to the outline in floating point. Edge points, their subpixel places and arcs are the front end's, which
 * is exact; from there on every number is unrounded, and every threshold is the one of drogue/config.h. */
#include "mirror_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "stages.h"

namespace vectors {

using reference::Ellipse;
using reference::Point;
using reference::q16;
using reference::Real;

namespace {

const drogue_config config = default_config();

/* The farthest acceptable arc of each polarity and quadrant; -1: none. */
using Farthest = std::array<std::array<int, 4>, 2>;

bool select_farthest(Farthest &out, const FrontEnd &front, const drogue_mask &mask)
{
    std::array<std::array<Real, 4>, 2> most = {};
    bool any = false;
    out[0].fill(-1);
    out[1].fill(-1);
    for (size_t i = 0; i < front.arcs.size(); i++) {
        std::vector<cv::Point> pixels;
        for (const Edge &e : front.arcs[i]) {
            pixels.push_back(e.pixel);
        }
        const reference::Rect r = reference::min_area_rect(pixels);
        const Real dx = real(q16(r.xc)) - static_cast<Real>(mask.centre2_x) / 2;
        const Real dy = real(q16(r.yc)) - static_cast<Real>(mask.centre2_y) / 2;
        if (dx == 0 || dy == 0 || q16(r.shorter) < config.min_short_px_q16) {
            continue;
        }
        const int quadrant = dy < 0 ? (dx > 0 ? 0 : 1) : (dx < 0 ? 2 : 3);
        const int turn = (quadrant - front.direction[i]) & 3;
        if (turn % 2 != 0) {
            continue;
        }
        const auto polarity = static_cast<size_t>(turn / 2);
        const auto q = static_cast<size_t>(quadrant);
        if (out[polarity][q] < 0 || dx * dx + dy * dy > most[polarity][q]) {
            most[polarity][q] = dx * dx + dy * dy;
            out[polarity][q] = static_cast<int>(i);
            any = true;
        }
    }
    return any;
}

Ellipse fit(const std::vector<Point> &points)
{
    std::vector<cv::Point2d> plain;
    for (const Point &p : points) {
        plain.emplace_back(static_cast<double>(p.x), static_cast<double>(p.y));
    }
    return reference::fit(plain);
}

bool plausible(const Ellipse &e, const drogue_mask &mask)
{
    return e.ok && e.b >= e.a * real(config.min_axis_ratio_q16) && e.a >= real(config.min_size_q16) * mask.longest_px &&
           e.a <= real(config.max_size_q16) * mask.longest_px;
}

std::optional<Outline> best_combination(const FrontEnd &front, const Farthest &farthest, const drogue_mask &mask)
{
    std::vector<reference::Candidate> candidates;
    std::vector<Outline> outlines;
    for (int polarity = 0; polarity < 2; polarity++) {
        for (int combination = 1; combination < 16; combination++) {
            std::vector<Point> points;
            bool present = true;
            for (size_t k = 0; k < 4; k++) {
                const int arc = farthest[static_cast<size_t>(polarity)][k];
                if ((combination >> k & 1) != 0) {
                    present = present && arc >= 0;
                    for (const Edge &e : arc >= 0 ? front.arcs[static_cast<size_t>(arc)] : std::vector<Edge>()) {
                        points.push_back(e.at);
                    }
                }
            }
            const Ellipse e = present ? fit(points) : Ellipse{0, 0, 0, 0, 0, false};
            if (!plausible(e, mask) || e.b < 1) {
                continue;
            }
            const Real threshold = reference::deviation_threshold(e, real(config.quality.fit_error_px_q16));
            const auto near_count = std::count_if(
                points.begin(), points.end(), [&](const Point &p) { return reference::deviation(e, p) < threshold; });
            const reference::Quality q =
                reference::quality(e, static_cast<int>(near_count), static_cast<int>(points.size()),
                                   real(config.quality.k1_q16), real(config.quality.k2_q16));
            if (q.fit_ratio >= real(config.min_fit_ratio_q16)) {
                candidates.push_back({e, real(q16(q.reliability)), polarity}); /* equal in Q16 is equal */
                outlines.push_back({e, polarity, combination, 0});
            }
        }
    }
    const drogue_cluster_config &c = config.cluster;
    int members;
    const int best = reference::cluster_best(
        candidates,
        {real(c.centre_px_q16), real(c.a_px_q16), real(c.b_px_q16), real(c.angle_rad_q16), real(c.round_q16)}, members);
    return best < 0 ? std::nullopt : std::optional<Outline>(outlines[static_cast<size_t>(best)]);
}

/* Does an edge point belong to an outline: near it to first order, the gradient along its normal? */
bool in_band(const Ellipse &e, int polarity, const Edge &edge)
{
    const Real c = std::cos(e.angle), s = std::sin(e.angle), dx = edge.at.x - e.xc, dy = edge.at.y - e.yc;
    const Real u = (dx * c + dy * s) / e.a, v = (dy * c - dx * s) / e.b, f = u * u + v * v - 1;
    const Real nx = u * c / e.a - v * s / e.b, ny = u * s / e.a + v * c / e.b; /* half the gradient of f */
    const Real along = (edge.gx * nx + edge.gy * ny) * (polarity == DROGUE_POLARITY_BRIGHT ? -1 : 1);
    const Real n2 = nx * nx + ny * ny, g2 = edge.gx * edge.gx + edge.gy * edge.gy;
    const Real band = real(config.refit_band_px_q16);
    const Real cos2 = std::floor(real(config.refit_cos_q16) * real(config.refit_cos_q16) * 1024 + 0.5L) / 1024;
    return f <= 1 && f >= -0.75L && f * f <= 4 * band * band * n2 && along > 0 && along * along >= cos2 * g2 * n2;
}

std::vector<Point> points_in_band(const Ellipse &e, int polarity, const FrontEnd &front)
{
    std::vector<Point> points;
    for (const Edge &edge : front.edges) {
        if (in_band(e, polarity, edge)) {
            points.push_back(edge.at);
        }
    }
    return points;
}

/* False when the edge points cover too little of the outline. */
bool refit(Outline &outline, const FrontEnd &front, const drogue_mask &mask)
{
    for (uint32_t round = 0; round < config.refit_rounds; round++) {
        const std::vector<Point> points = points_in_band(outline.ellipse, outline.polarity, front);
        const Ellipse e = fit(points);
        if (!plausible(e, mask)) {
            break;
        }
        outline.ellipse = e;
        outline.refit_points = static_cast<int64_t>(points.size());
    }
    const auto count = static_cast<Real>(points_in_band(outline.ellipse, outline.polarity, front).size());
    return count >= real(config.min_cover_q16) * reference::circumference(outline.ellipse);
}

/* Blur of variance v moves an edge of curvature c inward by v c / 2; the front end's own half variance as measured. */
void undo_blur(Ellipse &e)
{
    const Real own = config.smooth ? 0.82L : 0.32L, optics = real(config.optics_blur_px_q16);
    const Real half = own + optics * optics / 2, a = e.a, b = e.b;
    e.a += half * a / (b * b);
    e.b += half * b / (a * a);
}

} // namespace

const drogue_config &default_config()
{
    static const drogue_config defaults = [] {
        drogue_config c;
        drogue_config_default(&c);
        return c;
    }();
    return defaults;
}

FrontEnd run_front_end(const cv::Mat &view, const drogue_mask &mask)
{
    const drogue_capacity capacity = {static_cast<uint32_t>(view.cols), CONF_MAX_EDGES, CONF_MAX_LABELS, CONF_MAX_ARCS};
    std::vector<uint32_t> memory(drogue_workspace_bytes(&capacity) / 4 + 1);
    drogue_workspace workspace;
    drogue_frontend frontend;
    drogue_edge_list list;
    FrontEnd out;
    drogue_frontend_config front = {};
    front.canny_low = config.canny_low;
    front.canny_high = config.canny_high;
    front.smooth = config.smooth;
    front.use_ring = 1;
    front.ring = mask;
    front.min_arc_px = std::max(
        config.min_arc_px, static_cast<uint32_t>(std::floor(real(config.min_arc_share_q16) * mask.longest_px + 0.5L)));
    if (drogue_workspace_init(&workspace, memory.data(), memory.size() * 4, &capacity) != DROGUE_OK ||
        drogue_frontend_begin(&frontend, &workspace, &front, view.cols, view.rows) != DROGUE_OK) {
        throw std::runtime_error("the front end does not start");
    }
    for (int y = 0; y < view.rows; y++) {
        drogue_frontend_row(&frontend, view.ptr<uint8_t>(y));
    }
    out.status = drogue_frontend_end(&list, &frontend);
    out.arcs.resize(list.arc_count);
    for (uint32_t i = 0; i < list.edge_count; i++) {
        const drogue_edge &e = workspace.edges[i];
        const Edge edge = {{drogue_edge_x_px(&e), drogue_edge_y_px(&e)},
                           {static_cast<Real>(e.x_q5) / 32, static_cast<Real>(e.y_q5) / 32},
                           static_cast<Real>(e.gx),
                           static_cast<Real>(e.gy)};
        out.edges.push_back(edge);
        if (e.arc != DROGUE_NO_ARC) {
            out.arcs[e.arc].push_back(edge);
        }
    }
    for (uint32_t i = 0; i < list.arc_count; i++) {
        out.direction.push_back(static_cast<int>(workspace.arcs[i].direction));
    }
    return out;
}

drogue_status find_outline(Outline &out, const FrontEnd &front, const drogue_mask &mask)
{
    Farthest farthest;
    if (front.status != DROGUE_OK || front.edges.empty()) {
        return front.status != DROGUE_OK ? front.status : DROGUE_E_NO_EDGES;
    }
    if (!select_farthest(farthest, front, mask)) {
        return DROGUE_E_NO_ARCS;
    }
    const std::optional<Outline> best = best_combination(front, farthest, mask);
    if (!best) {
        return DROGUE_E_NO_ELLIPSE;
    }
    out = *best;
    if (!refit(out, front, mask)) {
        return DROGUE_E_NO_ELLIPSE;
    }
    undo_blur(out.ellipse);
    return DROGUE_OK;
}

Ellipse ideal_of(const Outline &outline, const FrontEnd &front, const reference::Camera &camera, cv::Point origin)
{
    Point centre = {outline.ellipse.xc + origin.x, outline.ellipse.yc + origin.y};
    const Ellipse none = {0, 0, 0, 0, 0, false};
    const std::vector<Point> members = points_in_band(outline.ellipse, outline.polarity, front);
    std::vector<Point> points;
    if (!reference::undistort(camera, centre)) {
        return none;
    }
    for (const Point &p : members) {
        Point q = {p.x + origin.x, p.y + origin.y};
        if (reference::undistort(camera, q)) {
            points.push_back(q);
        }
    }
    Ellipse e = fit(points);
    if (!e.ok || 4 * points.size() < 3 * members.size() || e.b < e.a * real(config.min_axis_ratio_q16) || e.b < 1) {
        return none;
    }
    undo_blur(e);
    return e;
}

} // namespace vectors
