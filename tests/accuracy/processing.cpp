/* SPDX-License-Identifier: Apache-2.0 */
/* What comes after the sensor. */
#include "processing.hpp"

#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace accuracy {

namespace {

cv::Mat toned(const cv::Mat &picture, const std::function<double(double)> &curve)
{
    cv::Mat table(1, 256, CV_8U), out;
    for (int i = 0; i < 256; i++) {
        table.at<uint8_t>(i) = cv::saturate_cast<uint8_t>(255 * curve(i / 255.0));
    }
    cv::LUT(picture, table, out);
    return out;
}

double srgb(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

cv::Mat coded(const cv::Mat &picture, int quality)
{
    std::vector<uint8_t> bytes;
    cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
    return cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
}

cv::Mat sharpened(const cv::Mat &picture, double amount)
{
    cv::Mat blurred, out;
    cv::GaussianBlur(picture, blurred, {}, 1);
    cv::addWeighted(picture, 1 + amount, blurred, -amount, 0, out);
    return out;
}

cv::Mat denoised(const cv::Mat &picture)
{
    cv::Mat out;
    cv::medianBlur(picture, out, 3);
    return out;
}

cv::Mat resized(const cv::Mat &picture)
{
    cv::Mat small, out;
    cv::resize(picture, small, {(2 * picture.cols + 1) / 3, (2 * picture.rows + 1) / 3}, 0, 0, cv::INTER_AREA);
    cv::resize(small, out, picture.size(), 0, 0, cv::INTER_LINEAR);
    return out;
}

cv::Mat defocused(const cv::Mat &picture, double radius_px)
{
    const int reach = 3, parts = 8;
    cv::Mat disc = cv::Mat::zeros(2 * reach + 1, 2 * reach + 1, CV_32F), out;
    for (int i = 0; i < disc.rows * parts; i++) {
        for (int k = 0; k < disc.cols * parts; k++) {
            const double y = (i + 0.5) / parts - reach - 0.5, x = (k + 0.5) / parts - reach - 0.5;
            disc.at<float>(i / parts, k / parts) += x * x + y * y <= radius_px * radius_px ? 1.0F : 0.0F;
        }
    }
    cv::filter2D(picture, out, CV_8U, disc / cv::sum(disc)[0]);
    return out;
}

cv::Mat glowing(const cv::Mat &picture)
{
    cv::Mat light, narrow, wide, out;
    picture.convertTo(light, CV_32F, 1 / 255.0);
    const cv::Mat bright = cv::max(light - 0.6F, 0.0F);
    cv::GaussianBlur(bright, narrow, {}, 6);
    cv::GaussianBlur(bright, wide, {}, 14);
    cv::Mat(light + 0.5 * narrow + 0.5 * wide).convertTo(out, CV_8U, 255);
    return out;
}

cv::Mat vignetted(const cv::Mat &picture)
{
    cv::Mat out = picture.clone();
    for (int y = 0; y < out.rows; y++) {
        for (int x = 0; x < out.cols; x++) {
            out.at<uint8_t>(y, x) = cv::saturate_cast<uint8_t>(out.at<uint8_t>(y, x) * (0.55 + 0.6 * x / out.cols));
        }
    }
    return out;
}

using Named = std::pair<const char *, cv::Mat (*)(const cv::Mat &)>;

const Named all[] = {
    {"jpeg", [](const cv::Mat &p) { return coded(p, 85); }},
    {"sharp", [](const cv::Mat &p) { return sharpened(p, 1); }},
    {"both", [](const cv::Mat &p) { return coded(sharpened(p, 0.8), 80); }},
    {"median", denoised},
    {"resized", resized},
    {"defocus", [](const cv::Mat &p) { return defocused(p, 1.8); }},
    {"glow", glowing},
    {"haze", [](const cv::Mat &p) { return toned(p, [](double v) { return 0.35 + 0.3 * v; }); }},
    {"vignette", vignetted},
    {"exposed", [](const cv::Mat &p) { return toned(p, [](double v) { return 1.5 * v; }); }},
    {"srgb", [](const cv::Mat &p) { return toned(p, srgb); }},
    {"told", [](const cv::Mat &p) { return toned(p, srgb); }},
    {"curve", [](const cv::Mat &p) { return toned(p, [](double v) { return v * v * (3 - 2 * v); }); }}};

} // namespace

const std::vector<std::string> &processings()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const Named &n : all) {
            list.emplace_back(n.first);
        }
        return list;
    }();
    return names;
}

cv::Mat processed(const cv::Mat &picture, const std::string &processing)
{
    for (const Named &n : all) {
        if (processing == n.first) {
            return n.second(picture);
        }
    }
    throw std::invalid_argument("no processing " + processing);
}

drogue_transfer transfer_of(const std::string &processing)
{
    return processing == "told" ? DROGUE_TRANSFER_SRGB : DROGUE_TRANSFER_LINEAR;
}

} // namespace accuracy
