/* SPDX-License-Identifier: Apache-2.0 */
/* The inner disc where no outline says where it is, and the outlines that it allows, in floating point, from the edges along
 * rays that the library finds. */
#pragma once

#include <vector>

#include "mirror.hpp"

namespace mirror {

constexpr Real LSB = 1 / 65536.0L;

/* Are two ellipses the same to so much, px? Their angles as far as these move them. */
bool same(const reference::Ellipse &e, const reference::Ellipse &f, Real room);

/* A disc as seen from the camera: tangents of its middle's direction, and of its radius were it on the axis. */
struct Sight {
    Real x, y, radius;
};

/* Where the library's numbers are those of the mirror to what it resolves, they are the next step's input, so that both
 * decide alike; where they are not, or it decides otherwise, it is contradicted. */
class Seeker {
public:
    /* 'follow' false: every number and decision is the mirror's own */
    Seeker(const Task &task, bool follow) : task_(task), follow_(follow) {}

    /* Look for the disc about a region's middle, 'origin' its first pixel; false: there is none. */
    bool look(const cv::Mat &view, const drogue_mask &mask, cv::Point origin);

    /* The first outline about the disc, in coordinates of a region; not ok: none. */
    reference::Ellipse head_on(cv::Point origin);

    /* Of the outlines that the disc allows the first that edge points cover best, of every second turn and then of those
     * beside the best; not ok: they cover none. */
    reference::Ellipse best(const FrontEnd &front, const drogue_mask &mask, cv::Point origin);

    bool contradicted() const { return contradicted_; }

private:
    /* A sight, and as the library has it. */
    struct Seen {
        Sight own;
        drogue_inner_sight library;
    };

    /* The best outline so far, and by how many steps the drogue is turned. */
    struct Best {
        reference::Ellipse ring;
        Real cover;
        int yaw, pitch;
    };

    void score(Best &best, const FrontEnd &front, const drogue_mask &mask, cv::Point origin, int yaw, int pitch);
    std::vector<reference::Ellipse> rims(int yaw, int pitch, cv::Point origin);
    Real cover(const reference::Ellipse &e, const FrontEnd &front, const drogue_mask &mask);

    const Task &task_;
    bool follow_, contradicted_ = false;
    Seen seen_ = {};
};

/* Is the ring of a mask made for an outline of that size: has it a twentieth to spare to either side? */
bool of_size(const reference::Ellipse &e, const drogue_mask &mask);

} // namespace mirror
