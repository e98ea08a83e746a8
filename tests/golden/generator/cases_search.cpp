/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of the search: circles about a dark disc, and what is sighted in drawn frames. */
#include <cmath>

#include "case.hpp"
#include "images.hpp"

namespace vectors {

namespace {

/* A disc of one grey, in quarter pixels. */
struct Disc {
    int x4, y4, radius4, grey;
};

/* Discs over each other, the first lowest; a pixel is grey by the sixteen points of it that lie inside. */
cv::Mat discs(int width, int height, int background, const std::vector<Disc> &list)
{
    return image_from(width, height, [&](int x, int y) {
        int sum = 0;
        for (int k = 0; k < 16; k++) {
            const int px = 8 * x + 2 * (k % 4) - 3, py = 8 * y + 2 * (k / 4) - 3; /* eighths */
            int grey = background;
            for (const Disc &d : list) {
                const int dx = px - 2 * d.x4, dy = py - 2 * d.y4;
                grey = dx * dx + dy * dy <= 4 * d.radius4 * d.radius4 ? d.grey : grey;
            }
            sum += grey;
        }
        return (sum + 8) / 16;
    });
}

/* Canopy and inner part as a drogue has them, the inner part aside by (ix, iy) quarter pixels. */
std::vector<Disc> drogue(int x4, int y4, int radius4, int canopy = 60, int inner = 12, int ix = 0, int iy = 0)
{
    return {{x4, y4, radius4, canopy}, {x4 + ix, y4 + iy, radius4 * 3 / 8, inner}};
}

void add_cells(Set &set, const std::string &name, Tier tier, const Flags &flags, const cv::Mat &image, int x, int y,
               int ring_q4 = 72, int contrast = 40)
{
    set.add(name, tier, flags, {image_array("image", image), word_array("disc", 32, 4, {x, y, ring_q4, contrast})});
}

void add_frame(Set &set, const std::string &name, Tier tier, const Flags &flags, const cv::Mat &image, int contrast = 6)
{
    set.add(name, tier, flags, {image_array("image", image), word_array("params", 32, 0, {contrast})});
}

} // namespace

namespace {

/* Two drawn circles about the disc with a little noise, by number: some meet limits that others do not. */
cv::Mat drawn_circles(uint64_t number, bool faint)
{
    uint64_t state = number * 7919 + 17;
    const auto draw = [&state](int low, int high) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return low + static_cast<int>((state >> 33) % static_cast<uint64_t>(high - low + 1));
    };
    const int most = faint ? 40 : 255, radius = draw(8, 14), background = draw(0, most), inside = draw(0, most);
    const int noise = faint ? draw(0, 2) : draw(0, 30), middle = draw(0, most), wide = draw(10, 17);
    const int ox = draw(-2, 2), oy = draw(-2, 2);
    return image_from(44, 44, [&](int x, int y) {
        const int dx = x - 22 - ox, dy = y - 22 - oy, d = dx * dx + dy * dy;
        return (d < radius * radius ? inside
                : d < wide * wide   ? middle
                                    : background) +
               (noise > 0 ? draw(0, noise) : 0);
    });
}

} // namespace

