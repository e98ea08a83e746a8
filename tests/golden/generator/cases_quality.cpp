/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of the score of an ellipse, and of the choice among candidates: every threshold met exactly and missed. */
#include <cmath>

#include "case.hpp"
#include "reference.hpp"

namespace vectors {

namespace {

constexpr int64_t ONE = 65536;
constexpr int64_t PI = 205887;
constexpr int64_t HALF_PI = 102944;

int64_t q16(double v) { return static_cast<int64_t>(std::floor(v * 65536 + 0.5)); }

using Words = std::vector<int64_t>;

struct Scored {
    Words ellipse; /* xc yc a b angle */
    Words points;
    int64_t fit_error = ONE, k1 = 6 * ONE, k2 = 19661;
};

void add_scored(Set &set, const std::string &name, Tier tier, const Flags &flags, const Scored &s)
{
    set.add(name, tier, flags,
            {word_array("ellipse", 32, 16, s.ellipse), word_array("points", 32, 16, s.points),
             word_array("params", 32, 16, {s.fit_error, s.k1, s.k2})});
}

/* Points about an ellipse with the given spread across. */
Words points_about(const Words &ellipse, accuracy::Random &random, int count, double spread_px)
{
    Words words;
    const double turn = static_cast<double>(ellipse[4]) / 65536;
    for (int i = 0; i < count; i++) {
        const double t = random.uniform(0, 2 * CV_PI);
        const double off = spread_px * normal(random);
        const double u = (static_cast<double>(ellipse[2]) / 65536 + off) * std::cos(t);
        const double v = (static_cast<double>(ellipse[3]) / 65536 + off) * std::sin(t);
        words.push_back(ellipse[0] + q16(std::cos(turn) * u - std::sin(turn) * v));
        words.push_back(ellipse[1] + q16(std::sin(turn) * u + std::cos(turn) * v));
    }
    return words;
}

void add_ordinary_scores(Set &set)
{
    struct Shape {
        const char *name;
        double xc, yc, a, b, angle;
        int count;
    };
    static const Shape shapes[] = {
        {"round", 200, 180, 80, 80, 0, 60},       {"tilted", 100.3, 99.7, 60.25, 51.5, 0.7, 60},
        {"steep", 64, 70, 40, 22, -1.2, 40},      {"upright", 50, 50, 30, 25, 1.5707, 40},
        {"down", 50, 50, 30, 25, -1.5707, 40},    {"small", 20, 20, 4, 2.5, 0.4, 12},
        {"large", 900, 1000, 900, 850, -0.3, 80}, {"flat", 300, 300, 120, 30, 1.0, 40},
        {"negative", -40, -90, 33, 31, -0.9, 40},
    };
    for (const Shape &s : shapes) {
        accuracy::Random random = set.random(s.name);
        Scored scored;
        scored.ellipse = Words{q16(s.xc), q16(s.yc), q16(s.a), q16(s.b), q16(s.angle)};
        scored.points = points_about(scored.ellipse, random, s.count, 0.8);
        add_scored(set, s.name, Tier::ordinary, s.xc < 0 ? Flags{"rounding-negative"} : Flags{}, scored);
    }
}

/* Scores that lie next to a tie of their rounding, over the whole range of the exponential: they move with the last bits
 * of what they are made of. */
void add_scores_near_ties(Set &set)
{
    for (int k = 0; k < 30; k++) {
        const std::string name = "score-near-tie-" + std::to_string(k);
        accuracy::Random random = set.random(name);
        Scored s;
        double off = 1;
        while (off > 0.002) { /* LSB */
            s.ellipse = Words{0, 0, between(random, 9, 400) * ONE + between(random, 0, 65535), 0, 0};
            s.ellipse[3] =
                ONE + static_cast<int64_t>(random.uniform(0.35, 0.98) * static_cast<double>(s.ellipse[2] - ONE));
            s.points = Words{s.ellipse[2], 0};
            s.k1 = k * ONE * 2 + between(random, 0, 131071);
            s.k2 = between(random, 0, 15000);
            const auto real = [](int64_t word) { return static_cast<reference::Real>(word) / 65536; };
            const reference::Ellipse e = {0, 0, real(s.ellipse[2]), real(s.ellipse[3]), 0};
            const reference::Real score = reference::quality(e, 1, 1, real(s.k1), real(s.k2)).score * 65536;
            const reference::Real length = reference::quality(e, 1, 1, real(s.k1), real(s.k2)).length_ratio * 65536;
            const reference::Real own = score - length / 2; /* the axes' share is rounded alone */
            off = static_cast<double>(std::fabs(own - std::floor(own) - 0.5L));
        }
        add_scored(set, name, Tier::boundary, {"exponential", "half-lsb"}, s);
    }
}

/* Points at many semi-axes' distance magnify the last bits of sine and cosine. */
void add_magnified_angles(Set &set)
{
    for (int k = 0; k < 12; k++) {
        const std::string name = "sine-and-cosine-" + std::to_string(k);
        accuracy::Random random = set.random(name);
        Scored s;
        s.ellipse = Words{between(random, -99999, 99999), between(random, -99999, 99999), ONE + 3 * k, ONE,
                          k == 0   ? HALF_PI
                          : k == 1 ? -HALF_PI
                                   : between(random, -102943, 102943)};
        for (int i = 0; i < 50; i++) {
            const double t = random.uniform(0, 2 * CV_PI);
            s.points.push_back(s.ellipse[0] + q16(15.5 * std::cos(t)));
            s.points.push_back(s.ellipse[1] + q16(15.5 * std::sin(t)));
        }
        add_scored(set, name, Tier::boundary, {"half-lsb"}, s);
    }
}

} // namespace

void add_quality(Set &set)
{
    set.begin("quality");
    add_ordinary_scores(set);
    add_scores_near_ties(set);
    add_magnified_angles(set);
    accuracy::Random random = set.random("quality");
    Scored circle;
    circle.ellipse = Words{100 * ONE, 100 * ONE, 64 * ONE, 64 * ONE, 0};
    /* deviation of (64 + d) px along an axis is 2 d / 64 + (d / 64)^2; thresholds 2 / 64 met, missed by one LSB */
    circle.points = Words{164 * ONE, 100 * ONE, 100 * ONE, 164 * ONE, 36 * ONE,        100 * ONE, 165 * ONE, 100 * ONE,
                          163 * ONE, 100 * ONE, 100 * ONE, 100 * ONE, 164 * ONE + 512, 100 * ONE, 100 * ONE, 35 * ONE};
    add_scored(set, "circle", Tier::ordinary, {}, circle);
    circle.fit_error = 32 * (2 * 1024 + 16); /* threshold equal to the deviation at 65 px: 1 / 32 + 1 / 4096 */
    add_scored(set, "threshold-met", Tier::boundary, {"tie", "threshold-met"}, circle);
    circle.fit_error += 32;
    add_scored(set, "threshold-passed", Tier::boundary, {"tie", "threshold-met"}, circle);
    circle.fit_error = 0;
    add_scored(set, "no-tolerance", Tier::boundary, {"degenerate"}, circle);
    circle.fit_error = 1024 * ONE;
    add_scored(set, "largest-tolerance", Tier::boundary, {"saturation"}, circle);

    Scored s;
    s.ellipse = Words{50 * ONE, 60 * ONE, 45 * ONE, 39 * ONE, 40000};
    s.points = points_about(s.ellipse, random, 30, 0.5);
    for (const int64_t k1 : {INT64_C(0), INT64_C(1), ONE, 64 * ONE}) {
        s.k1 = k1;
        add_scored(set, "decay-" + std::to_string(k1), Tier::boundary, {"exponential"}, s);
    }
    s.k1 = 6 * ONE;
    for (const int64_t k2 :
         {INT64_C(0), INT64_C(56796), INT64_C(56797), INT64_C(56798), ONE - 1}) { /* b / a is 56797 */
        s.k2 = k2;
        add_scored(set, "zero-score-at-" + std::to_string(k2), Tier::boundary, {"threshold-met"}, s);
    }
    s.k2 = 0;
    for (int k = 0; k < 6; k++) { /* the exponential over its whole range */
        s.k1 = (3 + 11 * k) * ONE + 12345;
        s.ellipse[3] = 45 * ONE * (6 - k) / 6 - 777;
        add_scored(set, "exponential-" + std::to_string(k), Tier::ordinary, {"exponential"}, s);
    }
    s = Scored();
    s.ellipse = Words{50 * ONE, 50 * ONE, 12 * ONE, 9 * ONE, -30000};
    s.points = Words{4000 * ONE,  50 * ONE, 50 * ONE,  -9000 * ONE, -32768 * ONE, -32768 * ONE, 32767 * ONE,
                     32767 * ONE, 50 * ONE, 242 * ONE, 242 * ONE,   50 * ONE,     50 * ONE,     50 * ONE};
    add_scored(set, "points-far-away", Tier::stress, {"saturation"}, s);
    s.points = points_about(s.ellipse, random, 200, 0.2);
    add_scored(set, "more-points-than-circumference", Tier::boundary, {"saturation"}, s);
    s.points.resize(2);
    add_scored(set, "single-point", Tier::boundary, {"degenerate"}, s);
    const Words points = {ONE, 0, 3 * ONE, -ONE, 0, 0};
    add_scored(set, "minor-axis-one", Tier::boundary, {"threshold-met"}, {{0, 0, 3 * ONE, ONE, 1000}, points});
    add_scored(set, "minor-axis-below-one", Tier::must_reject, {"threshold-met"},
               {{0, 0, 3 * ONE, ONE - 1, 1000}, points});
    add_scored(set, "minor-above-major", Tier::must_reject, {"domain"}, {{0, 0, 3 * ONE, 3 * ONE + 1, 0}, points});
    add_scored(set, "both-axes-one", Tier::boundary, {"threshold-met"}, {{0, 0, ONE, ONE, 0}, points});
    add_scored(set, "no-axes", Tier::must_reject, {"degenerate", "domain"}, {{0, 0, 0, 0, 0}, points});
    add_scored(set, "circumference-last", Tier::boundary, {"saturation"},
               {{0, 0, 4096 * ONE, 4096 * ONE - 1, 9}, {4096 * ONE, 0, 0, 4096 * ONE, -4096 * ONE, 1}});
    add_scored(set, "circumference-too-long", Tier::boundary, {"saturation"},
               {{0, 0, 4096 * ONE, 4096 * ONE, 9}, {4096 * ONE, 0, 0, 4096 * ONE, -4096 * ONE, 1}});
    for (int k = 0; k < 8; k++) { /* square roots and quotients on both sides of a half */
        const int64_t a = between(random, 3 * 65536, 300 * 65536);
        const int64_t b = ONE + static_cast<int64_t>(random.next() % static_cast<uint64_t>(a - ONE));
        Scored any;
        any.ellipse = Words{between(random, -100000, 9000000), between(random, -100000, 9000000), a, b,
                            between(random, -102944, 102944)};
        any.points = points_about(any.ellipse, random, 25, 1.5);
        any.fit_error = between(random, 10000, 150000);
        any.k1 = between(random, 0, 20 * 65536);
        any.k2 = between(random, 0, 60000);
        add_scored(set, "random-" + std::to_string(k), Tier::ordinary, {}, any);
    }
}

namespace {

/* Two candidates that differ as given, the second less reliable: are they one cluster? */
struct Candidate {
    Words words = {100 * ONE, 90 * ONE, 50 * ONE, 40 * ONE, 20000, 50000, 0};
};

Candidate changed(const std::vector<std::pair<int, int64_t>> &by)
{
    Candidate c;
    c.words[5] = 40000;
    for (const auto &change : by) {
        c.words[static_cast<size_t>(change.first)] += change.second;
    }
    return c;
}

const Words default_config = {3 * ONE, 3 * ONE, 3 * ONE, 13107, 58982};

void add_choice(Set &set, const std::string &name, Tier tier, const Flags &flags,
                const std::vector<Candidate> &candidates, const Words &config = default_config)
{
    Words words;
    for (const Candidate &c : candidates) {
        words.insert(words.end(), c.words.begin(), c.words.end());
    }
    set.add(name, tier, flags, {word_array("candidates", 32, 16, words), word_array("config", 32, 16, config)});
}

/* Each threshold met exactly (another cluster), missed by one LSB (the same), in both directions. */
void add_thresholds(Set &set)
{
    static const char *const members[] = {"x", "y", "major", "minor", "angle"};
    for (int m = 0; m < 5; m++) {
        const int64_t threshold = m < 4 ? 3 * ONE : 13107;
        for (const int64_t sign : {1, -1}) {
            for (const int64_t less : {0, 1}) {
                add_choice(set,
                           std::string(members[m]) + (sign > 0 ? "-more-" : "-less-") + (less ? "within" : "at-limit"),
                           Tier::boundary, {"threshold-met", sign > 0 ? "tie" : "rounding-negative"},
                           {Candidate(), changed({{m, sign * (threshold - less)}})});
            }
        }
    }
}

} // namespace

void add_cluster(Set &set)
{
    set.begin("cluster");
    add_thresholds(set);
    add_choice(set, "none", Tier::must_reject, {"degenerate"}, {});
    add_choice(set, "single", Tier::boundary, {"degenerate"}, {Candidate()});
    add_choice(set, "distance-at-limit", Tier::boundary, {"tie"}, {Candidate(), changed({{0, 117964}, {1, -157286}})},
               {196607, ONE, ONE, 13107, 58982}); /* (117964, 157286) is 196607.3 long */
    add_choice(set, "distance-pythagorean", Tier::boundary, {"tie"},
               {Candidate(), changed({{0, 3 * ONE}, {1, 4 * ONE}})}, {5 * ONE, ONE, ONE, 13107, 58982});
    add_choice(set, "distance-within", Tier::boundary, {"tie"}, {Candidate(), changed({{0, 3 * ONE}, {1, 4 * ONE}})},
               {5 * ONE + 1, ONE, ONE, 13107, 58982});
    add_choice(set, "polarity", Tier::ordinary, {}, {Candidate(), changed({{6, 1}})});
    /* angles modulo pi: from one end of the range to the other */
    Candidate low, high;
    low.words[4] = -HALF_PI + 5;
    high.words[4] = HALF_PI - 13100;
    high.words[5] = 45000;
    add_choice(set, "angle-wrap-within", Tier::boundary, {"angle-wrap"}, {low, high});
    high.words[4] = low.words[4] + PI - 13107;
    add_choice(set, "angle-wrap-at-limit", Tier::boundary, {"angle-wrap", "tie"}, {low, high});
    high.words[4]++;
    add_choice(set, "angle-wrap-one-less", Tier::boundary, {"angle-wrap", "tie"}, {low, high});
    low.words[4] = -HALF_PI / 2;
    high.words[4] = low.words[4] + HALF_PI;
    high.words[4]++;
    add_choice(set, "angle-beyond-quarter-turn", Tier::boundary, {"angle-wrap", "tie"}, {low, high},
               {3 * ONE, 3 * ONE, 3 * ONE, HALF_PI, 58982});
    /* round ones: angles do not count when both ratios exceed the limit */
    for (const int first : {0, 1, 2}) {
        for (const int second : {0, 1, 2}) {
            Candidate i, j;
            i.words[2] = j.words[2] = 50 * ONE;
            i.words[3] = 45 * ONE - 1 + first; /* b / a = 0.9 - , = 0.9, 0.9 + */
            j.words[3] = 45 * ONE - 1 + second;
            j.words[4] += 60000;
            j.words[5] = 30000;
            add_choice(set, "round-" + std::to_string(first) + "-" + std::to_string(second), Tier::boundary,
                       {"near-circle", "tie"}, {i, j}, {3 * ONE, 3 * ONE, 3 * ONE, 13107, 9 * ONE / 10 + 1});
        }
    }
    Candidate exact_round;
    exact_round.words[2] = 64 * ONE;
    exact_round.words[3] = 32 * ONE;
    Candidate turned = exact_round;
    turned.words[4] -= 50000;
    add_choice(set, "round-limit-met", Tier::boundary, {"near-circle", "tie"}, {exact_round, turned},
               {3 * ONE, 3 * ONE, 3 * ONE, 13107, ONE / 2});
    /* equal reliabilities: the larger cluster, then the first */
    Candidate alone, a, b, c;
    alone.words[0] += 40 * ONE;
    a.words[0] += ONE;
    b.words[1] += ONE;
    add_choice(set, "equal-larger-cluster-later", Tier::boundary, {"tie"}, {alone, a, b, c});
    add_choice(set, "equal-larger-cluster-first", Tier::boundary, {"tie"}, {a, b, alone, c});
    add_choice(set, "equal-all-alike", Tier::boundary, {"tie"}, {a, b, c});
    Candidate other = alone;
    other.words[1] -= 30 * ONE;
    add_choice(set, "equal-both-alone", Tier::boundary, {"tie"}, {alone, other});
    Candidate better = other;
    better.words[5]++;
    add_choice(set, "last-is-better", Tier::boundary, {"tie"}, {a, b, c, alone, better});
    add_choice(set, "first-is-better", Tier::boundary, {"tie"}, {better, a, b, c, alone});
    Candidate worst;
    worst.words[5] = 0;
    add_choice(set, "reliability-zero", Tier::boundary, {"degenerate"}, {worst, worst});
    add_choice(
        set, "extremes", Tier::stress, {"saturation"},
        {{{INT32_MIN, INT32_MAX, INT32_MAX, 0, -HALF_PI, 3, 0}}, {{INT32_MAX, INT32_MIN, 0, INT32_MAX, HALF_PI, 3, 0}}},
        {INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX, ONE});
    for (int k = 0; k < 6; k++) {
        const std::string name = "random-" + std::to_string(k);
        accuracy::Random random = set.random(name);
        std::vector<Candidate> candidates(static_cast<size_t>(k == 5 ? 64 : between(random, 3, 30)));
        for (Candidate &v : candidates) {
            for (size_t m = 0; m < 4; m++) {
                v.words[m] += between(random, -200000, 200000);
            }
            v.words[4] = between(random, -102943, 102944);
            v.words[5] = 60000 + between(random, 0, 4);
            v.words[6] = between(random, 0, 1);
        }
        add_choice(set, name, Tier::ordinary, {}, candidates, {4 * ONE, 3 * ONE, 3 * ONE, 60000, 50000});
    }
}

} // namespace vectors
