/* SPDX-License-Identifier: Apache-2.0 */
/* The inner disc without an outline, and the outlines about it, in floating point. */
#include "seek.hpp"

#include <algorithm>
#include <cmath>

namespace mirror {

using reference::Ellipse;
using reference::Point;
using reference::Pose;
using reference::q16;

namespace {

/* An edge nearer to a limit than this, px, is within it or not as the library has it. */
constexpr Real GATE = 16 * LSB;
/* By how much numbers that come from the same ones may be off. A disc, px: ten rounds that each round its place and size,
 * twice, and between them rays that begin some LSB elsewhere. */
constexpr Real DISC = 32 * LSB;
/* Tangents: the point undistorted to some LSB of a pixel, the quotient to half an LSB; the radius of four of them, cut. */
constexpr Real TANGENT = 2 * LSB;

drogue_ellipse circle(Real x, Real y, Real radius) { return {q16(x), q16(y), q16(radius), q16(radius), 0}; }

/* Circles by the rays' edges; limits within which edges agree are moved by 'margin'. */
class Circles {
public:
    Circles(const cv::Mat &view, int least, Real margin)
        : view_{view.data, view.cols, view.rows, static_cast<int32_t>(view.step)}, least_(least), margin_(margin)
    {}

    /* Rays begin at an ellipse rounded to an LSB. */
    const Rays &cast(const Ellipse &at, Real reach)
    {
        const drogue_ellipse e = circle(at.xc, at.yc, at.a);
        drogue_rays_cast(rays_.data(), &view_, &e, q16(reach), 4, 2, least_, DROGUE_RAY_RISES);
        return rays_;
    }

