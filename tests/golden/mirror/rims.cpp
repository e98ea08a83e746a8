/* SPDX-License-Identifier: Apache-2.0 */
/* The outlines that an inner disc allows, in floating point, and the one of them that edge points cover best. */
#include "seek.hpp"

#include <algorithm>
#include <cmath>

namespace mirror {

using reference::Ellipse;
using reference::Pose;
using reference::q16;

namespace {

constexpr int TURNS = 6; /* steps from the line of sight at most, of so many rad: */
constexpr Real STEP = 0.08L;

/* An outline, px: its middle's coordinates are of some products, one with the disc's depth, each to an LSB of a metre; its
 * size is of a length and a cosine to an LSB each. */
Real outline_room(const Ellipse &e, const Pose &pose, const Task &task)
{
    const Real per_metre = std::max(task.camera.fx, task.camera.fy) / pose.position[2];
    return 8 * LSB + 4 * LSB * ((1 + std::fabs(task.model.inner_depth)) * per_metre + e.a);
}

/* A drogue whose disc is there and whose axis is turned from the line of sight. Head-on the disc's mean semi-axis is as on
 * the optical axis times (1 + length) / 2, turned times (1 + cosine) / 2. */
Pose turned(const Sight &s, Real yaw, Real pitch, const reference::Model &model)
{
    const Real across = std::hypot(s.x, Real(1)), length = std::hypot(s.y, across);
    const Real z = model.inner_radius / s.radius * (1 + length) / 2 * (1 - (yaw * yaw + pitch * pitch) / 4);
    Pose p = {{s.x * z, s.y * z, z}, {}, std::atan(s.x) + yaw, std::atan2(s.y, across) + pitch};
    p.axis = {std::sin(p.yaw) * std::cos(p.pitch), std::sin(p.pitch), std::cos(p.yaw) * std::cos(p.pitch)};
    for (size_t k = 0; k < 3; k++) { /* from the disc's middle to the rim's */
        p.position[k] -= model.inner_depth * p.axis[k];
    }
    return p;
}

} // namespace

/* Outlines of two drogues whose disc is the one seen, turned so far and the opposite way. */
std::vector<Ellipse> Seeker::rims(int yaw, int pitch, cv::Point origin)
{
    const drogue_setup setup = {&task_.library_camera, &task_.library_model, &task_.config};
    const reference::Model rim = {task_.model.rim_radius, task_.model.rim_radius, 0};
    drogue_inner_expected library = {};
    std::vector<Ellipse> out;
    if (follow_) {
        drogue_inner_rims(&library, &seen_.library, yaw, pitch, &setup, origin.x, origin.y);
    }
    for (const int way : {1, -1}) {
        const Pose pose = turned(seen_.own, way * yaw * STEP, way * pitch * STEP, task_.model);
        Ellipse e;
        if (reference::disc_image(e, pose, task_.camera, rim) != reference::Solved::ok || e.b < 1 ||
            !reference::distort(task_.camera, e)) {
            continue;
        }
        e.xc -= origin.x;
        e.yc -= origin.y;
        const bool known =
            out.size() < library.count && same(e, real_of(library.disc[out.size()]), outline_room(e, pose, task_));
        contradicted_ = contradicted_ || (follow_ && !known);
        out.push_back(known ? real_of(library.disc[out.size()]) : e);
    }
    contradicted_ = contradicted_ || (follow_ && out.size() != library.count);
    return out;
}

Ellipse Seeker::head_on(cv::Point origin)
{
    const std::vector<Ellipse> all = rims(0, 0, origin);
    return all.empty() ? Ellipse{0, 0, 0, 0, 0, false} : all[0];
}

Real Seeker::cover(const Ellipse &e, const FrontEnd &front, const drogue_mask &mask)
{
    const Real own = covered(e, front, mask, task_.config, follow_);
    if (follow_) {
        const drogue_ellipse rim = {q16(e.xc), q16(e.yc), q16(e.a), q16(e.b), q16(e.angle)};
        const Real as = real(drogue_outline_covered(&rim, &front.workspace, &front.list, &mask, &task_.config));
        contradicted_ = contradicted_ || as != own;
    }
    return own;
}

/* Outlines about the disc of a drogue turned so far and the opposite way. */
void Seeker::score(Best &best, const FrontEnd &front, const drogue_mask &mask, cv::Point origin, int yaw, int pitch)
{
    if (yaw * yaw + pitch * pitch > TURNS * TURNS) {
        return;
    }
    int way = 1;
    for (const Ellipse &e : rims(yaw, pitch, origin)) {
        const Real covered = cover(e, front, mask);
        if (covered > best.cover) {
            best = {e, covered, way * yaw, way * pitch};
        }
        way = -1;
    }
}

Ellipse Seeker::best(const FrontEnd &front, const drogue_mask &mask, cv::Point origin)
{
    Best best = {{0, 0, 0, 0, 0, false}, 0, 0, 0};
    for (int yaw = 0; yaw <= TURNS; yaw++) { /* what is turned the opposite way comes with it */
        for (int pitch = yaw == 0 ? 0 : -TURNS; pitch <= TURNS; pitch++) {
            if ((yaw + pitch) % 2 == 0) {
                score(best, front, mask, origin, yaw, pitch);
            }
        }
    }
    const Best middle = best;
    for (int yaw = -1; yaw <= 1 && best.ring.ok; yaw++) {
        for (int pitch = -1; pitch <= 1; pitch++) {
            if (yaw != 0 || pitch != 0) {
                score(best, front, mask, origin, middle.yaw + yaw, middle.pitch + pitch);
            }
        }
    }
    return best.ring;
}

bool of_size(const Ellipse &e, const drogue_mask &mask)
{
    return 42 * e.a <= 20 * mask.longest_px && 57 * e.b >= 20 * mask.longest_px;
}

} // namespace mirror
