/* SPDX-License-Identifier: Apache-2.0 */
/* What lies beside the outline, and blur: what both did to it, in floating point, from the grey along rays that the library
 * reads: integers, and where a ray goes is settled by the ellipse alone. */
#include "outline.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "drogue/rays.h"

namespace mirror {

using reference::Ellipse;
using reference::Support;

namespace {

enum { GROUPS = 8, GROUP = DROGUE_RAYS / GROUPS, BINS = reference::SUPPORT_BINS / GROUPS, SLOPES = 23, MIDDLE = 11 };
enum { LONG_SLOPES = 64, LONG_MIDDLE = 48 };

using Curve = std::array<Real, SLOPES>;

/* Slopes along a group's rays, half a pixel apart, 'middle' of them within the ellipse: of grey or of light. */
template <size_t N>
std::array<Real, N> slopes(const Support &s, const drogue_ray *rays, int group, const drogue_image &view, int middle,
                           drogue_transfer transfer)
{
    std::array<Real, N> sum = {};
    for (int k = group * GROUP; k < (group + 1) * GROUP; k++) {
        const auto bin = static_cast<size_t>(k * reference::SUPPORT_BINS / DROGUE_RAYS);
        const uint32_t bright = s.bright >> bin & 1;
        if (s.count[bin][bright] > 0) {
            std::array<int32_t, N + 2> grey;
            const auto read = transfer == DROGUE_TRANSFER_SRGB ? drogue_ray_read_light : drogue_ray_read;
            read(grey.data(), &rays[k], &view, -(middle + 1) * 32768, N + 2);
            for (size_t i = 0; i < N; i++) {
                sum[i] += static_cast<Real>(bright ? grey[i] - grey[i + 2] : grey[i + 2] - grey[i]);
            }
        }
    }
    return sum;
}

/* How much of a group's rays is saturated 1.5 px outside the ellipse, less what is so inside it; of all, those without
 * points of the outline, too. */
Real cut_off(const Support &s, const drogue_ellipse &aim, int group, const drogue_image &view)
{
    const int sets = aim.a_px_q16 >= 24 * 65536 ? 2 : 1;
    std::array<drogue_ray, DROGUE_RAYS> rays;
    int cut = 0;
    for (int set = 0; set < sets; set++) {
        drogue_rays_aim(rays.data(), &aim, (8 * set + 4) / sets, 0, DROGUE_RAYS / 2);
        for (int k = group * GROUP; k < (group + 1) * GROUP; k++) {
            const auto bin = static_cast<size_t>(k * reference::SUPPORT_BINS / DROGUE_RAYS);
            int32_t inside, outside;
            if (s.count[bin][s.bright >> bin & 1] > 0) {
                drogue_ray_read(&inside, &rays[k], &view, -3 * 32768, 1);
                drogue_ray_read(&outside, &rays[k], &view, 3 * 32768, 1);
                cut += (outside >= 254 * 256) - (inside >= 254 * 256);
            }
        }
    }
    return static_cast<Real>(cut) / (sets * GROUP);
}

/* The mean over as many sets of rays as the outline is large for, in whole numbers. */
Curve mean_slopes(const Support &s, const drogue_ellipse &aim, int group, const drogue_image &view,
                  drogue_transfer transfer)
{
    const int sets = aim.a_px_q16 >= 24 * 65536 ? 2 : 1;
    std::array<drogue_ray, DROGUE_RAYS> rays;
    Curve mean = {};
    for (int k = 0; k < sets; k++) {
        drogue_rays_aim(rays.data(), &aim, (8 * k + 4) / sets, 0, DROGUE_RAYS / 2);
        const Curve one = slopes<SLOPES>(s, rays.data(), group, view, MIDDLE, transfer);
        std::transform(one.begin(), one.end(), mean.begin(), mean.begin(), std::plus<Real>());
    }
    std::transform(mean.begin(), mean.end(), mean.begin(), [=](Real sum) { return std::floor(sum / sets + 0.5L); });
    return mean;
}

/* A Gaussian of variance 1.33 px^2, in 1/128. */
Curve blurred(const Curve &slope)
{
    static const int tap[] = {128, 117, 88, 55, 28, 12, 4, 1};
    Curve out = {};
    for (int i = 7; i + 7 < SLOPES; i++) {
        for (int k = -7; k <= 7; k++) {
            out[static_cast<size_t>(i)] += tap[std::abs(k)] * slope[static_cast<size_t>(i + k)];
        }
    }
    return out;
}

Curve sharpened(const Curve &slope)
{
    Curve out = {};
    for (size_t i = 2; i + 2 < SLOPES; i++) {
        out[i] = slope[i] - (slope[i - 2] - 2 * slope[i] + slope[i + 2]) / 4;
    }
    return out;
}

/* The highest peak from one place to another; 0 when there is none. */
size_t peak(const Curve &c, int from, int to)
{
    size_t best = 0;
    Real highest = 0;
    for (auto i = static_cast<size_t>(from); i <= static_cast<size_t>(to); i++) {
        if (c[i] > highest && c[i] > c[i - 1] && c[i] >= c[i + 1]) {
            best = i;
            highest = c[i];
        }
    }
    return best;
}

/* The vertex of the parabola through a peak and the values so far from it. */
Real vertex(const Curve &c, size_t at, size_t apart)
{
    const Real before = c[at - apart], after = c[at + apart];
    return static_cast<Real>(at) + static_cast<Real>(apart) * (after - before) / (2 * (2 * c[at] - before - after));
}

/* The most that slopes add up to from one place on. */
template <typename Iterator> Real most_of(Iterator from, Iterator to)
{
    Real sum = 0, most = 0;
    for (; from != to; ++from) {
        sum += *from;
        most = std::max(most, sum);
    }
    return most;
}

/* Variance of a group's edge from its width, px^2; 0 without one. */
Real edge_variance(const Curve &slope, const Curve &seen)
{
    const auto at = std::max_element(seen.begin() + MIDDLE - 4, seen.begin() + MIDDLE + 5) - seen.begin();
    const auto i = static_cast<size_t>(at);
    const Real rise =
        slope[i] + most_of(slope.begin() + at + 1, slope.end()) + most_of(slope.rbegin() + (SLOPES - at), slope.rend());
    const Real width = seen[i] > 0 && rise > 0 ? std::min<Real>(rise * 369 / seen[i], 16) : 0;
    return width * width / 8;
}

std::array<Real, 2> smear_of(const std::array<Real, GROUPS> &variance)
{
    std::array<Real, GROUPS / 2> both;
    for (size_t k = 0; k < GROUPS / 2; k++) {
        const Real p = variance[k], q = variance[k + GROUPS / 2];
        both[k] = p > 0 && q > 0 ? (p + q) / 2 : p + q;
        if (!(both[k] > 0)) {
            return {0, 0};
        }
    }
    const Real c = both[0] - both[1] - both[2] + both[3], s = both[0] + both[1] - both[2] - both[3];
    const Real other = std::abs(both[0] - both[1] + both[2] - both[3]) / 2, length = std::hypot(c, s);
    const Real beyond = length / std::sqrt(Real(2)) - other - 0.5L;
    return beyond > 0 ? std::array<Real, 2>{c * beyond / length, s * beyond / length} : std::array<Real, 2>{0, 0};
}

/* How far outwards the front end's blur moves a group's edge, px, and the standard deviation of that by noise. */
struct Moved {
    Real by = 0, noise = 0;
};

/* 'slope' is of the light, 'seen' of the grey as the front end sees it. */
Moved moved(const Curve &slope, const Curve &seen)
{
    const size_t best = peak(seen, MIDDLE - 2, MIDDLE + 2);
    if (best == 0) {
        return {};
    }
    const Real at = vertex(seen, best, 1);
    const Curve sharp = sharpened(slope);
    const Real near = std::floor(at * 0x1p20L + 0.5L), far = 2516580; /* slopes Q20, as the library: 2.4 of them */
    const size_t is = peak(sharp, static_cast<int>(std::floor((near - far) / 0x1p20L)),
                           static_cast<int>(std::ceil((near + far) / 0x1p20L)));
    if (is == 0) {
        return {};
    }
    Moved out;
    Real squares = 0, from = at;
    for (size_t i = MIDDLE + 5; i < MIDDLE + 9; i++) {
        squares += (slope[i + 2] - slope[i]) * (slope[i + 2] - slope[i]);
    }
    out.noise =
        std::min<Real>(25 / 16.0L * std::sqrt(squares) / (4 * (2 * sharp[is] - sharp[is - 1] - sharp[is + 1])), 4);
    if (seen[best] > seen[best - 2] && seen[best] >= seen[best + 2]) {
        const Real wide = vertex(seen, best, 2);
        from = wide + (wide - at) / 4;
    }
    out.by = (from - vertex(sharp, is, 1)) / 2;
    return out;
}

/* An edge that motion blurs: middle and width at half its height, how far inwards the band's other edge is; half pixels. */
struct Lobe {
    Real at = 0, width = 0, farther = 0;
};

using Long = std::array<Real, LONG_SLOPES>;

/* Where a curve falls below half of a peak, going one way; negative where it does not. */
Real half_way(const Long &c, size_t peak, int step)
{
    for (auto i = static_cast<int>(peak); i + step >= 2 && i + step < LONG_SLOPES - 2; i += step) {
        const Real here = c[static_cast<size_t>(i)], next = c[static_cast<size_t>(i + step)];
        if (2 * next < c[peak]) {
            return i + step * (here - c[peak] / 2) / (here - next);
        }
    }
    return -1;
}

Lobe lobe_of(const Long &slope)
{
    static const int tap[] = {1, 2, 3, 2, 1};
    Long curve = {}, under = {};
    Lobe lobe;
    for (size_t i = 2; i + 2 < LONG_SLOPES; i++) {
        for (size_t k = 0; k < 5; k++) {
            curve[i] += tap[k] * slope[i + k - 2];
        }
        under[i] = -curve[i];
    }
    const auto top = std::max_element(curve.begin() + LONG_MIDDLE - 6, curve.begin() + LONG_MIDDLE + 7);
    const auto peak = static_cast<size_t>(top - curve.begin());
    const Real inner = half_way(curve, peak, -1), outer = half_way(curve, peak, 1);
    if (!(*top > 0) || top[0] < top[-1] || top[0] < top[1] || inner < 0 || outer < 0) {
        return lobe;
    }
    lobe.at = (inner + outer) / 2 - LONG_MIDDLE;
    lobe.width = outer - inner;
    auto farthest = static_cast<size_t>(inner);
    const int from = static_cast<int>(inner);
    for (int i = from - 1; i > from - 36 && i >= 2; i--) {
        farthest = under[static_cast<size_t>(i)] > under[farthest] ? static_cast<size_t>(i) : farthest;
    }
    const Real far_inner = half_way(under, farthest, -1), far_outer = half_way(under, farthest, 1);
    if (3 * under[farthest] > *top && far_inner >= 0 && far_outer >= 0) {
        const Real between = (inner + outer - far_inner - far_outer) / 2;
        lobe.farther = between < 30 ? between : 0;
    }
    return lobe;
}

/* Motion of length l across a band of width w: lobes min(l, w) wide, max(l, w) apart; both too far out by half of what l
 * is longer. Which of the two is which, such that opposite groups agree, and with the band where it is sharpest. */
std::array<Real, GROUPS> smeared_offsets(const std::array<Lobe, GROUPS> &lobe)
{
    std::array<Real, GROUPS> off;
    Real band = 0, sharpest = 1000;
    for (size_t k = 0; k < GROUPS / 2; k++) {
        const Lobe &p = lobe[k], &q = lobe[k + GROUPS / 2];
        if (p.farther > 0 && q.farther > 0 && p.width + q.width < sharpest) {
            sharpest = p.width + q.width;
            band = (p.farther + q.farther) / 2;
        }
    }
    for (size_t k = 0; k < GROUPS / 2; k++) {
        const Lobe &p = lobe[k], &q = lobe[k + GROUPS / 2];
        Real least = 6, more[2] = {0, 0};
        for (int i = 0; i < 4 && p.farther > 0 && q.farther > 0; i++) {
            const bool first = (i & 1) != 0, second = (i & 2) != 0;
            const Real one = first ? p.farther : p.width, two = second ? q.farther : q.width;
            const Real bands = ((first ? p.width : p.farther) + (second ? q.width : q.farther)) / 2;
            const Real off_by = std::abs(one - two) + std::abs(bands - band) + (i > 0 ? 1 : 0);
            if (off_by < least) {
                const Real length = (one + two) / 2;
                least = off_by;
                more[0] = first ? std::max<Real>(length - p.width, 0) / 2 : 0;
                more[1] = second ? std::max<Real>(length - q.width, 0) / 2 : 0;
            }
        }
        off[k] = (more[0] - p.at) / 2; /* half pixels */
        off[k + GROUPS / 2] = (more[1] - q.at) / 2;
    }
    return off;
}

std::array<Real, 5> basis(int k)
{
    const Real t = (k + 0.5L) * 2 * std::acos(Real(-1)) / reference::SUPPORT_BINS;
    return {1, std::cos(t), std::sin(t), std::cos(2 * t), std::sin(2 * t)};
}

/* Harmonics of the groups' offsets, in semi-axes, each shrunk by what noise makes of it where motion blurs nothing: 'noise'
 * is the variance of a wave by the pixels' own, times b^2. */
std::array<Real, 5> harmonics(const std::array<Real, GROUPS> &off, const Ellipse &e, Real noise, bool smeared)
{
    std::array<Real, reference::SUPPORT_BINS> radial;
    std::array<Real, 5> c = {};
    Real left = 0;
    for (int k = 0; k < reference::SUPPORT_BINS; k++) {
        const auto at = basis(k);
        radial[static_cast<size_t>(k)] = off[static_cast<size_t>(k / BINS)] * std::hypot(at[1] / e.a, at[2] / e.b);
        for (size_t i = 0; i < 5; i++) {
            c[i] += radial[static_cast<size_t>(k)] * at[i] /
                    (i > 0 ? reference::SUPPORT_BINS / 2 : reference::SUPPORT_BINS);
        }
    }
    for (int g = 0; g < GROUPS; g++) {
        Real mean = 0;
        for (int k = g * BINS; k < (g + 1) * BINS; k++) {
            const auto at = basis(k);
            mean += radial[static_cast<size_t>(k)] / BINS;
            for (size_t i = 0; i < 5; i++) {
                mean -= c[i] * at[i] / BINS;
            }
        }
        left += mean * mean;
    }
    for (size_t i = 0; i < 5; i++) {
        const Real variance = smeared ? 0 : (left / 24 + noise / (e.b * e.b)) / (i > 0 ? 1 : 2);
        c[i] = variance > 0 ? c[i] * (c[i] * c[i]) / (c[i] * c[i] + variance) : c[i];
        c[i] = std::clamp<Real>(c[i], -0.125L, 0.125L);
    }
    return c;
}

/* Is there another edge outside the outline's own? */
bool outside(const Curve &slope)
{
    Real own = 0;
    for (size_t i = MIDDLE - 3; i <= MIDDLE + 3; i++) {
        own = std::max(own, std::fabs(slope[i]));
    }
    for (size_t i = MIDDLE + 2; i + 1 < SLOPES; i++) {
        const Real size = std::fabs(slope[i]);
        if (size > 3 * 8 * 256 && 6 * size > own && size > std::fabs(slope[i - 1]) && size >= std::fabs(slope[i + 1])) {
            return true;
        }
    }
    return false;
}

} // namespace

/* Blur of variance v moves an edge of curvature c inward by v c / 2; the front end's own half variance as measured. */
void undo_blur(Ellipse &e, const drogue_config &config)
{
    const Real own = config.smooth ? 0.82L : 0.32L, optics = real(config.optics_blur_px_q16);
    const Real half = own + optics * optics / 2, a = e.a, b = e.b;
    e.a += half * a / (b * b);
    e.b += half * b / (a * a);
}

/* The ellipse without that: the symmetric matrix of its semi-axes, less the pull, and its principal axes again. */
void put_back(Ellipse &e, const std::array<Real, 5> &pull)
{
    const Real a = e.a * (1 - pull[0] - pull[3]), b = e.b * (1 - pull[0] + pull[3]);
    const Real cross = -2 * e.a * e.b / (e.a + e.b) * pull[4], half = (a - b) / 2, apart = std::hypot(half, cross);
    const Real u = -e.a * pull[1], v = -e.b * pull[2], c = std::cos(e.angle), s = std::sin(e.angle);
    const Real pi = std::acos(Real(-1));
    e.xc += u * c - v * s;
    e.yc += u * s + v * c;
    if (apart > 0x1p-16L) { /* an LSB of the library: of a circle any angle is as good */
        e.angle = std::remainder(e.angle + std::atan2(cross, half) / 2, pi);
    }
    e.a = (a + b) / 2 + apart;
    e.b = (a + b) / 2 - apart;
}

std::array<Real, 5> turned(const std::array<Real, 5> &p, Real turn)
{
    const Real c = std::cos(turn), s = std::sin(turn), c2 = std::cos(2 * turn), s2 = std::sin(2 * turn);
    return {p[0], p[1] * c + p[2] * s, p[2] * c - p[1] * s, p[3] * c2 + p[4] * s2, p[4] * c2 - p[3] * s2};
}

void pull(Outline &o, const drogue_image &view, const drogue_ellipse &aim, const drogue_config &config)
{
    std::array<Real, GROUPS> off, variance, cut;
    Real noise = 64 / 65536.0L;
    o.ellipse = o.fitted;
    o.support.pull = o.outer ? o.support.pull : std::array<Real, 5>{};
    o.support.smear = {};
    o.outside = 0;
    if (o.support.points > 0) {
        for (int g = 0; g < GROUPS; g++) {
            const Curve slope = mean_slopes(o.support, aim, g, view, DROGUE_TRANSFER_LINEAR), seen = blurred(slope);
            const Moved edge = moved(mean_slopes(o.support, aim, g, view, config.transfer), seen);
            off[static_cast<size_t>(g)] = edge.by;
            o.outside += outside(slope);
            noise += edge.noise * edge.noise / (4 * GROUPS);
            variance[static_cast<size_t>(g)] = edge_variance(slope, seen);
            cut[static_cast<size_t>(g)] = cut_off(o.support, aim, g, view) * config.optics_blur_px_q16 / 131072.0L;
        }
        o.support.smear = smear_of(variance);
        const bool smeared = std::hypot(o.support.smear[0], o.support.smear[1]) > 0.5L && o.fitted.b >= 24;
        if (smeared) {
            std::array<Lobe, GROUPS> lobe;
            std::array<drogue_ray, DROGUE_RAYS> rays;
            drogue_rays_aim(rays.data(), &aim, 4, 0, DROGUE_RAYS / 2);
            for (int g = 0; g < GROUPS; g++) {
                lobe[static_cast<size_t>(g)] =
                    lobe_of(slopes<LONG_SLOPES>(o.support, rays.data(), g, view, LONG_MIDDLE, config.transfer));
            }
            off = smeared_offsets(lobe);
        }
        std::transform(off.begin(), off.end(), cut.begin(), off.begin(), std::minus<Real>());
        const Real c2 = std::cos(2 * o.fitted.angle), s2 = std::sin(2 * o.fitted.angle), c = o.support.smear[0];
        o.support.smear = {c * c2 - o.support.smear[1] * s2, o.support.smear[1] * c2 + c * s2}; /* from +x */
        if (!o.outer) {
            o.support.pull = harmonics(off, o.fitted, noise, smeared);
            put_back(o.ellipse, o.support.pull);
        }
    }
    undo_blur(o.ellipse, config);
}

namespace {

/* Edges in a bin, steepest first. */
struct OuterEdge {
    Real at = 0;
    int64_t slope = 0;
};
using OuterBin = std::vector<OuterEdge>;

/* What is seen about an outline: the edges of each bin, and the least slope of one. */
struct OuterSight {
    std::array<OuterBin, reference::SUPPORT_BINS> bins;
    int64_t least = 0;
};

/* Does a peak stand out by an eighth from what lies between it and a higher one, on either side? */
bool stands_out(const int64_t *slope, size_t count, size_t at)
{
    const int64_t *const peak = slope + at, *const end = slope + count;
    const int64_t *left = peak, *right = peak;
    int64_t within = *peak, outside = *peak;
    while (left > slope && left[-1] <= *peak) {
        within = std::min(within, *--left);
    }
    while (right + 1 < end && right[1] <= *peak) {
        outside = std::min(outside, *++right);
    }
    return (left == slope || 8 * within <= 7 * *peak) && (right + 1 == end || 8 * outside <= 7 * *peak);
}

/* The peaks of the mean slopes of four rays, the middle ones its own: the four steepest. 'own' gathers the steepest
 * within, 'outside' those out there but for the steepest peak. */
OuterBin outer_bin(const drogue_ray *rays, size_t k, const drogue_image &view, drogue_q16 step, int64_t &own,
                   int64_t &outside, int64_t &count)
{
    enum { SAMPLES = 18, OUTER_SLOPES = SAMPLES - 2, WITHIN = 5, OWN = 6, FAR = 8, KEPT = 4 };
    std::array<int64_t, SAMPLES> grey = {};
    std::array<int64_t, OUTER_SLOPES> slope;
    OuterBin out;
    int64_t within = 0;
    size_t outer = 0;
    for (size_t r = 2 * k + DROGUE_RAYS - 1; r < 2 * k + DROGUE_RAYS + 3; r++) {
        std::array<int32_t, SAMPLES> one;
        drogue_ray ray = rays[r % DROGUE_RAYS];
        ray.step_px_q16 = step;
        drogue_ray_read(one.data(), &ray, &view, -WITHIN * step, SAMPLES);
        std::transform(one.begin(), one.end(), grey.begin(), grey.begin(), std::plus<int64_t>());
    }
    for (size_t i = 0; i < OUTER_SLOPES; i++) {
        slope[i] = std::abs(grey[i + 2] - grey[i]) / 4;
    }
    for (size_t i = 1; i + 1 < OUTER_SLOPES; i++) {
        if (slope[i] <= slope[i - 1] || slope[i] < slope[i + 1] || !stands_out(slope.data(), OUTER_SLOPES, i)) {
            continue;
        }
        const auto bend = static_cast<Real>(2 * slope[i] - slope[i - 1] - slope[i + 1]);
        const Real part = static_cast<Real>(slope[i + 1] - slope[i - 1]) / (2 * bend);
        out.push_back({(static_cast<Real>(i) + 1 - WITHIN + part) * real(step), slope[i]});
        within = i <= OWN ? std::max(within, slope[i]) : within;
        outer = i > OWN && (outer == 0 || slope[i] > slope[outer]) ? i : outer;
    }
    own += within;
    for (size_t i = FAR; i < OUTER_SLOPES; i++) {
        if (std::max(i, outer) - std::min(i, outer) > 2) {
            outside += slope[i];
            count++;
        }
    }
    std::stable_sort(out.begin(), out.end(), [](const OuterEdge &x, const OuterEdge &y) { return x.slope > y.slope; });
    out.resize(std::min<size_t>(out.size(), KEPT));
    return out;
}

/* Has a ray by itself half the slope at its bin's outer edge that the four have on average? */
bool has_outer(drogue_ray ray, const OuterEdge &edge, const drogue_image &view, drogue_q16 step)
{
    std::array<int32_t, 5> grey;
    int64_t most = 0;
    ray.step_px_q16 = step;
    drogue_ray_read(grey.data(), &ray, &view, reference::q16(edge.at) - 2 * step, 5);
    for (size_t i = 0; i < 3; i++) {
        most = std::max<int64_t>(most, std::abs(grey[i + 2] - grey[i]));
    }
    return 2 * most >= edge.slope;
}

using Waves = std::array<Real, 5>;

Real there(const Waves &v, size_t k)
{
    const auto at = basis(static_cast<int>(k));
    return std::inner_product(v.begin(), v.end(), at.begin(), Real(0));
}

/* Of a bin the edge nearest to a place, the end where none is within so much. */
OuterBin::const_iterator nearest(const OuterBin &bin, Real at, Real within, int64_t least)
{
    auto best = bin.end();
    for (auto e = bin.begin(); e != bin.end() && e->slope >= least; ++e) {
        if (std::fabs(e->at - at) < within) {
            within = std::fabs(e->at - at);
            best = e;
        }
    }
    return best;
}

/* The ellipse of least squares over the edges nearest to one; within 0: over the steepest ones outside. */
Waves outer_fit(const Waves &v, const OuterSight &s, Real within)
{
    constexpr size_t BINS32 = reference::SUPPORT_BINS;
    Waves sum = {};
    for (size_t k = 0; k < BINS32; k++) {
        const OuterBin &bin = s.bins[k];
        const auto at = basis(static_cast<int>(k));
        const auto edge = within > 0 ? nearest(bin, there(v, k), within, s.least)
                                     : std::find_if(bin.begin(), bin.end(),
                                                    [&](const OuterEdge &e) { return e.slope >= s.least && e.at > 1; });
        const Real off = edge != bin.end() ? edge->at : there(v, k);
        for (size_t i = 0; i < 5; i++) {
            sum[i] += off * at[i] / (i > 0 ? BINS32 / 2 : BINS32);
        }
    }
    return sum;
}

/* Bins whose edges an ellipse passes; 0 where there are too few off the outline. */
int agreeing(const Waves &v, const OuterSight &s)
{
    int agree = 0, off = 0, both = 0;
    for (size_t k = 0; k < s.bins.size(); k++) {
        const Real at = there(v, k);
        const bool on = nearest(s.bins[k], at, 0.6L, s.least) != s.bins[k].end(), is_off = std::fabs(at) > 0.7L;
        agree += on;
        off += is_off;
        both += on && is_off;
    }
    return off >= 6 && 2 * both >= off ? agree : 0;
}

/* From seven starts the larger ellipse on which most bins agree; false: there is none. */
bool outer_seek(Waves &best, const OuterSight &s, Real most)
{
    Real merit = 0;
    for (int start = -1; start < 6; start++) {
        Waves v = {};
        v[0] = std::max(start, 0);
        v = start < 0 ? outer_fit(v, s, 0) : v;
        for (int i = 0; i < 16; i++) {
            v = outer_fit(v, s, i < 6 ? 2 : i < 14 ? 1 : 0.6L);
        }
        const bool is_near = std::all_of(v.begin(), v.end(), [&](Real c) { return std::fabs(c) <= most; });
        const int agree = is_near && v[0] >= 0.3L ? agreeing(v, s) : 0;
        if (agree >= 22 && agree / 4.0L + v[0] > merit) {
            merit = agree / 4.0L + v[0];
            best = v;
        }
    }
    return merit > 0;
}

bool outer_edge(Ellipse &e, Waves &grown, const drogue_image &view, const drogue_ellipse &aim, drogue_q16 step)
{
    std::array<drogue_ray, DROGUE_RAYS> rays;
    OuterSight s;
    Waves v = {};
    int64_t outside = 0, count = 0, own = 0;
    int seen = 0, asked = 0;
    drogue_rays_aim(rays.data(), &aim, 4, 0, DROGUE_RAYS / 2);
    for (size_t k = 0; k < s.bins.size(); k++) {
        s.bins[k] = outer_bin(rays.data(), k, view, step, own, outside, count);
    }
    s.least = std::max({int64_t{5 * 256}, own / (32 * 5), 3 * outside / (2 * count)});
    if (!outer_seek(v, s, e.b / 8)) {
        return false;
    }
    for (size_t k = 0; k < s.bins.size(); k++) {
        const Real at = there(v, k);
        const auto edge = nearest(s.bins[k], at, 0.6L, s.least);
        for (size_t r = 2 * k; r < 2 * k + 2 && at > 0.7L && edge != s.bins[k].end(); r++) {
            seen += has_outer(rays[r], *edge, view, step);
            asked++;
        }
    }
    if (4 * seen < 3 * asked) {
        return false;
    }
    const Real along = (v[0] + v[3]) / e.a, across = (v[0] - v[3]) / e.b;
    grown = {-(along + across) / 2, -v[1] / e.a, -v[2] / e.b, -(along - across) / 2, -2 * v[4] / (e.a + e.b)};
    put_back(e, grown);
    return true;
}

} // namespace

bool outer_edge(Ellipse &e, std::array<Real, 5> &grown, const drogue_image &view, const drogue_ellipse &aim)
{
    const drogue_q16 narrow = 32768, wide = std::min(aim.a_px_q16 / 200, 9 * 65536);
    return e.b >= 16 &&
           (outer_edge(e, grown, view, aim, narrow) || (wide > narrow && outer_edge(e, grown, view, aim, wide)));
}

} // namespace mirror
