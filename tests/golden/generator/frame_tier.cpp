/* SPDX-License-Identifier: Apache-2.0 */
/* The reference tier of a frame by the mirror, and how far the library may be from it: the ellipse by what its fit may,
 * everything behind it by what such an ellipse, such a centroid and rounded residuals move it. */
#include "tiers.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "case_words.h"
#include "frame_words.hpp"

namespace vectors {

namespace {

using reference::Ellipse;
using reference::q16;
using reference::Real;
using Words = std::vector<int64_t>;
using namespace frame_words;

constexpr Real ELLIPSE_LSB = 4; /* of a fit, as stages_words.c has it */

void put_ellipse(int64_t *at, const Ellipse &e)
{
    const Real v[5] = {e.xc, e.yc, e.a, e.b, e.angle};
    std::transform(v, v + 5, at, q16);
}

void put_pose(int64_t *at, const reference::Pose &p)
{
    const Real v[8] = {p.position[0], p.position[1], p.position[2], p.axis[0], p.axis[1], p.axis[2], p.yaw, p.pitch};
    std::transform(v, v + 8, at, q16);
}

Words words_of(const mirror::Result &r)
{
    Words w(ALL, 0);
    w[STATUS] = r.contradicted ? -1 : static_cast<int64_t>(r.status); /* -1: which no library says */
    w[AMBIGUITY] = q16(r.ambiguity);
    if (!r.found) {
        return w;
    }
    put_ellipse(&w[SEEN], r.seen);
    if (r.ideal.ok) {
        put_ellipse(&w[IDEAL], r.ideal);
    }
    w[POLARITY] = r.outline.polarity;
    for (size_t k = 0; k < 4; k++) {
        w[ARCS] |= r.outline.arcs[k] != DROGUE_NO_ARC ? 1 << k : 0;
    }
    w[REFIT] = r.outline.refit_points;
    w[HAS_INNER] = r.has_inner;
    if (r.has_inner) {
        w[INNER + 3] = r.part.level;
        w[INNER] = q16(r.inner.x);
        w[INNER + 1] = q16(r.inner.y);
        w[INNER + 2] = static_cast<int64_t>(std::floor(r.area + 0.5L));
        w[INNER + 4] = q16(r.part.rms);
    }
    if (r.status != DROGUE_OK) {
        return w;
    }
    put_pose(&w[POSE], r.pose);
    put_pose(&w[OTHER], r.alternative);
    w[RESOLVED] = r.resolved;
    for (int i = 0, at = COVARIANCE; i < 5; i++) {
        for (int j = 0; j <= i; j++) {
            w[static_cast<size_t>(at++)] = rounded(r.covariance(i, j), 48);
        }
    }
    for (size_t k = 0; k < 3; k++) {
        w[STD + k] = rounded(r.position_std[k], 32);
    }
    w[STD + 3] = rounded(r.axis_std, 32);
    return w;
}

/* Edge points enter the last fit exactly. With the lens undone they are rounded, each in its own way, to a grid in which
 * four semi-axes fit 16 bits: half a pitch bounds what that can do. */
std::array<Real, 5> ellipse_more(const Ellipse &e, bool lens)
{
    Real pitch = 64; /* LSB */
    while (pitch < 65536 && 4 * e.a * 65536 / pitch > 32767) {
        pitch *= 2;
    }
    const Real axis = lens ? pitch / 2 : 0;
    return {axis, axis, axis, axis, axis + angle_turn(e.a, e.b, ELLIPSE_LSB + axis)};
}

/* Relative error of the scatter of the bins' sums: every offset is rounded to 2^-16 semi-axes, on its own, and the ellipse
 * itself lies off by an LSB of a pixel. */
Real scatter_error(const reference::Support &s, const Ellipse &e)
{
    Real scatter = 0, points = 0;
    int bins = 0;
    for (int k = 0; k < reference::SUPPORT_BINS; k++) {
        const int n = s.count[static_cast<size_t>(k)][s.bright >> k & 1];
        const Real sum = 65536 * s.sum[static_cast<size_t>(k)];
        scatter += n > 0 ? sum * sum / n : 0;
        points += n;
        bins += n > 0;
    }
    scatter = std::max<Real>(scatter, 1e-6L);
    return 5 * 2 * 0.29L / std::sqrt(scatter) + bins / 12.0L / scatter + 2 / e.b * std::sqrt(points / scatter);
}

/* Edges are up to 16 px wide to 2^-13 px, whose square over 8 is the variance; of four, halved. */
constexpr Real SMEAR_LSB = 32;

/* What the words behind the ellipse move by when what they come from does. */
class Sensitivity {
public:
    Sensitivity(const mirror::Task &task, const mirror::Result &result, const mirror::Features &features,
                const drogue_result *library)
        : task_(task), result_(result), features_(features), library_(library), own_(words_of(result)), sum_(ALL, 0)
    {}

