/* SPDX-License-Identifier: Apache-2.0 */
/* The measurement of a frame in floating point: region, outline, inner part, poses, choice, joint solution. */
#include "mirror.hpp"

#include "drogue/inner.h"
#include "drogue/noise.h"
#include "drogue/undistort.h"

#include <algorithm>
#include <cmath>

#include "seek.hpp"

namespace mirror {

using reference::Ellipse;
using reference::Point;
using reference::Pose;

namespace {

constexpr Real DOUBTED = 32768; /* of a try that gave no pose */

/* The region within the image, and the circles about the region asked for in its coordinates. */
bool place(cv::Rect &clipped, drogue_mask &mask, const cv::Mat &image, const std::array<int64_t, 4> &region)
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

int64_t clipped_width(const std::array<int64_t, 4> &region, const cv::Mat &image)
{
    return std::min<int64_t>(region[0] + region[2], image.cols) - std::max<int64_t>(region[0], 0);
}

int rounded(Real v) { return static_cast<int>(std::floor(v + 0.5L)); }

/* A frame's outline in the making. */
struct Frame {
    cv::Mat view;
    drogue_mask mask;
    std::unique_ptr<FrontEnd> front;
    std::array<int64_t, 4> asked; /* the region, before it is clipped */
    drogue_outline decided;       /* the library's */
    Follow follow;
    cv::Rect region; /* of the last outline looked for, and that */
    Outline outline;
    bool filled = false; /* thresholds of the noise filled a table */
    drogue_second_look second_look = DROGUE_SECOND_NONE;
    Real ring = 0; /* semi-axis of the outline that a disc allows which was sought */
};

/* Are edges everywhere, on a quarter of the ring's 7/16 of a square region? */
bool is_crowded(const Frame &f)
{
    return 64 * static_cast<int64_t>(f.front->list.edge_count) > 7 * static_cast<int64_t>(f.view.total());
}

/* Run the front end on a region. */
drogue_status see_edges(Result &out, Frame &f, const Task &task, const std::array<int64_t, 4> &region)
{
    if (!place(out.region, f.mask, task.image, region)) {
        return DROGUE_E_REGION;
    }
    drogue_capacity capacity = task.capacity;
    f.asked = region;
    if (static_cast<uint32_t>(out.region.width) > capacity.width_px) {
        return DROGUE_E_WORKSPACE;
    }
    capacity.width_px = static_cast<uint32_t>(out.region.width);
    f.view = task.image(out.region).clone();
    f.front = run_front_end(f.view, f.mask, task.config, capacity);
    return f.front->status;
}

drogue_status outline_in(Result &out, Frame &f, const Task &task, const std::array<int64_t, 4> &region, bool follow)
{
    const drogue_status placed = see_edges(out, f, task, region);
    f.follow.library = nullptr;
    if (placed == DROGUE_E_REGION || placed == DROGUE_E_WORKSPACE) {
        return placed;
    }
    if (follow && f.front->status == DROGUE_OK) {
        (void)drogue_outline_find(&f.decided, &f.front->workspace, &f.front->list, &f.mask, &task.config);
        f.follow.library = &f.decided;
    }
    return find_outline(out.outline, *f.front, f.mask, task.config, f.follow);
}

bool ring_holds(const Ellipse &e, const drogue_mask &mask)
{
    const Real off = std::hypot(e.xc - mask.centre2_x / 2.0L, e.yc - mask.centre2_y / 2.0L);
    return 2 * (e.a + off + 1) <= mask.longest_px && 3 * (e.b - off - 1) >= mask.longest_px;
}

/* Region whose ring suits an outline; a side or corner halfway between pixels to what the library resolves is its. */
std::array<int64_t, 4> region_about(const Ellipse &e, cv::Point origin, const drogue_result *library)
{
    const auto pick = [](Real v, int other) {
        return std::fabs(std::fabs(v - other) - 0.5L) < Follow::score ? other : rounded(v);
    };
    const Real exact = std::max(2 * e.a + 4, e.a + 1.5L * e.b);
    const int side = library != nullptr ? pick(exact, library->region.width_px) : rounded(exact);
    const Real x = e.xc - (side - 1) / 2.0L, y = e.yc - (side - 1) / 2.0L;
    return {origin.x + (library != nullptr ? pick(x, library->region.x_px - origin.x) : rounded(x)),
            origin.y + (library != nullptr ? pick(y, library->region.y_px - origin.y) : rounded(y)), side, side};
}

drogue_status outline_twice(Result &out, Frame &f, const Task &task, const drogue_result *library)
{
    const drogue_status status = outline_in(out, f, task, task.region, library != nullptr);
    const Real cover = out.outline.cover;
    if ((status != DROGUE_OK && status != DROGUE_E_NO_ELLIPSE) ||
        cover < std::floor(task.config.min_cover_q16 / 2.0L + 0.5L) / 65536 ||
        cover >= real(task.config.recentre_cover_q16) || ring_holds(out.outline.ellipse, f.mask)) {
        return status;
    }
    const std::array<int64_t, 4> better = region_about(out.outline.ellipse, out.region.tl(), library);
    if (clipped_width(better, task.image) > static_cast<int64_t>(task.capacity.width_px)) {
        out.second_look = DROGUE_SECOND_TOO_WIDE;
        return status;
    }
    const Ellipse was = out.outline.ellipse;
    const cv::Point was_at = out.region.tl();
    out.outline = Outline();
    out.second_look = DROGUE_SECOND_NO_MORE;
    const drogue_status again = outline_in(out, f, task, better, library != nullptr);
    if (again == DROGUE_OK && out.outline.cover >= cover) {
        const Ellipse &e = out.outline.ellipse; /* about the same? */
        const Real dx = e.xc - was.xc + out.region.x - was_at.x, dy = e.yc - was.yc + out.region.y - was_at.y;
        if (std::fabs(e.a - was.a) <= was.a / 3 && std::hypot(dx, dy) <= was.a / 3) {
            out.second_look = DROGUE_SECOND_BETTER;
            return DROGUE_OK;
        }
    } else if (again == DROGUE_E_LABELS_FULL || again == DROGUE_E_EDGES_FULL || again == DROGUE_E_ARCS_FULL) {
        out.second_look = DROGUE_SECOND_FULL;
    } else if (again == DROGUE_E_REGION) {
        out.second_look = DROGUE_SECOND_REGION;
    }
    out.outline = Outline(); /* what was found first stands */
    return outline_in(out, f, task, task.region, library != nullptr);
}

bool distorts(const reference::Camera &c) { return c.k1 != 0 || c.k2 != 0 || c.p1 != 0 || c.p2 != 0 || c.k3 != 0; }

drogue_ellipse rounded_ellipse(const Ellipse &e)
{
    return {reference::q16(e.xc), reference::q16(e.yc), reference::q16(e.a), reference::q16(e.b),
            reference::q16(e.angle)};
}

/* Where the poses expect the inner disc. The library's own places where there is a library to follow: rays begin there. */
drogue_inner_expected expect(const Result &out, const Frame &f, const std::array<Pose, 2> &pair, const Task &task,
                             const drogue_ellipse &rim)
{
    drogue_inner_expected expected = {};
    if (f.follow.library != nullptr) {
        const auto camera = task.library_camera;
        const drogue_model model = task.library_model;
        const drogue_setup setup = {&camera, &model, &task.config};
        drogue_ellipse ideal = rim;
        drogue_pose poses[2];
        ideal.xc_px_q16 += out.region.x * 65536;
        ideal.yc_px_q16 += out.region.y * 65536;
        if ((!drogue_camera_distorts(&camera) ||
             drogue_outline_undistorted(&ideal, &f.decided, &f.front->workspace, &f.front->list, &setup, out.region.x,
                                        out.region.y) == DROGUE_OK) &&
            drogue_pose_from_ellipse(poses, &ideal, &camera, model.rim_radius_m_q16) == DROGUE_OK) {
            drogue_inner_expect(&expected, poses, &setup, out.region.x, out.region.y);
        }
        return expected;
    }
    for (const Pose &pose : pair) {
        Ellipse e;
        if (reference::disc_image(e, pose, task.camera, task.model) == reference::Solved::ok && e.b >= 1 &&
            reference::distort(task.camera, e)) {
            expected.disc[expected.count++] =
                rounded_ellipse({e.xc - out.region.x, e.yc - out.region.y, e.a, e.b, e.angle, true});
        }
    }
    return expected;
}

/* Look for the inner disc where a pose expects it; 'expected' is the one that it was found by. */
void find_inner(Result &out, Ellipse &expected, const Frame &f, const std::array<Pose, 2> &pair, const Task &task)
{
    const drogue_ellipse rim = f.follow.library != nullptr ? f.decided.ellipse : rounded_ellipse(out.outline.ellipse);
    const drogue_inner_expected discs = expect(out, f, pair, task, rim);
    const drogue_image view = {f.view.data, f.view.cols, f.view.rows, static_cast<int32_t>(f.view.step)};
    std::array<drogue_ray, DROGUE_RAYS> rays;
    drogue_inner_edge edge;
    const bool known = f.follow.library != nullptr &&
                       drogue_inner_edge_find(&edge, rays.data(), &view, &discs, &rim, &task.config) == DROGUE_OK;
    out.part = inner_edge(view, discs, rim, task.config, known ? &edge : nullptr);
    out.has_inner = out.part.found;
    if (out.has_inner) {
        const drogue_ellipse &e = discs.disc[out.part.which];
        expected = {real(e.xc_px_q16), real(e.yc_px_q16), real(e.a_px_q16), real(e.b_px_q16), 0, true};
        out.area = std::acos(Real(-1)) * (expected.a + out.part.grown) * (expected.b + out.part.grown);
        const drogue_q16 grown = known ? edge.grown_px_q16 : reference::q16(out.part.grown);
        out.larger_q16 = grown > 0 ? drogue_q16_div(grown, e.a_px_q16) : 0;
    }
}

/* What a disc's size puts in doubt: its share where it is too large by 1/32 and more, half of it where it is too small by more
 * than half a pixel. */
Real size_doubt(Real grown, Real a)
{
    return std::max({std::min(grown / a, 2 * (grown / a - 1 / 64.0L)), (-grown - 0.5L) / a / 2, Real(0)});
}

/* By what share size and place say that the outline's pose is too far: three quarters of what the disc is too large by beyond
 * 1/256, or of half of what it lies farther beside its place than that, whichever is less. */
Real too_far(const Disc &part, const Ellipse &expected)
{
    const Real away = std::hypot(part.x - expected.xc, part.y - expected.yc);
    const Real by = std::min(part.grown - expected.a / 256, (away - part.grown) / 2);
    const bool tells = 8 * part.rays >= 7 * DROGUE_RAYS && part.grown <= expected.a / 8;
    return tells ? std::max<Real>(0, 0.75L * by / expected.a) : 0;
}

Real inner_std(const Result &out, const Ellipse &expected, const drogue_config &config)
{
    const Real doubt = size_doubt(out.part.grown, expected.a);
    return std::hypot(std::hypot(real(config.inner_std_share_q16) * expected.a, real(config.inner_std_px_q16)),
                      std::hypot(out.part.std, doubt > 0.125L ? doubt * expected.a : 0));
}

bool same_solution(const reference::Joint &p, const reference::Joint &q)
{
    const auto yaw = static_cast<double>(p.pose.yaw - q.pose.yaw),
               pitch = static_cast<double>(p.pose.pitch - q.pose.pitch);
    return yaw * yaw <= p.covariance(3, 3) && pitch * pitch <= p.covariance(4, 4);
}

Real apart(const Pose &p, const drogue_pose &q)
{
    Real sum = 0;
    for (size_t k = 0; k < 3; k++) { /* the position may have been brought nearer */
        sum += std::fabs(p.axis[k] - real(q.axis_q16[k]));
    }
    return sum;
}

/* The pose that outline and inner part agree with best; where they do not, it is worth something when the other one is
 * worse by so much more. */
struct Together {
    reference::Joint joint;
    size_t index;
    bool resolved, agree;
};

/* Is all of an outline in the image? */
bool lies_within(const Ellipse &e, const cv::Mat &image)
{
    return e.xc >= e.a && e.yc >= e.a && e.xc + e.a <= image.cols - 1 && e.yc + e.a <= image.rows - 1;
}

Together solve_together(const std::array<Pose, 2> &poses, size_t nearer, const Features &f,
                        const reference::Covariance &outline, const Task &task, const drogue_result *library)
{
    constexpr int STEPS = 5, OTHER_STEPS = 1;
    const auto solve = [&](size_t which, int steps) {
        return reference::solve_joint(poses[which], f.ideal, outline, f.inner, task.camera, task.model, steps);
    };
    Together t = {solve(nearer, STEPS), nearer, false, false};
    reference::Joint other = solve(1 - nearer, OTHER_STEPS);
    const bool near_ok = t.joint.solved == reference::Solved::ok, far_ok = other.solved == reference::Solved::ok;
    bool turn = far_ok && (!near_ok || other.chi2 < t.joint.chi2);
    if (library != nullptr && near_ok && far_ok && std::fabs(other.chi2 - t.joint.chi2) < 0.01 * (1 + t.joint.chi2)) {
        turn = apart(poses[nearer], library->alternative) < apart(poses[1 - nearer], library->alternative);
    }
    if (turn) {
        std::swap(t.joint, other);
        t.index = 1 - nearer;
        t.joint = solve(t.index, STEPS);
    }
    if (t.joint.solved != reference::Solved::ok) {
        return t;
    }
    t.agree = t.joint.chi2 <= static_cast<double>(real(task.config.max_chi2_q16));
    const double gap = static_cast<double>(real(task.config.min_chi2_gap_q16)) * (t.agree ? 1 : t.joint.chi2);
    t.resolved = !far_ok || !near_ok ? t.agree : same_solution(t.joint, other) || other.chi2 - t.joint.chi2 >= gap;
    return t;
}

} // namespace

void finish(Result &out, const Task &task, const Features &f, const drogue_result *library)
{
    std::array<Pose, 2> pair;
    reference::Choice choice = {0, {0, 0}, 1};
    if (!reference::poses(f.ideal, task.camera, task.model.rim_radius, pair)) {
        out.status = DROGUE_E_DOMAIN;
        return;
    }
    const bool placed = f.placed && reference::choose(pair, f.inner.at, task.model.inner_depth, task.camera, choice);
    out.has_inner = f.trusted && placed; /* else something dark: it orders the poses, but is not to be believed */
    out.ambiguity = out.has_inner ? choice.ambiguity : 1;
    decide(out, task, f, pair, placed ? static_cast<size_t>(choice.index) : 0, library);
}

std::array<std::array<Real, 3>, 3> doubt_covariance(const std::array<Real, 3> &position, Real doubt, Real rim_radius)
{
    std::array<std::array<Real, 3>, 3> added;
    for (size_t i = 0; i < 3; i++) {
        for (size_t j = 0; j < 3; j++) {
            added[i][j] = position[i] * position[j] * doubt * doubt / 2;
        }
        added[i][i] += i < 2 ? 2 * std::pow(doubt * doubt * rim_radius, 2) : 0;
    }
    return added;
}

namespace {

/* A doubt and that of an outline outside which another edge shows in so many parts, below 1 in Q16. */
Real with_outside(Real doubt, int outside)
{
    const Real both = std::hypot(doubt, outside * outside * real(DROGUE_Q16(1, 640)));
    return std::min<Real>(outside > 0 ? real(reference::q16(both)) : both, 65535 / 65536.0L);
}

} // namespace

void decide(Result &out, const Task &task, const Features &f, const std::array<Pose, 2> &pair, size_t nearer,
            const drogue_result *library)
{
    reference::Covariance outline;
    const drogue_config &config = task.config;
    if (!reference::outline_covariance(outline, f.ideal, f.support, real(config.outline_shading_q16),
                                       real(config.optics_blur_std_px2_q16))) {
        out.status = DROGUE_E_DOMAIN;
        return;
    }
    Together t = {{}, nearer, false, false};
    if (out.has_inner) {
        t = solve_together(pair, nearer, f, outline, task, library);
    }
    const bool agree = t.agree, together = agree || t.resolved;
    if (!together) {
        if (task.model.inner_radius > 0 && !out.has_inner) { /* it may be another edge than the rim, or partly */
            outline += 0x1p-13 * reference::Covariance::eye();
        }
        t = {reference::solve_joint(pair[nearer], f.ideal, outline, {{0, 0}, 0}, task.camera, task.model, 0), nearer,
             false, false};
    }
    out.status = t.joint.solved == reference::Solved::ok ? DROGUE_OK : DROGUE_E_DOMAIN;
    if (out.status != DROGUE_OK) {
        return;
    }
    out.resolved = t.resolved;
    out.pose = t.joint.pose;
    out.alternative = pair[1 - t.index];
    out.covariance = t.joint.covariance;
    if (out.has_inner) {
        out.covariance *= std::max(1.0, together ? t.joint.chi2 : static_cast<double>(real(config.max_chi2_q16)));
    }
    const Real smear = std::hypot(f.support.smear[0], f.support.smear[1]); /* it moves the disc's edge, too */
    const Real chi2 = static_cast<Real>(t.joint.chi2);
    const auto unit = [](Real v) { return std::min<Real>(1, std::max<Real>(0, v)); };
    const Real nearer_by = t.resolved ? f.too_far * unit(1.25L - smear) * unit((chi2 - 1) / 2) : 0;
    for (size_t k = 0; k < 3; k++) {
        out.pose.position[k] *= 1 - nearer_by;
        out.alternative.position[k] *= 1 - nearer_by;
    }
    out.doubt = std::max(nearer_by, !out.has_inner ? 0 : agree ? f.doubt : std::max<Real>(f.doubt, 1 / 64.0L));
    out.doubt = with_outside(out.doubt, f.outside);
    const auto doubted = doubt_covariance(out.pose.position, out.doubt, task.model.rim_radius);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            out.covariance(i, j) += static_cast<double>(doubted[static_cast<size_t>(i)][static_cast<size_t>(j)]);
        }
    }
    if (!t.resolved) { /* the truth is as likely the other pose */
        const Pose &p = out.pose, &q = out.alternative;
        const double apart[5] = {static_cast<double>(q.position[0] - p.position[0]),
                                 static_cast<double>(q.position[1] - p.position[1]),
                                 static_cast<double>(q.position[2] - p.position[2]), static_cast<double>(q.yaw - p.yaw),
                                 static_cast<double>(q.pitch - p.pitch)};
        for (int i = 0; i < 5; i++) {
            for (int j = 0; j < 5; j++) {
                out.covariance(i, j) += apart[i] * apart[j] / 2;
            }
        }
    }
    for (int k = 0; k < 3; k++) {
        out.position_std[static_cast<size_t>(k)] = std::sqrt(static_cast<Real>(out.covariance(k, k)));
    }
    const Real c = std::cos(out.pose.pitch);
    out.axis_std = std::sqrt(out.covariance(3, 3) * c * c + out.covariance(4, 4));
}

