/* SPDX-License-Identifier: Apache-2.0 */
/* Quality (10)-(15) of fits to arcs, and the winner among their combinations (16), against double. */
#include "geometry.h"
#include "golden.hpp"

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
    double model[5];            /* fit ratio, length ratio, axis ratio, score, reliability */
    double near_low, near_high; /* fit ratio without and with the points within 4 LSB of the threshold */
};

double deviation(const ellipse_real &e, double x, double y)
{
    const double dx = x - e.xc, dy = y - e.yc, c = std::cos(e.angle), s = std::sin(e.angle);
    const double u = (dx * c + dy * s) / e.a, v = (dy * c - dx * s) / e.b;
    return std::fabs(u * u + v * v - 1);
}

/* False when the library fits no ellipse. */
bool score(Scored *out, const std::vector<Points> &arcs, unsigned combination, Report *deviations,
           const std::string &name)
{
    drogue_moments moments;
    drogue_ellipse_frame frame;
    drogue_ellipse *q = &out->candidate.ellipse;
    double low = 0, high = 0, total = 0, worst = 0;
    std::uint32_t near_count = 0;
    drogue_moments_clear(&moments);
    for (unsigned k = 0; k < 4; k++) {
        for (const auto &p : (combination >> k) & 1u ? arcs[k] : Points()) {
            drogue_moments_add_point(&moments, p.first, p.second);
        }
    }
    if (drogue_ellipse_fit(q, &moments, 5) != DROGUE_OK || drogue_ellipse_frame_of(&frame, q) != DROGUE_OK) {
        return false;
    }
    const ellipse_real e = ellipse_from_q16(q);
    const drogue_q16 threshold = drogue_quality_threshold(q, quality_config.fit_error_px_q16);
    const double t = 2.0 / e.a;
    worst = std::fabs(threshold - 65536 * t);
    for (unsigned k = 0; k < 4; k++) {
        for (const auto &p : (combination >> k) & 1u ? arcs[k] : Points()) {
            const drogue_q16 got = drogue_ellipse_deviation(&frame, p.first * 2048, p.second * 2048);
            const double d = deviation(e, p.first / 32.0, p.second / 32.0);
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
    drogue_quality_score(&out->got, q, near_count, (std::uint32_t)total, &quality_config);
    const double ratio = e.b / e.a, k1 = 6, k2 = real_of_q16(quality_config.k2_q16), s = (ratio - k2) / (1 - k2);
    out->near_low = low / total;
    out->near_high = high / total;
    out->model[0] = near_count / total;
    out->model[1] = std::min(1.0, total / (TEST_PI * (3 * (e.a + e.b) - std::sqrt((3 * e.a + e.b) * (e.a + 3 * e.b)))));
    out->model[2] = ratio;
    out->model[3] = out->model[1] / 2 + (s > 0 ? ((s - 1) * std::exp(-k1 * s) + 1) / 2 : 0);
    out->model[4] = (out->model[3] + out->model[0]) / 2;
    out->candidate.reliability_q16 = out->got.reliability_q16;
    out->candidate.polarity = 0;
    out->candidate.arcs = combination;
    return true;
}

bool same(const ellipse_real &p, const ellipse_real &q)
{
    const bool round = p.b > 58982 / 65536.0 * p.a && q.b > 58982 / 65536.0 * q.a;
    return std::hypot(p.xc - q.xc, p.yc - q.yc) < 3 && std::fabs(p.a - q.a) < 3 && std::fabs(p.b - q.b) < 3 &&
           (round || std::fabs(angle_difference(p.angle, q.angle, TEST_PI)) < 13107 / 65536.0);
}

/* Winner and its cluster by real reliabilities; -2 when two are too near to tell apart. */
int model_winner(unsigned *members, const std::vector<Scored> &all)
{
    int best = -1;
    for (int i = 0; i < (int)all.size(); i++) {
        best = best < 0 || all[(std::size_t)i].model[4] > all[(std::size_t)best].model[4] ? i : best;
    }
    *members = 0;
    for (int i = 0; i < (int)all.size(); i++) {
        if (i != best && all[(std::size_t)best].model[4] - all[(std::size_t)i].model[4] < 8 / 65536.0) {
            return -2;
        }
        *members += i == best || same(ellipse_from_q16(&all[(std::size_t)best].candidate.ellipse),
                                      ellipse_from_q16(&all[(std::size_t)i].candidate.ellipse));
    }
    return best;
}

} // namespace

int main()
{
    Report deviations("deviation", 4), fit("fit_ratio", 4), length("length_ratio", 4), axes("axis_ratio", 4);
    Report scores("score", 4), reliability("reliability", 4), near_counts("near_count", 0), winners("winner", 0);
    for (int seed = 1; seed <= 400; seed++) {
        const std::vector<Points> arcs = random_arcs(seed);
        std::vector<Scored> all;
        std::vector<drogue_candidate> candidates;
        for (unsigned combination = 1; combination < 16; combination++) {
            const std::string name = name_of("seed", seed) + " arcs " + std::to_string(combination);
            Scored s = {};
            if (score(&s, arcs, combination, &deviations, name)) {
                fit.add(lsb_from(s.got.fit_ratio_q16, s.model[0]), name);
                length.add(lsb_from(s.got.length_ratio_q16, s.model[1]), name);
                axes.add(lsb_from(s.got.axis_ratio_q16, s.model[2]), name);
                scores.add(lsb_from(s.got.score_q16, s.model[3]), name);
                reliability.add(lsb_from(s.got.reliability_q16, s.model[4]), name);
                near_counts.add(s.model[0] >= s.near_low && s.model[0] <= s.near_high ? 0 : 1, name);
                all.push_back(s);
                candidates.push_back(s.candidate);
            }
        }
        unsigned expected_members;
        std::uint32_t members;
        const int expected = model_winner(&expected_members, all);
        const int got =
            drogue_cluster_best(&members, candidates.data(), (std::uint32_t)candidates.size(), &cluster_config);
        if (expected != -2) {
            winners.add(got == expected && members == expected_members ? 0 : 1, name_of("seed", seed));
        }
    }
    const bool ok[] = {deviations.finish(5000),  fit.finish(5000),    length.finish(5000),
                       axes.finish(5000),        scores.finish(5000), reliability.finish(5000),
                       near_counts.finish(5000), winners.finish(300)};
    return std::all_of(std::begin(ok), std::end(ok), [](bool v) { return v; }) ? EXIT_SUCCESS : EXIT_FAILURE;
}
