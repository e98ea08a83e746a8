/* SPDX-License-Identifier: Apache-2.0 */
/* From edge points to the outline in floating point. Edge points, their subpixel places and arcs are the front end's, which
 * is exact; from there on every number is unrounded, and every threshold is the configuration's. */
#include "outline.hpp"

#include "drogue/inner.h"

#include "../../band_points.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <stdexcept>

#include "decisions.h"

namespace mirror {

using reference::BandPoint;
using reference::Edge;
using reference::Ellipse;
using reference::Point;
using reference::q16;
using reference::Support;

namespace {

constexpr uint32_t NONE = DROGUE_NO_ARC;
constexpr Real SETTLED = 1 / 64.0L; /* px */

/* An edge point and what is decided about it: the library's choice where the margin is below what it resolves. */
BandPoint decide(const Ellipse &e, const reference::Band &band, const Edge &edge, const drogue_edge &q,
                 const drogue_ellipse_frame *frame, const drogue_band *library)
{
    BandPoint p = reference::band_point(e, band, edge);
    band_point own = {};
    if (library == nullptr) {
        return p;
    }
    const bool held = point_holds(&own, frame, library, &q) != 0;
    if (p.undecided(Follow::width(e, band.width), Follow::cosine)) {
        p.held = held;
    }
    if (p.held && held && p.from_next_bin < Follow::angle(e)) {
        p.bin = static_cast<int>(point_bin(&own));
    }
    return p;
}

/* One collection of edge points about an ellipse. */
std::vector<BandPoint> collect(const Ellipse &e, const reference::Band &band, const FrontEnd &front,
                               const decisions_round *library)
{
    std::vector<BandPoint> points;
    drogue_ellipse_frame frame = {};
    if (library != nullptr && drogue_ellipse_frame_of(&frame, &library->ellipse) != DROGUE_OK) {
        library = nullptr;
    }
    for (size_t i = 0; i < front.edges.size(); i++) {
        points.push_back(decide(e, band, front.edges[i], front.workspace.edges[i], &frame,
                                library != nullptr ? &library->band : nullptr));
    }
    return points;
}

Ellipse fit(const std::vector<Point> &points)
{
    std::vector<cv::Point2d> plain;
    for (const Point &p : points) {
        plain.emplace_back(static_cast<double>(p.x), static_cast<double>(p.y));
    }
    return reference::fit(plain);
}

/* The stage on one frame. */
class Finder {
public:
    Finder(const FrontEnd &front, const drogue_mask &mask, const drogue_config &config, const Follow &follow)
        : front_(front), mask_(mask), config_(config), follow_(follow)
    {}
    drogue_status find(Outline &out);
    bool enlarge(Outline &out) const;
    bool settle(Outline &out, const Ellipse &ring, Real band, Real least);
    Real covered(const Ellipse &e, bool follow) const;

private:
    using Arcs = std::array<uint32_t, 4>;
    struct Candidate {
        reference::Candidate rated;
        reference::Quality quality;
        Arcs arcs;
        Real slack; /* by which reliability may differ from the library's */
    };

    bool select();
    Real cover(uint32_t &bright, Real &slack, const Ellipse &e) const;
    bool rate(Candidate &out, const Arcs &arcs) const;
    std::vector<Candidate> candidates() const;
    size_t choose(int &members, const std::vector<Candidate> &all) const;
    bool plausible(const Ellipse &e) const;
    reference::Band band_about(const Ellipse &e) const;
    Outline refine(const Candidate &candidate) const;
    void refit(Outline &o, const decisions_round *rounds, int known) const;
    bool on_ring(Outline &out, const Ellipse &ring, Real least) const;
    void narrow(reference::Band &band, const Support &s, const Ellipse &e) const;
    reference::ClusterConfig cluster() const;

