/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of the inner disc where it is expected: cut by ribs, hidden, blurred, beside other inner parts. */
#include <cmath>

#include "images.hpp"

namespace vectors {

namespace {

struct Job {
    cv::Mat image;
    int centre2_x, centre2_y, longest, min_area = 9;
    std::vector<double> expected; /* xc yc a b of each */
};

void add_job(Set &set, const std::string &name, Tier tier, const Flags &flags, const Job &j)
{
    std::vector<int64_t> words;
    for (const double v : j.expected) {
        words.push_back(static_cast<int64_t>(std::floor(v * 65536 + 0.5)));
    }
    set.add(name, tier, flags,
            {image_array("image", j.image),
             word_array("params", 32, 0, {j.centre2_x, j.centre2_y, j.longest, j.min_area}),
             word_array("expected", 32, 16, words)});
}

/* An ellipse drawn with a ramp of 'ramp' px; whole numbers decide, as in images.cpp. */
void draw(cv::Mat &image, double xc, double yc, double a, double b, double ramp, int ink)
{
    const cv::Mat before = image.clone();
    image = image_from(image.cols, image.rows, [&](int x, int y) {
        const double r = std::hypot((x - xc) / a, (y - yc) / b);
        const double share = std::min(1.0, std::max(0.0, ((1 - r) * std::sqrt(a * b) + ramp / 2) / ramp));
        const int paper = before.at<uint8_t>(y, x);
        return paper + static_cast<int>(std::floor(share * (ink - paper) + 0.5));
    });
}

Job canopy(int side = 80)
{
    Job j = {constant(side, side, 110), side - 1, side - 1, side, 9, {}};
    return j;
}

void add_plain(Set &set)
{
    Job j = canopy();
    draw(j.image, 41.3, 38.2, 11, 10.2, 2, 12);
    j.expected = {41, 39, 11, 10};
    add_job(set, "where-expected", Tier::ordinary, {}, j);
    j.expected = {30, 39, 11, 10, 42, 38, 11, 10};
    add_job(set, "second-expected", Tier::ordinary, {"twin-pose"}, j);
    j.expected = {42, 38, 11, 10, 30, 39, 11, 10};
    add_job(set, "first-expected", Tier::ordinary, {"twin-pose"}, j);
    j.expected = {41, 39, 11, 10, 41, 39, 8, 7};
    add_job(set, "first-of-the-right-size", Tier::ordinary, {"twin-pose"}, j);
    j.expected = {41, 39, 16, 15, 41, 39, 11, 10};
    add_job(set, "second-of-the-right-size", Tier::ordinary, {"twin-pose"}, j);
    j.expected = {41, 39, 11, 10, 41, 39, 11, 10};
    add_job(set, "expected-twice", Tier::boundary, {"tie", "head-on"}, j);
    j.expected = {58, 39, 11, 10};
    add_job(set, "expected-too-far", Tier::must_reject, {"inner-missing"}, j);
    j.expected = {58, 39, 11, 10, 43, 42, 11, 10};
    add_job(set, "first-too-far", Tier::ordinary, {"twin-pose"}, j);
    j.expected = {41, 39, 11, 10};
    j.min_area = 10000;
    add_job(set, "smaller-than-the-least", Tier::must_reject, {"threshold-met"}, j);
    j.min_area = 0;
    j.longest = 30;
    add_job(set, "looked-for-in-a-small-disc", Tier::boundary, {"border"}, j);
    j.longest = 0;
    add_job(set, "no-disc", Tier::must_reject, {"argument", "mask-range"}, j);
    for (int k = 0; k < 6; k++) {
        const std::string name = "blurred-" + std::to_string(k);
        accuracy::Random random = set.random(name);
        Job b = canopy(70);
        const double x = random.uniform(30, 40);
        const double y = random.uniform(30, 40);
        const double a = random.uniform(4, 13);
        const double flat = random.uniform(0.85, 1);
        const double ramp = random.uniform(1, 6);
        draw(b.image, x, y, a, a * flat, ramp, between(random, 5, 60));
        for (int row = 0; row < b.image.rows; row++) {
            for (int column = 0; column < b.image.cols; column++) {
                uint8_t &p = b.image.at<uint8_t>(row, column);
                p = static_cast<uint8_t>(std::min(255, std::max(0, p + between(random, -4, 4))));
            }
        }
        const double dx = random.uniform(-3, 3);
        b.expected = {x + dx, y - 1, a, a * flat, x - 6, y + 5, a, a * flat};
        add_job(set, name, Tier::ordinary, {"noise", "motion-blur"}, b);
    }
}

void add_disturbed(Set &set)
{
    Job j = canopy();
    draw(j.image, 40, 40, 14, 13, 2, 12);
    j.expected = {40.5, 39.5, 14, 13};
    Job ribs = j;
    fill(ribs.image, 39, 0, 3, 80, 150);
    fill(ribs.image, 0, 39, 80, 3, 150);
    add_job(set, "cut-by-ribs", Tier::ordinary, {"occlusion", "label-merge"}, ribs);
    ribs.min_area = 200;
    add_job(set, "each-piece-too-small", Tier::must_reject, {"occlusion", "threshold-met"}, ribs);
    Job beside = j;
    draw(beside.image, 58, 52, 8, 8, 2, 8);
    draw(beside.image, 22, 24, 9, 6, 2, 10);
    add_job(set, "dark-parts-beside-it", Tier::ordinary, {}, beside);
    draw(beside.image, 51, 44, 5, 5, 1, 10);
    add_job(set, "a-dark-part-grown-on", Tier::stress, {"label-merge"}, beside);
    Job hidden = j;
    fill(hidden.image, 44, 0, 36, 80, 140);
    add_job(set, "partly-hidden", Tier::stress, {"occlusion"}, hidden);
    Job larger = j;
    draw(larger.image, 20, 22, 17, 15, 2, 5);
    add_job(set, "a-larger-one-beside-it", Tier::ordinary, {}, larger);
    Job sheen = j;
    for (int y = 0; y < 80; y++) {
        for (int x = 0; x < 80; x++) {
            sheen.image.at<uint8_t>(y, x) = static_cast<uint8_t>(sheen.image.at<uint8_t>(y, x) * (40 + x) / 120);
        }
    }
    add_job(set, "light-falls-off", Tier::ordinary, {}, sheen);
    Job brighter = j;
    draw(brighter.image, 40, 40, 4, 4, 1, 90);
    add_job(set, "hole-in-the-middle", Tier::stress, {}, brighter);
}

void add_extremes(Set &set)
{
    Job j = canopy();
    j.expected = {40, 40, 10, 9};
    add_job(set, "one-level", Tier::must_reject, {"degenerate"}, j);
    j.image = constant(80, 80, 0);
    add_job(set, "all-black", Tier::boundary, {"degenerate"}, j);
    j.image = disc_image(80, 80, 40, 0, 255);
    add_job(set, "black-on-white", Tier::boundary, {"saturation"}, j);
    j.image = disc_image(80, 80, 40, 100, 101);
    add_job(set, "one-level-apart", Tier::boundary, {"otsu-tie"}, j);
    j.image = disc_image(80, 80, 40, 100, 103);
    add_job(set, "three-levels-apart", Tier::boundary, {"half-lsb"}, j);
    j.image = disc_image(80, 80, 40, 20, 200);
    j.expected = {40, 40, 10, 9, 39, 39, 10, 9}; /* mirror images about the disc's middle */
    add_job(set, "equal-misfits", Tier::boundary, {"tie"}, j);
    std::swap(j.expected[0], j.expected[4]);
    std::swap(j.expected[1], j.expected[5]);
    add_job(set, "equal-misfits-back", Tier::boundary, {"tie"}, j);
    for (const int at : {4, 75}) {
        Job corner = canopy();
        corner.longest = 300;
        draw(corner.image, at, at, 9, 9, 2, 10);
        corner.expected = {static_cast<double>(at), static_cast<double>(at), 9, 9};
        add_job(set, "in-the-corner-" + std::to_string(at), Tier::boundary, {"border"}, corner);
    }
    Job odd = {constant(61, 47, 120), 60, 46, 61, 4, {31.25, 22.75, 2, 1.5}};
    draw(odd.image, 31, 23, 2.4, 2.2, 1, 10);
    add_job(set, "few-pixels", Tier::boundary, {"odd-size", "opening"}, odd);
    odd.expected = {31.25, 22.75, 1, 1.0 / 65536};
    add_job(set, "least-expectation", Tier::boundary, {"saturation"}, odd);
    odd.expected = {31.25, 22.75, 2000, 1900};
    add_job(set, "largest-expectation", Tier::stress, {"saturation"}, odd);
    odd.expected = {-30000, 30000, 20, 20, 31, 23, 3, 3};
    add_job(set, "expected-far-outside", Tier::stress, {"saturation"}, odd);
    odd.image = image_from(61, 1, [](int x, int) { return x % 20 < 9 ? 20 : 200; });
    odd.expected = {24, 0, 5, 5};
    odd.centre2_y = 0;
    add_job(set, "one-row", Tier::boundary, {"1xN", "opening"}, odd);
    Job wide = {constant(400, 60, 120), 399, 59, 500, 9, {180.5, 30, 20, 19}};
    draw(wide.image, 181, 29.5, 20, 19, 3, 15);
    draw(wide.image, 300, 29.5, 20, 19, 3, 15);
    add_job(set, "wide-image", Tier::ordinary, {}, wide);
}

} // namespace

void add_disc(Set &set)
{
    set.begin("disc");
    add_plain(set);
    add_disturbed(set);
    add_extremes(set);
}

} // namespace vectors
