/* SPDX-License-Identifier: Apache-2.0 */
/* From the exact front end's edge points to the outline, in floating point. */
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "reference.hpp"

#include "drogue/drogue.h"

namespace mirror {

using reference::Real;

inline Real real(int64_t q16) { return static_cast<Real>(q16) / 65536; }

/* What the front end leaves: the library's own lists, and the same as numbers. */
struct FrontEnd {
    drogue_status status;
    std::vector<uint32_t> memory;
    drogue_workspace workspace;
    drogue_edge_list list;
    std::vector<reference::Edge> edges;
};
std::unique_ptr<FrontEnd> run_front_end(const cv::Mat &view, const drogue_mask &mask, const drogue_config &config,
                                        const drogue_capacity &capacity);

/* The edge points along rays by drogue_inner_beyond(), beyond 0 by drogue_inner_along(), in place of what the front end
 * left: integers, as those are. */
void look_beyond(FrontEnd &front, const cv::Mat &view, const drogue_ellipse &about, drogue_q16 beyond_px_q16);

/* Where a number lies nearer to a limit than the library resolves, its own decision is taken; by how much it may be
 * off is stated here, and a decision with a wider margin is never taken from it. */
struct Follow {
    const drogue_outline *library; /* NULL: every decision is the mirror's own */
    static constexpr Real cosine = 3e-4L;
    /* px: the ellipse to 8 LSB, the normal to 14 bits; the band's width is 3 spreads whose root is cut to 16 bits of a
     * semi-axis */
    static Real width(const reference::Ellipse &e, Real band) { return 3e-4L + 3e-4L * band + 4 * e.a / 65536; }
    /* rad: the ellipse to 8 LSB, its angle the less sure the rounder it is; the direction times b / a to 14 bits */
    static Real angle(const reference::Ellipse &e)
    {
        return 1e-4L + e.a / e.b / 8192 + 8 / 65536.0L * (1 + 1 / std::max<Real>(e.a - e.b, 1e-6L));
    }
    static constexpr Real score = 8 / 65536.0L;
};

/* An outline: its ellipse in region coordinates, the arcs it came from. */
struct Outline {
    reference::Ellipse ellipse, fitted; /* with and without what blur took put back */
    reference::Quality quality;
    int polarity = 0;
    std::array<uint32_t, 4> arcs;
    int members = 0;
    int64_t refit_points = 0;
    Real cover = 0, band = 0;
    reference::Support support;
    bool outer = false; /* along rays: nothing is put back, and support.pull is by how much it is larger */
    int outside = 0;
};

/* The outline with its blur undone, or why there is none. */
drogue_status find_outline(Outline &out, const FrontEnd &front, const drogue_mask &mask, const drogue_config &config,
                           const Follow &follow);

/* The list's edge points as numbers. */
void number(FrontEnd &front);

/* Share of an ellipse that edge points cover, as drogue_outline_covered(); 'follow': of a point nearer to a limit than the
 * library resolves that says whether it counts. */
Real covered(const reference::Ellipse &e, const FrontEnd &front, const drogue_mask &mask, const drogue_config &config,
             bool follow);

/* The outline about an ellipse, as drogue_outline_settle(); false: none. */
bool settle(Outline &out, const drogue_ellipse &ring, drogue_q16 band_px_q16, drogue_q16 least_cover_q16,
            const FrontEnd &front, const drogue_mask &mask, const drogue_config &config, const Follow &follow);

/* A larger outline about the one found, as drogue_outline_enlarge(); false: none, 'out' as it was. */
bool enlarge(Outline &out, const FrontEnd &front, const drogue_mask &mask, const drogue_config &config,
             const Follow &follow);

/* The rim's outer edge about an outline as drogue_outline_outer(), along rays from the ellipse 'aim'; false: there is none. */
bool outer_edge(reference::Ellipse &e, std::array<Real, 5> &grown, const drogue_image &view, const drogue_ellipse &aim);

/* What lies beside the outline as drogue_outline_pull(), along rays from the ellipse 'aim', and blur put back. */
void pull(Outline &o, const drogue_image &view, const drogue_ellipse &aim, const drogue_config &config);
void put_back(reference::Ellipse &e, const std::array<Real, 5> &pull);
std::array<Real, 5> turned(const std::array<Real, 5> &pull,
                           Real turn); /* over the angles of an ellipse turned by that */
void undo_blur(reference::Ellipse &e, const drogue_config &config);

/* Ellipse as the ideal camera would see it, px of the whole image; not ok when the lens cannot be undone. */
reference::Ellipse ideal_of(const Outline &outline, const FrontEnd &front, const drogue_config &config,
                            const Follow &follow, const reference::Camera &camera, cv::Point origin);

} // namespace mirror
