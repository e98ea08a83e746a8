/* SPDX-License-Identifier: Apache-2.0 */
/* Reference of the stages on pixels, by OpenCV. */
#include "reference.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace reference {

namespace {

bool raster_before(cv::Point p, cv::Point q) { return p.y != q.y ? p.y < q.y : p.x < q.x; }

/* Pixels of each component but the background, in raster order of their first pixel. */
std::vector<std::vector<cv::Point>> components(const cv::Mat &map)
{
    cv::Mat labels;
    std::vector<std::vector<cv::Point>> all(static_cast<size_t>(cv::connectedComponents(map, labels, 8, CV_32S)));
    for (int y = 0; y < map.rows; y++) {
        for (int x = 0; x < map.cols; x++) {
            all[static_cast<size_t>(labels.at<int32_t>(y, x))].emplace_back(x, y);
        }
    }
    all.erase(all.begin());
    std::sort(all.begin(), all.end(), [](const auto &p, const auto &q) { return raster_before(p[0], q[0]); });
    return all;
}

} // namespace

cv::Mat smooth(const cv::Mat &image)
{
    cv::Mat out;
    cv::GaussianBlur(image, out, cv::Size(5, 5), 0, 0, cv::BORDER_REFLECT_101);
    return out;
}

void gradient(const cv::Mat &image, cv::Mat &gx, cv::Mat &gy)
{
    cv::Sobel(image, gx, CV_16S, 1, 0, 3, 1, 0, cv::BORDER_REPLICATE);
    cv::Sobel(image, gy, CV_16S, 0, 1, 3, 1, 0, cv::BORDER_REPLICATE);
}

cv::Mat canny(const cv::Mat &image, int low, int high, bool smoothed)
{
    cv::Mat edges;
    cv::Canny(smoothed ? smooth(image) : image, edges, low, high, 3, false);
    return edges;
}

cv::Mat canny_within(const cv::Mat &image, int low, int high, bool smoothed, const cv::Mat &mask)
{
    const cv::Mat candidates = canny(image, low, low, smoothed) & mask; /* all are strong, so all are kept */
    const cv::Mat strong = canny(image, high, high, smoothed) & mask;
    cv::Mat edges = cv::Mat::zeros(image.size(), CV_8U);
    for (const std::vector<cv::Point> &pixels : components(candidates)) {
        const bool kept =
            std::any_of(pixels.begin(), pixels.end(), [&](cv::Point p) { return strong.at<uint8_t>(p) != 0; });
        for (const cv::Point p : pixels) {
            edges.at<uint8_t>(p) = kept ? 255 : 0;
        }
    }
    return edges;
}

cv::Mat ring(int width, int height, int centre2_x, int centre2_y, int longest)
{
    cv::Mat mask(height, width, CV_8U);
    const Real side2 = static_cast<Real>(longest) * longest;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            const Real dx = 2 * static_cast<Real>(x) - centre2_x;
            const Real dy = 2 * static_cast<Real>(y) - centre2_y;
            const Real d = dx * dx + dy * dy; /* (2 distance)^2 */
            mask.at<uint8_t>(y, x) = 9 * d >= 4 * side2 && d <= side2 ? 255 : 0;
        }
    }
    return mask;
}

std::vector<Arc> arcs(const cv::Mat &edges, const cv::Mat &gx, const cv::Mat &gy)
{
    const cv::Mat of_class[4] = {(gx >= 0) & (gy < 0), (gx < 0) & (gy <= 0), (gx <= 0) & (gy > 0),
                                 (gx > 0) & (gy >= 0)};
    std::vector<Arc> all;
    for (int c = 0; c < 4; c++) {
        for (const std::vector<cv::Point> &pixels : components(edges & of_class[c])) {
            all.push_back({c, pixels});
        }
    }
    std::sort(all.begin(), all.end(),
              [](const Arc &p, const Arc &q) { return raster_before(p.pixels[0], q.pixels[0]); });
    return all;
}

} // namespace reference