    /* Sum of the slopes that agree on a circle; 0: too few rays, or it is too small. */
    Real settle(Ellipse &e, Real larger, Real gate) const
    {
        Offset v = {0, 0, larger};
        Sums s;
        if (!mirror::settle(s, v, rays_, gate + margin_, std::max<Real>(1.5L, e.a / 16) + margin_, true) ||
            4 * s.rays < 3 * DROGUE_RAYS / 2 || e.a + v[2] < 2) {
            return 0;
        }
        e = {e.xc + v[0], e.yc + v[1], e.a + v[2], e.a + v[2], 0, true};
        return s.slopes;
    }

private:
    drogue_image view_;
    int least_;
    Real margin_;
    Rays rays_;
};

/* Rays begin at whole LSB. */
Real down(Real v) { return std::floor(v / LSB) * LSB; }
Ellipse to_lsb(const Ellipse &e) { return real_of(circle(e.xc, e.yc, e.a)); }

constexpr int PLACES[13][2] = {{0, 0}, {1, 0},  {-1, 0}, {0, 1},  {0, -1}, {2, 0},  {-2, 0},
                               {0, 2}, {0, -2}, {1, 1},  {-1, 1}, {1, -1}, {-1, -1}};

/* The circle of which the rays from a place about the middle see the steepest edge; 'a' and 'r' semi-axis and radius as the
 * region suggests them. Not ok: none. */
Ellipse steepest(Circles &circles, const Ellipse &middle, Real a, Real r)
{
    Ellipse best = {0, 0, 0, 0, 0, false};
    Real most = 0;
    for (const auto &p : PLACES) {
        const Ellipse place = {middle.xc + p[0] * down(a / 6), middle.yc + p[1] * down(a / 6), r, r, 0, true};
        circles.cast(place, 3 * down(r / 4));
        for (const int size : {-1, 0, 1}) {
            Ellipse e = place;
            const Real slopes = circles.settle(e, size * down(r / 3), 3 * down(r / 4));
            if (slopes > most) {
                most = slopes;
                best = e;
            }
        }
    }
    return best;
}

/* The disc, rounded to an LSB; not ok: none. */
Ellipse disc_in(const cv::Mat &view, const drogue_mask &mask, const Task &task, Real margin)
{
    const Ellipse none = {0, 0, 0, 0, 0, false};
    const Real a = mask.longest_px * real(drogue_q16{DROGUE_Q16(5, 12)});
    const Real r = real(q16(real(q16(a * task.model.inner_radius)) / task.model.rim_radius));
    const Ellipse middle = {mask.centre2_x / 2.0L, mask.centre2_y / 2.0L, 3 * down(a / 5), 0, 0, true};
    Circles circles(view, task.config.min_inner_contrast, margin);
    if (r < 3 || r > a) {
        return none;
    }
    if (a <= 512) { /* rays from the middle reach all of an outline */
        Circles steeper(view, 2 * task.config.min_inner_contrast, margin);
        const Rays &rays = steeper.cast(middle, middle.a);
        if (std::count_if(rays.begin(), rays.end(), [](const drogue_ray &ray) { return ray.count > 0; }) < 3) {
            return none;
        }
    }
    Ellipse e = steepest(circles, middle, a, r);
    if (!e.ok) {
        return none;
    }
    circles.cast(e = to_lsb(e), down(r / 4));
    return circles.settle(e, 0, down(r / 4)) > 0 ? to_lsb(e) : none;
}

/* Tangents of the direction of a pixel; 'most' of all that were asked for. */
bool direction_of(Point &p, Real &most, const reference::Camera &c)
{
    if (!reference::undistort(c, p)) {
        return false;
    }
    p = {(p.x - c.cx) / c.fx, (p.y - c.cy) / c.fy};
    most = std::max({most, std::fabs(p.x), std::fabs(p.y)});
    return true;
}

/* Where a disc is; 'most' the largest tangent, of 45 degrees at most; false: beyond the lens model. */
bool sight_of(Sight &out, Real &most, const Ellipse &e, const reference::Camera &c)
{
    Point at[5] = {{e.xc, e.yc}, {e.xc - e.a, e.yc}, {e.xc + e.a, e.yc}, {e.xc, e.yc - e.a}, {e.xc, e.yc + e.a}};
    most = 0;
    for (Point &p : at) {
        if (!direction_of(p, most, c)) {
            return false;
        }
    }
    out = {at[0].x, at[0].y, (at[2].x - at[1].x + at[4].y - at[3].y) / 4};
    return true;
}

} // namespace

bool same(const Ellipse &e, const Ellipse &f, Real room)
{
    const Real turn = std::remainder(e.angle - f.angle, std::acos(Real(-1)));
    return std::max({std::fabs(e.xc - f.xc), std::fabs(e.yc - f.yc), std::fabs(e.a - f.a), std::fabs(e.b - f.b),
                     std::fabs(turn) * (e.a - e.b)}) <= room;
}

bool Seeker::look(const cv::Mat &view, const drogue_mask &mask, cv::Point origin)
{
    const drogue_image image = {view.data, view.cols, view.rows, static_cast<int32_t>(view.step)};
    const drogue_setup setup = {&task_.library_camera, &task_.library_model, &task_.config};
    drogue_ellipse disc = {0, 0, 0, 0, 0};
    Rays rays;
    const bool there = follow_ && drogue_inner_seek(&disc, rays.data(), &image, &mask, &setup) != 0;
    Ellipse found = {0, 0, 0, 0, 0, false};
    for (const Real margin : {Real(0), GATE, -GATE}) {
        found = disc_in(view, mask, task_, margin);
        contradicted_ = follow_ && (found.ok != there || (there && !same(found, real_of(disc), DISC)));
        if (!contradicted_) {
            break;
        }
    }
    if (!found.ok) {
        return false;
    }
    found = follow_ && !contradicted_ ? real_of(disc) : found;
    const Ellipse at = {found.xc + origin.x, found.yc + origin.y, found.a, found.b, 0, true};
    const drogue_ellipse rounded = circle(at.xc, at.yc, at.a);
    Real most = 0;
    bool good = sight_of(seen_.own, most, at, task_.camera);
    const bool known = follow_ && drogue_inner_sight_of(&seen_.library, &rounded, setup.camera) != 0;
    good = good && (follow_ && std::fabs(most - 1) < TANGENT ? known : most <= 1) && seen_.own.radius > 0;
    if (follow_) {
        const Sight as = {real(seen_.library.x_q16), real(seen_.library.y_q16), real(seen_.library.radius_q16)};
        const bool alike = std::max({std::fabs(as.x - seen_.own.x), std::fabs(as.y - seen_.own.y),
                                     std::fabs(as.radius - seen_.own.radius)}) <= TANGENT;
        contradicted_ = contradicted_ || known != good || (known && !alike);
        seen_.own = known && alike ? as : seen_.own;
    }
    return good;
}

} // namespace mirror
