/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of the smallest rectangle and of the verdict on an arc. */
#include <cmath>
#include <set>
#include <stdexcept>

#include "case.hpp"
#include "reference.hpp"

namespace vectors {

namespace {

using Points = std::vector<cv::Point>;

/* In raster order, each once. */
Points in_raster_order(const Points &points)
{
    std::set<std::pair<int, int>> order;
    for (const cv::Point &p : points) {
        order.emplace(p.y, p.x);
    }
    Points sorted;
    for (const auto &p : order) {
        sorted.emplace_back(p.second, p.first);
    }
    return sorted;
}

struct Judge {
    int centre2_x = 0, centre2_y = 0, direction = 0;
    int64_t min_short_q16 = 98304;
};

void add_arc(Set &set, const std::string &name, Tier tier, const Flags &flags, const Points &points, const Judge &j)
{
    std::vector<int64_t> words;
    for (const cv::Point &p : in_raster_order(points)) {
        words.push_back(p.x);
        words.push_back(p.y);
    }
    set.add(name, tier, flags,
            {word_array("points", 16, 0, words),
             word_array("params", 32, 16, {j.centre2_x, j.centre2_y, 2048, j.direction, j.min_short_q16})});
}

/* Pixels of an ellipse's arc about (cx, cy); angles in degrees, y down. */
Points arc_pixels(double cx, double cy, double a, double b, double turn, double from, double to)
{
    Points points;
    for (double t = from; t <= to; t += 20 / std::max(a, b)) {
        const double u = a * std::cos(t * CV_PI / 180);
        const double v = b * std::sin(t * CV_PI / 180);
        const double c = std::cos(turn * CV_PI / 180);
        const double s = std::sin(turn * CV_PI / 180);
        points.emplace_back(static_cast<int>(std::floor(cx + c * u - s * v + 0.5)),
                            static_cast<int>(std::floor(cy + s * u + c * v + 0.5)));
    }
    return points;
}

Points segment(int x, int y, int dx, int dy, int count)
{
    Points points;
    for (int i = 0; i < count; i++) {
        points.emplace_back(x + i * dx, y + i * dy);
    }
    return points;
}

Points blob(accuracy::Random &random, int x, int y, int w, int h, int count)
{
    Points points;
    for (int i = 0; i < count; i++) {
        const int dx = between(random, 0, w); /* apart: the order of arguments is the compiler's */
        const int dy = between(random, 0, h);
        points.emplace_back(x + dx, y + dy);
    }
    return points;
}

Judge about(int x, int y, int direction)
{
    Judge j;
    j.centre2_x = 2 * x;
    j.centre2_y = 2 * y;
    j.direction = direction;
    return j;
}

/* Every direction class in every quadrant: dark, bright and rejected. */
void add_quadrants(Set &set)
{
    for (int quadrant = 0; quadrant < 4; quadrant++) {
        const double middle = -45 - 90 * quadrant;
        for (int direction = 0; direction < 4; direction++) {
            add_arc(set, "quadrant-" + std::to_string(quadrant + 1) + "-class-" + std::to_string(direction + 1),
                    Tier::ordinary, {"direction-class"}, arc_pixels(100, 100, 60, 52, 20, middle - 50, middle + 30),
                    about(100, 100, direction));
        }
    }
}

/* The short side meets the least one exactly, and misses it by one. */
void add_straightness(Set &set)
{
    struct Arc {
        const char *name;
        Points points;
    };
    const Arc arcs[] = {
        {"flat-block", {{300, 20}, {301, 20}, {330, 20}, {300, 23}, {330, 23}}},
        {"shallow-arc", arc_pixels(250, 120, 90, 90, 0, -60, -35)},
        {"oblique-block", {{300, 20}, {306, 23}, {312, 26}, {298, 24}, {310, 30}}},
    };
    for (const Arc &a : arcs) {
        const int64_t shorter = reference::q16(reference::min_area_rect(in_raster_order(a.points)).shorter);
        Judge j = about(200, 150, 0);
        j.min_short_q16 = shorter;
        add_arc(set, std::string(a.name) + "-met", Tier::boundary, {"threshold-met"}, a.points, j);
        j.min_short_q16 = shorter + 1;
        add_arc(set, std::string(a.name) + "-missed", Tier::boundary, {"threshold-met"}, a.points, j);
    }
}

/* A rectangle whose centre is one LSB beside an axis: neither on it nor within what rounding may lose. */
void add_one_lsb_off(Set &set)
{
    for (int k = 0; k < 4; k++) {
        const std::string name = "centre-one-lsb-" + std::string(k == 0   ? "right"
                                                                 : k == 1 ? "left"
                                                                 : k == 2 ? "below"
                                                                          : "above");
        accuracy::Random random = set.random(name);
        const int64_t wanted = k % 2 == 0 ? 1 : -1;
        Points points;
        Judge j = about(300, 300, 0);
        j.min_short_q16 = 0;
        int64_t off = 0;
        while (off != wanted) {
            points = blob(random, 180, 180, 230, 230, 3);
            const reference::Rect r = reference::min_area_rect(in_raster_order(points));
            const int64_t at = reference::q16(k < 2 ? r.xc : r.yc);
            const int64_t centre2 = (at + 16384) >> 15;
            off = at - centre2 * 32768;
            (k < 2 ? j.centre2_x : j.centre2_y) = static_cast<int>(centre2);
            const bool right = k < 2 ? wanted > 0 : reference::q16(r.xc) > j.centre2_x * 32768;
            const bool above = k < 2 ? reference::q16(r.yc) < j.centre2_y * 32768 : wanted < 0;
            j.direction = above ? (right ? 0 : 1) : (right ? 3 : 2);
        }
        add_arc(set, name, Tier::boundary, {"quadrant-axis", "half-lsb"}, points, j);
    }
}

} // namespace

void add_constraints(Set &set)
{
    set.begin("constraints");
    add_quadrants(set);
    add_straightness(set);
    add_one_lsb_off(set);
    Judge loose = about(30, 30, 0);
    loose.min_short_q16 = 0;
    add_arc(set, "single", Tier::boundary, {"degenerate"}, {{40, 20}}, loose);
    add_arc(set, "single-origin", Tier::boundary, {"degenerate"}, {{0, 0}}, loose);
    add_arc(set, "pair", Tier::boundary, {"degenerate"}, {{40, 20}, {43, 24}}, loose);
    add_arc(set, "pair-across", Tier::boundary, {"degenerate", "rounding-negative"}, {{40, 20}, {35, 21}}, loose);
    add_arc(set, "horizontal", Tier::boundary, {"degenerate"}, segment(35, 12, 1, 0, 20), loose);
    add_arc(set, "vertical", Tier::boundary, {"degenerate"}, segment(45, 5, 0, 1, 20), loose);
    add_arc(set, "diagonal", Tier::boundary, {"degenerate"}, segment(35, 5, 1, 1, 20), loose);
    add_arc(set, "antidiagonal", Tier::boundary, {"degenerate"}, segment(55, 5, -1, 1, 20), loose);
    add_arc(set, "steep", Tier::boundary, {"degenerate", "rounding-negative"}, segment(60, 1, -2, 3, 9), loose);
    add_arc(set, "straight-rejected", Tier::boundary, {"threshold-met"}, segment(35, 5, 1, 1, 20), about(30, 30, 0));
    add_arc(set, "square", Tier::boundary, {"tie"}, {{40, 10}, {50, 10}, {40, 20}, {50, 20}}, loose);
    add_arc(set, "square-turned", Tier::boundary, {"tie"}, {{45, 5}, {50, 10}, {45, 15}, {40, 10}}, loose);
    add_arc(set, "square-oblique", Tier::boundary, {"tie"}, {{41, 10}, {48, 11}, {47, 18}, {40, 17}}, loose);
    add_arc(set, "triangle", Tier::boundary, {"tie"}, {{40, 10}, {52, 10}, {40, 19}}, loose);
    add_arc(set, "triangle-isosceles", Tier::boundary, {"tie"}, {{46, 4}, {40, 20}, {52, 20}}, loose);
    add_arc(set, "octagon", Tier::boundary, {"tie"},
            {{43, 10}, {46, 10}, {48, 12}, {48, 15}, {46, 17}, {43, 17}, {41, 15}, {41, 12}}, loose);
    add_arc(set, "hull-with-straight-sides", Tier::boundary, {"degenerate"},
            {{40, 2}, {41, 2}, {42, 2}, {50, 2}, {40, 5}, {50, 6}, {40, 9}, {45, 9}, {50, 9}, {44, 4}}, loose);
    /* the rectangle's centre on the vertical, the horizontal, both axes; one LSB of the centre beside them */
    for (int direction = 0; direction < 4; direction++) {
        Judge on = loose;
        on.direction = direction;
        const std::string of_class = "-class-" + std::to_string(direction + 1);
        add_arc(set, "centre-on-axis-above" + of_class, Tier::boundary, {"quadrant-axis"},
                {{20, 4}, {40, 4}, {20, 12}, {40, 12}}, on);
        add_arc(set, "centre-on-axis-below" + of_class, Tier::boundary, {"quadrant-axis"},
                {{20, 44}, {40, 44}, {20, 52}, {40, 52}}, on);
        add_arc(set, "centre-on-axis-right" + of_class, Tier::boundary, {"quadrant-axis"},
                {{40, 26}, {60, 26}, {40, 34}, {60, 34}}, on);
        add_arc(set, "centre-on-axis-left" + of_class, Tier::boundary, {"quadrant-axis"},
                {{4, 26}, {16, 26}, {4, 34}, {16, 34}}, on);
    }
    add_arc(set, "centre-on-centre", Tier::boundary, {"quadrant-axis"}, {{20, 26}, {40, 26}, {20, 34}, {40, 34}},
            loose);
    for (int k = 0; k < 4; k++) {
        Judge beside = loose;
        beside.centre2_x += k & 1 ? 1 : -1;
        beside.centre2_y += k & 2 ? 1 : -1;
        beside.direction = k & 2 ? (k & 1 ? 1 : 0) : (k & 1 ? 2 : 3);
        add_arc(set, "centre-half-a-pixel-off-" + std::to_string(k), Tier::boundary,
                {"quadrant-axis", "rounding-negative"}, {{20, 26}, {40, 26}, {20, 34}, {40, 34}}, beside);
    }
    add_arc(set, "largest-region", Tier::stress, {"saturation"},
            {{1, 0}, {2040, 0}, {0, 3}, {2047, 9}, {5, 2040}, {2047, 2041}, {2, 2047}, {2046, 2047}},
            about(1024, 1024, 3));
    add_arc(set, "longest-diagonal", Tier::stress, {"saturation"}, {{0, 0}, {2047, 2046}, {3, 5}, {2041, 2047}},
            about(2047, 0, 2));
    Judge far = about(0, 0, 3);
    far.centre2_x = -32768;
    far.centre2_y = 32768;
    add_arc(set, "centre-far-away", Tier::stress, {"saturation"}, arc_pixels(100, 100, 60, 52, 20, 0, 80), far);
    for (int k = 0; k < 8; k++) {
        const std::string name = "blob-" + std::to_string(k);
        accuracy::Random random = set.random(name);
        const int count = between(random, 3, 60);
        const int x = between(random, 0, 400);
        const int y = between(random, 0, 400);
        const int w = between(random, 2, 90);
        const int h = between(random, 2, 90);
        const int direction = between(random, 0, 3);
        add_arc(set, name, Tier::ordinary, {}, blob(random, x, y, w, h, count), about(230, 230, direction));
    }
    for (int k = 0; k < 6; k++) {
        const std::string name = "arc-" + std::to_string(k);
        accuracy::Random random = set.random(name);
        const double from = random.uniform(0, 360);
        const double a = random.uniform(10, 180);
        const double b = a * random.uniform(0.7, 1);
        const double turn = random.uniform(-90, 90);
        const int direction = between(random, 0, 3);
        add_arc(set, name, Tier::ordinary, {}, arc_pixels(220, 220, a, b, turn, from, from + 80),
                about(220, 220, direction));
    }
}

} // namespace vectors
