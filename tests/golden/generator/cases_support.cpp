/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of the support of an ellipse: polarity round the outline, gaps, the band's limits, bins, strides. */
#include <cmath>
#include <functional>

#include "case.hpp"

namespace vectors {

namespace {

int64_t q16(double v) { return static_cast<int64_t>(std::floor(v * 65536 + 0.5)); }

struct Oval {
    double xc = 120, yc = 110, a = 60, b = 52, angle = 0.4;
};

struct Job {
    Oval oval;
    std::vector<int64_t> edges; /* x_q5 y_q5 gx gy */
    double width = 1.5, cosine = 0.87;
    int stride = 1, polarity = 2;

    void add(double x, double y, double gx, double gy)
    {
        edges.insert(edges.end(),
                     {static_cast<int64_t>(std::floor(32 * x + 0.5)), static_cast<int64_t>(std::floor(32 * y + 0.5)),
                      static_cast<int64_t>(std::floor(gx + 0.5)), static_cast<int64_t>(std::floor(gy + 0.5))});
    }
};

void add_job(Set &set, const std::string &name, Tier tier, const Flags &flags, const Job &j)
{
    const Oval &o = j.oval;
    set.add(name, tier, flags,
            {word_array("ellipse", 32, 16, {q16(o.xc), q16(o.yc), q16(o.a), q16(o.b), q16(o.angle)}),
             word_array("edges", 32, 5, j.edges),
             word_array("params", 32, 16, {q16(j.width), q16(j.cosine), j.stride, j.polarity})});
}

/* An edge point off the oval by 'off' px along its normal, whose gradient is turned from it; strength < 0: inward. */
void put(Job &j, const Oval &o, double t, double off, double turn, double strength)
{
    const double c = std::cos(o.angle), s = std::sin(o.angle);
    const double nx = std::cos(t) / o.a, ny = std::sin(t) / o.b, n = std::hypot(nx, ny);
    const double u = o.a * std::cos(t) + off * nx / n, v = o.b * std::sin(t) + off * ny / n;
    const double gx = (c * nx - s * ny) / n * strength, gy = (s * nx + c * ny) / n * strength;
    j.add(o.xc + c * u - s * v, o.yc + s * u + c * v, std::cos(turn) * gx - std::sin(turn) * gy,
          std::sin(turn) * gx + std::cos(turn) * gy);
}

/* Edge points round the oval; strength as a function of the eccentric angle, 0: none there. */
void round_oval(Job &j, accuracy::Random &random, double noise, double density,
                const std::function<double(double)> &strength)
{
    const Oval o = j.oval;
    const int count = static_cast<int>(density * 2 * CV_PI * o.a);
    for (int i = 0; i < count; i++) {
        const double t = 2 * CV_PI * i / count;
        const double off = noise * normal(random);
        const double turn = 0.1 * normal(random);
        if (strength(t) != 0) {
            put(j, o, t, off, turn, strength(t));
        }
    }
}

void add_polarities(Set &set)
{
    struct Ring {
        const char *name;
        std::function<double(double)> strength;
    };
    static const Ring rings[] = {
        {"dark", [](double) { return 300; }},
        {"bright", [](double) { return -300; }},
        {"half-and-half", [](double t) { return t < CV_PI ? 300 : -300; }},
        {"one-quarter-bright", [](double t) { return t < CV_PI / 2 ? -300 : 300; }},
        {"four-changes", [](double t) { return std::fmod(t, CV_PI) < CV_PI / 2 ? 300 : -300; }},
        {"changes-in-every-bin", [](double t) { return static_cast<int>(t * 16 / CV_PI) % 2 == 0 ? 300 : -300; }},
        {"few-bright-bins", [](double t) { return t > 1 && t < 1.3 ? -300 : 300; }},
        {"dark-with-a-gap", [](double t) { return t > 2 && t < 3.5 ? 0 : 300; }},
        {"change-across-a-gap", [](double t) { return t > 2 && t < 3.5 ? 0
                                                      : t < 2          ? 300
                                                                       : -300; }},
        {"quarter-alone", [](double t) { return t > 4 && t < 5.6 ? -300 : 0; }},
        {"nothing", [](double) { return 0; }},
    };
    for (const Ring &ring : rings) {
        for (int polarity = 0; polarity < 3; polarity++) {
            const std::string name = std::string(ring.name) + (polarity == 0   ? "-as-dark"
                                                               : polarity == 1 ? "-as-bright"
                                                                               : "");
            if (polarity < 2 && ring.name != std::string("half-and-half") && ring.name != std::string("dark")) {
                continue;
            }
            accuracy::Random random = set.random(name);
            Job j;
            j.polarity = polarity;
            round_oval(j, random, 0.3, 0.9, ring.strength);
            add_job(set, name, Tier::ordinary, {"polarity"}, j);
        }
    }
    accuracy::Random random = set.random("both-at-once");
    Job j;
    round_oval(j, random, 0.2, 0.9, [](double) { return 300; });
    round_oval(j, random, 0.2, 0.9, [](double t) { return t < 4 ? -200 : 0; });
    add_job(set, "both-at-once", Tier::boundary, {"polarity", "tie"}, j);
}

void add_shapes(Set &set)
{
    struct Shape {
        const char *name;
        Oval oval;
        double width, noise;
        Flags flags;
    };
    static const Shape shapes[] = {
        {"small", {20, 20, 8, 6.5, -0.7}, 1.5, 0.2, {}},
        {"circle", {100, 90, 50, 50, 0}, 1.5, 0.3, {"near-circle"}},
        {"nearly-a-circle", {100, 90, 50, 49.9, 1.2}, 1.5, 0.3, {"near-circle"}},
        {"flat", {120, 110, 90, 37, 1.1}, 1.5, 0.4, {}},
        {"upright", {120, 110, 60, 45, 1.5707}, 1.5, 0.3, {"angle-wrap"}},
        {"lying", {120, 110, 60, 45, -1.5707}, 1.5, 0.3, {"angle-wrap"}},
        {"large", {1020, 1000, 640, 590, 0.3}, 8, 2, {}},
        {"wide-band", {120, 110, 60, 52, 0.4}, 8, 2.5, {}},
        {"narrow-band", {120, 110, 60, 52, 0.4}, 0.05, 0.05, {}},
        {"a-twentieth-of-a-pixel", {120, 110, 60, 52, 0.4}, 0.5, 0.05, {}},
    };
    for (const Shape &shape : shapes) {
        accuracy::Random random = set.random(shape.name);
        Job j;
        j.oval = shape.oval;
        j.width = shape.width;
        round_oval(j, random, shape.noise, shape.oval.a > 500 ? 0.3 : 0.85, [](double) { return 250; });
        add_job(set, shape.name, Tier::ordinary, shape.flags, j);
    }
    for (const int stride : {2, 3, 7}) {
        const std::string name = "stride-" + std::to_string(stride);
        accuracy::Random random = set.random(name);
        Job j;
        j.stride = stride;
        round_oval(j, random, 0.3, 0.8, [](double t) { return t < 2 ? 0 : 300; });
        add_job(set, name, Tier::ordinary, {}, j);
    }
}

/* So many points in every bin as just do and do not cover it; the bins' length is a pixel's multiple of them. */
void add_cover(Set &set)
{
    for (const int per_bin : {1, 2, 3, 4, 5, 6}) {
        Job j;
        j.oval = {120, 110, 60, 45, 0};
        for (int k = 0; k < 32; k++) {
            for (int i = 0; i < per_bin; i++) {
                put(j, j.oval, (k + (i + 1.0) / (per_bin + 1)) * CV_PI / 16, 0, 0, k % 8 < 4 ? 200 : -200);
            }
        }
        add_job(set, "points-a-bin-" + std::to_string(per_bin), Tier::boundary, {"threshold-met"}, j);
        j.polarity = 0;
        add_job(set, "dark-points-a-bin-" + std::to_string(per_bin), Tier::boundary, {"threshold-met"}, j);
    }
}

void add_limits(Set &set)
{
    Job j;
    j.oval.angle = 0;
    for (int i = -24; i <= 24; i++) { /* across the band at the ends of the axes, in steps of the edge list's unit */
        for (int q = 0; q < 4; q++) {
            put(j, j.oval, q * CV_PI / 2, i / 8.0 * 1.5 / 3, 0, 300);
        }
        for (int n = 0; n < 8; n++) {
            put(j, j.oval, 0.3 + n * 0.77, 1.5 + i / 32.0, 0, 300);
        }
    }
    add_job(set, "distance-limit", Tier::boundary, {"threshold-met"}, j);
    Job turned;
    for (int i = -20; i <= 20; i++) { /* about 29.5 degrees */
        for (int n = 0; n < 6; n++) {
            put(turned, turned.oval, n * 1.05 + i * 0.011, 0, 0.5159 + i * 0.004, i % 2 == 0 ? 900 : -900);
            put(turned, turned.oval, n * 1.05 + 0.4 + i * 0.011, 0, -0.5159 + i * 0.004, 60);
        }
    }
    add_job(set, "direction-limit", Tier::boundary, {"threshold-met"}, turned);
    turned.cosine = 0;
    add_job(set, "any-direction", Tier::boundary, {"direction-class"}, turned);
    turned.cosine = 1;
    add_job(set, "exact-direction", Tier::boundary, {"direction-class"}, turned);
    Job bins;
    bins.oval = {128, 128, 64, 64, 0};
    for (int k = 0; k < 32; k++) { /* on the limits of the bins and beside them */
        for (const double beside : {-1e-3, 0.0, 1e-3}) {
            put(bins, bins.oval, k * CV_PI / 16 + beside, 0, 0, 100 + k);
        }
    }
    for (const int x : {-1, 1}) {
        bins.add(128 + 64 * x, 128, 200.0 * x, 0);
        bins.add(128, 128 + 64 * x, 0, 200.0 * x);
        for (const int y : {-1, 1}) { /* diagonals */
            bins.add(128 + 45.25 * x, 128 + 45.25 * y, 100.0 * x, 100.0 * y);
        }
    }
    add_job(set, "bin-limits", Tier::boundary, {"sector-boundary"}, bins);
    Job far;
    for (const double x : {0.0, 40.0, 119.0, 120.0, 121.0, 600.0, 2047.0}) {
        for (const double y : {0.0, 60.0, 109.0, 110.0, 111.0, 700.0, 2047.0}) {
            far.add(x, y, 255, -255);
        }
    }
    far.width = 8;
    add_job(set, "far-and-within", Tier::stress, {"saturation"}, far);
    far.oval = {5, 5, 2, 1, 0.5};
    far.add(7, 5, 1020, 0);
    add_job(set, "least-ellipse", Tier::boundary, {"threshold-met", "saturation"}, far);
    far.oval.b = 1 - 1.0 / 65536;
    add_job(set, "below-a-pixel", Tier::must_reject, {"domain", "threshold-met"}, far);
    far.oval = {100, 100, 40, 40 + 1.0 / 65536, 0};
    add_job(set, "minor-above-major", Tier::must_reject, {"domain", "threshold-met"}, far);
    Job none;
    put(none, none.oval, 1, 0, 0, 0);
    put(none, none.oval, 2, 0, CV_PI / 2, 512);
    none.cosine = 0;
    add_job(set, "no-gradient-along-normal", Tier::boundary, {"axis-gradient"}, none);
    Job steep;
    accuracy::Random random = set.random("strongest-gradients");
    for (int i = 0; i < 64; i++) {
        put(steep, steep.oval, i * CV_PI / 32 + 0.01, normal(random) / 4, 0, 0);
        const size_t at = steep.edges.size();
        steep.edges[at - 2] = steep.edges[at - 4] > 120 * 32 ? 1020 : -1020;
        steep.edges[at - 1] = steep.edges[at - 3] > 110 * 32 ? 1020 : -1020;
    }
    add_job(set, "strongest-gradients", Tier::stress, {"saturation"}, steep);
}

} // namespace

void add_support(Set &set)
{
    set.begin("support");
    add_polarities(set);
    add_shapes(set);
    add_cover(set);
    add_limits(set);
}

} // namespace vectors
