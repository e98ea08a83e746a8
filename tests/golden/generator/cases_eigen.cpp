/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of the symmetric 3x3 eigenproblem: every order, equal eigenvalues, the cone's spread, signs. */
#include <cmath>

#include "case.hpp"

namespace vectors {

namespace {

constexpr int64_t ONE = INT64_C(1) << 58;

void add_matrix(Set &set, const std::string &name, Tier tier, const Flags &flags, std::vector<int64_t> a)
{
    set.add(name, tier, flags, {word_array("matrix", 64, 60, std::move(a))});
}

int64_t wide(accuracy::Random &random, int bits)
{
    const auto v = static_cast<int64_t>(random.next() >> (64 - bits));
    return random.next() & 1 ? -v : v;
}

/* Cone of a circle seen by a camera: eigenvalues about 1 : 1 : -1/5000, turned a little. */
std::vector<int64_t> cone(accuracy::Random &random)
{
    const double x = random.uniform(-0.3, 0.3);
    const double y = random.uniform(-0.3, 0.3);
    const double a = random.uniform(0.9, 1.1);
    const double b = random.uniform(-0.1, 0.1);
    const double r2 = random.uniform(0.0002, 0.01);
    const auto fixed = [](double v) { return static_cast<int64_t>(std::floor(v * 0x1p58)); };
    return {fixed(a),
            fixed(b),
            fixed(-a * x - b * y),
            fixed(1 / a),
            fixed(-b * x - y / a),
            fixed(a * x * x + 2 * b * x * y + y * y / a - r2)};
}

} // namespace

void add_eigen(Set &set)
{
    set.begin("eigen");
    static const int orders[][3] = {{3, 2, 1}, {3, 1, 2}, {2, 3, 1}, {2, 1, 3}, {1, 3, 2}, {1, 2, 3}};
    for (const auto &o : orders) {
        add_matrix(set, "diagonal-" + std::to_string(o[0]) + std::to_string(o[1]) + std::to_string(o[2]),
                   Tier::boundary, {"degenerate"}, {o[0] * ONE / 2, 0, 0, o[1] * ONE / 2, 0, o[2] * ONE / 2});
        add_matrix(set, "nearly-diagonal-" + std::to_string(o[0]) + std::to_string(o[1]) + std::to_string(o[2]),
                   Tier::ordinary, {},
                   {o[0] * ONE / 2, ONE / 900, -ONE / 70, o[1] * ONE / 2, ONE / 33, o[2] * ONE / 2});
    }
    add_matrix(set, "zero", Tier::boundary, {"degenerate"}, {0, 0, 0, 0, 0, 0});
    add_matrix(set, "identity", Tier::boundary, {"degenerate", "equal-eigenvalues"}, {ONE, 0, 0, ONE, 0, ONE});
    add_matrix(set, "two-equal", Tier::boundary, {"equal-eigenvalues"}, {ONE, 0, 0, -ONE, 0, ONE});
    add_matrix(set, "plane-01", Tier::boundary, {"tie"}, {0, ONE, 0, 0, 0, 0});
    add_matrix(set, "plane-02", Tier::boundary, {"tie"}, {0, 0, -ONE, 0, 0, 0});
    add_matrix(set, "plane-12", Tier::boundary, {"tie"}, {0, 0, 0, 0, ONE, 0});
    add_matrix(set, "plane-01-equal-diagonal", Tier::boundary, {"tie"}, {ONE, ONE / 3, 0, ONE, 0, -ONE});
    add_matrix(set, "all-ones", Tier::boundary, {"tie", "equal-eigenvalues"}, {ONE, ONE, ONE, ONE, ONE, ONE});
    add_matrix(set, "rank-one", Tier::boundary, {"equal-eigenvalues"},
               {4 * ONE / 16, 6 * ONE / 16, -2 * ONE / 16, 9 * ONE / 16, -3 * ONE / 16, ONE / 16});
    add_matrix(set, "negative", Tier::ordinary, {"rounding-negative"},
               {-ONE, ONE / 5, ONE / 7, -ONE / 2, ONE / 9, -ONE / 3});
    add_matrix(set, "largest", Tier::boundary, {"saturation"}, {2 * ONE, 2 * ONE, 2 * ONE, 2 * ONE, 2 * ONE, 2 * ONE});
    add_matrix(set, "largest-mixed", Tier::boundary, {"saturation"},
               {2 * ONE, -2 * ONE, 2 * ONE, -2 * ONE, 2 * ONE, 2 * ONE});
    add_matrix(set, "largest-negative", Tier::boundary, {"saturation", "rounding-negative"},
               {-2 * ONE, -2 * ONE, -2 * ONE, -2 * ONE, -2 * ONE, -2 * ONE});
    add_matrix(set, "smallest", Tier::boundary, {"degenerate"}, {1, 1, 0, -1, 1, 2});
    add_matrix(set, "last-bits", Tier::boundary, {"rounding-negative"}, {ONE, 1, -1, ONE / 2, 1, -ONE});
    add_matrix(set, "fit-constraint", Tier::ordinary, {}, {0, 0, 2 * ONE, -ONE / 2, ONE / 900, ONE / 40});
    for (int k = 0; k < 6; k++) {
        const std::string name = "cone-" + std::to_string(k);
        accuracy::Random random = set.random(name);
        add_matrix(set, name, Tier::ordinary, {}, cone(random));
    }
    for (int k = 0; k < 10; k++) {
        const std::string name = "random-" + std::to_string(k);
        accuracy::Random random = set.random(name);
        std::vector<int64_t> a;
        for (int i = 0; i < 6; i++) {
            a.push_back(wide(random, k < 6 ? 59 : between(random, 20, 59)));
        }
        add_matrix(set, name, Tier::ordinary, {}, a);
    }
}

} // namespace vectors
