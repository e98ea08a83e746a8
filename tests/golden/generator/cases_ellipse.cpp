/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of the direct fit: arcs of every extent, size and noise, exact conics, degenerate points. */
#include <cmath>

#include "case.hpp"

namespace vectors {

namespace {

struct Arc {
    double xc = 0, yc = 0, a = 100, b = 90, angle_deg = 30;
    double from_deg = 0, extent_deg = 360, noise_px = 0;
    int count = 200;
};

using Words = std::vector<int64_t>;

void add_fit(Set &set, const std::string &name, Tier tier, const Flags &flags, const Words &points, int frac_bits)
{
    set.add(name, tier, flags,
            {word_array("points", 16, std::max(0, frac_bits), points), word_array("params", 32, 0, {frac_bits})});
}

/* Points of an arc, rounded to 2^-frac_bits px. */
Words points_of(const Arc &arc, accuracy::Random &random, int frac_bits)
{
    const double unit = 1 << frac_bits;
    const double turn = arc.angle_deg * CV_PI / 180;
    Words words;
    for (int i = 0; i < arc.count; i++) {
        const double t = (arc.from_deg + arc.extent_deg * i / arc.count) * CV_PI / 180;
        const double u = arc.a * std::cos(t);
        const double v = arc.b * std::sin(t);
        const double x = arc.xc + std::cos(turn) * u - std::sin(turn) * v + arc.noise_px * normal(random);
        const double y = arc.yc + std::sin(turn) * u + std::cos(turn) * v + arc.noise_px * normal(random);
        words.push_back(static_cast<int64_t>(std::floor(x * unit + 0.5)));
        words.push_back(static_cast<int64_t>(std::floor(y * unit + 0.5)));
    }
    return words;
}

/* Whole-number solutions of A x^2 + B xy + C y^2 = value, moved by (x0, y0). */
Words lattice_conic(int a, int b, int c, int value, int x0, int y0)
{
    Words words;
    for (int y = -400; y <= 400; y++) {
        for (int x = -400; x <= 400; x++) {
            if (a * x * x + b * x * y + c * y * y == value) {
                words.push_back(x + x0);
                words.push_back(y + y0);
            }
        }
    }
    return words;
}

Words first_points(Words words, size_t count)
{
    words.resize(2 * count);
    return words;
}

void add_arcs_of_ellipses(Set &set)
{
    static const int extents[] = {60, 90, 120, 180, 360};
    static const int radii[] = {8, 20, 50, 120, 300, 900};
    static const double noises[] = {0, 0.3, 1};
    int turn = 0;
    for (const int extent : extents) {
        for (const int radius : radii) {
            const double noise = noises[turn++ % 3];
            Arc arc;
            const std::string name = "arc" + std::to_string(extent) + "-r" + std::to_string(radius) +
                                     (noise == 0  ? ""
                                      : noise < 1 ? "-noise-third"
                                                  : "-noise-one");
            accuracy::Random random = set.random(name);
            arc.a = radius;
            arc.b = radius * random.uniform(0.75, 0.97);
            arc.angle_deg = random.uniform(-88, 88);
            arc.from_deg = random.uniform(0, 360);
            arc.extent_deg = extent;
            arc.noise_px = std::min(noise, radius / 40.0);
            arc.count = std::min(240, 4 + static_cast<int>(radius * extent / 57.3));
            arc.xc = radius > 400 ? random.uniform(-90, 90) : random.uniform(-600, 600);
            arc.yc = radius > 400 ? random.uniform(-90, 90) : random.uniform(-600, 600);
            const Flags flags = {extent == 90 ? "90-degree-arc" : "arc"};
            add_fit(set, name, extent == 60 ? Tier::stress : Tier::ordinary, flags, points_of(arc, random, 5), 5);
        }
    }
}

void add_angles(Set &set)
{
    static const double angles[] = {0, 90, 45, -45, 22.5, 89.9999, -89.9999, 0.0001};
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
        const std::string name = "angle-" + std::to_string(i);
        accuracy::Random random = set.random(name);
        Arc arc;
        arc.angle_deg = angles[i];
        arc.xc = random.uniform(-20, 20);
        arc.yc = random.uniform(-20, 20);
        arc.b = 70;
        add_fit(set, name, Tier::boundary, {"angle-wrap"}, points_of(arc, random, 5), 5);
    }
    /* symmetric about both axes: B is exactly 0, the major axis across, then down */
    for (const bool down : {false, true}) {
        Words words;
        for (int i = 0; i < 20; i++) {
            const int major = 64 + 48 * i;
            const int minor = static_cast<int>(std::floor(700 * std::sqrt(1 - major * major / 1048576.0)));
            for (int k = 0; k < 4; k++) {
                const int u = k & 1 ? -major : major;
                const int v = k & 2 ? -minor : minor;
                words.push_back(down ? v : u);
                words.push_back(down ? u : v);
            }
        }
        add_fit(set, down ? "symmetric-down" : "symmetric-across", Tier::boundary, {"angle-wrap", "tie"}, words, 5);
    }
    /* equal spread in x and y: the fit may take either first */
    add_fit(set, "equal-spread", Tier::boundary, {"tie", "exact-conic"}, lattice_conic(1, 1, 1, 91, 3, -8), 0);
}

void add_exact_conics(Set &set)
{
    add_fit(set, "circle-25", Tier::boundary, {"exact-conic", "near-circle"}, lattice_conic(1, 0, 1, 25, 0, 0), 0);
    add_fit(set, "circle-4225", Tier::boundary, {"exact-conic", "near-circle"}, lattice_conic(1, 0, 1, 4225, 100, -77),
            0);
    add_fit(set, "circle-105625", Tier::boundary, {"exact-conic", "near-circle"},
            lattice_conic(1, 0, 1, 105625, -11, 5), 0);
    add_fit(set, "ellipse-across", Tier::boundary, {"exact-conic", "angle-wrap"}, lattice_conic(1, 0, 4, 4225, 1, 1),
            0);
    add_fit(set, "ellipse-down", Tier::boundary, {"exact-conic", "angle-wrap"}, lattice_conic(4, 0, 1, 4225, 9, -1), 0);
    add_fit(set, "ellipse-oblique", Tier::boundary, {"exact-conic"}, lattice_conic(1, 1, 1, 637, -300, 200), 0);
    add_fit(set, "ellipse-oblique-back", Tier::boundary, {"exact-conic"}, lattice_conic(1, -1, 1, 8281, 70, 60), 0);
    add_fit(set, "ellipse-slanted", Tier::boundary, {"exact-conic"}, lattice_conic(2, 1, 3, 7176, 0, 0), 0);
    add_fit(set, "through-origin", Tier::boundary, {"exact-conic"}, lattice_conic(1, 0, 1, 4225, 63, 16), 0);
    add_fit(set, "circle-fine-unit", Tier::boundary, {"exact-conic"}, lattice_conic(1, 0, 1, 105625, 0, 0), 10);
    add_fit(set, "six-points", Tier::boundary, {"exact-conic"}, first_points(lattice_conic(1, 0, 1, 65, 2, 3), 6), 0);
    add_fit(set, "six-points-general", Tier::boundary, {"degenerate"}, {10, 0, 0, 9, -11, 1, 1, -8, 8, 6, -7, -7}, 0);
    Words twice = first_points(lattice_conic(1, 1, 1, 91, 0, 0), 5);
    const Words five = twice;
    twice.insert(twice.end(), five.begin(), five.end());
    add_fit(set, "five-points-twice", Tier::boundary, {"exact-conic", "degenerate"}, twice, 0);
}

/* The largest symmetric shape of the 16 bits, one point moved by a unit: upright but for a millionth. */
void add_nearly_upright(Set &set)
{
    for (const int moved : {1, -1}) {
        Words words;
        for (int i = 0; i < 30; i++) {
            const int major = 200 + 1080 * i;
            const int minor = static_cast<int>(std::floor(22000 * std::sqrt(1 - major * (major / 1.05e9))));
            for (int k = 0; k < 4; k++) {
                words.push_back(k & 2 ? -minor : minor);
                words.push_back(k & 1 ? -major : major);
            }
        }
        words[80] += moved;
        add_fit(set, moved > 0 ? "nearly-upright" : "nearly-upright-back", Tier::boundary, {"angle-wrap"}, words, 5);
    }
}

void add_rejected(Set &set)
{
    const Words circle = lattice_conic(1, 0, 1, 4225, 0, 0);
    add_fit(set, "five-points", Tier::must_reject, {"too-few"}, first_points(circle, 5), 0);
    add_fit(set, "one-point", Tier::must_reject, {"too-few"}, {3, 4}, 5);
    add_fit(set, "unit-negative", Tier::must_reject, {"argument"}, circle, -1);
    add_fit(set, "unit-too-fine", Tier::must_reject, {"argument"}, circle, 16);
    Words line, slanted, same, parabola, far;
    for (int i = -10; i <= 10; i++) {
        line.insert(line.end(), {7 * i, 12});
        slanted.insert(slanted.end(), {3 * i + 40, -5 * i + 3});
        same.insert(same.end(), {-17, 230});
        parabola.insert(parabola.end(), {10 * i, i * i});
        far.insert(far.end(), {3200 * i, i * i * 8 - 20000});
    }
    add_fit(set, "line-across", Tier::must_reject, {"degenerate", "collinear"}, line, 0);
    add_fit(set, "line-slanted", Tier::must_reject, {"degenerate", "collinear"}, slanted, 5);
    add_fit(set, "one-place", Tier::must_reject, {"degenerate"}, same, 5);
    Words outgrown; /* a short arc of a circle whose radius leaves Q16 */
    for (int i = -100; i <= 100; i++) {
        outgrown.push_back(std::lround(35000 * std::sin(i * 0.008)));
        outgrown.push_back(std::lround(35000 * (1 - std::cos(i * 0.008))));
    }
    add_fit(set, "circle-beyond-q16", Tier::must_reject, {"saturation"}, outgrown, 0);
    add_fit(set, "beyond-q16", Tier::must_reject, {"saturation"}, far, 0);
    /* conics that are no ellipse, and places too few for one */
    Words hyperbola, lines, four, three;
    for (const int x : {1, 2, 3, 4, 5, 6, 10, 12, 15, 20, 30, 60}) {
        hyperbola.insert(hyperbola.end(), {x, 60 / x, -x, -60 / x});
        lines.insert(lines.end(), {x, 2 * x, x, -x});
        four.insert(four.end(), {x % 2 ? 10 : -7, x % 3 ? 21 : -4, 3, 5});
        three.insert(three.end(), {x % 2 ? 10 : -7, x % 2 ? 0 : -4, 3, 5});
    }
    add_fit(set, "hyperbola", Tier::must_reject, {"degenerate", "exact-conic"}, hyperbola, 0);
    add_fit(set, "two-lines", Tier::must_reject, {"degenerate", "exact-conic"}, lines, 0);
    add_fit(set, "four-or-five-places", Tier::must_reject, {"degenerate"}, four, 0);
    add_fit(set, "three-places", Tier::must_reject, {"degenerate"}, three, 0);
    add_fit(set, "parabola", Tier::stress, {"degenerate"}, parabola, 5);
}

} // namespace

