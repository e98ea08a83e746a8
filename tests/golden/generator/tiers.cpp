/* SPDX-License-Identifier: Apache-2.0 */
/* The reference tier of arcs selected, of support and of the joint pose. */
#include "tiers.hpp"

#include <algorithm>
#include <cmath>

#include "reference.hpp"

#include "drogue/drogue.h"

namespace vectors {

namespace {

using reference::q16;
using reference::Real;
using Words = std::vector<int64_t>;

/* Each of n offsets is rounded to an LSB on its own: five standard deviations of their sum, or all alike where that is
 * less; and what the frame's own roundings shift every one of them by. */
Real sum_error(Real n, const reference::Ellipse &e)
{
    return std::min(0.5L * n, 5 * 0.29L * std::sqrt(n)) + n * (1e-4L * e.a + 4e-3L) + 1;
}

/* A member as its word: bin and polarity, -1 when the point does not belong. Where its limits are nearer than the library
 * resolves from the same ellipse (the normal, and with it the direction times b / a, has 14 bits), the library's word counts. */
int64_t member_of(reference::BandPoint &p, const reference::Ellipse &e, const reference::Band &band, int64_t library)
{
    if (p.undecided(3e-4L * band.width + 1e-4L, 3e-4L)) {
        p.held = library >= 0;
    }
    if (p.held && library >= 0 && p.from_next_bin < e.a / e.b / 8192) {
        p.bin = as_int(library) % reference::SUPPORT_BINS;
    }
    return p.held ? p.bin + reference::SUPPORT_BINS * p.polarity : -1;
}

reference::Ellipse ellipse_of(const Words &w)
{
    return {real(w[0]), real(w[1]), real(w[2]), real(w[3]), real(w[4]), true};
}

int64_t status_of(reference::Solved solved)
{
    switch (solved) {
    case reference::Solved::ok: return DROGUE_OK;
    case reference::Solved::degenerate: return DROGUE_E_DEGENERATE;
    case reference::Solved::domain: return DROGUE_E_DOMAIN;
    case reference::Solved::behind: break;
    }
    return DROGUE_E_BEHIND_CAMERA;
}

/* A symmetric matrix packed, and its bound: a share of each entry's scale, the root of the diagonal's product. */
Expected packed(const Array &exact, const reference::Covariance &c, Real share)
{
    Words words;
    std::vector<Real> more;
    for (int i = 0; i < 5; i++) {
        for (int j = 0; j <= i; j++) {
            words.push_back(rounded(c(i, j), 48));
            more.push_back(share * std::ldexp(std::sqrt(static_cast<Real>(c(i, i)) * c(j, j)), 48));
        }
    }
    return {like(exact, words), bounds("joint", like(exact, words), more)};
}

} // namespace

Tiers select_tier(const Arrays &in, const Arrays &exact)
{
    const Words &p = in[2].words;
    std::vector<reference::Verdict> verdicts;
    std::vector<int> counts;
    size_t at = 0;
    for (size_t i = 0; i < in[1].words.size(); i += 2) {
        std::vector<cv::Point> pixels;
        for (int64_t k = 0; k < in[1].words[i]; k++, at += 2) {
            pixels.emplace_back(as_int(in[0].words[at]), as_int(in[0].words[at + 1]));
        }
        verdicts.push_back(reference::judge_arc(pixels, as_int(p[0]), as_int(p[1]), as_int(in[1].words[i + 1]), p[3]));
        counts.push_back(static_cast<int>(pixels.size()));
    }
    Words words = {DROGUE_E_NO_ARCS};
    for (const auto &quadrant : reference::select_arcs(verdicts, counts, as_int(p[4]))) {
        for (const int arc : quadrant) {
            words.push_back(arc);
            if (arc >= 0) {
                words[0] = DROGUE_OK;
            }
        }
    }
    return {{like(exact[0], words), {}}};
}

Tiers support_tier(const Arrays &in, const Arrays &exact)
{
    const reference::Ellipse e = ellipse_of(in[0].words);
    const Words &w = in[1].words, &p = in[2].words;
    const reference::Band band = {real(p[0]), real(p[1])};
    if (e.b < 1 || e.a < e.b) {
        Tiers none;
        for (const Array &a : exact) {
            none.push_back({like(a, Words(a.words.size(), 0)), {}});
        }
        none[0].array.words[0] = DROGUE_E_DOMAIN;
        return none;
    }
    std::vector<reference::BandPoint> points;
    std::vector<reference::Edge> edges;
    Words members;
    reference::Support counted, added;
    for (size_t i = 0; i < w.size() / 4; i++) {
        edges.push_back({{static_cast<Real>(w[4 * i]) / 32, static_cast<Real>(w[4 * i + 1]) / 32},
                         static_cast<Real>(w[4 * i + 2]),
                         static_cast<Real>(w[4 * i + 3])});
        points.push_back(reference::band_point(e, band, edges.back()));
        members.push_back(member_of(points.back(), e, band, exact[2].words[i]));
    }
    int64_t looked = 0;
    for (size_t i = 0; i < points.size(); i += static_cast<size_t>(p[2])) {
        if (points[i].held) {
            reference::support_add(counted, points[i], edges[i]);
            looked++;
        }
    }
    reference::support_judge(counted, e, as_int(p[3]), as_int(p[2]));
    added.bright = counted.bright;
    Real distances = 0;
    for (size_t i = 0; i < points.size(); i++) {
        if (points[i].held && reference::support_add(added, points[i], edges[i])) {
            distances += std::fabs(points[i].f) / 2;
        }
    }
    Words bins;
    std::vector<Real> more;
    for (size_t k = 0; k < added.sum.size(); k++) {
        bins.insert(bins.end(), {added.count[k][0], added.count[k][1], q16(added.sum[k])});
        more.insert(more.end(), {0, 0, sum_error(added.count[k][added.bright >> k & 1], e)});
    }
    const Real each = 2 * (1e-4L * e.a + 4e-3L);
    const Real squares = 10 * 0.29L * 65536 * std::sqrt(added.squares) + each * 65536 * distances + added.points;
    const Array sums = like(exact[3], {rounded(added.squares, 32), static_cast<int64_t>(added.gradient)});
    return {{like(exact[0], {DROGUE_OK, looked, static_cast<int32_t>(counted.bright), counted.covered,
                             counted.covered * 65536 / reference::SUPPORT_BINS, added.points}),
             {}},
            {like(exact[1], bins), bounds("support", like(exact[1], bins), more)},
            {like(exact[2], members), {}},
            {sums, bounds("support", sums, {squares, 0})}};
}

Tiers joint_tier(const Arrays &in, const Arrays &exact)
{
    const reference::Ellipse e = ellipse_of(in[0].words);
    const Words &c = in[1].words, &bins = in[2].words, &p = in[3].words;
    const reference::Camera camera = {real(c[0]), real(c[1]), real(c[2]), real(c[3])};
    const reference::Model model = {real(p[0]), real(p[1]), real(p[2])};
    const reference::Inner inner = {{real(p[8]), real(p[9])}, real(p[10])};
    const Real yaw = real(p[6]), pitch = real(p[7]);
    const reference::Pose start = {{real(p[3]), real(p[4]), real(p[5])},
                                   {std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch)},
                                   yaw,
                                   pitch};
    reference::Support support;
    for (size_t k = 0; k < reference::SUPPORT_BINS; k++) {
        support.count[k][0] = as_int(bins[2 * k]);
        support.sum[k] = real(bins[2 * k + 1]);
        support.points += as_int(bins[2 * k]);
    }
    support.gradient = static_cast<Real>(p[13]);
    Words joint(10, 0), disc(6, 0);
    std::vector<Real> more(10, 0), disc_more(6, 0);
    reference::Ellipse image;
    const reference::Solved seen = reference::disc_image(image, start, camera, model);
    disc[0] = status_of(seen);
    if (seen == reference::Solved::ok) {
        disc = {DROGUE_OK, q16(image.xc), q16(image.yc), q16(image.a), q16(image.b), q16(image.angle)};
        disc_more[5] = angle_turn(image.a, image.b, 4);
    }
    Tiers tiers = {
        {like(exact[0], joint), {}},
        {like(exact[1], disc), disc[0] == DROGUE_OK ? bounds("joint", like(exact[1], disc), disc_more) : Bound()},
        {like(exact[2], Words(15, 0)), {}},
        {like(exact[3], Words(15, 0)), {}}};
    reference::Covariance outline;
    if (!reference::outline_covariance(outline, e, support, real(p[11]), real(p[12]))) {
        tiers[0].array.words[0] = DROGUE_E_DEGENERATE;
        return tiers;
    }
    /* the basis and its products have 30 bits, of which inverting takes what the counts' matrix is badly conditioned by:
     * nothing for a whole outline, all of them for an arc of few bins, whose covariance has no reference then */
    const Real share = 0x1p-30L * static_cast<Real>(reference::condition_of(support));
    tiers[3] = packed(exact[3], outline, share);
    const reference::Joint j = reference::solve_joint(start, e, outline, inner, camera, model, as_int(p[14]));
    tiers[0].array.words[0] = status_of(j.solved);
    if (j.solved != reference::Solved::ok) {
        return tiers;
    }
    const Real v[9] = {j.pose.position[0], j.pose.position[1], j.pose.position[2],
                       j.pose.axis[0],     j.pose.axis[1],     j.pose.axis[2],
                       j.pose.yaw,         j.pose.pitch,       static_cast<Real>(j.chi2)};
    for (size_t k = 0; k < 9; k++) {
        tiers[0].array.words[1 + k] = q16(v[k]);
    }
    more[9] = static_cast<Real>(tiers[0].array.words[9]) * 0x1p-14L;
    tiers[0].bound = bounds("joint", tiers[0].array, more);
    tiers[2] = packed(exact[2], j.covariance, 0x1p-13L);
    return tiers;
}

} // namespace vectors
