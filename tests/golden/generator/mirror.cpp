/* SPDX-License-Identifier: Apache-2.0 */
/* The measurement of a frame in floating point. Edge points, their subpixel places and arcs are the front end's, which is
 * exact; from there on every number is unrounded, and every threshold is the one of drogue/config.h. */
#include "mirror.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "reference.hpp"
#include "stages.h"

#include "drogue/drogue.h"

namespace vectors {

namespace {

using reference::Ellipse;
using reference::Point;
using reference::q16;
using reference::Real;

Real real(int64_t word) { return static_cast<Real>(word) / 65536; }

struct Edge {
    cv::Point pixel;
    Point at;  /* region coordinates */
    Real gx, gy; /* y down */
};

struct FrontEnd {
    drogue_status status;
    std::vector<Edge> edges;
    std::vector<std::vector<Edge>> arcs;
    std::vector<int> direction;
};

drogue_config default_config()
{
    drogue_config config;
    drogue_config_default(&config);
    return config;
}

const drogue_config config = default_config();

/* The region within the image, and the circles about the region asked for in its coordinates. */
bool place(cv::Rect &clipped, drogue_mask &mask, const cv::Mat &image, const std::vector<int64_t> &region)
{
    const auto far = [](int64_t v) { return v > 1 << 20 || v < -(1 << 20); };
    if (region[2] < 1 || region[3] < 1 || region[2] > DROGUE_MAX_REGION || region[3] > DROGUE_MAX_REGION ||
        far(region[0]) || far(region[1])) {
        return false;
    }
    const cv::Rect asked(static_cast<int>(region[0]), static_cast<int>(region[1]), static_cast<int>(region[2]),
                         static_cast<int>(region[3]));
    clipped = asked & cv::Rect(0, 0, image.cols, image.rows);
    mask.centre2_x = asked.width - 1 + 2 * (asked.x - clipped.x);
    mask.centre2_y = asked.height - 1 + 2 * (asked.y - clipped.y);
    mask.longest_px = std::max(asked.width, asked.height);
    return !clipped.empty() && clipped.width <= DROGUE_MAX_SIDE && clipped.height <= DROGUE_MAX_SIDE &&
           clipped.br().x <= INT16_MAX && clipped.br().y <= INT16_MAX;
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
    front.min_arc_px = std::max(config.min_arc_px,
                                static_cast<uint32_t>(std::floor(real(config.min_arc_share_q16) * mask.longest_px + 0.5L)));
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
                           static_cast<Real>(e.gx), static_cast<Real>(e.gy)};
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

/* An outline: its ellipse in region coordinates, the arcs it came from. */
struct Outline {
    Ellipse ellipse;
    int polarity = 0, combination = 0;
    int64_t refit_points = 0;
};

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
            const auto near_count = std::count_if(points.begin(), points.end(), [&](const Point &p) {
                return reference::deviation(e, p) < threshold;
            });
            const reference::Quality q = reference::quality(e, static_cast<int>(near_count), static_cast<int>(points.size()),
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
        candidates, {real(c.centre_px_q16), real(c.a_px_q16), real(c.b_px_q16), real(c.angle_rad_q16), real(c.round_q16)},
        members);
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

reference::Camera camera_of(const std::vector<int64_t> &w)
{
    return {real(w[0]), real(w[1]), real(w[2]), real(w[3]), real(w[4]), real(w[5]), real(w[6]), real(w[7]), real(w[8])};
}

/* Ellipse as the ideal camera would see it, px of the whole image; not ok when the lens cannot be undone. */
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

int rounded(Real v) { return static_cast<int>(std::floor(v + 0.5L)); }

void put_ellipse(int64_t *at, const Ellipse &e)
{
    at[0] = q16(e.xc);
    at[1] = q16(e.yc);
    at[2] = q16(e.a);
    at[3] = q16(e.b);
    at[4] = q16(e.angle);
}

std::array<int64_t, 8> pose_words(const reference::Pose &p)
{
    return {q16(p.position[0]), q16(p.position[1]), q16(p.position[2]), q16(p.axis[0]),
            q16(p.axis[1]),     q16(p.axis[2]),     q16(p.yaw),         q16(p.pitch)};
}

/* LSB by which each word of the pose may move when the ellipse moves by its bound, beyond the pose's own. */
std::array<uint32_t, 8> pose_bound(const Ellipse &e, const std::array<uint32_t, 5> &px, const reference::Camera &camera,
                                   Real radius, size_t which)
{
    std::array<reference::Pose, 2> pair, moved;
    std::array<uint32_t, 8> bound;
    bound.fill(4);
    reference::poses(e, camera, radius, pair);
    const std::array<int64_t, 8> own = pose_words(pair[which]);
    for (size_t k = 0; k < 5; k++) {
        std::array<int64_t, 8> most = {};
        for (const int sign : {1, -1}) {
            Ellipse f = e;
            Real *const member[5] = {&f.xc, &f.yc, &f.a, &f.b, &f.angle};
            *member[k] += sign * static_cast<Real>(px[k]) / 65536;
            f.b = std::min(f.b, f.a);
            if (reference::poses(f, camera, radius, moved)) {
                const std::array<int64_t, 8> words = pose_words(moved[which]);
                for (size_t i = 0; i < 8; i++) {
                    most[i] = std::max(most[i], std::abs(words[i] - own[i]));
                }
            }
        }
        for (size_t i = 0; i < 8; i++) {
            bound[i] += static_cast<uint32_t>(most[i]);
        }
    }
    return bound;
}

/* LSB by which the ambiguity may move when each word of the poses moves by its bound. */
uint32_t ambiguity_bound(const std::array<reference::Pose, 2> &pair, const std::array<std::array<uint32_t, 8>, 2> &bound,
                         const reference::Choice &choice, Point inner, Real depth, const reference::Camera &camera)
{
    Real moved = 0;
    for (size_t i = 0; i < 2; i++) {
        for (size_t k = 0; k < 6; k++) {
            reference::Pose p = pair[i];
            Point q;
            (k < 3 ? p.position[k] : p.axis[k - 3]) += static_cast<Real>(bound[i][k]) / 65536;
            if (reference::project(p, depth, camera, q)) {
                moved += std::fabs(std::hypot(q.x - inner.x, q.y - inner.y) - choice.distance[i]);
            }
        }
    }
    const Real farther = std::max(choice.distance[0], choice.distance[1]);
    return static_cast<uint32_t>(std::min<Real>(65536, 1 + std::ceil(65536 * moved / std::max<Real>(farther, 1e-6L))));
}

enum Word { STATUS = 0, SEEN = 1, IDEAL = 6, POLARITY = 11, ARCS, REFIT, HAS_INNER, INNER, POSE = 19, OTHER = 27, RESOLVED = 35, AMBIGUITY };
constexpr uint32_t ELLIPSE_LSB = 16;
constexpr uint32_t ANY_ANGLE = 205887; /* pi */

/* The last fit takes points on a grid about the ellipse before it, the finest in which four semi-axes fit 16 bits. Edge
 * points, on a grid of their own, are all moved alike: the centre is good to half a pitch. Without their grid, the lens
 * undone, they move each in its own way. */
std::array<uint32_t, 5> ellipse_bound(const Ellipse &e, bool lens)
{
    uint32_t pitch = 64; /* LSB */
    while (pitch < 65536 && 4 * e.a * 65536 / pitch > 32767) {
        pitch *= 2;
    }
    const uint32_t centre = ELLIPSE_LSB + pitch / 2;
    const uint32_t axis = lens ? centre : ELLIPSE_LSB;
    const Real angle = axis + std::ceil(axis / std::max<Real>(e.a - e.b, 1e-9L));
    return {centre, centre, axis, axis, angle < ANY_ANGLE ? static_cast<uint32_t>(angle) : ANY_ANGLE};
}

} // namespace

FrameReference mirror_frame(const cv::Mat &image, const std::vector<int64_t> &camera_words,
                            const std::vector<int64_t> &model, const std::vector<int64_t> &region)
{
    FrameReference out = {std::vector<int64_t>(37, 0), std::vector<uint32_t>(37, 0)};
    std::vector<int64_t> &w = out.words;
    const reference::Camera camera = camera_of(camera_words);
    const Real radius = real(model[0]);
    cv::Rect clipped;
    drogue_mask mask;
    Farthest farthest;
    w[AMBIGUITY] = 65536;
    if (!(camera.fx > 0) || !(camera.fy > 0) || !(radius > 0) || model[1] < 0) {
        w[STATUS] = DROGUE_E_ARGUMENT;
        return out;
    }
    if (!place(clipped, mask, image, region)) {
        w[STATUS] = DROGUE_E_REGION;
        return out;
    }
    const cv::Mat view = image(clipped).clone();
    const FrontEnd front = run_front_end(view, mask);
    if (front.status != DROGUE_OK || front.edges.empty()) {
        w[STATUS] = front.status != DROGUE_OK ? front.status : DROGUE_E_NO_EDGES;
        return out;
    }
    if (!select_farthest(farthest, front, mask)) {
        w[STATUS] = DROGUE_E_NO_ARCS;
        return out;
    }
    std::optional<Outline> outline = best_combination(front, farthest, mask);
    if (!outline || !refit(*outline, front, mask)) {
        w[STATUS] = DROGUE_E_NO_ELLIPSE;
        return out;
    }
    undo_blur(outline->ellipse);
    Ellipse seen = outline->ellipse;
    seen.xc += clipped.x;
    seen.yc += clipped.y;
    Ellipse ideal = seen;
    const bool lens = (camera_words[4] | camera_words[5] | camera_words[6] | camera_words[7] | camera_words[8]) != 0;
    if (lens) {
        ideal = ideal_of(*outline, front, camera, clipped.tl());
    }
    put_ellipse(&w[SEEN], seen);
    w[POLARITY] = outline->polarity;
    w[ARCS] = outline->combination;
    w[REFIT] = outline->refit_points;
    if (ideal.ok) {
        put_ellipse(&w[IDEAL], ideal);
    }
    const std::array<uint32_t, 5> bounds[2] = {ellipse_bound(seen, false), ellipse_bound(ideal, lens)};
    std::copy(bounds[0].begin(), bounds[0].end(), out.bound.begin() + SEEN);
    std::copy(bounds[1].begin(), bounds[1].end(), out.bound.begin() + IDEAL);
    if (!ideal.ok) {
        w[STATUS] = DROGUE_E_NO_ELLIPSE;
        return out;
    }
    Point inner = {0, 0};
    if (model[1] > 0) {
        const Ellipse &e = outline->ellipse;
        const reference::DarkPart part =
            reference::dark_part(view, rounded(2 * e.xc), rounded(2 * e.yc), rounded(2.5L * e.b),
                                 static_cast<int>(config.min_dark_area_px));
        w[INNER + 3] = part.threshold;
        w[HAS_INNER] = part.found;
        if (part.found) {
            inner = {part.x + clipped.x, part.y + clipped.y};
            w[INNER] = q16(inner.x);
            w[INNER + 1] = q16(inner.y);
            w[INNER + 2] = part.area;
            out.bound[INNER] = out.bound[INNER + 1] = 1;
        }
    }
    std::array<reference::Pose, 2> pair;
    if (!reference::poses(ideal, camera, radius, pair)) {
        w[STATUS] = DROGUE_E_DOMAIN;
        return out;
    }
    reference::Choice choice = {0, {0, 0}, 1};
    if (w[HAS_INNER] != 0 && reference::undistort(camera, inner)) {
        if (!reference::choose(pair, inner, real(model[2]), camera, choice)) {
            w[STATUS] = DROGUE_E_BEHIND_CAMERA;
            return out;
        }
        w[RESOLVED] = choice.distance[static_cast<size_t>(choice.index)] <= real(config.inner_gate_q16) * ideal.a &&
                      choice.ambiguity <= real(config.max_ambiguity_q16);
    }
    w[AMBIGUITY] = q16(choice.ambiguity);
    const std::array<std::array<uint32_t, 8>, 2> pose_bounds = {pose_bound(ideal, bounds[1], camera, radius, 0),
                                                                pose_bound(ideal, bounds[1], camera, radius, 1)};
    for (const int k : {0, 1}) {
        const auto which = static_cast<size_t>(choice.index ^ k);
        const std::array<int64_t, 8> words = pose_words(pair[which]);
        std::copy(words.begin(), words.end(), w.begin() + (k == 0 ? POSE : OTHER));
        std::copy(pose_bounds[which].begin(), pose_bounds[which].end(), out.bound.begin() + (k == 0 ? POSE : OTHER));
    }
    if (w[HAS_INNER] != 0) {
        out.bound[AMBIGUITY] = ambiguity_bound(pair, pose_bounds, choice, inner, real(model[2]), camera);
    }
    return out;
}

} // namespace vectors
