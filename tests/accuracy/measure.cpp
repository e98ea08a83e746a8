/* SPDX-License-Identifier: Apache-2.0 */
/* Call of the library, conversions and statistics. */
#include "measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace accuracy {

namespace {

Ellipse from_library(const drogue_ellipse &e)
{
    return {from_q16(e.xc_px_q16), from_q16(e.yc_px_q16), from_q16(e.a_px_q16), from_q16(e.b_px_q16),
            from_q16(e.angle_rad_q16)};
}

Pose from_library(const drogue_pose &p)
{
    return {{from_q16(p.position_m_q16[0]), from_q16(p.position_m_q16[1]), from_q16(p.position_m_q16[2])},
            {from_q16(p.axis_q16[0]), from_q16(p.axis_q16[1]), from_q16(p.axis_q16[2])}};
}

} // namespace

drogue_q16 to_q16(double v)
{
    const double scaled = std::floor(v * 65536 + 0.5);
    if (!(scaled >= INT32_MIN && scaled <= INT32_MAX)) {
        throw std::range_error("number outside Q16");
    }
    return static_cast<drogue_q16>(scaled);
}

Measurement measure(const cv::Mat &image, const Camera &camera, const drogue_model &model, const cv::Rect &region,
                    drogue_transfer transfer)
{
    const auto side = static_cast<uint32_t>(std::max(region.width, region.height));
    const drogue_capacity capacity = DROGUE_CAPACITY_FOR(side + (side + 3) / 4); /* every second look fits */
    std::vector<uint32_t> memory(drogue_workspace_bytes(&capacity) / sizeof(uint32_t) + 1);
    drogue_workspace workspace;
    drogue_config config;
    const drogue_camera q_camera = {to_q16(camera.fx_px), to_q16(camera.fy_px), to_q16(camera.cx_px),
                                    to_q16(camera.cy_px), to_q16(camera.k1),    to_q16(camera.k2),
                                    to_q16(camera.p1),    to_q16(camera.p2),    to_q16(camera.k3)};
    const drogue_image q_image = {image.data, image.cols, image.rows, static_cast<int32_t>(image.step)};
    const drogue_region q_region = {region.x, region.y, region.width, region.height};
    Measurement m;

    CV_Assert(image.type() == CV_8UC1);
    if (drogue_workspace_init(&workspace, memory.data(), memory.size() * sizeof(uint32_t), &capacity) != DROGUE_OK) {
        throw std::runtime_error("workspace refused");
    }
    drogue_config_default(&config);
    config.transfer = transfer;
    const drogue_setup setup = {&q_camera, &model, &config};
    m.ok = drogue_measure(&m.raw, &workspace, &setup, &q_image, &q_region) == DROGUE_OK;
    m.seen = from_library(m.raw.ellipse);
    m.ideal = from_library(m.raw.ideal);
    m.pose = from_library(m.raw.pose);
    m.alternative = from_library(m.raw.alternative);
    m.inner_px = {from_q16(m.raw.inner.x_px_q16), from_q16(m.raw.inner.y_px_q16)};
    return m;
}

cv::Mat grey_of(const cv::Mat &bgr)
{
    cv::Mat grey(bgr.size(), CV_8U);
    for (int y = 0; y < bgr.rows; y++) {
        for (int x = 0; x < bgr.cols; x++) {
            const auto p = bgr.at<cv::Vec3b>(y, x);
            grey.at<uint8_t>(y, x) = static_cast<uint8_t>((77 * p[2] + 150 * p[1] + 29 * p[0] + 128) >> 8);
        }
    }
    return grey;
}

double median(std::vector<double> values)
{
    if (values.empty()) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    std::sort(values.begin(), values.end());
    const size_t half = values.size() / 2;
    return values.size() % 2 != 0 ? values[half] : (values[half - 1] + values[half]) / 2;
}

double percentile(std::vector<double> values, double percent)
{
    if (values.empty()) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    std::sort(values.begin(), values.end());
    const auto rank = static_cast<size_t>(std::ceil(percent / 100 * static_cast<double>(values.size())));
    return values[std::min(values.size(), std::max<size_t>(rank, 1)) - 1];
}

double mean(const std::vector<double> &values)
{
    double sum = 0;
    for (const double v : values) {
        sum += v;
    }
    return values.empty() ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(values.size());
}

} // namespace accuracy
