/* SPDX-License-Identifier: Apache-2.0 */
/* Images for the cases. */
#include "images.hpp"

#include <algorithm>

namespace vectors {

cv::Mat image_from(int width, int height, const std::function<int(int x, int y)> &grey)
{
    cv::Mat image(height, width, CV_8U);
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            image.at<uint8_t>(y, x) = static_cast<uint8_t>(std::clamp(grey(x, y), 0, 255));
        }
    }
    return image;
}

cv::Mat constant(int width, int height, int grey)
{
    return image_from(width, height, [grey](int, int) { return grey; });
}

cv::Mat noise(int width, int height, accuracy::Random &random, int low, int high)
{
    return image_from(width, height, [&](int, int) { return between(random, low, high); });
}

cv::Mat few_levels(int width, int height, accuracy::Random &random, const std::vector<int> &levels)
{
    return image_from(width, height, [&](int, int) {
        return levels[static_cast<size_t>(between(random, 0, static_cast<int>(levels.size()) - 1))];
    });
}

cv::Mat disc_image(int width, int height, int radius4, int inside, int outside)
{
    return image_from(width, height, [=](int x, int y) {
        const int dx = 2 * x - (width - 1);
        const int dy = 2 * y - (height - 1);
        return 4 * (dx * dx + dy * dy) <= radius4 * radius4 ? inside : outside;
    });
}

cv::Mat soft_disc(int width, int height, int centre2_x, int centre2_y, int radius4, int ramp4, int inside, int outside)
{
    return image_from(width, height, [=](int x, int y) {
        const int64_t dx = 2 * x - centre2_x;
        const int64_t dy = 2 * y - centre2_y;
        const int64_t square = 1024 * (dx * dx + dy * dy); /* of the distance in units of 1/64 px */
        int64_t distance = 0;
        for (int64_t bit = 1 << 16; bit > 0; bit >>= 1) { /* integer square root */
            if ((distance + bit) * (distance + bit) <= square) {
                distance += bit;
            }
        }
        const int64_t beyond = std::clamp<int64_t>(distance - 16 * radius4 + 8 * ramp4, 0, 16 * ramp4);
        return inside + static_cast<int>((outside - inside) * beyond / (16 * ramp4));
    });
}

void fill(cv::Mat &image, int x, int y, int w, int h, int grey)
{
    for (int v = std::max(y, 0); v < std::min(y + h, image.rows); v++) {
        for (int u = std::max(x, 0); u < std::min(x + w, image.cols); u++) {
            image.at<uint8_t>(v, u) = static_cast<uint8_t>(grey);
        }
    }
}

void stroke(cv::Mat &image, const std::vector<cv::Point> &points, int thickness, int grey)
{
    for (size_t i = 0; i + 1 < points.size(); i++) {
        const cv::Point a = points[i];
        const cv::Point b = points[i + 1];
        fill(image, std::min(a.x, b.x), std::min(a.y, b.y), std::abs(a.x - b.x) + thickness,
             std::abs(a.y - b.y) + thickness, grey);
    }
}

std::vector<cv::Point> serpentine(int width, int height, int pitch)
{
    std::vector<cv::Point> points;
    const int left = pitch / 2;
    const int right = width - pitch;
    for (int y = left, turn = 0; y < height - pitch / 2; y += pitch, turn++) {
        points.emplace_back(turn % 2 == 0 ? left : right, y);
        points.emplace_back(turn % 2 == 0 ? right : left, y);
    }
    return points;
}

std::vector<cv::Point> spiral(int width, int height, int pitch)
{
    std::vector<cv::Point> points;
    int left = pitch / 2;
    int top = pitch / 2;
    int right = width - pitch;
    int bottom = height - pitch;
    points.emplace_back(left, top);
    while (left < right && top < bottom) {
        points.emplace_back(right, top);
        points.emplace_back(right, bottom);
        top += pitch;
        points.emplace_back(left, bottom);
        right -= pitch;
        points.emplace_back(left, top);
        bottom -= pitch;
        left += pitch;
    }
    return points;
}

cv::Mat comb(int width, int height, int pitch, int thickness, bool bar_last, int ink, int paper)
{
    cv::Mat image = constant(width, height, paper);
    for (int x = pitch / 2; x + thickness <= width; x += pitch) {
        fill(image, x, pitch / 2, thickness, height - pitch, ink);
    }
    fill(image, pitch / 2, bar_last ? height - pitch / 2 - thickness : pitch / 2, width - pitch, thickness, ink);
    return image;
}

} // namespace vectors
