/* SPDX-License-Identifier: Apache-2.0 */
/* The library with memory for an image, and the time of a thread. */
#pragma once

#include <time.h>

#include <functional>
#include <vector>

#include <opencv2/core.hpp>

#include "drogue/track.h"
#include "measure.hpp"

namespace bench {

const double rim_m = 0.35, inner_m = 0.12, depth_m = 0.25;

inline double cpu_s()
{
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

inline double seconds(const std::function<void()> &work)
{
    const double begin = cpu_s();
    work();
    return cpu_s() - begin;
}

/* The library with memory for an image. */
struct Library {
    Library(const cv::Mat &image, const accuracy::Camera &camera)
        : q_image{image.data, image.cols, image.rows, static_cast<int32_t>(image.step)}, region{0, 0, image.cols,
                                                                                                image.rows}
    {
        const auto side = static_cast<uint32_t>(std::max(image.cols, image.rows));
        const uint32_t area = side * side;
        const drogue_capacity capacity = {side, area / 2, area / 4 + 2, area / 8 + 96};
        memory.resize(drogue_workspace_bytes(&capacity) / sizeof(uint32_t) + 1);
        search_memory.resize(DROGUE_SEARCH_BYTES(image.cols));
        drogue_config_default(&config);
        q_camera = {accuracy::to_q16(camera.fx_px),
                    accuracy::to_q16(camera.fy_px),
                    accuracy::to_q16(camera.cx_px),
                    accuracy::to_q16(camera.cy_px),
                    0,
                    0,
                    0,
                    0,
                    0};
        model = {accuracy::to_q16(rim_m), accuracy::to_q16(inner_m), accuracy::to_q16(depth_m)};
        drogue_track_config track_config;
        drogue_track_config_default(&track_config);
        CV_Assert(drogue_workspace_init(&workspace, memory.data(), memory.size() * 4, &capacity) == DROGUE_OK);
        CV_Assert(drogue_search_init(&search, search_memory.data(), search_memory.size(), image.cols) == DROGUE_OK);
        CV_Assert(drogue_track_init(&track, &track_config, &q_camera, &model, &region) == DROGUE_OK);
    }

    void front_end(bool ring)
    {
        drogue_frontend f;
        const drogue_mask mask = drogue_mask_of_size(region.width_px, region.height_px);
        const drogue_frontend_config c = {
            config.canny_low, config.canny_high, 1, ring, mask, static_cast<uint32_t>(region.width_px) / 8};
        CV_Assert(drogue_frontend_begin(&f, &workspace, &c, region.width_px, region.height_px) == DROGUE_OK);
        for (int32_t y = 0; y < region.height_px; y++) {
            drogue_frontend_row(&f, drogue_image_row(&q_image, y));
        }
        (void)drogue_frontend_end(&list, &f);
    }
    void outline()
    {
        const drogue_mask mask = drogue_mask_of_size(region.width_px, region.height_px);
        drogue_outline out;
        (void)drogue_outline_find(&out, &workspace, &list, &mask, &config);
    }
    void measure()
    {
        const drogue_setup setup = {&q_camera, &model, &config};
        (void)drogue_measure(&result, &workspace, &setup, &q_image, &region);
    }
    void seek()
    {
        CV_Assert(drogue_search_begin(&search, region.width_px) == DROGUE_OK);
        for (int32_t y = 0; y < region.height_px; y++) {
            drogue_search_row(&search, drogue_image_row(&q_image, y));
        }
        (void)drogue_search_end(&search);
    }
    void follow()
    {
        drogue_region used;
        (void)drogue_track_frame(&result, &used, &track, &workspace, &search, &config, &q_image, 40000);
    }

    drogue_image q_image;
    drogue_region region;
    drogue_camera q_camera;
    drogue_model model;
    drogue_config config;
    drogue_workspace workspace;
    drogue_search search;
    drogue_track track;
    drogue_result result;
    drogue_edge_list list = {0, 0};
    std::vector<uint32_t> memory;
    std::vector<uint8_t> search_memory;
};

} // namespace bench
