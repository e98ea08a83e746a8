/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of smoothing, gradient and masks: every border rule, every rounding tie, every weight of a kernel alone. */
#include "images.hpp"

namespace vectors {

namespace {

std::string size_name(const char *what, int width, int height)
{
    return std::string(what) + "-" + std::to_string(width) + "x" + std::to_string(height);
}

/* Lone pixels of increasing grey, far enough apart that their 5x5 neighbourhoods do not touch. */
cv::Mat lone_pixels(int first, int step, int pitch, int columns, int rows, int paper)
{
    cv::Mat image = constant(columns * pitch, rows * pitch, paper);
    for (int i = 0; i < columns * rows; i++) {
        fill(image, i % columns * pitch + pitch / 2, i / columns * pitch + pitch / 2, 1, 1, (first + i * step) & 255);
    }
    return image;
}

/* A lone pixel in a corner, on a border, in the middle. */
cv::Mat one_pixel(int side, int x, int y, int ink, int paper)
{
    cv::Mat image = constant(side, side, paper);
    fill(image, x, y, 1, 1, ink);
    return image;
}

/* Images that both filters take. */
void add_common(Set &set)
{
    static const int odd_sizes[][2] = {{1, 1}, {2, 1}, {1, 2}, {3, 1},  {1, 3},  {4, 1},  {1, 4},  {5, 1},
                                       {1, 5}, {2, 2}, {3, 2}, {2, 3},  {3, 3},  {4, 3},  {5, 4},  {4, 5},
                                       {5, 5}, {6, 5}, {7, 6}, {1, 40}, {40, 1}, {2, 17}, {17, 2}, {31, 33}};
    for (const auto &size : odd_sizes) {
        const std::string name = size_name("noise", size[0], size[1]);
        accuracy::Random random = set.random(name);
        const bool thin = size[0] == 1 || size[1] == 1;
        set.add(name, Tier::boundary, {thin ? "1xN" : "odd-size", "border"},
                {image_array("image", noise(size[0], size[1], random))});
    }
    accuracy::Random random = set.random("noise");
    set.add("noise-64x48", Tier::ordinary, {}, {image_array("image", noise(64, 48, random))});
    set.add("noise-2048x2", Tier::stress, {"border"}, {image_array("image", noise(2048, 2, random))});
    set.add("noise-1x2048", Tier::stress, {"border", "1xN"}, {image_array("image", noise(1, 2048, random))});
    set.add("noise-3x200", Tier::stress, {"border"}, {image_array("image", noise(3, 200, random))});
    set.add("extremes", Tier::stress, {"saturation"}, {image_array("image", few_levels(40, 40, random, {0, 255}))});
    set.add("white", Tier::boundary, {"saturation"}, {image_array("image", constant(9, 7, 255))});
    set.add("checker", Tier::stress, {"saturation"},
            {image_array("image", image_from(16, 16, [](int x, int y) { return (x + y) % 2 * 255; }))});
    set.add("columns", Tier::ordinary, {},
            {image_array("image", image_from(24, 9, [](int x, int) { return x / 3 % 2 * 255; }))});
    set.add("rows", Tier::ordinary, {},
            {image_array("image", image_from(9, 24, [](int, int y) { return y / 3 % 2 * 255; }))});
    set.add("ramp", Tier::ordinary, {},
            {image_array("image", image_from(52, 20, [](int x, int y) { return 3 * x + 5 * y; }))});
    set.add("disc", Tier::ordinary, {}, {image_array("image", disc_image(48, 48, 70, 40, 200))});
    set.add("corner", Tier::boundary, {"border"}, {image_array("image", one_pixel(9, 0, 0, 255, 0))});
    set.add("last-corner", Tier::boundary, {"border"}, {image_array("image", one_pixel(9, 8, 8, 255, 0))});
    set.add("edge", Tier::boundary, {"border"}, {image_array("image", one_pixel(9, 8, 3, 0, 255))});
}

} // namespace

void add_smooth(Set &set)
{
    set.begin("smooth");
    add_common(set);
    /* weights 1, 4, 6, 16, 24, 36 of 256: all grey levels of a lone pixel pass every tie of the rounding */
    set.add("weights-dark", Tier::boundary, {"tie"}, {image_array("image", lone_pixels(0, 4, 5, 8, 8, 0))});
    set.add("weights-odd", Tier::boundary, {"tie"}, {image_array("image", lone_pixels(2, 4, 5, 8, 8, 0))});
    set.add("weights-bright", Tier::boundary, {"tie", "saturation"},
            {image_array("image", lone_pixels(127, 2, 5, 8, 8, 255))});
    set.add("reflect-101", Tier::boundary, {"reflect-101"},
            {image_array("image", image_from(12, 12, [](int x, int y) { return x * x * 2 + y * y; }))});
}

void add_gradient(Set &set)
{
    set.begin("gradient");
    add_common(set);
    set.add("weights", Tier::ordinary, {}, {image_array("image", lone_pixels(1, 7, 3, 8, 8, 0))});
    set.add("full-step", Tier::boundary, {"saturation"},
            {image_array("image", image_from(8, 8, [](int x, int y) { return x < 4 && y < 4 ? 255 : 0; }))});
}

void add_mask(Set &set)
{
    struct Mask {
        const char *name;
        int width, height, centre2_x, centre2_y, longest;
        Tier tier;
        Flags flags;
    };
    static const Mask masks[] = {
        {"square-30", 31, 31, 30, 30, 30, Tier::boundary, {"tie"}}, /* (6, 8) and (9, 12) lie on the circles */
        {"square-60", 61, 61, 60, 60, 60, Tier::boundary, {"tie"}},
        {"square-24", 26, 26, 24, 24, 24, Tier::boundary, {"tie"}},
        {"even-32", 32, 32, 31, 31, 32, Tier::ordinary, {}},
        {"odd-33", 33, 33, 32, 32, 33, Tier::ordinary, {"odd-size"}},
        {"even-34", 34, 34, 33, 33, 34, Tier::ordinary, {"tie"}},                   /* outer radius 17: (8, 15) */
        {"half-pixel-50", 51, 50, 49, 50, 50, Tier::boundary, {"tie", "odd-size"}}, /* (7.5, 10) .. (12, 16.5) */
        {"wide", 48, 20, 47, 19, 48, Tier::ordinary, {"border"}},
        {"tall", 20, 48, 19, 47, 48, Tier::ordinary, {"border"}},
        {"1x40", 1, 40, 0, 39, 40, Tier::boundary, {"1xN"}},
        {"40x1", 40, 1, 39, 0, 40, Tier::boundary, {"1xN"}},
        {"single", 1, 1, 0, 0, 1, Tier::boundary, {"1xN"}},
        {"two", 2, 2, 1, 1, 2, Tier::boundary, {"tie"}},
        {"three", 3, 3, 2, 2, 3, Tier::boundary, {"tie"}},
        {"five", 5, 5, 4, 4, 5, Tier::boundary, {"tie"}},
        {"centre-left-of-image", 24, 24, -10, 23, 60, Tier::boundary, {"border", "rounding-negative"}},
        {"centre-above-image", 24, 24, 23, -31, 66, Tier::boundary, {"border", "rounding-negative"}},
        {"centre-beyond-image", 24, 24, 71, 80, 90, Tier::boundary, {"border"}},
        {"off-image", 24, 24, 4000, 4000, 60, Tier::boundary, {"border"}},
        {"farthest-centre", 24, 24, 32768, -32768, 46322, Tier::boundary, {"border", "rounding-negative"}},
        {"farthest-centre-inner", 24, 24, -32768, 32768, 69500, Tier::boundary, {"border", "rounding-negative"}},
        {"covers-all", 24, 24, 23, 23, 4096, Tier::boundary, {"saturation"}},
        {"largest", 24, 24, 23, 23, 1048576, Tier::stress, {"saturation"}}, /* squares of 40 bits */
        {"2048x3", 2048, 3, 2047, 2, 2048, Tier::stress, {"border"}},
    };
    set.begin("mask");
    for (const Mask &m : masks) {
        set.add(m.name, m.tier, m.flags,
                {word_array("params", 32, 0, {m.width, m.height, m.centre2_x, m.centre2_y, m.longest})});
    }
}

} // namespace vectors
