/* SPDX-License-Identifier: Apache-2.0 */
/* Reference of the stages on pixels, by OpenCV. */
#include "reference.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <opencv2/imgproc.hpp>

namespace reference {

namespace {

/* Pixels with low <= 9 (2 distance / longest)^2 <= high. */
cv::Mat band(int width, int height, int centre2_x, int centre2_y, int longest, int low, int high)
{
    cv::Mat mask(height, width, CV_8U);
    const Real side2 = static_cast<Real>(longest) * longest;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            const Real dx = 2 * static_cast<Real>(x) - centre2_x;
            const Real dy = 2 * static_cast<Real>(y) - centre2_y;
            const Real d = 9 * (dx * dx + dy * dy);
            mask.at<uint8_t>(y, x) = d >= low * side2 && d <= high * side2 ? 255 : 0;
        }
    }
    return mask;
}

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

__extension__ typedef unsigned __int128 uint128;

/* Variance between two classes up to a common factor: (whole + rest / parts), rest < parts. */
struct Variance {
    uint128 whole = 0, rest = 0, parts = 1;

    bool operator<(const Variance &o) const
    {
        return whole != o.whole ? whole < o.whole : rest * o.parts < o.rest * parts;
    }
};

/* Variance of the classes <= t and > t for every t, exact for up to 2^22 pixels. */
std::array<Variance, 256> class_variances(const std::vector<uint8_t> &levels)
{
    std::array<int64_t, 256> histogram = {};
    std::array<Variance, 256> variance;
    int64_t sum = 0, below = 0, sum_below = 0;
    const int64_t count = static_cast<int64_t>(levels.size());
    for (const uint8_t v : levels) {
        histogram[v]++;
        sum += v;
    }
    for (size_t t = 0; t < 256; t++) {
        below += histogram[t];
        sum_below += histogram[t] * static_cast<int64_t>(t);
        if (below > 0 && below < count) {
            const uint128 d = static_cast<uint128>(std::abs(sum * below - sum_below * count));
            const uint128 parts = static_cast<uint128>(below * (count - below));
            variance[t] = {d * d / parts, d * d % parts, parts};
        }
    }
    return variance;
}