    const FrontEnd &front_;
    const drogue_mask &mask_;
    const drogue_config &config_;
    const Follow &follow_;
    Real band_ = 0; /* half the width of the band about an ellipse; 0: as configured */
    std::array<std::array<uint32_t, DROGUE_ARC_CHOICES>, 4> choices_ = {};
};

bool Finder::select()
{
    std::vector<reference::Verdict> verdicts;
    std::vector<int> counts;
    bool any = false;
    for (uint32_t i = 0; i < front_.list.arc_count; i++) {
        const drogue_arc &arc = front_.workspace.arcs[i];
        std::vector<cv::Point> pixels;
        for (uint32_t k = arc.first; k < arc.first + arc.count; k++) {
            const drogue_edge *e = &front_.workspace.edges[k];
            pixels.emplace_back(drogue_edge_x_px(e), drogue_edge_y_px(e));
        }
        verdicts.push_back(reference::judge_arc(pixels, mask_.centre2_x, mask_.centre2_y,
                                                static_cast<int>(arc.direction), config_.min_short_px_q16));
        counts.push_back(static_cast<int>(arc.count));
    }
    const reference::Choices chosen = reference::select_arcs(verdicts, counts, config_.polarity);
    for (size_t q = 0; q < 4; q++) {
        for (size_t i = 0; i < 2; i++) {
            choices_[q][i] = chosen[q][i] < 0 ? NONE : static_cast<uint32_t>(chosen[q][i]);
            any = any || chosen[q][i] >= 0;
        }
    }
    return any;
}

bool Finder::plausible(const Ellipse &e) const
{
    return e.ok && e.b >= e.a * real(config_.min_axis_ratio_q16) &&
           e.a >= real(config_.min_size_q16) * mask_.longest_px && e.a <= real(config_.max_size_q16) * mask_.longest_px;
}

reference::Band Finder::band_about(const Ellipse &e) const
{
    const Real share = std::min<Real>(8, real(config_.search_band_q16) * e.a);
    return {band_ > 0 ? band_ : std::max(real(config_.refit_band_px_q16), share), real(config_.refit_cos_q16)};
}

/* Covered share of an ellipse by some of all edge points; 'slack' is what undecided points and bins could change. */
Real Finder::cover(uint32_t &bright, Real &slack, const Ellipse &e) const
{
    const size_t stride = front_.edges.size() / 512 + 1;
    const reference::Band band = band_about(e);
    Support with, without;
    for (size_t i = 0; i < front_.edges.size(); i += stride) {
        const BandPoint p = reference::band_point(e, band, front_.edges[i]);
        const bool unsure = p.undecided(Follow::width(e, band.width), Follow::cosine);
        const bool torn = p.from_next_bin < Follow::angle(e);
        if (p.held || unsure) {
            reference::support_add(with, p, front_.edges[i]);
        }
        if (p.held && !unsure && !torn) {
            reference::support_add(without, p, front_.edges[i]);
        }
    }
    Support own;
    for (size_t i = 0; i < front_.edges.size(); i += stride) {
        const BandPoint p = reference::band_point(e, band, front_.edges[i]);
        if (p.held) {
            reference::support_add(own, p, front_.edges[i]);
        }
    }
    for (Support *s : {&own, &with, &without}) {
        reference::support_judge(*s, e, config_.polarity, static_cast<int>(stride));
    }
    bright = own.bright;
    const int most = std::max({own.covered, with.covered, without.covered}),
              least = std::min({own.covered, with.covered, without.covered});
    slack = static_cast<Real>(most - least) / reference::SUPPORT_BINS;
    return static_cast<Real>(own.covered) / reference::SUPPORT_BINS;
}

/* Fit and score the union of arcs; false when it is no candidate. */
bool Finder::rate(Candidate &out, const Arcs &arcs) const
{
    std::vector<Point> points;
    for (const uint32_t index : arcs) {
        for (uint32_t k = 0; index != NONE && k < front_.workspace.arcs[index].count; k++) {
            points.push_back(front_.edges[front_.workspace.arcs[index].first + k].at);
        }
    }
    const Ellipse e = fit(points);
    if (!plausible(e) || e.b < 1) {
        return false;
    }
    const Real error = std::max(e.a * real(config_.search_band_q16), real(config_.quality.fit_error_px_q16));
    const Real threshold = reference::deviation_threshold(e, error), total = static_cast<Real>(points.size());
    Real near_count = 0, unsure = 0, slack = 0;
    for (const Point &p : points) {
        const Real d = reference::deviation(e, p);
        near_count += d < threshold;
        unsure += std::fabs(d - threshold) < 8 / 65536.0L;
    }
    uint32_t bright = 0;
    const Real covered = cover(bright, slack, e);
    out.quality = reference::quality_of_cover(e, near_count / total, covered, real(config_.quality.k1_q16),
                                              real(config_.quality.k2_q16));
    out.rated = {e, real(q16(out.quality.reliability)), static_cast<int>(bright)}; /* equal in Q16 is equal */
    out.arcs = arcs;
    out.slack = Follow::score + unsure / total / 2 + slack / 4;
    return out.quality.fit_ratio >= real(config_.min_fit_ratio_q16);
}

std::vector<Finder::Candidate> Finder::candidates() const
{
    std::vector<Candidate> all;
    Candidate c;
    const Arcs firsts = {choices_[0][0], choices_[1][0], choices_[2][0], choices_[3][0]};
    if (rate(c, firsts)) {
        all.push_back(c);
        if (c.quality.length_ratio >= 0.9L) {
            return all;
        }
    }
    for (size_t k = 0; k < 4; k++) {
        for (size_t l = k + 1; l < 4; l++) {
            for (const uint32_t first : choices_[k]) {
                for (const uint32_t second : choices_[l]) {
                    Arcs arcs = {NONE, NONE, NONE, NONE};
                    arcs[k] = first;
                    arcs[l] = second;
                    if (first != NONE && second != NONE && arcs != firsts && rate(c, arcs)) {
                        all.push_back(c);
                    }
                }
            }
        }
    }
    return all;
}

reference::ClusterConfig Finder::cluster() const
{
    const drogue_cluster_config &c = config_.cluster;
    return {real(c.centre_px_q16), real(c.a_px_q16), real(c.b_px_q16), real(c.angle_rad_q16), real(c.round_q16)};
}

/* The winner; among those that reliability cannot tell apart, the one that the library took. */
size_t Finder::choose(int &members, const std::vector<Candidate> &all) const
{
    std::vector<reference::Candidate> rated;
    for (const Candidate &c : all) {
        rated.push_back(c.rated);
    }
    size_t best = static_cast<size_t>(reference::cluster_best(rated, cluster(), members));
    if (follow_.library != nullptr) {
        for (size_t i = 0; i < all.size(); i++) {
            if (std::equal(all[i].arcs.begin(), all[i].arcs.end(), follow_.library->arcs) &&
                all[i].rated.reliability + all[i].slack + all[best].slack >= all[best].rated.reliability) {
                best = i;
            }
        }
        members = 0;
        for (const Candidate &c : all) {
            members += &c == &all[best] || reference::same_ellipse(all[best].rated, c.rated, cluster());
        }
    }
    return best;
}

/* Band for the next round: three spreads of the points, from a third of the configured width to the last one. */
void Finder::narrow(reference::Band &band, const Support &s, const Ellipse &e) const
{
    const Real spread = s.points > 0 ? 3 * e.a * std::sqrt(s.squares / s.points) : 0;
    if (spread < band.width) {
        band.width = std::max(spread, (config_.refit_band_px_q16 / 3 + 1) / 65536.0L);
    }
}

Outline Finder::refine(const Candidate &candidate) const
{
    Outline o;
    decisions_round rounds[DECISIONS_MAX];
    const int known = follow_.library != nullptr ? decisions_of_refit(rounds, &front_.workspace, &front_.list, &mask_,
                                                                      &config_, candidate.arcs.data())
                                                 : 0;
    o.arcs = candidate.arcs;
    o.quality = candidate.quality;
    o.ellipse = candidate.rated.ellipse;
    o.support.bright = static_cast<uint32_t>(candidate.rated.polarity);
    refit(o, rounds, known);
    return o;
}

/* Bins about an ellipse as bins about one with another angle: a nearly round one may turn by any, as it settles. */
void turn_bins(Support &s, Real from, Real to)
{
    const auto n = static_cast<long>(s.count.size());
    const long turn = std::lround((to - from) * static_cast<Real>(n) / (2 * std::acos(Real(-1))));
    const size_t by = static_cast<size_t>(((turn % n) + n) % n);
    std::rotate(s.count.begin(), s.count.begin() + static_cast<long>(by), s.count.end());
    std::rotate(s.sum.begin(), s.sum.begin() + static_cast<long>(by), s.sum.end());
    s.bright = by == 0 ? s.bright : s.bright >> by | s.bright << (static_cast<size_t>(n) - by);
}

/* Collect and fit until it settles, with what the library decided where that is known. */
void Finder::refit(Outline &o, const decisions_round *rounds, int known) const
{
    reference::Band band = band_about(o.ellipse);
    bool done = false;
    Real collected = o.ellipse.angle;
    for (int round = 0; round <= static_cast<int>(config_.refit_rounds) && !done; round++) {
        const decisions_round *library = round < known ? &rounds[round] : nullptr;
        const std::vector<BandPoint> points = collect(o.ellipse, band, front_, library);
        collected = o.ellipse.angle;
        const int left = static_cast<int>(config_.refit_rounds) - round; /* the last two fits are to all points */
        const size_t every = front_.edges.size() / 512 + 1;
        const size_t stride = (round == 0 && left > 0) || (left > 2 && every > 8) ? every : 1;
        std::vector<Point> members;
        Support s;
        s.bright = o.support.bright;
        for (size_t i = 0; i < points.size(); i += stride) {
            if (points[i].held && reference::support_add(s, points[i], front_.edges[i])) {
                members.push_back(front_.edges[i].at);
            }
        }
        const uint32_t summed = s.bright;
        reference::support_judge(s, o.ellipse, config_.polarity, static_cast<int>(stride));
        const bool last = round == static_cast<int>(config_.refit_rounds), turned = s.bright != summed;
        if (last && turned) {
            reference::support_judge_as(s, o.ellipse, summed, 1);
        }
        o.support = s;
        o.band = band.width;
        if (last || turned) { /* turned: once more, with the polarities that the counts show */
            continue;
        }
        const Ellipse e = fit(members);
        if (!plausible(e)) {
            if (stride > 1) {
                continue;
            }
            break;
        }
        const Real width = band.width;
        narrow(band, s, e);
        const Real moved = std::max({std::fabs(e.xc - o.ellipse.xc), std::fabs(e.yc - o.ellipse.yc),
                                     std::fabs(e.a - o.ellipse.a), std::fabs(e.b - o.ellipse.b)});
        const bool unsure = std::fabs(moved - SETTLED) < Follow::score ||
                            (moved <= SETTLED && width - band.width < Follow::width(e, width));
        done = moved <= SETTLED && width - band.width < 1 / 65536.0L && stride == 1;
        if (known > 0 && unsure) {
            done = round + 1 >= known;
        }
        o.ellipse = e;
        o.refit_points = static_cast<int64_t>(members.size());
    }
    turn_bins(o.support, collected, o.ellipse.angle);
    o.cover = static_cast<Real>(o.support.covered) / reference::SUPPORT_BINS;
    o.polarity = o.support.bright == 0            ? DROGUE_POLARITY_DARK
                 : o.support.bright == UINT32_MAX ? DROGUE_POLARITY_BRIGHT
                                                  : DROGUE_POLARITY_BOTH;
}

/* Of the eight parts of an outline those that have a covered bin. */
int parts_of(const Outline &o)
{
    int parts = 0;
    for (int part = 0; part < 8; part++) {
        bool covered = false;
        for (int k = 4 * part; k < 4 * part + 4; k++) {
            const auto &count = o.support.count[static_cast<size_t>(k)];
            covered = covered || count[o.support.bright >> k & 1] >= reference::support_needed(o.ellipse, k);
        }
        parts += covered;
    }
    return parts;
}

/* Refit about an ellipse; false when less than so much of it, or of the outline, is covered. */
bool Finder::on_ring(Outline &out, const Ellipse &ring, Real least) const
{
    Real slack = 0;
    uint32_t bright = 0;
    if (cover(bright, slack, ring) < least) {
        return false;
    }
    decisions_round rounds[DECISIONS_MAX];
    const drogue_ellipse start = {q16(ring.xc), q16(ring.yc), q16(ring.a), q16(ring.b), q16(ring.angle)};
    const int known = follow_.library != nullptr ? decisions_of_ring(rounds, &front_.workspace, &front_.list, &mask_,
                                                                     &config_, &start, q16(band_), bright)
                                                 : 0;
    out.ellipse = ring;
    out.support.bright = bright;
    refit(out, rounds, known);
    return out.cover >= least;
}

bool Finder::enlarge(Outline &out) const
{
    Ellipse ring = out.fitted;
    Outline best = out;
    best.cover = 0;
    for (int k = 0; k < 14; k++) {
        Outline trial = out;
        ring.a += ring.a / 40;
        ring.b += ring.b / 40;
        if (!plausible(ring)) {
            break;
        }
        if (on_ring(trial, ring, real(config_.min_cover_q16)) && trial.cover >= best.cover &&
            trial.ellipse.b * 50 > out.fitted.b * 51) {
            best = trial;
        }
    }
    if (best.cover == 0) {
        return false;
    }
    out = best;
    return true;
}

bool Finder::settle(Outline &out, const Ellipse &ring, Real band, Real least)
{
    band_ = band;
    out = Outline();
    out.arcs.fill(NONE);
    if (!plausible(ring) || !on_ring(out, ring, least) ||
        (out.cover < real(config_.min_cover_q16) && parts_of(out) < 7)) {
        return false;
    }
    out.quality = reference::quality_of_cover(out.ellipse, 1, out.cover, real(config_.quality.k1_q16),
                                              real(config_.quality.k2_q16));
    out.members = 1;
    return true;
}

Real Finder::covered(const Ellipse &e, bool follow) const
{
    if (!plausible(e)) {
        return 0;
    }
    const reference::Band band = band_about(e);
    const decisions_round library = {{q16(e.xc), q16(e.yc), q16(e.a), q16(e.b), q16(e.angle)},
                                     drogue_band_of(q16(band.width), config_.refit_cos_q16)};
    const std::vector<BandPoint> points = collect(e, band, front_, follow ? &library : nullptr);
    const size_t stride = front_.edges.size() / DROGUE_OUTLINE_LOOKS + 1;
    Support s;
    for (size_t i = 0; i < points.size(); i += stride) {
        if (points[i].held) {
            reference::support_add(s, points[i], front_.edges[i]);
        }
    }
    reference::support_judge(s, e, config_.polarity, static_cast<int>(stride));
    return static_cast<Real>(s.covered) / reference::SUPPORT_BINS;
}

/* The most reliable candidate, refined; while it covers little, the next that differ, and the one that covers most. */
drogue_status Finder::find(Outline &out)
{
    if (front_.status != DROGUE_OK || front_.edges.empty()) {
        return front_.status != DROGUE_OK ? front_.status : DROGUE_E_NO_EDGES;
    }
    if (!select()) {
        return DROGUE_E_NO_ARCS;
    }
    std::vector<Candidate> all = candidates();
    out.cover = -1;
    for (int tries = 0; tries < 3 && out.cover < 0.75L && !all.empty(); tries++) {
        int members = 0;
        const Candidate chosen = all[choose(members, all)];
        Outline trial = refine(chosen);
        trial.members = members;
        if (trial.cover > out.cover) {
            out = trial;
        }
        all.erase(std::remove_if(all.begin(), all.end(),
                                 [&](const Candidate &c) {
                                     return c.arcs == chosen.arcs ||
                                            reference::same_ellipse(c.rated, chosen.rated, cluster());
                                 }),
                  all.end());
    }
    if (out.cover < real(config_.min_cover_q16)) {
        return DROGUE_E_NO_ELLIPSE;
    }
    return DROGUE_OK;
}

} // namespace

void number(FrontEnd &front)
{
    front.edges.clear();
    for (uint32_t i = 0; i < front.list.edge_count; i++) {
        const drogue_edge &e = front.workspace.edges[i];
        front.edges.push_back({{static_cast<Real>(e.x_q5) / 32, static_cast<Real>(e.y_q5) / 32},
                               static_cast<Real>(e.gx),
                               static_cast<Real>(e.gy)});
    }
}

std::unique_ptr<FrontEnd> run_front_end(const cv::Mat &view, const drogue_mask &mask, const drogue_config &config,
                                        const drogue_capacity &capacity)
{
    auto out = std::make_unique<FrontEnd>();
    drogue_frontend frontend;
    drogue_frontend_config front = {};
    front.canny_low = config.canny_low;
    front.canny_high = config.canny_high;
    front.smooth = config.smooth;
    front.use_ring = 1;
    front.ring = mask;
    front.min_arc_px = std::max(
        config.min_arc_px, static_cast<uint32_t>(std::floor(real(config.min_arc_share_q16) * mask.longest_px + 0.5L)));
    out->memory.resize(drogue_workspace_bytes(&capacity) / 4 + 1);
    if (drogue_workspace_init(&out->workspace, out->memory.data(), out->memory.size() * 4, &capacity) != DROGUE_OK ||
        drogue_frontend_begin(&frontend, &out->workspace, &front, view.cols, view.rows) != DROGUE_OK) {
        throw std::runtime_error("the front end does not start");
    }
    for (int y = 0; y < view.rows; y++) {
        drogue_frontend_row(&frontend, view.ptr<uint8_t>(y));
    }
    out->status = drogue_frontend_end(&out->list, &frontend);
    number(*out);
    return out;
}

void look_beyond(FrontEnd &front, const cv::Mat &view, const drogue_ellipse &about, drogue_q16 beyond_px_q16)
{
    const drogue_image image = {view.data, view.cols, view.rows, static_cast<int32_t>(view.step)};
    front.list = {beyond_px_q16 > 0 ? drogue_inner_beyond(&front.workspace, &image, &about, beyond_px_q16)
                                    : drogue_inner_along(&front.workspace, &image, &about),
                  0};
    number(front);
}

/* As fitted and with what blur took put back. */
static void finish(Outline &out, const drogue_config &config)
{
    out.fitted = out.ellipse;
    undo_blur(out.ellipse, config);
}

drogue_status find_outline(Outline &out, const FrontEnd &front, const drogue_mask &mask, const drogue_config &config,
                           const Follow &follow)
{
    out.arcs.fill(NONE);
    out.cover = -1;
    const drogue_status status = Finder(front, mask, config, follow).find(out);
    if (out.cover < 0) { /* no candidate */
        out.cover = 0;
        out.ellipse = {0, 0, 0, 0, 0, false};
    } else {
        finish(out, config);
    }
    return status;
}

bool enlarge(Outline &out, const FrontEnd &front, const drogue_mask &mask, const drogue_config &config,
             const Follow &follow)
{
    if (!Finder(front, mask, config, follow).enlarge(out)) {
        return false;
    }
    finish(out, config);
    return true;
}

Real covered(const Ellipse &e, const FrontEnd &front, const drogue_mask &mask, const drogue_config &config, bool follow)
{
    return Finder(front, mask, config, {nullptr}).covered(e, follow);
}

bool settle(Outline &out, const drogue_ellipse &ring, drogue_q16 band_px_q16, drogue_q16 least_cover_q16,
            const FrontEnd &front, const drogue_mask &mask, const drogue_config &config, const Follow &follow)
{
    const Ellipse start = {real(ring.xc_px_q16), real(ring.yc_px_q16),     real(ring.a_px_q16),
                           real(ring.b_px_q16),  real(ring.angle_rad_q16), true};
    if (!Finder(front, mask, config, follow).settle(out, start, real(band_px_q16), real(least_cover_q16))) {
        return false;
    }
    finish(out, config);
    return true;
}

Ellipse ideal_of(const Outline &outline, const FrontEnd &front, const drogue_config &config, const Follow &follow,
                 const reference::Camera &camera, cv::Point origin)
{
    const Ellipse none = {0, 0, 0, 0, 0, false};
    Point centre = {outline.fitted.xc + origin.x, outline.fitted.yc + origin.y};
    if (!reference::undistort(camera, centre)) {
        return none;
    }
    decisions_round library = {};
    if (follow.library != nullptr) {
        library.ellipse = follow.library->fitted;
        library.band = drogue_band_of(follow.library->band_px_q16, config.refit_cos_q16);
    }
    const std::vector<BandPoint> points = collect(outline.fitted, {outline.band, real(config.refit_cos_q16)}, front,
                                                  follow.library != nullptr ? &library : nullptr);
    std::vector<Point> straight;
    size_t members = 0;
    for (size_t i = 0; i < points.size(); i++) {
        if (!points[i].held || static_cast<int>(outline.support.bright >> points[i].bin & 1) != points[i].polarity) {
            continue;
        }
        Point q = {front.edges[i].at.x + origin.x, front.edges[i].at.y + origin.y};
        members++;
        if (reference::undistort(camera, q)) {
            straight.push_back(q);
        }
    }
    Ellipse e = fit(straight);
    if (!e.ok || 4 * straight.size() < 3 * members || e.b < e.a * real(config.min_axis_ratio_q16) || e.b < 1) {
        return none;
    }
    if (!outline.outer) {
        put_back(e, turned(outline.support.pull, e.angle - outline.fitted.angle));
    }
    undo_blur(e, config);
    return e;
}

} // namespace mirror