void add_rim(Set &set)
{
    set.begin("rim");
    for (const int ring : {36, 51, 72, 86}) { /* each scale, its rim twice as large */
        const int r4 = ring / 2;
        const std::string name = "ring-" + std::to_string(ring);
        add_cells(set, name + "-dark", Tier::ordinary, {}, discs(44, 44, 200, drogue(88, 88, r4)), 22, 22, ring);
        add_cells(set, name + "-bright", Tier::ordinary, {"polarity"}, discs(44, 44, 30, drogue(88, 88, r4, 140, 12)),
                  22, 22, ring);
        add_cells(set, name + "-aside", Tier::ordinary, {},
                  discs(44, 44, 200, drogue(88, 88, r4, 60, 12, r4 / 4, -r4 / 5)), 22 + r4 / 16, 22 - r4 / 20, ring);
        for (const int share : ring == 72 || ring == 36
                                   ? std::vector<int>{12, 13, 14, 28, 29, 30}
                                   : std::vector<int>()) { /* of the ring's radius, tenths: 1.3 to 2.9 suit */
            add_cells(set, name + "-share-" + std::to_string(share), Tier::boundary, {"threshold-met"},
                      discs(48, 48, 190, {{96, 96, ring * share / 40, 50}}), 24, 24, ring);
        }
    }
    std::vector<Disc> list = drogue(88, 88, 40);
    list.insert(list.begin(),
                {88, 88, 60, 120}); /* a paler circle outside, a brighter one inside: three choices differ */
    list.insert(list.begin() + 2, {88, 88, 26, 85});
    add_cells(set, "three-circles", Tier::stress, {"farthest-arc"}, discs(44, 44, 210, list), 22, 22);
    list = {{88, 88, 56, 40}, {88, 88, 34, 160}, {88, 88, 14, 10}};
    add_cells(set, "both-signs", Tier::stress, {"polarity"}, discs(44, 44, 200, list), 22, 22);
    for (const int x : {6, 10, 14, 33, 37}) { /* rays end at the border */
        add_cells(set, "border-x-" + std::to_string(x), Tier::boundary, {"border"},
                  discs(44, 40, 200, drogue(4 * x, 80, 40)), x, 20);
        add_cells(set, "border-y-" + std::to_string(x), Tier::boundary, {"border"},
                  discs(40, 44, 200, drogue(80, 4 * x, 40)), 20, x);
    }
    for (const int cut : {8, 9, 10, 11, 12, 13}) { /* part of the rim is gone: fewer and fewer rays meet it */
        cv::Mat image = discs(44, 44, 200, drogue(88, 88, 40));
        image(cv::Rect(0, 0, 44, cut)) = 200;
        fill(image, 0, 0, 44, 2 * cut - 4, 60);
        add_cells(set, "cut-" + std::to_string(cut), Tier::stress, {"arc"}, image, 22, 22);
    }
    for (const int step : {1, 2, 3, 4, 5, 62, 63, 64, 65, 66, 120}) { /* least step that counts, most that counts */
        add_cells(set, "step-" + std::to_string(step), Tier::boundary, {"threshold-met"},
                  discs(44, 44, 60 + step, {{88, 88, 40, 60}}), 22, 22, 72, step);
    }
    for (const int contrast : {0, 6, 63, 64, 65, 255}) {
        add_cells(set, "contrast-" + std::to_string(contrast), Tier::boundary, {"threshold-met"},
                  discs(44, 44, 200, drogue(88, 88, 40)), 22, 22, 72, contrast);
    }
    add_cells(set, "ellipse", Tier::ordinary, {},
              image_from(44, 44,
                         [](int x, int y) {
                             const int u = x - 22, v = y - 21;
                             return 100 * u * u + 64 * v * v < 6400 ? 60 : 200;
                         }),
              22, 21);
    add_cells(set, "flat", Tier::must_reject, {"degenerate"}, constant(44, 44, 90), 22, 22);
    add_cells(set, "straight", Tier::must_reject, {"straight"},
              image_from(44, 44, [](int x, int) { return x < 26 ? 40 : 200; }), 22, 22);
    add_cells(set, "one-cell", Tier::must_reject, {"1xN"}, constant(1, 1, 90), 0, 0);
    add_cells(set, "smallest-ring", Tier::boundary, {"threshold-met"}, discs(20, 20, 200, {{40, 40, 9, 40}}), 10, 10,
              16);
    add_cells(set, "largest-reach", Tier::boundary, {"threshold-met"}, discs(48, 48, 200, {{96, 96, 66, 40}}), 24, 24,
              120);
    for (const int number : {78, 122, 159, 229, 684, 779}) { /* small steps; a point on the limit of a circle */
        static const int rings[] = {36, 51, 72, 86};
        add_cells(set, "drawn-" + std::to_string(number), Tier::boundary, {"threshold-met"},
                  drawn_circles(static_cast<uint64_t>(number), number < 200), 22, 22, rings[number % 4], 20);
    }
    for (int i = 0; i < 16; i++) {
        accuracy::Random random = set.random("noise" + std::to_string(i));
        const int w = between(random, 20, 48), h = between(random, 20, 48);
        cv::Mat image = noise(w, h, random, 0, 40 + 12 * i);
        image += discs(w, h, 120, drogue(2 * w, 2 * h, between(random, 24, 52), 60, 0));
        static const int rings[] = {36, 51, 72, 86};
        const int contrast = between(random, 1, 90), y = h / 2 + between(random, -2, 2); /* arguments have no order */
        const int x = w / 2 + between(random, -2, 2);
        add_cells(set, "noise-" + std::to_string(i), Tier::stress, {"noise"}, image, x, y, rings[i % 4], contrast);
    }
}