void find_threshold(InnerPart &part, const std::vector<uint8_t> &levels)
{
    const std::array<Variance, 256> variance = class_variances(levels);
    const auto most = std::max_element(variance.begin(), variance.end()); /* the first of equals */
    cv::Mat binary;
    part.threshold = static_cast<int>(most - variance.begin());
    part.threshold_opencv =
        levels.empty()
            ? 0
            : static_cast<int>(cv::threshold(levels, binary, 0, 255, cv::THRESH_BINARY_INV | cv::THRESH_OTSU));
    part.opencv_equal = most->whole == 0 || !(variance[static_cast<size_t>(part.threshold_opencv)] < *most);
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

cv::Mat ring(int width, int height, int centre2_x, int centre2_y, int longest)
{
    return band(width, height, centre2_x, centre2_y, longest, 4, 9);
}

cv::Mat disc(int width, int height, int centre2_x, int centre2_y, int longest)
{
    return band(width, height, centre2_x, centre2_y, longest, 0, 4);
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

namespace {

/* Levels of the pixels inside a mask. */
std::vector<uint8_t> levels_in(const cv::Mat &image, const cv::Mat &inside)
{
    std::vector<uint8_t> levels;
    for (int y = 0; y < image.rows; y++) {
        for (int x = 0; x < image.cols; x++) {
            if (inside.at<uint8_t>(y, x) != 0) {
                levels.push_back(image.at<uint8_t>(y, x));
            }
        }
    }
    return levels;
}

Point centroid_of(const std::vector<cv::Point> &pixels)
{
    Point sum = {0, 0};
    for (const cv::Point p : pixels) {
        sum.x += p.x;
        sum.y += p.y;
    }
    const auto count = static_cast<Real>(pixels.size());
    return {sum.x / count, sum.y / count};
}

int rounded(Real v) { return static_cast<int>(std::floor(v + 0.5L)); }

/* Mask of a disc about a point; its radius and a pixel are rounded as drogue_mask needs. */
cv::Mat window(const cv::Mat &image, Point at, Real radius)
{
    return disc(image.cols, image.rows, rounded(2 * at.x), rounded(2 * at.y), rounded(3 * radius) + 3);
}

/* Sum of darkness, which falls from 'range' at the level 'full' to 0, and its centroid; 'at' is kept when it is 0. */
Real weigh(Point &at, const cv::Mat &image, const cv::Mat &inside, int full, int range)
{
    Real sum = 0, x_sum = 0, y_sum = 0;
    for (int y = 0; y < image.rows; y++) {
        for (int x = 0; x < image.cols; x++) {
            const int darkness = std::clamp(full + range - image.at<uint8_t>(y, x), 0, range);
            if (inside.at<uint8_t>(y, x) != 0 && darkness > 0) {
                sum += darkness;
                x_sum += static_cast<Real>(darkness) * x;
                y_sum += static_cast<Real>(darkness) * y;
            }
        }
    }
    if (sum > 0) {
        at = {x_sum / sum, y_sum / sum};
    }
    return sum;
}

} // namespace

InnerPart inner_part(const cv::Mat &image, int centre2_x, int centre2_y, int longest, int min_area)
{
    InnerPart part = {};
    const cv::Mat inside = disc(image.cols, image.rows, centre2_x, centre2_y, longest);
    find_threshold(part, levels_in(image, inside));
    part.dark = (image <= part.threshold) & inside;
    cv::morphologyEx(part.dark, part.opened, cv::MORPH_OPEN, cv::Mat::ones(3, 3, CV_8U));
    part.area_unique = true;
    for (const std::vector<cv::Point> &pixels : components(part.opened)) {
        const int area = static_cast<int>(pixels.size());
        if (area <= part.area) {
            part.area_unique = part.area_unique && area < part.area;
            continue;
        }
        part.area = area;
        part.area_unique = true;
        const Point centre = centroid_of(pixels);
        part.x = centre.x;
        part.y = centre.y;
    }
    part.found = part.area > 0 && part.area >= min_area;
    return part;
}

InnerDisc inner_disc(const cv::Mat &image, int centre2_x, int centre2_y, int longest, int min_area,
                     const std::vector<Ellipse> &expected)
{
    constexpr Real PI = 3.14159265358979323846264338327950288L;
    const InnerPart all = inner_part(image, centre2_x, centre2_y, longest, min_area);
    InnerDisc out = {};
    Real least = 0;
    Point at = {0, 0};
    out.threshold = all.threshold;
    for (size_t i = 0; i < expected.size(); i++) {
        const Ellipse &e = expected[i];
        std::vector<cv::Point> members;
        for (const std::vector<cv::Point> &pixels : components(all.opened)) {
            const Point p = centroid_of(pixels);
            if (static_cast<int>(pixels.size()) >= min_area && std::hypot(p.x - e.xc, p.y - e.yc) <= e.a) {
                members.insert(members.end(), pixels.begin(), pixels.end());
            }
        }
        if (members.empty()) {
            continue;
        }
        const Point p = centroid_of(members);
        const Real fill = static_cast<Real>(members.size()) / (PI * e.a * e.b);
        const Real misfit = std::hypot(p.x - e.xc, p.y - e.yc) / e.a + std::fabs(fill - 1);
        if (!out.found || misfit < least) {
            least = misfit;
            at = p;
            out.which = static_cast<int>(i);
            out.area = static_cast<int64_t>(members.size());
        }
        out.found = true;
    }
    if (!out.found) {
        return out;
    }
    /* about the part's own threshold, a third of the way to the dark level on either side */
    const Ellipse &e = expected[static_cast<size_t>(out.which)];
    InnerPart own = {};
    const std::vector<uint8_t> levels = levels_in(image, window(image, at, 1.6L * e.a));
    find_threshold(own, levels);
    int64_t count[2] = {0, 0}, sum[2] = {0, 0};
    for (const uint8_t level : levels) {
        count[level > own.threshold]++;
        sum[level > own.threshold] += level;
    }
    const int dark = count[0] > 0 ? static_cast<int>(sum[0] / count[0]) : 0,
              bright = count[1] > 0 ? static_cast<int>(sum[1] / count[1]) : 0;
    out.contrast = std::max(0, bright - dark);
    const int half = (own.threshold - dark) / 3;
    const int range = 2 * half + 1, full = own.threshold - half;
    weigh(at, image, window(image, at, 1.2L * e.a), full, range);
    const cv::Mat inside = window(image, at, 1.2L * e.a);
    const Real darkness = weigh(at, image, inside, full, range);
    Point lower = at, upper = at;
    weigh(lower, image, inside, full - half, range);
    weigh(upper, image, inside, full + half, range);
    out.threshold = own.threshold;
    out.x = at.x;
    out.y = at.y;
    out.area = darkness > 0 ? static_cast<int64_t>(std::floor(darkness / range + 0.5L)) : out.area;
    out.spread = std::hypot(upper.x - lower.x, upper.y - lower.y);
    out.fill = static_cast<Real>(out.area) / (PI * e.a * e.b);
    return out;
}

} // namespace reference
