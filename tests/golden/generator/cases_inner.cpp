/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of the inner inner part: Otsu's threshold with its ties, the disc, the opening, equal areas. */
#include <stdexcept>

#include "images.hpp"

namespace vectors {

namespace {

struct Disc {
    int centre2_x, centre2_y, longest;
};

Disc whole(const cv::Mat &image) { return {image.cols - 1, image.rows - 1, 3 * (image.cols + image.rows)}; }

Disc inscribed(const cv::Mat &image) { return {image.cols - 1, image.rows - 1, std::max(image.cols, image.rows)}; }

void add_part(Set &set, const std::string &name, Tier tier, const Flags &flags, const cv::Mat &image, const Disc &d,
              int min_area)
{
    set.add(
        name, tier, flags,
        {image_array("image", image), word_array("params", 32, 0, {d.centre2_x, d.centre2_y, d.longest, min_area})});
}

/* Image with the given count of pixels of each level, dark ones first, in rows of the given width. */
cv::Mat with_histogram(int width, const std::vector<std::pair<int, int>> &level_counts)
{
    std::vector<int> pixels;
    for (const auto &lc : level_counts) {
        pixels.insert(pixels.end(), static_cast<size_t>(lc.second), lc.first);
    }
    if (pixels.size() % static_cast<size_t>(width) != 0) {
        throw std::runtime_error("the histogram does not fill whole rows");
    }
    return image_from(width, static_cast<int>(pixels.size()) / width,
                      [&](int x, int y) { return pixels[static_cast<size_t>(y * width + x)]; });
}

void add_thresholds(Set &set)
{
    struct Histogram {
        const char *name;
        int width;
        std::vector<std::pair<int, int>> counts;
        Flags flags;
    };
    static const Histogram histograms[] = {
        {"otsu-two-levels", 8, {{50, 24}, {200, 40}}, {"plateau", "otsu-tie"}}, /* every level between is as good */
        {"otsu-neighbours", 8, {{127, 32}, {128, 32}}, {"otsu-tie"}},
        {"otsu-symmetric", 8, {{10, 16}, {20, 16}, {30, 16}}, {"otsu-tie"}}, /* two thresholds of equal variance */
        {"otsu-symmetric-five", 10, {{0, 20}, {64, 10}, {128, 20}, {192, 10}, {255, 20}}, {"otsu-tie"}},
        {"otsu-near-tie", 9, {{10, 27}, {20, 27}, {30, 27}, {31, 9}}, {"otsu-tie"}},
        {"otsu-near-tie-back", 9, {{9, 9}, {10, 27}, {20, 27}, {30, 27}}, {"otsu-tie"}},
        {"otsu-extremes", 8, {{0, 8}, {255, 56}}, {"saturation"}},
        {"otsu-single-bright", 8, {{40, 63}, {41, 1}}, {"otsu-tie"}},
        {"otsu-single-dark", 8, {{0, 9}, {254, 54}, {255, 1}}, {"saturation"}},
        {"otsu-last-level", 8, {{254, 24}, {255, 40}}, {"saturation"}},
        {"one-level", 8, {{90, 64}}, {"degenerate"}},
    };
    for (const Histogram &h : histograms) {
        const cv::Mat image = with_histogram(h.width, h.counts);
        add_part(set, h.name, h.name == std::string("one-level") ? Tier::must_reject : Tier::boundary, h.flags, image,
                 whole(image), 1);
    }
    const cv::Mat black = constant(12, 9, 0);
    add_part(set, "all-black", Tier::boundary, {"degenerate"}, black, whole(black), 9);
}

/* Dark shapes on a bright ground. */
cv::Mat with_blocks(int width, int height, const std::vector<cv::Rect> &blocks, int ink = 20, int paper = 200)
{
    cv::Mat image = constant(width, height, paper);
    for (const cv::Rect &b : blocks) {
        fill(image, b.x, b.y, b.width, b.height, ink);
    }
    return image;
}

void add_shapes(Set &set)
{
    struct Shape {
        const char *name;
        cv::Mat image;
        int min_area;
        Tier tier;
        Flags flags;
    };
    cv::Mat snake = constant(49, 41, 190);
    stroke(snake, serpentine(49, 41, 8), 4, 15);
    cv::Mat coil = constant(55, 55, 190);
    stroke(coil, spiral(55, 55, 8), 3, 15);
    const Shape shapes[] = {
        {"block-3x3", with_blocks(24, 20, {{9, 8, 3, 3}}), 9, Tier::boundary, {"threshold-met", "opening"}},
        {"block-3x3-too-small", with_blocks(24, 20, {{9, 8, 3, 3}}), 10, Tier::must_reject, {"threshold-met"}},
        {"block-2x9", with_blocks(24, 20, {{9, 8, 2, 9}}), 1, Tier::must_reject, {"opening"}},
        {"block-9x2", with_blocks(24, 20, {{9, 8, 9, 2}}), 1, Tier::must_reject, {"opening"}},
        {"block-with-spurs",
         with_blocks(30, 26, {{9, 8, 8, 7}, {12, 2, 1, 6}, {17, 10, 8, 2}, {4, 13, 5, 1}}),
         9,
         Tier::ordinary,
         {"opening"}},
        {"block-with-hole", with_blocks(30, 26, {{9, 8, 8, 7}, {12, 11, 1, 1}}), 9, Tier::ordinary, {"opening"}},
        {"corners-touch", with_blocks(24, 24, {{6, 6, 4, 4}, {10, 10, 4, 5}}), 9, Tier::ordinary, {"label-merge"}},
        {"corners-touch-back", with_blocks(24, 24, {{10, 6, 4, 4}, {6, 10, 4, 5}}), 9, Tier::ordinary, {"label-merge"}},
        {"equal-areas", with_blocks(40, 24, {{22, 4, 5, 4}, {8, 12, 4, 5}}), 9, Tier::boundary, {"equal-areas", "tie"}},
        {"equal-areas-side-by-side",
         with_blocks(40, 24, {{24, 8, 4, 4}, {8, 8, 4, 4}}),
         9,
         Tier::boundary,
         {"equal-areas", "tie"}},
        {"second-is-larger", with_blocks(40, 24, {{6, 4, 4, 4}, {20, 12, 4, 5}}), 9, Tier::ordinary, {}},
        {"at-borders",
         with_blocks(20, 16, {{0, 0, 3, 3}, {15, 0, 5, 3}, {0, 12, 3, 4}, {16, 13, 4, 3}}),
         6,
         Tier::boundary,
         {"border", "opening"}},
        {"frame",
         with_blocks(20, 18, {{0, 0, 20, 2}, {0, 16, 20, 2}, {0, 0, 2, 18}, {18, 0, 2, 18}}),
         1,
         Tier::boundary,
         {"border", "opening", "label-merge"}},
        {"one-row",
         with_blocks(30, 1, {{5, 0, 3, 1}, {12, 0, 2, 1}, {20, 0, 6, 1}}),
         1,
         Tier::boundary,
         {"1xN", "opening"}},
        {"one-column",
         with_blocks(1, 30, {{0, 5, 1, 3}, {0, 12, 1, 2}, {0, 20, 1, 6}}),
         1,
         Tier::boundary,
         {"1xN", "opening"}},
        {"serpentine", snake, 9, Tier::stress, {"label-merge"}},
        {"spiral", coil, 9, Tier::stress, {"label-merge"}},
        {"comb", comb(60, 40, 8, 4, true, 10, 200), 9, Tier::stress, {"label-merge"}},
        {"comb-and-block", with_blocks(8, 8, {{1, 1, 6, 6}}), 36, Tier::boundary, {"threshold-met"}},
    };
    for (const Shape &s : shapes) {
        add_part(set, s.name, s.tier, s.flags, s.image, whole(s.image), s.min_area);
    }
}

} // namespace

void add_centroid(Set &set)
{
    set.begin("centroid");
    add_thresholds(set);
    add_shapes(set);
    accuracy::Random random = set.random("centroid");
    const cv::Mat inner = soft_disc(64, 64, 70, 58, 60, 8, 15, 150);
    add_part(set, "disc", Tier::ordinary, {}, inner, inscribed(inner), 9);
    add_part(set, "disc-whole-image", Tier::ordinary, {}, inner, whole(inner), 9);
    add_part(set, "disc-beside", Tier::boundary, {"border"}, inner, {-20, 63, 96}, 9);
    add_part(set, "disc-beyond", Tier::boundary, {"border"}, inner, {140, 150, 96}, 9);
    add_part(set, "disc-above", Tier::boundary, {"border", "rounding-negative"}, inner, {61, -33, 96}, 9);
    add_part(set, "disc-off-image", Tier::must_reject, {"border"}, inner, {500, 500, 96}, 9);
    add_part(set, "disc-empty", Tier::must_reject, {"argument"}, inner, {63, 63, 0}, 9);
    add_part(set, "disc-centre-too-far", Tier::must_reject, {"argument"}, inner, {63, -32769, 99000}, 9);
    add_part(set, "disc-centre-far", Tier::boundary, {"border"}, inner, {63, -32768, 49250}, 9);
    add_part(set, "disc-smallest", Tier::boundary, {"threshold-met"}, constant(9, 9, 0), {8, 8, 1}, 1);
    add_part(set, "two-pixels", Tier::must_reject, {"degenerate"},
             image_from(2, 1, [](int x, int) { return 40 * x + 3; }), {1, 0, 9}, 1);
    add_part(set, "1x2048", Tier::stress, {"1xN"}, image_from(1, 2048, [](int, int y) { return y / 64 % 5 * 50; }),
             {0, 2047, 6000}, 9);
    for (int longest = 51; longest <= 66; longest += 3) { /* up to the border, on it, past it */
        add_part(set, "disc-near-border-" + std::to_string(longest), Tier::boundary, {"border"},
                 image_from(39, 37, [](int x, int y) { return (x == 0 || x == 38 ? 0 : 130) + 3 * y; }),
                 {38, 37, longest}, 2);
    }
    add_part(set, "disc-largest", Tier::boundary, {"saturation"}, inner, {63, 63, 1048576}, 9);
    /* pixels on the disc's circle: radius 10 and (6, 8), then half-pixel centres */
    for (const int longest : {29, 30, 31}) {
        add_part(set, "circle-of-" + std::to_string(longest), Tier::boundary, {"tie"}, constant(31, 31, 0),
                 {30, 30, longest}, 1);
    }
    /* the four outermost pixels of a disc of radius 10 alone differ: each decides whether there is a threshold */
    static const int outermost[][2] = {{15, 5}, {15, 25}, {5, 15}, {25, 15}};
    for (size_t k = 0; k < 4; k++) {
        const int *at = outermost[k];
        add_part(set, "outermost-pixel-" + std::to_string(k), Tier::boundary, {"tie"},
                 image_from(31, 31, [at](int x, int y) { return x == at[0] && y == at[1] ? 200 : 100; }), {30, 30, 30},
                 1);
    }
    add_part(set, "circle-half-pixel", Tier::boundary, {"tie"}, constant(32, 32, 0), {31, 31, 30}, 1);
    add_part(set, "circle-mixed-centre", Tier::boundary, {"tie"}, constant(32, 31, 0), {31, 30, 75}, 1);
    add_part(set, "noise", Tier::ordinary, {"label-merge"}, noise(64, 60, random), {64, 60, 150}, 4);
    add_part(set, "noise-smooth-ground", Tier::ordinary, {},
             image_from(60, 60,
                        [&](int x, int y) {
                            const int d = (x - 33) * (x - 33) + (y - 28) * (y - 28);
                            return (d < 150 ? 20 : 120) + between(random, -15, 15) + x / 2;
                        }),
             {60, 58, 80}, 9);
    add_part(set, "blocks-of-noise", Tier::stress, {"label-merge"},
             image_from(72, 60,
                        [&, cells = noise(18, 15, random)](int x, int y) {
                            return cells.at<uint8_t>(y / 4, x / 4) < 110 ? 30 : 180;
                        }),
             {71, 59, 400}, 9);
    add_part(set, "large-sums", Tier::stress, {"saturation", "otsu-tie"},
             image_from(200, 180, [&](int x, int y) { return (x * x + y * y * 3) / 600 + between(random, 0, 40); }),
             {199, 179, 700}, 9);
    add_part(set, "2048x3", Tier::stress, {"border"},
             image_from(2048, 3, [](int x, int) { return x / 100 % 3 == 1 ? 30 : 170 + x % 7; }), {2047, 2, 5000}, 9);
    add_part(set, "inner-missing", Tier::ordinary, {}, noise(40, 40, random, 90, 99), {39, 39, 90}, 9);
}

} // namespace vectors