    /* Change one number by so much, up and down. */
    template <class Member> void move(Member member, Real by)
    {
        std::vector<Real> most(ALL, 0);
        for (const int sign : {1, -1}) {
            mirror::Features f = features_;
            mirror::Result r = result_;
            member(f, sign * by);
            f.ideal.b = std::min(f.ideal.b, f.ideal.a);
            r.status = DROGUE_OK;
            mirror::finish(r, task_, f, library_);
            const Words w = words_of(r);
            for (size_t i = POSE; r.status == DROGUE_OK && i < ALL; i++) {
                most[i] = std::max(most[i], std::fabs(static_cast<Real>(w[i]) - static_cast<Real>(own_[i])));
            }
        }
        for (size_t i = 0; i < ALL; i++) {
            sum_[i] += most[i];
        }
    }
    Real at(size_t i) const { return sum_[i]; }

private:
    const mirror::Task &task_;
    const mirror::Result &result_;
    const mirror::Features &features_;
    const drogue_result *library_;
    Words own_;
    std::vector<Real> sum_;
};

/* LSB of the ambiguity when each word of the poses that the choice starts from may be off by 4. */
Real ambiguity_error(const mirror::Task &task, const mirror::Features &f)
{
    std::array<reference::Pose, 2> pair;
    reference::Choice choice, moved;
    Real sum = 1;
    if (!reference::poses(f.ideal, task.camera, task.model.rim_radius, pair) ||
        !reference::choose(pair, f.inner.at, task.model.inner_depth, task.camera, choice)) {
        return 0;
    }
    for (size_t i = 0; i < 2; i++) {
        for (size_t k = 0; k < 6; k++) {
            std::array<reference::Pose, 2> other = pair;
            (k < 3 ? other[i].position[k] : other[i].axis[k - 3]) += 4 / 65536.0L;
            if (reference::choose(other, f.inner.at, task.model.inner_depth, task.camera, moved)) {
                sum += 65536 * std::fabs(moved.ambiguity - choice.ambiguity);
            }
        }
    }
    return sum;
}

void poses_more(std::vector<Real> &more, const mirror::Task &task, const mirror::Result &r, const mirror::Features &f,
                const std::array<Real, 5> &ellipse, const drogue_result *library)
{
    Sensitivity s(task, r, f, library);
    Real Ellipse::*const member[5] = {&Ellipse::xc, &Ellipse::yc, &Ellipse::a, &Ellipse::b, &Ellipse::angle};
    for (size_t k = 0; k < 5; k++) {
        s.move([&](mirror::Features &g, Real by) { g.ideal.*member[k] += by; },
               std::min((ELLIPSE_LSB + ellipse[k]) / 65536, std::acos(Real(-1))));
    }
    const Real error = scatter_error(f.support, f.ideal);
    s.move(
        [](mirror::Features &g, Real by) {
            for (Real &sum : g.support.sum) {
                sum *= std::sqrt(std::max<Real>(0, 1 + by));
            }
        },
        error);
    for (size_t k = 0; k < 5 && f.support.pull[k] != 0; k++) { /* to 2^-24, of which half remains */
        s.move([k](mirror::Features &g, Real by) { g.support.pull[k] += by; }, 0x1p-24L);
    }
    for (size_t k = 0; k < 2 && (f.support.smear[0] != 0 || f.support.smear[1] != 0); k++) {
        s.move([k](mirror::Features &g, Real by) { g.support.smear[k] += by; }, SMEAR_LSB / 65536);
    }
    if (f.placed) {
        s.move([](mirror::Features &g, Real by) { g.inner.at.x += by; }, 2 / 65536.0L);
        s.move([](mirror::Features &g, Real by) { g.inner.at.y += by; }, 2 / 65536.0L);
        s.move([](mirror::Features &g, Real by) { g.inner.std += by; }, 3 / 65536.0L);
    }
    if (f.doubt > 0) { /* the disc's size is off by 0.0005 px: a ray more or less steep by a grey level */
        s.move([](mirror::Features &g, Real by) { g.doubt += by; },
               32 / 65536.0L / std::sqrt(r.area / std::acos(Real(-1))));
    }
    if (f.too_far > 0) {
        s.move([](mirror::Features &g, Real by) { g.too_far += by; },
               24 / 65536.0L / std::sqrt(r.area / std::acos(Real(-1))));
    }
    const Words own = words_of(r);
    for (size_t i = POSE; i < RESOLVED; i++) {
        more[i] = s.at(i);
    }
    more[AMBIGUITY] = r.has_inner ? s.at(AMBIGUITY) + ambiguity_error(task, f) : 0;
    for (size_t i = COVARIANCE; i < ALL; i++) {
        more[i] = s.at(i) + std::fabs(static_cast<Real>(own[i])) * 0x1p-20L;
    }
    for (int i = 0, at = COVARIANCE; i < 3;
         i++) { /* the doubt is a share of a position whose words are off by an LSB */
        for (int j = 0; j <= i; j++) {
            const Real far =
                std::fabs(r.pose.position[static_cast<size_t>(i)]) + std::fabs(r.pose.position[static_cast<size_t>(j)]);
            more[static_cast<size_t>(at++)] += std::ldexp(r.doubt * r.doubt / 2 * far / 65536, 48);
        }
    }
    if (!r.resolved) { /* half the square of what lies between two poses, whose words are off by an LSB each and more */
        const reference::Pose &p = r.pose, &q = r.alternative;
        const Real apart[5] = {q.position[0] - p.position[0], q.position[1] - p.position[1],
                               q.position[2] - p.position[2], q.yaw - p.yaw, q.pitch - p.pitch};
        const Real off = 4 / 65536.0L;
        for (int i = 0, at = COVARIANCE; i < 5; i++) {
            for (int j = 0; j <= i; j++) {
                more[static_cast<size_t>(at++)] +=
                    std::ldexp(off * (std::fabs(apart[i]) + std::fabs(apart[j]) + off) / 2, 48);
            }
        }
        for (size_t k = 0; k < 4; k++) {
            const Real std = k < 3 ? r.position_std[k] : r.axis_std;
            const Real most = k < 3 ? std::fabs(apart[k]) : std::fabs(apart[3]) + std::fabs(apart[4]);
            more[STD + k] += std::ldexp(off * (most + off) / std, 32);
        }
    }
}

} // namespace

mirror::Task frame_words::task_of(const std::vector<Array> &in, const std::array<int64_t, 4> &g)
{
    const Words &c = in[1].words, &m = in[2].words;
    mirror::Task t = {
        image_of(in[0]),
        {real(c[0]), real(c[1]), real(c[2]), real(c[3]), real(c[4]), real(c[5]), real(c[6]), real(c[7]), real(c[8])},
        {real(m[0]), real(m[1]), real(m[2])},
        g,
        {},
        {0, CONF_MAX_EDGES, CONF_MAX_LABELS, CONF_MAX_ARCS},
        {},
        {}};
    t.capacity.width_px = static_cast<uint32_t>(t.image.cols); /* as the stage's workspace */
    drogue_config_default(&t.config);
    const auto q = [](int64_t v) { return static_cast<drogue_q16>(v); };
    t.library_camera = {q(c[0]), q(c[1]), q(c[2]), q(c[3]), q(c[4]), q(c[5]), q(c[6]), q(c[7]), q(c[8])};
    t.library_model = {q(m[0]), q(m[1]), q(m[2])};
    return t;
}

namespace {

/* What the mirror follows, from the words of the exact tier. */
drogue_result library_of(const std::vector<Array> &exact)
{
    const Words &w = exact[0].words, &d = exact[1].words;
    drogue_result r = {};
    r.region = {static_cast<int32_t>(d[0]), static_cast<int32_t>(d[1]), static_cast<int32_t>(d[2]),
                static_cast<int32_t>(d[3])};
    r.ellipse.a_px_q16 = static_cast<int32_t>(w[SEEN + 2]);
    r.ellipse.angle_rad_q16 = static_cast<int32_t>(w[SEEN + 4]);
    r.ideal.a_px_q16 = static_cast<int32_t>(w[IDEAL + 2]);
    r.ideal.angle_rad_q16 = static_cast<int32_t>(w[IDEAL + 4]);
    for (size_t k = 0; k < 3; k++) {
        r.pose.position_m_q16[k] = static_cast<int32_t>(w[POSE + k]);
        r.pose.axis_q16[k] = static_cast<int32_t>(w[POSE + 3 + k]);
        r.alternative.position_m_q16[k] = static_cast<int32_t>(w[OTHER + k]);
        r.alternative.axis_q16[k] = static_cast<int32_t>(w[OTHER + 3 + k]);
    }
    return r;
}

/* Region, list, arcs, quality, members, cover, doubt, what is outside, and rays that see the inner part. Edge points and
 * arcs are counted by the front end that the mirror has in common with the library; the stage 'arcs' has a reference
 * of its own for them. */
Expected detail_of(const Array &exact, const mirror::Result &r)
{
    Words w = exact.words;
    std::vector<Real> more(w.size(), EXACTLY);
    if (r.found) {
        const reference::Quality &q = r.outline.quality;
        w[0] = r.region.x;
        w[1] = r.region.y;
        w[2] = r.region.width;
        w[3] = r.region.height;
        for (size_t k = 0; k < 4; k++) {
            w[6 + k] = r.outline.arcs[k] == DROGUE_NO_ARC ? -1 : static_cast<int32_t>(r.outline.arcs[k]);
        }
        size_t at = 10;
        for (const Real v : {q.fit_ratio, q.length_ratio, q.axis_ratio, q.score, q.reliability}) {
            w[at] = q16(v);
            more[at++] = 0;
        }
        w[15] = r.outline.members;
        w[16] = q16(r.outline.cover);
        w[17] = r.status == DROGUE_OK ? q16(r.doubt) : 0;
        more[17] = 0;
        w[18] = r.outline.outside;
        w[19] = r.status == DROGUE_OK && r.has_inner ? static_cast<int>(r.part.rays) : 0;
    }
    return {like(exact, w), bounds("frame", like(exact, w), more)};
}

} // namespace

FrameWords frame_words::of(const mirror::Task &task, const drogue_result &library)
{
    mirror::Features features = {};
    FrameWords out;
    out.result = mirror::measure(task, &library, &features);
    out.words = words_of(out.result);
    out.more.assign(ALL, EXACTLY); /* what is not known is 0 */
    const mirror::Result &r = out.result;
    std::vector<Real> &more = out.more;
    if (r.found) {
        const reference::Camera &c = task.camera;
        const bool lens = c.k1 != 0 || c.k2 != 0 || c.p1 != 0 || c.p2 != 0 || c.k3 != 0;
        const std::array<Real, 5> seen = ellipse_more(r.seen, false), ideal = ellipse_more(r.ideal, lens);
        std::copy(seen.begin(), seen.end(), more.begin() + SEEN);
        if (r.ideal.ok) {
            std::copy(ideal.begin(), ideal.end(), more.begin() + IDEAL);
        }
        if (r.has_inner) {
            more[INNER] = more[INNER + 1] = more[INNER + 4] = 0;
        }
        if (r.status == DROGUE_OK) {
            poses_more(more, task, r, features, ideal, &library);
        }
    }
    return out;
}

std::vector<Expected> frame_tier(const std::vector<Array> &in, const std::vector<Array> &exact)
{
    if (exact[0].words.size() != WORDS || exact[2].name != "covariance" || exact[3].name != "std") {
        throw std::runtime_error("the frame stage's outputs are not those expected");
    }
    const Words &g = in[3].words;
    mirror::Task task = frame_words::task_of(in, {g[0], g[1], g[2], g[3]});
    if (in.size() > 4) {
        const std::vector<int32_t> words(in[4].words.begin(), in[4].words.end());
        conf_config_take(&task.config, words.data());
    }
    const FrameWords f = frame_words::of(task, library_of(exact));
    const auto part = [](const auto &all, size_t from, size_t to) {
        return std::decay_t<decltype(all)>(all.begin() + static_cast<long>(from), all.begin() + static_cast<long>(to));
    };
    const auto expected = [&](const Array &array, size_t from, size_t to) {
        const Array words = like(array, part(f.words, from, to));
        return Expected{words, bounds("frame", words, part(f.more, from, to))};
    };
    return {expected(exact[0], 0, COVARIANCE), detail_of(exact[1], f.result), expected(exact[2], COVARIANCE, STD),
            expected(exact[3], STD, ALL)};
}

} // namespace vectors