namespace {

/* Squares of chance grey with some darker discs over them, by number; wide: 128 places and one more for one of the scales. */
cv::Mat textured(uint64_t number, bool wide)
{
    uint64_t state = number * 77777;
    const auto below = [&state](int end) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<int>((state >> 33) % static_cast<uint64_t>(end));
    };
    const int width = wide ? 2 * (2 * (2 + below(4)) + 129) : 40 + below(60),
              height = wide ? 24 + below(24) : 40 + below(60);
    const int square = 1 + below(4), least = below(60), range = 20 + below(150);
    cv::Mat image(height, width, CV_8U);
    for (int y = 0; y < height; y += square) {
        for (int x = 0; x < width; x += square) {
            image(cv::Rect(x, y, square, square) & cv::Rect(0, 0, width, height)) = least + below(range);
        }
    }
    for (int count = 1 + below(6); count > 0; count--) {
        const int xc = below(width), yc = below(height), radius = 3 + below(12), grey = below(least + 1);
        for (int y = 0; y < height; y++) {
            for (int x = 0; x < width; x++) {
                if ((x - xc) * (x - xc) + (y - yc) * (y - yc) <= radius * radius) {
                    image.at<uint8_t>(y, x) = static_cast<uint8_t>(grey);
                }
            }
        }
    }
    return image;
}

} // namespace

