/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of the arcs selected in each quadrant: lengths, distances, their ties, polarity. */
#include <set>

#include "case.hpp"

namespace vectors {

namespace {

struct Arc {
    std::vector<cv::Point> points; /* raster order */
    int direction;
};

struct Job {
    int centre2_x = 200, centre2_y = 200, polarity = 2;
    int64_t min_short_q16 = 98304;
    std::vector<Arc> arcs;
};

void add_job(Set &set, const std::string &name, Tier tier, const Flags &flags, const Job &j)
{
    std::vector<int64_t> points, arcs;
    for (const Arc &a : j.arcs) {
        for (const cv::Point &p : a.points) {
            points.insert(points.end(), {p.x, p.y});
        }
        arcs.insert(arcs.end(), {static_cast<int64_t>(a.points.size()), a.direction});
    }
    set.add(name, tier, flags,
            {word_array("points", 16, 0, points), word_array("arcs", 32, 0, arcs),
             word_array("params", 32, 16, {j.centre2_x, j.centre2_y, 2048, j.min_short_q16, j.polarity})});
}

/* A staircase of 'count' pixels from (x, y) downward to the right. */
Arc stair(int x, int y, int count, int direction)
{
    Arc a = {{}, direction};
    for (int i = 0; i < count; i++) {
        a.points.emplace_back(x + i, y + i / 2);
    }
    return a;
}

/* An L in the rectangle w x h from (x, y): down its left side, then along its bottom. */
Arc corner(int x, int y, int w, int h, int direction)
{
    Arc a = {{}, direction};
    for (int i = 0; i < h - 1; i++) {
        a.points.emplace_back(x, y + i);
    }
    for (int i = 0; i < w; i++) {
        a.points.emplace_back(x + i, y + h - 1);
    }
    return a;
}

/* The same in the quadrants II, III, IV: mirrored about (100, 100). */
Arc mirrored(const Arc &a, int quadrant)
{
    std::set<std::pair<int, int>> order;
    for (const cv::Point &p : a.points) {
        order.emplace(quadrant >= 2 ? 200 - p.y : p.y, quadrant == 1 || quadrant == 2 ? 200 - p.x : p.x);
    }
    Arc m = {{}, a.direction};
    for (const auto &p : order) {
        m.points.emplace_back(p.second, p.first);
    }
    return m;
}

void add_lengths(Set &set)
{
    /* beyond a long arc in quadrant I a shorter one, farther out */
    for (const int length : {9, 10, 11, 12, 19, 20, 21}) {
        Job j;
        j.arcs = {corner(120, 60, 11, 10, 0), corner(160, 30, length - 4, 5, 0)};
        add_job(set, "farther-of-" + std::to_string(length) + "-to-20", Tier::boundary,
                {"farthest-arc", "threshold-met"}, j);
    }
    Job j;
    j.arcs = {corner(150, 40, 6, 6, 0), corner(120, 60, 6, 6, 0), corner(130, 50, 6, 6, 0)};
    add_job(set, "equal-lengths", Tier::boundary, {"tie", "farthest-arc"}, j);
    j.arcs = {corner(120, 60, 6, 6, 0), corner(130, 50, 6, 6, 0), corner(150, 40, 6, 6, 0)};
    add_job(set, "equal-lengths-back", Tier::boundary, {"tie", "farthest-arc"}, j);
    j.arcs = {corner(120, 70, 8, 8, 0), corner(123, 67, 8, 8, 0), corner(126, 64, 8, 8, 0), corner(129, 61, 8, 8, 0),
              corner(160, 30, 7, 8, 0)};
    add_job(set, "fifth-is-farthest", Tier::boundary, {"farthest-arc"}, j);
    std::swap(j.arcs[0], j.arcs[4]);
    add_job(set, "fifth-is-farthest-and-first", Tier::boundary, {"farthest-arc"}, j);
    j.arcs[0] = corner(160, 30, 8, 8, 0);
    add_job(set, "farthest-of-five-equals-first", Tier::boundary, {"tie", "farthest-arc"}, j);
    std::swap(j.arcs[0], j.arcs[4]);
    add_job(set, "farthest-of-five-equals-last", Tier::boundary, {"tie", "farthest-arc"}, j);
    j.arcs = {corner(140, 50, 7, 7, 0), corner(120, 60, 9, 9, 0)};
    add_job(set, "farthest-is-second-longest", Tier::ordinary, {"farthest-arc"}, j);
    j.arcs = {corner(120, 60, 9, 9, 0)};
    add_job(set, "single-arc", Tier::ordinary, {}, j);
    /* mirror images about the diagonal: equally far, to the bit */
    const Arc one = corner(150, 70, 6, 6, 0);
    Arc two = {{}, 0};
    std::set<std::pair<int, int>> order;
    for (const cv::Point &p : one.points) {
        order.emplace(200 - p.x, 200 - p.y);
    }
    for (const auto &p : order) {
        two.points.emplace_back(p.second, p.first);
    }
    j.arcs = {one, two};
    add_job(set, "equal-distances", Tier::boundary, {"tie", "farthest-arc"}, j);
    j.arcs = {two, one};
    add_job(set, "equal-distances-back", Tier::boundary, {"tie", "farthest-arc"}, j);
}

void add_polarities(Set &set)
{
    Job j;
    for (int q = 0; q < 4; q++) { /* dark ones near, bright ones far, others farther still */
        j.arcs.push_back(mirrored(corner(130, 60, 9, 9, q), q));
        j.arcs.push_back(mirrored(corner(145, 45, 8, 8, (q + 2) % 4), q));
        j.arcs.push_back(mirrored(corner(160, 30, 9, 9, (q + 1) % 4), q));
        j.arcs.push_back(mirrored(corner(115, 75, 10, 10, (q + 3) % 4), q));
    }
    for (int polarity = 0; polarity < 3; polarity++) {
        j.polarity = polarity;
        add_job(set, "polarity-" + std::to_string(polarity), Tier::ordinary, {"polarity", "direction-class"}, j);
    }
    j.polarity = 0;
    j.arcs = {corner(130, 60, 9, 9, 2), mirrored(corner(130, 60, 9, 9, 3), 1)};
    add_job(set, "only-the-other-polarity", Tier::must_reject, {"polarity"}, j);
    j.polarity = 2;
    j.arcs = {corner(130, 60, 9, 9, 1), mirrored(corner(130, 60, 9, 9, 2), 1)};
    add_job(set, "no-class-fits", Tier::must_reject, {"direction-class"}, j);
    j.arcs = {};
    add_job(set, "no-arcs", Tier::must_reject, {"degenerate"}, j);
    j.arcs = {{{{120, 40}, {120, 41}, {120, 42}, {120, 43}, {120, 44}, {120, 45}}, 0}};
    add_job(set, "only-a-straight-one", Tier::must_reject, {"straight"}, j);
    j.arcs.push_back(corner(150, 40, 3, 3, 0));
    add_job(set, "straight-and-short", Tier::must_reject, {"straight"}, j);
}

void add_random(Set &set)
{
    for (int k = 0; k < 10; k++) {
        const std::string name = "random-" + std::to_string(k);
        accuracy::Random random = set.random(name);
        Job j;
        j.polarity = k % 5 < 3 ? 2 : k % 5 - 3;
        const int count = between(random, 3, 40);
        for (int i = 0; i < count; i++) {
            const int quadrant = between(random, 0, 3);
            const int x = between(random, 102, 170);
            const int y = between(random, 30, 80);
            const int w = between(random, 2, 12);
            const int h = between(random, 2, 12);
            const int direction = between(random, 0, 4) == 0 ? between(random, 0, 3) : (quadrant + 2 * (i % 2)) % 4;
            j.arcs.push_back(mirrored(corner(x, y, w, h, direction), quadrant));
        }
        add_job(set, name, Tier::ordinary, {"farthest-arc"}, j);
    }
    Job j;
    for (int q = 0; q < 4; q++) {
        for (int i = 0; i < 4; i++) {
            j.arcs.push_back(mirrored(stair(110 + 8 * i, 30, 8 + 6 * i, q), q));
        }
    }
    add_job(set, "stairs", Tier::must_reject, {"straight"}, j);
}

} // namespace

void add_select(Set &set)
{
    set.begin("select");
    add_lengths(set);
    add_polarities(set);
    add_random(set);
}

} // namespace vectors
