/* SPDX-License-Identifier: Apache-2.0 */
/* Quality (10)-(15) of fits to arcs, and the winner among their combinations (16), against double. */
#include "geometry.h"
#include "golden.hpp"
#include "reference.hpp"

#include "drogue/cluster.h"
#include "drogue/ellipse.h"
#include "drogue/quality.h"

namespace {

using Points = std::vector<std::pair<std::int32_t, std::int32_t>>; /* Q5 */

const drogue_quality_config quality_config = {65536, 6 * 65536, 19661};
const drogue_cluster_config cluster_config = {3 * 65536, 3 * 65536, 3 * 65536, 13107, 58982};

/* Four arcs, one a quadrant; now and then one belongs to another ellipse. */
std::vector<Points> random_arcs(int seed)
{
    std::uint64_t rng = 0x0A11u + (std::uint64_t)seed;
    ellipse_real e = {rng_real(&rng, -20, 20), rng_real(&rng, -20, 20), rng_real(&rng, 30, 300), 0, 0};
    std::vector<Points> arcs(4);
    e.b = e.a * rng_real(&rng, 0.6, 1);
    e.angle = rng_real(&rng, -1.5, 1.5);
    const double noise = rng_real(&rng, 0, 1);
    for (int q = 0; q < 4; q++) {
        ellipse_real own = e;
        if (rng_range(&rng, 0, 4) == 0) {
            own.a *= 1.2;
            own.xc += 5;
        }
        const double span = rng_real(&rng, 0.5, 1.5);
        for (int i = 0; i < (int)(span * own.a); i++) {
            double x, y;
            ellipse_point(&x, &y, &own, q * TEST_PI / 2 + i / own.a);
            arcs[(std::size_t)q].emplace_back((std::int32_t)std::lround(32 * (x + noise * rng_normal(&rng))),
                                              (std::int32_t)std::lround(32 * (y + noise * rng_normal(&rng))));
        }
    }
    return arcs;
}

struct Scored {
    drogue_candidate candidate;
    drogue_quality got;
    reference::Quality model;
    long double near_low, near_high; /* fit ratio without and with the points within 4 LSB of the threshold */
};

reference::Ellipse reference_ellipse(const drogue_ellipse &q)
{
    return {real_of_q16(q.xc_px_q16), real_of_q16(q.yc_px_q16), real_of_q16(q.a_px_q16), real_of_q16(q.b_px_q16),
            real_of_q16(q.angle_rad_q16)};
}

/* False when the library fits no ellipse. */
bool score(Scored *out, const std::vector<Points> &arcs, unsigned combination, Report *deviations,
           const std::string &name)
{
    drogue_moments moments;
    drogue_ellipse_frame frame;
    drogue_ellipse *q = &out->candidate.ellipse;
    long double low = 0, high = 0;
    std::uint32_t near_count = 0, total = 0;
    drogue_moments_clear(&moments);
    for (unsigned k = 0; k < 4; k++) {
        for (const auto &p : (combination >> k) & 1u ? arcs[k] : Points()) {
            drogue_moments_add_point(&moments, p.first, p.second);
        }
    }
    if (drogue_ellipse_fit(q, &moments, 5) != DROGUE_OK || drogue_ellipse_frame_of(&frame, q) != DROGUE_OK) {
        return false;
    }
    const reference::Ellipse e = reference_ellipse(*q);
    const drogue_q16 threshold = drogue_quality_threshold(q, quality_config.fit_error_px_q16);
    const double t = (double)reference::deviation_threshold(e, real_of_q16(quality_config.fit_error_px_q16));
    double worst = std::fabs(threshold - 65536 * t);
    for (unsigned k = 0; k < 4; k++) {
        for (const auto &p : (combination >> k) & 1u ? arcs[k] : Points()) {
            const drogue_q16 got = drogue_ellipse_deviation(&frame, p.first * 2048, p.second * 2048);
            const double d = (double)reference::deviation(e, {p.first / 32.0L, p.second / 32.0L});
            if (d < 3) {
                worst = std::max(worst, std::fabs(got - 65536 * d));
            }
            near_count += got < threshold;
            low += d < t - 8 / 65536.0;
            high += d < t + 8 / 65536.0;
            total++;
        }
    }
    deviations->add(worst, name);
    drogue_quality_score(&out->got, q, near_count, total, &quality_config);
    out->model = reference::quality(e, (int)near_count, (int)total, real_of_q16(quality_config.k1_q16),
                                    real_of_q16(quality_config.k2_q16));
    out->near_low = low / total;
    out->near_high = high / total;
    out->candidate.reliability_q16 = out->got.reliability_q16;
    out->candidate.polarity = 0;
    out->candidate.arcs = combination;
    return true;
}

/* Winner and its cluster by real reliabilities; -2 when two are too near to tell apart. */
int model_winner(int *members, const std::vector<Scored> &all)
{
    const reference::ClusterConfig config = {3, 3, 3, real_of_q16(cluster_config.angle_rad_q16),
                                             real_of_q16(cluster_config.round_q16)};
    std::vector<reference::Candidate> candidates;
    for (const Scored &s : all) {
        candidates.push_back({reference_ellipse(s.candidate.ellipse), s.model.reliability, 0});
    }
    const int best = reference::cluster_best(candidates, config, *members);
    for (int i = 0; i < (int)all.size(); i++) {
        if (i != best &&
            all[(std::size_t)best].model.reliability - all[(std::size_t)i].model.reliability < 8 / 65536.0L) {
            return -2;
        }
    }
    return best;
}

} // namespace

int main()
{
    Report deviations("deviation", 4), fit("fit_ratio", 2), length("length_ratio", 2), axes("axis_ratio", 2);
    Report scores("score", 2), reliability("reliability", 2), near_counts("near_count", 0), winners("winner", 0);
    for (int seed = 1; seed <= 400; seed++) {
        const std::vector<Points> arcs = random_arcs(seed);
        std::vector<Scored> all;
        std::vector<drogue_candidate> candidates;
        for (unsigned combination = 1; combination < 16; combination++) {
            const std::string name = name_of("seed", seed) + " arcs " + std::to_string(combination);
            Scored s = {};
            if (score(&s, arcs, combination, &deviations, name)) {
                fit.add(lsb_from(s.got.fit_ratio_q16, s.model.fit_ratio), name);
                length.add(lsb_from(s.got.length_ratio_q16, s.model.length_ratio), name);
                axes.add(lsb_from(s.got.axis_ratio_q16, s.model.axis_ratio), name);
                scores.add(lsb_from(s.got.score_q16, s.model.score), name);
                reliability.add(lsb_from(s.got.reliability_q16, s.model.reliability), name);
                near_counts.add(s.model.fit_ratio >= s.near_low && s.model.fit_ratio <= s.near_high ? 0 : 1, name);
                all.push_back(s);
                candidates.push_back(s.candidate);
            }
        }
        int expected_members;
        std::uint32_t members;
        const int expected = model_winner(&expected_members, all);
        const int got =
            drogue_cluster_best(&members, candidates.data(), (std::uint32_t)candidates.size(), &cluster_config);
        if (expected != -2) {
            winners.add(got == expected && (int)members == expected_members ? 0 : 1, name_of("seed", seed));
        }
    }
    const bool ok[] = {deviations.finish(5000),  fit.finish(5000),    length.finish(5000),
                       axes.finish(5000),        scores.finish(5000), reliability.finish(5000),
                       near_counts.finish(5000), winners.finish(300)};
    return std::all_of(std::begin(ok), std::end(ok), [](bool v) { return v; }) ? EXIT_SUCCESS : EXIT_FAILURE;
}