namespace {

/* Bins as from another axis, to a whole bin; halfway between two, to that of the library. */
void turn(reference::Support &s, Real from, Real to, const drogue_ellipse &library)
{
    const Real per_radian = reference::SUPPORT_BINS / 2 / std::acos(Real(-1)), bins = (to - from) * per_radian;
    const bool halfway = std::fabs(std::remainder(bins - 0.5L, 1)) < 0.01L && library.a_px_q16 > 0;
    const auto whole =
        static_cast<int>(std::lround(halfway ? (real(library.angle_rad_q16) - from) * per_radian : bins));
    const int n = (whole + reference::SUPPORT_BINS) % reference::SUPPORT_BINS;
    if (n == 0) {
        return;
    }
    std::rotate(s.count.begin(), s.count.begin() + n, s.count.end());
    std::rotate(s.sum.begin(), s.sum.begin() + n, s.sum.end());
    s.bright = s.bright >> n | s.bright << (reference::SUPPORT_BINS - n);
}

/* Where angles begin anew it is the library's way that is taken. */
void take_way(Ellipse &e, const drogue_ellipse &library)
{
    if (std::fabs(std::fabs(e.angle) - std::acos(Real(0))) < 0x1p-12L && library.a_px_q16 > 0) {
        const Real as = real(library.angle_rad_q16);
        e.angle = as + std::remainder(e.angle - as, std::acos(Real(-1)));
    }
}

/* From the outline to the pose; the doubt in it. */
Real judge(Result &out, Features &from, Frame &f, const Task &task, const drogue_result *library)
{
    const reference::Camera &camera = task.camera;
    const drogue_image view = {f.view.data, f.view.cols, f.view.rows, static_cast<int32_t>(f.view.step)};
    std::array<drogue_ray, DROGUE_RAYS> rays;
    Real doubt = 0;
    pull(out.outline, view, f.follow.library != nullptr ? f.decided.fitted : rounded_ellipse(out.outline.fitted),
         task.config);
    if (f.follow.library != nullptr) {
        drogue_outline_pull(&f.decided, rays.data(), &view, &task.config);
    }
    out.found = true;
    out.seen = out.outline.ellipse;
    out.seen.xc += out.region.x;
    out.seen.yc += out.region.y;
    out.ideal =
        distorts(camera) ? ideal_of(out.outline, *f.front, task.config, f.follow, camera, out.region.tl()) : out.seen;
    if (library != nullptr) {
        take_way(out.seen, library->ellipse);
        take_way(out.ideal, library->ideal);
    }
    std::array<Pose, 2> pair;
    if (!out.ideal.ok || !reference::poses(out.ideal, camera, task.model.rim_radius, pair)) {
        out.status = out.ideal.ok ? DROGUE_E_DOMAIN : DROGUE_E_NO_ELLIPSE;
        return DOUBTED;
    }
    from = {out.ideal, out.outline.support, {{0, 0}, 0}, false, false, 0, 0, out.outline.outside};
    turn(from.support, f.follow.library != nullptr ? real(f.decided.support.axis_rad_q16) : out.outline.fitted.angle,
         out.ideal.angle, library != nullptr ? library->ideal : drogue_ellipse{});
    if (task.model.inner_radius > 0) {
        Ellipse expected = {0, 0, 0, 0, 0, false};
        find_inner(out, expected, f, pair, task);
        if (out.has_inner) {
            from.trusted = in_its_place(out.part, expected, out.outline.ellipse, task.config);
            out.inner = {out.part.x + out.region.x, out.part.y + out.region.y};
            from.inner = {out.inner, inner_std(out, expected, task.config)};
            from.placed = out.area >= task.config.min_inner_area_px && reference::undistort(camera, from.inner.at);
            from.trusted = from.trusted && from.placed;
            out.too_large = from.trusted && out.part.grown > room_of(expected, task.config);
            from.trusted = from.trusted && !out.too_large;
        }
        out.larger_q16 = from.trusted || out.too_large ? out.larger_q16 : 0;
        from.doubt = from.trusted ? size_doubt(out.part.grown, expected.a) : 0;
        from.too_far = from.trusted ? too_far(out.part, expected) : 0;
        doubt = from.trusted ? from.doubt : 1;
    }
    finish(out, task, from, library);
    return out.status == DROGUE_OK && out.has_inner && out.doubt > with_outside(doubt, from.outside)
               ? doubt + 1 / 200.0L
               : doubt;
}

bool is_smeared(const Outline &o) { return std::hypot(o.support.smear[0], o.support.smear[1]) > 1.25L; }

/* The edge points about an ellipse; false: they cover less than 'least'. */
bool settle_there(Result &out, Frame &f, const drogue_ellipse &about, drogue_q16 band, drogue_q16 least,
                  const Task &task)
{
    if (f.follow.library != nullptr) {
        (void)drogue_outline_settle(&f.decided, &about, band, least, &f.front->workspace, &f.front->list, &f.mask,
                                    &task.config);
    }
    return settle(out.outline, about, band, least, *f.front, f.mask, task.config, f.follow);
}

const drogue_q16 OUTER_BAND = DROGUE_Q16(1, 1);

/* A larger outline along rays about the best one: of the size that the disc asks for, or the rim's outer edge; of that the
 * edge points by 'config', as the best one's, where they show it. */
bool beyond(Result &out, Frame &f, const Result &best, const drogue_outline &decided,
            const std::array<int64_t, 4> &region, const Task &task, const drogue_config *config)
{
    const bool follow = f.follow.library != nullptr;
    const drogue_q16 least = task.config.min_cover_q16;
    Ellipse was = best.seen;
    out.tried = DROGUE_TRIED_RAYS;
    out.second_look = best.second_look;
    out.outline.arcs.fill(DROGUE_NO_ARC);
    place(out.region, f.mask, task.image, region);
    f.view = task.image(out.region).clone();
    was.xc -= out.region.x;
    was.yc -= out.region.y;
    const drogue_image view = {f.view.data, f.view.cols, f.view.rows, static_cast<int32_t>(f.view.step)};
    const drogue_ellipse known = follow ? decided.ellipse : rounded_ellipse(was);
    drogue_ellipse about = known;
    drogue_q16 by = drogue_q16_mul(known.a_px_q16, best.larger_q16);
    Real grown_size = 0;
    std::array<Real, 5> grown = {};
    std::array<int32_t, 5> grown_q24 = {};
    bool found = false;
    if (config == nullptr) {
        about.a_px_q16 += by;
        about.b_px_q16 += by;
    } else {
        Ellipse outer = was;
        std::vector<drogue_ray> rays(DROGUE_RAYS);
        out.status = DROGUE_E_NO_ELLIPSE;
        if (!outer_edge(outer, grown, view, known)) {
            return false;
        }
        about = rounded_ellipse(outer);
        if (follow) {
            about = known;
            (void)drogue_outline_outer(&about, grown_q24.data(), rays.data(), &view);
            std::transform(grown_q24.begin(), grown_q24.end(), grown.begin(), [](int32_t q) { return q * 0x1p-24L; });
        }
        by = 0;
        grown_size = (was.a + was.b + outer.a + outer.b) / 2;
        f.front = run_front_end(f.view, f.mask, *config, task.capacity);
        found = settle_there(out, f, about, config->refit_band_px_q16, least, task) && out.outline.cover >= 0.75L;
        if (found) {
            pull(out.outline, view, follow ? f.decided.fitted : rounded_ellipse(out.outline.fitted), task.config);
            found = out.outline.ellipse.a + out.outline.ellipse.b >= grown_size;
        }
        out.tried = found ? DROGUE_TRIED_LARGER : DROGUE_TRIED_RAYS;
    }
    if (!found && task.capacity.edges < DROGUE_INNER_BEYOND_POINTS) {
        out.status = DROGUE_E_EDGES_FULL;
        return false;
    }
    if (!found) {
        look_beyond(*f.front, f.view, about, by);
        found = f.front->list.edge_count > 0 &&
                settle_there(out, f, about, config == nullptr ? 0 : OUTER_BAND, least, task) &&
                (config == nullptr ||
                 (out.outline.cover >= 0.75L && out.outline.ellipse.a + out.outline.ellipse.b >= grown_size));
        if (found && config != nullptr) {
            out.outline.outer = true;
            out.outline.support.pull = turned(grown, out.outline.fitted.angle - was.angle);
            f.decided.outer = 1;
            drogue_turn_pull(f.decided.support.pull_q24, grown_q24.data(),
                             f.decided.fitted.angle_rad_q16 - known.angle_rad_q16);
        }
    }
    out.status = found ? DROGUE_OK : DROGUE_E_NO_ELLIPSE;
    out.outline.quality = best.outline.quality;
    out.outline.members = best.outline.members;
    return found;
}

/* An outline about the inner disc where no outline says where that is. */
bool about_disc(Result &out, Frame &f, const Task &task, bool follow)
{
    Seeker seeker(task, follow);
    std::array<int64_t, 4> region = task.region;
    out.tried = DROGUE_TRIED_DISC;
    out.status = DROGUE_E_NO_INNER_PART;
    if (!place(out.region, f.mask, task.image, region)) {
        return false;
    }
    const bool seen = seeker.look(task.image(out.region).clone(), f.mask, out.region.tl());
    const Ellipse first = seen ? seeker.head_on(out.region.tl()) : Ellipse{0, 0, 0, 0, 0, false};
    out.contradicted = seeker.contradicted();
    if (!seen) {
        return false;
    }
    if (first.ok && !of_size(first, f.mask)) {
        region = region_about(first, out.region.tl(), nullptr);
    }
    out.status = DROGUE_E_NO_ELLIPSE;
    if (clipped_width(region, task.image) > static_cast<int64_t>(task.capacity.width_px)) {
        out.second_look = DROGUE_SECOND_TOO_WIDE;
        return false;
    }
    out.status = see_edges(out, f, task, region);
    if (out.status != DROGUE_OK) {
        return false;
    }
    out.status = DROGUE_E_NO_ELLIPSE;
    const drogue_ellipse ring = rounded_ellipse(seeker.best(*f.front, f.mask, out.region.tl()));
    out.contradicted = seeker.contradicted();
    f.follow.library = follow ? &f.decided : nullptr;
    f.ring = real(ring.a_px_q16);
    const Ellipse was = real_of(ring);
    const bool found = settle_there(out, f, ring, 0, (5 * task.config.min_cover_q16 + 4) / 8, task);
    const Ellipse &e = out.outline.ellipse;
    return found && std::fabs(e.a - was.a) <= was.a / 10 && std::hypot(e.xc - was.xc, e.yc - was.yc) <= was.a / 8;
}

bool is_full(drogue_status status)
{
    return status == DROGUE_E_LABELS_FULL || status == DROGUE_E_EDGES_FULL || status == DROGUE_E_ARCS_FULL;
}

void find(Result &out, Frame &f, const Task &task, const drogue_result *library)
{
    out.status = outline_twice(out, f, task, library);
    f.region = out.region;
    f.outline = out.outline;
    f.second_look = out.second_look;
}

/* With the thresholds of the region's own noise; raised while they fill a table. */
bool try_own(Result &out, Frame &f, Task &task, const Task &asked, bool full, const drogue_result *library)
{
    const drogue_config &c = asked.config;
    const auto raised = [](int32_t high) { return high > 1530 ? INT32_MAX : high + high / 2 + 1; };
    uint32_t histogram[256];
    const drogue_image view = {f.view.data, f.view.cols, f.view.rows, static_cast<int32_t>(f.view.step)};
    int32_t high = std::max(drogue_noise_threshold(histogram, &view), c.canny_least);
    high = full && high <= c.canny_high ? raised(c.canny_high) : high;
    bool tried = false;
    for (int k = 0; k < 3 && c.canny_least < c.canny_high && (full ? high <= 1530 : high < c.canny_high); k++) {
        task.config.canny_low = static_cast<int32_t>(static_cast<int64_t>(high) * c.canny_low / c.canny_high);
        task.config.canny_high = high;
        find(out, f, task, library);
        tried = true;
        if (!is_full(out.status)) {
            break;
        }
        f.filled = true;
        high = raised(high);
    }
    return tried;
}

} // namespace

