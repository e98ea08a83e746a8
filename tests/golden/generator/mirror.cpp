/* SPDX-License-Identifier: Apache-2.0 */
/* The measurement of a frame in floating point: region, outline, dark part, poses, choice; and how far the library may be
 * from it. */
#include "mirror.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "mirror_outline.hpp"

namespace vectors {

namespace {

using reference::Ellipse;
using reference::Point;
using reference::q16;
using reference::Real;

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

reference::Camera camera_of(const std::vector<int64_t> &w)
{
    return {real(w[0]), real(w[1]), real(w[2]), real(w[3]), real(w[4]), real(w[5]), real(w[6]), real(w[7]), real(w[8])};
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
uint32_t ambiguity_bound(const std::array<reference::Pose, 2> &pair,
                         const std::array<std::array<uint32_t, 8>, 2> &bound, const reference::Choice &choice,
                         Point inner, Real depth, const reference::Camera &camera)
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

enum Word {
    STATUS = 0,
    SEEN = 1,
    IDEAL = 6,
    POLARITY = 11,
    ARCS,
    REFIT,
    HAS_INNER,
    INNER,
    POSE = 19,
    OTHER = 27,
    RESOLVED = 35,
    AMBIGUITY
};
constexpr uint32_t ELLIPSE_LSB = 4;
constexpr uint32_t ANY_ANGLE = 205887; /* pi */

/* Edge points enter the last fit exactly. With the lens undone they are rounded, each in its own way, to a grid in which
 * four semi-axes fit 16 bits: half a pitch bounds what that can do. */
std::array<uint32_t, 5> ellipse_bound(const Ellipse &e, bool lens)
{
    uint32_t pitch = 64; /* LSB */
    while (pitch < 65536 && 4 * e.a * 65536 / pitch > 32767) {
        pitch *= 2;
    }
    const uint32_t axis = lens ? ELLIPSE_LSB + pitch / 2 : ELLIPSE_LSB;
    const Real angle = axis + std::ceil(axis / std::max<Real>(e.a - e.b, 1e-9L));
    return {axis, axis, axis, axis, angle < ANY_ANGLE ? static_cast<uint32_t>(angle) : ANY_ANGLE};
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
    Outline outline;
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
    w[STATUS] = find_outline(outline, front, mask);
    if (w[STATUS] != DROGUE_OK) {
        return out;
    }
    Ellipse seen = outline.ellipse;
    seen.xc += clipped.x;
    seen.yc += clipped.y;
    Ellipse ideal = seen;
    const bool lens = (camera_words[4] | camera_words[5] | camera_words[6] | camera_words[7] | camera_words[8]) != 0;
    if (lens) {
        ideal = ideal_of(outline, front, camera, clipped.tl());
    }
    put_ellipse(&w[SEEN], seen);
    w[POLARITY] = outline.polarity;
    w[ARCS] = outline.combination;
    w[REFIT] = outline.refit_points;
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
        const Ellipse &e = outline.ellipse;
        const reference::DarkPart part = reference::dark_part(
            view, rounded(2 * e.xc), rounded(2 * e.yc), rounded(2.5L * e.b), static_cast<int>(config.min_dark_area_px));
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