void add_ellipse(Set &set)
{
    set.begin("ellipse");
    add_arcs_of_ellipses(set);
    add_angles(set);
    add_nearly_upright(set);
    add_exact_conics(set);
    add_rejected(set);
    accuracy::Random random = set.random("ellipse");
    Arc round;
    round.a = 82.3;
    round.b = 82.3;
    round.count = 2000;
    round.noise_px = 0.4;
    add_fit(set, "near-circle-2000", Tier::stress, {"near-circle"}, points_of(round, random, 5), 5);
    round.a = 82.35;
    round.noise_px = 0;
    round.count = 600;
    add_fit(set, "near-circle-clean", Tier::stress, {"near-circle"}, points_of(round, random, 5), 5);
    for (const int bits : {0, 1, 8, 10, 15}) {
        Arc arc;
        const double side = 32000.0 / (1 << bits); /* uses the 16 bits of a coordinate */
        arc.a = side * 0.4;
        arc.b = side * 0.33;
        arc.xc = side * 0.55;
        arc.yc = -side * 0.57;
        arc.angle_deg = -35;
        add_fit(set, "unit-" + std::to_string(bits), Tier::boundary, {"saturation"}, points_of(arc, random, bits),
                bits);
    }
    Arc flat;
    flat.b = 3;
    add_fit(set, "flat", Tier::stress, {"degenerate"}, points_of(flat, random, 5), 5);
    Arc tiny;
    tiny.a = 1.4;
    tiny.b = 0.9;
    tiny.count = 24;
    add_fit(set, "tiny", Tier::stress, {"degenerate"}, points_of(tiny, random, 5), 5);
    Arc pixels;
    pixels.a = 40;
    pixels.b = 34;
    pixels.xc = pixels.yc = 64;
    add_fit(set, "whole-pixels", Tier::ordinary, {}, points_of(pixels, random, 0), 0);
    for (int k = 0; k < 8; k++) {
        const std::string name = "random-" + std::to_string(k);
        accuracy::Random own = set.random(name);
        Arc arc;
        arc.a = own.uniform(15, 250);
        arc.b = arc.a * own.uniform(0.4, 1);
        arc.xc = own.uniform(-500, 500);
        arc.yc = own.uniform(-500, 500);
        arc.angle_deg = own.uniform(-90, 90);
        arc.from_deg = own.uniform(0, 360);
        arc.extent_deg = own.uniform(90, 360);
        arc.noise_px = 0.2;
        arc.count = between(own, 30, 200);
        add_fit(set, name, Tier::ordinary, {}, points_of(arc, own, 5), 5);
    }
}

} // namespace vectors