/* The tries of drogue_measure(), in its order. */
Result measure(const Task &asked, const drogue_result *library, Features *features)
{
    constexpr Real SURE = 1 / 256.0L;
    Task task = asked;
    Frame f;
    Result best;
    Real least = DOUBTED;
    best.outline.arcs.fill(DROGUE_NO_ARC);
    const reference::Camera &c = task.camera;
    const reference::Model &m = task.model;
    const bool distorts_too_much =
        std::max({std::fabs(c.k1), std::fabs(c.k2), std::fabs(c.k3), std::fabs(c.p1), std::fabs(c.p2)}) > 256;
    if (!(c.fx > 0) || !(c.fy > 0) || distorts_too_much || !(m.rim_radius > 0) || m.inner_radius < 0 ||
        m.inner_radius > m.rim_radius || m.inner_depth < 0) {
        best.status = DROGUE_E_ARGUMENT;
        return best;
    }
    drogue_outline decided = {}; /* the library's, of the best */
    std::array<int64_t, 4> asked_for = {};
    drogue_config kept_config = task.config; /* by whose thresholds that was found */
    drogue_status status = DROGUE_OK;
    drogue_second_look room = DROGUE_SECOND_NONE; /* of any try that had too little of it */
    const auto keep = [&](const Result &out, const Features &from, Real doubt) {
        least = doubt;
        best = out;
        decided = f.decided;
        asked_for = f.asked;
        kept_config = task.config;
        if (features != nullptr) {
            *features = from;
        }
    };
    const auto note_room = [&](const Result &out) {
        if (room == DROGUE_SECOND_NONE) {
            room = is_full(out.status) || f.filled             ? DROGUE_SECOND_FULL
                   : out.second_look >= DROGUE_SECOND_TOO_WIDE ? out.second_look
                                                               : DROGUE_SECOND_NONE;
        }
    };
    bool crowded = false;
    for (int what = 0; what < 4 && least > SURE; what++) {
        const bool larger = what % 2 == 1;
        Result out;
        Features from = {};
        Real doubt = DOUBTED;
        if (larger && status != DROGUE_OK) {
            continue;
        }
        out.outline.arcs.fill(DROGUE_NO_ARC);
        if (what == 2) {
            if (!try_own(out, f, task, asked, is_full(best.status), library)) {
                break;
            }
        } else if (larger) {
            out.region = f.region;
            out.outline = f.outline;
            out.second_look = f.second_look;
            if (f.follow.library != nullptr) {
                (void)drogue_outline_enlarge(&f.decided, &f.front->workspace, &f.front->list, &f.mask, &task.config);
            }
            out.status =
                enlarge(out.outline, *f.front, f.mask, task.config, f.follow) ? DROGUE_OK : DROGUE_E_NO_ELLIPSE;
        } else {
            find(out, f, task, library);
        }
        out.tried = what;
        if (out.status == DROGUE_OK) {
            doubt = judge(out, from, f, task, library);
        }
        status = out.status;
        note_room(out);
        if (what == 0) {
            best = out;
            if (status != DROGUE_OK && status != DROGUE_E_NO_ELLIPSE && status != DROGUE_E_NO_EDGES &&
                status != DROGUE_E_NO_ARCS && !is_full(status)) {
                return best;
            }
            crowded = is_crowded(f);
        }
        if (doubt < least - 1 / 256.0L && (status == DROGUE_OK || best.status != DROGUE_OK)) {
            keep(out, from, doubt);
        }
    }
    bool contradicted = false;
    if (task.model.inner_radius > 0 && least > 0.04L && !(least >= 1 && crowded)) {
        Result out;
        Features from = {};
        out.outline.arcs.fill(DROGUE_NO_ARC);
        const Real doubt = about_disc(out, f, task, library != nullptr) ? judge(out, from, f, task, library) : DOUBTED;
        note_room(out);
        contradicted = out.contradicted;
        const bool thin = out.outline.cover < real(task.config.min_cover_q16);
        const Real most = best.status == DROGUE_OK && least == 1 && !thin ? 0.04L : 1 / 64.0L;
        if (out.status == DROGUE_OK && out.has_inner && out.doubt < most) {
            keep(out, from, doubt);
        }
    }
    const auto is_another = [&] {
        return least == 1 &&
               (best.larger_q16 > 0 || (best.outline.cover < 0.7L && lies_within(best.seen, task.image)) ||
                f.ring - best.seen.a > f.ring / 8);
    };
    for (const int wider : {-1, 1}) {
        const bool nothing = best.status != DROGUE_OK || is_another();
        if ((least >= 1 && crowded) || (!nothing && (wider < 0 || least <= 0.04L))) {
            continue;
        }
        const int64_t dx = wider * (asked.region[2] / 8), dy = wider * (asked.region[3] / 8);
        Result out;
        Features from = {};
        out.outline.arcs.fill(DROGUE_NO_ARC);
        out.tried = DROGUE_TRIED_FOUND;
        task.config = asked.config;
        task.region = {asked.region[0] - dx, asked.region[1] - dy, asked.region[2] + 2 * dx, asked.region[3] + 2 * dy};
        if (clipped_width(task.region, task.image) > static_cast<int64_t>(task.capacity.width_px)) {
            out.second_look = DROGUE_SECOND_TOO_WIDE;
            out.status = DROGUE_E_REGION;
        } else {
            find(out, f, task, library);
        }
        const Real doubt = out.status == DROGUE_OK ? judge(out, from, f, task, library) : DOUBTED;
        note_room(out);
        if (out.status == DROGUE_OK && doubt < 0.1L && doubt < least - 1 / 256.0L) {
            keep(out, from, doubt);
        }
    }
    for (const bool outer : {false, true}) {
        const bool asked_beyond = least > SURE && best.larger_q16 > drogue_q16{DROGUE_Q16(2, 100)};
        Result out;
        Features from = {};
        const bool asked_outer = best.outline.outside > 0 && (least != 1 || best.outline.cover >= 0.7L);
        if (best.status != DROGUE_OK || best.tried == DROGUE_TRIED_RAYS || !(outer ? asked_outer : asked_beyond)) {
            continue;
        }
        const bool found = beyond(out, f, best, decided, asked_for, task, outer ? &kept_config : nullptr);
        const Real doubt = found ? judge(out, from, f, task, library) : DOUBTED;
        if (room == DROGUE_SECOND_NONE && is_full(out.status)) {
            room = DROGUE_SECOND_FULL;
        }
        const bool outer_stands = (out.has_inner || !best.has_inner) &&
                                  !(is_smeared(best.outline) && is_smeared(out.outline)) &&
                                  (least > 0 || doubt <= 0.0055L);
        if (out.status == DROGUE_OK && (outer ? outer_stands : doubt < least - 1 / 256.0L)) {
            keep(out, from, doubt);
        }
    }
    const bool another = is_another();
    const bool whole = best.status == DROGUE_OK && !another && best.second_look <= DROGUE_SECOND_BETTER;
    if (room != DROGUE_SECOND_NONE) {
        best.second_look = whole ? DROGUE_SECOND_ROOM : room;
    }
    best.contradicted = contradicted;
    if (best.seen.a <= 0) { /* the edges looked for last */
        drogue_mask mask;
        place(best.region, mask, task.image, f.asked);
    }
    if (best.status == DROGUE_OK && another) {
        Result refused;
        refused.contradicted = contradicted;
        refused.second_look = best.second_look;
        refused.status = DROGUE_E_NO_ELLIPSE;
        refused.region = best.region;
        refused.tried = best.tried;
        refused.outline.arcs.fill(DROGUE_NO_ARC);
        return refused;
    }
    return best;
}

} // namespace mirror
