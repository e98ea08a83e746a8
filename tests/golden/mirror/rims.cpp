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

/* Outlines of two drogues whose disc is seen there, turned so far and the opposite way. */
std::vector<Ellipse> Seeker::rims(const Seen &seen, int yaw, int pitch, cv::Point origin)
{
    const drogue_setup setup = {&task_.library_camera, &task_.library_model, &task_.config};
    const reference::Model rim = {task_.model.rim_radius, task_.model.rim_radius, 0};
    drogue_inner_expected library = {};
    std::vector<Ellipse> out;
    if (follow_) {
        drogue_inner_rims(&library, &seen.library, yaw, pitch, &setup, origin.x, origin.y);
    }
    for (const int way : {1, -1}) {
        const Pose pose = turned(seen.own, way * yaw * STEP, way * pitch * STEP, task_.model);
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
    const std::vector<Ellipse> all = rims(seen_, 0, 0, origin);
    return all.empty() ? Ellipse{0, 0, 0, 0, 0, false} : all[0];
}

Real Seeker::cover(const Ellipse &e, const FrontEnd &front, const drogue_mask &mask, uint32_t looks)
{
    const Real own = covered(e, front, mask, task_.config, follow_, looks);
    if (follow_) {
        const drogue_ellipse rim = {q16(e.xc), q16(e.yc), q16(e.a), q16(e.b), q16(e.angle)};
        const Real as = real(drogue_outline_covered(&rim, &front.workspace, &front.list, &mask, &task_.config, looks));
        contradicted_ = contradicted_ || as != own;
    }
    return own;
}

/* Outlines about a disc of a size, of a drogue turned so far and the opposite way. */
void Seeker::score(Best &best, const FrontEnd &front, const drogue_mask &mask, cv::Point origin, const Turn &turn,
                   uint32_t looks)
{
    if (turn.yaw * turn.yaw + turn.pitch * turn.pitch > TURNS * TURNS) {
        return;
    }
    Seen seen = seen_;
    seen.library.radius_q16 = turn.size * seen_.library.radius_q16 / 16;
    seen.own.radius = follow_ ? real(seen.library.radius_q16) : turn.size * seen_.own.radius / 16;
    int way = 1;
    for (const Ellipse &e : rims(seen, turn.yaw, turn.pitch, origin)) {
        const Real covered = cover(e, front, mask, looks), share = turn.size * covered / 16;
        best.sum += covered;
        best.count++;
        if (share > best.most) {
            best = {e, share, {turn.size, way * turn.yaw, way * turn.pitch}, best.sum, best.count};
        }
        way = -1;
    }
}

Ellipse Seeker::best(Real &above, const FrontEnd &front, const drogue_mask &mask, cv::Point origin, int sizes)
{
    const uint32_t looks = sizes > 0 ? 128 : 512;
    Best best = {{0, 0, 0, 0, 0, false}, 0, {0, 0, 0}, 0, 0};
    for (int size = 16 - sizes; size <= 16 + sizes; size++) {
        for (int yaw = 0; yaw <= TURNS; yaw++) { /* what is turned the opposite way comes with it */
            for (int pitch = yaw == 0 ? 0 : -TURNS; pitch <= TURNS; pitch++) {
                if ((yaw + pitch + size) % 2 == 0) {
                    score(best, front, mask, origin, {size, yaw, pitch}, looks);
                }
            }
        }
    }
    const Turn middle = best.turn;
    for (int yaw = -1; yaw <= 1 && best.ring.ok; yaw++) {
        for (int pitch = -1; pitch <= 1; pitch++) {
            if (yaw != 0 || pitch != 0) {
                score(best, front, mask, origin, {middle.size, middle.yaw + yaw, middle.pitch + pitch}, looks);
            }
        }
    }
    above = best.count > 0 ? best.most - best.sum / best.count : 0;
    return best.ring;
}

bool of_size(const Ellipse &e, const drogue_mask &mask)
{
    return 42 * e.a <= 20 * mask.longest_px && 57 * e.b >= 20 * mask.longest_px;
}

} // namespace mirror
