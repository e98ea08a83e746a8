/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of the one-pass front end: arcs of one direction class, their order, subpixel offsets, full tables. */
#include <functional>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "images.hpp"
#include "reference.hpp"
#include "stages.h"

namespace vectors {

namespace {

struct Front {
    int low = 40, high = 100, smooth = 1, use_ring = 0;
    int centre2_x = 0, centre2_y = 0, longest = 0;
    int min_arc = 1;
};

Front with_ring(const cv::Mat &image, Front f = {})
{
    f.use_ring = 1;
    f.centre2_x = image.cols - 1;
    f.centre2_y = image.rows - 1;
    f.longest = std::max(image.cols, image.rows);
    return f;
}

Front thresholds(int low, int high, int smooth, int min_arc)
{
    Front f;
    f.low = low;
    f.high = high;
    f.smooth = smooth;
    f.min_arc = min_arc;
    return f;
}

void add_front(Set &set, const std::string &name, Tier tier, const Flags &flags, const cv::Mat &image, const Front &f)
{
    set.add(name, tier, flags,
            {image_array("image", image),
             word_array("params", 32, 0,
                        {f.low, f.high, f.smooth, f.use_ring, f.centre2_x, f.centre2_y, f.longest, f.min_arc})});
}

/* Lengths of the arcs of an image, by the reference. */
std::vector<int> arc_lengths(const cv::Mat &image, const Front &f)
{
    const cv::Mat smoothed = f.smooth ? reference::smooth(image) : image;
    cv::Mat gx, gy;
    const cv::Mat edges =
        f.use_ring
            ? reference::canny_within(image, f.low, f.high, f.smooth != 0,
                                      reference::ring(image.cols, image.rows, f.centre2_x, f.centre2_y, f.longest))
            : reference::canny(image, f.low, f.high, f.smooth != 0);
    reference::gradient(smoothed, gx, gy);
    std::vector<int> lengths;
    for (const reference::Arc &a : reference::arcs(edges, gx, gy)) {
        lengths.push_back(static_cast<int>(a.pixels.size()));
    }
    return lengths;
}

void add_least_length(Set &set)
{
    const cv::Mat image = soft_disc(48, 48, 47, 47, 80, 8, 40, 200);
    Front f = with_ring(image);
    const std::vector<int> lengths = arc_lengths(image, f);
    if (lengths.empty() || lengths[0] < 10) {
        throw std::runtime_error("the disc has no long arc");
    }
    f.min_arc = lengths[0];
    add_front(set, "least-length-met", Tier::boundary, {"threshold-met"}, image, f);
    f.min_arc++;
    add_front(set, "least-length-missed", Tier::boundary, {"threshold-met"}, image, f);
    f.min_arc = 2147483647;
    add_front(set, "least-length-huge", Tier::boundary, {"saturation"}, image, f);
    f.min_arc = 0;
    add_front(set, "least-length-zero", Tier::boundary, {"degenerate"}, image, f);
}

/* Dots that give whole numbers of arcs each, as many as the arc table holds, and one more. */
void add_full_arcs(Set &set)
{
    const int pitch = 6;
    const Front f = thresholds(100, 200, 0, 1);
    cv::Mat image = constant(22 * pitch, 22 * pitch, 0);
    const auto arcs = [&] { return static_cast<int>(arc_lengths(image, f).size()); };
    fill(image, pitch / 2, pitch / 2, 1, 1, 200);
    const int each = arcs();
    int dots = 1;
    while (each > 0 && (dots + 1) * each <= CONF_MAX_ARCS) {
        fill(image, dots % 22 * pitch + pitch / 2, dots / 22 * pitch + pitch / 2, 1, 1, 200);
        dots++;
    }
    if (arcs() != CONF_MAX_ARCS) {
        throw std::runtime_error("the dots do not fill the arc table");
    }
    add_front(set, "arcs-all-used", Tier::boundary, {"table-full"}, image, f);
    fill(image, dots % 22 * pitch + pitch / 2, dots / 22 * pitch + pitch / 2, 1, 1, 200);
    add_front(set, "arcs-full", Tier::must_reject, {"table-full"}, image, f);
}

/* One candidate more in the ring than the edge list holds: found by moving a large ring's outer circle to the left. */
void add_full_edges(Set &set)
{
    const cv::Mat image = image_from(2048, 26, [](int x, int) { return x % 3 == 2 ? 255 : 0; });
    Front f = thresholds(200, 400, 0, 2147483647);
    const cv::Mat candidates = reference::canny(image, f.low, f.low, false);
    f.use_ring = 1;
    f.longest = 16384;
    const auto count = [&](int centre2_x) {
        return cv::countNonZero(candidates &
                                reference::ring(image.cols, image.rows, centre2_x, f.centre2_y, f.longest));
    };
    for (f.centre2_y = 0; f.centre2_y < 4000; f.centre2_y += 40) {
        int few = -13400; /* bisect for the last place with no more than wanted */
        int many = -11000;
        while (many - few > 1) {
            const int middle = few + (many - few) / 2;
            (count(middle) > CONF_MAX_EDGES + 1 ? many : few) = middle;
        }
        if (count(few) == CONF_MAX_EDGES + 1) {
            f.centre2_x = few;
            add_front(set, "edges-full", Tier::must_reject, {"table-full"}, image, f);
            return;
        }
    }
    throw std::runtime_error("no ring holds one candidate too many");
}

/* As many labels as there are, refused at the last: four arcs a dot, none of which merge. */
void add_full_labels(Set &set)
{
    const Front f = thresholds(100, 200, 0, 2147483647);
    const int pitch = 5;
    cv::Mat image = constant(46 * pitch, 45 * pitch, 0);
    for (int i = 0; i < CONF_MAX_LABELS / 4; i++) { /* label 0 is none: one too many */
        fill(image, i % 46 * pitch + pitch / 2, i / 46 * pitch + pitch / 2, 1, 1, 200);
    }
    if (arc_lengths(image, f).size() != CONF_MAX_LABELS) {
        throw std::runtime_error("the dots do not fill the labels");
    }
    add_front(set, "labels-full", Tier::must_reject, {"table-full"}, image, f);
}

/* The range of a mask's centre and side, met and passed on every side. */
void add_mask_range(Set &set)
{
    const cv::Mat image = soft_disc(16, 16, 15, 15, 26, 4, 200, 40);
    static const int masks[][3] = {{15, 15, 1},        {15, 15, 0},         {15, 15, 1048576},   {32768, 15, 32800},
                                   {32769, 15, 32800}, {-32768, 15, 32800}, {-32769, 15, 32800}, {15, 32768, 32800},
                                   {15, 32769, 32800}, {15, -32768, 32800}, {15, -32769, 32800}};
    for (const auto &m : masks) {
        const bool valid = m[2] >= 1 && std::abs(m[0]) <= 32768 && std::abs(m[1]) <= 32768;
        Front f = thresholds(40, 100, 1, 2);
        f.use_ring = 1;
        f.centre2_x = m[0];
        f.centre2_y = m[1];
        f.longest = m[2];
        const std::string name =
            "mask-" + std::to_string(m[0]) + "-" + std::to_string(m[1]) + "-" + std::to_string(m[2]);
        add_front(set, name, valid ? Tier::boundary : Tier::must_reject, {"threshold-met", "mask-range"}, image, f);
    }
}

} // namespace

void add_arcs(Set &set)
{
    set.begin("arcs");
    static const int sizes[][2] = {{1, 1}, {1, 30}, {30, 1}, {2, 2}, {3, 3}, {2, 25}, {25, 2}, {7, 5}, {33, 31}};
    for (const auto &s : sizes) {
        const std::string name = "noise-" + std::to_string(s[0]) + "x" + std::to_string(s[1]);
        accuracy::Random random = set.random(name);
        const bool thin = s[0] == 1 || s[1] == 1;
        add_front(set, name, Tier::boundary, {thin ? "1xN" : "odd-size", "border"}, noise(s[0], s[1], random),
                  thresholds(100, 300, 0, 1));
    }
    accuracy::Random random = set.random("arcs");
    add_front(set, "noise", Tier::stress, {"label-merge"}, noise(48, 48, random), thresholds(200, 600, 0, 3));
    add_front(set, "noise-smoothed", Tier::ordinary, {"label-merge"}, noise(60, 60, random), thresholds(20, 90, 1, 4));
    add_front(set, "noise-dense", Tier::stress, {"label-merge"}, noise(40, 40, random), thresholds(0, 0, 0, 1));
    const cv::Mat grain = noise(61, 50, random);
    add_front(set, "noise-ring", Tier::ordinary, {}, grain, with_ring(grain, thresholds(100, 300, 0, 2)));
    add_front(set, "plateaus", Tier::boundary, {"plateau", "tie"}, few_levels(40, 40, random, {0, 30, 60}),
              thresholds(60, 180, 0, 2));
    add_front(set, "extremes", Tier::stress, {"saturation", "tie"}, few_levels(40, 40, random, {0, 255}),
              thresholds(300, 900, 0, 2));
    add_front(set, "flat", Tier::boundary, {"degenerate"}, constant(12, 12, 9), thresholds(0, 0, 1, 1));

    const cv::Mat dark = soft_disc(64, 64, 63, 63, 108, 8, 50, 210);
    const cv::Mat bright = soft_disc(65, 62, 65, 60, 100, 6, 220, 90);
    add_front(set, "disc-dark", Tier::ordinary, {}, dark, with_ring(dark));
    add_front(set, "disc-bright", Tier::ordinary, {"odd-size"}, bright, with_ring(bright));
    add_front(set, "disc-whole-image", Tier::ordinary, {}, dark, thresholds(40, 100, 1, 10));
    add_front(set, "disc-step", Tier::boundary, {"axis-gradient", "tie"}, disc_image(48, 48, 72, 0, 200),
              thresholds(40, 100, 0, 5));
    Front off = with_ring(dark);
    off.centre2_x -= 31;
    off.centre2_y += 14;
    add_front(set, "ring-off-centre", Tier::ordinary, {}, dark, off);
    off.centre2_x = -64;
    off.longest = 120;
    add_front(set, "ring-beside-image", Tier::boundary, {"border"}, dark, off);

    /* A strip across the ring, faint in it but for what is beside it; then it is strong in the ring, too. */
    for (const int within : {0, 1}) {
        const Front f = with_ring(dark, thresholds(60, 300, 0, 1));
        cv::Mat mask; /* with what the gradient sees beside it */
        cv::dilate(reference::ring(64, 64, f.centre2_x, f.centre2_y, f.longest), mask, cv::Mat::ones(5, 5, CV_8U));
        add_front(set, within ? "ring-strong-within" : "ring-strong-without", Tier::boundary, {"long-weak-chain"},
                  image_from(64, 64,
                             [&](int x, int y) {
                                 const bool bright = mask.at<uint8_t>(y, x) == 0 || (within && x < 8);
                                 return y / 8 == 4 ? (bright ? 180 : 130) : 100;
                             }),
                  f);
    }

    /* gx = 0 or gy = 0 all along a side; corners where the class changes */
    cv::Mat square = constant(40, 40, 60);
    fill(square, 10, 10, 20, 20, 160);
    add_front(set, "square", Tier::boundary, {"axis-gradient", "plateau"}, square, thresholds(40, 100, 1, 1));
    add_front(set, "square-dark", Tier::boundary, {"axis-gradient", "plateau"},
              image_from(40, 40, [&](int x, int y) { return 220 - square.at<uint8_t>(y, x); }),
              thresholds(40, 100, 0, 1));
    add_front(set, "diagonals", Tier::boundary, {"tie"},
              image_from(36, 36, [](int x, int y) { return (x + y) / 9 % 2 * 120 + (x - y + 36) / 12 % 2 * 60; }),
              thresholds(40, 100, 0, 1));

    cv::Mat snake = constant(53, 53, 80);
    stroke(snake, serpentine(53, 53, 8), 4, 120);
    add_front(set, "serpentine", Tier::stress, {"long-weak-chain", "label-merge"}, snake, thresholds(30, 200, 0, 3));
    cv::Mat coil = constant(63, 63, 120);
    stroke(coil, spiral(63, 63, 8), 4, 80);
    fill(coil, 30, 30, 3, 3, 0);
    add_front(set, "spiral", Tier::stress, {"long-weak-chain", "label-merge"}, coil, thresholds(30, 250, 0, 3));
    add_front(set, "comb", Tier::stress, {"label-merge"}, comb(60, 36, 6, 3, true, 200, 60), thresholds(30, 200, 0, 2));
    /* rounded waves: arcs of one class that meet from both sides further down */
    add_front(set, "waves", Tier::stress, {"label-merge"},
              image_from(56, 56,
                         [](int x, int y) {
                             const int u = x % 14 - 7;
                             return (y + u * u / 2) / 10 % 2 * 100 + 50;
                         }),
              thresholds(40, 100, 1, 1));
    add_front(set, "rings", Tier::stress, {"label-merge"},
              image_from(60, 60,
                         [](int x, int y) {
                             const int d = (2 * x - 59) * (2 * x - 59) + (2 * y - 59) * (2 * y - 59);
                             return d / 400 % 2 * 140 + 50;
                         }),
              thresholds(40, 200, 1, 6));
    add_least_length(set);
    add_full_arcs(set);
    add_full_edges(set);
    add_full_labels(set);
    add_mask_range(set);
    Front bad = thresholds(50, 49, 1, 1);
    add_front(set, "low-above-high", Tier::must_reject, {"argument"}, dark, bad);
    bad = thresholds(-1, 49, 1, 1);
    add_front(set, "low-negative", Tier::must_reject, {"argument"}, dark, bad);
}

} // namespace vectors
