/* SPDX-License-Identifier: Apache-2.0 */
/* Renders frames and searches them. */
#include "whole_frame.hpp"

#include <algorithm>
#include <cmath>

#include "measure.hpp"

namespace accuracy {

cv::Rect frame_of(const Trial &t)
{
    const int side = std::max(frame_px, static_cast<int>(std::lround(3.2 * t.rim.a_px)));
    const double room = 0.5 - 0.5 * std::min(1.0, 2.6 * t.rim.a_px / side);
    Random random(hash_at(t.scene.seed, 1, 2));
    const int x = static_cast<int>(std::lround(t.rim.xc_px - side * (0.5 + room * random.uniform(-1, 1))));
    const int y = static_cast<int>(std::lround(t.rim.yc_px - side * (0.5 + room * random.uniform(-1, 1))));
    return cv::Rect(x, y, side, side) & cv::Rect({0, 0}, t.scene.image_px);
}

cv::Mat empty_frame(const Trial &t, const cv::Rect &frame)
{
    const Scene &s = t.scene;
    cv::Mat image(frame.size(), CV_8U);
    for (int y = 0; y < image.rows; y++) {
        for (int x = 0; x < image.cols; x++) {
            image.at<uint8_t>(y, x) = cv::saturate_cast<uint8_t>(background_grey(s, x + frame.x, y + frame.y) +
                                                                 s.sensor.noise * normal_at(s.seed + 5, x, y));
        }
    }
    return image;
}

cv::Mat whole_frame(const Trial &t, const cv::Rect &frame)
{
    cv::Mat image = empty_frame(t, frame);
    const int half = static_cast<int>(std::lround(2 * t.rim.a_px)) + 20;
    const cv::Rect about = cv::Rect(static_cast<int>(std::lround(t.rim.xc_px)) - half,
                                    static_cast<int>(std::lround(t.rim.yc_px)) - half, 2 * half, 2 * half) &
                           frame;
    render(t.scene, about).copyTo(image(about - frame.tl()));
    return image;
}

Acquired acquire(const cv::Mat &image, const Camera &c, const drogue_model &model)
{
    const drogue_camera camera = {to_q16(c.fx_px), to_q16(c.fy_px), to_q16(c.cx_px), to_q16(c.cy_px), to_q16(c.k1),
                                  to_q16(c.k2),    to_q16(c.p1),    to_q16(c.p2),    to_q16(c.k3)};
    const drogue_image view = {image.data, image.cols, image.rows, static_cast<int32_t>(image.step)};
    const drogue_capacity capacity = DROGUE_CAPACITY_FOR(std::max(image.cols, image.rows));
    std::vector<uint32_t> memory(drogue_workspace_bytes(&capacity) / sizeof(uint32_t) + 1);
    std::vector<uint8_t> search_memory(DROGUE_SEARCH_BYTES(static_cast<size_t>(image.cols)));
    drogue_workspace workspace;
    drogue_search search;
    drogue_config config;
    Acquired acquired;
    CV_Assert(drogue_workspace_init(&workspace, memory.data(), memory.size() * sizeof(uint32_t), &capacity) ==
                  DROGUE_OK &&
              drogue_search_init(&search, search_memory.data(), search_memory.size(), image.cols) == DROGUE_OK);
    drogue_config_default(&config);
    const drogue_setup setup = {&camera, &model, &config};
    (void)drogue_acquire(&acquired.result, &workspace, &search, &setup, &view, nullptr);
    acquired.sightings.assign(search.best, search.best + search.count);
    return acquired;
}

bool suits(const cv::Point2d &middle_px, double side_px, const Ellipse &rim)
{
    const double off = std::hypot(middle_px.x - rim.xc_px, middle_px.y - rim.yc_px);
    const double side = side_px / (2.5 * rim.a_px);
    return off < 0.35 * rim.a_px && side > 0.8 && side < 1.25;
}

int rank_of(const std::vector<drogue_sighting> &sightings, const Ellipse &rim, const cv::Point &origin)
{
    for (size_t k = 0; k < sightings.size(); k++) {
        const drogue_sighting &s = sightings[k];
        if (suits(cv::Point2d(s.x_px + origin.x, s.y_px + origin.y), s.region.width_px, rim)) {
            return static_cast<int>(k);
        }
    }
    return -1;
}

} // namespace accuracy
