/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of Canny's edge map: sectors, equal magnitudes, thresholds, hysteresis. */
#include <array>
#include <stdexcept>

#include "images.hpp"
#include "reference.hpp"

namespace vectors {

namespace {

void add_map(Set &set, const std::string &name, Tier tier, const Flags &flags, const cv::Mat &image, int low, int high,
             int smooth)
{
    set.add(name, tier, flags, {image_array("image", image), word_array("params", 32, 0, {low, high, smooth})});
}

/* A 5x5 patch whose middle has the given gradient, and whose magnitudes around it make the verdict on the middle
 * depend on the sector that the gradient falls into: horizontal or vertical ('axis') against diagonal. */
bool sector_patch(cv::Mat &patch, accuracy::Random &random, int gx, int gy)
{
    std::array<int, 9> p; /* rows of the inner 3x3 */
    for (int &v : p) {
        v = between(random, 0, 255);
    }
    const int dx = gx - (p[2] - p[0]) - (p[8] - p[6]);
    const int dy = gy - (p[6] - p[0]) - (p[8] - p[2]);
    if (dx % 2 != 0 || dy % 2 != 0 || std::abs(dx) > 510 || std::abs(dy) > 510) {
        return false;
    }
    const int left = between(random, std::max(0, -dx / 2), 255 - std::max(0, dx / 2));
    const int top = between(random, std::max(0, -dy / 2), 255 - std::max(0, dy / 2));
    p[3] = left;
    p[5] = left + dx / 2;
    p[1] = top;
    p[7] = top + dy / 2;
    patch = noise(5, 5, random);
    for (int i = 0; i < 9; i++) {
        patch.at<uint8_t>(1 + i / 3, 1 + i % 3) = static_cast<uint8_t>(p[static_cast<size_t>(i)]);
    }
    cv::Mat ex, ey;
    reference::gradient(patch, ex, ey);
    const auto magnitude = [&](int x, int y) {
        return std::abs(ex.at<int16_t>(y, x)) + std::abs(ey.at<int16_t>(y, x));
    };
    if (ex.at<int16_t>(2, 2) != gx || ey.at<int16_t>(2, 2) != gy) {
        throw std::runtime_error("the patch has another gradient");
    }
    const int m = magnitude(2, 2);
    const bool across = std::abs(gx) > std::abs(gy);
    const bool axis =
        across ? m > magnitude(1, 2) && m >= magnitude(3, 2) : m > magnitude(2, 1) && m >= magnitude(2, 3);
    const int s = (gx ^ gy) < 0 ? -1 : 1;
    const bool diagonal = m > magnitude(2 - s, 1) && m > magnitude(2 + s, 3);
    return axis != diagonal;
}

/* Gradients next to the border of the sectors, tan 22.5 degrees: the nearest fractions on both sides among those that a
 * gradient can have, whose components are both odd or both even. */
cv::Mat sector_borders(accuracy::Random &random)
{
    static const int fractions[][2] = {{577, 239}, {816, 338}, {239, 99}, {338, 140}, {99, 41}, {478, 198}};
    const int pitch = 7;
    cv::Mat image = constant(12 * pitch, 8 * pitch, 0);
    int tile = 0;
    for (const auto &f : fractions) {
        for (int variant = 0; variant < 16; variant++, tile++) {
            const int major = variant & 1 ? -f[0] : f[0];
            const int minor = variant & 2 ? -f[1] : f[1];
            cv::Mat patch;
            long tries = 0;
            while (!sector_patch(patch, random, variant & 4 ? minor : major, variant & 4 ? major : minor)) {
                if (++tries > 10000000) {
                    throw std::runtime_error("no patch for a gradient on a sector's border");
                }
            }
            patch.copyTo(image(cv::Rect(tile % 12 * pitch + 1, tile / 12 * pitch + 1, 5, 5)));
        }
    }
    return image;
}

/* Least threshold that at most 'count' pixels of the smoothed image exceed. */
int threshold_for(const cv::Mat &image, int count)
{
    int high = 0;
    while (cv::countNonZero(reference::canny(image, high, high, true)) > count) {
        high++;
    }
    return high;
}

/* A weak ring with a single strong pixel: hysteresis must carry it around all of the circle. */
void add_weak_ring(Set &set)
{
    const int low = 12;
    for (int grey = 120; grey < 150; grey++) {
        cv::Mat image = soft_disc(160, 160, 159, 159, 300, 12, 100, 116);
        fill(image, 156, 78, 2, 1, grey);
        fill(image, 157, 79, 1, 1, grey - 5);
        const int high = threshold_for(image, 1);
        const bool single = cv::countNonZero(reference::canny(image, high, high, true)) == 1;
        if (single && cv::countNonZero(reference::canny(image, low, high, true)) >= 440) {
            const Flags flags = {"long-weak-chain", "two-thresholds"};
            add_map(set, "weak-ring-one-strong", Tier::stress, flags, image, low, high, 1);
            add_map(set, "weak-ring-none-strong", Tier::stress, flags, image, low, threshold_for(image, 0), 1);
            return;
        }
    }
    throw std::runtime_error("no weak ring hangs on a single strong pixel");
}

/* Chains of weak edges with a strong spot at one end. */
void add_chains(Set &set)
{
    struct Chain {
        const char *name;
        cv::Mat image;
        cv::Point spot;
        Flags flags;
    };
    cv::Mat snake = constant(61, 61, 80);
    stroke(snake, serpentine(61, 61, 8), 4, 100);
    cv::Mat coil = constant(63, 63, 80);
    stroke(coil, spiral(63, 63, 8), 4, 100);
    const Chain chains[] = {
        {"serpentine-strong-start", snake, {4, 4}, {"long-weak-chain"}},
        {"serpentine-strong-end", snake, serpentine(61, 61, 8).back(), {"long-weak-chain", "label-merge"}},
        {"spiral-strong-inside", coil, spiral(63, 63, 8).back(), {"long-weak-chain", "label-merge"}},
        {"comb-joined-last", comb(60, 40, 8, 4, true, 100, 80), {56, 4}, {"label-merge"}},
        {"comb-joined-first", comb(60, 40, 8, 4, false, 100, 80), {4, 34}, {"label-merge"}},
    };
    for (const Chain &c : chains) {
        cv::Mat image = c.image.clone();
        fill(image, c.spot.x, c.spot.y, 2, 2, 220);
        add_map(set, c.name, Tier::stress, c.flags, image, 30, 300, 0);
        add_map(set, std::string(c.name) + "-smoothed", Tier::ordinary, c.flags, image, 20, 120, 1);
    }
}

void add_few_levels(Set &set)
{
    struct Levels {
        const char *name;
        std::vector<int> levels;
        int low, high, smooth;
    };
    /* magnitudes are multiples of the step: many equal neighbours, many that meet a threshold exactly */
    static const Levels levels[] = {
        {"levels-two", {0, 10}, 20, 40, 0},           {"levels-three", {0, 20, 40}, 60, 120, 0},
        {"levels-four", {10, 15, 20, 25}, 30, 60, 0}, {"levels-extreme", {0, 255}, 510, 1020, 0},
        {"levels-smooth", {0, 64, 128}, 100, 200, 1}, {"levels-equal-thresholds", {0, 20, 40}, 100, 100, 0},
        {"levels-low-zero", {7, 8}, 0, 3, 0},         {"levels-both-zero", {7, 8}, 0, 0, 0},
    };
    for (const Levels &l : levels) {
        accuracy::Random random = set.random(l.name);
        add_map(set, l.name, Tier::boundary, {"tie", "plateau", "two-thresholds"}, few_levels(40, 37, random, l.levels),
                l.low, l.high, l.smooth);
    }
}

} // namespace

void add_canny(Set &set)
{
    set.begin("canny");
    static const int sizes[][2] = {{1, 1},  {1, 40}, {40, 1}, {2, 2}, {3, 3},
                                   {2, 30}, {30, 2}, {3, 21}, {5, 7}, {33, 31}};
    for (const auto &s : sizes) {
        for (const int smooth : {0, 1}) {
            const std::string name =
                "noise-" + std::to_string(s[0]) + "x" + std::to_string(s[1]) + (smooth ? "-smoothed" : "");
            accuracy::Random random = set.random(name);
            add_map(set, name, Tier::boundary, {s[0] == 1 || s[1] == 1 ? "1xN" : "odd-size", "border"},
                    noise(s[0], s[1], random), smooth ? 40 : 200, smooth ? 100 : 500, smooth);
        }
    }
    accuracy::Random random = set.random("canny");
    add_map(set, "noise-64x64", Tier::ordinary, {}, noise(64, 64, random), 300, 700, 0);
    add_map(set, "noise-64x64-smoothed", Tier::ordinary, {}, noise(64, 64, random), 60, 150, 1);
    add_map(set, "noise-all-edges", Tier::stress, {"label-merge"}, noise(64, 48, random), 0, 400, 0);
    add_map(set, "noise-none-strong", Tier::boundary, {"two-thresholds", "saturation"}, noise(32, 32, random), 0, 2040,
            0);
    add_map(set, "noise-2048x3", Tier::stress, {"border"}, noise(2048, 3, random), 400, 900, 1);
    add_map(set, "flat", Tier::boundary, {"degenerate"}, constant(16, 16, 77), 0, 0, 1);
    add_map(set, "thresholds-huge", Tier::boundary, {"saturation"}, noise(16, 16, random), 2147483647, 2147483647, 0);
    add_map(set, "sector-borders", Tier::boundary, {"sector-boundary"}, sector_borders(random), 0, 0, 0);
    add_map(set, "disc-dark", Tier::ordinary, {}, disc_image(64, 64, 100, 40, 200), 40, 100, 1);
    add_map(set, "disc-bright", Tier::ordinary, {}, disc_image(63, 64, 101, 220, 30), 40, 100, 1);
    add_map(set, "disc-step", Tier::boundary, {"plateau", "tie"}, disc_image(48, 48, 76, 255, 0), 40, 100, 0);
    add_map(
        set, "ramps", Tier::boundary, {"plateau", "tie"},
        image_from(48, 48,
                   [](int x, int y) {
                       return x < 24 ? 8 * std::min(x, y) : y < 24 ? 250 - 10 * std::abs(x - 36) : 5 * (x + y) % 256;
                   }),
        20, 60, 0);
    add_few_levels(set);
    add_weak_ring(set);
    add_chains(set);
}

} // namespace vectors