void add_search(Set &set)
{
    set.begin("search");
    for (const int radius : {12, 16, 22, 30, 44, 60, 85, 120}) {
        const int side = radius * 3;
        const std::string name = "radius-" + std::to_string(radius);
        add_frame(set, name + "-dark", Tier::ordinary, {},
                  discs(side, side, 205, drogue(2 * side, 2 * side, 4 * radius)));
        if (radius <= 60) {
            add_frame(set, name + "-bright", Tier::ordinary, {"polarity"},
                      discs(side + 7, side + 3, 40, drogue(2 * side + 9, 2 * side - 6, 4 * radius, 140, 20)));
            add_frame(set, name + "-aside", Tier::ordinary, {"odd-size"},
                      discs(side + 21, side + 1, 190,
                            drogue(2 * side + 30, 2 * side, 4 * radius, 70, 14, radius / 2, -radius / 3)));
        }
    }
    for (const int contrast : {4, 5, 6, 7, 8, 20}) { /* of inner part and canopy */
        add_frame(set, "contrast-" + std::to_string(contrast), Tier::boundary, {"threshold-met"},
                  discs(120, 110, 120, drogue(240, 220, 120, 60, 60 - contrast)));
        add_frame(set, "contrast-wanted-" + std::to_string(contrast), Tier::boundary, {"threshold-met"},
                  discs(120, 110, 120, drogue(240, 220, 120, 60, 50)), contrast);
    }
    const cv::Mat one = discs(120, 110, 200, drogue(240, 220, 120));
    for (const int least : {0, 47, 48, 49, 254, 255}) {
        add_frame(set, "least-" + std::to_string(least), Tier::boundary, {"threshold-met"}, one, least);
    }
    add_frame(set, "least-negative", Tier::must_reject, {"argument"}, one, -1);
    add_frame(set, "least-too-large", Tier::must_reject, {"argument"}, one, 256);
    std::vector<Disc> list;
    for (int i = 0; i < 15; i++) { /* more than are kept, each of its own shade */
        for (const Disc &d : drogue(140 + 240 * (i % 5), 140 + 240 * (i / 5), 80 + 6 * (i % 4), 40 + 7 * i, 8)) {
            list.push_back(d);
        }
    }
    add_frame(set, "fifteen", Tier::stress, {"table-full"}, discs(310, 190, 215, list));
    list.clear();
    for (int i = 0; i < 150; i++) { /* more dark discs in a row of a level than wait */
        list.push_back({24 + 44 * (i % 30), 30 + 48 * (i / 30), 10, 100 - i % 37});
    }
    add_frame(set, "many-dots", Tier::stress, {"table-full"}, discs(340, 70, 180, list));
    list.clear();
    for (int i = 0; i < 60; i++) { /* the same, all alike */
        list.push_back({24 + 32 * i, 40, 10, 70});
    }
    add_frame(set, "many-equal-dots", Tier::stress, {"table-full", "tie"}, discs(490, 40, 180, list));
    list = drogue(200, 200, 100);
    for (const Disc &d : drogue(420, 210, 100, 64, 14)) {
        list.push_back(d);
    }
    add_frame(set, "two-beside", Tier::ordinary, {}, discs(150, 100, 200, list));
    list = {{240, 240, 200, 90}, {240, 240, 110, 150}, {240, 240, 60, 40}, {240, 240, 24, 5}};
    add_frame(set, "concentric", Tier::stress, {"farthest-arc"}, discs(120, 120, 220, list));
    for (const int at : {30, 60, 100, 330, 370, 410}) { /* over each border */
        add_frame(set, "border-x-" + std::to_string(at), Tier::boundary, {"border"},
                  discs(110, 100, 200, drogue(at, 200, 110)));
        add_frame(set, "border-y-" + std::to_string(at), Tier::boundary, {"border"},
                  discs(100, 110, 200, drogue(200, at, 110)));
    }
    /* a disc whose middle is darkest in the last row and column that are looked at */
    for (const int n : {4, 5, 6, 7}) {
        const int middle = 8 * n + 4;
        add_frame(set, "corner-" + std::to_string(n), Tier::boundary, {"border", "threshold-met"},
                  discs(60, 58, 200, {{middle, middle, 4 * n + 4, 90}, {middle, middle, 12, 10}}));
        add_frame(
            set, "far-corner-" + std::to_string(n), Tier::boundary, {"border", "threshold-met"},
            discs(60, 58, 200, {{240 - middle, 232 - middle, 4 * n + 4, 90}, {240 - middle, 232 - middle, 12, 10}}));
    }
    static const int sizes[][2] = {{1, 1},   {2, 2},   {3, 40},  {40, 3},  {5, 5},
                                   {11, 11}, {12, 10}, {63, 65}, {66, 37}, {37, 66}};
    for (const auto &size : sizes) {
        const std::string name = std::to_string(size[0]) + "x" + std::to_string(size[1]);
        accuracy::Random random = set.random(name);
        add_frame(set, "noise-" + name, Tier::stress, {"noise", "odd-size"}, noise(size[0], size[1], random));
    }
    for (int i = 0; i < 6; i++) {
        const std::string name = "grain-" + std::to_string(i);
        accuracy::Random random = set.random(name);
        cv::Mat image = noise(90, 84, random, 0, 8 + 14 * i);
        image += discs(90, 84, 150, drogue(186, 164, 100 + 10 * i, 70, 5, 10, -8));
        add_frame(set, name, Tier::stress, {"noise"}, image, 3 + i);
    }
    for (const int number : {1, 153, 224, 604}) { /* discs beside each other wait, and more than there is room for */
        add_frame(set, "texture-" + std::to_string(number), Tier::stress, {"noise", "table-full"},
                  textured(static_cast<uint64_t>(number), false));
    }
    for (const int number : {12, 21, 93}) { /* places are looked at 128 at a time: one is left over */
        add_frame(set, "texture-wide-" + std::to_string(number), Tier::stress, {"noise", "table-full"},
                  textured(static_cast<uint64_t>(number), true));
    }
    accuracy::Random random = set.random("levels");
    add_frame(set, "few-levels", Tier::stress, {"tie"}, few_levels(70, 60, random, {20, 40, 60}), 5);
    add_frame(set, "flat", Tier::must_reject, {"degenerate"}, constant(80, 80, 100));
}

} // namespace vectors
